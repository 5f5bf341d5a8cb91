#include "number.h"
#include "text.h"

#include <string.h>

/* Lines searched for the first row, and rows that decide which columns hold numbers. */
enum { SEARCHED_LINES = 1000, SAMPLED_ROWS = 100 };

typedef struct line_shape {
    char delimiter, point;
    pia_index fields, numbers, empty;
} line_shape;

static char guess_delimiter(const pia_text_line *line)
{
    size_t length = (size_t)(line->end - line->begin);
    if (memchr(line->begin, ';', length) != NULL) return ';';
    return memchr(line->begin, ',', length) != NULL ? ',' : ' ';
}

static line_shape shape_with(const pia_text_line *line, char delimiter, char point)
{
    line_shape shape = {.delimiter = delimiter, .point = point};
    const char *p = line->begin;
    pia_text_field field;
    double value;
    for (; pia_text_next_field(line, delimiter, &p, &field); shape.fields++) {
        shape.numbers += pia_text_number(&field, point, &value);
        shape.empty += field.begin == field.end;
    }
    return shape;
}

static int holds_numbers_only(const line_shape *shape)
{
    return shape->numbers > 0 && shape->numbers + shape->empty == shape->fields;
}

static int has(const pia_text_line *line, char c)
{
    return memchr(line->begin, c, (size_t)(line->end - line->begin)) != NULL;
}

/* Commas are decimal where semicolons or tabs delimit and nothing else makes numbers of all fields. */
static line_shape shape_of(const pia_text_line *line)
{
    line_shape shape = shape_with(line, guess_delimiter(line), '.');
    if (holds_numbers_only(&shape) || !has(line, ',') || !(has(line, ';') || has(line, '\t'))) return shape;
    line_shape decimal = shape_with(line, has(line, ';') ? ';' : ' ', ',');
    return holds_numbers_only(&decimal) ? decimal : shape;
}

static int look_alike(const line_shape *a, const line_shape *b)
{
    return a->delimiter == b->delimiter && a->fields == b->fields && a->numbers > 0 && b->numbers > 0;
}

/* A number, whole or with something behind it that makes it none: "0x10", "1.2.3". */
static int begins_as_number(const pia_text_field *field)
{
    double value;
    return field->begin < field->end && pia_number_parse(field->begin, field->end, &value) != NULL;
}

/* Every column that holds a number in `row` holds one in `line`, if a damaged one: it is a row as well, which must not be lost as a
 * header with a number in it. */
static int is_like_row(const pia_text_line *line, const pia_text_line *row, const line_shape *shape)
{
    const char *p = line->begin, *q = row->begin;
    pia_text_field field, other;
    double value;
    while (pia_text_next_field(line, shape->delimiter, &p, &field) && pia_text_next_field(row, shape->delimiter, &q, &other))
        if (pia_text_number(&other, shape->point, &value) && !begins_as_number(&field)) return 0;
    return 1;
}

/* The first line at or after p that is neither blank nor a comment; 0 at the end of the file. */
static int next_content(const char *p, const char *end, pia_text_line *line)
{
    while (p < end) {
        *line = pia_text_line_at(p, end);
        if (line->begin < line->end) return 1;
        p = line->next;
    }
    return 0;
}

/* "12442" above rows of coordinates. */
static int is_count(const line_shape *shape, const pia_text_line *line, const char *end)
{
    pia_text_line next;
    return shape->fields == 1 && next_content(line->next, end, &next) && shape_of(&next).fields > 1;
}

/* The first row; NULL when no line holds a number. A run is a stretch of lines that look alike and hold a number each. */
static const char *find_first_row(const pia_input *input, line_shape *row)
{
    line_shape previous = {0}, labelled = {0};
    const char *run = NULL, *labelled_run = NULL, *p = input->begin;
    pia_text_line line, first, next;
    for (int i = 0; i < SEARCHED_LINES && next_content(p, input->end, &line); i++, p = line.next) {
        line_shape shape = shape_of(&line);
        int continues = look_alike(&previous, &shape) && (i != 1 || is_like_row(&first, &line, &shape));
        if (i == 0) first = line;
        if (!continues) run = line.begin;
        if (holds_numbers_only(&shape) && !is_count(&shape, &line, input->end)) {
            *row = shape;
            return run;
        }
        if (labelled_run == NULL && shape.numbers > 0 && (continues || !next_content(line.next, input->end, &next))) {
            labelled_run = run;
            labelled = shape;
        }
        previous = shape;
    }
    *row = labelled;
    return labelled_run;
}

/* A text column holds labels, but "0,5" or "1 2" in one field tells of a decimal comma or of two delimiters. */
static pia_status refuse_several_numbers(pia_context *context, const pia_input *input, const pia_text_line *line, char delimiter)
{
    const char *p = line->begin;
    pia_text_field field;
    for (pia_index f = 1; pia_text_next_field(line, delimiter, &p, &field); f++) {
        line_shape parts = shape_of(&(pia_text_line){.begin = field.begin, .end = field.end});
        if (parts.fields < 2 || !holds_numbers_only(&parts)) continue;
        char quote[32];
        pia_input_quote(field.begin, field.end, quote);
        return pia_input_fail(context, input, field.begin,
                              "field %lld holds several numbers, '%s'; use one delimiter in all rows, and '.' as the decimal point",
                              (long long)f, quote);
    }
    return PIA_OK;
}

static pia_status refuse_without_rows(pia_context *context, const pia_input *input)
{
    pia_text_line line;
    const char *p = input->begin;
    for (int i = 0; i < SEARCHED_LINES && next_content(p, input->end, &line); i++, p = line.next) {
        pia_status status = refuse_several_numbers(context, input, &line, guess_delimiter(&line));
        if (status != PIA_OK) return status;
    }
    return pia_input_fail(context, input, NULL, "holds no row of numbers; give at least one point a line");
}

/* Rows of whole numbers say nothing of the decimal point: the first number that has one does. */
static char point_of(const pia_input *input, const pia_text_layout *layout)
{
    pia_text_line line;
    const char *p = layout->data;
    for (int i = 0; i < SAMPLED_ROWS && next_content(p, input->end, &line); i++, p = line.next) {
        if (layout->delimiter == ',' || has(&line, '.') || (layout->delimiter == ' ' && !has(&line, '\t'))) return '.';
        line_shape shape = shape_with(&line, layout->delimiter, ',');
        if (has(&line, ',')) return shape.fields == layout->field_count && holds_numbers_only(&shape) ? ',' : '.';
    }
    return '.';
}

static pia_status sample_columns(pia_context *context, const pia_input *input, pia_text_layout *layout)
{
    pia_text_line line;
    const char *p = layout->data;
    for (int i = 0; i < SAMPLED_ROWS && next_content(p, input->end, &line); i++, p = line.next) {
        const char *q = line.begin;
        pia_text_field field;
        double value;
        for (pia_index f = 0; f < layout->field_count && pia_text_next_field(&line, layout->delimiter, &q, &field); f++)
            if (pia_text_number(&field, layout->point, &value)) layout->numeric[f] = 1;
        pia_status status = i == 0 && layout->point == '.' ? refuse_several_numbers(context, input, &line, layout->delimiter) : PIA_OK;
        if (status != PIA_OK) return status;
    }
    return PIA_OK;
}

static pia_index count_fields(const pia_text_line *line, char delimiter)
{
    const char *p = line->begin;
    pia_text_field field;
    pia_index count = 0;
    while (pia_text_next_field(line, delimiter, &p, &field)) count++;
    return count;
}

/* The last line before the data, if it has one name a field; else the last comment that has. */
static void find_names(const pia_input *input, pia_text_layout *layout)
{
    pia_text_line header = {0}, comment = {0};
    const char *p = input->begin;
    while (p < layout->data) {
        pia_text_line line = pia_text_line_at(p, input->end);
        if (line.begin == layout->data) break;
        if (line.begin < line.end) {
            header = line;
            layout->header_count++;
        } else if (line.commented) {
            pia_text_line text = pia_text_line_at(line.begin + 1, input->end);
            if (count_fields(&text, layout->delimiter) == layout->field_count && shape_of(&text).numbers == 0) comment = text;
        }
        p = line.next;
    }
    if (header.begin != NULL && count_fields(&header, layout->delimiter) == layout->field_count)
        layout->names = header;
    else if (header.begin == NULL)
        layout->names = comment;
}

static pia_status check_text(pia_context *context, const pia_input *input)
{
    pia_index size = input->end - input->begin;
    size_t looked = size < 4096 ? (size_t)size : 4096;
    if (size == 0) return pia_input_fail(context, input, NULL, "is empty; give rows of numbers");
    if (size >= 2 && (memcmp(input->begin, "\xff\xfe", 2) == 0 || memcmp(input->begin, "\xfe\xff", 2) == 0))
        return pia_input_fail(context, input, NULL, "is UTF-16 text; save it as UTF-8");
    if (memchr(input->begin, '\0', looked) != NULL) return pia_input_fail(context, input, NULL, "is not text; name its format");
    return PIA_OK;
}

pia_status pia_text_find_layout(pia_context *context, const pia_input *input, pia_text_layout *out)
{
    pia_status status = check_text(context, input);
    if (status != PIA_OK) return status;
    line_shape row;
    pia_text_layout layout = {.data = find_first_row(input, &row)};
    if (layout.data == NULL) return refuse_without_rows(context, input);
    layout.delimiter = row.delimiter;
    layout.field_count = row.fields;
    layout.point = row.point == ',' ? ',' : point_of(input, &layout);
    find_names(input, &layout);
    layout.numeric = pia_take_zero(context, layout.field_count, 1);
    if (layout.numeric == NULL) return pia_take_status(context, layout.field_count, 1);
    status = sample_columns(context, input, &layout);
    if (status == PIA_OK)
        *out = layout;
    else
        pia_give(context, layout.numeric);
    return status;
}
