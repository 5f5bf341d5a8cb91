#include "number.h"
#include "ply_header.h"

#include <math.h>
#include <string.h>

/* PLY: items stand one after another, numbers and lists in the order of the header. Elements before the vertices are skipped, in one
 * step where their items have a fixed size; what comes behind the vertices is not looked at. */

typedef struct cursor {
    pia_context *context;
    const pia_input *input;
    const pia_ply_header *header;
    const char *p;
} cursor;

static pia_status refuse_end(const cursor *c, const pia_ply_property *property)
{
    return pia_input_fail(c->context, c->input, NULL, "ends inside its data, at a property %.*s; copy it again",
                          (int)(property->name_size < 40 ? property->name_size : 40), property->name);
}

/* The next number of an ASCII file. */
static pia_status read_word(cursor *c, const pia_ply_property *property, double *value)
{
    const char *end = c->input->end;
    while (c->p < end && (pia_text_is_blank(*c->p) || pia_text_is_end(*c->p))) c->p++;
    if (c->p == end) return refuse_end(c, property);
    const char *word = c->p, *after = pia_number_parse(word, end, value);
    if (after != NULL && (after == end || pia_text_is_blank(*after) || pia_text_is_end(*after))) {
        c->p = after;
        return PIA_OK;
    }
    char quote[32];
    const char *stop = word;
    while (stop < end && !pia_text_is_blank(*stop) && !pia_text_is_end(*stop)) stop++;
    pia_input_quote(word, stop, quote);
    return pia_input_fail(c->context, c->input, word, "'%s' is not a number; correct it", quote);
}

static pia_status read_number(cursor *c, const pia_ply_property *property, pia_record_type type, double *value)
{
    if (c->header->encoding == PIA_PLY_ASCII) return read_word(c, property, value);
    if (c->input->end - c->p < type.size) return refuse_end(c, property);
    *value = pia_record_load(c->p, type, c->header->encoding == PIA_PLY_BIG);
    c->p += type.size;
    return PIA_OK;
}

static pia_status skip_list(cursor *c, const pia_ply_property *property)
{
    double length, value;
    const char *begin = c->p;
    pia_status status = read_number(c, property, property->length, &length);
    if (status != PIA_OK) return status;
    if (!(length >= 0 && length < 1e18 && floor(length) == length))
        return pia_input_fail(c->context, c->input, c->header->encoding == PIA_PLY_ASCII ? begin : NULL,
                              "a list %.*s has the length %g; correct it", (int)(property->name_size < 40 ? property->name_size : 40),
                              property->name, length);
    pia_index count = (pia_index)length;
    if (c->header->encoding != PIA_PLY_ASCII) {
        if (count > (c->input->end - c->p) / property->type.size) return refuse_end(c, property);
        c->p += count * property->type.size;
        return PIA_OK;
    }
    for (pia_index i = 0; i < count && status == PIA_OK; i++) status = read_word(c, property, &value);
    return status;
}

/* One item; the property f goes to out[slot[f]], or nowhere when slot is NULL or negative. */
static pia_status read_item(cursor *c, const pia_ply_element *element, const pia_index *slot, double *out)
{
    for (pia_index k = element->first; k < element->end; k++) {
        const pia_ply_property *property = &c->header->property[k];
        double value;
        pia_status status = property->length.kind != 0 ? skip_list(c, property) : read_number(c, property, property->type, &value);
        if (status != PIA_OK) return status;
        pia_index to = slot != NULL ? slot[k - element->first] : -1;
        if (to >= 0) out[to] = value;
    }
    return PIA_OK;
}

/* Whether the rest of the file can hold what the header claims; the last item of an ASCII file needs no blank behind it. */
static pia_status check_claim(const cursor *c, const pia_ply_element *element)
{
    pia_index rest = c->input->end - c->p + 1;
    if (element->least_size == 0 || element->count <= rest / element->least_size) return PIA_OK;
    return pia_input_fail(
        c->context, c->input, NULL,
        "its PLY header claims %lld items of at least %lld bytes, more than the %lld bytes of the file hold; copy it again",
        (long long)element->count, (long long)element->least_size, (long long)(c->input->end - c->input->begin));
}

static pia_status skip_element(cursor *c, const pia_ply_element *element)
{
    pia_status status = check_claim(c, element);
    if (element->first == element->end || status != PIA_OK) return status;
    if (element->fixed && c->header->encoding != PIA_PLY_ASCII) {
        pia_index size = element->count * element->least_size;
        if (size > c->input->end - c->p) return refuse_end(c, &c->header->property[element->first]);
        c->p += size;
        return PIA_OK;
    }
    for (pia_index i = 0; i < element->count && status == PIA_OK; i++) status = read_item(c, element, NULL, NULL);
    return status;
}

/* The names of the vertex properties in one line, the caller's to give back. */
static pia_status join_names(pia_context *context, const pia_ply_header *header, const pia_ply_element *vertex, char **out,
                             pia_text_line *line)
{
    pia_index size = 1;
    for (pia_index k = vertex->first; k < vertex->end; k++) size += header->property[k].name_size + 1;
    char *text = *out = pia_take(context, size, 1);
    if (text == NULL) return pia_take_status(context, size, 1);
    for (pia_index k = vertex->first; k < vertex->end; k++) {
        if (k > vertex->first) *text++ = ' ';
        memcpy(text, header->property[k].name, (size_t)header->property[k].name_size);
        text += header->property[k].name_size;
    }
    *line = (pia_text_line){.begin = *out, .end = text, .next = text};
    return PIA_OK;
}

static int has(const pia_ply_header *header, const pia_ply_element *vertex, char name)
{
    for (pia_index k = vertex->first; k < vertex->end; k++)
        if (header->property[k].name_size == 1 && header->property[k].name[0] == name) return 1;
    return 0;
}

static pia_status refuse_lists(const cursor *c, const pia_ply_element *vertex, const pia_text_columns *columns)
{
    for (pia_index k = 0; k < columns->count; k++) {
        const pia_ply_property *property = &c->header->property[vertex->first + columns->field[k]];
        if (property->length.kind != 0)
            return pia_fail(c->context, PIA_E_ARGUMENT, "%s: the property %.*s is a list; choose columns of one number", c->input->path,
                            (int)(property->name_size < 40 ? property->name_size : 40), property->name);
    }
    return PIA_OK;
}

static pia_status read_vertices(cursor *c, const pia_ply_element *vertex, const char *list, pia_points *out)
{
    char *names = NULL;
    pia_text_line line;
    pia_text_columns columns = {0};
    pia_status status = check_claim(c, vertex);
    if (status == PIA_OK && (vertex->count == 0 || vertex->first == vertex->end))
        status = pia_input_fail(c->context, c->input, NULL, "holds no vertices with coordinates; give at least one");
    if (status == PIA_OK) status = join_names(c->context, c->header, vertex, &names, &line);
    if (status == PIA_OK)
        status = pia_records_begin(c->context, c->input, &line, vertex->end - vertex->first, list,
                                   has(c->header, vertex, 'z') ? "x,y,z" : "x,y", vertex->count, &columns, out);
    if (status == PIA_OK) status = refuse_lists(c, vertex, &columns);
    for (pia_index i = 0; i < vertex->count && status == PIA_OK; i++)
        status = read_item(c, vertex, columns.slot, out->points + i * out->dim);
    pia_give(c->context, columns.slot);
    pia_give(c->context, columns.field);
    pia_give(c->context, names);
    return status;
}

static pia_status read_points(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *out)
{
    pia_ply_header header;
    pia_status status = pia_ply_read_header(context, input, &header);
    if (status != PIA_OK) return status;
    cursor c = {context, input, &header, header.data};
    pia_index last = header.element_count - 1;
    for (pia_index k = 0; k < last && status == PIA_OK; k++) status = skip_element(&c, &header.element[k]);
    if (status == PIA_OK) status = read_vertices(&c, &header.element[last], options->columns, out);
    pia_ply_clear(context, &header);
    return status == PIA_OK ? pia_points_screen(context, input, options, out) : status;
}

const pia_format pia_format_ply = {
    .name = "ply",
    .title = "PLY, ASCII and binary",
    .detail = "vertices are read as points, x, y, z unless columns are chosen by the names of their properties",
    .extensions = "ply",
    .read_points = read_points,
};
