#include "info_model.h"

#include "json_writer.h"

/* What is told of one model. */
struct figures {
    pia_model_info info;
    double low[PIA_MAX_DIM], high[PIA_MAX_DIM];
    double length; /* of a curve */
    int fitted;
    pia_report report; /* when fitted */
};

static int measure(struct session *session, const char *path, const pia_model *model, struct figures *out)
{
    *out = (struct figures){.info.struct_size = sizeof out->info, .report.struct_size = sizeof out->report};
    pia_model_get_info(model, &out->info);
    out->fitted = pia_model_report(model, &out->report);
    pia_status status = pia_model_bounds(session->context, model, out->low, out->high);
    if (status == PIA_OK && out->info.directions == 1) status = pia_model_length(session->context, model, &out->length);
    return session_check(session, status, path);
}

/* ---- Text ---- */

static void print_knots(const pia_model *model, const pia_model_info *info, int direction)
{
    const double *knots = pia_model_knots(model, direction);
    pia_index inside = info->control[direction] - info->degree[direction] - 1, distinct = 0;
    const double *first = knots + info->degree[direction] + 1;
    for (pia_index i = 0; i < inside; i++) distinct += i == 0 || first[i] != first[i - 1];
    printf("%-12s degree %d, %lld control points, domain %.10g to %.10g, %lld inside knots (%lld distinct)%s\n",
           info->directions == 1 ? "curve"
           : direction           ? "surface v"
                                 : "surface u",
           info->degree[direction], (long long)info->control[direction], info->domain[direction][0], info->domain[direction][1],
           (long long)inside, (long long)distinct, info->periodic[direction] ? ", closed" : "");
}

static void print_report(const pia_report *report)
{
    printf("fitted by    %s, %lld iterations, stop %s, %lld points\n", report->method, (long long)report->iterations,
           pia_stop_name(report->stop), (long long)report->point_count);
    printf("             max error %.6g at row %lld, rms error %.6g\n", report->max_error, (long long)report->max_error_index,
           report->rms_error);
}

static void print_text(const pia_model *model, const struct figures *figures)
{
    const pia_model_info *info = &figures->info;
    for (int direction = 0; direction < info->directions; direction++) print_knots(model, info, direction);
    printf("points       %d components%s\n", info->dim, info->rational ? ", rational" : "");
    for (int k = 0; k < info->dim; k++)
        printf("%-12s %d: %.10g to %.10g\n", k ? "" : "bounds", k + 1, figures->low[k], figures->high[k]);
    pia_index loops = pia_model_trim_loop_count(model);
    if (loops > 0) printf("trim loops   %lld, holes among them %lld\n", (long long)loops, (long long)loops - 1);
    if (info->directions == 1) printf("length       %.12g\n", figures->length);
    if (figures->fitted) print_report(&figures->report);
    const char *note;
    for (pia_index i = 0; (note = pia_model_note(model, i)); i++) printf("%-12s %s\n", i ? "" : "notes", note);
}

/* ---- JSON ---- */

static void put_direction(struct json_writer *json, const pia_model *model, const pia_model_info *info, int direction)
{
    json_open(json, NULL, '{');
    json_count(json, "degree", info->degree[direction]);
    json_count(json, "control", info->control[direction]);
    json_truth(json, "closed", info->periodic[direction]);
    json_numbers(json, "domain", info->domain[direction], 2);
    json_numbers(json, "knots", pia_model_knots(model, direction), info->knot_count[direction]);
    json_close(json, '}');
}

static void put_report(struct json_writer *json, const pia_report *report)
{
    json_open(json, "fit", '{');
    json_text(json, "method", report->method);
    json_count(json, "iterations", report->iterations);
    json_text(json, "stop", pia_stop_name(report->stop));
    json_truth(json, "reached", report->reached);
    json_count(json, "point_count", report->point_count);
    json_number(json, "max_error", report->max_error);
    json_count(json, "max_error_index", report->max_error_index);
    json_number(json, "rms_error", report->rms_error);
    json_close(json, '}');
}

static void put_model(struct json_writer *json, const pia_model *model, const struct figures *figures)
{
    const pia_model_info *info = &figures->info;
    json_open(json, NULL, '{');
    json_text(json, "kind", info->directions == 1 ? "curve" : "surface");
    json_count(json, "dim", info->dim);
    json_truth(json, "rational", info->rational);
    json_count(json, "control_count", info->control[0] * info->control[1]);
    json_open(json, "directions", '[');
    for (int direction = 0; direction < info->directions; direction++) put_direction(json, model, info, direction);
    json_close(json, ']');
    json_numbers(json, "low", figures->low, info->dim);
    json_numbers(json, "high", figures->high, info->dim);
    if (info->directions == 1) json_number(json, "length", figures->length);
    if (info->directions == 2) json_count(json, "trim_loops", pia_model_trim_loop_count(model));
    if (figures->fitted) put_report(json, &figures->report);
    json_open(json, "notes", '[');
    const char *note;
    for (pia_index i = 0; (note = pia_model_note(model, i)); i++) json_text(json, NULL, note);
    json_close(json, ']');
    json_close(json, '}');
}

int info_models(struct session *session, const struct model_set *set)
{
    struct json_writer json = {.stream = stdout};
    struct figures *figures = session_keep(session, (size_t)set->count, sizeof *figures);
    for (pia_index i = 0; i < set->count; i++) {
        int code = measure(session, set->path, set->model[i], &figures[i]);
        if (code) return code;
    }
    if (!session->json) {
        for (pia_index i = 0; i < set->count; i++) {
            if (set->count > 1) printf("model %lld\n", (long long)i);
            print_text(set->model[i], &figures[i]);
        }
        return EXIT_DONE;
    }
    json_open(&json, NULL, '{');
    json_text(&json, "file", set->path);
    json_text(&json, "holds", "models");
    json_open(&json, "models", '[');
    for (pia_index i = 0; i < set->count; i++) put_model(&json, set->model[i], &figures[i]);
    json_close(&json, ']');
    json_close(&json, '}');
    json_end(&json);
    return EXIT_DONE;
}
