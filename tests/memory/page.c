/* The interactive report when memory runs out. */
#include "failing.h"

#include <unistd.h>

typedef struct report {
    pia_model *model, *start;
    double points[60];
    char path[64];
} report;

static pia_status write_report(pia_context *context, void *user)
{
    report *r = user;
    const pia_model *model = r->model, *frames[] = {r->start, r->model};
    const pia_index rows[2] = {3, 5};
    pia_page_options options;
    pia_page_options_init(&options);
    options.frames = frames;
    options.frame_count = 2;
    options.met = rows;
    options.met_count = 2;
    pia_status status = pia_page_write(context, r->path, &model, 1, r->points, 20, &options);
    int exists = access(r->path, F_OK) == 0;
    if (exists != (status == PIA_OK)) return PIA_E_INTERNAL; /* whole or not at all */
    unlink(r->path);
    return status;
}

static pia_model *make_surface(double height)
{
    static const double knots[] = {0, 0, 0, 0.4, 1, 1, 1};
    const int degree[2] = {2, 2};
    const pia_index control[2] = {4, 4};
    double points[48];
    for (int i = 0; i < 16; i++) {
        points[3 * i] = i / 4;
        points[3 * i + 1] = i % 4;
        points[3 * i + 2] = height * sin(i);
    }
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 2, degree, (const double *const[]){knots, knots}, control, 3, points, NULL, &model));
    return model;
}

static void a_report_survives_every_failing_allocation(void **state)
{
    (void)state;
    report r = {.model = make_surface(1), .start = make_surface(0.5)};
    for (int i = 0; i < 60; i++) r.points[i] = 1.5 + cos(i);
    r.points[7] = NAN;
    snprintf(r.path, sizeof r.path, "/tmp/pia-page-%ld.html", (long)getpid());
    assert_survives_failures(write_report, &r);
    pia_model_destroy(r.model);
    pia_model_destroy(r.start);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_report_survives_every_failing_allocation)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
