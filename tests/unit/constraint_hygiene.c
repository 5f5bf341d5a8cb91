/* Sets of constraints that repeat, contradict, or ask for more than there is. */
#include "constraint.h"

#include "dense_normal.h"
#include "knots.h"

enum { ROOM = 40 };

typedef struct bench {
    pia_context *context;
    problem *p;
    double points[ROOM * 3];
    pia_notes notes;
    pia_constraint list[ROOM];
    double value[ROOM][3];
    pia_constraints *c;
} bench;

static void open_curve(bench *b, int degree, pia_index unknowns, pia_index rows)
{
    memset(b, 0, sizeof *b);
    assert_ok(NULL, pia_context_create(NULL, &b->context));
    b->p = problem_open(b->context, PIA_CURVE, degree, 0, unknowns, 0, rows, 2, 0, 0);
    for (int i = 0; i < ROOM; i++)
        b->list[i] = (pia_constraint){.struct_size = sizeof b->list[i], .at_point = PIA_AUTO, .value = b->value[i]};
}

static void close_bench(bench *b)
{
    pia_notes_clear(pia_memory_of(b->context), &b->notes);
    pia_constraints_close(b->c);
    problem_close(b->p);
    pia_context_destroy(b->context);
}

static pia_status build(bench *b, pia_index count)
{
    pia_constraints_close(b->c);
    b->c = NULL;
    return pia_constraints_build(b->p->op, &b->p->targets, b->points, 10, b->list, count, NULL, 0, &b->notes, &b->c);
}

static void at_point(bench *b, int i, pia_index point)
{
    b->list[i].at_point = point;
    b->list[i].value = NULL;
}

static void expect_message(const bench *b, const char *part)
{
    if (strstr(pia_message(b->context), part) != NULL) return;
    print_error("\"%s\" is not in \"%s\"\n", part, pia_message(b->context));
    fail();
}

static void a_repeated_constraint_is_left_out_and_named(void **state)
{
    (void)state;
    bench b;
    open_curve(&b, 3, 10, 30);
    at_point(&b, 0, 4);
    at_point(&b, 1, 17);
    at_point(&b, 2, 4);
    assert_ok(b.context, build(&b, 3));
    assert_int_equal(pia_constraints_count(b.c), 3);
    assert_int_equal(pia_constraints_rank(b.c), 2);
    assert_int_equal(b.notes.count, 1);
    assert_string_equal(b.notes.line[0], "the constraint at point 4 follows from those at point 4 and was left out");
    pia_constraints_finish(b.c, b.points);
    assert_near(pia_constraints_violation(b.c, b.points, NULL), 0, 1e-14);
    close_bench(&b);
}

static void contradictions_are_refused_naming_the_points(void **state)
{
    (void)state;
    bench b;
    open_curve(&b, 3, 10, 30);
    static const pia_index names[30] = {[4] = 104, [17] = 117};
    at_point(&b, 0, 17);
    b.list[1].at_point = 17;
    b.value[1][0] = 50;
    assert_status(b.context, build(&b, 2), PIA_E_CONSTRAINT);
    expect_message(&b, "the constraint at point 17 contradicts those at point 17: it is off by");
    at_point(&b, 0, 4);
    b.list[1].at_point = 4;
    assert_status(b.context, pia_constraints_build(b.p->op, &b.p->targets, b.points, 10, b.list, 2, names, 0, NULL, &b.c),
                  PIA_E_CONSTRAINT);
    expect_message(&b, "point 104");
    close_bench(&b);
}

/* One span holds degree + 1 of them. */
static void a_crowded_span_is_refused_naming_the_crowd(void **state)
{
    (void)state;
    bench b;
    open_curve(&b, 3, 10, 30);
    for (int i = 0; i < 5; i++) {
        b.list[i].at_parameter[0] = 0.01 * (i + 1);
        b.value[i][0] = i == 2;
    }
    assert_ok(b.context, build(&b, 4));
    assert_status(b.context, build(&b, 5), PIA_E_CONSTRAINT);
    expect_message(&b, "contradicts those at 0.0");
    close_bench(&b);
}

static void more_constraints_than_control_points_are_refused_with_the_counts(void **state)
{
    (void)state;
    bench b;
    open_curve(&b, 3, 6, 30);
    for (int i = 0; i < 9; i++) at_point(&b, i, 3 * i + 1);
    assert_status(b.context, build(&b, 9), PIA_E_CONSTRAINT);
    expect_message(&b, "9 constraints are more than 6 free control points can meet");
    close_bench(&b);
}

static void what_frozen_control_points_decide_is_judged_by_their_value(void **state)
{
    (void)state;
    bench b;
    open_curve(&b, 3, 10, 30);
    assert_ok(b.context, pia_op_freeze(b.p->op, 0, 1));
    b.points[0] = 3;
    b.points[1] = -2;
    b.list[0].at_parameter[0] = 0;
    b.value[0][0] = 3 + b.p->origin[0];
    b.value[0][1] = -2 + b.p->origin[1];
    assert_ok(b.context, build(&b, 1));
    assert_int_equal(pia_constraints_rank(b.c), 0);
    assert_string_equal(b.notes.line[0], "the constraint at 0 follows from control points that are frozen and was left out");
    b.value[0][1] += 0.5;
    assert_status(b.context, build(&b, 1), PIA_E_CONSTRAINT);
    expect_message(&b, "the constraint at 0 cannot be met: the control points that it needs are frozen, and it is off by 0.5");
    close_bench(&b);
}

static void impossible_requests_are_refused_by_number(void **state)
{
    (void)state;
    bench b;
    open_curve(&b, 2, 10, 30);
    b.list[0].at_point = 30;
    assert_status(b.context, build(&b, 1), PIA_E_ARGUMENT);
    expect_message(&b, "constraint 0 is at point 30; choose one from 0 to 29");
    b.list[0].at_point = PIA_AUTO;
    b.list[0].at_parameter[0] = 1.5;
    assert_status(b.context, build(&b, 1), PIA_E_ARGUMENT);
    b.list[0].at_parameter[0] = NAN;
    assert_status(b.context, build(&b, 1), PIA_E_ARGUMENT);
    b.list[0].at_parameter[0] = 0.5;
    b.list[0].derivative[0] = 3;
    assert_status(b.context, build(&b, 1), PIA_E_ARGUMENT);
    b.list[0].derivative[0] = -1;
    assert_status(b.context, build(&b, 1), PIA_E_ARGUMENT);
    b.list[0].derivative[0] = 1;
    b.list[0].value = NULL;
    assert_status(b.context, build(&b, 1), PIA_E_ARGUMENT);
    expect_message(&b, "constraint 0 (derivative 1 at 0.5) needs a value");
    b.list[0].value = b.value[0];
    b.list[0].direction_only = 1;
    assert_status(b.context, build(&b, 1), PIA_E_ARGUMENT);
    expect_message(&b, "direction of a zero vector");
    b.list[0].derivative[0] = 0;
    assert_status(b.context, build(&b, 1), PIA_E_ARGUMENT);
    b.list[0].direction_only = 0;
    b.value[0][1] = INFINITY;
    assert_status(b.context, build(&b, 1), PIA_E_ARGUMENT);
    close_bench(&b);
}

/* [2023] Fig. 9: with a constraint in the support of every basis function the other points decide nothing. */
static void as_many_constraints_as_control_points_leave_nothing_to_the_data(void **state)
{
    (void)state;
    bench b;
    open_curve(&b, 3, 8, 60);
    double result[2][16];
    for (int i = 0; i < 8; i++) {
        b.list[i].at_parameter[0] = pia_knots_greville(b.p->knots[0], 3, i);
        b.value[i][0] = i * i;
        b.value[i][1] = 5 - i;
    }
    for (int round = 0; round < 2; round++) {
        for (pia_index i = 0; i < b.p->rows * 2 && round == 1; i++) b.p->points[i] += (double)(i % 3);
        memset(b.points, 0, sizeof b.points);
        assert_ok(b.context, build(&b, 8));
        pia_normal *normal = dense_normal_open(b.p);
        memcpy(result[round], normal->right, sizeof result[round]);
        normal->class->solve(normal, result[round], 2);
        assert_ok(b.context, pia_constraints_factor(b.c, normal));
        assert_ok(b.context, pia_constraints_correct(b.c, normal, b.points, result[round]));
        pia_normal_close(normal);
    }
    for (int i = 0; i < 16; i++) assert_near(result[0][i], result[1][i], 1e-11);
    close_bench(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_repeated_constraint_is_left_out_and_named),
        cmocka_unit_test(contradictions_are_refused_naming_the_points),
        cmocka_unit_test(a_crowded_span_is_refused_naming_the_crowd),
        cmocka_unit_test(more_constraints_than_control_points_are_refused_with_the_counts),
        cmocka_unit_test(what_frozen_control_points_decide_is_judged_by_their_value),
        cmocka_unit_test(impossible_requests_are_refused_by_number),
        cmocka_unit_test(as_many_constraints_as_control_points_leave_nothing_to_the_data),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
