/* The page as it was built from web/: markup, style and program, with the places where title and data go. */
#ifndef PIA_REPORT_PAGE_TEMPLATE_H
#define PIA_REPORT_PAGE_TEMPLATE_H

#include <stddef.h>

/* A piece of text, not terminated. */
typedef struct pia_slice {
    const char *text;
    size_t size;
} pia_slice;

/* The page in three pieces: up to the title, from there up to the data, and the rest. */
void pia_page_template(pia_slice out[3]);

#endif
