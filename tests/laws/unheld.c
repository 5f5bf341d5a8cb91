/* Curves with gaps as wide as Schoenberg and Whitney allow, and wider: least squares alone would put some control points anywhere, and
 * the fit holds them near the data. What that costs is held against the best that there is within three extents: SciPy 1.10,
 * optimize.lsq_linear by BVLS on the dense rows, with those bounds on the control points. */
#include <stdlib.h>

#include "check.h"

enum { MOST = 64, DEGREE = 7 };

typedef struct gappy {
    double points[MOST], parameters[MOST], knots[MOST + DEGREE + 1];
    pia_data data;
    pia_fit_options options;
} gappy;

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Rows of a noisy wave that came by chance, outside of two gaps. */
static void make(gappy *g, uint64_t seed, int degree, pia_index control, pia_index rows)
{
    double gap[2];
    for (int k = 0; k < 4; k++) random_number(&seed);
    for (int k = 0; k < 2; k++) gap[k] = random_number(&seed);
    for (pia_index i = 0; i < rows; i++) {
        double t;
        do t = random_number(&seed);
        while ((t > gap[0] && t < gap[0] + 0.2) || (t > gap[1] && t < gap[1] + 0.1));
        g->parameters[i] = i == 0 ? 0 : i == 1 ? 1 : t;
    }
    qsort(g->parameters, (size_t)rows, sizeof *g->parameters, compare);
    for (pia_index i = 0; i < rows; i++) g->points[i] = sin(7 * g->parameters[i]) + 0.01 * (random_number(&seed) - 0.5);
    for (pia_index i = 0; i < control + degree + 1; i++)
        g->knots[i] = fmin(fmax((double)(i - degree) / (double)(control - degree), 0), 1);
    pia_data_init(&g->data);
    pia_fit_options_init(&g->options);
    g->data.points = g->points;
    g->data.parameters = g->parameters;
    g->data.count[0] = rows;
    g->data.dim = 1;
    g->options.degree[0] = degree;
    g->options.knots[0] = g->knots;
    g->options.knot_count[0] = control + degree + 1;
}

/* Returns how far control points are from the middle of the data. */
static double fit(pia_context *context, gappy *g, const char *method, pia_report *report)
{
    double control[MOST], low = INFINITY, high = -INFINITY, farthest = 0;
    pia_model *model = NULL;
    g->options.method = method;
    report->struct_size = sizeof *report;
    assert_ok(context, pia_fit_data(context, &g->data, &g->options, &model, report));
    pia_model_control(model, control, NULL);
    pia_model_destroy(model);
    for (pia_index i = 0; i < g->data.count[0]; i++) {
        low = fmin(low, g->points[i]);
        high = fmax(high, g->points[i]);
    }
    for (pia_index i = 0; i < report->control_count; i++) farthest = fmax(farthest, fabs(control[i] - 0.5 * (low + high)));
    return farthest / (high - low);
}

static void holding_control_points_costs_little_of_the_fit(void **state)
{
    static const struct {
        uint64_t seed;
        int degree, control, rows;
        double best; /* RMS error */
    } cases[] = {{423, 5, 20, 23, 0.0010583571}, {376, 3, 14, 22, 0.0010575129},  {457, 4, 26, 28, 0.00056562304},
                 {623, 5, 18, 21, 0.0014988687}, {323, 5, 22, 25, 0.00099070546}, {729, 6, 25, 31, 0.00168309},
                 {378, 5, 18, 24, 0.0011252733}, {174, 6, 17, 18, 0.00094137292}, {440, 7, 26, 29, 0.0011226862},
                 {686, 3, 23, 28, 0.0015450203}, {160, 7, 18, 20, 0.0014836001}};
    static gappy g;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        pia_report direct, descent;
        make(&g, cases[k].seed, cases[k].degree, cases[k].control, cases[k].rows);
        assert_true(fit(*state, &g, "direct", &direct) <= 3.001);
        assert_true(direct.unsupported_count > 0);
        assert_true(direct.rms_error >= cases[k].best * (1 - 1e-6));
        assert_true(direct.rms_error <= cases[k].best * 1.1);
        g.options.max_iterations = 100000;
        fit(*state, &g, "cg", &descent);
        assert_near(descent.rms_error, direct.rms_error, 1e-6 * direct.rms_error);
    }
}

int main(void)
{
    pia_context *context = NULL;
    if (pia_context_create(NULL, &context) != PIA_OK) return 1;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(holding_control_points_costs_little_of_the_fit, context)};
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    pia_context_destroy(context);
    return failed;
}
