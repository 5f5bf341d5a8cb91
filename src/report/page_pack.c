#include "page_pack.h"

#include <math.h>

pia_series pia_series_between(int components, int bits, const double *low, const double *high)
{
    pia_series series = {.components = components, .bits = bits};
    double levels = ldexp(1, bits) - 2;
    for (int c = 0; c < components; c++) {
        series.low[c] = low[c];
        series.step[c] = high[c] > low[c] ? high[c] / levels - low[c] / levels : 0;
    }
    return series;
}

void pia_series_close(pia_context *context, pia_series *series)
{
    pia_give(context, series->code);
    series->code = NULL;
}

void pia_pack_close(pia_pack *pack)
{
    pia_memory_give(pia_memory_of(pack->context), pack->byte);
    *pack = (pia_pack){.context = pack->context};
}

static uint32_t encode(const pia_series *series, int component, double value)
{
    uint32_t none = (uint32_t)(ldexp(1, series->bits) - 1);
    if (isnan(value)) return none;
    double step = series->step[component], code = step > 0 ? rint((value - series->low[component]) / step) : 0;
    return code <= 0 ? 0 : code >= (double)none - 1 ? none - 1 : (uint32_t)code;
}

/* Replaces numbers [rows x columns] by what the prediction leaves, from the last to the first; sums wrap. Returns the bits set in any.
 */
static uint32_t predict(uint32_t *number, pia_index rows, pia_index columns)
{
    uint32_t set = 0;
    for (pia_index k = rows * columns - 1; k >= 0; k--) {
        pia_index i = k / columns, j = k % columns;
        uint32_t left = j > 0 ? number[k - 1] : 0, up = i > 0 ? number[k - columns] : 0;
        uint32_t corner = i > 0 && j > 0 ? number[k - columns - 1] : 0;
        uint32_t rest = number[k] - (left + up - corner);
        number[k] = (rest << 1) ^ (0 - (rest >> 31));
        set |= number[k];
    }
    return set;
}

static pia_status write_planes(pia_pack *pack, const uint32_t *number, pia_index count, pia_index components, int planes)
{
    pia_index size = 0;
    if (!pia_multiply(count * components, planes, &size))
        return pia_fail(pack->context, PIA_E_SIZE, "a lattice of %lld numbers is too large for a page", (long long)count);
    if (!pia_memory_grow(pia_memory_of(pack->context), &pack->byte, &pack->capacity, pack->count + size, 1))
        return pia_fail(pack->context, PIA_E_MEMORY, "out of memory for the %lld bytes of a page", (long long)(pack->count + size));
    unsigned char *to = (unsigned char *)pack->byte + pack->count;
    for (pia_index c = 0; c < components; c++)
        for (int plane = 0; plane < planes; plane++)
            for (pia_index k = 0; k < count; k++) *to++ = (unsigned char)(number[c * count + k] >> (8 * plane));
    pack->count += size;
    return PIA_OK;
}

pia_status pia_series_add(pia_pack *pack, pia_series *series, const double *values, pia_index stride, pia_index rows, pia_index columns,
                          pia_packed *out)
{
    pia_index count = rows * columns, all = count * series->components;
    int follows = series->code != NULL && series->rows == rows && series->columns == columns;
    uint32_t *code = pia_take(pack->context, all, sizeof *code), *rest = pia_take(pack->context, all, sizeof *rest), set = 0;
    pia_status status = code != NULL && rest != NULL ? PIA_OK : pia_take_status(pack->context, all, sizeof *code);
    if (status == PIA_OK) {
        for (int c = 0; c < series->components; c++) {
            for (pia_index k = 0; k < count; k++) {
                pia_index at = c * count + k;
                code[at] = encode(series, c, values[k * stride + c]);
                rest[at] = code[at] - (follows ? series->code[at] : 0);
            }
            set |= predict(rest + c * count, rows, columns);
        }
        *out = (pia_packed){pack->count, set >> 24 ? 4 : set >> 16 ? 3 : set >> 8 ? 2 : 1, follows};
        status = write_planes(pack, rest, count, series->components, out->planes);
    }
    pia_give(pack->context, rest);
    if (status != PIA_OK) {
        pia_give(pack->context, code);
        return status;
    }
    pia_give(pack->context, series->code);
    series->code = code;
    series->rows = rows;
    series->columns = columns;
    return PIA_OK;
}
