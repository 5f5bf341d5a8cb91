#include "bytes.h"
#include "records.h"

#include <string.h>

/* LAS 1.0 to 1.4: a header, records of a fixed size, little-endian. Coordinates are whole numbers with a scale and an offset a
 * direction. ASPRS, LAS Specification 1.4 - R15, tables 3 and 6 to 18. */

enum { FORMATS = 11, MOST_FIELDS = 18 };

/* Where a number stands in a record: (bits >> shift) & mask of an integer, then scale and offset. */
typedef struct field {
    const char *name;
    int at;
    pia_record_type type;
    int shift, mask; /* mask 0: the whole number */
    double scale, offset;
} field;

typedef struct las_header {
    int format, record_size;
    pia_index count;
    const char *records;
    int field_count;
    field field[MOST_FIELDS];
} las_header;

static const int least_size[FORMATS] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

static void add(las_header *header, const char *name, int at, char kind, int size)
{
    header->field[header->field_count++] = (field){.name = name, .at = at, .type = {kind, size}, .scale = 1};
}

static void add_bits(las_header *header, const char *name, int at, int shift, int mask)
{
    add(header, name, at, 'u', 1);
    header->field[header->field_count - 1].shift = shift;
    header->field[header->field_count - 1].mask = mask;
}

/* Formats 0 to 5 and 6 to 10 begin alike; colours, time and near infrared follow in some. */
static void list_fields(las_header *header)
{
    static const int time[FORMATS] = {0, 20, 0, 20, 20, 20, 22, 22, 22, 22, 22};
    static const int colour[FORMATS] = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
    static const int infrared[FORMATS] = {[8] = 36, [10] = 36};
    int f = header->format, wide = f >= 6;
    add(header, "x", 0, 'i', 4);
    add(header, "y", 4, 'i', 4);
    add(header, "z", 8, 'i', 4);
    add(header, "intensity", 12, 'u', 2);
    add_bits(header, "return_number", 14, 0, wide ? 15 : 7);
    add_bits(header, "number_of_returns", 14, wide ? 4 : 3, wide ? 15 : 7);
    add_bits(header, "classification", wide ? 16 : 15, 0, wide ? 255 : 31);
    add(header, "scan_angle", wide ? 18 : 16, 'i', wide ? 2 : 1);
    if (wide) header->field[header->field_count - 1].scale = 0.006; /* degrees; the older formats count whole ones */
    add(header, "user_data", 17, 'u', 1);
    add(header, "point_source_id", wide ? 20 : 18, 'u', 2);
    if (time[f] > 0) add(header, "gps_time", time[f], 'f', 8);
    if (colour[f] > 0) {
        add(header, "red", colour[f], 'u', 2);
        add(header, "green", colour[f] + 2, 'u', 2);
        add(header, "blue", colour[f] + 4, 'u', 2);
    }
    if (infrared[f] > 0) add(header, "nir", infrared[f], 'u', 2);
}

static double value_of(const field *f, const char *record)
{
    double number = pia_record_load(record + f->at, f->type, 0);
    if (f->mask != 0) number = (double)((int)number >> f->shift & f->mask);
    return number * f->scale + f->offset;
}

static double load_double(const char *at)
{
    return pia_bytes_to_double(pia_bytes_load_little(at, 8));
}

static pia_index load(const char *at, int size)
{
    return (pia_index)pia_bytes_load_little(at, size);
}

/* The count of a 1.4 file; the older one where it is zero, or too large for 64 bits with a sign. */
static pia_index count_of(const char *begin, int minor)
{
    pia_index count = minor >= 4 ? load(begin + 247, 8) : 0;
    return count > 0 ? count : load(begin + 107, 4);
}

static pia_status read_header(pia_context *context, const pia_input *input, las_header *out)
{
    enum { SHORTEST = 227, SHORTEST_14 = 375 };
    const char *begin = input->begin;
    pia_index size = input->end - begin;
    if (size < 4 || memcmp(begin, "LASF", 4) != 0) return pia_input_fail(context, input, NULL, "is not a LAS file; name its format");
    int major = size > 25 ? begin[24] : 1, minor = size > 25 ? begin[25] : 0;
    if (major != 1 || minor < 0 || minor > 4)
        return pia_input_fail(context, input, NULL, "has LAS version %d.%d; write it as version 1.2 to 1.4", major, minor);
    if (size < (minor >= 4 ? SHORTEST_14 : SHORTEST))
        return pia_input_fail(context, input, NULL, "ends inside its LAS header; copy it again");
    int format = (unsigned char)begin[104];
    if (format & 0xc0)
        return pia_input_fail(context, input, NULL,
                              "is compressed (LAZ); decompress it first, with 'laszip' or 'pdal translate IN.laz OUT.las'");
    if (format >= FORMATS)
        return pia_input_fail(context, input, NULL, "has point format %d; LAS has the formats 0 to %d, convert it", format,
                              FORMATS - 1);
    *out = (las_header){.format = format, .record_size = (int)load(begin + 105, 2), .count = count_of(begin, minor)};
    pia_index first = load(begin + 96, 4);
    if (out->record_size < least_size[format])
        return pia_input_fail(context, input, NULL, "has records of %d bytes, point format %d needs %d; write it again",
                              out->record_size, format, least_size[format]);
    if (out->count == 0) return pia_input_fail(context, input, NULL, "holds no points; give at least one");
    if (first > size || out->count > (size - first) / out->record_size)
        return pia_input_fail(context, input, NULL,
                              "its LAS header claims %lld points of %d bytes, more than the %lld bytes of the file hold; copy it again",
                              (long long)out->count, out->record_size, (long long)size);
    out->records = begin + first;
    list_fields(out);
    for (int d = 0; d < 3; d++) {
        out->field[d].scale = load_double(begin + 131 + 8 * d);
        out->field[d].offset = load_double(begin + 155 + 8 * d);
    }
    return PIA_OK;
}

static void load_records(const las_header *header, const pia_text_columns *columns, pia_points *out)
{
    double *to = out->points;
    for (pia_index i = 0; i < header->count; i++)
        for (pia_index k = 0; k < columns->count; k++)
            *to++ = value_of(&header->field[columns->field[k]], header->records + i * header->record_size);
}

static pia_status read_points(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *out)
{
    las_header header;
    pia_text_columns columns;
    char names[MOST_FIELDS * 20] = "";
    pia_status status = read_header(context, input, &header);
    if (status != PIA_OK) return status;
    for (int f = 0; f < header.field_count; f++) {
        if (f > 0) strcat(names, " ");
        strcat(names, header.field[f].name);
    }
    pia_text_line line = {.begin = names, .end = names + strlen(names)};
    status = pia_records_begin(context, input, &line, header.field_count, options->columns, "x,y,z", header.count, &columns, out);
    if (status != PIA_OK) return status;
    load_records(&header, &columns, out);
    pia_give(context, columns.slot);
    pia_give(context, columns.field);
    return pia_points_screen(context, input, options, out);
}

const pia_format pia_format_las = {
    .name = "las",
    .title = "LAS 1.0 to 1.4, uncompressed",
    .detail = "point formats 0 to 10; x, y, z, or columns by name: intensity, classification, gps_time, red, ...",
    .extensions = "las",
    .read_points = read_points,
};
