/* Formats: reader and writer of one file format, one file each. */
#ifndef PIA_IO_IO_H
#define PIA_IO_IO_H

#include "context.h"
#include "model.h"
#include "output.h"

/* A file in memory: mapped when it is a regular file, else read whole. Readers never look outside [begin, end); no NUL follows.
 * A mapped file that another program shortens meanwhile ends the process (SIGBUS), as with any mapping. */
typedef struct pia_input {
    const char *path;   /* as the messages name it; "standard input" for "-" */
    const char *inside; /* "/NAME" of what is wanted of a file that holds several arrays; NULL: nothing was named */
    const char *begin, *end;
    void *block; /* what to unmap or give back */
    int mapped;
} pia_input;

/* path is borrowed until the input is closed. PIA_E_FILE: missing, a directory, unreadable; PIA_E_MEMORY. */
pia_status pia_input_open(pia_context *context, const char *path, pia_input *out);
void pia_input_close(pia_context *context, pia_input *input);

/* Number of the line that holds `at`, from 1. LF, CRLF and CR end a line. */
pia_index pia_input_line(const pia_input *input, const char *at);
/* PIA_E_FORMAT with "PATH:LINE: ...", or "PATH: ..." when at is NULL. What names no remedy behind a semicolon asks to correct the
 * file. */
pia_status pia_input_fail(pia_context *context, const pia_input *input, const char *at, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* The outcome of a call about what a file holds, told as one about the file: failures but of memory become PIA_E_FORMAT
 * "PATH:LINE: where" and what the context's message said. */
pia_status pia_input_judge(pia_context *context, const pia_input *input, const char *at, const char *where, pia_status status);
/* Copies at most 24 characters for a message, "..." for what is left out and '?' for what cannot be printed. */
void pia_input_quote(const char *begin, const char *end, char quote[32]);

/* What a reader of points fills in; arrays taken with pia_take. The public pia_points wraps it. */
struct pia_points {
    pia_memory memory;
    pia_kind kind;
    double *points;
    pia_index count[2];
    int dim;
    pia_index part_count, *part; /* part NULL: the rows are one part */
    pia_index whole[2];          /* {0, rows}: the one part of files that know no parts */
    pia_index skipped, *row;
    char **names; /* [dim], or NULL */
    const char *format;
};

/* Gives back the arrays and leaves the struct empty; its memory stays. */
void pia_points_clear(pia_points *points);

/* A regular grid of heights turned into points (x, y, z): x = first[0] + column * step[0], y = first[1] + row * step[1].
 * values [rows x columns]. Sets kind, count, dim, points of `out`. PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_points_from_heights(pia_context *context, const double *values, pia_index rows, pia_index columns, const double first[2],
                                   const double step[2], pia_points *out);

/* Refuses points with a component that is not finite, naming the first; a NaN passes with options->allow_nan, and rows (not grids)
 * are dropped and counted with options->skip_invalid. For formats without lines. */
pia_status pia_points_screen(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *points);

/* Points of model `model` at `samples` uniform parameters a direction (PIA_AUTO: enough for a picture); parameters
 * [count x directions] and points [count x dim] are the caller's to give back; count[1] is 1 for a curve. */
pia_status pia_model_sample(pia_context *context, const pia_model *model, pia_index samples, double **parameters, double **points,
                            pia_index count[2]);

typedef struct pia_plugin pia_plugin;

typedef struct pia_format {
    const char *name, *title, *reference, *detail;
    const char *extensions; /* "csv txt xyz dat" */
    pia_status (*read_points)(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *out);
    pia_status (*read_models)(pia_context *context, const pia_input *input, pia_model ***out, pia_index *count);
    pia_status (*write_models)(pia_context *context, pia_output *output, const pia_model *const *models, pia_index count,
                               const pia_write_options *options); /* whole; the name is never NULL */
    pia_status (*write_table)(pia_context *context, pia_output *output, const char *header, const double *values, pia_index rows,
                              int columns);
    const pia_plugin *plugin; /* the program that reading needs (plugin.h); NULL: none */
    int holds_arrays;         /* 1: FILE:/NAME is the array NAME of FILE */
    int leaves_trims;         /* 1: trimmed surfaces are written whole */
} pia_format;                 /* a NULL entry: the format cannot do that. Readers leave `out` as it was on failure, apart from what
                                 pia_points_clear gives back */

/* The registry, collected from the files format_*.c; NULL past the end. */
const pia_format *pia_format_list(pia_index index);
/* By name or extension in `name`, or by the extension of path when name is NULL; NULL when unknown. */
const pia_format *pia_format_find(const char *name, const char *path);
/* Where "/NAME" begins in a path that names an array within a file: FILE:/NAME, FILE being of a format that holds arrays, by `name` or
 * by its extension. NULL: path is that of a file. */
const char *pia_format_inside(const char *name, const char *path);

#endif
