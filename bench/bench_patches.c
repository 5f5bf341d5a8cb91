/* Fewest control points of patches at equal tolerance: every grid of the manifest at three tolerances, ours beside SciPy and
 * OpenCASCADE. One program measures all results: the largest distance from a data point to its closest point of the patch.
 *
 *     bench_patches [--data DIRECTORY] [--only TEXT] [--peers NAME,NAME | --no-peers] [--limit SECONDS]
 *
 * Tolerances are shares of the range of the last component. A peer that does not reach one is asked again for a smaller one, and the
 * first result that reaches it counts, with the time of that attempt alone. One that took longer than the limit is not asked for a
 * smaller tolerance of the same grid: it is marked "late" there too. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pia/pia.h"
#include "run_peer.h"
#include "settings.h"

enum { MAX_CASES = 100, PEERS = 2, ATTEMPTS = 4 };
static const double relative[] = {0.1, 0.03, 0.01};
static const char *const peer_names[PEERS] = {"patch_scipy", "patch_occt"};

typedef struct patch {
    char name[128];
    int heights;
    pia_points *file;
    const double *points; /* [count[0] x count[1] x 3] */
    pia_index count[2];
    double range;
} patch;

typedef struct outcome {
    pia_index control; /* 0: none */
    double seconds, error;
    int reached, late; /* late: no result within the limit */
} outcome;

/* ---- the cases ---- */

static double range_of(const patch *p)
{
    double low = INFINITY, high = -INFINITY;
    for (pia_index i = 0; i < p->count[0] * p->count[1]; i++) {
        low = fmin(low, p->points[3 * i + 2]);
        high = fmax(high, p->points[3 * i + 2]);
    }
    return high - low;
}

/* One line of the manifest; 0 when its file is not there. */
static int load(pia_context *context, const settings *s, const char *line, patch *p)
{
    char path[512];
    long rows, columns;
    if (sscanf(line, "%127[^,],%ld,%ld,%d", p->name, &rows, &columns, &p->heights) != 4) return 0;
    if (s->only != NULL && strstr(p->name, s->only) == NULL) return 0;
    snprintf(path, sizeof path, "%s/%s", s->data, p->name);
    pia_points_options options;
    pia_points_options_init(&options);
    options.grid = rows == 0;
    if (access(path, R_OK) != 0 || pia_points_read(context, path, &options, &p->file) != PIA_OK) {
        fprintf(stderr, "%s: left out\n", p->name);
        return 0;
    }
    pia_points_info info;
    pia_points_get_info(p->file, &info);
    p->points = info.points;
    p->count[0] = rows > 0 ? rows : info.count[0];
    p->count[1] = rows > 0 ? columns : info.count[1];
    p->range = range_of(p);
    return 1;
}

/* ---- the programs ---- */

static outcome measure(pia_context *context, const patch *p, const pia_model *model, double tolerance, outcome out)
{
    pia_deviation deviation = {.struct_size = sizeof deviation};
    if (pia_model_deviation(context, model, p->points, p->count[0] * p->count[1], NULL, &deviation, NULL) != PIA_OK)
        return (outcome){0};
    out.error = deviation.max_error;
    out.reached = out.error <= tolerance * (1 + 1e-9);
    return out;
}

static outcome ours(pia_context *context, const settings *s, const patch *p, double tolerance)
{
    pia_data data;
    pia_fit_options options;
    pia_report report = {.struct_size = sizeof report};
    pia_model *model;
    pia_data_init(&data);
    data.kind = PIA_GRID;
    data.points = p->points;
    data.count[0] = p->count[0];
    data.count[1] = p->count[1];
    data.dim = 3;
    pia_fit_options_init(&options);
    options.tolerance = tolerance;
    options.time_limit = s->limit;
    double start = run_peer_now();
    if (pia_fit_data(context, &data, &options, &model, &report) != PIA_OK) {
        fprintf(stderr, "%s: %s\n", p->name, pia_message(context));
        return (outcome){0};
    }
    outcome out = {.control = report.control_count, .seconds = run_peer_now() - start};
    out = measure(context, p, model, tolerance, out);
    if (report.reached == 1 && !out.reached) printf("WRONG: %s says reached at %g but deviates %g\n", p->name, tolerance, out.error);
    pia_model_destroy(model);
    return out;
}

static void write_case(const patch *p, double tolerance, const char *path)
{
    FILE *file = fopen(path, "w");
    if (file == NULL) exit(4);
    fprintf(file, "%lld %lld %d %.17g\n", (long long)p->count[0], (long long)p->count[1], p->heights, tolerance);
    for (pia_index i = 0; i < p->count[0] * p->count[1]; i++)
        fprintf(file, "%.17g %.17g %.17g\n", p->points[3 * i], p->points[3 * i + 1], p->points[3 * i + 2]);
    fclose(file);
}

static outcome read_result(pia_context *context, const patch *p, const char *path, double tolerance)
{
    outcome out = {0};
    int degree[2];
    long control[2], counted;
    FILE *file = fopen(path, "r");
    if (file == NULL) return out;
    if (fscanf(file, "%lf %d %d %ld %ld %ld", &out.seconds, &degree[0], &degree[1], &control[0], &control[1], &counted) == 6) {
        pia_index knots[2] = {control[0] + degree[0] + 1, control[1] + degree[1] + 1}, count[2] = {control[0], control[1]};
        pia_index values = knots[0] + knots[1] + 3 * count[0] * count[1], read = 0;
        double *value = malloc((size_t)values * sizeof *value);
        const double *knot[2] = {value, value + knots[0]};
        while (read < values && fscanf(file, "%lf", &value[read]) == 1) read++;
        pia_model *model;
        if (read == values && pia_model_create(context, 2, degree, knot, count, 3, knot[1] + knots[1], NULL, &model) == PIA_OK) {
            out.control = counted;
            out = measure(context, p, model, tolerance, out);
            pia_model_destroy(model);
        }
        free(value);
    }
    fclose(file);
    return out;
}

static outcome theirs(pia_context *context, const settings *s, int peer, const patch *p, double tolerance)
{
    char path[64], result[64];
    snprintf(path, sizeof path, "patches_%d.case", (int)getpid());
    snprintf(result, sizeof result, "patches_%d.result", (int)getpid());
    outcome out = {0};
    double factor = 1, start = run_peer_now();
    for (int attempt = 0; attempt < ATTEMPTS && !out.reached && run_peer_now() - start < s->limit; attempt++, factor *= 0.7) {
        double left = s->limit - (run_peer_now() - start);
        write_case(p, tolerance * factor, path);
        int done = run_peer(s->directory, PIA_BENCH "/peers", peer_names[peer], path, result, left);
        out = done ? read_result(context, p, result, tolerance) : (outcome){0};
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

typedef struct totals {
    double ratio[MAX_CASES]; /* control points: ours over those of the best peer */
    int ratios, cases, reached, peer_reached[PEERS];
    double our_time[PEERS], peer_time[PEERS], slower[PEERS][MAX_CASES]; /* over the cases that both reached; ours over theirs */
} totals;

static void print_cell(const outcome *o, double tolerance)
{
    if (o->control == 0)
        printf(" | %6s %8s %5s ", "-", o->late ? "late" : "-", "");
    else
        printf(" | %6lld %8.3f %5.2f%c", (long long)o->control, o->seconds, o->error / tolerance, o->reached ? ' ' : '!');
}

/* late: bits of the peers that were for a larger tolerance of the same grid. */
static void run_case(pia_context *context, const settings *s, const patch *p, double share, int *late, totals *t)
{
    double tolerance = share * p->range;
    outcome mine = ours(context, s, p, tolerance), best = {0};
    printf("%-30s %3lld x %3lld %4.0f", p->name, (long long)p->count[0], (long long)p->count[1], 100 * share);
    print_cell(&mine, tolerance);
    t->cases++;
    t->reached += mine.reached;
    for (int peer = 0; peer < PEERS; peer++) {
        if ((s->peers >> peer & 1) == 0) continue;
        outcome o = (*late >> peer & 1) != 0 ? (outcome){.late = 1} : theirs(context, s, peer, p, tolerance);
        *late |= o.late << peer;
        print_cell(&o, tolerance);
        if (!o.reached || !mine.reached) continue;
        t->slower[peer][t->peer_reached[peer]++] = mine.seconds / o.seconds;
        t->our_time[peer] += mine.seconds;
        t->peer_time[peer] += o.seconds;
        if (best.control == 0 || o.control < best.control) best = o;
    }
    if (best.control > 0) {
        t->ratio[t->ratios++] = (double)mine.control / (double)best.control;
        printf(" | %6.3f", t->ratio[t->ratios - 1]);
    }
    printf("\n");
    fflush(stdout);
}

static void print_totals(const settings *s, totals *t)
{
    printf("%d cases, %d reached\n", t->cases, t->reached);
    for (int peer = 0; peer < PEERS; peer++) {
        int count = t->peer_reached[peer];
        if ((s->peers >> peer & 1) == 0 || count == 0) continue;
        qsort(t->slower[peer], (size_t)count, sizeof(double), ascending);
        printf("%-11s reached %d; time over these cases %.3f s, ours %.3f s; ours over theirs a case: median %.2f, worst %.2f\n",
               peer_names[peer], count, t->peer_time[peer], t->our_time[peer], t->slower[peer][count / 2], t->slower[peer][count - 1]);
    }
    if (t->ratios == 0) return;
    qsort(t->ratio, (size_t)t->ratios, sizeof(double), ascending);
    printf("control points, ours / best peer's: least %.3f, median %.3f, worst %.3f\n", t->ratio[0], t->ratio[t->ratios / 2],
           t->ratio[t->ratios - 1]);
}

int main(int argc, char **argv)
{
    settings s = read_settings(argc, argv, peer_names, PEERS, "patch_", -1);
    pia_context *context;
    static totals t;
    char line[256];
    FILE *manifest = fopen(PIA_BENCH "/patches_manifest.csv", "r");
    if (manifest == NULL || pia_context_create(NULL, &context) != PIA_OK) return 4;
    printf("%-30s %9s %4s | %-22s", "grid", "", "T, %", "ours: n, s, error / T");
    for (int peer = 0; peer < PEERS; peer++)
        if ((s.peers >> peer & 1) != 0) printf(" | %-22s", peer_names[peer] + strlen("patch_"));
    printf(" | ours / best\n");
    while (fgets(line, sizeof line, manifest) != NULL) {
        patch p;
        if (strncmp(line, "file,", 5) == 0 || !load(context, &s, line, &p)) continue;
        int late = 0;
        for (size_t k = 0; k < sizeof relative / sizeof *relative && t.cases < MAX_CASES; k++)
            run_case(context, &s, &p, relative[k], &late, &t);
        pia_points_destroy(p.file);
    }
    fclose(manifest);
    print_totals(&s, &t);
    pia_context_destroy(context);
    return 0;
}
