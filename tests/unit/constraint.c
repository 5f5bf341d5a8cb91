/* Constraints against dense KKT systems, on curves, grids and scattered points. */
#include "constraint.h"

#include "dense_normal.h"

typedef struct shape {
    pia_kind kind;
    int p, q, nu, nv, rows, dim, cyclic, weighted, frozen;
} shape;

static const shape shapes[] = {
    {PIA_CURVE, 3, 0, 12, 0, 40, 3, 0, 0, 0},    {PIA_CURVE, 1, 0, 9, 0, 30, 1, 0, 1, 0},  {PIA_CURVE, 5, 0, 14, 0, 50, 2, 1, 0, 0},
    {PIA_CURVE, 2, 0, 10, 0, 40, 2, 1, 1, 1},    {PIA_CURVE, 4, 0, 11, 0, 44, 4, 0, 0, 1}, {PIA_GRID, 3, 3, 7, 6, 20, 3, 0, 0, 0},
    {PIA_GRID, 2, 3, 6, 7, 21, 2, 2, 1, 0},      {PIA_GRID, 3, 1, 8, 5, 24, 1, 3, 0, 1},   {PIA_SCATTERED, 3, 3, 7, 7, 22, 3, 0, 0, 0},
    {PIA_SCATTERED, 2, 2, 6, 7, 21, 2, 1, 1, 1}, {PIA_GRID, 2, 3, 6, 7, 21, 2, 3, 0, 0},
};
enum { SHAPES = sizeof shapes / sizeof *shapes, ROOM = 12 };

/* Constraints of every sort that a shape allows: data points, places, derivatives; at most ROOM. */
typedef struct asked {
    pia_constraint list[ROOM];
    double value[ROOM][PIA_MAX_DIM];
    pia_index count;
} asked;

static pia_constraint *ask(asked *a, uint64_t *seed)
{
    pia_constraint *c = &a->list[a->count];
    *c = (pia_constraint){.struct_size = sizeof *c, .at_point = PIA_AUTO, .value = a->value[a->count]};
    for (int d = 0; d < PIA_MAX_DIM; d++) a->value[a->count][d] = 2 * problem_random(seed) - 1;
    a->count++;
    return c;
}

static void ask_for_everything(const problem *p, int directions_too, asked *a)
{
    uint64_t seed = 99;
    a->count = 0;
    for (int k = 0; k < 2; k++) {
        pia_constraint *c = ask(a, &seed);
        c->at_point = (2 * k + 1) * p->rows / 5;
        c->value = NULL;
    }
    pia_constraint *c = ask(a, &seed);
    c->at_parameter[0] = 0.62;
    c->at_parameter[1] = 0.13;
    c = ask(a, &seed);
    c->at_parameter[0] = 0.05;
    c->at_parameter[1] = 0.9;
    c->derivative[0] = 1;
    if (directions_too && p->dim > 1) {
        c = ask(a, &seed);
        c->at_parameter[0] = 0.81;
        c->at_parameter[1] = 0.45;
        c->derivative[p->kind == PIA_CURVE ? 0 : 1] = 1;
        c->direction_only = 1;
    }
}

static pia_context *new_context(void)
{
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    return context;
}

static problem *open_shape(pia_context *context, const shape *s, double *start)
{
    problem *p = problem_open(context, s->kind, s->p, s->q, s->nu, s->nv, s->rows, s->dim, s->cyclic, s->weighted);
    uint64_t seed = 5;
    for (pia_index i = 0; i < p->cols * p->dim; i++) start[i] = 2 * problem_random(&seed) - 1;
    if (s->frozen) {
        assert_ok(context, pia_op_freeze(p->op, 1, 1));
        assert_ok(context, pia_op_freeze(p->op, p->cols - 2, 1));
    }
    return p;
}

/* Scalar rows over [cols x dim] unknowns: everything in the open, directions as products with vectors across them. */
typedef struct dense_rows {
    pia_index count;
    double *row, *right; /* [count x cols dim], [count] */
} dense_rows;

static void add_row(const problem *p, dense_rows *r, const double *functional, const double *e, double right)
{
    double *row = r->row + r->count * p->cols * p->dim;
    for (pia_index c = 0; c < p->cols; c++)
        for (int d = 0; d < p->dim; d++) row[c * p->dim + d] = functional[c] * e[d];
    r->right[r->count++] = right;
}

static dense_rows rows_of(const problem *p, const asked *a)
{
    dense_rows r = {0, malloc((size_t)(ROOM * p->dim * p->cols * p->dim) * sizeof(double)),
                    malloc((size_t)(ROOM * p->dim) * sizeof(double))};
    double *functional = malloc((size_t)p->cols * sizeof *functional);
    for (pia_index i = 0; i < a->count; i++) {
        const pia_constraint *c = &a->list[i];
        double t[2] = {c->at_parameter[0], c->at_parameter[1]}, sum = 0;
        if (c->at_point >= 0) problem_parameters(p, c->at_point, t);
        const double *value = c->value != NULL ? c->value : p->points + c->at_point * p->dim;
        problem_row(p, t, c->derivative, functional);
        for (pia_index k = 0; k < p->cols; k++) sum += functional[k];
        for (int d = 0; d < p->dim; d++) {
            double e[PIA_MAX_DIM] = {0};
            if (!c->direction_only) {
                e[d] = 1;
                add_row(p, &r, functional, e, value[d] - sum * p->origin[d]);
            } else if (d > 0) { /* value[0] x_d - value[d] x_0 = 0 */
                e[d] = value[0];
                e[0] = -value[d];
                add_row(p, &r, functional, e, 0);
            }
        }
    }
    free(functional);
    return r;
}

/* x [cols x dim]: least squares under the rows, by one dense KKT system; frozen unknowns keep what `start` says. weight > 0: rows are
 * data of that weight instead. */
static void dense_limit(const problem *p, const dense_rows *r, const double *start, double *x)
{
    pia_index n = p->cols * p->dim, all = n + r->count;
    double *h = malloc((size_t)(p->cols * p->cols) * sizeof *h), *b = malloc((size_t)n * sizeof *b);
    double *kkt = calloc((size_t)(all * all), sizeof *kkt), *right = calloc((size_t)all, sizeof *right);
    problem_normal(p, h, b);
    for (pia_index i = 0; i < p->cols; i++)
        for (pia_index j = 0; j < p->cols; j++)
            for (int d = 0; d < p->dim; d++) kkt[(i * p->dim + d) * all + j * p->dim + d] = h[i * p->cols + j];
    memcpy(right, b, (size_t)n * sizeof *b);
    for (pia_index k = 0; k < r->count; k++) {
        right[n + k] = r->right[k];
        for (pia_index i = 0; i < n; i++) kkt[(n + k) * all + i] = kkt[i * all + n + k] = r->row[k * n + i];
    }
    for (pia_index i = 0; i < n; i++) {
        if (p->op->frozen == NULL || !p->op->frozen[i / p->dim]) continue;
        for (pia_index j = 0; j < all; j++) kkt[i * all + j] = i == j;
        right[i] = start[i];
    }
    problem_solve(kkt, all, right, 1);
    memcpy(x, right, (size_t)n * sizeof *x);
    free(h), free(b), free(kkt), free(right);
}

static void the_corrected_direct_solve_is_the_kkt_solution(void **state)
{
    (void)state;
    pia_context *context = new_context();
    for (int k = 0; k < 2 * SHAPES; k++) {
        double points[400], expected[400], correction[400];
        problem *p = open_shape(context, &shapes[k / 2], points);
        asked a;
        pia_constraints *c;
        ask_for_everything(p, k % 2, &a);
        assert_ok(context, pia_constraints_build(p->op, &p->targets, points, 10, a.list, a.count, NULL, 0, NULL, &c));
        dense_rows r = rows_of(p, &a);
        dense_limit(p, &r, points, expected);
        pia_normal *normal = dense_normal_open(p);
        normal->class->multiply(normal, points, p->dim, correction);
        for (pia_index i = 0; i < p->cols * p->dim; i++) correction[i] = normal->right[i] - correction[i];
        normal->class->solve(normal, correction, p->dim);
        assert_ok(context, pia_constraints_factor(c, normal));
        assert_ok(context, pia_constraints_correct(c, normal, points, correction));
        for (pia_index i = 0; i < p->cols * p->dim; i++) points[i] += correction[i];
        for (pia_index i = 0; i < p->cols * p->dim; i++) assert_near(points[i], expected[i], 1e-9);
        assert_near(pia_constraints_violation(c, points, NULL), 0, 1e-13);
        free(r.row), free(r.right);
        pia_constraints_close(c);
        pia_normal_close(normal);
        problem_close(p);
    }
    pia_context_destroy(context);
}

static void finishing_meets_constraints_and_leaves_frozen_unknowns(void **state)
{
    (void)state;
    pia_context *context = new_context();
    for (int k = 0; k < 2 * SHAPES; k++) {
        double points[400], before[400];
        problem *p = open_shape(context, &shapes[k / 2], points);
        asked a;
        pia_constraints *c;
        ask_for_everything(p, k % 2, &a);
        memcpy(before, points, sizeof before);
        assert_ok(context, pia_constraints_build(p->op, &p->targets, points, 10, a.list, a.count, NULL, 0, NULL, &c));
        assert_true(pia_constraints_violation(c, points, NULL) > 1e-3);
        pia_constraints_finish(c, points);
        assert_near(pia_constraints_violation(c, points, NULL), 0, 2e-15 * 10);
        dense_rows r = rows_of(p, &a);
        for (pia_index i = 0; i < r.count; i++) {
            double value = -r.right[i], size = 0;
            for (pia_index j = 0; j < p->cols * p->dim; j++) {
                value += r.row[i * p->cols * p->dim + j] * points[j];
                size += fabs(r.row[i * p->cols * p->dim + j]);
            }
            assert_near(value, 0, 1e-14 * (1 + size) * 10);
        }
        for (pia_index i = 0; i < p->cols * p->dim; i++)
            if (p->op->frozen != NULL && p->op->frozen[i / p->dim]) assert_near(points[i], before[i], 0);
        free(r.row), free(r.right);
        pia_constraints_close(c);
        problem_close(p);
    }
    pia_context_destroy(context);
}

/* A reduced gradient is orthogonal to the constraints, and stays what it is when it already was. */
static void directions_of_reduced_gradients_do_not_move_the_constraints(void **state)
{
    (void)state;
    pia_context *context = new_context();
    for (int k = 0; k < 2 * SHAPES; k++) {
        double points[400], gradient[400], again[400], z[400], metric[400], moved[400];
        problem *p = open_shape(context, &shapes[k / 2], points);
        uint64_t seed = 3;
        asked a;
        pia_constraints *c;
        ask_for_everything(p, k % 2, &a);
        assert_ok(context, pia_constraints_build(p->op, &p->targets, points, 10, a.list, a.count, NULL, 0, NULL, &c));
        for (pia_index i = 0; i < p->cols; i++) metric[i] = i % 5 == 3 ? 0 : 0.01 + problem_random(&seed);
        for (pia_index i = 0; i < p->cols * p->dim; i++) gradient[i] = problem_random(&seed);
        pia_op_mask(p->op, gradient, p->dim);
        assert_ok(context, pia_constraints_metric(c, metric));
        pia_constraints_finish(c, points);
        pia_constraints_reduce(c, gradient);
        memcpy(again, gradient, sizeof again);
        pia_constraints_reduce(c, again);
        pia_constraints_direction(c, gradient, z);
        for (pia_index i = 0; i < p->cols * p->dim; i++) assert_near(again[i], gradient[i], 1e-13);
        for (pia_index i = 0; i < p->cols * p->dim; i++) moved[i] = points[i] + z[i];
        assert_near(pia_constraints_violation(c, moved, NULL), 0, 1e-12);
        pia_constraints_close(c);
        problem_close(p);
    }
    pia_context_destroy(context);
}

static void soft_constraints_are_data_of_their_weight(void **state)
{
    (void)state;
    pia_context *context = new_context();
    const double weight = 37;
    for (int k = 0; k < 2 * SHAPES; k++) {
        double points[400], gradient[400], again[400];
        problem *p = open_shape(context, &shapes[k / 2], points);
        pia_index size = p->cols * p->dim;
        asked a;
        pia_constraints *c;
        pia_normal *normal = dense_normal_open(p), *soft;
        ask_for_everything(p, k % 2, &a);
        a.list[a.count] = a.list[0]; /* twice the same and contradictory: both count */
        a.list[a.count++].value = a.value[3];
        assert_ok(context, pia_constraints_build(p->op, &p->targets, points, 10, a.list, a.count, NULL, 1, NULL, &c));
        assert_ok(context, pia_constraints_soften(c, weight, normal, &soft));
        assert_ok(context, soft->class->factor(soft));
        soft->class->multiply(soft, points, p->dim, gradient);
        for (pia_index i = 0; i < size; i++) gradient[i] = soft->right[i] - gradient[i];
        pia_op_mask(p->op, gradient, p->dim);
        soft->class->solve(soft, gradient, p->dim);
        for (pia_index i = 0; i < size; i++) points[i] += gradient[i];
        soft->class->multiply(soft, points, p->dim, again);
        for (pia_index i = 0; i < size; i++)
            assert_near(again[i], p->op->frozen != NULL && p->op->frozen[i / p->dim] ? 0 : soft->right[i], 1e-10);
        /* The gradient from the data and the rows in the open. Rows of B have absolute sum 1, directions unit vectors across. */
        normal->class->multiply(normal, points, p->dim, gradient);
        double *residual = malloc((size_t)(a.count * p->dim) * sizeof *residual);
        pia_constraints_residual(c, points, residual);
        for (pia_index i = 0; i < size; i++) gradient[i] = normal->right[i] - gradient[i];
        pia_constraints_add(c, residual, weight, gradient);
        for (pia_index i = 0; i < size; i++) assert_near(gradient[i], 0, 1e-10);
        free(residual);
        pia_normal_close(soft);
        pia_normal_close(normal);
        pia_constraints_close(c);
        problem_close(p);
    }
    pia_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_corrected_direct_solve_is_the_kkt_solution),
        cmocka_unit_test(finishing_meets_constraints_and_leaves_frozen_unknowns),
        cmocka_unit_test(directions_of_reduced_gradients_do_not_move_the_constraints),
        cmocka_unit_test(soft_constraints_are_data_of_their_weight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
