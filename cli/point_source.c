#include "point_source.h"

#include <string.h>

#include "file_name.h"

enum { KEY_COLUMNS = 0x600, KEY_SKIP_INVALID, KEY_GRID, KEY_PART, KEY_INPUT_FORMAT };

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Reading points:", 10},
    {"columns", KEY_COLUMNS, "x,y,z", 0, "columns to use, by name or by number from 1 (default: all numeric ones)", 0},
    {"grid", KEY_GRID, "RxC", OPTION_ARG_OPTIONAL,
     "the rows are a grid of R times C points, C fastest; without RxC: the file is a matrix of heights", 0},
    {"part", KEY_PART, "K", 0, "only part K, from 0, of a file with parts, separated by blank lines or by a column 'contour'", 0},
    {"skip-invalid", KEY_SKIP_INVALID, NULL, 0, "drop and count rows that are no points, instead of an error", 0},
    {"input-format", KEY_INPUT_FORMAT, "NAME", 0, "format of the points, whatever the file is called", 0},
    {0}};

/* `--grid 6x5` and `--grid=6x5` are the same: argp leaves the word of an optional value to us. */
static error_t parse_grid(struct point_source *source, const char *arg, struct argp_state *state)
{
    pia_index shape[2];
    source->grid = 1;
    if (!arg && state->next < state->argc && text_is_pair(state->argv[state->next], shape)) arg = state->argv[state->next++];
    if (!arg) return 0;
    if (!text_is_pair(arg, shape) || shape[0] < 1 || shape[1] < 1)
        return usage_error("--grid: '%s' is not a shape; write rows x columns, such as 121x161", arg);
    source->shape[0] = shape[0];
    source->shape[1] = shape[1];
    return 0;
}

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct point_source *source = state->input;
    switch (key) {
    case KEY_COLUMNS: source->columns = arg; return 0;
    case KEY_SKIP_INVALID: source->skip_invalid = 1; return 0;
    case KEY_INPUT_FORMAT: source->format = arg; return 0;
    case KEY_GRID: return parse_grid(source, arg, state);
    case KEY_PART: return option_count("--part", arg, 0, &source->part);
    default: return ARGP_ERR_UNKNOWN;
    }
}

const struct argp point_source_argp = {options, parse, NULL, NULL, NULL, NULL, NULL};

void point_source_init(struct point_source *source, struct session *session)
{
    *source = (struct point_source){.session = session, .part = PIA_AUTO};
}

static int shape_grid(const struct point_source *source, struct point_set *set)
{
    pia_index rows, *count = set->info.count, have = count[0] * count[1];
    if (__builtin_mul_overflow(source->shape[0], source->shape[1], &rows) || rows != have)
        return fail(EXIT_DATA, "%s: %lld points are no grid of %lld x %lld; check --grid", source->path, (long long)have,
                    (long long)source->shape[0], (long long)source->shape[1]);
    count[0] = source->shape[0];
    count[1] = source->shape[1];
    set->info.kind = PIA_GRID;
    return EXIT_DONE;
}

/* With --columns the weights were read as one more column, the last; else the column is looked for by its name or number. */
static int find_weights(const struct point_source *source, const pia_points_info *info, int *column)
{
    pia_index number;
    *column = -1;
    if (source->columns)
        *column = info->dim - 1;
    else if (text_is_count(source->weights, &number) && number >= 1 && number <= info->dim)
        *column = (int)number - 1;
    else
        for (int k = 0; info->names && k < info->dim; k++)
            if (strcmp(info->names[k], source->weights) == 0) *column = k;
    if (*column >= 0 && info->dim > 1) return EXIT_DONE;
    return fail(EXIT_USAGE, "%s: --weights: no column or file is called '%s'; 'pia info %s' lists the columns", source->path,
                source->weights, source->path);
}

static int split_weights(const struct point_source *source, struct point_set *set)
{
    pia_points_info *info = &set->info;
    int column, code = find_weights(source, info, &column);
    if (code) return code;
    pia_index count = info->count[0] * info->count[1];
    int dim = info->dim - 1;
    double *weights = session_keep(source->session, (size_t)count, sizeof *weights);
    double *points = session_keep(source->session, (size_t)count, (size_t)dim * sizeof *points);
    for (pia_index i = 0; i < count; i++) {
        const double *row = info->points + i * info->dim;
        weights[i] = row[column];
        memcpy(points + i * dim, row, (size_t)column * sizeof *row);
        memcpy(points + i * dim + column, row + column + 1, (size_t)(dim - column) * sizeof *row);
    }
    set->weights = weights;
    info->points = points;
    info->dim = dim;
    info->names = NULL;
    return EXIT_DONE;
}

int points_open(struct point_source *source, struct point_set *out)
{
    struct session *session = source->session;
    pia_points_options wanted;
    pia_points_options_init(&wanted);
    int matrix = source->grid && !source->shape[0];
    wanted.format = format_of(source->path, source->format, "csv");
    wanted.columns = source->columns;
    if (source->columns && source->weights) wanted.columns = session_text(session, "%s,%s", source->columns, source->weights);
    wanted.skip_invalid = source->skip_invalid;
    wanted.grid = matrix;
    wanted.allow_nan = source->grid ? 1 : PIA_AUTO;
    *out = (struct point_set){.info.struct_size = sizeof out->info};
    int code = session_check(session, pia_points_read(session->context, source->path, &wanted, &out->file), source->path);
    if (code) return code;
    pia_points_get_info(out->file, &out->info);
    out->total = out->info.count[0] * out->info.count[1] + out->info.skipped;
    if (source->weights) code = split_weights(source, out);
    if (!code && source->shape[0]) code = shape_grid(source, out);
    if (!code && source->part >= out->info.part_count)
        code = fail(EXIT_USAGE, "%s: there is no part %lld; the file has %lld, counted from 0", source->path, (long long)source->part,
                    (long long)out->info.part_count);
    if (code) points_close(out);
    return code;
}

void points_close(struct point_set *set)
{
    pia_points_destroy(set->file);
    set->file = NULL;
}

struct row_span points_span(const struct point_set *set, pia_index part)
{
    const pia_points_info *info = &set->info;
    struct row_span span = {
        .row = info->row, .count = info->count[0] * info->count[1], .total = set->total, .any_order = set->any_order};
    if (part != PIA_AUTO && info->kind == PIA_CURVE) {
        span.first = info->part[part];
        span.count = info->part[part + 1] - span.first;
    }
    return span;
}

struct point_set points_of_part(const struct point_set *set, pia_index part)
{
    struct point_set chosen = *set;
    struct row_span span = points_span(set, part);
    chosen.info.points += span.first * chosen.info.dim;
    if (chosen.info.kind == PIA_CURVE) chosen.info.count[0] = span.count;
    return chosen;
}
