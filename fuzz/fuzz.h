/* What the targets share. A target reads its input as a file in memory; the sanitizers see any byte touched outside. Broken promises
 * end the process like a crash. */
#ifndef PIA_FUZZ_FUZZ_H
#define PIA_FUZZ_FUZZ_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define PROMISE(condition) ((condition) ? (void)0 : fuzz_broken(#condition, __FILE__, __LINE__))

static inline void fuzz_broken(const char *condition, const char *file, int line)
{
    fprintf(stderr, "%s:%d: broken promise: %s\n", file, line, condition);
    abort();
}

static inline pia_context *fuzz_context(void)
{
    pia_context_options options;
    pia_context *context = NULL;
    pia_context_options_init(&options);
    options.threads = 1;
    PROMISE(pia_context_create(&options, &context) == PIA_OK);
    return context;
}

static inline pia_input fuzz_input(const uint8_t *data, size_t size)
{
    const char *begin = (const char *)data;
    return (pia_input){.path = "input", .begin = begin, .end = begin + size};
}

/* A failure of a reader is one that the file explains, in one line. */
static inline void fuzz_check_failure(pia_context *context, pia_status status)
{
    const char *message = pia_message(context);
    PROMISE(status == PIA_E_FORMAT || status == PIA_E_ARGUMENT || status == PIA_E_MEMORY || status == PIA_E_SIZE);
    PROMISE(message[0] != '\0' && strchr(message, '\n') == NULL);
}

static inline void fuzz_check_points(const pia_points *points, const pia_points_options *options)
{
    pia_index count = points->count[0] * points->count[1];
    PROMISE(points->count[0] > 0 && points->count[1] > 0 && points->dim > 0 && points->dim <= PIA_MAX_DIM);
    for (pia_index i = 0; i < count * points->dim; i++)
        PROMISE(isfinite(points->points[i]) || (options->allow_nan && isnan(points->points[i])));
    PROMISE(points->part == NULL || (points->part[0] == 0 && points->part[points->part_count] == points->count[0]));
    for (pia_index i = 0; points->part != NULL && i < points->part_count; i++) PROMISE(points->part[i] < points->part[i + 1]);
    for (pia_index i = 1; points->row != NULL && i < points->count[0]; i++) PROMISE(points->row[i - 1] < points->row[i]);
    PROMISE((points->row != NULL) == (points->skipped > 0));
}

/* Reads the input with every kind of options that changes the way through the reader. */
static inline int fuzz_points(const pia_format *format, const uint8_t *data, size_t size)
{
    static const pia_points_options way[] = {
        {.struct_size = sizeof *way},
        {.struct_size = sizeof *way, .skip_invalid = 1, .columns = "2,x"},
        {.struct_size = sizeof *way, .grid = 1, .allow_nan = 1},
        {.struct_size = sizeof *way, .skip_invalid = 1},
    };
    pia_context *context = fuzz_context();
    for (size_t w = 0; w < sizeof way / sizeof *way; w++) {
        pia_input input = fuzz_input(data, size);
        pia_points points = {.memory = context->memory};
        pia_status status = format->read_points(context, &input, &way[w], &points);
        if (status == PIA_OK)
            fuzz_check_points(&points, &way[w]);
        else
            fuzz_check_failure(context, status);
        pia_points_clear(&points);
    }
    pia_context_destroy(context);
    return 0;
}

#endif
