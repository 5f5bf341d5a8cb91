#include "records.h"

#include "bytes.h"

double pia_record_load(const char *at, pia_record_type type, int big)
{
    uint64_t bits = big ? pia_bytes_load_big(at, type.size) : pia_bytes_load_little(at, type.size);
    int unused = 64 - 8 * type.size;
    switch (type.kind) {
    case 'f': return type.size == 8 ? pia_bytes_to_double(bits) : (double)pia_bytes_to_float((uint32_t)bits);
    case 'i': return (double)((int64_t)(bits << unused) >> unused);
    default: return (double)bits;
    }
}

static pia_status take_points(pia_context *context, const pia_input *input, pia_index rows, pia_index width, pia_points *out)
{
    pia_index size;
    if (width > PIA_MAX_DIM)
        return pia_fail(context, PIA_E_ARGUMENT, "%s: a point has at most %d components, not %lld; choose fewer columns", input->path,
                        PIA_MAX_DIM, (long long)width);
    if (!pia_multiply(rows, width, &size)) return pia_fail(context, PIA_E_SIZE, "%s: too many rows", input->path);
    out->points = pia_take(context, size, sizeof *out->points);
    if (out->points == NULL) return pia_take_status(context, size, sizeof *out->points);
    out->kind = PIA_CURVE;
    out->count[0] = rows;
    out->count[1] = 1;
    out->dim = (int)width;
    return PIA_OK;
}

pia_status pia_records_begin(pia_context *context, const pia_input *input, const pia_text_line *names, pia_index count,
                             const char *list, const char *otherwise, pia_index rows, pia_text_columns *columns, pia_points *out)
{
    pia_text_layout layout = {.delimiter = ' ', .point = '.', .field_count = count, .names = *names};
    pia_status status = pia_text_choose_columns(context, input, &layout, list != NULL ? list : otherwise, columns);
    if (status != PIA_OK) return status;
    status = take_points(context, input, rows, columns->count, out);
    if (status == PIA_OK) status = pia_text_copy_names(context, &layout, columns, out);
    if (status == PIA_OK) return PIA_OK;
    pia_give(context, columns->slot);
    pia_give(context, columns->field);
    *columns = (pia_text_columns){.count = 0};
    return status;
}
