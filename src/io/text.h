/* Text tables: lines, fields, where the data begin and which columns hold numbers. */
#ifndef PIA_IO_TEXT_H
#define PIA_IO_TEXT_H

#include "io.h"

/* One line without its end, its comment ('#' outside quotes) and blanks around it; empty when begin == end. */
typedef struct pia_text_line {
    const char *begin, *end;
    const char *next; /* the line after it */
    int commented;    /* a comment was cut off */
} pia_text_line;

typedef struct pia_text_field {
    const char *begin, *end; /* without quotes and blanks around it */
} pia_text_field;

/* p < end. */
pia_text_line pia_text_line_at(const char *p, const char *end);

/* The field at *p, which moves behind it and its delimiter; 0 when the line has no more. *p starts as line->begin. delimiter ' '
 * stands for any run of blanks and tabs. A trailing comma or semicolon is followed by one more, empty field. */
int pia_text_next_field(const pia_text_line *line, char delimiter, const char **p, pia_text_field *out);

/* The whole field as a number, also one that is not finite; 0 when it is something else. Exponents may be Fortran's: 1.5D+03. point:
 * the decimal one, '.' or ','; a ',' is the only one that the number has, and '.' is no part of it then. */
int pia_text_number(const pia_text_field *field, char point, double *value);

/* Line ends: LF, CRLF, CR. */
static inline int pia_text_is_end(char c)
{
    return c == '\n' || c == '\r';
}

static inline int pia_text_is_blank(char c)
{
    return c == ' ' || c == '\t';
}

/* p at a line end or at `end`: the next line. */
static inline const char *pia_text_skip_end(const char *p, const char *end)
{
    if (p < end && *p == '\r') return p + 1 < end && p[1] == '\n' ? p + 2 : p + 1;
    return p < end ? p + 1 : p;
}

/* What a table looks like. */
typedef struct pia_text_layout {
    char delimiter;         /* ',' ';' or ' ' */
    char point;             /* of numbers: '.' or ',' */
    const char *data;       /* the first row */
    pia_index field_count;  /* fields of a row */
    char *numeric;          /* [field_count] 1: the first rows hold numbers there */
    pia_text_line names;    /* line with one name a field; begin NULL: none */
    pia_index header_count; /* lines before the data, without comments and blank lines */
} pia_text_layout;

/* Reads the first rows. The data begin at the first line that holds numbers only (a lone number before wider rows is a count), or, in
 * tables with text columns, at the first of two lines with numbers in the same column. PIA_E_FORMAT: empty, no row of numbers, not
 * text. layout->numeric is the caller's to give back. */
pia_status pia_text_find_layout(pia_context *context, const pia_input *input, pia_text_layout *out);

/* The columns wanted: slot[field] is the output column or -1. */
typedef struct pia_text_columns {
    pia_index *slot;  /* [layout field_count] */
    pia_index *field; /* [count] field of each output column */
    pia_index count;
    pia_index contour; /* field that tells rows of different contours apart; -1: none */
} pia_text_columns;

/* list: names or numbers from 1, separated by commas; NULL: all numeric columns. PIA_E_ARGUMENT names the column that is unknown or
 * listed twice. The arrays are the caller's to give back. */
pia_status pia_text_choose_columns(pia_context *context, const pia_input *input, const pia_text_layout *layout, const char *list,
                                   pia_text_columns *out);

/* A column called "contour" tells rows of different contours apart: it is no component of the points unless it was listed, or is all
 * that there is. */
void pia_text_set_contour_apart(const pia_text_layout *layout, int listed, pia_text_columns *columns);

/* The names of the chosen columns into out->names [columns->count]; nothing when the layout has none. out->dim is that count. */
pia_status pia_text_copy_names(pia_context *context, const pia_text_layout *layout, const pia_text_columns *columns, pia_points *out);

/* Reads all rows into out->points [count[0] x columns->count], out->part and, where rows were skipped, out->row. A part ends at a blank
 * line, and where the text of the contour changes. */
pia_status pia_text_read_rows(pia_context *context, const pia_input *input, const pia_text_layout *layout,
                              const pia_text_columns *columns, const pia_points_options *options, pia_points *out);

#endif
