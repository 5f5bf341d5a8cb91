/* Scattered operators and constraints when memory runs out. */
#include "constraint.h"

#include "failing.h"
#include "op_scatter.h"

enum { ROWS = 40, CONTROL = 6 };

/* One constraint repeats, one is a direction: every array there is gets used. */
static pia_status constrain_scattered_points(pia_context *context, void *user)
{
    static const double line[CONTROL + 4] = {0, 0, 0, 0, 0.3, 0.6, 1, 1, 1, 1};
    static const double *const knots[2] = {line, line};
    static const int degree[2] = {3, 3};
    static const pia_map map[2] = {PIA_MAP_IDENTITY, PIA_MAP_IDENTITY};
    static const pia_index full[2] = {CONTROL, CONTROL};
    static const double origin[2] = {0, 0}, along[2] = {1, 2};
    double parameters[2 * ROWS], points[2 * ROWS], start[2 * CONTROL * CONTROL] = {0};
    (void)user;
    for (int i = 0; i < ROWS; i++) {
        points[2 * i] = parameters[2 * i] = i / (double)ROWS;
        points[2 * i + 1] = parameters[2 * i + 1] = i * 7 % ROWS / (double)ROWS;
    }
    pia_constraint list[3];
    for (int i = 0; i < 3; i++) pia_constraint_init(&list[i]);
    list[0].at_point = list[1].at_point = 5;
    list[2].derivative[0] = list[2].direction_only = 1;
    list[2].value = along;
    pia_targets targets = {.points = points, .origin = origin, .dim = 2};
    pia_op *op = NULL;
    pia_constraints *constraints = NULL;
    pia_notes notes = {0};
    pia_status status = pia_op_scatter_open(context, degree, map, knots, full, parameters, ROWS, NULL, 2, &op);
    if (status == PIA_OK) status = pia_constraints_build(op, &targets, start, 1, list, 3, NULL, 0, &notes, &constraints);
    if (status == PIA_OK) status = pia_constraints_metric(constraints, NULL);
    pia_notes_clear(pia_memory_of(context), &notes);
    pia_constraints_close(constraints);
    pia_op_close(op);
    return status;
}

static void constraints_on_scattered_points_survive_any_failing_allocation(void **state)
{
    (void)state;
    assert_survives_failures(constrain_scattered_points, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(constraints_on_scattered_points_survive_any_failing_allocation)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
