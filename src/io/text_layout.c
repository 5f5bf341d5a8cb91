#include "text.h"

#include <string.h>

/* Lines searched for the first row, and rows that decide which columns hold numbers. */
enum { SEARCHED_LINES = 1000, SAMPLED_ROWS = 100 };

typedef struct line_shape {
    char delimiter;
    pia_index fields, numbers, empty;
    pia_index first_number; /* index of the first field that is a number; -1 */
} line_shape;

static char guess_delimiter(const pia_text_line *line)
{
    size_t length = (size_t)(line->end - line->begin);
    if (memchr(line->begin, ';', length) != NULL) return ';';
    return memchr(line->begin, ',', length) != NULL ? ',' : ' ';
}

static line_shape shape_of(const pia_text_line *line)
{
    line_shape shape = {.delimiter = guess_delimiter(line), .first_number = -1};
    const char *p = line->begin;
    pia_text_field field;
    double value;
    for (; pia_text_next_field(line, shape.delimiter, &p, &field); shape.fields++) {
        int number = pia_text_number(&field, &value);
        if (number && shape.first_number < 0) shape.first_number = shape.fields;
        shape.numbers += number;
        shape.empty += field.begin == field.end;
    }
    return shape;
}

static int holds_numbers_only(const line_shape *shape)
{
    return shape->numbers > 0 && shape->numbers + shape->empty == shape->fields;
}

static int look_alike(const line_shape *a, const line_shape *b)
{
    return a->delimiter == b->delimiter && a->fields == b->fields && a->numbers > 0 && b->numbers > 0;
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
static const char *find_first_row(const pia_input *input, const char *begin, line_shape *row)
{
    line_shape previous = {0}, labelled = {0};
    const char *run = NULL, *labelled_run = NULL;
    pia_text_line line;
    const char *p = begin;
    for (int i = 0; i < SEARCHED_LINES && next_content(p, input->end, &line); i++, p = line.next) {
        line_shape shape = shape_of(&line);
        int continues = look_alike(&previous, &shape);
        if (holds_numbers_only(&shape) && !is_count(&shape, &line, input->end)) {
            *row = shape;
            return continues && i > 1 ? run : line.begin; /* the line before a first row may be a title with a number in it */
        }
        if (!continues) run = line.begin;
        pia_text_line next;
        if (labelled_run == NULL && shape.numbers > 0 && (continues || !next_content(line.next, input->end, &next))) {
            labelled_run = run;
            labelled = shape;
        }
        previous = shape;
    }
    *row = labelled;
    return labelled_run;
}

/* Says why a text that is no number keeps a row from being read; NULL when it may be a label. */
static const char *why_not_label(const pia_text_field *field)
{
    pia_text_line whole = {.begin = field->begin, .end = field->end};
    line_shape parts = shape_of(&whole);
    if (parts.fields > 1 && holds_numbers_only(&parts)) return "use one delimiter in all rows, and '.' as the decimal point";
    return NULL;
}

static pia_status sample_columns(pia_context *context, const pia_input *input, pia_text_layout *layout)
{
    pia_text_line line;
    const char *p = layout->data;
    for (int i = 0; i < SAMPLED_ROWS && next_content(p, input->end, &line); i++, p = line.next) {
        const char *q = line.begin;
        pia_text_field field;
        double value;
        for (pia_index f = 0; f < layout->field_count && pia_text_next_field(&line, layout->delimiter, &q, &field); f++) {
            const char *why = NULL;
            if (pia_text_number(&field, &value))
                layout->numeric[f] = 1;
            else if (i == 0 && (why = why_not_label(&field)) != NULL) {
                char quote[32];
                pia_input_quote(field.begin, field.end, quote);
                return pia_input_fail(context, input, field.begin, "field %lld holds several numbers, '%s'; %s", (long long)f + 1,
                                      quote, why);
            }
        }
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
static void find_names(const pia_input *input, const char *begin, pia_text_layout *layout)
{
    pia_text_line header = {0}, comment = {0};
    const char *p = begin;
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
    int marked = input->end - input->begin >= 3 && memcmp(input->begin, "\xef\xbb\xbf", 3) == 0;
    const char *begin = input->begin + (marked ? 3 : 0);
    line_shape row;
    pia_text_layout layout = {.data = find_first_row(input, begin, &row)};
    if (layout.data == NULL) return pia_input_fail(context, input, NULL, "holds no row of numbers; give at least one point a line");
    layout.delimiter = row.delimiter;
    layout.field_count = row.fields;
    find_names(input, begin, &layout);
    layout.numeric = pia_take_zero(context, layout.field_count, 1);
    if (layout.numeric == NULL) return pia_take_status(context, layout.field_count, 1);
    status = sample_columns(context, input, &layout);
    if (status == PIA_OK)
        *out = layout;
    else
        pia_give(context, layout.numeric);
    return status;
}
