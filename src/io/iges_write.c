#include "cad.h"
#include "iges.h"

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

/* A spline in space, after the type. */
static void put_spline(section *s, const pia_model *model)
{
    int surface = model->directions == 2;
    for (int d = 0; d < model->directions; d++) put_count(s, (long long)model->control[d] - 1);
    for (int d = 0; d < model->directions; d++) put_count(s, model->degree[d]);
    if (!surface) put_count(s, model->dim == 2); /* planar */
    for (int d = 0; d < model->directions; d++) put_count(s, pia_cad_is_closed_alike(model, d));
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
}

/* A straight side in the parameter plane as a spline of degree 1 over [0, 1]: two points, flat, open, polynomial, not periodic; knots,
 * weights, points, domain, normal. */
static void put_segment(section *s, const pia_cad_edge *edge)
{
    static const int counts[] = {1, 1, 1, 0, 1, 0};
    const double *a = edge->from, *b = edge->to, reals[] = {0, 0, 1, 1, 1, 1, a[0], a[1], 0, b[0], b[1], 0, 0, 1, 0, 0, 1};
    const size_t count = sizeof reals / sizeof *reals;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) put_count(s, counts[i]);
    for (size_t i = 0; i < count; i++) put_real(s, reals[i], i + 1 < count ? ',' : ';');
}

static void put_parameters(section *s, const pia_iges_plan *plan, const pia_iges_entity *e)
{
    char text[32];
    put_count(s, e->type);
    if (e->model != NULL)
        put_spline(s, e->model);
    else if (e->segment != NULL)
        put_segment(s, e->segment);
    for (pia_index i = 0; i < e->count; i++) {
        snprintf(text, sizeof text, "%lld", plan->number[e->first + i]);
        put(s, text, i + 1 < e->count ? ',' : ';');
    }
    end_line(s);
}

static void put_start(section *s)
{
    put(s, "B-spline curves and surfaces written by libpia", '.');
    end_line(s);
}

/* "5Hwords": a text as IGES counts it. */
static void put_text(section *s, const char *text)
{
    char counted[PIA_CAD_NAME_SIZE + 8];
    snprintf(counted, sizeof counted, "%zuH%s", strlen(text), text);
    put(s, counted, ',');
}

static void put_global(section *g, const pia_write_options *options)
{
    static const struct {
        const char *flag, *name;
    } unit[] = {[PIA_UNIT_MILLIMETRE] = {"2", "MM"}, [PIA_UNIT_METRE] = {"6", "M"}, [PIA_UNIT_INCH] = {"1", "INCH"}};
    static const char *const writer[] = {"6Hlibpia", "6Hlibpia", "32", "38", "6", "308", "15"};
    char name[PIA_CAD_NAME_SIZE];
    pia_cad_name(options, 0, 1, name);
    put(g, "1H,", ',');
    put(g, "1H;", ',');
    put_text(g, name);
    put_text(g, name);
    for (size_t i = 0; i < sizeof writer / sizeof *writer; i++) put(g, writer[i], ',');
    put_text(g, name);
    put(g, "1.", ',');
    put(g, unit[options->unit].flag, ',');
    put_text(g, unit[options->unit].name);
    put(g, "1", ',');
    put(g, "0.01", ',');
    put(g, "0H", ',');
    put_real(g, options->tolerance, ',');
    put(g, "0.", ',');
    put(g, "0H", ',');
    put(g, "0H", ',');
    put(g, "11", ',');
    put(g, "0", ';');
    end_line(g);
}

/* Two lines an entity; its parameters start at line `start` and take `lines`. */
static void put_directory(pia_output *output, const pia_iges_entity *e, long long index, long long start, long long lines)
{
    const char *label = e->type == PIA_IGES_SURFACE || e->type == PIA_IGES_TRIMMED ? "SURFACE" : "CURVE";
    pia_output_text(output, "%8d%8lld%8d%8d%8d%8d%8d%8d00%02d%02d00D%7lld\n", e->type, start, 0, 0, 0, 0, 0, 0, e->dependent,
                    e->in_plane ? 5 : 0, 2 * index + 1);
    pia_output_text(output, "%8d%8d%8d%8lld%8d%8s%8s%8s%8dD%7lld\n", e->type, 0, 0, lines, 0, "", "", label, 0, 2 * index + 2);
}

/* How many parameter lines an entity takes. */
static long long count_lines(const pia_iges_plan *plan, const pia_iges_entity *e)
{
    section s = {.output = NULL, .letter = 'P', .columns = DATA_COLUMNS, .entity = 1};
    put_parameters(&s, plan, e);
    return s.lines;
}

void pia_iges_write(pia_output *output, const pia_iges_plan *plan, const pia_write_options *options)
{
    section start = {.output = output, .letter = 'S', .columns = GLOBAL_COLUMNS};
    section global = {.output = output, .letter = 'G', .columns = GLOBAL_COLUMNS};
    section parameters = {.output = output, .letter = 'P', .columns = DATA_COLUMNS};
    put_start(&start);
    put_global(&global, options);
    long long at = 1;
    for (pia_index i = 0; i < plan->entity_count; i++) {
        long long lines = count_lines(plan, &plan->entity[i]);
        put_directory(output, &plan->entity[i], i, at, lines);
        at += lines;
    }
    for (pia_index i = 0; i < plan->entity_count; i++) {
        parameters.entity = 2 * i + 1;
        put_parameters(&parameters, plan, &plan->entity[i]);
    }
    pia_output_text(output, "S%7lldG%7lldD%7lldP%7lld%40sT%7d\n", start.lines, global.lines, 2 * (long long)plan->entity_count,
                    parameters.lines, "", 1);
}
