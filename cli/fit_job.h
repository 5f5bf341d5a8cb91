/* pia fit, from request to outputs: job_options.c reads the command line into a fit_request, job_setup.c makes the library's data and
 * options of it (job_base.c parameters from a base surface), job_run.c runs them, job_trim.c ends surfaces where their points do,
 * job_output.c writes the files, job_report.c the report among them, job_summary.c tells the result. */
#ifndef PIA_CLI_FIT_JOB_H
#define PIA_CLI_FIT_JOB_H

#include "constraint_file.h"
#include "number_file.h"
#include "point_source.h"
#include "progress.h"
#include "recording.h"

enum fit_kind { KIND_BY_FILE, KIND_CURVE, KIND_SURFACE };

struct fit_request {
    struct session *session;
    struct point_source source;
    enum fit_kind kind;
    int function_graph;
    pia_fit_options options; /* what needs no file */
    double axis_tolerances[PIA_MAX_DIM];
    struct texts method_options, shape_options;
    const char *parameters, *knots, *start; /* names or files, as given; NULL: not given */
    const char *interpolate, *constraints, *corners, *freeze;
    const char *weights, *tolerances;
    const char *closed; /* "", "u", "v" or "uv" */
    const char *order;  /* "given", "nearest" or "tree"; NULL: given */
    const char *trim;   /* "alpha", "hull" or "none"; NULL: alpha for scattered points */
    double trim_radius; /* 0: from the spacing */
    const char *format; /* --format: of the file that it turns out to mean */
    const char *output_format;
    struct texts outputs; /* -o */
    pia_write_options writing;
    const char *report, *trace, *checkpoint, *resume;
    struct texts levels; /* numbers as written */
    int levels_are_iterations;
    int dry_run;
    const char *command; /* the command line, as a shell takes it */
};

/* What one part of the file is fitted with; arrays are kept by the session, models are released by fit_task_close. */
struct fit_task {
    struct row_span span;
    pia_data data;
    pia_fit_options options;
    pia_model **start;
    pia_index start_count;
    struct constraint_file constraints;
};

/* One fit, and its models at each level (one level when none were asked). */
struct fit_result {
    struct row_span span;
    pia_report *report; /* [level_done] */
    pia_model **model;  /* [level_done] */
    pia_index level_done;
    double *trace; /* [trace_count x TRACE_COLUMNS] */
    pia_index trace_count;
    pia_fit_options options;    /* what it was fitted with; `start` is gone */
    struct recording recording; /* empty without --report */
};

enum { TRACE_COLUMNS = 7 };

struct fit_job {
    struct fit_request *request;
    struct session *session;
    struct point_set points;
    pia_kind kind;
    struct numbers parameters, weights, tolerances, knots; /* files that options name; count 0: none */
    pia_index part_first, part_count;                      /* parts to fit */
    struct fit_result *result;                             /* [part_done] */
    pia_index part_done;                                   /* parts fitted: fewer after Ctrl-C */
    struct texts outputs;                                  /* files written */
    struct progress progress;
    double read_seconds, fit_seconds, write_seconds;
};

/* job_options.c. Returns as arguments_parse. */
int fit_request_parse(struct fit_request *request, struct session *session, int argc, char **argv);

/* job_setup.c: reads the points and the files that options name; then one task for each part. */
int fit_inputs_open(struct fit_job *job);
void fit_inputs_close(struct fit_job *job);
/* job_order.c: the points of a curve in the order that --order asks for; a hint where the given one looks random. */
int fit_order(struct fit_job *job);
/* job_base.c: the parameters of scattered points from a base surface. */
int fit_base_open(struct fit_job *job, const char *path);
int fit_task_open(struct fit_job *job, pia_index part, struct fit_task *out);
void fit_task_close(struct fit_task *task);

/* job_run.c */
int fit_run_task(struct fit_job *job, const struct fit_task *task, struct fit_result *result);
int fit_run_resumed(struct fit_job *job, struct fit_result *result);
void fit_result_close(struct fit_result *result);

/* job_trim.c: trimmed models in place of those of scattered points, as --trim says. */
int fit_trim(struct fit_job *job);

/* job_dry_run.c: says what would be done, and does nothing. */
int fit_dry_run(struct fit_job *job, const struct fit_task *task);

/* job_output.c: refuses outputs that cannot be written before any work is done; writes them. */
int fit_outputs_check(struct fit_request *request);
int fit_outputs_write(struct fit_job *job);

/* job_report.c: writes the report on the models of the last level. */
pia_status fit_report_write(struct fit_job *job, const pia_model *const *models);

/* job_settings.c: every setting of a fit with its default, kept by the session; returns how many. */
pia_index fit_settings(const struct fit_job *job, const pia_page_setting **out);

/* The points that the parts fitted were made from, as one stretch; count 0 where a checkpoint was resumed without them. */
pia_points_info fit_points_shown(const struct fit_job *job, pia_index *count);

/* The tolerance as written on a command line; NULL where none was asked. */
const char *fit_tolerance_text(struct session *session, const pia_fit_options *options);
/* job_summary.c: prints the text or the JSON, and returns the exit status. */
int fit_summary_print(const struct fit_job *job);

#endif
