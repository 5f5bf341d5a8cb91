/* GoTools g2: class 100 a curve, class 200 a surface; "dim rational", then count and order, knots of each direction, then control
 * points (w x, w where rational), the first index fastest. Read and written. */
#include "io.h"
#include "number.h"
#include "text.h"

#include <math.h>
#include <string.h>

enum { CURVE = 100, SURFACE = 200 };

/* ---- writing ---- */

static void write_numbers(pia_output *output, const double *value, pia_index count)
{
    for (pia_index i = 0; i < count; i++) {
        if (i > 0) pia_output_bytes(output, " ", 1);
        pia_output_number(output, value[i]);
    }
    pia_output_bytes(output, "\n", 1);
}

static void write_model(pia_output *output, const pia_model *model)
{
    int width = pia_model_width(model);
    pia_output_text(output, "%d 1 0 0\n%d %d\n", model->directions == 1 ? CURVE : SURFACE, model->dim, model->rational);
    for (int d = 0; d < model->directions; d++) {
        pia_output_text(output, "%lld %d\n", (long long)model->control[d], model->degree[d] + 1);
        write_numbers(output, model->knots[d], model->control[d] + model->degree[d] + 1);
    }
    for (pia_index j = 0; j < model->control[1]; j++)
        for (pia_index i = 0; i < model->control[0]; i++)
            write_numbers(output, model->points + (i * model->control[1] + j) * width, width);
    pia_output_bytes(output, "\n", 1);
}

static pia_status write_models(pia_context *context, pia_output *output, const pia_model *const *models, pia_index count,
                               const pia_write_options *options)
{
    (void)context;
    (void)options;
    for (pia_index i = 0; i < count; i++) write_model(output, models[i]);
    return PIA_OK;
}

/* ---- reading ---- */

typedef struct reader {
    pia_context *context;
    const pia_input *input;
    const char *at;
} reader;

static void skip_blanks(reader *r)
{
    while (r->at < r->input->end && (pia_text_is_blank(*r->at) || *r->at == '\n' || *r->at == '\r')) r->at++;
}

static pia_status read_number(reader *r, double *value)
{
    skip_blanks(r);
    const char *after = r->at < r->input->end ? pia_number_parse(r->at, r->input->end, value) : NULL;
    if (after == NULL || !isfinite(*value))
        return pia_input_fail(r->context, r->input, r->at, "a finite number was expected here; the file is cut short or damaged");
    r->at = after;
    return PIA_OK;
}

static pia_status read_count(reader *r, double most, pia_index *out)
{
    double value;
    pia_status status = read_number(r, &value);
    if (status != PIA_OK) return status;
    if (!(value >= 0 && value <= most && value == floor(value)))
        return pia_input_fail(r->context, r->input, r->at, "%g is not a whole number from 0 to %g", value, most);
    *out = (pia_index)value;
    return PIA_OK;
}

/* What a file of this size can hold at most: two characters a number. */
static pia_status check_room(reader *r, pia_index numbers)
{
    if (numbers <= (r->input->end - r->at + 1) / 2) return PIA_OK;
    return pia_input_fail(r->context, r->input, r->at, "the file is too short for the %lld numbers it announces", (long long)numbers);
}

static pia_status read_direction(reader *r, int *degree, pia_index *control, double **knots)
{
    pia_index order = 0, count = 0;
    pia_status status = read_count(r, 9e15, &count);
    if (status == PIA_OK) status = read_count(r, PIA_MAX_DEGREE + 1, &order);
    if (status == PIA_OK && (order < 2 || count < order))
        status = pia_input_fail(r->context, r->input, r->at, "%lld control points of order %lld are no spline", (long long)count,
                                (long long)order);
    if (status == PIA_OK) status = check_room(r, count + order);
    if (status != PIA_OK) return status;
    *degree = (int)order - 1;
    *control = count;
    *knots = pia_take(r->context, count + order, sizeof **knots);
    if (*knots == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < count + order && status == PIA_OK; i++) status = read_number(r, &(*knots)[i]);
    return status;
}

/* Control points, from (w x, w) with the first index fastest to Cartesian ones with the second index fastest. */
static pia_status read_control(reader *r, const pia_index control[2], int dim, int rational, double **points, double **weights)
{
    pia_index count = control[0] * control[1], numbers;
    if (!pia_multiply(count, dim + rational, &numbers))
        return pia_fail(r->context, PIA_E_SIZE, "%s: too many control points", r->input->path);
    pia_status status = check_room(r, numbers);
    if (status != PIA_OK) return status;
    *points = pia_take(r->context, count * dim, sizeof **points);
    *weights = rational ? pia_take(r->context, count, sizeof **weights) : NULL;
    if (*points == NULL || (rational && *weights == NULL)) return PIA_E_MEMORY;
    for (pia_index k = 0; k < count && status == PIA_OK; k++) {
        pia_index at = k % control[0] * control[1] + k / control[0];
        double w = 1;
        for (int d = 0; d < dim && status == PIA_OK; d++) status = read_number(r, *points + at * dim + d);
        if (status == PIA_OK && rational) status = read_number(r, &w);
        if (status == PIA_OK && !(w > 0))
            status = pia_input_fail(r->context, r->input, r->at, "a weight is %g; weights are positive", w);
        if (status != PIA_OK || !rational) continue;
        (*weights)[at] = w;
        for (int d = 0; d < dim; d++) (*points)[at * dim + d] /= w;
    }
    return status;
}

static pia_status read_model(reader *r, pia_model **out)
{
    pia_index class = 0, version, dim = 0, rational = 0, control[2] = {1, 1};
    int degree[2] = {0, 0};
    double *knots[2] = {NULL, NULL}, *points = NULL, *weights = NULL;
    pia_status status = read_count(r, 1000, &class);
    if (status == PIA_OK && class != CURVE && class != SURFACE)
        status = pia_input_fail(r->context, r->input, r->at, "class %lld is not read; 100 is a curve, 200 a surface", (long long)class);
    for (int i = 0; i < 3 && status == PIA_OK; i++) status = read_count(r, 1000, &version);
    if (status == PIA_OK) status = read_count(r, PIA_MAX_DIM, &dim);
    if (status == PIA_OK) status = read_count(r, 1, &rational);
    int directions = class == SURFACE ? 2 : 1;
    if (status == PIA_OK && dim < 1) status = pia_input_fail(r->context, r->input, r->at, "dimension 0 is no space");
    for (int d = 0; d < directions && status == PIA_OK; d++) status = read_direction(r, &degree[d], &control[d], &knots[d]);
    pia_index product;
    if (status == PIA_OK && !pia_multiply(control[0], control[1], &product))
        status = pia_fail(r->context, PIA_E_SIZE, "%s: too many control points", r->input->path);
    if (status == PIA_OK) status = read_control(r, control, (int)dim, (int)rational, &points, &weights);
    if (status == PIA_OK) {
        const double *const *all = (const double *const *)knots;
        status = pia_model_create(r->context, directions, degree, all, control, (int)dim, points, weights, out);
        status = pia_input_judge(r->context, r->input, r->at, "", status);
    }
    pia_give(r->context, knots[0]);
    pia_give(r->context, knots[1]);
    pia_give(r->context, points);
    pia_give(r->context, weights);
    return status;
}

static pia_status read_models(pia_context *context, const pia_input *input, pia_model ***out, pia_index *count)
{
    reader r = {context, input, input->begin};
    pia_model **list = NULL;
    pia_index found = 0, capacity = 0;
    pia_status status = PIA_OK;
    skip_blanks(&r);
    while (r.at < input->end && status == PIA_OK) {
        void *block = list;
        int grown = pia_memory_grow(pia_memory_of(context), &block, &capacity, found + 1, sizeof *list);
        list = block;
        status = grown ? read_model(&r, &list[found]) : pia_fail(context, PIA_E_MEMORY, "%s: out of memory", input->path);
        if (status == PIA_OK) found++;
        skip_blanks(&r);
    }
    if (status == PIA_OK && found == 0) status = pia_input_fail(context, input, NULL, "holds no curve or surface");
    if (status == PIA_OK) {
        *out = list;
        *count = found;
        return PIA_OK;
    }
    for (pia_index i = 0; i < found; i++) pia_model_destroy(list[i]);
    pia_give(context, list);
    return status;
}

const pia_format pia_format_g2 = {
    .name = "g2",
    .title = "GoTools g2, curves and surfaces",
    .detail = "reads and writes models of any dimension, rational or not; several in a file",
    .extensions = "g2",
    .read_models = read_models,
    .write_models = write_models,
    .leaves_trims = 1,
};
