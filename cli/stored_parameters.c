#include "stored_parameters.h"

#include <math.h>
#include <string.h>

#include "registry.h"

const double *grid_parameters(struct session *session, const double *u, const double *v, const pia_index count[2])
{
    double *pairs = session_keep(session, (size_t)(count[0] * count[1]), 2 * sizeof *pairs), *to = pairs;
    for (pia_index i = 0; i < count[0]; i++)
        for (pia_index j = 0; j < count[1]; j++) {
            *to++ = u[i];
            *to++ = v[j];
        }
    return pairs;
}

/* How far apart two rows may be that are one point for a fit: the end of a closed curve may miss its start by rounding. */
static double reach_of(const pia_points_info *points)
{
    double square = 0;
    for (int d = 0; d < points->dim; d++) {
        double low = INFINITY, high = -INFINITY;
        for (pia_index i = 0; i < points->count[0] * points->count[1]; i++) {
            low = fmin(low, points->points[i * points->dim + d]);
            high = fmax(high, points->points[i * points->dim + d]);
        }
        square += (high - low) * (high - low);
    }
    return 1e-14 * sqrt(square);
}

static int same_row(const pia_points_info *points, pia_index i, pia_index j, double reach)
{
    const double *a = points->points + i * points->dim, *b = points->points + j * points->dim;
    double square = 0;
    for (int d = 0; d < points->dim; d++) square += isnan(a[d]) && isnan(b[d]) ? 0 : (a[d] - b[d]) * (a[d] - b[d]);
    return sqrt(square) <= reach;
}

/* Rows that a fit did not use take the parameter of the row that they repeat: the one before, or the first where a curve is closed.
 * Returns 0 when a row repeats neither. A row without parameter is NAN. */
static int fill_repeated(const pia_points_info *points, int width, double *parameter)
{
    double reach = reach_of(points);
    for (pia_index i = 0; i < points->count[0]; i++) {
        if (!isnan(parameter[i * width])) continue;
        pia_index same = i && same_row(points, i, i - 1, reach) ? i - 1 : 0;
        if (isnan(parameter[same * width]) || !same_row(points, i, same, reach)) return 0;
        memcpy(parameter + i * width, parameter + same * width, (size_t)width * sizeof *parameter);
    }
    return 1;
}

/* `width` numbers for each of the `count` rows used. A closed curve may have been turned. */
static const double *parameters_by_row(struct session *session, const pia_points_info *points, const double *parameters,
                                       pia_index count, int width, const pia_index *row)
{
    if (count > points->count[0] || (count < points->count[0] && !row)) return NULL;
    double *copy = session_keep(session, (size_t)points->count[0], (size_t)width * sizeof *copy);
    for (pia_index i = 0; i < points->count[0] * width; i++) copy[i] = NAN;
    for (pia_index i = 0; i < count; i++)
        memcpy(copy + (row ? row[i] : i) * width, parameters + i * width, (size_t)width * sizeof *copy);
    return fill_repeated(points, width, copy) ? copy : NULL;
}

/* Whether the last line of a grid in a direction repeats the first one: a fit closed there has dropped it. */
static int repeats_line(const pia_points_info *points, int direction)
{
    const pia_index *count = points->count, step = direction ? count[1] : 1, last = (count[direction] - 1) * (direction ? 1 : count[1]);
    double reach = reach_of(points);
    for (pia_index k = 0; k < count[1 - direction]; k++)
        if (!same_row(points, k * step, k * step + last, reach)) return 0;
    return 1;
}

static const double *parameters_of_grid(struct session *session, const pia_points_info *points, const double *parameters,
                                        pia_index count)
{
    const pia_index *size = points->count;
    int shorter[2] = {0, 0};
    for (int d = 0; d < 2 && count != size[0] + size[1]; d++) shorter[d] = repeats_line(points, d);
    if (count != size[0] - shorter[0] + size[1] - shorter[1]) return NULL;
    double *line[2];
    for (int d = 0; d < 2; d++) {
        line[d] = session_keep(session, (size_t)size[d], sizeof *line[d]);
        memcpy(line[d], parameters, (size_t)(size[d] - shorter[d]) * sizeof *parameters);
        if (shorter[d]) line[d][size[d] - 1] = line[d][0];
        parameters += size[d] - shorter[d];
    }
    return grid_parameters(session, line[0], line[1], size);
}

const double *fit_parameters(struct session *session, pia_fit *fit, const pia_points_info *points)
{
    const double *parameters = NULL;
    const pia_index *row = NULL;
    pia_index count = 0;
    if (pia_fit_parameters(fit, &parameters, &count, &row) != PIA_OK || !parameters) return NULL;
    if (points->kind == PIA_GRID) return parameters_of_grid(session, points, parameters, count);
    int width = points->kind == PIA_SCATTERED ? 2 : 1;
    return parameters_by_row(session, points, parameters, count / width, width, row);
}

/* Those of a fit with these options that does not iterate. */
static pia_status parameters_of_fit(struct session *session, const pia_points_info *points, pia_fit_options *options,
                                    const double **out)
{
    pia_data data;
    pia_fit *fit = NULL;
    *out = NULL;
    pia_data_init(&data);
    data.kind = points->kind;
    data.points = points->points;
    data.dim = points->dim;
    memcpy(data.count, points->count, sizeof data.count);
    options->max_iterations = 0;
    pia_status status = pia_fit_open(session->context, &data, options, &fit);
    if (status == PIA_OK) *out = fit_parameters(session, fit, points);
    pia_fit_close(fit);
    return status;
}

/* A fit that begins at the model. */
static void begin_at(const pia_model *model, pia_fit_options *options)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    options->start = model;
    options->method = "lspia"; /* which takes any number of control points */
    for (int d = 0; d < info.directions; d++) options->closed[d] = info.periodic[d];
}

pia_status named_parameters(struct session *session, const pia_model *model, const pia_points_info *points, const char *name,
                            const double **out)
{
    pia_fit_options options;
    pia_fit_options_init(&options);
    begin_at(model, &options);
    options.parametrization = name;
    return parameters_of_fit(session, points, &options, out);
}

/* The 2004 format measures chords in a way of its own, which a start model does not tell. */
static const double *parameters_of_report(struct session *session, const pia_model *model, const pia_points_info *points,
                                          const pia_report *report)
{
    const double *parameters;
    pia_fit_options options;
    pia_fit_options_init(&options);
    if (strcmp(report->placement, "pia2004") == 0) {
        options.method = "pia";
        options.placement = report->placement;
    } else
        begin_at(model, &options);
    options.parametrization = report->parametrization;
    parameters_of_fit(session, points, &options, &parameters);
    return parameters;
}

/* The rows that the fit of a curve used. */
static pia_points_info used_points(struct session *session, const pia_points_info *points, const pia_index *dropped,
                                   pia_index dropped_count)
{
    pia_points_info used = *points;
    size_t row = (size_t)points->dim * sizeof(double);
    double *to = session_keep(session, (size_t)points->count[0], row);
    used.points = to;
    for (pia_index i = 0, next = 0; i < points->count[0]; i++)
        if (next < dropped_count && dropped[next] == i)
            next++;
        else {
            memcpy(to, points->points + i * points->dim, row);
            to += points->dim;
        }
    used.count[0] -= dropped_count;
    return used;
}

/* Whether these are the first components: those of a function graph, whose rows of equal abscissa differ. */
static int are_abscissas(const double *parameters, const pia_points_info *points)
{
    for (pia_index i = 0; i < points->count[0]; i++)
        if (points->dim < 2 || parameters[i] != points->points[i * points->dim]) return 0;
    return 1;
}

/* Parameters of all rows of a curve from those of the rows used. */
static const double *spread(struct session *session, const double *parameters, const pia_points_info *points, const pia_index *dropped,
                            pia_index dropped_count, int graph)
{
    pia_index count = points->count[0];
    double *all = session_keep(session, (size_t)count, sizeof *all);
    for (pia_index i = 0, next = 0; i < count; i++)
        if (next < dropped_count && dropped[next] == i) {
            all[i] = graph ? points->points[i * points->dim] : NAN;
            next++;
        } else
            all[i] = *parameters++;
    return fill_repeated(points, 1, all) ? all : NULL;
}

/* Those of the points that the model was fitted to, dropped rows left out; NULL for others. */
static const double *parameters_used(struct session *session, const pia_model *model, const pia_points_info *points)
{
    pia_index stored;
    pia_model_info info = {.struct_size = sizeof info};
    pia_report report = {.struct_size = sizeof report};
    const pia_index *count = points->count, all = count[0] * count[1];
    const double *parameters = pia_model_parameters(model, &stored);
    pia_model_get_info(model, &info);
    if (parameters && stored == info.directions * all) return parameters;
    if (parameters && info.directions == 2 && stored == count[0] + count[1])
        return grid_parameters(session, parameters, parameters + count[0], count);
    if (parameters || !pia_model_report(model, &report) || report.kind != points->kind || report.point_count != all) return NULL;
    if (!registry_has("parametrization", report.parametrization)) return NULL;
    return parameters_of_report(session, model, points, &report);
}

const double *stored_parameters(struct session *session, const pia_model *model, const pia_points_info *points)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_index dropped_count;
    const pia_index *dropped = pia_model_dropped(model, &dropped_count);
    pia_model_get_info(model, &info);
    if (info.directions == 2 || !dropped_count || dropped[dropped_count - 1] >= points->count[0])
        return parameters_used(session, model, points);
    pia_points_info used = used_points(session, points, dropped, dropped_count);
    const double *parameters = parameters_used(session, model, &used);
    if (!parameters) return NULL;
    return spread(session, parameters, points, dropped, dropped_count, are_abscissas(parameters, &used));
}
