#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    pia_context *context = fuzz_context();
    pia_input input = fuzz_input(data, size);
    pia_model **models = NULL;
    pia_index count = 0;
    pia_status status = pia_format_find("g2", NULL)->read_models(context, &input, &models, &count);
    if (status != PIA_OK) fuzz_check_failure(context, status);
    pia_models_destroy(models, count);
    pia_context_destroy(context);
    return 0;
}
