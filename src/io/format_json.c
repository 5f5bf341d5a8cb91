#include "json.h"

#include <locale.h>
#include <string.h>

/* The whole file as a tree. Numbers are parsed in the C locale whatever the process uses. */
static pia_status load(pia_context *context, const pia_input *input, json_t **out)
{
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (plain == (locale_t)0) return pia_fail(context, PIA_E_MEMORY, "%s: out of memory for the C locale", input->path);
    locale_t before = uselocale(plain);
    json_error_t error;
    json_t *root = json_loadb(input->begin, (size_t)(input->end - input->begin),
                              JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL | JSON_ALLOW_NUL, &error);
    uselocale(before);
    freelocale(plain);
    if (root == NULL && json_error_code(&error) == json_error_out_of_memory)
        return pia_fail(context, PIA_E_MEMORY, "%s: out of memory while reading JSON; free memory", input->path);
    if (root == NULL) {
        for (char *p = error.text; *p != '\0'; p++)
            if ((unsigned char)*p < ' ') *p = ' ';
        return pia_fail(context, PIA_E_FORMAT, "%s:%d: column %d: %s; correct the JSON", input->path, error.line, error.column,
                        error.text);
    }
    *out = root;
    return PIA_OK;
}

static pia_status get_directions(const pia_json_place *place, const json_t *shape, int *directions)
{
    const char *type = json_string_value(json_object_get(shape, "type"));
    if (type != NULL && strcmp(type, "curve") == 0)
        *directions = 1;
    else if (type != NULL && strcmp(type, "surface") == 0)
        *directions = 2;
    else
        return pia_input_fail(place->context, place->input, NULL, "shape.type must be \"curve\" or \"surface\"; is this a model file?");
    return PIA_OK;
}

static pia_status read_dropped(const pia_json_place *place, const json_t *rows, pia_summary *summary)
{
    double *values;
    pia_index count;
    if (json_array_size(rows) == 0) return PIA_OK;
    pia_status status = pia_json_get_reals(place, rows, "dropped_rows", &values, &count);
    if (status != PIA_OK) return status;
    summary->dropped = pia_take(place->context, count, sizeof *summary->dropped);
    if (summary->dropped == NULL) status = pia_take_status(place->context, count, sizeof *summary->dropped);
    for (pia_index i = 0; i < count && status == PIA_OK; i++) {
        double least = i > 0 ? values[i - 1] + 1 : 0;
        if (values[i] >= least && values[i] <= 9007199254740992.0 && values[i] == (double)(pia_index)values[i])
            summary->dropped[i] = (pia_index)values[i];
        else
            status = pia_json_fail(place, "dropped_rows", "must be increasing row numbers");
    }
    summary->dropped_count = count;
    pia_give(place->context, values);
    return status;
}

/* Fills the summary of the model from its part of the key `pia`. */
static pia_status read_summary(const pia_json_place *place, const json_t *memory_of_fit, pia_model *model)
{
    const json_t *parameters = json_object_get(memory_of_fit, "parameters");
    pia_summary *summary = model->summary = pia_take_zero(place->context, 1, sizeof *summary);
    if (summary == NULL) return pia_take_status(place->context, 1, sizeof *summary);
    pia_status status = PIA_OK;
    if (!pia_json_read_fit(pia_memory_of(place->context), json_object_get(memory_of_fit, "fit"), summary))
        status = pia_fail(place->context, PIA_E_MEMORY, "%s: out of memory for the notes of the fit", place->input->path);
    if (status == PIA_OK && json_is_array(parameters))
        status = pia_json_get_reals(place, parameters, "parameters", &summary->parameters, &summary->parameter_count);
    if (status == PIA_OK) status = read_dropped(place, json_object_get(memory_of_fit, "dropped_rows"), summary);
    return status;
}

/* What the key `pia` adds to a model: `memory` is its object, or NULL. */
static pia_status read_memory(const pia_json_place *place, const json_t *memory, pia_model *model)
{
    const json_t *periodic = json_object_get(memory, "periodic");
    for (int d = 0; d < model->directions; d++) model->periodic[d] = json_is_true(json_array_get(periodic, (size_t)d));
    return json_is_object(json_object_get(memory, "fit")) ? read_summary(place, memory, model) : PIA_OK;
}

static pia_status read_data(pia_json_place *place, const json_t *root, pia_model **models, pia_index count)
{
    const json_t *shape = json_object_get(root, "shape"), *data = json_object_get(shape, "data");
    const json_t *pia = json_object_get(root, "pia"), *each = json_object_get(pia, "models");
    int directions = 0;
    pia_status status = get_directions(place, shape, &directions);
    for (pia_index k = 0; k < count && status == PIA_OK; k++) {
        place->model = k;
        status = pia_json_read_shape(place, json_is_array(data) ? json_array_get(data, (size_t)k) : data, directions, &models[k]);
        if (status == PIA_OK) status = read_memory(place, json_is_array(each) ? json_array_get(each, (size_t)k) : pia, models[k]);
    }
    return status;
}

static pia_status read_tree(pia_context *context, const pia_input *input, const json_t *root, pia_model ***out, pia_index *count)
{
    pia_json_place place = {.context = context, .input = input};
    const json_t *data = json_object_get(json_object_get(root, "shape"), "data");
    int tinyspline = pia_json_is_tinyspline(root);
    pia_index size = json_is_array(data) ? (pia_index)json_array_size(data) : json_is_object(data) || tinyspline ? 1 : 0;
    if (size == 0) return pia_input_fail(context, input, NULL, "has no shape.data; is this a model file?");
    pia_model **models = pia_take_zero(context, size, sizeof *models);
    if (models == NULL) return pia_take_status(context, size, sizeof *models);
    if (tinyspline) place.model = PIA_AUTO;
    pia_status status = tinyspline ? pia_json_read_tinyspline(&place, root, models) : read_data(&place, root, models, size);
    if (status == PIA_OK) {
        *out = models;
        *count = size;
        return PIA_OK;
    }
    for (pia_index k = 0; k < size; k++) pia_model_destroy(models[k]);
    pia_give(context, models);
    return status;
}

static pia_status read_models(pia_context *context, const pia_input *input, pia_model ***out, pia_index *count)
{
    json_t *root;
    pia_status status = load(context, input, &root);
    if (status != PIA_OK) return status;
    status = read_tree(context, input, root, out, count);
    json_decref(root);
    return status;
}

const pia_format pia_format_json = {
    .name = "json",
    .title = "JSON model in the layout of geomdl, rw3dm and Sverchok",
    .detail = "reads and writes every model exactly, with trim loops and the report of its fit; reads TinySpline's layout",
    .extensions = "json",
    .read_models = read_models,
    .write_models = pia_json_write_models,
};
