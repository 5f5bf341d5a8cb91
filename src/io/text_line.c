#include "number.h"
#include "text.h"

pia_text_line pia_text_line_at(const char *p, const char *end)
{
    while (p < end && pia_text_is_blank(*p)) p++;
    pia_text_line line = {.begin = p};
    int quoted = 0;
    for (; p < end && !pia_text_is_end(*p) && (quoted || *p != '#'); p++) quoted ^= *p == '"';
    line.end = p;
    line.commented = p < end && *p == '#';
    while (p < end && !pia_text_is_end(*p)) p++;
    line.next = pia_text_skip_end(p, end);
    while (line.end > line.begin && pia_text_is_blank(line.end[-1])) line.end--;
    return line;
}

/* Behind the closing quote of a quoted field at p, or the line's end. */
static const char *skip_quoted(const char *p, const char *end)
{
    for (p++; p < end; p++) {
        if (*p != '"') continue;
        if (p + 1 == end || p[1] != '"') return p + 1;
        p++; /* a doubled quote stands for one */
    }
    return end;
}

static void trim(pia_text_field *field)
{
    while (field->begin < field->end && pia_text_is_blank(*field->begin)) field->begin++;
    while (field->end > field->begin && pia_text_is_blank(field->end[-1])) field->end--;
    if (field->end - field->begin < 2 || *field->begin != '"' || field->end[-1] != '"') return;
    field->begin++;
    field->end--;
    trim(field);
}

static int ends_field(char c, char delimiter)
{
    return delimiter == ' ' ? pia_text_is_blank(c) : c == delimiter;
}

int pia_text_next_field(const pia_text_line *line, char delimiter, const char **p, pia_text_field *out)
{
    const char *q = *p;
    if (q == NULL || line->begin == line->end) return 0;
    out->begin = q;
    if (q < line->end && *q == '"') q = skip_quoted(q, line->end);
    while (q < line->end && !ends_field(*q, delimiter)) q++;
    out->end = q;
    trim(out);
    if (q == line->end) {
        *p = NULL;
        return 1;
    }
    q++;
    while (q < line->end && pia_text_is_blank(*q)) q++;
    *p = q;
    return 1;
}

/* A longer number is no measured one. */
enum { LONGEST = 256 };

/* The field with '.' for its decimal point and 'e' for its exponent; returns its length, 0 where it cannot be a number. */
static size_t translate(const pia_text_field *field, char point, char *out)
{
    size_t length = (size_t)(field->end - field->begin);
    int commas = 0;
    if (length > LONGEST) return 0;
    for (size_t i = 0; i < length; i++) {
        char c = field->begin[i];
        if (point == ',' && c == '.') return 0;
        commas += c == ',';
        out[i] = c == point ? '.' : c == 'D' || c == 'd' ? 'e' : c;
    }
    return commas <= (point == ',') ? length : 0;
}

int pia_text_number(const pia_text_field *field, char point, double *value)
{
    char text[LONGEST];
    if (field->begin == field->end) return 0;
    if (point == '.' && pia_number_parse(field->begin, field->end, value) == field->end) return 1;
    size_t length = translate(field, point, text);
    return length > 0 && pia_number_parse(text, text + length, value) == text + length;
}
