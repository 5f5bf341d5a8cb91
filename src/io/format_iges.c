/* IGES 5.3: entity 126 for curves, 128 for surfaces, one a model; numbers with all the digits a double has. Fixed 80-column lines in
 * the sections start, global, directory, parameters, terminate. */
#include "cad.h"
#include "io.h"

#include <stdio.h>
#include <string.h>

enum { DATA_COLUMNS = 64, GLOBAL_COLUMNS = 72 };

/* A section under way: text collects until a token would not fit its line. */
typedef struct section {
    pia_output *output;
    char letter;
    int columns, used;
    char line[GLOBAL_COLUMNS + 1];
    long long lines;
    long long entity; /* directory entry of a parameter line; 0 elsewhere */
} section;

static void end_line(section *s)
{
    memset(s->line + s->used, ' ', (size_t)(s->columns - s->used));
    s->line[s->columns] = '\0';
    s->lines++;
    if (s->output == NULL) /* only counting */
        s->used = 0;
    else if (s->entity > 0)
        pia_output_text(s->output, "%s%8lld%c%7lld\n", s->line, s->entity, s->letter, s->lines);
    else
        pia_output_text(s->output, "%s%c%7lld\n", s->line, s->letter, s->lines);
    s->used = 0;
}

/* A token with its delimiter, never broken over lines. */
static void put(section *s, const char *token, char delimiter)
{
    int length = (int)strlen(token) + 1;
    if (s->used + length > s->columns) end_line(s);
    memcpy(s->line + s->used, token, (size_t)length - 1);
    s->line[s->used + length - 1] = delimiter;
    s->used += length;
}

static void put_count(section *s, long long value)
{
    char text[32];
    snprintf(text, sizeof text, "%lld", value);
    put(s, text, ',');
}

static void put_real(section *s, double value, char delimiter)
{
    char text[PIA_CAD_REAL_SIZE];
    pia_cad_real(value, text);
    put(s, text, delimiter);
}

static void put_knots(section *s, const pia_model *model, int d)
{
    for (pia_index i = 0; i < model->control[d] + model->degree[d] + 1; i++) put_real(s, model->knots[d][i], ',');
}

/* Weights, then points, the first index fastest. */
static void put_control(section *s, const pia_model *model)
{
    double xyz[3], w;
    for (int pass = 0; pass < 2; pass++)
        for (pia_index j = 0; j < model->control[1]; j++)
            for (pia_index i = 0; i < model->control[0]; i++) {
                pia_cad_point(model, i * model->control[1] + j, xyz, &w);
                if (pass == 0) put_real(s, w, ',');
                for (int d = 0; pass == 1 && d < 3; d++) put_real(s, xyz[d], ',');
            }
}

static void put_domain(section *s, const pia_model *model)
{
    for (int d = 0; d < model->directions; d++) {
        put_real(s, model->knots[d][model->degree[d]], ',');
        put_real(s, model->knots[d][model->control[d]], model->directions == 2 && d == 1 ? ';' : ',');
    }
}

static void put_parameters(section *s, const pia_model *model)
{
    int surface = model->directions == 2;
    put(s, surface ? "128" : "126", ',');
    for (int d = 0; d < model->directions; d++) put_count(s, (long long)model->control[d] - 1);
    for (int d = 0; d < model->directions; d++) put_count(s, model->degree[d]);
    if (!surface) put_count(s, model->dim == 2); /* planar */
    for (int d = 0; d < model->directions; d++) put_count(s, pia_cad_is_closed(model, d));
    put_count(s, !model->rational);
    for (int d = 0; d < model->directions; d++) put_count(s, 0); /* clamped, hence not periodic in the sense of IGES */
    for (int d = 0; d < model->directions; d++) put_knots(s, model, d);
    put_control(s, model);
    put_domain(s, model);
    if (!surface) {
        put_real(s, 0, ',');
        put_real(s, 0, ',');
        put_real(s, model->dim == 2, ';');
    }
    end_line(s);
}

static void put_start_and_global(section *s, section *g)
{
    put(s, "B-spline curves and surfaces written by libpia", '.');
    end_line(s);
    static const char *const field[] = {"1H,", "1H;", "3Hpia", "3Hpia", "6Hlibpia", "6Hlibpia", "32",     "38", "6",  "308", "15", "0H",
                                        "1.",  "2",   "2HMM",  "1",     "0.01",     "0H",       "1.E-06", "0.", "0H", "0H",  "11", "0"};
    size_t count = sizeof field / sizeof *field;
    for (size_t i = 0; i < count; i++) put(g, field[i], i + 1 < count ? ',' : ';');
    end_line(g);
}

/* Two lines a model; its parameters start at line `start` and take `lines`. */
static void put_directory(pia_output *output, const pia_model *model, long long index, long long start, long long lines)
{
    int type = model->directions == 2 ? 128 : 126;
    pia_output_text(output, "%8d%8lld%8d%8d%8d%8d%8d%8d%8sD%7lld\n", type, start, 0, 0, 0, 0, 0, 0, "00000000", 2 * index + 1);
    pia_output_text(output, "%8d%8d%8d%8lld%8d%8s%8s%8s%8dD%7lld\n", type, 0, 0, lines, 0, "", "",
                    model->directions == 2 ? "SURFACE" : "CURVE", 0, 2 * index + 2);
}

/* How many parameter lines a model takes. */
static long long count_lines(const pia_model *model)
{
    section s = {.output = NULL, .letter = 'P', .columns = DATA_COLUMNS, .entity = 1};
    put_parameters(&s, model);
    return s.lines;
}

static pia_status write_models(pia_context *context, pia_output *output, const pia_model *const *models, pia_index count,
                               pia_index samples)
{
    (void)samples;
    pia_status status = pia_cad_check(context, "IGES", models, count);
    if (status != PIA_OK) return status;
    section start = {.output = output, .letter = 'S', .columns = GLOBAL_COLUMNS};
    section global = {.output = output, .letter = 'G', .columns = GLOBAL_COLUMNS};
    section parameters = {.output = output, .letter = 'P', .columns = DATA_COLUMNS};
    put_start_and_global(&start, &global);
    long long at = 1;
    for (pia_index i = 0; i < count; i++) {
        long long lines = count_lines(models[i]);
        put_directory(output, models[i], i, at, lines);
        at += lines;
    }
    for (pia_index i = 0; i < count; i++) {
        parameters.entity = 2 * i + 1;
        put_parameters(&parameters, models[i]);
    }
    pia_output_text(output, "S%7lldG%7lldD%7lldP%7lld%40sT%7d\n", start.lines, global.lines, 2 * (long long)count, parameters.lines, "",
                    1);
    return PIA_OK;
}

const pia_format pia_format_iges = {
    .name = "iges",
    .title = "IGES 5.3, entities 126 and 128",
    .detail = "writes curves and surfaces, exact to the bit; several in a file",
    .extensions = "igs iges",
    .write_models = write_models,
};
