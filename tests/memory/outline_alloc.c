/* Trimming to points when memory runs out. */
#include "failing.h"

static pia_status trim(pia_context *context, void *user)
{
    static const double ends[] = {0, 0, 1, 1}, control[] = {0, 0, 1, 0, 0, 1, 1, 1};
    const double *knots[] = {ends, ends};
    double uv[2 * 64];
    pia_model *model = NULL, *out = NULL;
    for (int i = 0; i < 64; i++) { /* a frame: one hole */
        int side = i / 16;
        double along = (i % 16) / 15.0;
        uv[2 * i] = side == 0 ? along : side == 1 ? 1 - 0.2 * (i % 2) : side == 2 ? 1 - along : 0.2 * (i % 2);
        uv[2 * i + 1] = side == 0 ? 0.2 * (i % 2) : side == 1 ? along : side == 2 ? 1 - 0.2 * (i % 2) : 1 - along;
    }
    pia_status status = pia_model_create(context, 2, (int[]){1, 1}, knots, (pia_index[]){2, 2}, 2, control, NULL, &model);
    if (status == PIA_OK) status = pia_model_trim_to_points(context, model, uv, 64, user, &out);
    if (status == PIA_OK && user == NULL) assert_int_equal(pia_model_trim_loop_count(out), 2);
    pia_model_destroy(out);
    pia_model_destroy(model);
    return status;
}

static void trimming_survives_every_failure(void **state)
{
    (void)state;
    pia_outline_options hull = {.struct_size = sizeof hull, .hull = 1};
    assert_survives_failures(trim, NULL);
    assert_survives_failures(trim, &hull);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(trimming_survives_every_failure)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
