#include "fuzz.h"

#include <sys/mman.h>
#include <unistd.h>

static void check_trim(const pia_trim *a, const pia_trim *b)
{
    PROMISE((a == NULL) == (b == NULL));
    if (a == NULL) return;
    PROMISE(a->loop_count == b->loop_count && a->loop_count > 0);
    for (pia_index l = 0; l <= a->loop_count; l++) PROMISE(a->start[l] == b->start[l]);
    PROMISE(memcmp(a->uv, b->uv, (size_t)a->start[a->loop_count] * 2 * sizeof(double)) == 0);
}

/* Standard output goes to memory: each input writes a file, and a disk would make that the slowest part by far. */
static int output_in_memory(void)
{
    static int file = -1;
    if (file >= 0) return file;
    file = memfd_create("output", 0);
    PROMISE(file >= 0 && dup2(file, STDOUT_FILENO) == STDOUT_FILENO);
    return file;
}

/* What can be read can be written, and then reads as the same bits. */
static void write_and_read(pia_context *context, const pia_format *format, pia_model **models, pia_index count)
{
    const pia_model *const *written = (const pia_model *const *)models;
    pia_model **back = NULL;
    pia_index back_count = 0;
    int file = output_in_memory();
    PROMISE(ftruncate(file, 0) == 0 && lseek(file, 0, SEEK_SET) == 0);
    PROMISE(pia_model_write(context, "-", format->name, written, count, PIA_AUTO) == PIA_OK);
    size_t size = (size_t)lseek(file, 0, SEEK_CUR);
    uint8_t *text = malloc(size);
    PROMISE(text != NULL && pread(file, text, size, 0) == (ssize_t)size);
    pia_input input = fuzz_input(text, size);
    PROMISE(format->read_models(context, &input, &back, &back_count) == PIA_OK);
    free(text);
    PROMISE(back_count == count);
    for (pia_index k = 0; k < count; k++) {
        const pia_model *a = models[k], *b = back[k];
        PROMISE(a->directions == b->directions && a->dim == b->dim && a->rational == b->rational);
        size_t values = (size_t)(a->control[0] * a->control[1] * pia_model_width(a));
        PROMISE(memcmp(a->points, b->points, values * sizeof(double)) == 0);
        check_trim(a->trim, b->trim);
    }
    pia_models_destroy(back, back_count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    pia_context *context = fuzz_context();
    pia_input input = fuzz_input(data, size);
    pia_model **models = NULL;
    pia_index count = 0;
    const pia_format *format = pia_format_find("json", NULL);
    pia_status status = format->read_models(context, &input, &models, &count);
    if (status == PIA_OK)
        write_and_read(context, format, models, count);
    else
        fuzz_check_failure(context, status);
    pia_models_destroy(models, count);
    pia_context_destroy(context);
    return 0;
}
