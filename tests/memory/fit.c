#include "failing.h"

enum { COUNT = 40, ROWS = 8, COLUMNS = 7 };

typedef struct problem {
    pia_data data;
    pia_fit_options options;
    double points[ROWS * COLUMNS * 3];
} problem;

static problem curve_problem(const char *method)
{
    problem p;
    memset(&p, 0, sizeof p);
    pia_data_init(&p.data);
    pia_fit_options_init(&p.options);
    p.options.method = method;
    p.options.max_iterations = 3;
    p.options.trace_every = 1;
    p.data.count[0] = COUNT;
    p.data.dim = 2;
    for (int i = 0; i < COUNT; i++) {
        p.points[2 * i] = cos(0.15 * i);
        p.points[2 * i + 1] = sin(0.15 * i) + 0.1 * sin(i);
    }
    memcpy(p.points + 20, p.points + 18, 2 * sizeof(double)); /* a repeated point, so that rows are dropped and noted */
    return p;
}

/* Knots are inserted on the way to the tolerance. */
static problem epia_problem(void)
{
    problem p = curve_problem("epia");
    p.options.tolerance = 0.01;
    p.options.max_iterations = 12;
    return p;
}

static problem grid_problem(const char *method)
{
    problem p = curve_problem(method);
    p.data.kind = PIA_GRID;
    p.data.count[0] = ROWS;
    p.data.count[1] = COLUMNS;
    p.data.dim = 3;
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++) {
            double *q = p.points + 3 * (i * COLUMNS + j);
            q[0] = i;
            q[1] = j;
            q[2] = sin(i) * cos(j);
        }
    return p;
}

static pia_status fit_in_one_call(pia_context *context, void *user)
{
    problem *p = user;
    p->data.points = p->points;
    pia_model *model = NULL;
    pia_report report = {.struct_size = sizeof report};
    pia_status status = pia_fit_data(context, &p->data, &p->options, &model, &report);
    if (status != PIA_OK) assert_null(model);
    pia_model_destroy(model);
    return status;
}

static pia_status fit_step_by_step(pia_context *context, void *user)
{
    problem *p = user;
    p->data.points = p->points;
    pia_fit *fit = NULL;
    pia_model *model = NULL;
    pia_report report = {.struct_size = sizeof report};
    pia_index frozen = 2;
    pia_status status = pia_fit_open(context, &p->data, &p->options, &fit);
    if (status == PIA_OK) status = pia_fit_step(fit, 2, &report);
    if (status == PIA_OK) status = pia_fit_freeze(fit, &frozen, 1, 1);
    if (status == PIA_OK) status = pia_fit_move_point(fit, 5, (const double[3]){0.5, 0.25, 0.125});
    if (status == PIA_OK) status = pia_fit_step(fit, 2, &report);
    if (status == PIA_OK) status = pia_fit_model(fit, &model);
    pia_model_destroy(model);
    pia_fit_close(fit);
    return status;
}

/* Every method of the registry that takes this data. */
static void survive_with_every_method(problem (*make)(const char *method))
{
    pia_entry method;
    int covered = 0;
    for (pia_index i = 0; pia_list("method", i, &method); i++) {
        problem p = make(method.name);
        p.data.points = p.points;
        pia_context *context = NULL;
        assert_ok(NULL, pia_context_create(NULL, &context));
        int takes = fit_in_one_call(context, &p) == PIA_OK;
        int steps = fit_step_by_step(context, &p) == PIA_OK;
        pia_context_destroy(context);
        if (takes) assert_survives_failures(fit_in_one_call, &p);
        if (steps) assert_survives_failures(fit_step_by_step, &p);
        covered += takes;
    }
    assert_true(covered >= 2);
}

static void t_peer_10_a_curve_fit_survives_every_failure(void **state)
{
    (void)state;
    survive_with_every_method(curve_problem);
}

static void a_grid_fit_survives_every_failure(void **state)
{
    (void)state;
    survive_with_every_method(grid_problem);
}

static void knot_insertion_survives_every_failure(void **state)
{
    (void)state;
    problem p = epia_problem();
    assert_survives_failures(fit_in_one_call, &p);
    assert_survives_failures(fit_step_by_step, &p);
}

static void dominant_columns_survive_every_failure(void **state)
{
    (void)state;
    problem p = grid_problem("direct");
    p.options.placement = "dominant-columns";
    p.options.tolerance = 0.1;
    assert_survives_failures(fit_in_one_call, &p);
}

/* Blocks aligned as asked and no better, which only their own allocator can take back: the address of the whole stands before each. */
static void *barely_aligned(void *user, size_t size, size_t align)
{
    char *whole;
    size_t step = align < sizeof whole ? sizeof whole : align;
    if (posix_memalign((void **)&whole, 2 * step, size + step) != 0) return NULL;
    memcpy(whole + step - sizeof whole, &whole, sizeof whole);
    ++*(int64_t *)user;
    return whole + step;
}

static void take_back(void *user, void *block)
{
    char *whole;
    if (block == NULL) return;
    memcpy(&whole, (char *)block - sizeof whole, sizeof whole);
    --*(int64_t *)user;
    free(whole);
}

static void t_peer_18_blocks_need_no_more_than_the_alignment_asked_and_go_back_where_they_came_from(void **state)
{
    (void)state;
    int64_t blocks = 0;
    pia_context_options options;
    pia_context *context = NULL;
    pia_context_options_init(&options);
    options.allocate = barely_aligned;
    options.release = take_back;
    options.user = &blocks;
    assert_ok(NULL, pia_context_create(&options, &context));
    problem curve = curve_problem("direct"), grid = grid_problem("lspia"), loose = epia_problem();
    assert_ok(context, fit_in_one_call(context, &curve));
    assert_ok(context, fit_in_one_call(context, &grid));
    assert_ok(context, fit_in_one_call(context, &loose));
    pia_context_destroy(context);
    assert_int_equal(blocks, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(knot_insertion_survives_every_failure),
        cmocka_unit_test(dominant_columns_survive_every_failure),
        cmocka_unit_test(t_peer_10_a_curve_fit_survives_every_failure),
        cmocka_unit_test(a_grid_fit_survives_every_failure),
        cmocka_unit_test(t_peer_18_blocks_need_no_more_than_the_alignment_asked_and_go_back_where_they_came_from),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
