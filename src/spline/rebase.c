#include "rebase.h"

#include <string.h>

#include "knots.h"

enum { TOGETHER = 64 }; /* new points of a line, so that lines are passed over as they lie in memory */

/* A new control point: `row` over the old ones from `from` on. Where it is one of them, so are `copies` new ones from here on, one
 * after the other, and `from` is the old one. */
typedef struct combination {
    pia_index from, copies;
    double row[PIA_MAX_DEGREE + 1];
} combination;

static void combine(const double *row, int count, const double *from, pia_index inner, double *to)
{
    for (pia_index c = 0; c < inner; c++) to[c] = row[0] * from[c];
    for (int k = 1; k < count; k++) {
        if (row[k] == 0) continue;
        for (pia_index c = 0; c < inner; c++) to[c] += row[k] * from[k * inner + c];
    }
}

/* Which old point the row stands for, -1 when it is not one of them. */
static int lone_place(const double *row, int count)
{
    int place = -1;
    for (int k = 0; k < count; k++) {
        if (row[k] == 0) continue;
        if (row[k] != 1 || place >= 0) return -1;
        place = k;
    }
    return place;
}

/* Of the new points from `begin` on. span: of the one before. */
static void fill_combinations(const pia_rebase *r, pia_index begin, pia_index count, pia_index *span, combination *out)
{
    for (pia_index j = 0; j < count; j++) {
        const double *target = r->target + begin + j;
        *span = pia_knots_span_near(r->knots, r->degree, r->control, target[0], *span);
        r->rule(r->knots, r->degree, *span, target + 1, out[j].row);
        int lone = lone_place(out[j].row, r->degree + 1);
        out[j].from = *span - r->degree + (lone >= 0 ? lone : 0);
        out[j].copies = lone >= 0;
    }
    for (pia_index j = count - 2; j >= 0; j--)
        if (out[j].copies > 0 && out[j + 1].from == out[j].from + 1) out[j].copies += out[j + 1].copies;
}

static void combine_line(const pia_rebase *r, const combination *made, pia_index count, const double *from, double *to)
{
    pia_index inner = r->lines.inner, taken;
    for (pia_index j = 0; j < count; j += taken) {
        const double *old = from + made[j].from * inner;
        taken = made[j].copies > 0 ? made[j].copies : 1;
        if (made[j].copies > 0)
            memcpy(to + j * inner, old, (size_t)(taken * inner) * sizeof *to);
        else
            combine(made[j].row, r->degree + 1, old, inner, to + j * inner);
    }
}

void pia_rebase_points(const pia_rebase *r, const double *from, double *to)
{
    pia_index inner = r->lines.inner, span = r->degree;
    combination made[TOGETHER];
    for (pia_index begin = 0; begin < r->target_control; begin += TOGETHER) {
        pia_index count = r->target_control - begin < TOGETHER ? r->target_control - begin : TOGETHER;
        fill_combinations(r, begin, count, &span, made);
        for (pia_index line = 0; line < r->lines.outer; line++)
            combine_line(r, made, count, from + line * r->control * inner, to + (line * r->target_control + begin) * inner);
    }
}

pia_status pia_model_rebase(pia_context *context, const pia_model *model, int direction, int degree, const double *target,
                            pia_index target_control, pia_rebase_rule *rule, pia_model **out)
{
    pia_status status = pia_knots_check(context, degree, target, target_control + degree + 1, target_control);
    if (status != PIA_OK) return status;
    int degrees[2] = {model->degree[0], model->degree[1]};
    pia_index control[2] = {model->control[0], model->control[1]};
    degrees[direction] = degree;
    control[direction] = target_control;
    pia_model *made = NULL;
    status = pia_model_new(context, model->directions, degrees, control, model->dim, model->rational, &made);
    if (status == PIA_OK) status = pia_trim_copy(context, model->trim, &made->trim);
    if (status != PIA_OK) {
        pia_model_destroy(made);
        return status;
    }
    for (int d = 0; d < model->directions; d++) {
        const double *knots = d == direction ? target : model->knots[d];
        memcpy(made->knots[d], knots, (size_t)(control[d] + degrees[d] + 1) * sizeof *knots);
        made->periodic[d] = model->periodic[d];
    }
    pia_rebase r = {model->knots[direction],
                    model->degree[direction],
                    model->control[direction],
                    pia_model_lines(model, direction),
                    target,
                    target_control,
                    rule};
    pia_rebase_points(&r, model->points, made->points);
    made->periodic[direction] = pia_model_joins(made, direction);
    *out = made;
    return PIA_OK;
}
