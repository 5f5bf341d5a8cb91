/* The base surface of a cloud, chosen by trial: over the parameters of each a surface of 8 x 8 control points, faired a little, is
 * fitted to at most 20000 of the points. The base over which that comes closest (RMS) is the one over which the points are most nearly
 * the graph of a smooth function, which is what a fit to a tolerance needs. A later base of the list has to be closer by a tenth:
 * planes are simpler than cylinders, and those than spheres, whose poles squeeze parameters. */
#include "fit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TRIAL_CONTROL = 8, TRIAL_POINTS = 20000 };

static const double TRIAL_FAIRING = 1e-4, CLOSER = 0.9;

/* Every few of the points. The caller gives it back. */
static double *take_sample(const pia_fit *fit, pia_index *count)
{
    pia_index step = (fit->rows + TRIAL_POINTS - 1) / TRIAL_POINTS;
    *count = (fit->rows + step - 1) / step;
    double *sample = pia_take(fit->context, *count * fit->dim, sizeof *sample);
    for (pia_index i = 0; sample != NULL && i < *count; i++)
        memcpy(sample + i * fit->dim, fit->points + i * step * fit->dim, (size_t)fit->dim * sizeof *sample);
    return sample;
}

/* The RMS deviation of the trial surface; PIA_E_DATA where the points have no parameters on this base. */
static pia_status try_base(pia_fit *fit, const pia_cloud *base, const double *points, pia_index count, double *rms)
{
    int around;
    pia_data data;
    pia_fit_options options;
    pia_report report = {.struct_size = sizeof report};
    double *uv = pia_take(fit->context, 2 * count, sizeof *uv);
    if (uv == NULL) return pia_take_status(fit->context, 2 * count, sizeof *uv);
    pia_status status = base->compute(fit->context, points, count, fit->dim, uv, &around);
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.kind = PIA_SCATTERED;
    data.points = points;
    data.count[0] = count;
    data.dim = fit->dim;
    data.parameters = uv;
    options.control[0] = options.control[1] = TRIAL_CONTROL;
    options.closed[0] = around;
    options.fairing = TRIAL_FAIRING;
    options.method = "direct";
    if (status == PIA_OK) status = pia_fit_data(fit->context, &data, &options, NULL, &report);
    if (status == PIA_OK) *rms = report.rms_error;
    pia_give(fit->context, uv);
    return status;
}

pia_status pia_fit_choose_base(pia_fit *fit)
{
    static const char *const candidate[] = {"plane", "cylinder", "sphere"};
    char tried[160] = "";
    double best = INFINITY;
    pia_index count;
    if (fit->dim < 3) {
        fit->cloud = pia_cloud_find("xy");
        return PIA_OK;
    }
    double *sample = take_sample(fit, &count);
    if (sample == NULL) return pia_take_status(fit->context, count * fit->dim, sizeof *sample);
    pia_status status = PIA_OK;
    for (size_t k = 0; k < sizeof candidate / sizeof *candidate && (status == PIA_OK || status == PIA_E_DATA); k++) {
        const pia_cloud *base = pia_cloud_find(candidate[k]);
        double rms = INFINITY;
        status = try_base(fit, base, sample, count, &rms);
        if (status != PIA_OK) continue;
        size_t used = strlen(tried);
        snprintf(tried + used, sizeof tried - used, "%s%s %.3g", used > 0 ? ", " : "", base->name, rms);
        if (!(rms < CLOSER * best)) continue;
        best = rms;
        fit->cloud = base;
    }
    pia_give(fit->context, sample);
    if (fit->cloud == NULL || (status != PIA_OK && status != PIA_E_DATA)) return status;
    pia_fit_note_add(fit, "method: parameters %s, over which a surface of %d x %d control points comes closest; rms %s",
                     fit->cloud->name, TRIAL_CONTROL, TRIAL_CONTROL, tried);
    return PIA_OK;
}
