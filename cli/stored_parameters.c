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

/* The parameters of a fit, by rows of the points: a closed curve may have been turned. */
static const double *parameters_by_row(struct session *session, pia_fit *fit, const pia_points_info *points, int closed)
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

/* The parameters that the model carries, one for each row of a curve, dropped ones too. */
static const double *spread_parameters(struct session *session, const pia_model *model, const pia_points_info *points, int closed)
{
    pia_index stored, dropped_count, next = 0, used = 0, all = points->count[0];
    const double *parameters = pia_model_parameters(model, &stored), *x = points->points;
    const pia_index *dropped = pia_model_dropped(model, &dropped_count);
    if (!parameters || stored + dropped_count != all) return NULL;
    double *copy = session_keep(session, (size_t)all, sizeof *copy);
    int graph = points->dim > 1;
    for (pia_index i = 0; i < all; i++) {
        int here = next < dropped_count && dropped[next] == i;
        copy[i] = here ? NAN : parameters[used++];
        next += here;
        graph = graph && (here || copy[i] == x[i * points->dim]);
    }
    for (pia_index i = 0; graph && i < all; i++) copy[i] = x[i * points->dim];
    fill_dropped(copy, all, closed);
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
    if (status == PIA_OK) *out = parameters_by_row(session, fit, points, options->closed[0]);
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

const double *stored_parameters(struct session *session, const pia_model *model, const pia_points_info *points)
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
    if (parameters && info.directions == 1) return spread_parameters(session, model, points, info.periodic[0]);
    if (parameters || !pia_model_report(model, &report) || report.kind != points->kind) return NULL;
    if (report.point_count + (info.directions == 1 ? report.repaired_count : 0) != all) return NULL;
    if (!registry_has("parametrization", report.parametrization)) return NULL;
    return parameters_of_report(session, model, points, &report);
}
