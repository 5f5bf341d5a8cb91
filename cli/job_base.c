/* --param MODEL: scattered points take the parameters of their foot points on a surface. */
#include "fit_job.h"
#include "model_source.h"

static int check_base(const struct fit_job *job, const char *path, const pia_model_info *info)
{
    if (job->kind != PIA_SCATTERED)
        return fail(EXIT_USAGE, "--param %s: a base surface gives parameters to scattered points; write --surface", path);
    if (info->directions != 2) return fail(EXIT_DATA, "%s: is a curve; scattered points need a base surface", path);
    if (info->dim != job->points.info.dim)
        return fail(EXIT_DATA, "%s: has %d components, the points have %d; choose --columns", path, info->dim, job->points.info.dim);
    return EXIT_DONE;
}

static int find_feet(struct fit_job *job, const char *path, const pia_model *base)
{
    pia_model_info info = {.struct_size = sizeof info};
    const pia_points_info *points = &job->points.info;
    pia_model_get_info(base, &info);
    int code = check_base(job, path, &info);
    if (code) return code;
    double *uv = session_keep(job->session, (size_t)points->count[0], 2 * sizeof *uv);
    pia_status status = pia_model_closest(job->session->context, base, points->points, points->count[0], uv, NULL);
    code = session_check(job->session, status, path);
    if (code) return code;
    for (pia_index i = 0; i < 2 * points->count[0]; i++) {
        const double *domain = info.domain[i % 2];
        uv[i] = (uv[i] - domain[0]) / (domain[1] - domain[0]);
        if (info.periodic[i % 2] && uv[i] >= 1) uv[i] = 0;
    }
    for (int d = 0; d < 2; d++) job->request->options.closed[d] |= info.periodic[d];
    job->parameters = (struct numbers){.path = path, .value = uv, .count = 2 * points->count[0]};
    return EXIT_DONE;
}

int fit_base_open(struct fit_job *job, const char *path)
{
    struct model_set models;
    const pia_model *base;
    int code = models_open(job->session, path, NULL, &models);
    if (code) return code;
    code = models_choose(&models, PIA_AUTO, &base);
    if (!code) code = find_feet(job, path, base);
    models_close(&models);
    return code;
}
