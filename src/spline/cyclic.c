/* Between the cyclic form of a closed spline, which fits work on, and the clamped form, which models keep. Control point i is the
 * blossom of a span's polynomial at the degree knots after knot i, in either form: clamping takes repeated end knots, unclamping takes
 * knots that go on periodically. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "basis.h"
#include "finite.h"
#include "knots.h"
#include "rebase.h"

static double dot(const double *row, int count, const double *points, pia_index stride)
{
    double sum = 0;
    for (int k = 0; k < count; k++) sum += row[k] * points[k * stride];
    return sum;
}

static double sum_of_sizes(const double *row, int count)
{
    double sum = 0;
    for (int k = 0; k < count; k++) sum += fabs(row[k]);
    return sum;
}

/* What two ends may differ by and still be called equal: 1e-9 of the extent, and the rounding of far-off coordinates. */
static double join_tolerance(const pia_model *model)
{
    int width = pia_model_width(model);
    pia_index count = model->control[0] * model->control[1];
    double extent = 0, largest = 0;
    for (int c = 0; c < width; c++) {
        double low = model->points[c], high = low;
        for (pia_index i = 0; i < count; i++) {
            low = fmin(low, model->points[i * width + c]);
            high = fmax(high, model->points[i * width + c]);
        }
        extent = fmax(extent, high - low);
        largest = fmax(largest, fmax(fabs(low), fabs(high)));
    }
    return 1e-9 * extent + 16 * DBL_EPSILON * largest;
}

/* Each derivative is one row at either end; the sizes of the rows say how much rounding the derivative magnifies. */
int pia_model_joins(const pia_model *model, int direction)
{
    enum { WIDTH = PIA_MAX_DEGREE + 1 };
    int degree = model->degree[direction], count = degree + 1;
    pia_index control = model->control[direction], last = control - 1;
    const double *knots = model->knots[direction];
    double start[WIDTH * WIDTH], end[WIDTH * WIDTH];
    pia_basis_derivatives(knots, degree, degree, knots[degree], degree - 1, start);
    pia_basis_derivatives(knots, degree, last, knots[control], degree - 1, end);
    pia_lines lines = pia_model_lines(model, direction);
    double tolerance = join_tolerance(model);
    for (int order = 0; order < degree; order++) {
        const double *a = start + order * count, *b = end + order * count;
        double bound = tolerance * (sum_of_sizes(a, count) + sum_of_sizes(b, count));
        for (pia_index i = 0; i < lines.outer * lines.inner; i++) {
            const double *line = model->points + i / lines.inner * control * lines.inner + i % lines.inner;
            double gap = dot(a, count, line, lines.inner) - dot(b, count, line + (last - degree) * lines.inner, lines.inner);
            if (!(fabs(gap) <= bound)) return 0;
        }
    }
    return 1;
}

/* Clamped knots over the domain of a cyclic vector; returns how many control points they make. */
static pia_index clamp_knots(const double *knots, int degree, pia_index control, double *clamped)
{
    double low = knots[degree], high = knots[control];
    double *next = clamped;
    for (int k = 0; k <= degree; k++) *next++ = low;
    for (pia_index i = degree; i < control; i++)
        if (knots[i] > low && knots[i] < high) *next++ = knots[i];
    pia_index count = next - clamped;
    for (int k = 0; k <= degree; k++) *next++ = high;
    return count;
}

/* Each closed direction in turn. */
static pia_status clamp_points(pia_context *context, const double *const *knots, const pia_index *control, const int *closed,
                               const double *points, pia_model *model)
{
    const int *degree = model->degree;
    pia_rebase first = {knots[0], degree[0], control[0], {1, model->dim}, model->knots[0], model->control[0], pia_basis_blossom};
    if (model->directions == 1) {
        pia_rebase_points(&first, points, model->points);
        return PIA_OK;
    }
    first.lines.inner = control[1] * model->dim;
    pia_rebase second = {knots[1],        degree[1],         control[1],       {model->control[0], model->dim},
                         model->knots[1], model->control[1], pia_basis_blossom};
    if (!closed[0] || !closed[1]) {
        pia_rebase_points(closed[0] ? &first : &second, points, model->points);
        return PIA_OK;
    }
    pia_index between_count = model->control[0] * first.lines.inner;
    double *between = pia_take(context, between_count, sizeof *between);
    if (between == NULL) return pia_take_status(context, between_count, sizeof *between);
    pia_rebase_points(&first, points, between);
    pia_rebase_points(&second, between, model->points);
    pia_give(context, between);
    return PIA_OK;
}

pia_status pia_model_from_cyclic(pia_context *context, int directions, const int *degree, const double *const *knots,
                                 const pia_index *control, const int *closed, int dim, const double *points, pia_model **out)
{
    pia_model *model = NULL;
    pia_status status = pia_model_new(context, directions, degree, control, dim, 0, &model);
    for (int d = 0; status == PIA_OK && d < directions; d++) {
        if (closed[d])
            model->control[d] = clamp_knots(knots[d], degree[d], control[d], model->knots[d]);
        else
            memcpy(model->knots[d], knots[d], (size_t)(control[d] + degree[d] + 1) * sizeof **knots);
        model->periodic[d] = closed[d] && model->control[d] == control[d];
        status = pia_knots_check(context, degree[d], model->knots[d], model->control[d] + degree[d] + 1, model->control[d]);
    }
    if (status == PIA_OK) status = clamp_points(context, knots, control, closed, points, model);
    if (status == PIA_OK)
        status = pia_check_finite(context, "control point", model->points, model->control[0] * model->control[1], dim);
    if (status == PIA_OK)
        *out = model;
    else
        pia_model_destroy(model);
    return status;
}

/* Knot `index` of a clamped vector continued periodically over both ends of its domain, any index. */
static double cyclic_knot(const double *knots, int degree, pia_index control, pia_index index)
{
    pia_index spans = control - degree, offset = index - degree;
    pia_index turns = offset / spans - (offset % spans < 0);
    return knots[index - turns * spans] + (double)turns * (knots[control] - knots[degree]);
}

/* The cyclic control points whose knots reach over the seam, as rows over the clamped ones. Point i of them is also point i + spans,
 * over the other end: the end that has less to extrapolate is taken. */
typedef struct seam {
    pia_index first[PIA_MAX_DEGREE];
    double row[PIA_MAX_DEGREE][PIA_MAX_DEGREE + 1];
} seam;

static void open_seam(const double *knots, int degree, pia_index control, seam *out)
{
    pia_index spans = control - degree;
    for (int i = 0; i < degree; i++) {
        int beyond_start = degree - 1 - i, beyond_end = i;
        pia_index span = beyond_start <= beyond_end ? degree : control - 1;
        pia_index index = beyond_start <= beyond_end ? i : i + spans;
        double arguments[PIA_MAX_DEGREE];
        for (int k = 0; k < degree; k++) arguments[k] = cyclic_knot(knots, degree, control, index + 1 + k);
        pia_basis_blossom(knots, degree, span, arguments, out->row[i]);
        out->first[i] = span - degree;
    }
}

static void unclamp_line(const seam *s, int degree, pia_index control, pia_index stride, double *line)
{
    pia_index spans = control - degree;
    double opened[PIA_MAX_DEGREE];
    for (int i = 0; i < degree; i++) opened[i] = dot(s->row[i], degree + 1, line + s->first[i] * stride, stride);
    for (int i = 0; i < degree && i < spans; i++) line[i * stride] = opened[i];
    for (pia_index i = spans; i < control; i++) line[i * stride] = line[(i - spans) * stride];
}

pia_status pia_model_to_cyclic(pia_context *context, const pia_model *model, double *const *knots, double *points)
{
    if (model->rational) return pia_fail(context, PIA_E_ARGUMENT, "a rational model has no cyclic form here; use a polynomial one");
    for (int d = 0; d < model->directions; d++)
        if (model->periodic[d] && !pia_model_joins(model, d))
            return pia_fail(context, PIA_E_SHAPE, "direction %d is called periodic, but its ends do not join with %d derivatives", d,
                            model->degree[d] - 1);
    memcpy(points, model->points, (size_t)(model->control[0] * model->control[1] * model->dim) * sizeof *points);
    for (int d = 0; d < model->directions; d++) {
        int degree = model->degree[d];
        pia_index control = model->control[d];
        memcpy(knots[d], model->knots[d], (size_t)(control + degree + 1) * sizeof **knots);
        if (!model->periodic[d]) continue;
        for (pia_index i = 0; i <= control + degree; i++) knots[d][i] = cyclic_knot(model->knots[d], degree, control, i);
        seam s;
        open_seam(model->knots[d], degree, control, &s);
        pia_lines lines = pia_model_lines(model, d);
        for (pia_index i = 0; i < lines.outer * lines.inner; i++)
            unclamp_line(&s, degree, control, lines.inner, points + i / lines.inner * control * lines.inner + i % lines.inner);
    }
    return PIA_OK;
}
