#include "cad.h"

#include "number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

pia_status pia_cad_check(pia_context *context, const char *format, const pia_model *const *models, pia_index count)
{
    for (pia_index i = 0; i < count; i++)
        if (models[i]->dim < 2 || models[i]->dim > 3)
            return pia_fail(context, PIA_E_ARGUMENT,
                            "%s holds curves and surfaces in space, not models of dimension %d; choose columns x,y or x,y,z", format,
                            models[i]->dim);
    return PIA_OK;
}

int pia_cad_real(double value, char text[PIA_CAD_REAL_SIZE])
{
    char number[PIA_NUMBER_SIZE];
    int length = pia_number_format(value, number), used = 0, point = 0;
    for (int i = 0; i < length; i++) {
        int exponent = number[i] == 'e' || number[i] == 'E';
        if (number[i] == '.') point = 1;
        if (exponent && !point) text[used++] = '.';
        if (exponent) point = 1;
        text[used++] = exponent ? 'E' : number[i];
    }
    if (!point) text[used++] = '.';
    text[used] = '\0';
    return used;
}

void pia_cad_point(const pia_model *model, pia_index i, double xyz[3], double *weight)
{
    const double *p = model->points + i * pia_model_width(model);
    *weight = model->rational ? p[model->dim] : 1;
    for (int d = 0; d < 3; d++) xyz[d] = d < model->dim ? (model->rational ? p[d] / *weight : p[d]) : 0;
}

pia_index pia_cad_run(const double *knots, pia_index count, pia_index from)
{
    pia_index length = 1;
    while (from + length < count && knots[from + length] == knots[from]) length++;
    return length;
}

/* The largest distance from one control point to another of each pair, over the largest coordinate. */
static double distance(const pia_model *model, pia_index i, pia_index j)
{
    double a[3], b[3], w, square = 0;
    pia_cad_point(model, i, a, &w);
    pia_cad_point(model, j, b, &w);
    for (int d = 0; d < 3; d++) square += (a[d] - b[d]) * (a[d] - b[d]);
    return sqrt(square);
}

double pia_cad_size(const pia_model *model)
{
    double size = 0;
    pia_index count = model->control[0] * model->control[1];
    for (pia_index i = 0; i < count; i++) size = fmax(size, distance(model, 0, i));
    return size;
}

void pia_cad_name(const pia_write_options *options, pia_index index, pia_index count, char name[PIA_CAD_NAME_SIZE])
{
    enum { NUMBER = 21 };
    int used = snprintf(name, PIA_CAD_NAME_SIZE - NUMBER, "%s", options->name);
    if (used >= PIA_CAD_NAME_SIZE - NUMBER) used = PIA_CAD_NAME_SIZE - NUMBER - 1;
    for (char *c = name; *c != '\0'; c++)
        if (*c < ' ' || *c > '~' || strchr("'\\,;", *c) != NULL) *c = '_';
    if (count > 1) snprintf(name + used, NUMBER, " %lld", (long long)index + 1);
}

double pia_cad_tolerance(const pia_write_options *options, const pia_model *const *models, pia_index count)
{
    double size = 0;
    if (options->tolerance > 0) return options->tolerance;
    for (pia_index i = 0; i < count; i++) size = fmax(size, pia_cad_size(models[i]));
    return size > 0 && size < 1 ? 1e-7 * size : 1e-7;
}

/* First and last line of control points across `direction`, in pairs: whether `differ` finds none that differs by more than near. */
static int ends_agree(const pia_model *model, int direction, double (*differ)(const pia_model *, pia_index, pia_index), double near)
{
    pia_index other = model->directions == 1 ? 1 : model->control[1 - direction], stride = direction == 0 ? model->control[1] : 1;
    for (pia_index k = 0; k < other; k++) {
        pia_index first = k * (direction == 0 ? 1 : model->control[1]);
        if (differ(model, first, first + (model->control[direction] - 1) * stride) > near) return 0;
    }
    return 1;
}

static double weight_difference(const pia_model *model, pia_index i, pia_index j)
{
    double xyz[3], a, b;
    pia_cad_point(model, i, xyz, &a);
    pia_cad_point(model, j, xyz, &b);
    return fabs(a - b);
}

int pia_cad_is_closed(const pia_model *model, int direction)
{
    return ends_agree(model, direction, distance, 1e-12 * pia_cad_size(model));
}

int pia_cad_is_closed_alike(const pia_model *model, int direction)
{
    return pia_cad_is_closed(model, direction) && ends_agree(model, direction, weight_difference, 0);
}

int pia_cad_is_degenerate(const pia_model *model, int along, int last)
{
    pia_index count = model->control[along], stride = along == 0 ? model->control[1] : 1;
    pia_index across = along == 0 ? 1 : model->control[1], first = last ? (model->control[1 - along] - 1) * across : 0;
    double near = 1e-12 * pia_cad_size(model);
    for (pia_index k = 1; k < count; k++)
        if (distance(model, first, first + k * stride) > near) return 0;
    return 1;
}
