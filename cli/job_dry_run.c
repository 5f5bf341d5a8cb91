#include "fit_job.h"
#include "json_writer.h"

/* A limit of the iteration: 0 stands for none, PIA_AUTO for the library's own. */
struct limit {
    const char *key, *name;
    double value;
    const char *automatic;
};

enum { LIMITS = 5 };

static void list_limits(const pia_fit_options *options, struct limit out[LIMITS])
{
    out[0] = (struct limit){"tolerance", "tolerance", options->tolerance, ""};
    out[1] = (struct limit){"iterations", "iterations", (double)options->max_iterations, "as many as the method needs"};
    out[2] = (struct limit){"change", "change", options->stop_change, "1e-14 of the extent"};
    out[3] = (struct limit){"gradient", "relative gradient", options->stop_gradient, "1e-12"};
    out[4] = (struct limit){"time", "seconds", options->time_limit, ""};
}

static void print_text(const struct session *session, const pia_report *report, const struct limit limits[LIMITS])
{
    printf("method       %s, degree %d, %lld control points for %lld points\n", report->method, report->degree[0],
           (long long)report->control_count, (long long)report->point_count);
    printf("memory       %.3g MB before the first iteration\n", 1e-6 * (double)session->bytes);
    for (int i = 0; i < LIMITS; i++) {
        const struct limit *limit = &limits[i];
        int never = limit->value == 0 && i != 1;
        printf("%-12s %s: ", i ? "" : "stops", limit->name);
        if (limit->value == PIA_AUTO || never)
            puts(never ? "no limit" : limit->automatic);
        else
            printf("%g\n", limit->value);
    }
}

static void print_json(const struct session *session, const pia_report *report, const struct limit limits[LIMITS])
{
    struct json_writer json = {.stream = stdout};
    json_open(&json, NULL, '{');
    json_text(&json, "method", report->method);
    json_count(&json, "degree", report->degree[0]);
    json_count(&json, "control_count", report->control_count);
    json_count(&json, "point_count", report->point_count);
    json_count(&json, "memory_bytes", (pia_index)session->bytes);
    json_open(&json, "stops", '{');
    for (int i = 0; i < LIMITS; i++) {
        const struct limit *limit = &limits[i];
        if (limit->value == PIA_AUTO)
            json_text(&json, limit->key, limit->automatic);
        else
            json_number(&json, limit->key, limit->value);
    }
    json_close(&json, '}');
    json_close(&json, '}');
    json_end(&json);
}

int fit_dry_run(struct fit_job *job, const struct fit_task *task)
{
    pia_fit *fit = NULL;
    pia_report report = {.struct_size = sizeof report};
    struct limit limits[LIMITS];
    pia_status status = pia_fit_open(job->session->context, &task->data, &task->options, &fit);
    if (status == PIA_OK) status = pia_fit_report(fit, &report);
    int code = session_check(job->session, status, job->request->source.path);
    list_limits(&task->options, limits);
    if (!code && job->session->json)
        print_json(job->session, &report, limits);
    else if (!code)
        print_text(job->session, &report, limits);
    pia_fit_close(fit);
    return code;
}
