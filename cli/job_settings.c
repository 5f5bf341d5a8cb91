/* Every setting of a fit as a reader would write it on a command line, beside its default. */
#include <string.h>

#include "fit_job.h"

enum { MOST_SETTINGS = 96 };

struct settings {
    struct session *session;
    pia_page_setting *item; /* [MOST_SETTINGS] */
    pia_index count;
};

/* value NULL: the default. */
static void add(struct settings *settings, const char *name, const char *initial, const char *value)
{
    if (settings->count < MOST_SETTINGS) settings->item[settings->count++] = (pia_page_setting){name, value, initial};
}

static void add_number(struct settings *settings, const char *name, const char *initial, double value, double unset)
{
    add(settings, name, initial, value != unset ? session_text(settings->session, "%.15g", value) : NULL);
}

/* Counts a direction; a curve has one. */
static void add_pair(struct settings *settings, const char *name, const char *initial, const pia_index value[2], pia_index unset)
{
    if (value[0] == unset && value[1] == unset)
        add(settings, name, initial, NULL);
    else if (value[0] == value[1] || value[1] == PIA_AUTO)
        add(settings, name, initial, session_text(settings->session, "%lld", (long long)value[0]));
    else
        add(settings, name, initial, session_text(settings->session, "%lld,%lld", (long long)value[0], (long long)value[1]));
}

/* The value of the last "name=value" of this name, NULL without one. */
static const char *setting_of(const struct texts *texts, const char *name)
{
    size_t length = strlen(name);
    for (pia_index i = texts->count - 1; i >= 0; i--)
        if (strncmp(texts->item[i], name, length) == 0 && texts->item[i][length] == '=') return texts->item[i] + length + 1;
    return NULL;
}

/* The parameters of a record, as `option` sets them. */
static void add_parameters(struct settings *settings, const char *option, const char *record, const struct texts *given)
{
    pia_parameter parameter;
    for (pia_index i = 0; pia_list_parameters(record, i, &parameter); i++)
        add(settings, session_text(settings->session, "%s %s", option, parameter.name), parameter.initial,
            setting_of(given, parameter.name));
}

static void add_model(struct settings *settings, const struct fit_request *request, const pia_report *report)
{
    const pia_fit_options *options = &request->options;
    const pia_index degree[2] = {options->degree[0], options->degree[1]};
    const char *kind = request->function_graph         ? "--fit-function"
                       : request->kind == KIND_SURFACE ? "--surface"
                       : request->kind == KIND_CURVE   ? "--curve"
                                                       : NULL;
    const char *chosen_control = session_text(settings->session, "auto: %lld", (long long)report->control_count);
    const char *chosen_method = session_text(settings->session, "auto: %s", report->method);
    add(settings, "kind", "by the file", kind);
    add_pair(settings, "--degree", "3", degree, 3);
    add_pair(settings, "--control", chosen_control, options->control, PIA_AUTO);
    add(settings, "--param", *report->parametrization ? report->parametrization : "chord", request->parameters);
    add(settings, "--knots", *report->placement ? session_text(settings->session, "auto: %s", report->placement) : "auto",
        request->knots);
    add(settings, "--closed", "open", request->closed ? *request->closed ? request->closed : "closed" : NULL);
    add(settings, "--start", "the method's own", request->start);
    add(settings, "--method", chosen_method, options->method);
    add_parameters(settings, "--method-option", report->method, &request->method_options);
}

static void add_goal(struct settings *settings, const struct fit_request *request)
{
    const pia_fit_options *options = &request->options;
    add(settings, "--tolerance", "none", fit_tolerance_text(settings->session, options));
    add(settings, "--point-tolerance", "none", request->tolerances);
    add(settings, "--measure", "parametric", options->measure_distance ? "distance" : NULL);
    add_number(settings, "--correct", "0", (double)options->correct, 0);
    add(settings, "--weights", "1", request->weights);
    add(settings, "--robust", "none", options->robust);
    add_number(settings, "--robust scale", "by the loss", options->robust_scale, PIA_AUTO);
    add_number(settings, "--fairing", "0", options->fairing, 0);
    add(settings, "--corners", "none", request->corners);
}

static void add_conditions(struct settings *settings, const struct fit_request *request)
{
    const pia_fit_options *options = &request->options;
    add(settings, "--interpolate", "none", request->interpolate);
    add(settings, "--constraints", "none", request->constraints);
    add_number(settings, "--soft", "hard", options->soft, 0);
    add(settings, "--freeze", "none", request->freeze);
    add(settings, "--shape", "none", options->limiter);
    if (options->limiter) add_parameters(settings, "--shape-option", options->limiter, &request->shape_options);
}

static void add_stops(struct settings *settings, const struct fit_request *request)
{
    const pia_fit_options *options = &request->options;
    add_number(settings, "--iterations", "the method's own", (double)options->max_iterations, PIA_AUTO);
    add_number(settings, "--stop-change", "1e-14 of the extent", options->stop_change, PIA_AUTO);
    add_number(settings, "--stop-gradient", "1e-12", options->stop_gradient, PIA_AUTO);
    add_number(settings, "--time-limit", "none", options->time_limit, 0);
    add_number(settings, "--threads", "as many as pay", request->session->threads, PIA_AUTO);
}

pia_index fit_settings(const struct fit_job *job, const pia_page_setting **out)
{
    const struct fit_result *first = &job->result[0];
    const pia_report *report = &first->report[first->level_done - 1];
    struct settings settings = {job->session, session_keep(job->session, MOST_SETTINGS, sizeof(pia_page_setting)), 0};
    add_model(&settings, job->request, report);
    add_goal(&settings, job->request);
    add_conditions(&settings, job->request);
    add_stops(&settings, job->request);
    *out = settings.item;
    return settings.count;
}
