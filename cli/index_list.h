/* Lists of data rows or control points as options take them: "0,40,80-90", "every:50", "ends", or a file with one a row. */
#ifndef PIA_CLI_INDEX_LIST_H
#define PIA_CLI_INDEX_LIST_H

#include "session.h"

/* The rows of one part of a file: what a list may name, and where it lies among the rows that were kept. */
struct row_span {
    const pia_index *row;   /* file row of each kept row; NULL: all were kept */
    pia_index first, count; /* kept rows of this part */
    pia_index total;        /* rows in the file, dropped ones included */
    int any_order;          /* 1: rows were put into another order */
};

struct index_list {
    pia_index *item; /* [count] within the span, increasing, each once; kept by the session */
    pia_index count;
};

/* Row of the file of kept row `index` of the span. */
pia_index row_in_file(const struct row_span *span, pia_index index);
/* Kept row of the span that is row `file_row` of the file; -1: dropped, or in another part. */
pia_index row_in_span(const struct row_span *span, pia_index file_row);

/* Reads a list. Numbers are rows of the file; "ends" and "every:K" count within the span; rows of other parts are left out. A row that
 * the file does not have, or that was dropped, is an error. Returns an exit status. */
int index_list_read(struct session *session, const char *option, const char *text, const struct row_span *span, struct index_list *out);

#endif
