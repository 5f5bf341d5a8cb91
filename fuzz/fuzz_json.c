#include "fuzz.h"

#include <unistd.h>

static void check_trim(const pia_trim *a, const pia_trim *b)
{
    PROMISE((a == NULL) == (b == NULL));
    if (a == NULL) return;
    PROMISE(a->loop_count == b->loop_count && a->loop_count > 0);
    for (pia_index l = 0; l <= a->loop_count; l++) PROMISE(a->start[l] == b->start[l]);
    PROMISE(memcmp(a->uv, b->uv, (size_t)a->start[a->loop_count] * 2 * sizeof(double)) == 0);
}

/* What can be read can be written, and then reads as the same bits. */
static void write_and_read(pia_context *context, pia_model **models, pia_index count)
{
    char path[64];
    snprintf(path, sizeof path, "/tmp/pia-fuzz-%ld.json", (long)getpid());
    const pia_model *const *written = (const pia_model *const *)models;
    pia_model **back = NULL;
    pia_index back_count = 0;
    PROMISE(pia_model_write(context, path, NULL, written, count, PIA_AUTO) == PIA_OK);
    PROMISE(pia_model_read(context, path, NULL, &back, &back_count) == PIA_OK);
    PROMISE(back_count == count);
    for (pia_index k = 0; k < count; k++) {
        const pia_model *a = models[k], *b = back[k];
        PROMISE(a->directions == b->directions && a->dim == b->dim && a->rational == b->rational);
        size_t values = (size_t)(a->control[0] * a->control[1] * pia_model_width(a));
        PROMISE(memcmp(a->points, b->points, values * sizeof(double)) == 0);
        check_trim(a->trim, b->trim);
    }
    pia_models_destroy(back, back_count);
    unlink(path);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    pia_context *context = fuzz_context();
    pia_input input = fuzz_input(data, size);
    pia_model **models = NULL;
    pia_index count = 0;
    pia_status status = pia_format_find("json", NULL)->read_models(context, &input, &models, &count);
    if (status == PIA_OK)
        write_and_read(context, models, count);
    else
        fuzz_check_failure(context, status);
    pia_models_destroy(models, count);
    pia_context_destroy(context);
    return 0;
}
