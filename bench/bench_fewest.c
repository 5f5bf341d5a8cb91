/* Fewest control points at equal tolerance: every curve of the manifest at three tolerances, ours beside SISL, OpenCASCADE and SciPy.
 * One program measures all results: the largest distance from a data point to its closest point of the curve.
 *
 *     bench_fewest [--data DIRECTORY] [--only TEXT] [--distance] [--peers NAME,NAME | --no-peers] [--limit SECONDS]
 *
 * A peer that does not reach the tolerance is asked again for a smaller one, and the first result that reaches it counts, with the
 * time of that attempt alone. One that took longer than the limit is not asked for a smaller tolerance of the same curve: it is marked
 * "late" there too. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "pia/pia.h"
#include "run_peer.h"
#include "settings.h"

enum { MAX_CASES = 400, PEERS = 3 };
static const double relative[] = {1e-2, 1e-3, 1e-4};
static const char *const peer_names[PEERS] = {"sisl", "occt", "scipy"};

typedef struct curve {
    char name[128];
    int dim, closed;
    pia_index rows;
    double *points, extent;
} curve;

typedef struct outcome {
    pia_index control;                /* 0: none */
    double seconds, processor, error; /* processor: of all threads */
    double between;                   /* ours: distance from the straight lines between points that are far apart */
    int reached, late;                /* late: no result within the limit */
} outcome;

static double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- the cases ---- */

static double extent_of(const curve *c)
{
    double square = 0;
    for (int d = 0; d < c->dim; d++) {
        double low = INFINITY, high = -INFINITY;
        for (pia_index i = 0; i < c->rows; i++) {
            low = fmin(low, c->points[i * c->dim + d]);
            high = fmax(high, c->points[i * c->dim + d]);
        }
        square += (high - low) * (high - low);
    }
    return sqrt(square);
}

/* Drops repeated rows, which no peer accepts, and lets closed curves end where they begin. */
static void clean(curve *c)
{
    pia_index kept = 0;
    double gap = 0;
    size_t size = (size_t)c->dim * sizeof(double);
    for (pia_index i = 0; i < c->rows; i++)
        if (kept == 0 || memcmp(c->points + i * c->dim, c->points + (kept - 1) * c->dim, size) != 0)
            memmove(c->points + kept++ * c->dim, c->points + i * c->dim, size);
    c->rows = kept;
    c->extent = extent_of(c);
    if (!c->closed) return;
    for (int d = 0; d < c->dim; d++) gap = fmax(gap, fabs(c->points[(kept - 1) * c->dim + d] - c->points[d]));
    if (gap > 1e-12 * c->extent) c->rows++;
    memcpy(c->points + (c->rows - 1) * c->dim, c->points, size);
}

/* One line of the manifest; 0 when its file is not there. */
static int load(pia_context *context, const settings *s, const char *line, curve *c)
{
    char columns[32], path[512], list[64];
    long first, last = -1;
    int from, to;
    if (sscanf(line, "%127[^,],%31[^,],%ld,%ld,%d", c->name, columns, &first, &last, &c->closed) < 5 &&
        sscanf(line, "%127[^,],%31[^,],%ld,,%d", c->name, columns, &first, &c->closed) < 4)
        return 0;
    if (s->only != NULL && strstr(c->name, s->only) == NULL) return 0;
    snprintf(path, sizeof path, "%s/%s", s->data, c->name);
    sscanf(columns, "%d-%d", &from, &to);
    for (int k = from, n = 0; k != to + (to > from ? 1 : -1); k += to > from ? 1 : -1)
        n += snprintf(list + n, sizeof list - (size_t)n, n > 0 ? ",%d" : "%d", k);
    pia_points_options options;
    pia_points_options_init(&options);
    options.columns = list;
    options.skip_invalid = 1;
    pia_points *points;
    pia_points_info info;
    if (pia_points_read(context, path, &options, &points) != PIA_OK) {
        fprintf(stderr, "%s: left out: %s\n", c->name, pia_message(context));
        return 0;
    }
    pia_points_get_info(points, &info);
    c->dim = info.dim;
    c->rows = last >= 0 ? last + 1 - first : info.count[0] - first;
    c->points = malloc((size_t)((c->rows + 1) * c->dim) * sizeof(double));
    memcpy(c->points, info.points + first * c->dim, (size_t)(c->rows * c->dim) * sizeof(double));
    pia_points_destroy(points);
    clean(c);
    return 1;
}

/* ---- the programs ---- */

static outcome measure(pia_context *context, const curve *c, const pia_model *model, double tolerance, outcome out)
{
    pia_deviation deviation = {.struct_size = sizeof deviation};
    if (pia_model_deviation(context, model, c->points, c->rows, NULL, &deviation, NULL) != PIA_OK) return (outcome){0};
    out.error = deviation.max_error;
    out.reached = out.error <= tolerance * (1 + 1e-9);
    return out;
}

static outcome ours(pia_context *context, const settings *s, const curve *c, double tolerance)
{
    pia_data data;
    pia_fit_options options;
    pia_report report = {.struct_size = sizeof report};
    pia_model *model;
    pia_data_init(&data);
    data.points = c->points;
    data.count[0] = c->rows;
    data.dim = c->dim;
    pia_fit_options_init(&options);
    options.closed[0] = c->closed;
    options.tolerance = tolerance;
    options.measure_distance = s->distance;
    options.time_limit = s->limit;
    double start = run_peer_now(), used = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    if (pia_fit_data(context, &data, &options, &model, &report) != PIA_OK) {
        fprintf(stderr, "%s: %s\n", c->name, pia_message(context));
        return (outcome){0};
    }
    outcome out = {.control = report.control_count, .seconds = run_peer_now() - start, .between = report.between_error};
    out.processor = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - used;
    out = measure(context, c, model, tolerance, out);
    if (report.reached == 1 && !out.reached) printf("WRONG: %s says reached at %g but deviates %g\n", c->name, tolerance, out.error);
    pia_model_destroy(model);
    return out;
}

static void write_case(const curve *c, double tolerance, const char *path)
{
    FILE *file = fopen(path, "w");
    if (file == NULL) exit(4);
    fprintf(file, "%lld %d %d %.17g\n", (long long)c->rows, c->dim, c->closed, tolerance);
    for (pia_index i = 0; i < c->rows; i++)
        for (int d = 0; d < c->dim; d++) fprintf(file, d + 1 < c->dim ? "%.17g " : "%.17g\n", c->points[i * c->dim + d]);
    fclose(file);
}

static outcome read_result(pia_context *context, const curve *c, const char *path, double tolerance)
{
    outcome out = {0};
    int degree;
    long control, counted;
    FILE *file = fopen(path, "r");
    if (file == NULL) return out;
    if (fscanf(file, "%lf %d %ld %ld", &out.seconds, &degree, &control, &counted) == 4) {
        pia_index knots = control + degree + 1, values = knots + control * c->dim, read = 0, count[2] = {control, 1};
        double *value = malloc((size_t)values * sizeof *value);
        const double *knot[2] = {value, NULL};
        while (read < values && fscanf(file, "%lf", &value[read]) == 1) read++;
        pia_model *model;
        if (read == values && pia_model_create(context, 1, &degree, knot, count, c->dim, value + knots, NULL, &model) == PIA_OK) {
            out.control = counted;
            out = measure(context, c, model, tolerance, out);
            pia_model_destroy(model);
        }
        free(value);
    }
    fclose(file);
    return out;
}

static outcome theirs(pia_context *context, const settings *s, int peer, const curve *c, double tolerance)
{
    char path[64], result[64];
    snprintf(path, sizeof path, "fewest_%d.case", (int)getpid());
    snprintf(result, sizeof result, "fewest_%d.result", (int)getpid());
    outcome out = {0};
    double factor = 1, start = run_peer_now();
    for (int attempt = 0; attempt < 4 && !out.reached && run_peer_now() - start < s->limit; attempt++, factor *= 0.7) {
        write_case(c, tolerance * factor, path);
        out = run_peer(s->directory, PIA_BENCH "/peers", peer_names[peer], path, result, s->limit - (run_peer_now() - start))
                  ? read_result(context, c, result, tolerance)
                  : (outcome){0};
        if (out.control == 0) break;
    }
    out.late = !out.reached && run_peer_now() - start >= s->limit;
    remove(path);
    remove(result);
    return out;
}

/* ---- the table ---- */

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double quantile(double *value, int count, double share)
{
    qsort(value, (size_t)count, sizeof *value, ascending);
    return count > 0 ? value[(int)(share * (count - 1))] : NAN;
}

typedef struct totals {
    double ratio[MAX_CASES];
    double between[MAX_CASES]; /* over the tolerance */
    int ratios, cases, reached, peer_reached[PEERS];
    double our_time[PEERS], peer_time[PEERS]; /* over the cases that both reached */
    int fastest;                              /* cases that both we and some peer reached, and the times of the fastest such peer */
    double our_fastest, peer_fastest;
    double seconds, processor, controls;
} totals;

static void print_cell(const outcome *o)
{
    if (o->control == 0)
        printf(" | %7s %9s ", "-", o->late ? "late" : "-");
    else
        printf(" | %7lld %9.4f%c", (long long)o->control, o->seconds, o->reached ? ' ' : '!');
}

/* late: bits of the peers that were for a larger tolerance of the same curve. */
static void run_case(pia_context *context, const settings *s, const curve *c, double tolerance, int *late, totals *t)
{
    outcome mine = ours(context, s, c, tolerance * c->extent), best = {0};
    double fastest = INFINITY;
    printf("%-38s %6lld %5.0e", c->name, (long long)c->rows, tolerance);
    print_cell(&mine);
    t->between[t->cases++] = mine.between / (tolerance * c->extent);
    t->reached += mine.reached;
    t->seconds += mine.seconds;
    t->processor += mine.processor;
    if (mine.control > 0) t->controls += log((double)mine.control);
    for (int peer = 0; peer < PEERS; peer++) {
        if ((s->peers >> peer & 1) == 0) continue;
        outcome o = (*late >> peer & 1) != 0 ? (outcome){.late = 1} : theirs(context, s, peer, c, tolerance * c->extent);
        *late |= o.late << peer;
        print_cell(&o);
        if (!o.reached || !mine.reached) continue;
        t->peer_reached[peer]++;
        t->our_time[peer] += mine.seconds;
        t->peer_time[peer] += o.seconds;
        fastest = fmin(fastest, o.seconds);
        if (best.control == 0 || o.control < best.control) best = o;
    }
    if (mine.reached && best.control > 0) {
        t->ratio[t->ratios++] = (double)mine.control / (double)best.control;
        printf(" | %6.3f", t->ratio[t->ratios - 1]);
        t->fastest++;
        t->our_fastest += mine.seconds;
        t->peer_fastest += fastest;
    }
    printf(mine.between > 3 * tolerance * c->extent ? " | between %.0f T\n" : "\n", mine.between / (tolerance * c->extent));
    fflush(stdout);
}

static void print_totals(const settings *s, totals *t)
{
    printf("%d cases, %d reached, %.3f s, %.3f s of processors, geometric mean of control points %.3f\n", t->cases, t->reached,
           t->seconds, t->processor, exp(t->controls / t->cases));
    printf("between the points, in tolerances: median %.2f, nine of ten at most %.2f, worst %.0f\n",
           quantile(t->between, t->cases, 0.5), quantile(t->between, t->cases, 0.9), quantile(t->between, t->cases, 1));
    for (int peer = 0; peer < PEERS; peer++)
        if ((s->peers >> peer & 1) != 0)
            printf("%-6s reached %d; time over these cases %.3f s, ours %.3f s, ratio %.2f\n", peer_names[peer], t->peer_reached[peer],
                   t->peer_time[peer], t->our_time[peer], t->peer_time[peer] / t->our_time[peer]);
    if (t->ratios == 0) return;
    printf("fastest peer that reached: %d cases, %.3f s, ours %.3f s, ratio %.2f\n", t->fastest, t->peer_fastest, t->our_fastest,
           t->peer_fastest / t->our_fastest);
    printf("control points, ours / best peer's: median %.3f, nine of ten at most %.3f, worst %.3f\n",
           quantile(t->ratio, t->ratios, 0.5), quantile(t->ratio, t->ratios, 0.9), quantile(t->ratio, t->ratios, 1));
}

int main(int argc, char **argv)
{
    settings s = read_settings(argc, argv, peer_names, PEERS, "", 0);
    pia_context *context;
    static totals t;
    char line[256];
    FILE *manifest = fopen(PIA_BENCH "/fewest_manifest.csv", "r");
    if (manifest == NULL || pia_context_create(NULL, &context) != PIA_OK) return 4;
    printf("%-38s %6s %5s | %-17s", "curve", "rows", "T", "ours: n, seconds");
    for (int peer = 0; peer < PEERS; peer++)
        if ((s.peers >> peer & 1) != 0) printf(" | %-17s", peer_names[peer]);
    printf(" | ours / best\n");
    while (fgets(line, sizeof line, manifest) != NULL) {
        curve c;
        if (strncmp(line, "file,", 5) == 0 || !load(context, &s, line, &c)) continue;
        int late = 0;
        for (size_t k = 0; k < sizeof relative / sizeof *relative && t.cases < MAX_CASES; k++)
            run_case(context, &s, &c, relative[k], &late, &t);
        free(c.points);
    }
    fclose(manifest);
    print_totals(&s, &t);
    pia_context_destroy(context);
    return 0;
}
