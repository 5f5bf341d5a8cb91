/* The one call: open without a copy, run, model, close. */
#include "fit.h"

pia_status pia_fit_data(pia_context *context, const pia_data *data, const pia_fit_options *options, pia_model **model,
                        pia_report *report)
{
    pia_fit *fit;
    pia_status status = pia_fit_borrow(context, data, options, &fit);
    if (status != PIA_OK) return status;
    status = pia_fit_run(fit, report);
    if (status == PIA_OK && model != NULL) status = pia_fit_turn_into_model(fit, model);
    pia_fit_close(fit);
    return status;
}
