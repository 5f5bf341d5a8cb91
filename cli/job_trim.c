/* --trim: surfaces over scattered points end where the points end. */
#include <string.h>

#include "fit_job.h"

/* Those of the fit, or, of more points than a model remembers, foot points. */
static pia_status parameters_of(struct fit_job *job, const pia_model *model, const double **uv, pia_index *count)
{
    const pia_points_info *points = &job->points.info;
    *uv = pia_model_parameters(model, count);
    *count /= 2;
    if (*uv) return PIA_OK;
    double *feet = session_keep(job->session, (size_t)points->count[0], 2 * sizeof *feet);
    *uv = feet;
    *count = points->count[0];
    return pia_model_closest(job->session->context, model, points->points, *count, feet, NULL);
}

static int trim(struct fit_job *job, pia_model **model)
{
    const struct fit_request *request = job->request;
    const double *uv;
    pia_index count;
    pia_model *trimmed = NULL;
    pia_outline_options options;
    pia_outline_options_init(&options);
    options.hull = request->trim && strcmp(request->trim, "hull") == 0;
    options.radius = request->trim_radius;
    pia_status status = parameters_of(job, *model, &uv, &count);
    if (status == PIA_OK) status = pia_model_trim_to_points(job->session->context, *model, uv, count, &options, &trimmed);
    if (status == PIA_E_DATA) {
        session_warn(job->session, "the surface is not trimmed: %s", pia_message(job->session->context));
        return EXIT_DONE;
    }
    if (status == PIA_OK) {
        pia_model_destroy(*model);
        *model = trimmed;
    }
    return session_check(job->session, status, request->source.path);
}

int fit_trim(struct fit_job *job)
{
    const char *how = job->request->trim;
    int code = EXIT_DONE;
    if (!job->points.file || job->kind != PIA_SCATTERED || (how && strcmp(how, "none") == 0)) return code;
    for (pia_index k = 0; k < job->part_done; k++)
        for (pia_index level = 0; !code && level < job->result[k].level_done; level++) code = trim(job, &job->result[k].model[level]);
    return code;
}
