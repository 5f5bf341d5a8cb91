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

/* A row that a fit dropped repeats another: the last one of a closed curve the first, else the one before. NAN marks those rows. */
static void fill_dropped(double *parameters, pia_index count, int closed)
{
    if (closed && isnan(parameters[count - 1])) parameters[count - 1] = parameters[0];
    for (pia_index i = 1; i < count; i++)
        if (isnan(parameters[i])) parameters[i] = parameters[i - 1];
}

/* A closed curve may have been turned. */
const double *fit_parameters(struct session *session, pia_fit *fit, const pia_points_info *points, int closed)
{
    const double *parameters = NULL;
    const pia_index *row = NULL, *size = points->count;
    pia_index count = 0;
    if (pia_fit_parameters(fit, &parameters, &count, &row) != PIA_OK || !parameters) return NULL;
    if (points->kind == PIA_GRID)
        return count == size[0] + size[1] ? grid_parameters(session, parameters, parameters + size[0], size) : NULL;
    double *copy = session_keep(session, (size_t)size[0], sizeof *copy);
    for (pia_index i = 0; i < size[0]; i++) copy[i] = row ? NAN : parameters[i];
    for (pia_index i = 0; row && i < count; i++) copy[row[i]] = parameters[i];
    fill_dropped(copy, size[0], closed);
    return copy;
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
    if (status == PIA_OK) *out = fit_parameters(session, fit, points, options->closed[0]);
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
                            pia_index dropped_count, int graph, int closed)
{
    pia_index count = points->count[0];
    double *all = session_keep(session, (size_t)count, sizeof *all);
    for (pia_index i = 0, next = 0; i < count; i++)
        if (next < dropped_count && dropped[next] == i) {
            all[i] = graph ? points->points[i * points->dim] : NAN;
            next++;
        } else
            all[i] = *parameters++;
    fill_dropped(all, count, closed);
    return all;
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
    return spread(session, parameters, points, dropped, dropped_count, are_abscissas(parameters, &used), info.periodic[0]);
}
