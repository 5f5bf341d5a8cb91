/* Orders of points that have none, against a walk that looks at all pairs and against the order in which they were made. */
#include "context_fixture.h"

#include "order.h"

#include <stdlib.h>

enum { COUNT = 400, STRIDE = 149 }; /* STRIDE has no factor in common with COUNT */

static pia_order_report fresh(void)
{
    return (pia_order_report){.struct_size = sizeof(pia_order_report), .break_row = -1};
}

/* Points of a spiral in `dim` components, row i being the (i STRIDE mod COUNT)-th along it. */
static void make_spiral(double *points, int dim)
{
    for (int i = 0; i < COUNT; i++) {
        double t = 6.0 * (i * STRIDE % COUNT) / COUNT;
        for (int d = 0; d < dim; d++) points[i * dim + d] = d == 0 ? (1 + t) * cos(t) : d == 1 ? (1 + t) * sin(t) : d * t;
    }
}

/* Whether the order goes along the spiral, from either end. */
static void assert_along(const pia_index *order)
{
    int first = (int)(order[0] * STRIDE % COUNT), way = first == 0 ? 1 : -1;
    assert_int_equal(first, way > 0 ? 0 : COUNT - 1);
    for (int i = 0; i < COUNT; i++) assert_int_equal(order[i] * STRIDE % COUNT, first + way * i);
}

static void a_shuffled_spiral_is_put_in_order_again(void **state)
{
    static double points[5 * COUNT];
    static pia_index order[COUNT];
    for (int dim = 2; dim <= 5; dim++)
        for (int way = 0; way < 2; way++) {
            pia_order_report report = {.struct_size = sizeof report};
            make_spiral(points, dim);
            assert_ok(*state, pia_points_order(*state, points, COUNT, dim, way ? "tree" : "nearest", order, &report));
            assert_along(order);
            assert_int_equal(report.closed, 0);
            assert_int_equal(report.break_count, 0);
            assert_int_equal(report.break_row, -1);
            assert_near(report.length, report.tree_length, 1e-12 * report.tree_length); /* no order is shorter than the tree */
        }
}

static void a_shuffled_circle_is_closed(void **state)
{
    double points[2 * COUNT];
    pia_index order[COUNT];
    for (int i = 0; i < COUNT; i++) {
        double turn = 2 * acos(-1) * (i * STRIDE % COUNT) / COUNT;
        points[2 * i] = cos(turn);
        points[2 * i + 1] = sin(turn);
    }
    for (int way = 0; way < 2; way++) {
        pia_order_report report = {.struct_size = sizeof report};
        assert_ok(*state, pia_points_order(*state, points, COUNT, 2, way ? "tree" : "nearest", order, &report));
        assert_int_equal(report.closed, 1);
        for (int i = 1; i < COUNT; i++) {
            int step = abs((int)(order[i] * STRIDE % COUNT - order[i - 1] * STRIDE % COUNT));
            assert_true(step == 1 || step == COUNT - 1);
        }
    }
}

static double square_between(const double *points, int dim, pia_index a, pia_index b)
{
    double sum = 0;
    for (int d = 0; d < dim; d++) sum += (points[a * dim + d] - points[b * dim + d]) * (points[a * dim + d] - points[b * dim + d]);
    return sum;
}

static void the_nearest_that_is_left_is_always_next(void **state)
{
    static double points[3 * COUNT];
    static pia_index order[COUNT];
    char gone[COUNT] = {0};
    unsigned seed = 7;
    for (int i = 0; i < 3 * COUNT; i++) points[i] = (double)((seed = seed * 1664525u + 1013904223u) >> 8) / (1 << 24);
    pia_order_report report = fresh();
    assert_ok(*state, pia_order_nearest(*state, points, COUNT, 3, order, &report));
    for (int i = 0; i < COUNT; i++) {
        assert_false(gone[order[i]]);
        gone[order[i]] = 1;
        for (int j = 0; i > 0 && j < COUNT; j++)
            if (!gone[j]) assert_true(square_between(points, 3, order[i - 1], order[i]) <= square_between(points, 3, order[i - 1], j));
    }
}

static void a_gap_is_a_break_of_the_walk(void **state)
{
    static const double points[] = {0, 1, 2, 3, 50, 51, 52, 53};
    static const pia_index along[] = {7, 6, 5, 4, 3, 2, 1, 0}; /* from the row farthest from the first one */
    pia_index order[8];
    pia_order_report report = fresh();
    assert_ok(*state, pia_order_nearest(*state, points, 8, 1, order, &report));
    assert_memory_equal(order, along, sizeof along);
    assert_int_equal(report.break_count, 1);
    assert_int_equal(report.break_row, 4);
    assert_near(report.break_length, 47, 0);
}

/* A line of 41 points with a twig of 15 that leaves it at its 20th. */
static void a_branch_is_a_break_of_the_tree(void **state)
{
    enum { LINE = 41, TWIG = 15 };
    double points[2 * (LINE + TWIG)];
    pia_index order[LINE + TWIG];
    for (int i = 0; i < LINE; i++) points[2 * i] = i, points[2 * i + 1] = 0;
    for (int i = 0; i < TWIG; i++) points[2 * (LINE + i)] = 20, points[2 * (LINE + i) + 1] = i + 1;
    pia_order_report report = fresh();
    assert_ok(*state, pia_order_tree(*state, points, LINE + TWIG, 2, order, &report));
    for (int i = 0; i <= 20; i++) assert_int_equal(order[i], i);
    for (int i = 0; i < TWIG; i++) assert_int_equal(order[21 + i], LINE + i); /* beside the row where they leave, from near to far */
    for (int i = 21; i < LINE; i++) assert_int_equal(order[TWIG + i], i);
    assert_int_equal(report.break_count, 1);
    assert_int_equal(report.break_row, 20);
    assert_near(report.break_length, TWIG, 1e-12);
}

static void one_point_and_equal_points_have_an_order(void **state)
{
    static const double same[] = {3, 3, 3, 3, 3, 3, 3, 3};
    for (int count = 1; count <= 4; count += 3)
        for (int way = 0; way < 2; way++) {
            pia_index order[4] = {-1, -1, -1, -1};
            int seen[4] = {0};
            assert_ok(*state, pia_points_order(*state, same, count, 2, way ? "tree" : "nearest", order, NULL));
            for (int i = 0; i < count; i++) {
                assert_in_range(order[i], 0, count - 1);
                assert_int_equal(seen[order[i]]++, 0);
            }
        }
}

static void bad_points_and_words_are_named(void **state)
{
    double points[] = {0, 1, NAN, 2};
    pia_index order[4];
    assert_int_equal(pia_points_order(*state, points, 2, 2, "tree", order, NULL), PIA_E_DATA);
    assert_non_null(strstr(pia_message(*state), "component 0 of row 1"));
    points[2] = 5;
    assert_int_equal(pia_points_order(*state, points, 2, 2, "random", order, NULL), PIA_E_ARGUMENT);
    assert_non_null(strstr(pia_message(*state), "there are given, nearest, tree"));
    points[2] = 1e300;
    assert_int_equal(pia_points_order(*state, points, 2, 2, "tree", order, NULL), PIA_E_DATA);
    assert_non_null(strstr(pia_message(*state), "too far apart"));
    assert_int_equal(pia_points_order(*state, points, 0, 2, "tree", order, NULL), PIA_E_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shuffled_spiral_is_put_in_order_again), cmocka_unit_test(a_shuffled_circle_is_closed),
        cmocka_unit_test(the_nearest_that_is_left_is_always_next), cmocka_unit_test(a_gap_is_a_break_of_the_walk),
        cmocka_unit_test(a_branch_is_a_break_of_the_tree),         cmocka_unit_test(one_point_and_equal_points_have_an_order),
        cmocka_unit_test(bad_points_and_words_are_named),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
