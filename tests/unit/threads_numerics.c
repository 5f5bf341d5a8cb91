/* Results do not depend on the number of threads, bit for bit. */
#include "check.h"
#include "deviation.h"
#include "param.h"

#include <stdlib.h>

enum { COUNT = 300000 };

static const int thread_counts[] = {1, 2, 3, 8};

static pia_context *context_with(int threads)
{
    pia_context_options options;
    pia_context_options_init(&options);
    options.threads = threads;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(&options, &context));
    return context;
}

static double *random_numbers(int count)
{
    double *values = malloc((size_t)count * sizeof *values);
    assert_non_null(values);
    srand(9);
    for (int i = 0; i < count; i++) values[i] = rand() / (double)RAND_MAX;
    return values;
}

static void parameters_do_not_depend_on_the_number_of_threads(void **state)
{
    (void)state;
    double *points = random_numbers(2 * COUNT), *first = malloc(COUNT * sizeof *first), *t = malloc(COUNT * sizeof *t);
    const pia_parametrization *rule;
    for (pia_index r = 0; (rule = pia_param_list(r)) != NULL; r++)
        for (int k = 0; k < 4; k++) {
            pia_context *context = context_with(thread_counts[k]);
            assert_ok(context, rule->compute(context, points, COUNT, 2, 3, 1, k == 0 ? first : t));
            if (k > 0) assert_memory_equal(t, first, COUNT * sizeof *t);
            pia_context_destroy(context);
        }
    free(points), free(first), free(t);
}

static void statistics_do_not_depend_on_the_number_of_threads(void **state)
{
    (void)state;
    pia_deviation first = {0}, out = {0};
    for (int k = 0; k < 4; k++) {
        double *distances = random_numbers(COUNT);
        pia_context *context = context_with(thread_counts[k]);
        assert_ok(context, pia_deviation_summarize(context, distances, COUNT, k == 0 ? &first : &out));
        if (k > 0) assert_memory_equal(&out, &first, sizeof out);
        pia_context_destroy(context);
        free(distances);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parameters_do_not_depend_on_the_number_of_threads),
        cmocka_unit_test(statistics_do_not_depend_on_the_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
