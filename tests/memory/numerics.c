/* Parametrizations, placements, band solvers and statistics under every allocation failure. */
#include "band.h"
#include "deviation.h"
#include "failing.h"
#include "param.h"
#include "place.h"
#include "windows.h"

static const double points[] = {0, 0, 0, 1, 0, 0, 2, 1, 0, 0, 1, 1, 1, 1, 0, 2, 2, 0, 0, 2, 0, 1, 2, 1, 2, 2, 2};

static pia_status parametrize(pia_context *context, void *user)
{
    double t[9];
    (void)user;
    return pia_param_find("foley")->compute(context, points, 9, 3, 3, 0, t);
}

static pia_status parametrize_grid(pia_context *context, void *user)
{
    const pia_index count[] = {3, 3};
    const int degree[] = {2, 2}, closed[] = {0, 1};
    double u[3], v[3];
    (void)user;
    return pia_param_grid(context, pia_param_find("chord"), points, count, 3, degree, closed, u, v);
}

static pia_status place_repeated(pia_context *context, void *user)
{
    const double t[] = {0, 0.2, 0.2, 0.5, 0.5, 0.8, 1};
    const pia_place_problem problem = {2, 0, 4, t, 7};
    double knots[7];
    (void)user;
    return pia_place_find("lsq")->place(context, &problem, knots);
}

static const double rows[] = {1, 0, 0.3, 0.7, 0.6, 0.4};
static const pia_index firsts[] = {0, 0, 1};

static void give_rows(void *work, pia_index begin, pia_index end, pia_index *first, double *a)
{
    (void)work;
    memcpy(first, firsts + begin, (size_t)(end - begin) * sizeof *first);
    memcpy(a, rows + 2 * begin, (size_t)(end - begin) * 2 * sizeof *a);
}

static pia_status solve_bands(pia_context *context, void *user)
{
    double b[] = {1, 2, 3}, row[] = {1, 0.5}, right[] = {2}, x[3] = {0};
    pia_band_lu lu;
    pia_band_plu plu;
    pia_band_qr qr;
    (void)user;
    pia_status status = pia_band_lu_stream(context, give_rows, NULL, 3, 2, b, 1);
    if (status != PIA_OK || (status = pia_band_lu_factor(context, rows, firsts, 3, 2, &lu)) != PIA_OK) return status;
    pia_band_lu_clear(context, &lu);
    if ((status = pia_band_plu_factor(context, rows, 3, 0, 1, &plu)) != PIA_OK) return status;
    pia_band_plu_clear(context, &plu);
    if ((status = pia_band_qr_open(context, 3, 2, 1, &qr)) != PIA_OK) return status;
    pia_band_qr_add(&qr, 0, row, right);
    pia_band_qr_solve(&qr, 1e-12, x);
    pia_band_qr_close(context, &qr);
    return PIA_OK;
}

/* The parameters of a curve of degree 1 are its inside knots. */
enum { LONG = 8192 };

static pia_status interpolate_long_curve(pia_context *context, void *user)
{
    double *knots = user, *x = knots + LONG + 2, origin = 0;
    pia_collocation line;
    pia_targets targets = {knots + 1, &origin, 1};
    pia_step_errors errors;
    pia_op *op;
    int done;
    pia_status status = pia_collocation_open(context, 1, PIA_MAP_IDENTITY, 0, knots, LONG, knots + 1, LONG, PIA_WITHOUT_BEGINS, &line);
    if (status != PIA_OK) return status;
    status = pia_op_curve_open(context, &line, NULL, 1, &op);
    if (status == PIA_OK) {
        status = pia_windows_step(op, NULL, &targets, x, NULL, &errors, &done);
        pia_op_close(op);
    }
    pia_collocation_close(context, &line);
    return status;
}

static pia_status summarize(pia_context *context, void *user)
{
    double distances[] = {3, 1, 2};
    pia_deviation out;
    (void)user;
    return pia_deviation_summarize(context, distances, 3, &out);
}

static void parametrizations_survive_every_failure(void **state)
{
    (void)state;
    assert_survives_failures(parametrize, NULL);
    assert_survives_failures(parametrize_grid, NULL);
}

static void placements_survive_every_failure(void **state)
{
    (void)state;
    assert_survives_failures(place_repeated, NULL);
}

static void band_solvers_survive_every_failure(void **state)
{
    (void)state;
    assert_survives_failures(solve_bands, NULL);
}

static void long_curves_survive_every_failure(void **state)
{
    (void)state;
    double *knots = malloc((2 * LONG + 2) * sizeof *knots);
    assert_non_null(knots);
    for (int i = 0; i < LONG + 2; i++) knots[i] = i < 1 ? 0 : i > LONG ? LONG - 1 : i - 1;
    assert_survives_failures(interpolate_long_curve, knots);
    free(knots);
}

static void statistics_survive_every_failure(void **state)
{
    (void)state;
    assert_survives_failures(summarize, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parametrizations_survive_every_failure), cmocka_unit_test(placements_survive_every_failure),
        cmocka_unit_test(band_solvers_survive_every_failure),     cmocka_unit_test(long_curves_survive_every_failure),
        cmocka_unit_test(statistics_survive_every_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
