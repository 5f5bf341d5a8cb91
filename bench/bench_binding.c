/* bench_binding COUNT CONTROL: seconds of one least-squares fit of COUNT points, the call that binding_python.py makes from Python. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <time.h>

#include "pia/pia.h"

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int main(int argc, char **argv)
{
    pia_index count = argc > 1 ? atoll(argv[1]) : 1000000;
    size_t huge = 1 << 21, bytes = ((size_t)count * 2 * sizeof(double) + huge - 1) / huge * huge;
    double *points = aligned_alloc(huge, bytes);
    if (points == NULL) return 1;
    madvise(points, bytes, MADV_HUGEPAGE); /* as NumPy does for its arrays */
    for (pia_index i = 0; i < count; i++) {
        points[2 * i] = (double)i;
        points[2 * i + 1] = 1000 * sin(1e-4 * (double)i);
    }
    pia_context *context = NULL;
    pia_model *model = NULL;
    pia_report report = {.struct_size = sizeof report}; /* as Python asks for it: without, errors would not be measured */
    pia_data data;
    pia_fit_options options;
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = points;
    data.count[0] = count;
    data.dim = 2;
    options.control[0] = argc > 2 ? atoll(argv[2]) : 1000;
    if (pia_context_create(NULL, &context) != PIA_OK) return 1;
    double best = INFINITY;
    for (int k = 0; k < 3; k++) {
        double began = seconds();
        if (pia_fit_data(context, &data, &options, &model, &report) != PIA_OK) return 1;
        best = fmin(best, seconds() - began);
        pia_model_destroy(model);
    }
    printf("%.4f s from C, %lld points, %lld control points\n", best, (long long)count, (long long)options.control[0]);
    pia_context_destroy(context);
    free(points);
    return 0;
}
