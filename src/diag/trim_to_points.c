/* A surface cut to where its points are: the outline of their parameters as trim loops, simplified as long as that leaves them simple.
 */
#include "model.h"
#include "options.h"
#include "outline.h"

#include <math.h>
#include <string.h>

enum { LOOKED_AT = 400, MOST_NAMED = 8 };

void pia_outline_options_init(pia_outline_options *options)
{
    *options = (pia_outline_options){.struct_size = sizeof *options};
}

static pia_status check(pia_context *context, const pia_model *model, const double *parameters, pia_index count,
                        const pia_outline_options *o)
{
    if (model == NULL || parameters == NULL || count < 3)
        return pia_fail(context, PIA_E_ARGUMENT, "trimming to points needs a model and parameters of at least 3 points");
    if (model->directions != 2) return pia_fail(context, PIA_E_ARGUMENT, "a curve cannot be trimmed; surfaces can");
    if (!(o->radius >= 0) || isinf(o->radius)) return pia_fail(context, PIA_E_ARGUMENT, "radius %g is not a length", o->radius);
    for (pia_index i = 0; i < 2 * count; i++)
        if (!isfinite(parameters[i]))
            return pia_fail(context, PIA_E_DATA, "parameter %c of point %lld is %g; parameters are finite", 'u' + (int)(i % 2),
                            (long long)(i / 2), parameters[i]);
    return PIA_OK;
}

/* Mean lengths of Su and Sv at some of the points. */
static pia_status find_scale(pia_context *context, const pia_model *model, const double *uv, pia_index count, double scale[2])
{
    pia_index every = (count + LOOKED_AT - 1) / LOOKED_AT, looks = (count + every - 1) / every;
    int dim = model->dim;
    double at[2 * LOOKED_AT], *value = pia_take(context, looks * 3 * dim, sizeof *value);
    if (value == NULL) return pia_take_status(context, looks * 3 * dim, sizeof *value);
    for (pia_index i = 0; i < 2 * looks; i++) at[i] = uv[2 * every * (i / 2) + i % 2];
    pia_status status = pia_model_eval(context, model, at, looks, 1, value);
    for (int d = 0; d < 2 && status == PIA_OK; d++) {
        scale[d] = 0;
        for (pia_index i = 0; i < looks; i++) {
            double square = 0;
            for (int c = 0; c < dim; c++) square += value[(3 * i + 1 + d) * dim + c] * value[(3 * i + 1 + d) * dim + c];
            scale[d] += sqrt(square) / (double)looks;
        }
        if (!(scale[d] > 0)) status = pia_fail(context, PIA_E_DATA, "the surface has no extent in %c; it cannot be trimmed", 'u' + d);
    }
    pia_give(context, value);
    return status;
}

/* Copies of the parameters, inside the domain. */
static double *take_inside(pia_context *context, const pia_model *model, const double *parameters, pia_index count,
                           pia_outline_problem *problem)
{
    double *uv = pia_take(context, 2 * count, sizeof *uv);
    for (int d = 0; d < 2; d++) {
        problem->domain[d][0] = model->knots[d][model->degree[d]];
        problem->domain[d][1] = model->knots[d][model->control[d]];
        problem->closed[d] = model->periodic[d];
    }
    for (pia_index i = 0; i < 2 * count && uv != NULL; i++)
        uv[i] = fmin(fmax(parameters[i], problem->domain[i % 2][0]), problem->domain[i % 2][1]);
    return uv;
}

/* Loops with vertices left out; lengths count as in space. */
static void simplify(const pia_outline_problem *p, double tolerance, pia_loops *loops, unsigned char *keep)
{
    pia_index from = 0, to = 0;
    for (pia_index k = 0; k < loops->loop_count; k++) {
        pia_index count = loops->vertex_count[k];
        double *at = loops->at + 2 * to;
        memmove(at, loops->at + 2 * from, (size_t)(2 * count) * sizeof *at);
        from += count;
        for (pia_index i = 0; i < 2 * count; i++) at[i] *= p->scale[i % 2];
        count = pia_loop_simplify(at, count, tolerance, keep);
        for (pia_index i = 0; i < 2 * count; i++) at[i] = fmin(fmax(at[i] / p->scale[i % 2], p->domain[i % 2][0]), p->domain[i % 2][1]);
        loops->vertex_count[k] = count;
        to += count;
    }
    loops->vertex_total = to;
}

static pia_status copy_loops(pia_context *context, const pia_loops *from, pia_loops *to)
{
    *to = (pia_loops){.loop_count = from->loop_count, .vertex_total = from->vertex_total};
    if (from->loop_count == 0) return PIA_OK;
    to->vertex_count = pia_take(context, from->loop_count, sizeof *to->vertex_count);
    to->at = pia_take(context, 2 * from->vertex_total, sizeof *to->at);
    if (to->vertex_count == NULL || to->at == NULL) {
        pia_loops_clear(context, to);
        return pia_take_status(context, 2 * from->vertex_total, sizeof *to->at);
    }
    memcpy(to->vertex_count, from->vertex_count, (size_t)from->loop_count * sizeof *to->vertex_count);
    memcpy(to->at, from->at, (size_t)(2 * from->vertex_total) * sizeof *to->at);
    return PIA_OK;
}

/* As coarse as the outline is, finer where its loops would then cross, as it is in the end. */
static pia_status trim(pia_context *context, const pia_model *model, const pia_outline_problem *p, const pia_outline *outline,
                       pia_model **out)
{
    static const double share[] = {1, 0.3, 0};
    unsigned char *keep = pia_take(context, outline->loops.vertex_total, 1);
    pia_status status = keep != NULL ? PIA_E_DATA : pia_take_status(context, outline->loops.vertex_total, 1);
    for (int k = 0; k < 3 && status == PIA_E_DATA; k++) {
        pia_loops loops;
        status = copy_loops(context, &outline->loops, &loops);
        if (status != PIA_OK) break;
        if (share[k] > 0) simplify(p, share[k] * outline->coarseness, &loops, keep);
        status = pia_model_trim(context, model, loops.loop_count, loops.vertex_count, loops.at, out);
        pia_loops_clear(context, &loops);
    }
    pia_give(context, keep);
    return status;
}

/* Memory that is too short for a note is no error. */
static void describe(const pia_outline_problem *p, const pia_outline *outline, pia_model *model)
{
    if (model->summary == NULL) return;
    pia_notes *notes = &model->summary->notes;
    const pia_loops *loops = &outline->loops;
    if (outline->outside > 0)
        pia_note_add(&model->memory, notes,
                     "%lld points lie in islands outside the outline; a larger --trim-radius than %.4g joins them",
                     (long long)outline->outside, outline->radius);
    if (loops->loop_count < 2) return;
    if (loops->loop_count == 2)
        pia_note_add(&model->memory, notes, "a hole is left open, a region without points that a disc of radius %.4g fits in",
                     outline->radius);
    else
        pia_note_add(&model->memory, notes, "%lld holes are left open, regions without points that a disc of radius %.4g fits in",
                     (long long)loops->loop_count - 1, outline->radius);
    const double *at = loops->at + 2 * loops->vertex_count[0];
    for (pia_index k = 1; k < loops->loop_count && k <= MOST_NAMED; at += 2 * loops->vertex_count[k++]) {
        double middle[2] = {0}, area = fabs(pia_loop_area(at, loops->vertex_count[k])) * p->scale[0] * p->scale[1];
        for (pia_index i = 0; i < 2 * loops->vertex_count[k]; i++) middle[i % 2] += at[i] / (double)loops->vertex_count[k];
        pia_note_add(&model->memory, notes, "hole %lld: about (u, v) = (%.4g, %.4g), area about %.3g", (long long)k, middle[0],
                     middle[1], area);
    }
}

pia_status pia_model_trim_to_points(pia_context *context, const pia_model *model, const double *parameters, pia_index count,
                                    const pia_outline_options *options, pia_model **out)
{
    pia_outline_options o;
    pia_outline outline = {.radius = 0};
    pia_outline_options_init(&o);
    pia_status status = pia_options_read(context, "pia_outline_options", &o, sizeof o, options);
    if (status == PIA_OK && out == NULL) return pia_fail(context, PIA_E_ARGUMENT, "out is NULL");
    if (status == PIA_OK) status = check(context, model, parameters, count, &o);
    if (status != PIA_OK) return status;
    pia_outline_problem problem = {.count = count, .hull = o.hull, .radius = o.radius};
    double *uv = take_inside(context, model, parameters, count, &problem);
    if (uv == NULL) return pia_take_status(context, 2 * count, sizeof *uv);
    problem.uv = uv;
    status = find_scale(context, model, uv, count, problem.scale);
    if (status == PIA_OK) status = pia_outline_find(context, &problem, &outline);
    if (status == PIA_OK) status = trim(context, model, &problem, &outline, out);
    if (status == PIA_OK) describe(&problem, &outline, *out);
    pia_loops_clear(context, &outline.loops);
    pia_give(context, uv);
    return status;
}
