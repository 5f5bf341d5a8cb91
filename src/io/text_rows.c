#include "number.h"
#include "text.h"

#include <math.h>
#include <string.h>

/* One pass: a tight loop takes rows of plain numbers; any row that it does not understand is taken apart field by field, which
 * either reads it (quotes, other columns' text) or says what is wrong with it. */

typedef struct reading {
    pia_context *context;
    const pia_input *input;
    const pia_text_layout *layout;
    const pia_text_columns *columns;
    const pia_points_options *options;
    double *values;
    pia_index count, capacity; /* rows */
    pia_index *row, row_capacity;
    pia_index *part, part_count, part_capacity;
    pia_text_field contour, contour_before; /* of the row just read, and of the one before; begin NULL: none */
    pia_index skipped;
} reading;

static const char *skip_blanks(const char *p, const char *end)
{
    while (p < end && pia_text_is_blank(*p)) p++;
    return p;
}

/* Behind the delimiter at p; NULL when something else is there. `before` is where blanks began. */
static inline const char *skip_delimiter(const char *before, const char *p, const char *end, char delimiter)
{
    if (delimiter == ' ') return p > before ? p : NULL;
    return p < end && *p == delimiter ? skip_blanks(p + 1, end) : NULL;
}

static const char *skip_text(const char *p, const char *end, char delimiter)
{
    while (p < end && *p != delimiter && *p != '"' && *p != '#' && !pia_text_is_end(*p) && (delimiter != ' ' || *p != '\t')) p++;
    return p;
}

static pia_text_field without_blanks(const char *begin, const char *end)
{
    while (end > begin && pia_text_is_blank(end[-1])) end--;
    return (pia_text_field){begin, end};
}

/* Reads a plain row at p, which is not blank; returns the next line, or NULL when the row needs a closer look. */
static const char *read_plainly(reading *r, const char *p, double *values)
{
    const char *end = r->input->end;
    const pia_index last = r->layout->field_count - 1, *slot = r->columns->slot;
    const char delimiter = r->layout->delimiter;
    if (r->layout->point != '.') return NULL;
    for (pia_index f = 0;; f++) {
        if (slot[f] < 0) {
            const char *begin = p;
            p = skip_text(p, end, delimiter);
            if (f == r->columns->contour) r->contour = without_blanks(begin, p);
        } else {
            double *value = &values[slot[f]];
            p = pia_number_parse(p, end, value);
            if (p == NULL || !isfinite(*value)) return NULL;
        }
        const char *before = p;
        p = skip_blanks(p, end);
        if (f == last) break;
        p = skip_delimiter(before, p, end, delimiter);
        if (p == NULL) return NULL;
    }
    if (p < end && *p == '#')
        p = pia_text_line_at(p, end).next;
    else if (p < end && pia_text_is_end(*p))
        p = pia_text_skip_end(p, end);
    else if (p < end)
        return NULL;
    return p;
}

/* Why a row cannot be used: its number of fields, or the first field that is no finite number. */
typedef struct problem {
    pia_index field_count;
    pia_index index;      /* of the field */
    pia_text_field field; /* begin NULL: the number of fields */
    int number;           /* 1: a number, but not finite */
} problem;

/* Takes a row apart field by field; returns 0 when it is good. */
static int find_problem(reading *r, const pia_text_line *line, double *values, problem *out)
{
    *out = (problem){0};
    pia_text_field field;
    const char *p = line->begin;
    while (pia_text_next_field(line, r->layout->delimiter, &p, &field)) out->field_count++;
    if (out->field_count != r->layout->field_count) return 1;
    p = line->begin;
    for (pia_index f = 0; pia_text_next_field(line, r->layout->delimiter, &p, &field); f++) {
        double value = 0;
        if (f == r->columns->contour) r->contour = field;
        if (r->columns->slot[f] < 0) continue;
        int number = pia_text_number(&field, r->layout->point, &value);
        if (!number || !(isfinite(value) || (isnan(value) && r->options->allow_nan > 0))) {
            out->index = f;
            out->field = field;
            out->number = number;
            return 1;
        }
        values[r->columns->slot[f]] = value;
    }
    return 0;
}

static pia_status refuse_row(const reading *r, const pia_text_line *line, const problem *why)
{
    char quote[32];
    long long field = (long long)why->index + 1;
    if (why->field.begin == NULL)
        return pia_input_fail(r->context, r->input, line->begin,
                              "row has %lld field%s, the rows before had %lld; correct it, or skip invalid rows",
                              (long long)why->field_count, why->field_count == 1 ? "" : "s", (long long)r->layout->field_count);
    pia_input_quote(why->field.begin, why->field.end, quote);
    if (why->field.begin == why->field.end)
        return pia_input_fail(r->context, r->input, line->begin, "field %lld is empty; fill it in, or skip invalid rows", field);
    if (why->number)
        return pia_input_fail(r->context, r->input, line->begin,
                              "field %lld is '%s', not a finite number; correct it, or skip invalid rows", field, quote);
    if (memchr(why->field.begin, ',', (size_t)(why->field.end - why->field.begin)) != NULL || r->layout->point == ',')
        return pia_input_fail(
            r->context, r->input, line->begin,
            "field %lld is '%s', not a number with decimal %s, as those before; write all with the same decimal point", field, quote,
            r->layout->point == ',' ? "comma" : "point");
    return pia_input_fail(r->context, r->input, line->begin,
                          "field %lld is '%s', not a number; correct it, choose other columns, or skip invalid rows", field, quote);
}

/* Room for one more row. The bytes read so far tell how many rows the rest will hold, so that few copies are made and little is
 * taken in vain. */
static pia_status make_room(reading *r, const char *p)
{
    if (r->count < r->capacity) return PIA_OK;
    double total = (double)(r->input->end - r->layout->data), done = (double)(p - r->layout->data);
    double estimate = done > 0 ? (double)r->count * (total / done) * 1.1 : 0;
    pia_index wanted = r->count + 64, size;
    if (estimate > (double)wanted) wanted = (pia_index)estimate;
    if (!pia_multiply(wanted, r->columns->count, &size)) return pia_fail(r->context, PIA_E_SIZE, "%s: too many rows", r->input->path);
    double *larger = pia_take(r->context, size, sizeof *larger);
    if (larger == NULL) return pia_take_status(r->context, size, sizeof *larger);
    if (r->count > 0) memcpy(larger, r->values, (size_t)(r->count * r->columns->count) * sizeof *larger);
    pia_give(r->context, r->values);
    r->values = larger;
    r->capacity = wanted;
    return PIA_OK;
}

static pia_status append_index(reading *r, pia_index **list, pia_index *capacity, pia_index count, pia_index value)
{
    void *block = *list;
    int grown = pia_memory_grow(pia_memory_of(r->context), &block, capacity, count + 1, sizeof **list);
    *list = block;
    if (!grown)
        return pia_fail(r->context, PIA_E_MEMORY, "%s: out of memory after %lld rows; free memory or split the file", r->input->path,
                        (long long)r->count);
    (*list)[count] = value;
    return PIA_OK;
}

/* Ends the part before the next row, if it has rows. */
static pia_status end_part(reading *r)
{
    pia_index begin = r->part_count > 0 ? r->part[r->part_count] : 0;
    if (r->count == begin) return PIA_OK;
    pia_status status = r->part_count == 0 ? append_index(r, &r->part, &r->part_capacity, 0, 0) : PIA_OK;
    if (status == PIA_OK) status = append_index(r, &r->part, &r->part_capacity, r->part_count + 1, r->count);
    if (status == PIA_OK) r->part_count++;
    return status;
}

/* Ends the part before the row just read, which is not counted yet, where its contour is another one. */
static pia_status compare_contour(reading *r)
{
    pia_text_field now = r->contour, before = r->contour_before;
    size_t size = (size_t)(now.end - now.begin);
    int same = before.begin != NULL && (size_t)(before.end - before.begin) == size && memcmp(before.begin, now.begin, size) == 0;
    r->contour_before = now;
    return same ? PIA_OK : end_part(r);
}

static pia_status read_row(reading *r, const char *p, const char **next)
{
    pia_status status = make_room(r, p);
    if (status != PIA_OK) return status;
    double *values = r->values + r->count * r->columns->count;
    *next = read_plainly(r, p, values);
    if (*next == NULL) {
        problem why;
        pia_text_line line = pia_text_line_at(p, r->input->end);
        *next = line.next;
        int bad = find_problem(r, &line, values, &why);
        if (bad && !r->options->skip_invalid) return refuse_row(r, &line, &why);
        r->skipped += bad;
        if (bad) return PIA_OK;
    }
    if (r->options->skip_invalid) status = append_index(r, &r->row, &r->row_capacity, r->count, r->count + r->skipped);
    if (status == PIA_OK && r->columns->contour >= 0) status = compare_contour(r);
    if (status == PIA_OK) r->count++;
    return status;
}

static pia_status read_all(reading *r)
{
    const char *end = r->input->end, *p = r->layout->data;
    pia_status status = PIA_OK;
    while (p < end && status == PIA_OK) {
        p = skip_blanks(p, end);
        if (p == end) break;
        if (pia_text_is_end(*p)) {
            status = end_part(r);
            p = pia_text_skip_end(p, end);
        } else if (*p == '#') {
            p = pia_text_line_at(p, end).next;
        } else {
            status = read_row(r, p, &p);
        }
    }
    if (status == PIA_OK) status = end_part(r);
    if (status == PIA_OK && r->count == 0)
        status = pia_input_fail(r->context, r->input, NULL, "all %lld rows are invalid; correct them", (long long)r->skipped);
    return status;
}

pia_status pia_text_read_rows(pia_context *context, const pia_input *input, const pia_text_layout *layout,
                              const pia_text_columns *columns, const pia_points_options *options, pia_points *out)
{
    reading r = {.context = context, .input = input, .layout = layout, .columns = columns, .options = options};
    pia_status status = read_all(&r);
    if (status != PIA_OK || r.skipped == 0) {
        pia_give(context, r.row);
        r.row = NULL;
    }
    if (status != PIA_OK) {
        pia_give(context, r.values);
        pia_give(context, r.part);
        return status;
    }
    out->points = r.values;
    out->count[0] = r.count;
    out->count[1] = 1;
    out->part = r.part;
    out->part_count = r.part_count;
    out->row = r.row;
    out->skipped = r.skipped;
    return PIA_OK;
}
