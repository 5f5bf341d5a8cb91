#include "json.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

pia_status pia_json_fail(const pia_json_place *place, const char *key, const char *what)
{
    if (place->model == PIA_AUTO) return pia_input_fail(place->context, place->input, NULL, "%s %s", key, what);
    return pia_input_fail(place->context, place->input, NULL, "shape.data[%lld]: %s %s", (long long)place->model, key, what);
}

pia_status pia_json_get_index(const pia_json_place *place, const json_t *object, const char *key, pia_index least, pia_index most,
                              pia_index *out)
{
    const json_t *value = json_object_get(object, key);
    double number = json_number_value(value);
    if (value == NULL) return pia_json_fail(place, key, "is missing");
    if (!json_is_number(value) || number != floor(number) || number < (double)least || number > (double)most) {
        char what[80];
        snprintf(what, sizeof what, "must be a whole number from %lld to %lld", (long long)least, (long long)most);
        return pia_json_fail(place, key, what);
    }
    *out = (pia_index)number;
    return PIA_OK;
}

pia_status pia_json_get_reals(const pia_json_place *place, const json_t *array, const char *key, double **out, pia_index *count)
{
    if (array == NULL) return pia_json_fail(place, key, "is missing");
    if (!json_is_array(array)) return pia_json_fail(place, key, "must be an array of numbers");
    pia_index size = (pia_index)json_array_size(array);
    double *values = pia_take(place->context, size, sizeof *values);
    if (values == NULL) return pia_take_status(place->context, size, sizeof *values);
    for (pia_index i = 0; i < size; i++) {
        const json_t *value = json_array_get(array, (size_t)i);
        if (!json_is_number(value)) {
            pia_give(place->context, values);
            return pia_json_fail(place, key, "holds something that is not a number");
        }
        values[i] = json_number_value(value);
    }
    *out = values;
    *count = size;
    return PIA_OK;
}

pia_status pia_json_get_points(const pia_json_place *place, const json_t *rows, double **out, pia_index *count, int *dim)
{
    if (!json_is_array(rows) || json_array_size(rows) == 0) return pia_json_fail(place, "points", "must be an array of points");
    pia_index size = (pia_index)json_array_size(rows), width = (pia_index)json_array_size(json_array_get(rows, 0)), total;
    if (width < 1 || width > PIA_MAX_DIM) return pia_json_fail(place, "points", "must have 1 to 16 components each");
    if (!pia_multiply(size, width, &total)) return pia_json_fail(place, "points", "are too many");
    double *values = pia_take(place->context, total, sizeof *values);
    if (values == NULL) return pia_take_status(place->context, total, sizeof *values);
    for (pia_index i = 0; i < size; i++) {
        const json_t *row = json_array_get(rows, (size_t)i);
        int valid = json_is_array(row) && (pia_index)json_array_size(row) == width;
        for (pia_index c = 0; c < width && valid; c++) {
            const json_t *value = json_array_get(row, (size_t)c);
            valid = json_is_number(value);
            values[i * width + c] = json_number_value(value);
        }
        if (valid) continue;
        pia_give(place->context, values);
        return pia_input_fail(place->context, place->input, NULL, "shape.data[%lld]: points[%lld] is not an array of %lld numbers",
                              (long long)place->model, (long long)i, (long long)width);
    }
    *out = values;
    *count = size;
    *dim = (int)width;
    return PIA_OK;
}

/* The arrays of one shape while they are collected. */
typedef struct shape {
    int directions, degree[2], dim;
    pia_index control[2], knot_count[2], point_count, weight_count;
    double *knots[2], *points, *weights;
} shape;

static void clear_shape(pia_context *context, shape *s)
{
    pia_give(context, s->knots[0]);
    pia_give(context, s->knots[1]);
    pia_give(context, s->points);
    pia_give(context, s->weights);
}

static pia_status get_direction(const pia_json_place *place, const json_t *data, int d, const char *degree_key, const char *knots_key,
                                shape *s)
{
    pia_index degree;
    pia_status status = pia_json_get_index(place, data, degree_key, 1, PIA_MAX_DEGREE, &degree);
    if (status != PIA_OK) return status;
    s->degree[d] = (int)degree;
    return pia_json_get_reals(place, json_object_get(data, knots_key), knots_key, &s->knots[d], &s->knot_count[d]);
}

static pia_status get_sizes(const pia_json_place *place, const json_t *data, shape *s)
{
    s->control[0] = s->point_count;
    s->control[1] = 1;
    if (s->directions == 1) return PIA_OK;
    pia_status status = pia_json_get_index(place, data, "size_u", 1, s->point_count, &s->control[0]);
    if (status == PIA_OK) status = pia_json_get_index(place, data, "size_v", 1, s->point_count, &s->control[1]);
    pia_index product;
    if (status == PIA_OK && (!pia_multiply(s->control[0], s->control[1], &product) || product != s->point_count))
        status = pia_json_fail(place, "points", "are not size_u * size_v");
    return status;
}

/* What the file says; where it says nothing, weights speak. */
static int is_rational(const json_t *data)
{
    const json_t *word = json_object_get(data, "rational");
    return word != NULL ? json_is_true(word) : json_object_get(json_object_get(data, "control_points"), "weights") != NULL;
}

static pia_status collect(const pia_json_place *place, const json_t *data, shape *s)
{
    const json_t *control = json_object_get(data, "control_points");
    pia_status status;
    if (s->directions == 1) {
        status = get_direction(place, data, 0, "degree", "knotvector", s);
    } else {
        status = get_direction(place, data, 0, "degree_u", "knotvector_u", s);
        if (status == PIA_OK) status = get_direction(place, data, 1, "degree_v", "knotvector_v", s);
    }
    if (status == PIA_OK) status = pia_json_get_points(place, json_object_get(control, "points"), &s->points, &s->point_count, &s->dim);
    if (status == PIA_OK) status = get_sizes(place, data, s);
    if (status == PIA_OK && is_rational(data))
        status = pia_json_get_reals(place, json_object_get(control, "weights"), "weights", &s->weights, &s->weight_count);
    for (int d = 0; d < s->directions && status == PIA_OK; d++)
        if (s->knot_count[d] != s->control[d] + s->degree[d] + 1)
            status = pia_input_fail(place->context, place->input, NULL,
                                    "shape.data[%lld]: %lld knots do not go with %lld control points of degree %d; there must be %lld",
                                    (long long)place->model, (long long)s->knot_count[d], (long long)s->control[d], s->degree[d],
                                    (long long)(s->control[d] + s->degree[d] + 1));
    if (status == PIA_OK && s->weights != NULL && s->weight_count != s->point_count)
        status = pia_json_fail(place, "weights", "must be as many as the points");
    return status;
}

static pia_status make_model(const pia_json_place *place, const json_t *data, const shape *s, pia_model **out)
{
    const double *knots[2] = {s->knots[0], s->knots[1]};
    const json_t *trims = s->directions == 2 ? json_object_get(data, "trims") : NULL;
    pia_model *model = NULL;
    pia_status status =
        pia_model_create(place->context, s->directions, s->degree, knots, s->control, s->dim, s->points, s->weights, &model);
    if (status == PIA_OK && trims != NULL) status = pia_json_read_trim(place, trims, &model);
    if (status == PIA_OK)
        *out = model;
    else
        pia_model_destroy(model);
    return status;
}

pia_status pia_json_read_shape(const pia_json_place *place, const json_t *data, int directions, pia_model **out)
{
    if (!json_is_object(data)) return pia_json_fail(place, "data", "must be an object");
    shape s = {.directions = directions};
    pia_status status = collect(place, data, &s);
    if (status == PIA_OK) {
        char where[40];
        snprintf(where, sizeof where, "shape.data[%lld]: ", (long long)place->model);
        status = pia_input_judge(place->context, place->input, NULL, where, make_model(place, data, &s, out));
    }
    clear_shape(place->context, &s);
    return status;
}
