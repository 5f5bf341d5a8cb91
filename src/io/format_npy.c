#include "bytes.h"
#include "npy_header.h"
#include "records.h"

/* The array as [rows x columns] with the last direction as columns, in C order. slot[column] is the place of a column in a row of
 * `width` values, or -1; NULL: all columns in order. */
static void load_rows(const pia_npy_header *header, const pia_index *slot, pia_index width, double *out)
{
    const pia_index *shape = header->shape;
    pia_index columns = header->directions > 1 ? shape[header->directions - 1] : 1;
    pia_index inner = header->directions == 3 ? shape[1] : 1;
    pia_index rows = columns > 0 ? header->count / columns : 0;
    const pia_record_type type = {header->type, header->size};
    for (pia_index i = 0; i < rows; i++) {
        /* In Fortran order the row (a, b) of a [A x B x columns] array begins at a + A b, and columns are `rows` apart. */
        pia_index begin = header->transpose ? i / inner + shape[0] * (i % inner) : i * columns;
        pia_index step = header->transpose ? rows : 1;
        for (pia_index c = 0; c < columns; c++) {
            pia_index to = slot != NULL ? slot[c] : c;
            if (to >= 0) out[i * width + to] = pia_record_load(header->values + (begin + c * step) * type.size, type, header->big);
        }
    }
}

static pia_status load_points(pia_context *context, const pia_npy_header *header, const pia_index *slot, pia_index width,
                              pia_points *out)
{
    int grid = header->directions == 3;
    out->kind = grid ? PIA_GRID : PIA_CURVE;
    out->count[0] = header->shape[0];
    out->count[1] = grid ? header->shape[1] : 1;
    out->dim = (int)width;
    pia_index size = out->count[0] * out->count[1] * width;
    out->points = pia_take(context, size, sizeof *out->points);
    if (out->points == NULL) return pia_take_status(context, size, sizeof *out->points);
    load_rows(header, slot, width, out->points);
    return PIA_OK;
}

/* Columns by number, with the rules of the text tables. */
static pia_status load_columns(pia_context *context, const pia_input *input, const pia_npy_header *header, const char *list,
                               pia_points *out)
{
    pia_text_layout layout = {
        .delimiter = ',', .point = '.', .field_count = header->directions > 1 ? header->shape[header->directions - 1] : 1};
    pia_text_columns columns;
    pia_status status = pia_text_choose_columns(context, input, &layout, list, &columns);
    if (status != PIA_OK) return status;
    status = load_points(context, header, columns.slot, columns.count, out);
    pia_give(context, columns.slot);
    pia_give(context, columns.field);
    return status;
}

static pia_status load_heights(pia_context *context, const pia_npy_header *header, pia_points *out)
{
    static const double origin[2] = {0, 0}, step[2] = {1, 1};
    double *heights = pia_take(context, header->count, sizeof *heights);
    if (heights == NULL) return pia_take_status(context, header->count, sizeof *heights);
    load_rows(header, NULL, header->shape[1], heights);
    pia_status status = pia_points_from_heights(context, heights, header->shape[0], header->shape[1], origin, step, out);
    pia_give(context, heights);
    return status;
}

static pia_status read_points(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *out)
{
    pia_npy_header header;
    pia_status status = pia_npy_read_header(context, input, &header);
    if (status != PIA_OK) return status;
    if (header.count == 0) return pia_input_fail(context, input, NULL, "holds no values; give at least one point");
    pia_index columns = header.directions > 1 ? header.shape[header.directions - 1] : 1;
    int heights = options->grid && header.directions == 2;
    if (heights)
        status = load_heights(context, &header, out);
    else if (options->columns != NULL)
        status = load_columns(context, input, &header, options->columns, out);
    else if (columns > PIA_MAX_DIM)
        status =
            pia_input_fail(context, input, NULL,
                           "its points have %lld components, at most %d are possible; choose columns, or read it as a grid of heights",
                           (long long)columns, PIA_MAX_DIM);
    else
        status = load_points(context, &header, NULL, columns, out);
    return status == PIA_OK ? pia_points_screen(context, input, options, out) : status;
}

static void write_values(pia_output *output, const double *values, pia_index count)
{
    unsigned char bytes[8];
    for (pia_index i = 0; i < count; i++) {
        pia_bytes_store_little(bytes, 8, pia_bytes_of_double(values[i]));
        pia_output_bytes(output, bytes, sizeof bytes);
    }
}

static pia_status write_table(pia_context *context, pia_output *output, const char *header, const double *values, pia_index rows,
                              int columns)
{
    (void)context;
    (void)header; /* an array has no names */
    pia_npy_write_header(output, (pia_index[]){rows, columns}, 2);
    write_values(output, values, rows * columns);
    return PIA_OK;
}

/* The samples alone: [n x dim] of a curve, [n x m x dim] of a surface. */
static pia_status write_models(pia_context *context, pia_output *output, const pia_model *const *models, pia_index count,
                               const pia_write_options *options)
{
    if (count > 1)
        return pia_fail(context, PIA_E_SHAPE, "an NPY file holds one model, not %lld; write them to files of their own",
                        (long long)count);
    double *parameters, *points;
    pia_index size[2];
    pia_status status = pia_model_sample(context, models[0], options->samples, &parameters, &points, size);
    if (status != PIA_OK) return status;
    int dim = models[0]->dim, surface = models[0]->directions == 2;
    pia_npy_write_header(output, surface ? (pia_index[]){size[0], size[1], dim} : (pia_index[]){size[0], dim, 0}, surface ? 3 : 2);
    write_values(output, points, size[0] * size[1] * dim);
    pia_give(context, parameters);
    pia_give(context, points);
    return PIA_OK;
}

const pia_format pia_format_npy = {
    .name = "npy",
    .title = "NumPy array, versions 1 to 3",
    .detail = "[n x dim] points, [n x m x dim] grids, or a matrix of heights; models are written as samples",
    .extensions = "npy",
    .read_points = read_points,
    .write_models = write_models,
    .leaves_trims = 1,
    .write_table = write_table,
};
