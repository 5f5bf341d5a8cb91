#include "bytes.h"
#include "io.h"

#include <string.h>

/* Netpbm grey maps: P2 (text) and P5 (binary, two bytes a value from 256 grey values on, most significant first). */

typedef struct pgm {
    const char *p, *end;
    int binary;
    pia_index columns, rows, largest;
} pgm;

static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

static void skip_blanks_and_comments(pgm *map)
{
    while (map->p < map->end && (is_blank(*map->p) || *map->p == '#')) {
        if (*map->p == '#')
            while (map->p < map->end && *map->p != '\n') map->p++;
        else
            map->p++;
    }
}

static int scan_count(pgm *map, pia_index *value)
{
    skip_blanks_and_comments(map);
    const char *begin = map->p;
    *value = 0;
    for (; map->p < map->end && *map->p >= '0' && *map->p <= '9'; map->p++)
        if (!pia_multiply(*value, 10, value) || __builtin_add_overflow(*value, *map->p - '0', value)) return 0;
    return map->p > begin;
}

static pia_status read_header(pia_context *context, const pia_input *input, pgm *map)
{
    *map = (pgm){.p = input->begin, .end = input->end};
    if (map->end - map->p < 3 || map->p[0] != 'P' || (map->p[1] != '2' && map->p[1] != '5'))
        return pia_input_fail(context, input, NULL, "is not a grey map (P2 or P5); convert it to PGM");
    map->binary = map->p[1] == '5';
    map->p += 2;
    if (!scan_count(map, &map->columns) || !scan_count(map, &map->rows) || !scan_count(map, &map->largest) || map->columns < 1 ||
        map->rows < 1 || map->largest < 1 || map->largest > 65535)
        return pia_input_fail(context, input, map->p, "the header must hold width, height and a largest value up to 65535");
    if (map->binary && map->p < map->end) map->p++; /* exactly one blank */
    pia_index values, bytes;
    int size = map->binary && map->largest < 256 ? 1 : 2; /* in text a digit and a blank */
    if (!pia_multiply(map->columns, map->rows, &values) || !pia_multiply(values, size, &bytes) ||
        bytes - (map->binary ? 0 : 1) > map->end - map->p)
        return pia_input_fail(context, input, NULL, "its header claims %lld x %lld values, more than the file holds; copy it again",
                              (long long)map->columns, (long long)map->rows);
    return PIA_OK;
}

static pia_status read_values(pia_context *context, const pia_input *input, pgm *map, double *out)
{
    pia_index count = map->columns * map->rows;
    int size = map->largest < 256 ? 1 : 2;
    for (pia_index i = 0; i < count; i++) {
        pia_index value;
        if (map->binary) {
            value = (pia_index)pia_bytes_load_big(map->p, size);
            map->p += size;
        } else if (!scan_count(map, &value)) {
            return pia_input_fail(context, input, map->p < map->end ? map->p : NULL, "value %lld of %lld is missing or not a number",
                                  (long long)i, (long long)count);
        }
        if (value > map->largest)
            return pia_input_fail(context, input, NULL, "value %lld is %lld, above the largest value %lld of the header", (long long)i,
                                  (long long)value, (long long)map->largest);
        out[i] = (double)value;
    }
    return PIA_OK;
}

static pia_status read_points(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *out)
{
    static const double origin[2] = {0, 0}, step[2] = {1, 1};
    (void)options; /* every value is finite */
    pgm map;
    pia_status status = read_header(context, input, &map);
    if (status != PIA_OK) return status;
    double *heights = pia_take(context, map.columns * map.rows, sizeof *heights);
    if (heights == NULL) return pia_take_status(context, map.columns * map.rows, sizeof *heights);
    status = read_values(context, input, &map, heights);
    if (status == PIA_OK) status = pia_points_from_heights(context, heights, map.rows, map.columns, origin, step, out);
    pia_give(context, heights);
    return status;
}

const pia_format pia_format_pgm = {
    .name = "pgm",
    .title = "Netpbm grey map as a grid of heights",
    .detail = "P2 and P5, 8 and 16 bits; points are (column, row, value)",
    .extensions = "pgm",
    .read_points = read_points,
};
