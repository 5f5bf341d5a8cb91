/* JSON into an output, safe inside an HTML script element: no '<', '>' or '&' leaves here as itself, and what is not finite is null. */
#ifndef PIA_REPORT_PAGE_JSON_H
#define PIA_REPORT_PAGE_JSON_H

#include "output.h"

typedef struct pia_json {
    pia_output *output;
    int comma; /* 1: a member stands before the next one */
} pia_json;

/* key NULL: an element of an array. bracket '{' or '['. */
void pia_json_open(pia_json *json, const char *key, char bracket);
void pia_json_close(pia_json *json, char bracket);
/* text NULL: null. */
void pia_json_text(pia_json *json, const char *key, const char *text);
void pia_json_number(pia_json *json, const char *key, double value);
void pia_json_count(pia_json *json, const char *key, pia_index value);
/* 1 true, 0 false, negative null. */
void pia_json_truth(pia_json *json, const char *key, int value);
void pia_json_numbers(pia_json *json, const char *key, const double *value, pia_index count);
void pia_json_counts(pia_json *json, const char *key, const pia_index *value, pia_index count);

/* Text between HTML tags. */
void pia_html_text(pia_output *output, const char *text);

#endif
