/* The one call: open without a copy, run, model, close. */
#include "fit.h"

static pia_status fit_once(pia_context *context, const pia_data *data, const pia_fit_options *options, int careful, pia_model **model,
                           pia_report *report, int *again)
{
    pia_fit *fit;
    *again = 0;
    pia_status status = pia_fit_borrow(context, data, options, careful, &fit);
    if (status != PIA_OK) {
        *again = !careful && status == PIA_E_DATA;
        return status;
    }
    status = pia_fit_run(fit, NULL);
    *again = !careful && (fit->unseen || fit->iterate.points == NULL);
    if (status == PIA_OK && !*again && report != NULL) status = pia_fit_report(fit, report);
    if (status == PIA_OK && !*again && model != NULL) status = pia_fit_turn_into_model(fit, model);
    pia_fit_close(fit);
    return status;
}

/* Good data need no check of their own, and no start where one step leads to the end. Where they are not, or somebody interrupts, it is
 * told what is wrong with them, or the start is what there is. */
pia_status pia_fit_data(pia_context *context, const pia_data *data, const pia_fit_options *options, pia_model **model,
                        pia_report *report)
{
    int again;
    pia_status status = fit_once(context, data, options, 0, model, report, &again);
    return again ? fit_once(context, data, options, 1, model, report, &again) : status;
}
