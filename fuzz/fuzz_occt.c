#include "fuzz.h"

#include "occt.h"

/* What the plug-in says, whatever it says. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    pia_context *context = fuzz_context();
    pia_input input = fuzz_input(data, size);
    pia_model **models = NULL;
    pia_index count = 0;
    pia_status status = pia_occt_parse(context, &input, input.begin, (pia_index)size, &models, &count);
    if (status == PIA_OK)
        PROMISE(count > 0);
    else
        fuzz_check_failure(context, status);
    pia_models_destroy(models, count);
    pia_context_destroy(context);
    return 0;
}
