/* Laws of local edits of a settled epia fit: who moves, what it costs, and that nothing is lost by looking at a part. */
#include <stdlib.h>
#include <unistd.h>

#include "context_fixture.h"

enum { ROWS = 2000, LINES = 40, COLUMNS = 50, SCATTERED = 4000, MOST = 1 << 17 };

typedef enum shape_kind { CURVE, GRID, CLOUD, SHAPES } shape_kind;

typedef struct sample {
    double points[4 * SCATTERED], parameters[2 * SCATTERED];
    pia_data data;
    pia_fit_options options;
} sample;

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static void make_curve(sample *s, int dim)
{
    for (int i = 0; i < ROWS; i++)
        for (int d = 0; d < dim; d++) {
            double t = 0.02 * i;
            s->points[i * dim + d] = (d == 0) * t + sin((1.3 + d) * t + d) + 0.4 * cos(0.9 * t * (1 + d));
        }
    s->data.count[0] = ROWS;
}

static void make_grid(sample *s)
{
    s->data.kind = PIA_GRID;
    s->data.count[0] = LINES;
    s->data.count[1] = COLUMNS;
    for (int i = 0; i < LINES; i++)
        for (int j = 0; j < COLUMNS; j++) {
            double *p = s->points + (i * COLUMNS + j) * 3;
            p[0] = 0.2 * i;
            p[1] = 0.2 * j;
            p[2] = 0.5 * sin(1.3 * p[0]) * cos(1.1 * p[1]);
        }
}

static void make_cloud(sample *s)
{
    uint64_t seed = 11;
    s->data.kind = PIA_SCATTERED;
    s->data.count[0] = SCATTERED;
    s->data.parameters = s->parameters;
    for (int i = 0; i < SCATTERED; i++) {
        double u = s->parameters[2 * i] = random_number(&seed), v = s->parameters[2 * i + 1] = random_number(&seed);
        double point[3] = {u, v, 0.1 * sin(9 * u) * cos(8 * v)};
        memcpy(s->points + 3 * i, point, sizeof point);
    }
}

static sample *make(shape_kind shape, int degree, int dim, double tolerance)
{
    sample *s = calloc(1, sizeof *s);
    pia_data_init(&s->data);
    pia_fit_options_init(&s->options);
    s->data.points = s->points;
    s->data.dim = dim;
    if (shape == CURVE) make_curve(s, dim);
    if (shape == GRID) make_grid(s);
    if (shape == CLOUD) make_cloud(s);
    s->options.method = "epia";
    s->options.degree[0] = s->options.degree[1] = degree;
    s->options.tolerance = tolerance;
    return s;
}

typedef struct controls {
    pia_model_info info;
    double x[MOST];
} controls;

static controls *controls_of(pia_context *context, pia_fit *fit)
{
    controls *c = calloc(1, sizeof *c);
    pia_model *model = NULL;
    c->info.struct_size = sizeof c->info;
    assert_ok(context, pia_fit_model(fit, &model));
    pia_model_get_info(model, &c->info);
    assert_true(c->info.control[0] * c->info.control[1] * c->info.dim <= MOST);
    pia_model_control(model, c->x, NULL);
    pia_model_destroy(model);
    return c;
}

/* Control points that differ, and the box of them in each direction. */
static pia_index count_moved(const controls *before, const controls *after, pia_index *extent)
{
    pia_index moved = 0, low[2] = {MOST, MOST}, high[2] = {-1, -1};
    assert_int_equal(before->info.control[0], after->info.control[0]);
    assert_int_equal(before->info.control[1], after->info.control[1]);
    for (pia_index i = 0; i < before->info.control[0]; i++)
        for (pia_index j = 0; j < before->info.control[1]; j++) {
            pia_index at[2] = {i, j}, c = i * before->info.control[1] + j;
            int dim = before->info.dim;
            if (memcmp(before->x + c * dim, after->x + c * dim, (size_t)dim * sizeof(double)) == 0) continue;
            moved++;
            for (int d = 0; d < 2; d++) {
                low[d] = at[d] < low[d] ? at[d] : low[d];
                high[d] = at[d] > high[d] ? at[d] : high[d];
            }
        }
    for (int d = 0; d < 2; d++) extent[d] = high[d] - low[d] + 1;
    return moved;
}

typedef struct cost {
    long long points, iterations, moved, controls, read, whole;
} cost;

/* The note about the cost of edits; 0 without one. */
static int find_cost(pia_fit *fit, cost *c)
{
    const char *note;
    for (pia_index k = 0; (note = pia_fit_note(fit, k)) != NULL; k++)
        if (sscanf(
                note,
                "epia: %lld moved points: %lld iterations moved up to %lld of %lld control points and looked at %lld rows, where all "
                "would have been %lld",
                &c->points, &c->iterations, &c->moved, &c->controls, &c->read, &c->whole) == 6)
            return 1;
    return 0;
}

/* The report, and the largest residual that the fit gives, which is measured over all rows. */
static pia_report measured(pia_context *context, pia_fit *fit, const sample *s)
{
    static double residual[4 * SCATTERED];
    pia_report report = {.struct_size = sizeof report};
    double worst = 0, squares = 0;
    assert_ok(context, pia_fit_report(fit, &report));
    assert_ok(context, pia_fit_residuals(fit, residual));
    for (pia_index i = 0; i < report.point_count; i++) {
        double square = 0;
        for (int d = 0; d < s->data.dim; d++) square += residual[i * s->data.dim + d] * residual[i * s->data.dim + d];
        worst = fmax(worst, sqrt(square));
        squares += square;
    }
    assert_near(report.max_error, worst, 1e-13);
    assert_near(report.rms_error, sqrt(squares / (double)report.point_count), 1e-13);
    return report;
}

static pia_fit *settled(pia_context *context, const sample *s)
{
    pia_fit *fit = NULL;
    pia_report report = {.struct_size = sizeof report};
    assert_ok(context, pia_fit_open(context, &s->data, &s->options, &fit));
    assert_ok(context, pia_fit_run(fit, &report));
    assert_true(report.stop == PIA_STOP_TOLERANCE || (report.stop == PIA_STOP_CHANGE && s->options.tolerance == 0));
    return fit;
}

/* Moves a row by `by` in its last component. */
static void drag(pia_context *context, sample *s, pia_fit *fit, pia_index row, double by)
{
    double *point = s->points + row * s->data.dim;
    point[s->data.dim - 1] += by;
    assert_ok(context, pia_fit_move_point(fit, row, point));
}

static const pia_index MIDDLE[SHAPES] = {ROWS / 2 + 3, (LINES / 2) * COLUMNS + COLUMNS / 2, 1234};
static const double TOLERANCE[SHAPES] = {0.01, 0.02, 0.01};

/* The owner and four on either side, of every direction. */
static void first_the_owner_and_its_neighbours_move(void **state)
{
    for (shape_kind shape = CURVE; shape < SHAPES; shape++)
        for (int degree = 1; degree <= 7; degree += 2) {
            sample *s = make(shape, degree, 3, TOLERANCE[shape]);
            pia_fit *fit = settled(*state, s);
            controls *before = controls_of(*state, fit);
            pia_index extent[2];
            drag(*state, s, fit, MIDDLE[shape], 60 * TOLERANCE[shape]);
            assert_ok(*state, pia_fit_step(fit, 1, NULL));
            controls *after = controls_of(*state, fit);
            pia_index moved = count_moved(before, after, extent);
            assert_in_range(moved, 1, shape == CURVE ? 9 : 81);
            assert_true(extent[0] <= 9 && extent[1] <= 9);
            measured(*state, fit, s);
            free(before);
            free(after);
            pia_fit_close(fit);
            free(s);
        }
}

static void an_edit_ends_within_the_tolerance_of_every_row_and_looks_at_few(void **state)
{
    for (shape_kind shape = CURVE; shape < SHAPES; shape++)
        for (int dim = shape == CURVE ? 2 : 3; dim <= (shape == CURVE ? 4 : 3); dim++) {
            sample *s = make(shape, 3, dim, TOLERANCE[shape]);
            pia_fit *fit = settled(*state, s);
            pia_index placed = measured(*state, fit, s).control_count;
            cost c;
            assert_false(find_cost(fit, &c));
            for (int k = 0; k < 3; k++) {
                drag(*state, s, fit, MIDDLE[shape] + 7 * k, (k - 1.5) * TOLERANCE[shape]);
                assert_ok(*state, pia_fit_run(fit, NULL));
                pia_report report = measured(*state, fit, s);
                assert_int_equal(report.stop, PIA_STOP_TOLERANCE);
                assert_true(report.reached == 1 && report.max_error <= TOLERANCE[shape]);
                assert_true(find_cost(fit, &c));
                assert_int_equal(c.points, 1);
                assert_int_equal(c.controls, report.control_count);
                assert_true(c.read <= c.whole); /* new lines of a grid move all along them */
                if (report.control_count == placed || shape == CURVE) assert_true(c.moved < c.controls / 2);
                placed = report.control_count;
            }
            pia_fit_close(fit);
            free(s);
        }
}

/* A point far off takes knots of its own, which are placed where it is. */
static void knots_come_where_the_edit_is(void **state)
{
    sample *s = make(CURVE, 3, 2, 0.01);
    pia_fit *fit = settled(*state, s);
    pia_report before = measured(*state, fit, s);
    cost c;
    drag(*state, s, fit, MIDDLE[CURVE], 0.7);
    assert_ok(*state, pia_fit_run(fit, NULL));
    pia_report after = measured(*state, fit, s);
    assert_true(after.stop == PIA_STOP_TOLERANCE && after.control_count > before.control_count);
    assert_true(find_cost(fit, &c));
    assert_true(c.moved < c.controls / 2 && c.read < c.whole / 2);
    pia_fit_close(fit);
    free(s);
}

/* On fixed knots there is one limit; it is found from the part outwards as by all control points, which an empty edit makes move. */
static void the_limit_is_that_of_the_whole(void **state)
{
    for (shape_kind shape = CURVE; shape < SHAPES; shape++) {
        controls *c[2];
        for (int whole = 0; whole < 2; whole++) {
            sample *s = make(shape, 3, 3, 0);
            s->options.control[0] = shape == CURVE ? 60 : 14;
            s->options.control[1] = shape == CURVE ? PIA_AUTO : 12;
            s->options.max_iterations = 20000;
            s->options.stop_change = 1e-13;
            pia_fit *fit = settled(*state, s);
            cost spent;
            drag(*state, s, fit, MIDDLE[shape], 0.3);
            if (whole) assert_ok(*state, pia_fit_freeze(fit, NULL, 0, 1));
            assert_ok(*state, pia_fit_run(fit, NULL));
            assert_int_equal(find_cost(fit, &spent), !whole);
            if (!whole) assert_true(spent.read <= spent.whole);
            c[whole] = controls_of(*state, fit);
            pia_fit_close(fit);
            free(s);
        }
        for (pia_index k = 0; k < c[0]->info.control[0] * c[0]->info.control[1] * 3; k++) assert_near(c[0]->x[k], c[1]->x[k], 1e-10);
        free(c[0]);
        free(c[1]);
    }
}

/* Points moved before the fit has followed the first of them are followed together; a later edit begins anew. */
static void edits_are_followed_together_until_they_are_settled(void **state)
{
    sample *s = make(CURVE, 3, 2, 0.01);
    pia_fit *fit = settled(*state, s);
    cost c;
    drag(*state, s, fit, 900, 0.05);
    drag(*state, s, fit, 1100, -0.05);
    assert_ok(*state, pia_fit_run(fit, NULL));
    assert_true(find_cost(fit, &c) && c.points == 2 && c.read < c.whole);
    assert_int_equal(measured(*state, fit, s).reached, 1);
    drag(*state, s, fit, 100, 0.05);
    assert_ok(*state, pia_fit_run(fit, NULL));
    assert_true(find_cost(fit, &c) && c.points == 1);
    assert_int_equal(measured(*state, fit, s).reached, 1);
    pia_fit_close(fit);
    free(s);
}

static void what_is_not_settled_goes_on_as_a_whole(void **state)
{
    sample *s = make(CURVE, 3, 2, 0.01);
    pia_fit *fit = NULL;
    cost c;
    assert_ok(*state, pia_fit_open(*state, &s->data, &s->options, &fit));
    assert_ok(*state, pia_fit_step(fit, 3, NULL));
    drag(*state, s, fit, 1000, 0.05);
    assert_ok(*state, pia_fit_run(fit, NULL));
    assert_false(find_cost(fit, &c));
    drag(*state, s, fit, 1000, 0.05);
    assert_ok(*state, pia_fit_step(fit, 1, NULL));
    assert_ok(*state, pia_fit_set(fit, "tolerance", "1e-3")); /* which asks something of every point */
    assert_ok(*state, pia_fit_run(fit, NULL));
    assert_false(find_cost(fit, &c));
    assert_true(measured(*state, fit, s).max_error <= 1e-3);
    pia_fit_close(fit);
    free(s);
}

/* Control points and notes after a file in the middle of an edit, and without one. */
static void a_saved_edit_goes_on_with_the_same_bits(void **state)
{
    for (shape_kind shape = CURVE; shape < SHAPES; shape++) {
        char path[] = "/tmp/pia_epia_edited_XXXXXX";
        sample *s = make(shape, 3, 3, TOLERANCE[shape]);
        pia_fit *fit = settled(*state, s), *resumed = NULL;
        cost one, other;
        pia_index extent[2];
        int file = mkstemp(path);
        assert_true(file >= 0);
        close(file);
        drag(*state, s, fit, MIDDLE[shape], 6 * TOLERANCE[shape]);
        assert_ok(*state, pia_fit_step(fit, 2, NULL));
        assert_ok(*state, pia_fit_save(fit, path));
        assert_ok(*state, pia_fit_resume(*state, path, &resumed));
        assert_ok(*state, pia_fit_run(fit, NULL));
        assert_ok(*state, pia_fit_run(resumed, NULL));
        controls *a = controls_of(*state, fit), *b = controls_of(*state, resumed);
        assert_int_equal(count_moved(a, b, extent), 0);
        assert_true(find_cost(fit, &one) && find_cost(resumed, &other));
        assert_memory_equal(&one, &other, sizeof one);
        pia_fit_close(fit);
        pia_fit_close(resumed);
        unlink(path);
        free(a);
        free(b);
        free(s);
    }
}

static void any_number_of_threads_gives_the_same_bits(void **state)
{
    (void)state;
    for (shape_kind shape = CURVE; shape < SHAPES; shape++) {
        controls *first = NULL;
        pia_index extent[2];
        for (int threads = 1; threads <= 8; threads *= 2) {
            pia_context *context;
            assert_ok(NULL, pia_context_create(NULL, &context));
            assert_ok(context, pia_context_set_threads(context, threads));
            sample *s = make(shape, 3, 3, TOLERANCE[shape]);
            pia_fit *fit = settled(context, s);
            drag(context, s, fit, MIDDLE[shape], 5 * TOLERANCE[shape]);
            assert_ok(context, pia_fit_run(fit, NULL));
            controls *now = controls_of(context, fit);
            if (first == NULL)
                first = now;
            else
                assert_int_equal(count_moved(first, now, extent), 0);
            if (first != now) free(now);
            pia_fit_close(fit);
            free(s);
            pia_context_destroy(context);
        }
        free(first);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(first_the_owner_and_its_neighbours_move),
        cmocka_unit_test(an_edit_ends_within_the_tolerance_of_every_row_and_looks_at_few),
        cmocka_unit_test(knots_come_where_the_edit_is),
        cmocka_unit_test(the_limit_is_that_of_the_whole),
        cmocka_unit_test(edits_are_followed_together_until_they_are_settled),
        cmocka_unit_test(what_is_not_settled_goes_on_as_a_whole),
        cmocka_unit_test(a_saved_edit_goes_on_with_the_same_bits),
        cmocka_unit_test(any_number_of_threads_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
