#include "info_points.h"

#include <math.h>

#include "json_writer.h"
#include "order_hint.h"

/* Figures of one part, or of a whole grid; NaN is passed over. */
struct figures {
    double low[PIA_MAX_DIM], high[PIA_MAX_DIM], extent;
    double spacing[3];    /* least, mean, largest distance of neighbours */
    pia_index duplicates; /* points equal to the one before */
    pia_index holes;      /* points with a component that is not a number */
    int closed;           /* 1: the last point repeats the first, to rounding */
    double order_ratio;   /* see order_hint.h */
};

static double distance_between(const double *a, const double *b, int dim)
{
    double sum = 0;
    for (int k = 0; k < dim; k++) sum = hypot(sum, a[k] - b[k]);
    return sum;
}

static void measure_box(const double *points, pia_index count, int dim, struct figures *out)
{
    for (int k = 0; k < dim; k++) {
        out->low[k] = INFINITY;
        out->high[k] = -INFINITY;
    }
    for (pia_index i = 0; i < count; i++) {
        int whole = 1;
        for (int k = 0; k < dim; k++) {
            double value = points[i * dim + k];
            whole &= isfinite(value) != 0;
            out->low[k] = fmin(out->low[k], value);
            out->high[k] = fmax(out->high[k], value);
        }
        out->holes += !whole;
    }
    out->extent = distance_between(out->low, out->high, dim);
}

static void measure_spacing(const double *points, pia_index count, int dim, struct figures *out)
{
    double least = INFINITY, largest = 0, sum = 0;
    for (pia_index i = 1; i < count; i++) {
        double step = distance_between(points + (i - 1) * dim, points + i * dim, dim);
        out->duplicates += step == 0;
        least = fmin(least, step);
        largest = fmax(largest, step);
        sum += step;
    }
    out->spacing[0] = count > 1 ? least : 0;
    out->spacing[1] = count > 1 ? sum / (double)(count - 1) : 0;
    out->spacing[2] = largest;
    out->closed = count > 2 && out->extent > 0 && distance_between(points, points + (count - 1) * dim, dim) <= 1e-12 * out->extent;
}

/* What the noise of a curve or grid suggests; 0 where it suggests nothing. */
static double suggestion(const struct point_source *source, const pia_points_info *info, const struct row_span *span, double *noise)
{
    double tolerance;
    pia_data data;
    pia_data_init(&data);
    data.kind = info->kind;
    data.dim = info->dim;
    data.points = info->points + span->first * info->dim;
    data.count[0] = info->kind == PIA_GRID ? info->count[0] : span->count;
    data.count[1] = info->kind == PIA_GRID ? info->count[1] : 1;
    return pia_suggest_tolerance(source->session->context, &data, &tolerance, noise) == PIA_OK && tolerance > 0 ? tolerance : 0;
}

static struct figures measure(struct session *session, const pia_points_info *info, const struct row_span *span)
{
    struct figures figures = {.holes = 0};
    const double *points = info->points + span->first * info->dim;
    measure_box(points, span->count, info->dim, &figures);
    if (info->kind == PIA_CURVE) measure_spacing(points, span->count, info->dim, &figures);
    if (info->kind == PIA_CURVE) figures.order_ratio = order_ratio(session, points, span->count, info->dim);
    return figures;
}

/* ---- Text ---- */

static void print_figures(const struct figures *figures, const pia_points_info *info)
{
    for (int k = 0; k < info->dim; k++) {
        if (info->names)
            printf("%-12s %s", k ? "" : "range", info->names[k]);
        else
            printf("%-12s column %d", k ? "" : "range", k + 1);
        printf(" from %.10g to %.10g\n", figures->low[k], figures->high[k]);
    }
    printf("extent       %.10g\n", figures->extent);
    if (figures->holes) printf("holes        %lld points with no value\n", (long long)figures->holes);
    if (info->kind != PIA_CURVE) return;
    printf("spacing      %.6g least, %.6g mean, %.6g largest\n", figures->spacing[0], figures->spacing[1], figures->spacing[2]);
    printf("closed       %s\n", figures->closed ? "yes, the last point repeats the first" : "no");
    printf("duplicates   %lld points equal the one before\n", (long long)figures->duplicates);
    if (figures->order_ratio >= ORDER_LOOKS_RANDOM)
        printf("order        random: the way through them is %.3g times their spanning tree; 'pia fit --order tree' finds an order\n",
               figures->order_ratio);
}

static void print_text(const struct point_source *source, const struct point_set *set, pia_index first, pia_index parts)
{
    const pia_points_info *info = &set->info;
    if (info->kind == PIA_GRID)
        printf("points       a grid of %lld x %lld", (long long)info->count[0], (long long)info->count[1]);
    else
        printf("points       %lld", (long long)info->count[0]);
    printf(" with %d component%s, read as %s from %s\n", info->dim, info->dim == 1 ? "" : "s", info->format, source->path);
    if (info->skipped) printf("dropped      %lld invalid rows\n", (long long)info->skipped);
    for (pia_index k = 0; k < parts; k++) {
        struct row_span span = points_span(set, first + k);
        struct figures figures = measure(source->session, info, &span);
        pia_index part = first + k, row = span.count ? row_in_file(&span, 0) : 0;
        if (info->part_count > 1)
            printf("part %-7lld %lld points from row %lld\n", (long long)part, (long long)span.count, (long long)row);
        print_figures(&figures, info);
        double noise, tolerance = suggestion(source, info, &span, &noise);
        if (tolerance > 0) printf("noise        about %.3g a component; --tolerance %.3g keeps it out\n", noise, tolerance);
    }
}

/* ---- JSON ---- */

static void put_figures(struct json_writer *json, const struct point_source *source, const pia_points_info *info,
                        const struct row_span *span)
{
    double noise, tolerance = suggestion(source, info, span, &noise);
    struct figures figures = measure(source->session, info, span);
    json_count(json, "point_count", span->count);
    json_numbers(json, "low", figures.low, info->dim);
    json_numbers(json, "high", figures.high, info->dim);
    json_number(json, "extent", figures.extent);
    json_count(json, "holes", figures.holes);
    json_number(json, "noise", tolerance > 0 ? noise : NAN);
    json_number(json, "suggested_tolerance", tolerance > 0 ? tolerance : NAN);
    if (info->kind != PIA_CURVE) return;
    json_truth(json, "closed", figures.closed);
    json_truth(json, "looks_random", figures.order_ratio >= ORDER_LOOKS_RANDOM);
    json_count(json, "duplicates", figures.duplicates);
    json_open(json, "spacing", '{');
    json_number(json, "least", figures.spacing[0]);
    json_number(json, "mean", figures.spacing[1]);
    json_number(json, "largest", figures.spacing[2]);
    json_close(json, '}');
}

static void print_json(const struct point_source *source, const struct point_set *set, pia_index first, pia_index parts)
{
    const pia_points_info *info = &set->info;
    struct json_writer writer = {.stream = stdout}, *json = &writer;
    struct row_span all = points_span(set, PIA_AUTO);
    json_open(json, NULL, '{');
    json_text(json, "file", source->path);
    json_text(json, "holds", "points");
    json_text(json, "format", info->format);
    json_text(json, "kind", info->kind == PIA_GRID ? "grid" : "curve");
    json_numbers(json, "count", (const double[]){(double)info->count[0], (double)info->count[1]}, info->kind == PIA_GRID ? 2 : 1);
    json_count(json, "dim", info->dim);
    json_count(json, "skipped", info->skipped);
    json_open(json, "columns", '[');
    for (int k = 0; info->names && k < info->dim; k++) json_text(json, NULL, info->names[k]);
    json_close(json, ']');
    put_figures(json, source, info, &all);
    json_open(json, "parts", '[');
    for (pia_index k = 0; k < parts; k++) {
        struct row_span span = points_span(set, first + k);
        json_open(json, NULL, '{');
        json_count(json, "first_row", span.count ? row_in_file(&span, 0) : 0);
        put_figures(json, source, info, &span);
        json_close(json, '}');
    }
    json_close(json, ']');
    json_close(json, '}');
    json_end(json);
}

int info_points(struct point_source *source)
{
    struct point_set set;
    int code = points_open(source, &set);
    if (code) return code;
    int all = source->part == PIA_AUTO;
    (source->session->json ? print_json : print_text)(source, &set, all ? 0 : source->part, all ? set.info.part_count : 1);
    points_close(&set);
    return EXIT_DONE;
}
