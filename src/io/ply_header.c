#include "ply_header.h"

#include <string.h>

enum { MOST_WORDS = 5 };

/* A line taken apart at its blanks. */
typedef struct words {
    const char *begin;
    pia_text_field word[MOST_WORDS];
    int count; /* more than MOST_WORDS are counted but not kept */
} words;

static int is(const pia_text_field *word, const char *text)
{
    size_t size = strlen(text);
    return (size_t)(word->end - word->begin) == size && memcmp(word->begin, text, size) == 0;
}

/* '#' is no comment in PLY, so that a line is taken as it is. Returns the next line; NULL when the file ends inside this one. */
static const char *take_words(const char *p, const char *end, words *out)
{
    *out = (words){.begin = p};
    for (;;) {
        while (p < end && pia_text_is_blank(*p)) p++;
        if (p == end) return NULL;
        if (pia_text_is_end(*p)) return pia_text_skip_end(p, end);
        pia_text_field word = {.begin = p};
        while (p < end && !pia_text_is_blank(*p) && !pia_text_is_end(*p)) p++;
        word.end = p;
        if (out->count < MOST_WORDS) out->word[out->count] = word;
        out->count++;
    }
}

static pia_record_type type_of(const pia_text_field *word)
{
    static const struct {
        const char *name[2];
        pia_record_type type;
    } known[] = {{{"char", "int8"}, {'i', 1}},     {{"uchar", "uint8"}, {'u', 1}},   {{"short", "int16"}, {'i', 2}},
                 {{"ushort", "uint16"}, {'u', 2}}, {{"int", "int32"}, {'i', 4}},     {{"uint", "uint32"}, {'u', 4}},
                 {{"float", "float32"}, {'f', 4}}, {{"double", "float64"}, {'f', 8}}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (is(word, known[i].name[0]) || is(word, known[i].name[1])) return known[i].type;
    return (pia_record_type){0, 0};
}

static pia_status refuse_line(pia_context *context, const pia_input *input, const words *line, const char *why)
{
    char quote[32];
    const char *end = line->count > 0 ? line->word[(line->count < MOST_WORDS ? line->count : MOST_WORDS) - 1].end : line->begin;
    pia_input_quote(line->begin, end, quote);
    return pia_input_fail(context, input, line->begin, "'%s' %s", quote, why);
}

static pia_status read_encoding(pia_context *context, const pia_input *input, const words *line, pia_ply_header *header)
{
    static const char *const name[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    for (int k = 0; k < 3 && line->count == 3; k++) {
        if (!is(&line->word[1], name[k])) continue;
        header->encoding = k;
        return PIA_OK;
    }
    return refuse_line(context, input, line, "is no format of PLY; write it as ascii, binary_little_endian or binary_big_endian 1.0");
}

/* A count of up to 18 digits. */
static int parse_count(const pia_text_field *word, pia_index *count)
{
    *count = 0;
    for (const char *p = word->begin; p < word->end; p++) {
        if (*p < '0' || *p > '9' || word->end - word->begin > 18) return 0;
        *count = *count * 10 + (*p - '0');
    }
    return 1;
}

static pia_status read_element(pia_context *context, const pia_input *input, const words *line, pia_ply_header *header)
{
    pia_ply_element element = {.first = header->property_count, .end = header->property_count, .fixed = 1};
    if (line->count != 3 || !parse_count(&line->word[2], &element.count))
        return refuse_line(context, input, line, "is no element of PLY; write its name and its count, of at most 18 digits");
    void *block = header->element;
    int grown = pia_memory_grow(pia_memory_of(context), &block, &header->element_capacity, header->element_count + 1, sizeof element);
    header->element = block;
    if (!grown) return pia_fail(context, PIA_E_MEMORY, "%s: out of memory in its header", input->path);
    header->element[header->element_count++] = element;
    return PIA_OK;
}

static pia_status read_property(pia_context *context, const pia_input *input, const words *line, pia_ply_header *header)
{
    int list = line->count > 1 && is(&line->word[1], "list");
    if (header->element_count == 0 || line->count != (list ? 5 : 3))
        return refuse_line(context, input, line, "is no property of PLY; write a type and a name, or list and two types and a name");
    const pia_text_field *name = &line->word[list ? 4 : 2];
    pia_ply_property property = {.type = type_of(&line->word[list ? 3 : 1]), .name = name->begin, .name_size = name->end - name->begin};
    if (list) property.length = type_of(&line->word[2]);
    if (property.type.kind == 0 || (list && property.length.kind == 0))
        return refuse_line(context, input, line, "has a type that PLY does not know; write char to double, or int8 to float64");
    if (memchr(property.name, '"', (size_t)property.name_size) != NULL)
        return refuse_line(context, input, line, "has a name with a quote; rename it");
    void *block = header->property;
    int grown =
        pia_memory_grow(pia_memory_of(context), &block, &header->property_capacity, header->property_count + 1, sizeof property);
    header->property = block;
    if (!grown) return pia_fail(context, PIA_E_MEMORY, "%s: out of memory in its header", input->path);
    header->property[header->property_count++] = property;
    pia_ply_element *element = &header->element[header->element_count - 1];
    element->end = header->property_count;
    element->fixed &= !list;
    element->least_size += header->encoding == PIA_PLY_ASCII ? 2 : list ? property.length.size : property.type.size;
    return PIA_OK;
}

static pia_status read_lines(pia_context *context, const pia_input *input, const char *p, pia_ply_header *header)
{
    int encoded = 0, behind = 0, found = 0; /* behind: past the vertices */
    for (;;) {
        words line;
        pia_status status = PIA_OK;
        const char *next = take_words(p, input->end, &line);
        if (next == NULL) return pia_input_fail(context, input, NULL, "ends inside its PLY header; copy it again");
        const pia_text_field *word = line.word;
        p = next;
        if (line.count == 0 || is(word, "comment") || is(word, "obj_info")) continue;
        if (is(word, "end_header")) break;
        if (is(word, "format")) {
            encoded = 1;
            status = read_encoding(context, input, &line, header);
        } else if (!encoded) {
            status = refuse_line(context, input, &line, "comes before the line of the format; write the format first");
        } else if (is(word, "element")) {
            behind = found;
            if (!behind) status = read_element(context, input, &line, header);
            found |= line.count > 1 && is(&word[1], "vertex");
        } else if (is(word, "property")) {
            if (!behind) status = read_property(context, input, &line, header);
        } else {
            status = refuse_line(context, input, &line, "means nothing in a PLY header; remove it");
        }
        if (status != PIA_OK) return status;
    }
    header->data = p;
    return found ? PIA_OK : pia_input_fail(context, input, NULL, "has no element vertex; a PLY file of points needs one");
}

pia_status pia_ply_read_header(pia_context *context, const pia_input *input, pia_ply_header *out)
{
    words line;
    pia_ply_header header = {0};
    pia_index size = input->end - input->begin;
    const char *p = size > 4 && memcmp(input->begin, "ply", 3) == 0 ? take_words(input->begin, input->end, &line) : NULL;
    if (p == NULL || line.count != 1 || !is(line.word, "ply"))
        return pia_input_fail(context, input, NULL, "is not a PLY file; name its format");
    pia_status status = read_lines(context, input, p, &header);
    if (status == PIA_OK)
        *out = header;
    else
        pia_ply_clear(context, &header);
    return status;
}

void pia_ply_clear(pia_context *context, pia_ply_header *header)
{
    pia_give(context, header->element);
    pia_give(context, header->property);
    *header = (pia_ply_header){0};
}
