#include "json.h"

#include <math.h>
#include <string.h>

void pia_json_write_text(pia_output *output, const char *text)
{
    pia_output_bytes(output, "\"", 1);
    for (const char *p = text; *p != '\0'; p++) {
        unsigned char c = (unsigned char)*p;
        if (c == '"' || c == '\\')
            pia_output_text(output, "\\%c", c);
        else if (c < ' ')
            pia_output_text(output, "\\u%04x", c);
        else
            pia_output_bytes(output, p, 1);
    }
    pia_output_bytes(output, "\"", 1);
}

void pia_json_write_real(pia_output *output, double value)
{
    if (isfinite(value))
        pia_output_number(output, value);
    else
        pia_output_bytes(output, "null", 4);
}

void pia_json_write_reals(pia_output *output, const double *values, pia_index count)
{
    pia_output_bytes(output, "[", 1);
    for (pia_index i = 0; i < count; i++) {
        if (i > 0) pia_output_bytes(output, ", ", 2);
        pia_json_write_real(output, values[i]);
    }
    pia_output_bytes(output, "]", 1);
}

static void write_knots(pia_output *output, const pia_model *model, int direction, const char *key)
{
    pia_output_text(output, "     \"%s\": ", key);
    pia_json_write_reals(output, model->knots[direction], model->control[direction] + model->degree[direction] + 1);
    pia_output_text(output, ",\n");
}

/* Cartesian points: the quotient x of a stored product w x gives the same product again when it is read. */
static void write_points(pia_output *output, const pia_model *model, pia_index count, int width)
{
    double point[PIA_MAX_DIM];
    pia_output_text(output, "     \"control_points\": {\"points\": [");
    for (pia_index i = 0; i < count; i++) {
        const double *stored = model->points + i * width;
        for (int c = 0; c < model->dim; c++) point[c] = model->rational ? stored[c] / stored[model->dim] : stored[c];
        pia_output_text(output, i > 0 ? ",\n       " : "\n       ");
        pia_json_write_reals(output, point, model->dim);
    }
    pia_output_text(output, "]");
    for (pia_index i = 0; i < count && model->rational; i++) {
        pia_output_text(output, i > 0 ? ", " : ",\n      \"weights\": [");
        pia_json_write_real(output, model->points[i * width + model->dim]);
    }
    pia_output_text(output, model->rational ? "]}" : "}");
}

static void write_shape(pia_output *output, const pia_model *model)
{
    pia_output_text(output, "    {\"type\": \"spline\", \"rational\": %s, \"dimension\": %d,\n", model->rational ? "true" : "false",
                    model->dim);
    if (model->directions == 1) {
        pia_output_text(output, "     \"degree\": %d,\n", model->degree[0]);
        write_knots(output, model, 0, "knotvector");
    } else {
        pia_output_text(output, "     \"degree_u\": %d, \"degree_v\": %d,\n", model->degree[0], model->degree[1]);
        write_knots(output, model, 0, "knotvector_u");
        write_knots(output, model, 1, "knotvector_v");
        pia_output_text(output, "     \"size_u\": %lld, \"size_v\": %lld,\n", (long long)model->control[0],
                        (long long)model->control[1]);
    }
    write_points(output, model, model->control[0] * model->control[1], pia_model_width(model));
    if (model->trim != NULL) pia_json_write_trim(output, model->trim);
    pia_output_bytes(output, "}", 1);
}

static void write_dropped(pia_output *output, const pia_summary *summary)
{
    pia_output_text(output, ", \"dropped_rows\": [");
    for (pia_index i = 0; i < summary->dropped_count; i++)
        pia_output_text(output, i > 0 ? ", %lld" : "%lld", (long long)summary->dropped[i]);
    pia_output_text(output, "]");
}

/* What one model remembers beyond its shape, without braces. */
static void write_memory(pia_output *output, const pia_model *model)
{
    const pia_summary *summary = model->summary;
    pia_output_text(output, "\"periodic\": [%s", model->periodic[0] ? "true" : "false");
    if (model->directions == 2) pia_output_text(output, ", %s", model->periodic[1] ? "true" : "false");
    pia_output_text(output, "]");
    if (summary == NULL) return;
    pia_output_text(output, ", \"parameters\": ");
    if (summary->parameters != NULL)
        pia_json_write_reals(output, summary->parameters, summary->parameter_count);
    else
        pia_json_write_text(output, summary->report.parametrization);
    write_dropped(output, summary);
    pia_output_text(output, ",\n  \"fit\": ");
    pia_json_write_fit(output, summary);
}

pia_status pia_json_write_models(pia_context *context, pia_output *output, const pia_model *const *models, pia_index count,
                                 const pia_write_options *options)
{
    (void)options;
    for (pia_index k = 1; k < count; k++)
        if (models[k]->directions != models[0]->directions)
            return pia_fail(context, PIA_E_SHAPE, "model %lld is a %s, the first is not; write them to files of their own",
                            (long long)k, models[k]->directions == 1 ? "curve" : "surface");
    pia_output_text(output, "{\"shape\": {\"type\": \"%s\", \"count\": %lld, \"data\": [\n",
                    models[0]->directions == 1 ? "curve" : "surface", (long long)count);
    for (pia_index k = 0; k < count; k++) {
        write_shape(output, models[k]);
        pia_output_text(output, k + 1 < count ? ",\n" : "]},\n");
    }
    pia_output_text(output, " \"pia\": {\"schema\": 1, \"version\": \"%s\", ", pia_version());
    if (count == 1) write_memory(output, models[0]);
    for (pia_index k = 0; k < count && count > 1; k++) {
        pia_output_text(output, k == 0 ? "\"models\": [\n  {" : ",\n  {");
        write_memory(output, models[k]);
        pia_output_text(output, k + 1 < count ? "}" : "}]");
    }
    pia_output_text(output, "}}\n");
    return PIA_OK;
}
