/* Formats: reader and writer of one file format, one file each. */
#ifndef PIA_IO_IO_H
#define PIA_IO_IO_H

#include "context.h"
#include "model.h"
#include "output.h"

/* A file in memory (read whole or mapped), standard input for "-". */
typedef struct pia_input {
    const char *path; /* as the messages name it */
    const char *begin, *end;
    int mapped;
} pia_input;

pia_status pia_input_open(pia_context *context, const char *path, pia_input *out);
void pia_input_close(pia_context *context, pia_input *input);

/* What a reader of points fills in; arrays taken with pia_take. The public pia_points wraps it. */
struct pia_points {
    pia_memory memory;
    pia_kind kind;
    double *points;
    pia_index count[2];
    int dim;
    pia_index part_count, *part;
    pia_index skipped, *row;
    char **names;
    const char *format;
};

typedef struct pia_format {
    const char *name, *title, *reference, *detail;
    const char *extensions; /* "csv txt xyz dat" */
    pia_status (*read_points)(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *out);
    pia_status (*read_models)(pia_context *context, const pia_input *input, pia_model ***out, pia_index *count);
    pia_status (*write_models)(pia_context *context, pia_output *output, const pia_model *const *models, pia_index count,
                               pia_index samples);
    pia_status (*write_table)(pia_context *context, pia_output *output, const char *header, const double *values, pia_index rows,
                              int columns);
} pia_format; /* a NULL entry: the format cannot do that */

/* The registry, collected from the files format_*.c; NULL past the end. */
const pia_format *pia_format_list(pia_index index);
/* By name, or by the extension of path when name is NULL; NULL when unknown. */
const pia_format *pia_format_find(const char *name, const char *path);

#endif
