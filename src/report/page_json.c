#include "page_json.h"

#include <math.h>
#include <string.h>

static void begin_member(pia_json *json, const char *key)
{
    if (json->comma) pia_output_bytes(json->output, ",", 1);
    json->comma = 1;
    if (key != NULL) pia_output_text(json->output, "\"%s\":", key);
}

void pia_json_open(pia_json *json, const char *key, char bracket)
{
    begin_member(json, key);
    pia_output_bytes(json->output, &bracket, 1);
    json->comma = 0;
}

void pia_json_close(pia_json *json, char bracket)
{
    pia_output_bytes(json->output, &bracket, 1);
    json->comma = 1;
}

void pia_json_text(pia_json *json, const char *key, const char *text)
{
    begin_member(json, key);
    if (text == NULL) {
        pia_output_bytes(json->output, "null", 4);
        return;
    }
    pia_output_bytes(json->output, "\"", 1);
    for (const char *c = text; *c != '\0'; c++) {
        if ((unsigned char)*c < 0x20 || strchr("\"\\<>&", *c) != NULL)
            pia_output_text(json->output, "\\u%04x", (unsigned)*c);
        else
            pia_output_bytes(json->output, c, 1);
    }
    pia_output_bytes(json->output, "\"", 1);
}

void pia_json_number(pia_json *json, const char *key, double value)
{
    begin_member(json, key);
    if (isfinite(value))
        pia_output_number(json->output, value);
    else
        pia_output_bytes(json->output, "null", 4);
}

void pia_json_count(pia_json *json, const char *key, pia_index value)
{
    begin_member(json, key);
    pia_output_text(json->output, "%lld", (long long)value);
}

void pia_json_truth(pia_json *json, const char *key, int value)
{
    begin_member(json, key);
    pia_output_text(json->output, "%s", value < 0 ? "null" : value ? "true" : "false");
}

void pia_json_numbers(pia_json *json, const char *key, const double *value, pia_index count)
{
    pia_json_open(json, key, '[');
    for (pia_index i = 0; i < count; i++) pia_json_number(json, NULL, value[i]);
    pia_json_close(json, ']');
}

void pia_json_counts(pia_json *json, const char *key, const pia_index *value, pia_index count)
{
    pia_json_open(json, key, '[');
    for (pia_index i = 0; i < count; i++) pia_json_count(json, NULL, value[i]);
    pia_json_close(json, ']');
}

void pia_html_text(pia_output *output, const char *text)
{
    for (const char *c = text; *c != '\0'; c++) {
        if (strchr("<>&\"", *c) != NULL)
            pia_output_text(output, "&#%d;", *c);
        else
            pia_output_bytes(output, c, 1);
    }
}
