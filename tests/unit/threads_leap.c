/* Long curves of many control points are fitted at once, without a start: against the progressive service, which starts from the data
 * and factors the whole matrix. */
#include "../memory/failing.h"
#include "problems.h"

enum { CONTROL = 9000, EACH = 3, ROWS = EACH * CONTROL, DIM = 3, ROOM = DIM * (CONTROL + PIA_MAX_DEGREE) };

typedef struct curve {
    double points[DIM * ROWS], parameters[ROWS], weights[ROWS], knots[CONTROL + PIA_MAX_DEGREE + 1];
    pia_data data;
    pia_fit_options options;
} curve;

static double noise(pia_index i)
{
    return (double)(i * 7919 % 1013) / 1013 - 0.5;
}

/* Rows in the middles of equal shares of [0, 1]; knots evenly spread, or left to a closed curve. */
static curve *make(int degree, int dim, pia_index rows, int closed)
{
    curve *c = calloc(1, sizeof *c);
    assert_non_null(c);
    for (pia_index i = 0; i < CONTROL + degree + 1; i++) {
        double inner = (double)(i - degree) / (CONTROL - degree);
        c->knots[i] = inner < 0 ? 0 : inner > 1 ? 1 : inner;
    }
    for (pia_index i = 0; i < rows; i++) {
        double t = c->parameters[i] = ((double)i + 0.5) / (double)rows;
        c->weights[i] = 1.5 + noise(i);
        for (int d = 0; d < dim; d++) c->points[i * dim + d] = 5 + cos(6.283185307179586 * (7 + 5 * d) * t) + 0.01 * noise(i + d);
    }
    pia_data_init(&c->data);
    pia_fit_options_init(&c->options);
    c->data.points = c->points;
    c->data.parameters = c->parameters;
    c->data.count[0] = rows;
    c->data.dim = dim;
    c->options.method = "direct";
    c->options.degree[0] = degree;
    c->options.closed[0] = closed;
    c->options.control[0] = CONTROL;
    if (closed) return c;
    c->options.knots[0] = c->knots;
    c->options.knot_count[0] = CONTROL + degree + 1;
    return c;
}

static pia_context *with_threads(int threads)
{
    pia_context *context = NULL;
    pia_context_options options;
    pia_context_options_init(&options);
    options.threads = threads;
    assert_ok(NULL, pia_context_create(&options, &context));
    return context;
}

/* Control points [at most ROOM], and how many numbers that are. */
static pia_index read(pia_model *model, double *control)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    assert_true(info.control[0] * info.dim <= ROOM);
    pia_model_control(model, control, NULL);
    pia_model_destroy(model);
    return info.control[0] * info.dim;
}

static pia_index fit_at_once(pia_context *context, const curve *c, double *control, pia_report *report)
{
    pia_model *model = NULL;
    assert_ok(context, pia_fit_data(context, &c->data, &c->options, &model, report));
    return read(model, control);
}

static pia_index fit_by_steps(pia_context *context, const curve *c, double *control, pia_report *report)
{
    pia_fit *fit = NULL;
    pia_model *model = NULL;
    assert_ok(context, pia_fit_open(context, &c->data, &c->options, &fit));
    assert_ok(context, pia_fit_step(fit, INT64_MAX, report));
    assert_ok(context, pia_fit_model(fit, &model));
    pia_fit_close(fit);
    return read(model, control);
}

static double at_once[ROOM], by_steps[ROOM];

static void check_same(pia_context *context, curve *c, double tolerance)
{
    pia_report once = {.struct_size = sizeof once}, steps = {.struct_size = sizeof steps};
    pia_index count = fit_at_once(context, c, at_once, &once);
    assert_int_equal(fit_by_steps(context, c, by_steps, &steps), count);
    for (pia_index i = 0; i < count; i++) assert_near(at_once[i], by_steps[i], tolerance);
    assert_true(once.relative_gradient <= 1e-14);
    assert_near(once.rms_error, steps.rms_error, 1e-12 * steps.rms_error);
    assert_int_equal(once.unsupported_count, steps.unsupported_count);
    free(c);
}

static void every_degree_open_and_closed_comes_out_as_by_steps(void **state)
{
    (void)state;
    pia_context *context = with_threads(2);
    for (int degree = 1; degree <= 7; degree++)
        for (int closed = 0; closed < 2; closed++) check_same(context, make(degree, 1 + degree % DIM, ROWS, closed), 1e-11);
    pia_context_destroy(context);
}

static void weights_count(void **state)
{
    (void)state;
    pia_context *context = with_threads(2);
    curve *c = make(3, 3, ROWS, 0);
    c->data.weights = c->weights;
    check_same(context, c, 1e-12);
    pia_context_destroy(context);
}

/* Four rows in each of the first and the last spans, one in each of the others, near their middles: there far control points still say
 * something of each other. */
static void move_rows(curve *c)
{
    enum { SPANS = CONTROL - 3, CROWDED = 5 };
    pia_index row = 0;
    for (pia_index s = 0; s < SPANS; s++) {
        int rows = s < CROWDED || s >= SPANS - CROWDED ? 4 : 1;
        for (int k = 0; k < rows; k++) c->parameters[row++] = ((double)s + (rows > 1 ? k / 4.0 : 0.47)) / SPANS;
    }
    c->data.count[0] = row;
}

static void margins_that_are_short_are_made_good(void **state)
{
    (void)state;
    pia_context *context = with_threads(2);
    pia_report report = {.struct_size = sizeof report};
    curve *c = make(3, 2, ROWS, 0);
    move_rows(c);
    fit_at_once(context, c, at_once, &report);
    assert_true(report.iterations > 1);
    check_same(context, c, 1e-9);
    pia_context_destroy(context);
}

/* The rows of some spans are missing, so that control points are held by nothing but a pull to where they start. */
static void a_gap_is_closed_as_by_steps(void **state)
{
    (void)state;
    pia_context *context = with_threads(2);
    curve *c = make(3, 3, ROWS, 0);
    pia_index kept = ROWS / 2, gap = 40;
    memmove(c->parameters + kept, c->parameters + kept + gap, sizeof(double) * (size_t)(ROWS - kept - gap));
    memmove(c->points + kept * DIM, c->points + (kept + gap) * DIM, sizeof(double) * (size_t)((ROWS - kept - gap) * DIM));
    c->data.count[0] = ROWS - gap;
    pia_report report = {.struct_size = sizeof report};
    fit_at_once(context, c, at_once, &report);
    assert_true(report.unsupported_count > 0);
    check_same(context, c, 1e-9);
    pia_context_destroy(context);
}

static void threads_change_no_bit(void **state)
{
    (void)state;
    pia_context *one = with_threads(1), *four = with_threads(4);
    pia_report report = {.struct_size = sizeof report};
    curve *c = make(3, 3, ROWS, 0);
    pia_index count = fit_at_once(one, c, at_once, &report);
    fit_at_once(four, c, by_steps, &report);
    assert_memory_equal(at_once, by_steps, sizeof(double) * (size_t)count);
    free(c);
    pia_context_destroy(one);
    pia_context_destroy(four);
}

static int at_once_please(void *user)
{
    (void)user;
    return 1;
}

/* An interrupted fit has its start to show. */
static void an_interruption_leaves_the_start(void **state)
{
    (void)state;
    pia_context *context = NULL;
    pia_context_options options;
    pia_report report = {.struct_size = sizeof report};
    curve *c = make(3, 3, ROWS, 0);
    pia_context_options_init(&options);
    options.interrupted = at_once_please;
    assert_ok(NULL, pia_context_create(&options, &context));
    fit_at_once(context, c, at_once, &report);
    assert_int_equal(report.stop, PIA_STOP_CANCELLED);
    assert_int_equal(report.iterations, 0);
    assert_near(at_once[0], c->points[0], 1e-15);
    free(c);
    pia_context_destroy(context);
}

static pia_status fit(pia_context *context, void *user)
{
    curve *c = user;
    pia_model *model = NULL;
    pia_status status = pia_fit_data(context, &c->data, &c->options, &model, NULL);
    pia_model_destroy(model);
    return status;
}

static void memory_that_is_short_is_told(void **state)
{
    (void)state;
    curve *c = make(2, 1, ROWS, 0);
    assert_survives_failures(fit, c);
    free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_degree_open_and_closed_comes_out_as_by_steps),
        cmocka_unit_test(weights_count),
        cmocka_unit_test(margins_that_are_short_are_made_good),
        cmocka_unit_test(a_gap_is_closed_as_by_steps),
        cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test(an_interruption_leaves_the_start),
        cmocka_unit_test(memory_that_is_short_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
