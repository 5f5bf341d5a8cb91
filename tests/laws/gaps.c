/* Knots for a tolerance where points are missing: rows without weight, holes of a grid. The points that count are within the tolerance,
 * and the control points stay near the data, though nothing but bridging holds those in a gap. */
#include "context_fixture.h"

#include <stdlib.h>

enum { ROWS = 150, U = 14, V = 17 };

static const double NEAR = 5; /* extents from the middle of the data, whose own are within 1/2 */

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

/* Rows without weight: a part of them here and there, or a stretch. */
static void leave_out(double *weights, int rows, int stretch, uint64_t *seed)
{
    int from = (int)(random_number(seed) * rows);
    for (int i = 0; i < rows; i++) weights[i] = stretch ? i < from || i > from + rows / 4 : random_number(seed) > 0.4;
}

/* Data and model have 3 components, in a box around the origin of size about 2. */
static void stays_near(pia_context *context, const pia_data *data, const pia_fit_options *options, pia_index rows,
                       const double *weights)
{
    pia_fit *fit;
    pia_model *model;
    const double *parameters;
    const pia_index *row;
    pia_index count;
    pia_report report = {.struct_size = sizeof report};
    pia_model_info info = {.struct_size = sizeof info};
    static double residual[3 * (ROWS + U * V)];
    assert_ok(context, pia_fit_open(context, data, options, &fit));
    assert_ok(context, pia_fit_run(fit, &report));
    assert_ok(context, pia_fit_residuals(fit, residual));
    assert_ok(context, pia_fit_parameters(fit, &parameters, &count, &row));
    for (pia_index i = 0; i < rows && report.reached; i++) {
        const double *r = residual + 3 * i;
        if (weights[row != NULL ? row[i] : i] > 0)
            assert_true(sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) <= options->tolerance * (1 + 1e-9));
    }
    assert_ok(context, pia_fit_model(fit, &model));
    pia_model_get_info(model, &info);
    count = 3 * info.control[0] * info.control[1];
    double *control = malloc((size_t)count * sizeof *control);
    pia_model_control(model, control, NULL);
    for (pia_index i = 0; i < count; i++)
        if (!(fabs(control[i]) <= 2 * NEAR)) fail_msg("a control point is at %g", control[i]);
    free(control);
    pia_model_destroy(model);
    pia_fit_close(fit);
}

static void curves_bridge_rows_without_weight(void **state)
{
    double points[3 * ROWS], weights[ROWS];
    uint64_t seed = 3;
    for (int k = 0; k < 24; k++) {
        pia_data data;
        pia_fit_options options;
        pia_data_init(&data);
        pia_fit_options_init(&options);
        int closed = k % 2;
        for (int i = 0; i < ROWS; i++) {
            double a = 6.283185307179586 * i / (closed ? ROWS : ROWS - 1);
            for (int d = 0; d < 3; d++) points[3 * i + d] = cos(a + 2 * d) / (1 + d) + 0.02 * (random_number(&seed) - 0.5);
        }
        leave_out(weights, ROWS, k / 2 % 2, &seed);
        data.points = points;
        data.weights = weights;
        data.count[0] = ROWS;
        data.dim = 3;
        options.degree[0] = 2 + k % 3;
        options.closed[0] = closed;
        options.tolerance = 0.005;
        stays_near(*state, &data, &options, ROWS, weights);
    }
}

static void grids_bridge_holes_and_rows_without_weight(void **state)
{
    double points[3 * U * V], weights[U * V];
    uint64_t seed = 5;
    for (int k = 0; k < 16; k++) {
        pia_data data;
        pia_fit_options options;
        pia_data_init(&data);
        pia_fit_options_init(&options);
        leave_out(weights, U * V, k / 2 % 2, &seed);
        for (int i = 0; i < U * V; i++) {
            double u = (double)(i / V) / (U - 1) - 0.5, v = (double)(i % V) / (V - 1) - 0.5;
            points[3 * i] = 2 * u;
            points[3 * i + 1] = 2 * v;
            points[3 * i + 2] = k % 2 && weights[i] == 0 ? NAN : 0.4 * sin(5 * u) * cos(4 * v) + 0.05 * random_number(&seed);
        }
        data.kind = PIA_GRID;
        data.points = points;
        data.weights = k % 2 ? NULL : weights;
        data.count[0] = U;
        data.count[1] = V;
        data.dim = 3;
        options.tolerance = 0.01;
        stays_near(*state, &data, &options, U * V, weights);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_bridge_rows_without_weight),
        cmocka_unit_test(grids_bridge_holes_and_rows_without_weight),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
