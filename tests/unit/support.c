#include "support.h"
#include "basis.h"
#include "check.h"
#include "knots.h"

#include <stdlib.h>

enum { ROOM = 64 };

static double random_number(void)
{
    return rand() / (double)RAND_MAX;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Random knots with some double ones, open on [0, 1] or cyclic with period 1. */
static void random_knots(int degree, int closed, int control, double *knots)
{
    double inside[ROOM];
    int free_knots = closed ? control : control - degree - 1;
    for (int i = 0; i < free_knots; i++)
        inside[i] = i % 2 == 1 && degree > 1 && rand() % 4 == 0 ? inside[i - 1] : 0.001 + 0.998 * random_number();
    if (closed) inside[0] = 0;
    qsort(inside, (size_t)free_knots, sizeof *inside, compare);
    for (int i = 0; closed && i < control + 2 * degree + 1; i++) {
        int from = i - degree + 2 * control;
        knots[i] = inside[from % control] + from / control - 2;
    }
    for (int i = 0; !closed && i <= degree; i++) knots[i] = 0, knots[control + i] = 1;
    for (int i = 0; !closed && i < free_knots; i++) knots[degree + 1 + i] = inside[i];
}

/* positive[row * control + column] says whether the basis function is positive at the parameter; equal parameters are one row. */
static int positive_rows(const pia_support_line *line, unsigned char *positive)
{
    int rows = 0;
    pia_index full = line->control + (line->closed ? line->degree : 0);
    memset(positive, 0, ROOM * ROOM);
    for (pia_index i = 0; i < line->count; i++) {
        if ((line->weights != NULL && line->weights[i] == 0) || (i > 0 && line->parameters[i] == line->parameters[i - 1])) continue;
        double value[PIA_MAX_DEGREE + 1];
        pia_index span = pia_knots_span(line->knots, line->degree, full, line->parameters[i]);
        pia_basis_values(line->knots, line->degree, span, line->parameters[i], value);
        for (int k = 0; k <= line->degree; k++)
            if (value[k] > 0) positive[rows * line->control + (span - line->degree + k) % line->control] = 1;
        rows++;
    }
    return rows;
}

/* Largest bipartite matching by augmenting paths. */
static int augment(const unsigned char *positive, int rows, int columns, int column, int *owner, unsigned char *seen)
{
    for (int r = 0; r < rows; r++) {
        if (!positive[r * columns + column] || seen[r]) continue;
        seen[r] = 1;
        if (owner[r] < 0 || augment(positive, rows, columns, owner[r], owner, seen)) {
            owner[r] = column;
            return 1;
        }
    }
    return 0;
}

static int largest_matching(const unsigned char *positive, int rows, int columns)
{
    int owner[ROOM], size = 0;
    for (int r = 0; r < rows; r++) owner[r] = -1;
    for (int c = 0; c < columns; c++) {
        unsigned char seen[ROOM] = {0};
        size += augment(positive, rows, columns, c, owner, seen);
    }
    return size;
}

static void as_many_are_unsupported_as_a_largest_matching_leaves(int closed)
{
    double knots[ROOM], t[ROOM], weights[ROOM];
    static unsigned char positive[ROOM * ROOM];
    unsigned char held[ROOM];
    int gaps = 0;
    srand(11);
    for (int run = 0; run < 3000; run++) {
        int degree = 1 + rand() % 4, control = 2 * degree + 1 + rand() % 12, count = 1 + rand() % 30;
        random_knots(degree, closed, control, knots);
        double gap = random_number();
        for (int i = 0; i < count; i++) {
            t[i] = i > 0 && rand() % 4 == 0 ? t[i - 1] : random_number();
            if (rand() % 10 == 0) t[i] = knots[degree + rand() % (control - degree)];
            if (fabs(t[i] - gap) < 0.1) t[i] = gap - 0.1;
            t[i] = fmin(fmax(t[i], 0), closed ? 0.999 : 1);
            weights[i] = rand() % 6 > 0;
        }
        qsort(t, (size_t)count, sizeof *t, compare);
        for (int i = 1; i < count; i++)
            if (t[i] == t[i - 1]) weights[i] = weights[i - 1];
        pia_support_line line = {degree, closed, knots, control, t, run % 2 ? weights : NULL, count};
        pia_index unheld = pia_support_find(&line, held), zeroes = 0;
        for (int c = 0; c < control; c++) zeroes += held[c] == 0;
        int rows = positive_rows(&line, positive);
        assert_int_equal(unheld, zeroes);
        assert_int_equal(unheld, control - largest_matching(positive, rows, control));
        gaps += unheld > 0 && unheld < control;
    }
    assert_true(gaps > 100);
}

static void t_peer_31_t_peer_47_open_gaps_are_found_as_a_largest_matching_finds_them(void **state)
{
    (void)state;
    as_many_are_unsupported_as_a_largest_matching_leaves(0);
}

static void t_peer_31_t_peer_47_closed_gaps_are_found_as_a_largest_matching_finds_them(void **state)
{
    (void)state;
    as_many_are_unsupported_as_a_largest_matching_leaves(1);
}

static void data_that_interpolate_hold_every_control_point(void **state)
{
    (void)state;
    const double knots[] = {0, 0, 0, 0, 0.5, 1, 1, 1, 1}, t[] = {0, 0.2, 0.5, 0.8, 1};
    unsigned char held[5];
    pia_support_line line = {3, 0, knots, 5, t, NULL, 5};
    assert_int_equal(pia_support_find(&line, held), 0);
    line.count = 4;
    assert_int_equal(pia_support_find(&line, held), 1);
    assert_int_equal(held[4], 0);
    const double nothing[] = {0, 0, 0, 0, 0};
    line = (pia_support_line){3, 0, knots, 5, t, nothing, 5};
    assert_int_equal(pia_support_find(&line, held), 5);
}

static void scattered_pairs_are_counted_in_each_support(void **state)
{
    (void)state;
    enum { U = 9, V = 7, COUNT = 200 };
    const int degree[] = {3, 2};
    const pia_index control[] = {U, V};
    double ku[U + 4], kv[V + 3], pairs[2 * COUNT], weights[COUNT];
    const double *const knots[] = {ku, kv};
    pia_index data[U * V];
    srand(5);
    random_knots(3, 0, U, ku);
    random_knots(2, 0, V, kv);
    for (int i = 0; i < COUNT; i++) {
        pairs[2 * i] = random_number() * random_number();
        pairs[2 * i + 1] = random_number() * 0.4;
        weights[i] = rand() % 3 > 0;
    }
    pia_index zeroes = pia_support_count(degree, knots, control, pairs, weights, COUNT, data), expected_zeroes = 0;
    for (int i = 0; i < U; i++)
        for (int j = 0; j < V; j++) {
            int expected = 0;
            for (int k = 0; k < COUNT; k++)
                expected += weights[k] > 0 && pairs[2 * k] >= ku[i] && pairs[2 * k] < ku[i + 4] && pairs[2 * k + 1] >= kv[j] &&
                            pairs[2 * k + 1] < kv[j + 3];
            assert_int_equal(data[i * V + j], expected);
            expected_zeroes += expected == 0;
        }
    assert_int_equal(zeroes, expected_zeroes);
    assert_true(zeroes > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(t_peer_31_t_peer_47_open_gaps_are_found_as_a_largest_matching_finds_them),
        cmocka_unit_test(t_peer_31_t_peer_47_closed_gaps_are_found_as_a_largest_matching_finds_them),
        cmocka_unit_test(data_that_interpolate_hold_every_control_point),
        cmocka_unit_test(scattered_pairs_are_counted_in_each_support),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
