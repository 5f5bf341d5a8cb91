#include "json_writer.h"

#include <math.h>
#include <stdlib.h>

void print_number(FILE *stream, double number)
{
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, number);
        if (strtod(text, NULL) == number) break;
    }
    fputs(text, stream);
}

static void print_quoted(FILE *stream, const char *text)
{
    fputc('"', stream);
    for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
        if (*c == '"' || *c == '\\')
            fprintf(stream, "\\%c", *c);
        else if (*c < 0x20)
            fprintf(stream, "\\u%04x", *c);
        else
            fputc(*c, stream);
    }
    fputc('"', stream);
}

static void begin_member(struct json_writer *json, const char *key)
{
    if (json->comma) fputs(", ", json->stream);
    json->comma = 1;
    if (!key) return;
    print_quoted(json->stream, key);
    fputs(": ", json->stream);
}

void json_open(struct json_writer *json, const char *key, char bracket)
{
    begin_member(json, key);
    fputc(bracket, json->stream);
    json->comma = 0;
}

void json_close(struct json_writer *json, char bracket)
{
    fputc(bracket, json->stream);
    json->comma = 1;
}

void json_text(struct json_writer *json, const char *key, const char *text)
{
    begin_member(json, key);
    if (text)
        print_quoted(json->stream, text);
    else
        fputs("null", json->stream);
}

void json_count(struct json_writer *json, const char *key, pia_index count)
{
    begin_member(json, key);
    fprintf(json->stream, "%lld", (long long)count);
}

void json_number(struct json_writer *json, const char *key, double number)
{
    begin_member(json, key);
    if (isfinite(number))
        print_number(json->stream, number);
    else
        fputs("null", json->stream);
}

void json_numbers(struct json_writer *json, const char *key, const double *numbers, pia_index count)
{
    json_open(json, key, '[');
    for (pia_index i = 0; i < count; i++) json_number(json, NULL, numbers[i]);
    json_close(json, ']');
}

void json_texts(struct json_writer *json, const char *key, const struct texts *texts)
{
    json_open(json, key, '[');
    for (pia_index i = 0; i < texts->count; i++) json_text(json, NULL, texts->item[i]);
    json_close(json, ']');
}

void json_truth(struct json_writer *json, const char *key, int truth)
{
    begin_member(json, key);
    fputs(truth < 0 ? "null" : truth ? "true" : "false", json->stream);
}

void json_end(struct json_writer *json)
{
    fputc('\n', json->stream);
}

void json_outputs(FILE *stream, const struct texts *outputs)
{
    struct json_writer json = {.stream = stream};
    json_open(&json, NULL, '{');
    json_texts(&json, "outputs", outputs);
    json_close(&json, '}');
    json_end(&json);
}
