/* JSON on a stream, one line, numbers that read back as the same doubles, NaN and infinities as null. */
#ifndef PIA_CLI_JSON_WRITER_H
#define PIA_CLI_JSON_WRITER_H

#include <stdio.h>

#include "session.h"

struct json_writer {
    FILE *stream;
    int comma; /* 1: the next member follows another one */
};

/* `key` is NULL inside arrays and at the top. */
void json_open(struct json_writer *json, const char *key, char bracket);
void json_close(struct json_writer *json, char bracket);
void json_text(struct json_writer *json, const char *key, const char *text); /* NULL: null */
void json_count(struct json_writer *json, const char *key, pia_index count);
void json_number(struct json_writer *json, const char *key, double number);
void json_numbers(struct json_writer *json, const char *key, const double *numbers, pia_index count);
void json_texts(struct json_writer *json, const char *key, const struct texts *texts);
void json_truth(struct json_writer *json, const char *key, int truth); /* negative: null */
/* Ends the line. */
void json_end(struct json_writer *json);

/* {"outputs": [...]}, all that some commands have to tell. */
void json_outputs(FILE *stream, const struct texts *outputs);

/* The shortest of %.15g, %.16g, %.17g that reads back as the same double. */
void print_number(FILE *stream, double number);

#endif
