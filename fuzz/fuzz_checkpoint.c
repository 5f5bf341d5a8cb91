#include "checkpoint.h"
#include "crc32c.h"
#include "fuzz.h"

static void read_sections(pia_context *context, pia_checkpoint *checkpoint)
{
    static const char *const name[] = {"reals", "counts", "method", "a"};
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        for (int type = PIA_SECTION_DOUBLE; type <= PIA_SECTION_TEXT; type++) {
            void *data = NULL;
            pia_index count = 0, told = 0;
            pia_status status = pia_checkpoint_get(checkpoint, name[i], (pia_section_type)type, &data, &count);
            PROMISE((status == PIA_OK) == pia_checkpoint_has(checkpoint, name[i], (pia_section_type)type, &told));
            PROMISE(status != PIA_OK || (count == told && count >= 0));
            pia_give(context, data);
        }
    }
}

static void scan(pia_context *context, const uint8_t *data, size_t size)
{
    pia_input input = fuzz_input(data, size);
    pia_checkpoint *checkpoint = NULL;
    pia_status status = pia_checkpoint_scan(context, &input, &checkpoint);
    if (status == PIA_OK)
        read_sections(context, checkpoint);
    else
        fuzz_check_failure(context, status);
    pia_checkpoint_close(checkpoint);
}

/* The input as it is, and as the values of a section of a file whose checksums are right. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    pia_context *context = fuzz_context();
    scan(context, data, size);
    uint8_t *file = malloc(size + 28);
    PROMISE(file != NULL);
    memcpy(file, "PIACKPT\n\1\0\0\0", 12);
    memcpy(file + 12, data, size);
    uint32_t crc = pia_crc32c(0, data, size);
    for (int i = 0; i < 4; i++) file[12 + size + (size_t)i] = (uint8_t)(crc >> 8 * i);
    static const uint8_t end[8] = {0, 0, 0, 0, 1, 0, 0, 0};
    memcpy(file + 16 + size, end, sizeof end);
    crc = pia_crc32c(0, end, sizeof end);
    for (int i = 0; i < 4; i++) file[24 + size + (size_t)i] = (uint8_t)(crc >> 8 * i);
    scan(context, file, size + 28);
    free(file);
    pia_context_destroy(context);
    return 0;
}
