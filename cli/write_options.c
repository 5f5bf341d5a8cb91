#include "write_options.h"

#include <string.h>

enum { KEY_UNITS = 0x900, KEY_SCHEMA, KEY_ACCURACY, KEY_PART_NAME };

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "CAD files (.step .igs):", 70},
    {"units", KEY_UNITS, "mm|m|inch", 0, "what a length of 1 means (default mm)", 0},
    {"step-schema", KEY_SCHEMA, "ap214|ap242", 0, "application protocol of STEP files (default ap214)", 0},
    {"accuracy", KEY_ACCURACY, "X", 0, "distance below which points are the same, in those units (default 1e-7)", 0},
    {"part-name", KEY_PART_NAME, "NAME", 0, "what the part is called (default: the file's name)", 0},
    {0}};

static error_t parse_units(const char *text, pia_write_options *out)
{
    static const char *const name[] = {[PIA_UNIT_MILLIMETRE] = "mm", [PIA_UNIT_METRE] = "m", [PIA_UNIT_INCH] = "inch"};
    for (int u = PIA_UNIT_MILLIMETRE; u <= PIA_UNIT_INCH; u++)
        if (strcmp(text, name[u]) == 0) {
            out->unit = (pia_unit)u;
            return 0;
        }
    return usage_error("--units: '%s' is no unit; write mm, m or inch", text);
}

static error_t parse_schema(const char *text, pia_write_options *out)
{
    if (strcmp(text, "ap214") != 0 && strcmp(text, "ap242") != 0)
        return usage_error("--step-schema: '%s' is no schema that is written; ap214 or ap242", text);
    out->step_schema = text[3] == '1' ? PIA_STEP_AP214 : PIA_STEP_AP242;
    return 0;
}

static error_t parse(int key, char *arg, struct argp_state *state)
{
    pia_write_options *out = state->input;
    switch (key) {
    case KEY_UNITS: return parse_units(arg, out);
    case KEY_SCHEMA: return parse_schema(arg, out);
    case KEY_ACCURACY:
        if (option_number("--accuracy", arg, 0, &out->tolerance)) return ERROR_IS_TOLD;
        return out->tolerance > 0 ? 0 : usage_error("--accuracy %s: write a number above 0", arg);
    case KEY_PART_NAME: out->name = arg; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

const struct argp write_options_argp = {options, parse, NULL, NULL, NULL, NULL, NULL};
