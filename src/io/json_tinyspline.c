/* TinySpline's own layout, one polynomial curve: {"degree", "dimension", "control_points": [x, y, x, y, ...], "knots": [...]}. */
#include "json.h"

int pia_json_is_tinyspline(const json_t *root)
{
    return json_object_get(root, "shape") == NULL && json_is_array(json_object_get(root, "control_points")) &&
           json_is_array(json_object_get(root, "knots"));
}

static pia_status make_curve(const pia_json_place *place, pia_index degree, pia_index dim, const double *points, pia_index values,
                             const double *knots, pia_index knot_count, pia_model **out)
{
    const int degrees[] = {(int)degree};
    const double *const all[] = {knots};
    pia_index control = values / dim;
    if (values % dim != 0) return pia_json_fail(place, "control_points", "are not whole points of this dimension");
    if (knot_count != control + degree + 1) return pia_json_fail(place, "knots", "must be as many as control points + degree + 1");
    pia_status status = pia_model_create(place->context, 1, degrees, all, &control, (int)dim, points, NULL, out);
    return pia_input_judge(place->context, place->input, NULL, "", status);
}

pia_status pia_json_read_tinyspline(const pia_json_place *place, const json_t *root, pia_model **out)
{
    pia_index degree, dim, values = 0, knot_count = 0;
    double *points = NULL, *knots = NULL;
    pia_status status = pia_json_get_index(place, root, "degree", 1, PIA_MAX_DEGREE, &degree);
    if (status == PIA_OK) status = pia_json_get_index(place, root, "dimension", 1, PIA_MAX_DIM, &dim);
    if (status == PIA_OK)
        status = pia_json_get_reals(place, json_object_get(root, "control_points"), "control_points", &points, &values);
    if (status == PIA_OK) status = pia_json_get_reals(place, json_object_get(root, "knots"), "knots", &knots, &knot_count);
    if (status == PIA_OK) status = make_curve(place, degree, dim, points, values, knots, knot_count, out);
    pia_give(place->context, points);
    pia_give(place->context, knots);
    return status;
}
