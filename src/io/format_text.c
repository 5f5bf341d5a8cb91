#include "text.h"

#include <string.h>

/* The rows read are a matrix of heights: (column, row, height). */
static pia_status make_grid(pia_context *context, const pia_input *input, pia_index columns, pia_points *points)
{
    static const double origin[2] = {0, 0}, step[2] = {1, 1};
    if (points->part_count > 1)
        return pia_input_fail(context, input, NULL, "has %lld parts; a grid of heights has no blank lines between its rows",
                              (long long)points->part_count);
    double *heights = points->points;
    points->points = NULL;
    pia_status status = pia_points_from_heights(context, heights, points->count[0], columns, origin, step, points);
    pia_give(context, heights);
    return status;
}

static pia_status read_columns(pia_context *context, const pia_input *input, const pia_text_layout *layout,
                               const pia_text_columns *columns, const pia_points_options *options, pia_points *out)
{
    if (!options->grid && columns->count > PIA_MAX_DIM)
        return pia_input_fail(context, input, layout->data,
                              "row has %lld numbers, a point has at most %d; choose columns, or read the file as a grid of heights",
                              (long long)columns->count, PIA_MAX_DIM);
    pia_status status = pia_text_read_rows(context, input, layout, columns, options, out);
    if (status != PIA_OK) return status;
    if (options->grid) return make_grid(context, input, columns->count, out);
    out->kind = PIA_CURVE;
    out->dim = (int)columns->count;
    return pia_text_copy_names(context, layout, columns, out);
}

static pia_status read_points(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *out)
{
    pia_text_layout layout;
    pia_text_columns columns = {0};
    pia_status status = pia_text_find_layout(context, input, &layout);
    if (status != PIA_OK) return status;
    status = pia_text_choose_columns(context, input, &layout, options->columns, &columns);
    if (status == PIA_OK && !options->grid) pia_text_set_contour_apart(&layout, options->columns != NULL, &columns);
    if (status == PIA_OK) status = read_columns(context, input, &layout, &columns, options, out);
    if (status == PIA_OK && layout.header_count > (layout.names.begin != NULL))
        pia_log(context, 1, "%s: skipped %lld lines before the first row of numbers", input->path, (long long)layout.header_count);
    pia_give(context, layout.numeric);
    pia_give(context, columns.slot);
    pia_give(context, columns.field);
    return status;
}

static void write_row(pia_output *output, const double *values, int count)
{
    for (int c = 0; c < count; c++) {
        if (c > 0) pia_output_bytes(output, ",", 1);
        pia_output_number(output, values[c]);
    }
}

static pia_status write_table(pia_context *context, pia_output *output, const char *header, const double *values, pia_index rows,
                              int columns)
{
    (void)context;
    if (header != NULL) {
        pia_output_bytes(output, header, strlen(header));
        pia_output_bytes(output, "\n", 1);
    }
    for (pia_index i = 0; i < rows; i++) {
        write_row(output, values + i * columns, columns);
        pia_output_bytes(output, "\n", 1);
    }
    return PIA_OK;
}

/* "u,v,x,y,z"; components beyond the third, and all of a point of more than three, are numbered. */
static void write_sample_header(pia_output *output, const pia_model *model)
{
    static const char *const axis[] = {"x", "y", "z"};
    pia_output_text(output, model->directions == 2 ? "u,v" : "u");
    for (int c = 0; c < model->dim; c++) {
        if (model->dim <= 3)
            pia_output_text(output, ",%s", axis[c]);
        else
            pia_output_text(output, ",x%d", c + 1);
    }
    pia_output_bytes(output, "\n", 1);
}

/* Rows u[,v],x,y,z; a blank line between models. */
static pia_status write_models(pia_context *context, pia_output *output, const pia_model *const *models, pia_index count,
                               const pia_write_options *options)
{
    for (pia_index k = 0; k < count; k++) {
        const pia_model *model = models[k];
        double *parameters, *points;
        pia_index size[2];
        if (k > 0 && (model->dim != models[0]->dim || model->directions != models[0]->directions))
            return pia_fail(context, PIA_E_SHAPE,
                            "model %lld differs from the first in kind or dimension; write them to files of their own", (long long)k);
        pia_status status = pia_model_sample(context, model, options->samples, &parameters, &points, size);
        if (status != PIA_OK) return status;
        if (k == 0)
            write_sample_header(output, model);
        else
            pia_output_bytes(output, "\n", 1);
        for (pia_index i = 0; i < size[0] * size[1]; i++) {
            write_row(output, parameters + i * model->directions, model->directions);
            pia_output_bytes(output, ",", 1);
            write_row(output, points + i * model->dim, model->dim);
            pia_output_bytes(output, "\n", 1);
        }
        pia_give(context, parameters);
        pia_give(context, points);
    }
    return PIA_OK;
}

const pia_format pia_format_text = {
    .name = "text",
    .title = "Rows of numbers: comma, semicolon, tab or blanks",
    .detail = "header, comments (#), several parts; models are written as samples u[,v],x,y,z",
    .extensions = "csv txt xyz dat",
    .read_points = read_points,
    .write_models = write_models,
    .leaves_trims = 1,
    .write_table = write_table,
};
