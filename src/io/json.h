/* The JSON model, piece by piece: see docs/formats.md. */
#ifndef PIA_IO_JSON_H
#define PIA_IO_JSON_H

#include "io.h"

#include <jansson.h>

/* A string with quotes and escapes. */
void pia_json_write_text(pia_output *output, const char *text);
/* A number, or null when it is not finite. */
void pia_json_write_real(pia_output *output, double value);
/* [a, b, ...] */
void pia_json_write_reals(pia_output *output, const double *values, pia_index count);

/* The object "fit": what `pia fit --json` says, as far as the summary knows it, and the rest of the report. */
void pia_json_write_fit(pia_output *output, const pia_summary *summary);
/* The inverse; members that are missing or of another type keep their neutral value (0, "", NaN). 0 when memory is short. */
int pia_json_read_fit(const pia_memory *memory, const json_t *fit, pia_summary *summary);

/* ', "trims": {...}', a member of the surface's object that is not its first. */
void pia_json_write_trim(pia_output *output, const pia_trim *trim);

/* The writer of the format; options are not used. */
pia_status pia_json_write_models(pia_context *context, pia_output *output, const pia_model *const *models, pia_index count,
                                 const pia_write_options *options);

/* What a reader of one model knows about where it is. */
typedef struct pia_json_place {
    pia_context *context;
    const pia_input *input;
    pia_index model; /* from 0; PIA_AUTO: the file is the model */
} pia_json_place;

/* PIA_E_FORMAT "PATH: shape.data[0]: key what", or "PATH: key what" where the file is the model. */
pia_status pia_json_fail(const pia_json_place *place, const char *key, const char *what);
/* The number under `key`, which is whole and in [least, most]. */
pia_status pia_json_get_index(const pia_json_place *place, const json_t *object, const char *key, pia_index least, pia_index most,
                              pia_index *out);
/* The numbers of `array`, called `key` in messages; taken with pia_take. */
pia_status pia_json_get_reals(const pia_json_place *place, const json_t *array, const char *key, double **out, pia_index *count);
/* Rows of equal length, 1 to PIA_MAX_DIM numbers each; taken with pia_take. */
pia_status pia_json_get_points(const pia_json_place *place, const json_t *rows, double **out, pia_index *count, int *dim);
/* The object "trims" of a surface: *model becomes the trimmed one. PIA_E_FORMAT, PIA_E_DATA, PIA_E_MEMORY. */
pia_status pia_json_read_trim(const pia_json_place *place, const json_t *trims, pia_model **model);
/* Whether a file is a curve in TinySpline's layout, and that curve. PIA_E_FORMAT, PIA_E_MEMORY. */
int pia_json_is_tinyspline(const json_t *root);
pia_status pia_json_read_tinyspline(const pia_json_place *place, const json_t *root, pia_model **out);
/* The model that one member of shape.data describes. PIA_E_FORMAT, PIA_E_MEMORY. */
pia_status pia_json_read_shape(const pia_json_place *place, const json_t *data, int directions, pia_model **out);

#endif
