/* Models for CAD systems: g2 read and written, IGES and STEP written. tests/cad reads the last two back by OpenCASCADE. */
#include "../memory/failing.h"
#include "files.h"

#include "model.h"

static pia_model *patch(pia_context *context, int rational)
{
    static const double knots[2][9] = {{0, 0, 0, 0.3, 1, 1, 1}, {0, 0, 0, 0, 0.1, 1, 1, 1, 1}};
    const double *knot[2] = {knots[0], knots[1]};
    const int degree[2] = {2, 3};
    const pia_index control[2] = {4, 5};
    double points[60], weights[20];
    for (int i = 0; i < 20; i++) {
        points[3 * i] = i / 5 + 0.1 * sin(i);
        points[3 * i + 1] = i % 5 / 3.0;
        points[3 * i + 2] = 1e-7 * cos(2 * i);
        weights[i] = 1 + 0.5 * (i % 3);
    }
    pia_model *model;
    assert_ok(context, pia_model_create(context, 2, degree, knot, control, 3, points, rational ? weights : NULL, &model));
    return model;
}

static pia_model *arc(pia_context *context)
{
    const double knots[] = {0, 0, 0, 1, 1, 1}, points[] = {1, 0, 1, 1, 0, 1}, weights[] = {1, sqrt(0.5), 1};
    const double *knot[1] = {knots};
    const int degree[1] = {2};
    const pia_index control[1] = {3};
    pia_model *model;
    assert_ok(context, pia_model_create(context, 1, degree, knot, control, 2, points, weights, &model));
    return model;
}

static void g2_reads_back_what_it_wrote(void **state)
{
    pia_context *context = *state;
    pia_model *models[3] = {patch(context, 0), patch(context, 1), arc(context)}, **back;
    pia_index count;
    const char *path = path_of("models.g2");
    assert_ok(context, pia_model_write(context, path, NULL, (const pia_model *const *)models, 3, PIA_AUTO));
    assert_ok(context, pia_model_read(context, path, NULL, &back, &count));
    assert_int_equal(count, 3);
    for (int k = 0; k < 3; k++) {
        assert_int_equal(back[k]->rational, models[k]->rational);
        pia_index values = models[k]->control[0] * models[k]->control[1] * pia_model_width(models[k]);
        for (pia_index i = 0; i < values; i++) assert_near(back[k]->points[i], models[k]->points[i], k == 0 ? 0 : 4e-16);
        for (int d = 0; d < models[k]->directions; d++)
            assert_memory_equal(back[k]->knots[d], models[k]->knots[d],
                                (size_t)(models[k]->control[d] + models[k]->degree[d] + 1) * sizeof(double));
        pia_model_destroy(models[k]);
    }
    pia_models_destroy(back, count);
}

static void g2_that_is_damaged_is_refused_with_its_line(void **state)
{
    static const struct {
        const char *text, *says;
    } bad[] = {
        {"", "holds no curve"},
        {"300 1 0 0\n3 0\n", ":1: class 300"},
        {"100 1 0 0\n3 0\n2 4\n", ":3: 2 control points of order 4"},
        {"100 1 0 0\n3 0\n9000000000000000 4\n", "too short"},
        {"100 1 0 0\n2 0\n2 2\n0 0 1 1\n0 0\n1 x\n", ":6: a finite number"},
        {"100 1 0 0\n2 1\n2 2\n0 0 1 1\n0 0 0\n1 1 1\n", "weight"},
        {"100 1 0 0\n2 0\n2 2\n0 0 1", "too short"},
        {"100 1 0 0\n1 0\n2 2\n2 2 0 0\n0\n1\n", "bad.g2:6: knot"},
    };
    pia_model **models;
    pia_index count;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_status(*state, pia_model_read(*state, make_text("bad.g2", bad[i].text), NULL, &models, &count), PIA_E_FORMAT);
        if (strstr(pia_message(*state), bad[i].says) == NULL) fail_msg("\"%s\" does not say \"%s\"", pia_message(*state), bad[i].says);
    }
}

static void every_line_of_an_iges_file_has_80_columns_and_its_section(void **state)
{
    pia_context *context = *state;
    pia_model *models[2] = {patch(context, 1), arc(context)};
    const char *path = path_of("models.igs");
    assert_ok(context, pia_model_write(context, path, NULL, (const pia_model *const *)models, 2, PIA_AUTO));
    char *text = read_text(path), last = 'S';
    const char *order = "SGDPT";
    int lines = 0;
    for (char *line = text; *line != '\0'; line += 81, lines++) {
        assert_true(line[80] == '\n');
        assert_true(strchr(order, line[72]) >= strchr(order, last));
        last = line[72];
    }
    assert_true(last == 'T' && lines > 20);
    free(text);
    pia_model_destroy(models[0]);
    pia_model_destroy(models[1]);
}

/* Every reference of a STEP file leads to an instance of that file. */
static void assert_refers_to_itself(const char *text)
{
    long defined = 0, largest = 0;
    for (const char *at = text; (at = strchr(at, '#')) != NULL; at++) {
        char *end;
        long number = strtol(at + 1, &end, 10);
        if (*end == '=') assert_int_equal(number, ++defined);
        if (number > largest) largest = number;
    }
    assert_int_equal(largest, defined);
}

static pia_model *trimmed_patch(pia_context *context, int rational)
{
    const pia_index counts[] = {4, 3};
    const double uv[] = {0.1, 0, 0.9, 0, 0.9, 0.8, 0.1, 0.8, 0.3, 0.3, 0.3, 0.5, 0.5, 0.3};
    pia_model *whole = patch(context, rational), *trimmed = NULL;
    assert_ok(context, pia_model_trim(context, whole, 2, counts, uv, &trimmed));
    pia_model_destroy(whole);
    return trimmed;
}

static char *write_text(pia_context *context, const char *name, const pia_model *const *models, pia_index count,
                        const pia_write_options *options)
{
    const char *path = path_of(name);
    assert_ok(context, pia_model_write_as(context, path, models, count, options));
    return read_text(path);
}

static int occurrences(const char *text, const char *word)
{
    int count = 0;
    for (const char *at = text; (at = strstr(at, word)) != NULL; at++) count++;
    return count;
}

static void a_step_file_refers_to_nothing_it_does_not_define(void **state)
{
    pia_model *models[] = {patch(*state, 0), patch(*state, 1), arc(*state), trimmed_patch(*state, 0), trimmed_patch(*state, 1)};
    char *text = write_text(*state, "models.step", (const pia_model *const *)models, 5, NULL);
    assert_refers_to_itself(text);
    assert_int_equal(occurrences(text, "=ADVANCED_FACE"), 4);
    assert_int_equal(occurrences(text, "=SURFACE_CURVE"), 2 * 4 + 2 * (4 + 3));
    assert_int_equal(occurrences(text, "=GEOMETRIC_CURVE_SET"), 1);
    assert_int_equal(occurrences(text, "=FACE_OUTER_BOUND"), 4);
    assert_int_equal(occurrences(text, "=FACE_BOUND"), 2);
    for (int k = 1; k <= 5; k++) {
        char product[40];
        snprintf(product, sizeof product, "=PRODUCT('models %d'", k);
        assert_int_equal(occurrences(text, product), 1);
    }
    free(text);
    for (int k = 0; k < 5; k++) pia_model_destroy(models[k]);
}

/* A square tube, closed in u: its seam is one edge used twice. Shrunk at v = 1 to a pyramid, it has no edge there. */
static void closed_surfaces_have_a_seam_and_no_edge_where_they_shrink(void **state)
{
    static const double u[] = {0, 0, 0.25, 0.5, 0.75, 1, 1}, v[] = {0, 0, 1, 1}, x[] = {0, 1, 1, 0, 0}, y[] = {0, 0, 1, 1, 0};
    const double *const knots[] = {u, v};
    for (int pyramid = 0; pyramid < 2; pyramid++) {
        double points[5 * 2 * 3];
        for (int i = 0; i < 10; i++) {
            int top = i % 2, tip = top && pyramid;
            points[3 * i] = tip ? 0.5 : x[i / 2];
            points[3 * i + 1] = tip ? 0.5 : y[i / 2];
            points[3 * i + 2] = top;
        }
        pia_model *tube = NULL;
        assert_ok(*state, pia_model_create(*state, 2, (int[]){1, 1}, knots, (pia_index[]){5, 2}, 3, points, NULL, &tube));
        const pia_model *one = tube;
        char *text = write_text(*state, "tube.step", &one, 1, NULL);
        assert_refers_to_itself(text);
        assert_int_equal(occurrences(text, "=SEAM_CURVE"), 1);
        assert_int_equal(occurrences(text, "=EDGE_CURVE"), 3 - pyramid);
        assert_int_equal(occurrences(text, "=ORIENTED_EDGE"), 4 - pyramid);
        assert_int_equal(occurrences(text, "=VERTEX_POINT"), 2);
        free(text);
        pia_model_destroy(tube);
    }
}

static void units_schema_tolerance_and_name_are_written(void **state)
{
    pia_model *model = trimmed_patch(*state, 0);
    const pia_model *one = model;
    pia_write_options options;
    pia_write_options_init(&options);
    char *text = write_text(*state, "wing.step", &one, 1, &options);
    assert_non_null(strstr(text, "AUTOMOTIVE_DESIGN { 1 0 10303 214"));
    assert_non_null(strstr(text, "SI_UNIT(.MILLI.,.METRE.)"));
    assert_non_null(strstr(text, "LENGTH_MEASURE(1.E-07)"));
    assert_non_null(strstr(text, "PRODUCT('wing','wing'"));
    free(text);
    options.step_schema = PIA_STEP_AP242;
    options.unit = PIA_UNIT_INCH;
    options.tolerance = 0.001;
    options.name = "Joe's, \xc3\xa4";
    text = write_text(*state, "wing.step", &one, 1, &options);
    assert_non_null(strstr(text, "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF"));
    assert_non_null(strstr(text, "CONVERSION_BASED_UNIT('INCH'"));
    assert_non_null(strstr(text, "LENGTH_MEASURE(0.001)"));
    assert_non_null(strstr(text, "PRODUCT('Joe_s_ __'"));
    assert_refers_to_itself(text);
    free(text);
    text = write_text(*state, "wing.igs", &one, 1, &options);
    assert_non_null(strstr(text, "9HJoe_s_ __,1.,1,4HINCH,"));
    free(text);
    options.unit = PIA_UNIT_METRE;
    text = write_text(*state, "wing.igs", &one, 1, &options);
    assert_non_null(strstr(text, ",6,1HM,"));
    free(text);
    pia_model_destroy(model);
}

/* Trimmed surface 144; for each loop 142, two composites 102, two curves 126 a side; the surface 128. */
static void a_trimmed_surface_in_iges_has_all_its_entities(void **state)
{
    pia_model *model = trimmed_patch(*state, 1);
    const pia_model *one = model;
    char *text = write_text(*state, "models.igs", &one, 1, NULL);
    int found[200] = {0};
    for (char *line = text; *line != '\0'; line += 81)
        if (line[72] == 'D' && strtol(line + 73, NULL, 10) % 2 == 1) found[strtol(line, NULL, 10) % 200]++;
    assert_int_equal(found[144], 1);
    assert_int_equal(found[142], 2);
    assert_int_equal(found[102], 4);
    assert_int_equal(found[126], 2 * (4 + 3));
    assert_int_equal(found[128], 1);
    free(text);
    pia_model_destroy(model);
}

static void write_options_out_of_range_are_refused(void **state)
{
    pia_model *model = patch(*state, 0);
    const pia_model *one = model;
    pia_write_options bad[6];
    for (int k = 0; k < 6; k++) pia_write_options_init(&bad[k]);
    bad[0].unit = (pia_unit)3;
    bad[1].step_schema = (pia_step_schema)-1;
    bad[2].tolerance = 0;
    bad[3].tolerance = NAN;
    bad[4].format = "nothing";
    bad[5].struct_size = 0;
    for (int k = 0; k < 6; k++)
        assert_status(*state, pia_model_write_as(*state, path_of("bad.step"), &one, 1, &bad[k]), PIA_E_ARGUMENT);
    assert_int_equal(file_count(), 0);
    pia_model_destroy(model);
}

static pia_status write_trimmed(pia_context *context, void *user)
{
    const pia_model *one = user;
    static const char *const name[] = {"a.step", "a.igs"};
    pia_status status = PIA_OK;
    for (int k = 0; k < 2 && status == PIA_OK; k++) status = pia_model_write(context, path_of(name[k]), NULL, &one, 1, PIA_AUTO);
    return status;
}

static void writing_trimmed_faces_survives_every_failed_allocation(void **state)
{
    pia_model *model = trimmed_patch(*state, 1);
    assert_survives_failures(write_trimmed, model);
    pia_model_destroy(model);
}

static void models_outside_space_are_refused(void **state)
{
    const double knots[] = {0, 0, 1, 1}, points[] = {0, 1};
    const double *knot[1] = {knots};
    const int degree[1] = {1};
    const pia_index control[1] = {2};
    pia_model *line;
    assert_ok(*state, pia_model_create(*state, 1, degree, knot, control, 1, points, NULL, &line));
    static const char *const name[] = {"line.step", "line.igs"};
    for (int i = 0; i < 2; i++) {
        assert_status(*state, pia_model_write(*state, path_of(name[i]), NULL, (const pia_model *const *)&line, 1, PIA_AUTO),
                      PIA_E_ARGUMENT);
        assert_int_not_equal(access(path_of(name[i]), F_OK), 0);
    }
    pia_model_destroy(line);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(g2_reads_back_what_it_wrote),
        IN_FOLDER(g2_that_is_damaged_is_refused_with_its_line),
        IN_FOLDER(every_line_of_an_iges_file_has_80_columns_and_its_section),
        IN_FOLDER(closed_surfaces_have_a_seam_and_no_edge_where_they_shrink),
        IN_FOLDER(units_schema_tolerance_and_name_are_written),
        IN_FOLDER(a_trimmed_surface_in_iges_has_all_its_entities),
        IN_FOLDER(write_options_out_of_range_are_refused),
        IN_FOLDER(writing_trimmed_faces_survives_every_failed_allocation),
        IN_FOLDER(a_step_file_refers_to_nothing_it_does_not_define),
        IN_FOLDER(models_outside_space_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
