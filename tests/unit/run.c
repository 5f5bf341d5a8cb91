/* What a pass over the rows of a curve tells: sums, errors, bounding box, order. */
#include "run.h"
#include "box.h"
#include "problems.h"
#include "run_cubics.h"
#include "survey.h"

enum { MOST = 1100 };

typedef struct rows {
    double t[MOST], points[MOST * PIA_MAX_DIM], ones[MOST], origin[PIA_MAX_DIM];
    pia_run run;
} rows;

static void fill(rows *r, pia_index count, int degree, int dim)
{
    uint64_t seed = (uint64_t)(count + 100 * dim + degree);
    for (pia_index i = 0; i < count; i++) r->t[i] = 3 + 2 * ((double)i + problem_random(&seed)) / (double)count;
    for (pia_index i = 0; i < count * dim; i++) r->points[i] = 10 * problem_random(&seed) - 3;
    for (pia_index i = 0; i < count; i++) r->ones[i] = 1;
    for (int d = 0; d < dim; d++) r->origin[d] = d;
    r->run = (pia_run){degree, dim, r->origin, 4, 1, r->t, r->points, NULL, count};
}

static const pia_index counts[] = {1, 2, 3, 4, 5, 63, 64, 65, 130, 1100};
enum { COUNTS = sizeof counts / sizeof *counts };

static double chebyshev(int j, double x)
{
    return cos(j * acos(x));
}

static void moments_are_the_sums_of_their_definition(void **state)
{
    (void)state;
    static rows r;
    double sums[PIA_RUN_SUMS];
    for (int degree = 1; degree <= 5; degree++)
        for (int dim = 0; dim <= 4; dim++)
            for (int k = 0; k < COUNTS; k++) {
                fill(&r, counts[k], degree, dim);
                memset(sums, 0, sizeof sums);
                pia_run_moments(&r.run, NULL, sums);
                for (int c = 0; c < dim + 2; c++)
                    for (int j = 0; j <= degree; j++) {
                        double sum = 0;
                        for (pia_index i = 0; i < counts[k]; i++) {
                            double x = r.t[i] - 4, other = c == 0   ? 1
                                                           : c == 1 ? chebyshev(degree, x)
                                                                    : r.points[i * dim + c - 2] - (c - 2);
                            sum += chebyshev(j, x) * other;
                        }
                        assert_near(sums[c * (degree + 1) + j], sum, 1e-14 * 10 * (double)counts[k]);
                    }
            }
}

enum { WHOLE = 1040 /* rows in eights, more than a block */ };

/* What a pass with vectors of one width sums and sees of rows that may hold a strange one. */
typedef struct pass {
    double sum[PIA_CUBIC_SUMS][PIA_CUBIC_LANES];
    pia_survey seen;
} pass;

static void take(const rows *r, pia_run_cubics *cubics, pass *out)
{
    pia_scout scout;
    memset(out, 0, sizeof *out);
    pia_scout_open(r->t, r->points, r->run.dim, 0, WHOLE, &scout);
    cubics(&r->run, WHOLE, &scout, out->sum);
    assert_int_equal(scout.next, WHOLE);
    out->seen = pia_scout_close(&scout);
}

static void assert_same(const rows *r)
{
    pass four, eight;
    if (!pia_has_wide()) return;
    take(r, pia_run_cubics_by_four, &four);
    take(r, pia_run_cubics_by_eight, &eight);
    assert_memory_equal(four.sum, eight.sum, sizeof four.sum);
    assert_int_equal(four.seen.ordered, eight.seen.ordered);
    assert_int_equal(four.seen.finite, eight.seen.finite);
    if (four.seen.finite) assert_memory_equal(four.seen.low, eight.seen.low, sizeof(double) * (size_t)r->run.dim);
    if (four.seen.finite) assert_memory_equal(four.seen.high, eight.seen.high, sizeof(double) * (size_t)r->run.dim);
}

static void vectors_of_both_widths_sum_and_see_the_same(void **state)
{
    (void)state;
    static rows r;
    for (int dim = 1; dim <= 3; dim++) {
        fill(&r, WHOLE, 3, dim);
        assert_same(&r);
        r.points[dim] = 1e308; /* finite, but their sum is not */
        r.points[9 * dim] = 1.5e308;
        assert_same(&r);
    }
}

static void a_scout_sees_what_is_summed(void **state)
{
    (void)state;
    static rows r;
    for (int degree = 2; degree <= 3; degree++)
        for (int dim = 1; dim <= 3; dim++) {
            double sums[PIA_RUN_SUMS] = {0}, alone[PIA_RUN_SUMS] = {0};
            pia_scout scout, apart;
            fill(&r, MOST, degree, dim);
            pia_scout_open(r.t, r.points, dim, 0, MOST, &scout);
            pia_scout_open(r.t, r.points, dim, 0, MOST, &apart);
            pia_run_moments(&r.run, &scout, sums);
            pia_run_moments(&r.run, NULL, alone);
            pia_scout_reach(&apart, MOST);
            pia_survey a = pia_scout_close(&scout), b = pia_scout_close(&apart);
            assert_memory_equal(sums, alone, sizeof sums);
            assert_int_equal(scout.next, MOST);
            assert_true(a.finite && a.ordered);
            assert_memory_equal(a.low, b.low, sizeof(double) * (size_t)dim);
            assert_memory_equal(a.high, b.high, sizeof(double) * (size_t)dim);
        }
}

static void a_scout_notices_one_strange_row_among_those_summed(void **state)
{
    (void)state;
    static rows r;
    const double strange[] = {NAN, INFINITY, -INFINITY};
    fill(&r, MOST, 3, 3);
    for (pia_index at = 0; at < 3 * MOST; at += 7)
        for (int k = 0; k < 3; k++) {
            double sums[PIA_RUN_SUMS] = {0}, kept = r.points[at];
            pia_scout scout;
            r.points[at] = strange[k];
            pia_scout_open(r.t, r.points, 3, 0, MOST, &scout);
            pia_run_moments(&r.run, &scout, sums);
            assert_false(pia_scout_close(&scout).finite);
            r.points[at] = kept;
        }
    for (pia_index begin = 0; begin <= 8; begin += 8) /* also where the run is not the first one */
        for (pia_index at = begin > 0 ? begin : 1; at < MOST; at++)
            for (int nan = 0; nan < 2; nan++) {
                double sums[PIA_RUN_SUMS] = {0}, kept = r.t[at];
                pia_run run = r.run;
                pia_scout scout;
                run.t += begin;
                run.points += 3 * begin;
                run.count -= begin;
                r.t[at] = nan ? NAN : r.t[at - 1] - 1e-9;
                pia_scout_open(r.t, r.points, 3, begin, MOST, &scout);
                pia_run_moments(&run, &scout, sums);
                assert_false(pia_scout_close(&scout).ordered);
                r.t[at] = kept;
            }
}

static void errors_are_those_of_the_polynomial(void **state)
{
    (void)state;
    static rows r;
    double coefficient[6 * 4], out[MOST * 4];
    for (int degree = 2; degree <= 4; degree++)
        for (int dim = 1; dim <= 4; dim++)
            for (int k = 0; k < COUNTS; k++) {
                fill(&r, counts[k], degree, dim);
                for (int c = 0; c < (degree + 1) * dim; c++) coefficient[c] = 1.0 / (1 + c);
                double sum = 0, worst = -1;
                pia_index at = -1;
                for (pia_index i = 0; i < counts[k]; i++) {
                    double square = 0;
                    for (int d = 0; d < dim; d++) {
                        double value = r.points[i * dim + d] - d;
                        for (int j = 0; j <= degree; j++) value -= coefficient[j * dim + d] * chebyshev(j, r.t[i] - 4);
                        square += value * value;
                    }
                    sum += square;
                    at = square > worst ? i : at;
                    worst = fmax(worst, square);
                }
                for (int variant = 0; variant < 3; variant++) { /* in registers, by blocks with weights, with the differences */
                    pia_run_errors e = {0, 0, -1, -1};
                    r.run.weights = variant == 1 ? r.ones : NULL;
                    pia_run_residual(&r.run, coefficient, 7, variant == 2 ? out : NULL, &e);
                    assert_near(e.sum_squares, sum, 1e-13 * sum);
                    assert_near(e.weighted, sum, 1e-13 * sum);
                    assert_near(e.worst, worst, 1e-13 * worst);
                    assert_int_equal(e.index, 7 + at);
                }
            }
}

static void a_box_does_not_depend_on_how_rows_are_cut(void **state)
{
    (void)state;
    static rows r;
    double low[PIA_MAX_DIM], high[PIA_MAX_DIM];
    for (int dim = 1; dim <= PIA_MAX_DIM; dim++)
        for (pia_index cut = 1; cut < 12; cut++) {
            pia_box box;
            fill(&r, 61, 3, dim);
            pia_box_open(dim, &box);
            for (pia_index i = 0; i < 61; i += cut) pia_box_add(&box, r.points + i * dim, i + cut < 61 ? cut : 61 - i);
            assert_true(pia_box_close(&box, low, high));
            for (int d = 0; d < dim; d++) {
                double least = INFINITY, most = -INFINITY;
                for (int i = 0; i < 61; i++) {
                    least = fmin(least, r.points[i * dim + d]);
                    most = fmax(most, r.points[i * dim + d]);
                }
                assert_near(low[d], least, 0);
                assert_near(high[d], most, 0);
            }
        }
}

static void one_number_that_is_none_is_noticed_wherever_it_is(void **state)
{
    (void)state;
    static rows r;
    const double strange[] = {NAN, INFINITY, -INFINITY};
    double low[PIA_MAX_DIM], high[PIA_MAX_DIM];
    for (int dim = 1; dim <= 5; dim++)
        for (pia_index at = 0; at < 11 * dim; at++)
            for (int k = 0; k < 3; k++) {
                pia_box box;
                fill(&r, 11, 3, dim);
                r.points[at] = strange[k];
                pia_box_open(dim, &box);
                pia_box_add(&box, r.points, 11);
                assert_false(pia_box_close(&box, low, high));
            }
}

static void a_scout_notices_one_parameter_out_of_order(void **state)
{
    (void)state;
    static rows r;
    fill(&r, MOST, 3, 2);
    for (pia_index at = 1; at < MOST; at++)
        for (int nan = 0; nan < 2; nan++) {
            pia_scout first, second;
            double kept = r.t[at];
            r.t[at] = nan ? NAN : r.t[at - 1] - 1e-9;
            pia_scout_open(r.t, r.points, 2, 0, 600, &first);
            pia_scout_open(r.t, r.points, 2, 600, MOST, &second);
            for (pia_index row = 10; row < 600; row += 10) pia_scout_reach(&first, row);
            pia_scout_reach(&first, 600);
            pia_scout_reach(&second, MOST);
            pia_survey a = pia_scout_close(&first), b = pia_scout_close(&second), both = pia_survey_join(&a, &b, 2);
            assert_false(both.ordered);
            assert_true(both.finite);
            assert_int_equal(a.ordered, at >= 600);
            r.t[at] = kept;
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments_are_the_sums_of_their_definition),
        cmocka_unit_test(vectors_of_both_widths_sum_and_see_the_same),
        cmocka_unit_test(a_scout_sees_what_is_summed),
        cmocka_unit_test(a_scout_notices_one_strange_row_among_those_summed),
        cmocka_unit_test(errors_are_those_of_the_polynomial),
        cmocka_unit_test(a_box_does_not_depend_on_how_rows_are_cut),
        cmocka_unit_test(one_number_that_is_none_is_noticed_wherever_it_is),
        cmocka_unit_test(a_scout_notices_one_parameter_out_of_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
