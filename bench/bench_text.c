/* Reading text: megabytes a second of pia_points_read on memory-mapped files, beside strtod on the same bytes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "pia/pia.h"

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double write_file(const char *path, const char *format, long rows)
{
    FILE *file = fopen(path, "w");
    if (file == NULL) exit(4);
    srand(1);
    for (long i = 0; i < rows; i++) {
        double x = (double)i / 7, y = 1000.0 * rand() / RAND_MAX - 500, z = 1e-3 * rand() / RAND_MAX;
        fprintf(file, format, x, y, z);
    }
    long size = ftell(file);
    if (fclose(file) != 0) exit(4);
    return (double)size;
}

static double seconds_of_reading(const char *path, long rows, double *sum)
{
    pia_context *context;
    pia_points *points;
    pia_points_info info;
    if (pia_context_create(NULL, &context) != PIA_OK) exit(6);
    double start = now();
    if (pia_points_read(context, path, NULL, &points) != PIA_OK) {
        fprintf(stderr, "%s\n", pia_message(context));
        exit(3);
    }
    double seconds = now() - start;
    pia_points_get_info(points, &info);
    if (info.count[0] != rows) exit(6);
    *sum = 0;
    for (pia_index i = 0; i < 3 * info.count[0]; i++) *sum += info.points[i];
    pia_points_destroy(points);
    pia_context_destroy(context);
    return seconds;
}

/* The bare conversion, without lines or fields: the least a reader built on strtod can take. */
static double seconds_of_strtod(const char *path, double size, double *sum)
{
    char *text = malloc((size_t)size + 1);
    FILE *file = fopen(path, "r");
    if (text == NULL || file == NULL || fread(text, 1, (size_t)size, file) != (size_t)size) exit(4);
    fclose(file);
    text[(size_t)size] = '\0';
    double start = now();
    *sum = 0;
    for (char *p = text, *end; *p != '\0'; p = *end != '\0' ? end + 1 : end) *sum += strtod(p, &end);
    double seconds = now() - start;
    free(text);
    return seconds;
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name, *format;
    } kind[] = {{"6 decimals", "%.6f,%.6f,%.6f\n"}, {"17 digits", "%.17g,%.17g,%.17g\n"}, {"blanks", "%12.5f %12.5f %12.5f\n"}};
    long rows = argc > 1 ? atol(argv[1]) : 1000000;
    const char *path = "bench_text.csv";
    printf("%-12s %10s %10s %12s %12s %8s\n", "file", "rows", "MB", "pia MB/s", "strtod MB/s", "ratio");
    for (size_t k = 0; k < sizeof kind / sizeof *kind; k++) {
        double size = write_file(path, kind[k].format, rows), best = 1e9, sum = 0, check = 0;
        for (int run = 0; run < 3; run++) {
            double seconds = seconds_of_reading(path, rows, &sum);
            if (seconds < best) best = seconds;
        }
        double peer = seconds_of_strtod(path, size, &check);
        printf("%-12s %10ld %10.1f %12.0f %12.0f %8.2f%s\n", kind[k].name, rows, size / 1e6, size / 1e6 / best, size / 1e6 / peer,
               peer / best, sum == check ? "" : "  SUMS DIFFER");
    }
    unlink(path);
    return 0;
}
