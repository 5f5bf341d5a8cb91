#include <string.h>

#include "command.h"
#include "fit_job.h"

static int refuse_combinations(const struct fit_job *job)
{
    const struct fit_request *request = job->request;
    int many = job->part_count > 1;
    if (many && request->trace)
        return fail(EXIT_USAGE, "--trace: the file has %lld parts, a trace follows one; choose it with --part",
                    (long long)job->part_count);
    if (many && (request->checkpoint || request->resume))
        return fail(EXIT_USAGE, "--checkpoint: the file has %lld parts, a checkpoint holds one; choose it with --part",
                    (long long)job->part_count);
    return EXIT_DONE;
}

static int run_part(struct fit_job *job, pia_index part)
{
    struct fit_task task;
    int code = fit_task_open(job, part, &task);
    if (code) return code;
    code = job->request->dry_run ? fit_dry_run(job, &task) : fit_run_task(job, &task, &job->result[job->part_done]);
    if (!code && !job->request->dry_run) job->part_done++;
    fit_task_close(&task);
    return code;
}

static int run_parts(struct fit_job *job)
{
    double begin = seconds_now();
    job->result = session_keep(job->session, (size_t)job->part_count, sizeof *job->result);
    progress_begin(&job->progress, job->session);
    int code = EXIT_DONE;
    if (job->request->resume) {
        code = fit_run_resumed(job, &job->result[0]);
        job->part_done = !code;
    } else
        for (pia_index k = 0; !code && k < job->part_count && !progress_interrupted(); k++) code = run_part(job, job->part_first + k);
    job->fit_seconds = seconds_now() - begin;
    return code;
}

static int write_and_tell(struct fit_job *job)
{
    double begin = seconds_now();
    int code = fit_trim(job);
    if (!code) code = fit_outputs_write(job);
    job->write_seconds = seconds_now() - begin;
    return code ? code : fit_summary_print(job);
}

static int fit(struct fit_job *job)
{
    int code = fit_outputs_check(job->request);
    if (code) return code;
    double begin = seconds_now();
    job->part_count = 1;
    if (job->request->source.path) code = fit_inputs_open(job);
    job->read_seconds = seconds_now() - begin;
    if (!code) code = refuse_combinations(job);
    if (!code) code = run_parts(job);
    if (!code && job->part_done) code = write_and_tell(job);
    for (pia_index k = 0; k < job->part_done; k++) fit_result_close(&job->result[k]);
    fit_inputs_close(job);
    return code;
}

int cmd_fit(struct session *session, int argc, char **argv)
{
    struct fit_request request;
    struct fit_job job = {.request = &request, .session = session};
    int code = fit_request_parse(&request, session, argc, argv);
    if (code) return code;
    session->metered = request.dry_run;
    code = session_open(session);
    return code ? code : fit(&job);
}
