/* Frozen control points of curves and surfaces: they keep their bits, and the others go to the minimum that is left, which dense
 * orthogonal reflections of the rows over the free columns find on their own. Grids, with weights and holes, and scattered points. */
#include <stdlib.h>

#include "check.h"
#include "dense_solve.h"

static const char *const methods[] = {"direct",  "lspia",     "lspia-opt", "mlspia",  "nmlspia", "alspia",
                                      "salspia", "chebyshev", "cg",        "cg-kron", "clspia",  "clspia-pcg"};
enum { METHODS = sizeof methods / sizeof *methods, COUNT = 18, MOST_ROWS = 400, MOST = 64, DIM = 2 };

typedef struct sample {
    double points[MOST_ROWS * DIM], parameters[MOST_ROWS * 2], weights[MOST_ROWS], row[MOST_ROWS * MOST], free_row[MOST_ROWS * MOST];
    double right[MOST_ROWS * DIM];
    pia_index rows, controls;
    pia_data data;
    pia_fit_options options;
} sample;

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static double basis(const double *knots, pia_index i, int degree, double t, pia_index last)
{
    if (degree == 0) return t == knots[last + 1] ? i == last : knots[i] <= t && t < knots[i + 1];
    double left = knots[i + degree] - knots[i], right = knots[i + degree + 1] - knots[i + 1], sum = 0;
    if (left > 0) sum += (t - knots[i]) / left * basis(knots, i, degree - 1, t, last);
    if (right > 0) sum += (knots[i + degree + 1] - t) / right * basis(knots, i + 1, degree - 1, t, last);
    return sum;
}

static void parameters_of(const sample *s, pia_index row, double *uv)
{
    int scattered = s->data.kind == PIA_SCATTERED;
    uv[0] = scattered ? s->parameters[2 * row] : s->data.kind == PIA_GRID ? s->parameters[row / COUNT] : s->parameters[row];
    uv[1] = scattered ? s->parameters[2 * row + 1] : s->data.kind == PIA_GRID ? s->parameters[COUNT + row % COUNT] : 0;
}

static void make_points(sample *s)
{
    uint64_t seed = 77;
    for (pia_index i = 0; i < 2 * MOST_ROWS; i++)
        s->parameters[i] = s->data.kind == PIA_SCATTERED ? random_number(&seed)
                           : s->data.kind == PIA_GRID    ? (double)(i % COUNT) / (COUNT - 1)
                                                         : (double)i / (MOST_ROWS - 1);
    for (pia_index i = 0; i < s->rows; i++) {
        double uv[2];
        parameters_of(s, i, uv);
        for (int d = 0; d < DIM; d++)
            s->points[i * DIM + d] = 20 + cos(5 * uv[0] + 1.6 * d) + 0.4 * sin(4 * uv[1] + d) + 0.05 * random_number(&seed);
        s->weights[i] = 0.5 + random_number(&seed);
    }
}

/* Rows of the collocation matrix by the recursion of Cox and de Boor, times the roots of the weights. */
static void make_rows(sample *s, const int *degree, const pia_index *control)
{
    static double knots[2][2 * MOST];
    for (int d = 0; d < (s->data.kind == PIA_CURVE ? 1 : 2); d++) {
        for (pia_index k = 0; k <= control[d] + degree[d]; k++)
            knots[d][k] = fmin(fmax((double)(k - degree[d]) / (double)(control[d] - degree[d]), 0), 1);
        s->options.knots[d] = knots[d];
        s->options.knot_count[d] = control[d] + degree[d] + 1;
        s->options.degree[d] = degree[d];
    }
    for (pia_index row = 0; row < s->rows; row++) {
        double uv[2], root = s->data.weights != NULL ? sqrt(s->weights[row]) : 1;
        parameters_of(s, row, uv);
        for (pia_index c = 0; c < s->controls; c++) {
            double across = s->data.kind == PIA_CURVE ? 1 : basis(knots[1], c % control[1], degree[1], uv[1], control[1] - 1);
            s->row[row * s->controls + c] = root * basis(knots[0], c / control[1], degree[0], uv[0], control[0] - 1) * across;
        }
    }
}

static void make(sample *s, pia_kind kind, int degree, int weighted)
{
    const int degrees[] = {degree, 3};
    const pia_index control[] = {kind == PIA_CURVE ? 42 : 7, kind == PIA_CURVE ? 1 : 6};
    memset(s, 0, sizeof *s);
    pia_data_init(&s->data);
    pia_fit_options_init(&s->options);
    s->data.kind = kind;
    s->rows = kind == PIA_GRID ? COUNT * COUNT : MOST_ROWS;
    s->controls = control[0] * control[1];
    s->data.points = s->points;
    s->data.parameters = s->parameters;
    s->data.count[0] = kind == PIA_GRID ? COUNT : MOST_ROWS;
    s->data.count[1] = kind == PIA_GRID ? COUNT : 1;
    s->data.dim = DIM;
    make_points(s);
    if (weighted) s->data.weights = s->weights;
    make_rows(s, degrees, control);
    s->options.max_iterations = 100000;
    s->options.stop_gradient = 1e-15;
}

/* Of the control points x those that are not frozen := the minimum that the others leave. */
static void minimise(sample *s, const unsigned char *frozen, double *x)
{
    double solution[MOST * DIM];
    pia_index column[MOST], n = 0, m = 0;
    for (pia_index c = 0; c < s->controls; c++)
        if (!frozen[c]) column[n++] = c;
    for (pia_index row = 0; row < s->rows; row++) {
        const double *entry = s->row + row * s->controls, *q = s->points + row * DIM;
        double root = s->data.weights != NULL ? sqrt(s->weights[row]) : 1;
        if (!isfinite(q[0])) continue;
        for (pia_index c = 0; c < n; c++) s->free_row[m * n + c] = entry[column[c]];
        for (int d = 0; d < DIM; d++) {
            s->right[m * DIM + d] = root * q[d];
            for (pia_index c = 0; c < s->controls; c++)
                if (frozen[c]) s->right[m * DIM + d] -= entry[c] * x[c * DIM + d];
        }
        m++;
    }
    dense_solve(s->free_row, s->right, m, n, DIM, solution);
    for (pia_index c = 0; c < n; c++) memcpy(x + column[c] * DIM, solution + c * DIM, DIM * sizeof *x);
}

static void control_points(pia_context *context, pia_fit *fit, double *x)
{
    pia_model *model = NULL;
    assert_ok(context, pia_fit_model(fit, &model));
    pia_model_control(model, x, NULL);
    pia_model_destroy(model);
}

/* Runs the fit; what it was before tells where frozen control points stay. */
static void check_run(pia_context *context, sample *s, pia_fit *fit, const unsigned char *frozen, const char *method)
{
    double before[MOST * DIM], after[MOST * DIM], expected[MOST * DIM];
    control_points(context, fit, before);
    assert_ok(context, pia_fit_run(fit, NULL));
    control_points(context, fit, after);
    memcpy(expected, before, sizeof expected);
    minimise(s, frozen, expected);
    for (pia_index i = 0; i < s->controls * DIM; i++) {
        if (frozen[i / DIM])
            assert_memory_equal(&after[i], &before[i], sizeof *after);
        else if (!(fabs(after[i] - expected[i]) <= 4e-9))
            print_error("%s, control point %d\n", method, (int)(i / DIM));
        assert_near(after[i], expected[i], 4e-9);
    }
}

/* An edge of the net, a corner across from it, and one inside. */
static const pia_index chosen[] = {0, 1, 2, 3, 4, 5, 41, 22};
enum { CHOSEN = sizeof chosen / sizeof *chosen };

static void mark(unsigned char *frozen, int value)
{
    for (int i = 0; i < CHOSEN; i++) frozen[chosen[i]] = (unsigned char)value;
}

/* Frozen from the start; freed, frozen where the fit has come to, and a point moved meanwhile. */
static void check_methods(pia_context *context, sample *s)
{
    unsigned char frozen[MOST] = {0};
    for (int k = 0; k < METHODS; k++) {
        pia_fit *fit = NULL;
        const double moved[DIM] = {22, 19}, back[DIM] = {s->points[200 * DIM], s->points[200 * DIM + 1]};
        s->options.method = methods[k];
        s->options.freeze = chosen;
        s->options.freeze_count = CHOSEN;
        assert_ok(context, pia_fit_open(context, &s->data, &s->options, &fit));
        mark(frozen, 1);
        check_run(context, s, fit, frozen, methods[k]);
        assert_ok(context, pia_fit_freeze(fit, chosen, CHOSEN, 0));
        mark(frozen, 0);
        check_run(context, s, fit, frozen, methods[k]);
        assert_ok(context, pia_fit_freeze(fit, chosen, CHOSEN, 1));
        assert_ok(context, pia_fit_move_point(fit, 200, moved));
        memcpy(s->points + 200 * DIM, moved, sizeof moved);
        mark(frozen, 1);
        check_run(context, s, fit, frozen, methods[k]);
        memcpy(s->points + 200 * DIM, back, sizeof back);
        pia_fit_close(fit);
    }
}

static void on_curves(void **state)
{
    static sample s;
    for (int weighted = 0; weighted < 2; weighted++) {
        make(&s, PIA_CURVE, 2 + weighted, weighted);
        check_methods(*state, &s);
    }
}

static void on_grids(void **state)
{
    static sample s;
    make(&s, PIA_GRID, 3, 0);
    check_methods(*state, &s);
    make(&s, PIA_GRID, 2, 1);
    for (pia_index row = 60; row < 66; row++) s.points[row * DIM] = s.points[row * DIM + 1] = NAN;
    check_methods(*state, &s);
}

static void on_scattered_points(void **state)
{
    static sample s;
    for (int weighted = 0; weighted < 2; weighted++) {
        make(&s, PIA_SCATTERED, 2 + weighted, weighted);
        check_methods(*state, &s);
    }
}

/* Control points count from the middle of the data, which takes what is beyond the digits of their distance from it. */
static void an_edge_of_a_start_model_stays_where_the_model_has_it(void **state)
{
    static sample s;
    double start[MOST * DIM], first[MOST * DIM], last[MOST * DIM];
    const int degree[] = {3, 3};
    const pia_index control[] = {7, 6};
    uint64_t seed = 5;
    pia_model *model = NULL;
    pia_fit *fit = NULL;
    make(&s, PIA_GRID, 3, 0);
    for (pia_index i = 0; i < s.rows * DIM; i++) s.points[i] -= 20.3;
    for (pia_index i = 0; i < s.controls * DIM; i++) start[i] = 0.01 * random_number(&seed);
    assert_ok(*state, pia_model_create(*state, 2, degree, s.options.knots, control, DIM, start, NULL, &model));
    s.options.start = model;
    s.options.knots[0] = s.options.knots[1] = NULL;
    s.options.knot_count[0] = s.options.knot_count[1] = 0;
    s.options.freeze = chosen;
    s.options.freeze_count = CHOSEN;
    s.options.method = "direct";
    assert_ok(*state, pia_fit_open(*state, &s.data, &s.options, &fit));
    pia_model_destroy(model);
    control_points(*state, fit, first);
    assert_ok(*state, pia_fit_run(fit, NULL));
    control_points(*state, fit, last);
    for (int k = 0; k < CHOSEN; k++)
        for (pia_index i = chosen[k] * DIM; i < (chosen[k] + 1) * DIM; i++) {
            assert_memory_equal(&last[i], &first[i], sizeof *last);
            assert_near(last[i], start[i], 0x1p-52);
        }
    pia_fit_close(fit);
}

int main(void)
{
    pia_context *context = NULL;
    if (pia_context_create(NULL, &context) != PIA_OK) return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(on_curves, context),
        cmocka_unit_test_prestate(on_grids, context),
        cmocka_unit_test_prestate(on_scattered_points, context),
        cmocka_unit_test_prestate(an_edge_of_a_start_model_stays_where_the_model_has_it, context),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    pia_context_destroy(context);
    return failed;
}
