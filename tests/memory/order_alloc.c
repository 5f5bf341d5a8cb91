/* Ordering points when memory runs out. */
#include "failing.h"

static pia_status order(pia_context *context, void *how)
{
    double points[2 * 50];
    pia_index rows[50];
    for (int i = 0; i < 50; i++) {
        points[2 * i] = i * 17 % 50;
        points[2 * i + 1] = sin(0.2 * (i * 17 % 50));
    }
    pia_order_report report = {.struct_size = sizeof report};
    return pia_points_order(context, points, 50, 2, how, rows, &report);
}

static void ordering_survives_every_failure(void **state)
{
    (void)state;
    char nearest[] = "nearest", tree[] = "tree";
    assert_survives_failures(order, nearest);
    assert_survives_failures(order, tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ordering_survives_every_failure)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
