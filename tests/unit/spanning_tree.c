/* Neighbours and the spanning tree against all pairs. */
#include "context_fixture.h"

#include "kdtree.h"
#include "spanning_tree.h"

#include <stdlib.h>

enum { COUNT = 400 };

static double random_share(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Some points lie on a lattice, so that many distances are equal, and some repeat. */
static void make_points(double *points, int dim)
{
    uint64_t seed = 11;
    for (int i = 0; i < COUNT; i++)
        for (int d = 0; d < dim; d++) points[i * dim + d] = i % 3 ? random_share(&seed) : floor(8 * random_share(&seed)) / 8;
}

static double square_between(const double *points, int dim, int i, int j)
{
    double square = 0;
    for (int d = 0; d < dim; d++) square += (points[i * dim + d] - points[j * dim + d]) * (points[i * dim + d] - points[j * dim + d]);
    return square;
}

static void neighbours_are_the_nearest_of_all(void **state)
{
    static double points[4 * COUNT];
    static pia_index group[COUNT], all_group[COUNT];
    for (int dim = 1; dim <= 4; dim++) {
        pia_kdtree tree;
        make_points(points, dim);
        assert_ok(*state, pia_kdtree_open(*state, points, COUNT, dim, &tree));
        for (int i = 0; i < COUNT; i++) group[i] = i % 5;
        for (int i = 0; i < COUNT; i++) all_group[i] = -1;
        for (int i = 0; i < COUNT; i++) {
            pia_kdtree_filter filter = {.group = group, .all_group = all_group, .own = i % 5};
            double square = INFINITY, best = INFINITY;
            pia_index row = pia_kdtree_nearest(&tree, points + i * dim, &filter, &square), expected = -1;
            for (int j = 0; j < COUNT; j++) {
                double other = square_between(points, dim, i, j);
                if (group[j] == i % 5 || !(other < best)) continue;
                best = other;
                expected = j;
            }
            assert_int_equal(row, expected);
            assert_near(square, best, 0);
        }
        double none = 0;
        assert_int_equal(
            pia_kdtree_nearest(&tree, points, &(pia_kdtree_filter){.group = group, .all_group = all_group, .own = 0}, &none), -1);
        pia_kdtree_close(*state, &tree);
    }
}

/* Prim's tree, grown from row 0 over all pairs. */
static double prim(const double *points, int dim)
{
    double nearest[COUNT], total = 0;
    int in[COUNT] = {1};
    for (int i = 0; i < COUNT; i++) nearest[i] = square_between(points, dim, 0, i);
    for (int k = 1; k < COUNT; k++) {
        int next = -1;
        for (int i = 0; i < COUNT; i++)
            if (!in[i] && (next < 0 || nearest[i] < nearest[next])) next = i;
        in[next] = 1;
        total += sqrt(nearest[next]);
        for (int i = 0; i < COUNT; i++) nearest[i] = fmin(nearest[i], square_between(points, dim, next, i));
    }
    return total;
}

static void the_tree_is_as_short_as_prims(void **state)
{
    static double points[4 * COUNT];
    for (int dim = 1; dim <= 4; dim++) {
        pia_tree_edge *edges;
        int group[COUNT];
        double total = 0;
        make_points(points, dim);
        assert_ok(*state, pia_spanning_tree(*state, points, COUNT, dim, &edges));
        for (int i = 0; i < COUNT; i++) group[i] = i;
        for (int e = 0; e < COUNT - 1; e++) {
            int a = group[edges[e].row[0]], b = group[edges[e].row[1]];
            assert_true(a != b); /* no circle, so all hang together */
            for (int i = 0; i < COUNT; i++)
                if (group[i] == b) group[i] = a;
            assert_near(edges[e].length, sqrt(square_between(points, dim, (int)edges[e].row[0], (int)edges[e].row[1])), 0);
            assert_true(e == 0 || edges[e].length >= edges[e - 1].length);
            total += edges[e].length;
        }
        assert_near(total, prim(points, dim), 1e-12 * total);
        free(edges);
    }
}

static void one_point_and_equal_points_make_trees(void **state)
{
    static const double same[8] = {3, 3, 3, 3, 3, 3, 3, 3};
    pia_tree_edge *edges;
    assert_ok(*state, pia_spanning_tree(*state, same, 1, 2, &edges));
    free(edges);
    assert_ok(*state, pia_spanning_tree(*state, same, 4, 2, &edges));
    for (int e = 0; e < 3; e++) assert_near(edges[e].length, 0, 0);
    free(edges);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours_are_the_nearest_of_all),
        cmocka_unit_test(the_tree_is_as_short_as_prims),
        cmocka_unit_test(one_point_and_equal_points_make_trees),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
