#include "json.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* One table for writing and reading: the members of the report that are plain texts, counts and numbers. */

typedef enum member_type { TEXT, COUNT, REAL } member_type; /* char [24], pia_index, double */

typedef struct member {
    const char *key;
    member_type type;
    size_t offset;
} member;

#define MEMBER(key, type, field)                                                                                                       \
    {                                                                                                                                  \
        key, type, offsetof(pia_report, field)                                                                                         \
    }

static const member plain_member[] = {
    MEMBER("method", TEXT, method),
    MEMBER("control_count", COUNT, control_count),
    MEMBER("point_count", COUNT, point_count),
    MEMBER("iterations", COUNT, iterations),
    MEMBER("max_error", REAL, max_error),
    MEMBER("max_error_index", COUNT, max_error_index),
    MEMBER("rms_error", REAL, rms_error),
    MEMBER("constraint_error", REAL, constraint_error),
    MEMBER("parametrization", TEXT, parametrization),
    MEMBER("placement", TEXT, placement),
    MEMBER("limiter", TEXT, limiter),
    MEMBER("relative_gradient", REAL, relative_gradient),
    MEMBER("start_error", REAL, start_error),
    MEMBER("rate", REAL, rate),
    MEMBER("between_error", REAL, between_error),
    MEMBER("repaired_count", COUNT, repaired_count),
    MEMBER("unsupported_count", COUNT, unsupported_count),
    MEMBER("outlier_count", COUNT, outlier_count),
    MEMBER("round_count", COUNT, round_count),
};

enum { PLAIN_MEMBERS = sizeof plain_member / sizeof *plain_member };

static const char *const kind_name[] = {[PIA_CURVE] = "curve", [PIA_GRID] = "grid", [PIA_SCATTERED] = "surface"};

static void write_member(pia_output *output, const pia_report *report, const member *m)
{
    const char *at = (const char *)report + m->offset;
    pia_output_text(output, ", \"%s\": ", m->key);
    if (m->type == TEXT) {
        pia_json_write_text(output, at);
    } else if (m->type == REAL) {
        double value;
        memcpy(&value, at, sizeof value);
        pia_json_write_real(output, value);
    } else {
        pia_index value;
        memcpy(&value, at, sizeof value);
        pia_output_text(output, "%lld", (long long)value);
    }
}

static void write_axes(pia_output *output, const pia_report *report)
{
    if (report->worst_axis == PIA_AUTO) return;
    pia_output_text(output, ", \"worst_axis\": %d, \"axis_errors\": [", report->worst_axis);
    for (int d = 0; d < PIA_MAX_DIM && !isnan(report->axis_error[d]); d++) {
        if (d > 0) pia_output_text(output, ", ");
        pia_json_write_real(output, report->axis_error[d]);
    }
    pia_output_text(output, "]");
}

void pia_json_write_fit(pia_output *output, const pia_summary *summary)
{
    const pia_report *report = &summary->report;
    pia_output_text(output, "{\"kind\": \"%s\"", kind_name[report->kind]);
    if (report->kind == PIA_CURVE)
        pia_output_text(output, ", \"degree\": %d", report->degree[0]);
    else
        pia_output_text(output, ", \"degree\": [%d, %d]", report->degree[0], report->degree[1]);
    pia_output_text(output, ", \"control\": [%lld, %lld]", (long long)report->control[0], (long long)report->control[1]);
    for (int i = 0; i < PLAIN_MEMBERS; i++) write_member(output, report, &plain_member[i]);
    write_axes(output, report);
    pia_output_text(output,
                    ", \"stop\": \"%s\", \"reached\": %s, \"measure\": \"%s\", \"seconds\": {\"fit\": ", pia_stop_name(report->stop),
                    report->reached == PIA_AUTO ? "null"
                    : report->reached           ? "true"
                                                : "false",
                    report->measure_distance ? "distance" : "parametric");
    pia_json_write_real(output, report->seconds);
    pia_output_text(output, "}, \"warnings\": [");
    for (pia_index i = 0; i < summary->notes.count; i++) {
        if (i > 0) pia_output_text(output, ", ");
        pia_json_write_text(output, summary->notes.line[i]);
    }
    pia_output_text(output, "]}");
}

/* A whole number that a double holds exactly; 0 otherwise. */
static pia_index whole(const json_t *value)
{
    double number = json_number_value(value);
    return number == floor(number) && fabs(number) <= 9007199254740992.0 ? (pia_index)number : 0;
}

static int small(const json_t *value)
{
    pia_index number = whole(value);
    return number >= 0 && number <= PIA_MAX_DEGREE ? (int)number : 0;
}

static void read_member(const json_t *fit, const member *m, pia_report *report)
{
    const json_t *value = json_object_get(fit, m->key);
    char *at = (char *)report + m->offset;
    if (m->type == TEXT) {
        const char *text = json_string_value(value);
        snprintf(at, sizeof report->method, "%s", text != NULL ? text : "");
    } else if (m->type == REAL) {
        double number = json_is_number(value) ? json_number_value(value) : NAN;
        memcpy(at, &number, sizeof number);
    } else {
        pia_index count = whole(value);
        memcpy(at, &count, sizeof count);
    }
}

static void read_words(const json_t *fit, pia_report *report)
{
    const char *kind = json_string_value(json_object_get(fit, "kind"));
    const char *stop = json_string_value(json_object_get(fit, "stop"));
    const char *measure = json_string_value(json_object_get(fit, "measure"));
    for (int k = PIA_CURVE; k <= PIA_SCATTERED; k++)
        if (kind != NULL && strcmp(kind, kind_name[k]) == 0) report->kind = (pia_kind)k;
    for (int s = PIA_STOP_NONE; s <= PIA_STOP_INFEASIBLE; s++)
        if (stop != NULL && strcmp(stop, pia_stop_name((pia_stop)s)) == 0) report->stop = (pia_stop)s;
    report->measure_distance = measure != NULL && strcmp(measure, "distance") == 0;
}

static void read_axes(const json_t *fit, pia_report *report)
{
    const json_t *errors = json_object_get(fit, "axis_errors"), *worst = json_object_get(fit, "worst_axis");
    size_t count = json_array_size(errors);
    int known = json_is_number(worst) && whole(worst) >= 0 && whole(worst) < (pia_index)count && count <= PIA_MAX_DIM;
    report->worst_axis = known ? (int)whole(worst) : PIA_AUTO;
    for (size_t d = 0; d < PIA_MAX_DIM; d++)
        report->axis_error[d] = known && d < count ? json_number_value(json_array_get(errors, d)) : NAN;
}

int pia_json_read_fit(const pia_memory *memory, const json_t *fit, pia_summary *summary)
{
    pia_report *report = &summary->report;
    *report = (pia_report){.struct_size = sizeof *report};
    read_words(fit, report);
    const json_t *degree = json_object_get(fit, "degree"), *control = json_object_get(fit, "control");
    for (size_t d = 0; d < 2; d++) {
        report->degree[d] = small(json_is_array(degree) ? json_array_get(degree, d) : d == 0 ? degree : NULL);
        report->control[d] = whole(json_array_get(control, d));
    }
    for (int i = 0; i < PLAIN_MEMBERS; i++) read_member(fit, &plain_member[i], report);
    read_axes(fit, report);
    const json_t *reached = json_object_get(fit, "reached");
    report->reached = json_is_boolean(reached) ? json_is_true(reached) : PIA_AUTO;
    report->seconds = json_number_value(json_object_get(json_object_get(fit, "seconds"), "fit"));
    const json_t *warnings = json_object_get(fit, "warnings");
    for (size_t i = 0; i < json_array_size(warnings); i++) {
        const char *text = json_string_value(json_array_get(warnings, i));
        if (text != NULL && !pia_note_add(memory, &summary->notes, "%s", text)) return 0;
    }
    return 1;
}
