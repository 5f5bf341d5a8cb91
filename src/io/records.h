/* Points from records whose fields have names, for formats other than text. */
#ifndef PIA_IO_RECORDS_H
#define PIA_IO_RECORDS_H

#include "text.h"

/* A number in a file of binary records. */
typedef struct pia_record_type {
    char kind; /* 'i' 'u' 'f'; 0: none */
    int size;  /* bytes: 1, 2, 4, 8; a float 4 or 8 */
} pia_record_type;

/* The number at `at`; big: the most significant byte comes first. */
double pia_record_load(const char *at, pia_record_type type, int big);

/* The columns wanted of `count` fields: names is one line with their names, separated by blanks, without quotes; list as for
 * pia_text_choose_columns, NULL: otherwise. Takes out->points for `rows` rows, sets kind, count, dim and names. PIA_E_ARGUMENT,
 * PIA_E_MEMORY, PIA_E_SIZE. columns is the caller's to give back, empty on failure. */
pia_status pia_records_begin(pia_context *context, const pia_input *input, const pia_text_line *names, pia_index count,
                             const char *list, const char *otherwise, pia_index rows, pia_text_columns *columns, pia_points *out);

#endif
