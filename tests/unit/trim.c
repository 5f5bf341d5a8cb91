#include "model.h"

#include <math.h>

#include "../memory/failing.h"
#include "files.h"
#include "shapes.h"

/* An L in the middle of the domain with a triangular and a square hole; the last vertex of the L repeats the first. */
static const double ell[] = {0.1, 0.1, 0.9, 0.1, 0.9, 0.5, 0.5, 0.5, 0.5, 0.9, 0.1, 0.9, 0.1, 0.1};
static const double triangle[] = {0.2, 0.2, 0.4, 0.2, 0.2, 0.4}, square[] = {0.6, 0.2, 0.6, 0.4, 0.8, 0.4, 0.8, 0.2};

static pia_status trim_by(pia_context *context, const pia_model *model, int loops, const double *const *loop, const pia_index *counts,
                          pia_model **out)
{
    double uv[200];
    pia_index next = 0;
    for (int l = 0; l < loops; l++)
        for (pia_index i = 0; i < 2 * counts[l]; i++) uv[next++] = loop[l][i];
    return pia_model_trim(context, model, loops, counts, uv, out);
}

static pia_model *trimmed_surface(pia_context *context)
{
    const double *const loops[] = {ell, triangle, square};
    const pia_index counts[] = {7, 3, 4};
    pia_model *model = shape_surface(context, 3, 2, 3, 1, 8), *trimmed = NULL;
    assert_ok(context, trim_by(context, model, 3, loops, counts, &trimmed));
    pia_model_destroy(model);
    return trimmed;
}

static double loop_area(const pia_model *model, pia_index loop)
{
    pia_index count;
    const double *uv = pia_model_trim_loop(model, loop, &count);
    double area = 0;
    for (pia_index i = 0; i < count; i++) {
        const double *a = uv + 2 * i, *b = uv + 2 * ((i + 1) % count);
        area += (a[0] * b[1] - a[1] * b[0]) / 2;
    }
    return area;
}

static void loops_are_kept_closed_and_turned_the_right_way(void **state)
{
    (void)state;
    pia_model *model = trimmed_surface(NULL);
    pia_index count;
    assert_int_equal(pia_model_trim_loop_count(model), 3);
    pia_model_trim_loop(model, 0, &count);
    assert_int_equal(count, 6);
    assert_near(loop_area(model, 0), 0.48, 1e-15);
    assert_near(loop_area(model, 1), -0.02, 1e-15);
    assert_near(loop_area(model, 2), -0.04, 1e-15);
    assert_null(pia_model_trim_loop(model, 3, &count));
    assert_int_equal(count, 0);
    assert_null(pia_model_trim_loop(model, -1, &count));
    pia_model_destroy(model);
}

/* The share of a fine lattice that lies inside is the area of the face in the parameter plane. */
static void the_face_is_inside_the_first_loop_and_outside_the_others(void **state)
{
    (void)state;
    pia_model *model = trimmed_surface(NULL);
    enum { SIDE = 400 };
    int inside = 0;
    for (int i = 0; i < SIDE; i++)
        for (int j = 0; j < SIDE; j++) inside += pia_model_trim_contains(model, (i + 0.5) / SIDE, (j + 0.5) / SIDE);
    assert_near((double)inside / SIDE / SIDE, 0.48 - 0.02 - 0.04, 1e-3);
    pia_model_destroy(model);
}

static void shape_preserving_operations_keep_the_loops_and_splitting_is_refused(void **state)
{
    (void)state;
    pia_model *model = trimmed_surface(NULL), *made[4] = {NULL}, *left = NULL, *right = NULL, *whole = NULL;
    assert_ok(NULL, pia_model_insert_knots(NULL, model, 1, (double[]){0.3, 0.7}, 2, &made[0]));
    assert_ok(NULL, pia_model_elevate(NULL, model, 0, 2, &made[1]));
    assert_ok(NULL, pia_model_bezier(NULL, model, &made[2]));
    assert_ok(NULL, pia_model_remove_knots(NULL, model, 1e-3, &made[3], NULL));
    for (int k = 0; k < 4; k++) {
        assert_int_equal(pia_model_trim_loop_count(made[k]), 3);
        for (pia_index l = 0; l < 3; l++) assert_near(loop_area(made[k], l), loop_area(model, l), 0);
        pia_model_destroy(made[k]);
    }
    assert_status(NULL, pia_model_split(NULL, model, 0, 0.5, &left, &right), PIA_E_ARGUMENT);
    assert_ok(NULL, pia_model_trim(NULL, model, 0, NULL, NULL, &whole));
    assert_int_equal(pia_model_trim_loop_count(whole), 0);
    assert_int_equal(pia_model_trim_contains(whole, 0.95, 0.95), 1);
    shape_assert_same(model, whole, 9, 0);
    pia_model_destroy(whole);
    pia_model_destroy(model);
}

static void vertices_off_the_border_by_rounding_are_put_on_it(void **state)
{
    (void)state;
    pia_model *model = shape_surface(NULL, 2, 2, 3, 0, 3), *trimmed = NULL;
    const double loop[] = {-1e-13, 0, 1, 1e-13, 1 + 1e-13, 1, 0, 1};
    const pia_index count = 4;
    assert_ok(NULL, pia_model_trim(NULL, model, 1, &count, loop, &trimmed));
    assert_near(loop_area(trimmed, 0), 1, 0);
    pia_model_destroy(trimmed);
    pia_model_destroy(model);
}

static void refused(int loops, const double *const *loop, const pia_index *counts, const char *what)
{
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    pia_model *model = shape_surface(context, 2, 2, 3, 0, 3), *out = NULL;
    assert_status(context, trim_by(context, model, loops, loop, counts, &out), PIA_E_DATA);
    assert_null(out);
    if (strstr(pia_message(context), what) == NULL) fail_msg("\"%s\" lacks \"%s\"", pia_message(context), what);
    pia_model_destroy(model);
    pia_context_destroy(context);
}

static void impossible_loops_are_refused_by_name(void **state)
{
    (void)state;
    const double outside[] = {0, 0, 1.1, 0, 1, 1}, flat[] = {0, 0, 1, 1, 0, 0, 0, 0}, bow[] = {0, 0, 1, 1, 1, 0, 0, 1},
                 spike[] = {0.1, 0.1, 0.9, 0.1, 0.5, 0.1, 0.5, 0.8},
                 pinch[] = {0.1, 0.1, 0.5, 0.5, 0.9, 0.1, 0.9, 0.9, 0.5, 0.5, 0.1, 0.9}, far[] = {0.6, 0.6, 0.8, 0.6, 0.8, 0.8},
                 inner[] = {0.22, 0.22, 0.28, 0.22, 0.22, 0.28}, crossing[] = {0.2, 0.2, 0.95, 0.3, 0.2, 0.3},
                 not_finite[] = {0, 0, NAN, 0, 1, 1}, collinear[] = {0, 0, 0.5, 0.5, 1, 1};
    const pia_index counts[] = {7, 3, 3}, three = 3, four = 4, six = 6;
    refused(1, (const double *[]){outside}, &three, "trim loop 0, vertex 1: u = 1.1");
    refused(1, (const double *[]){flat}, &four, "2 different vertices");
    refused(1, (const double *[]){bow}, &four, "meets");
    refused(1, (const double *[]){spike}, &four, "meets");
    refused(1, (const double *[]){pinch}, &six, "meets");
    refused(1, (const double *[]){collinear}, &three, "meets");
    refused(1, (const double *[]){not_finite}, &three, "trim vertex");
    refused(2, (const double *[]){ell, far}, counts, "loop 1 is not a hole");
    refused(3, (const double *[]){ell, triangle, inner}, counts, "loop 2 is not a hole");
    refused(2, (const double *[]){ell, crossing}, counts, "meets");
    refused(2, (const double *[]){triangle, square}, (const pia_index[]){3, 4}, "loop 1 is not a hole");
}

static void curves_and_missing_arrays_are_refused(void **state)
{
    (void)state;
    pia_model *curve = shape_curve(NULL, 3, 9, 2, 0, 4), *surface = shape_surface(NULL, 2, 2, 3, 0, 3), *out = NULL;
    const pia_index three = 3, two = 2;
    assert_status(NULL, pia_model_trim(NULL, curve, 1, &three, triangle, &out), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_trim(NULL, NULL, 1, &three, triangle, &out), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_trim(NULL, surface, 1, NULL, triangle, &out), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_trim(NULL, surface, 1, &three, NULL, &out), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_trim(NULL, surface, 1, &three, triangle, NULL), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_trim(NULL, surface, 1, &two, triangle, &out), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_trim(NULL, surface, -1, &three, triangle, &out), PIA_E_ARGUMENT);
    assert_null(out);
    assert_int_equal(pia_model_trim_loop_count(curve), 0);
    pia_model_destroy(curve);
    pia_model_destroy(surface);
}

/* Many holes in a star of many points: the sweep against the definition, every pair of edges. */
static void a_perforated_star_is_taken(void **state)
{
    (void)state;
    enum { TIPS = 2000, HOLES = 20 * 20 };
    pia_index counts[1 + HOLES] = {2 * TIPS};
    double *uv = malloc((2 * TIPS + 3 * HOLES) * 2 * sizeof *uv), *to = uv;
    for (int i = 0; i < 2 * TIPS; i++) {
        double r = i % 2 ? 0.49 : 0.48, angle = 3.14159265358979 * i / TIPS;
        *to++ = 0.5 + r * cos(angle);
        *to++ = 0.5 + r * sin(angle);
    }
    for (int h = 0; h < HOLES; h++) {
        double x = 0.25 + 0.02 * (h % 20), y = 0.25 + 0.02 * (h / 20.0 - h % 20 / 20.0);
        const double corner[] = {x, y, x + 0.01, y, x, y + 0.01};
        memcpy(to, corner, sizeof corner);
        to += 6;
        counts[1 + h] = 3;
    }
    pia_model *model = shape_surface(NULL, 2, 2, 3, 0, 3), *trimmed = NULL;
    assert_ok(NULL, pia_model_trim(NULL, model, 1 + HOLES, counts, uv, &trimmed));
    assert_int_equal(pia_model_trim_loop_count(trimmed), 1 + HOLES);
    free(uv);
    pia_model_destroy(trimmed);
    pia_model_destroy(model);
}

static pia_status trim_and_copy(pia_context *context, void *user)
{
    const double *const loops[] = {ell, triangle};
    const pia_index counts[] = {7, 3};
    pia_model *trimmed = NULL, *finer = NULL;
    pia_status status = trim_by(context, user, 2, loops, counts, &trimmed);
    if (status == PIA_OK) status = pia_model_elevate(context, trimmed, 0, 1, &finer);
    pia_model_destroy(trimmed);
    pia_model_destroy(finer);
    return status;
}

static void trimming_survives_every_failed_allocation(void **state)
{
    (void)state;
    pia_model *model = shape_surface(NULL, 3, 2, 3, 0, 8);
    assert_survives_failures(trim_and_copy, model);
    pia_model_destroy(model);
}

static pia_model *read_one(pia_context *context, const char *path)
{
    pia_model **models = NULL, *one = NULL;
    pia_index count = 0;
    assert_ok(context, pia_model_read(context, path, NULL, &models, &count));
    assert_int_equal(count, 1);
    assert_ok(context,
              pia_model_trim_loop_count(models[0]) > 0 ? pia_model_insert_knots(context, models[0], 0, NULL, 0, &one) : PIA_E_DATA);
    pia_models_destroy(models, count);
    return one;
}

static void json_gives_the_same_loops_back(void **state)
{
    pia_model *model = trimmed_surface(*state);
    const pia_model *one = model;
    assert_ok(*state, pia_model_write(*state, path_of("t.json"), NULL, &one, 1, PIA_AUTO));
    pia_model *back = read_one(*state, path_of("t.json"));
    assert_int_equal(pia_model_trim_loop_count(back), 3);
    for (pia_index l = 0; l < 3; l++) {
        pia_index a, b;
        const double *p = pia_model_trim_loop(model, l, &a), *q = pia_model_trim_loop(back, l, &b);
        assert_int_equal(a, b);
        assert_memory_equal(p, q, (size_t)a * 2 * sizeof *p);
    }
    pia_model_destroy(back);
    pia_model_destroy(model);
}

#define PLANE(TRIMS)                                                                                                                   \
    "{\"shape\": {\"type\": \"surface\", \"data\": [{\"degree_u\": 1, \"degree_v\": 1, \"knotvector_u\": [0,0,1,1], "                  \
    "\"knotvector_v\": [0,0,1,1], \"size_u\": 2, \"size_v\": 2, \"control_points\": {\"points\": [[0,0],[0,1],[1,0],[1,1]]}, "         \
    "\"trims\": {\"data\": [" TRIMS "]}}]}}"
#define FREE(SENSE, POINTS) "{\"type\": \"freeform\", " SENSE "\"points\": [" POINTS "]}"

/* geomdl keeps what is inside a loop of sense 1 and cuts away what is inside a loop of sense 0. */
static void trims_of_other_programs_are_read(void **state)
{
    const char *half = "[0.2,0.2],[0.8,0.2],[0.2,0.8]";
    char text[2000];
    snprintf(text, sizeof text, PLANE(FREE("\"reversed\": 0, ", "[0.3,0.3],[0.4,0.3],[0.3,0.4]") "," FREE("\"reversed\": 1, ", "%s")),
             half);
    pia_model *model = read_one(*state, make_text("a.json", text));
    assert_near(loop_area(model, 0), 0.18, 1e-15);
    assert_near(loop_area(model, 1), -0.005, 1e-15);
    pia_model_destroy(model);
    snprintf(text, sizeof text, PLANE(FREE("\"reversed\": 0, ", "%s")), half);
    model = read_one(*state, make_text("b.json", text));
    assert_near(loop_area(model, 0), 1, 0);
    assert_near(loop_area(model, 1), -0.18, 1e-15);
    pia_model_destroy(model);
    snprintf(text, sizeof text, PLANE(FREE("", "%s")), half);
    model = read_one(*state, make_text("c.json", text));
    assert_int_equal(pia_model_trim_loop_count(model), 1);
    assert_near(loop_area(model, 0), 0.18, 1e-15);
    pia_model_destroy(model);
    /* A half disc: a parabola-like arc of degree 2 and a straight line, one after the other. */
    model = read_one(*state, make_text("d.json", PLANE("{\"type\": \"container\", \"reversed\": 1, \"data\": [{\"type\": \"spline\", "
                                                       "\"degree\": 2, \"knotvector\": [0,0,0,1,1,1], \"control_points\": {\"points\": "
                                                       "[[0.8,0.2],[0.5,0.8],[0.2,0.2]]}}, {\"type\": \"spline\", \"degree\": 1, "
                                                       "\"knotvector\": [0,0,1,1], \"control_points\": {\"points\": "
                                                       "[[0.2,0.2],[0.8,0.2]]}}]}")));
    assert_near(loop_area(model, 0), 0.12, 1e-4); /* two thirds of chord times height: 2/3 * 0.6 * 0.3 */
    pia_model_destroy(model);
}

static void broken_trims_are_refused_with_their_place(void **state)
{
    static const struct {
        const char *text, *message;
    } bad[] = {
        {PLANE(FREE("", "[0,0],[1,1]")), "shape.data[0]: trim loop 0 has 2 vertices"},
        {PLANE(FREE("", "[0,0],[1,1],[1,0],[0,1]")), "shape.data[0]: trim loop 0, edge"},
        {PLANE(FREE("", "[0,0,0],[1,1,0],[1,0,0]")), "points of dimension 2"},
        {PLANE("{\"type\": \"freeform\"}"), "points must be an array"},
        {PLANE("{\"type\": \"container\", \"data\": []}"), "loops without vertices"},
        {PLANE("7"), "data must be an object"},
        {PLANE("{\"degree\": 1, \"knotvector\": [0,0,1,1], \"control_points\": {\"points\": [[0],[1]]}}"), "curves of dimension 2"},
        {"{\"shape\": {\"type\": \"surface\", \"data\": [{\"degree_u\": 1, \"degree_v\": 1, \"knotvector_u\": [0,0,1,1], "
         "\"knotvector_v\": [0,0,1,1], \"size_u\": 2, \"size_v\": 2, \"control_points\": {\"points\": [[0],[1],[2],[3]]}, "
         "\"trims\": [1]}]}}",
         "trims must have an array"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        pia_model **models = NULL;
        pia_index count = 0;
        assert_status(*state, pia_model_read(*state, make_text("bad.json", bad[i].text), NULL, &models, &count), PIA_E_FORMAT);
        assert_null(models);
        if (strstr(pia_message(*state), bad[i].message) == NULL) fail_msg("\"%s\" lacks \"%s\"", pia_message(*state), bad[i].message);
    }
}

static pia_status read_trimmed(pia_context *context, void *user)
{
    pia_model **models = NULL;
    pia_index count = 0;
    pia_status status = pia_model_read(context, user, NULL, &models, &count);
    pia_models_destroy(models, count);
    return status;
}

static void reading_trims_survives_every_failed_allocation(void **state)
{
    char path[128];
    pia_model *model = trimmed_surface(*state);
    const pia_model *one = model;
    snprintf(path, sizeof path, "%s", path_of("t.json"));
    assert_ok(*state, pia_model_write(*state, path, NULL, &one, 1, PIA_AUTO));
    pia_model_destroy(model);
    assert_survives_failures(read_trimmed, path);
}

static void a_mesh_ends_at_the_loops(void **state)
{
    pia_model *model = trimmed_surface(*state);
    const pia_model *one = model;
    assert_ok(*state, pia_model_write(*state, path_of("t.obj"), NULL, &one, 1, 101));
    FILE *file = fopen(path_of("t.obj"), "r");
    assert_non_null(file);
    char line[256];
    int faces = 0;
    while (fgets(line, sizeof line, file)) faces += line[0] == 'f';
    fclose(file);
    assert_near(faces * 1e-4, 0.42, 0.03); /* cells on the border are left out */
    pia_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loops_are_kept_closed_and_turned_the_right_way),
        cmocka_unit_test(the_face_is_inside_the_first_loop_and_outside_the_others),
        cmocka_unit_test(shape_preserving_operations_keep_the_loops_and_splitting_is_refused),
        cmocka_unit_test(vertices_off_the_border_by_rounding_are_put_on_it),
        cmocka_unit_test(impossible_loops_are_refused_by_name),
        cmocka_unit_test(curves_and_missing_arrays_are_refused),
        cmocka_unit_test(a_perforated_star_is_taken),
        cmocka_unit_test(trimming_survives_every_failed_allocation),
        IN_FOLDER(json_gives_the_same_loops_back),
        IN_FOLDER(trims_of_other_programs_are_read),
        IN_FOLDER(broken_trims_are_refused_with_their_place),
        IN_FOLDER(reading_trims_survives_every_failed_allocation),
        IN_FOLDER(a_mesh_ends_at_the_loops),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
