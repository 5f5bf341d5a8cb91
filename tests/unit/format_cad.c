/* Models for CAD systems: g2 read and written, IGES and STEP written. tests/cad reads the last two back by OpenCASCADE. */
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
static void a_step_file_refers_to_nothing_it_does_not_define(void **state)
{
    pia_context *context = *state;
    pia_model *models[2] = {patch(context, 0), patch(context, 1)}, *curve = arc(context);
    const char *path = path_of("models.step");
    for (int which = 0; which < 2; which++) {
        const pia_model *const *list = which == 0 ? (const pia_model *const *)models : (const pia_model *const *)&curve;
        assert_ok(context, pia_model_write(context, path, NULL, list, which == 0 ? 2 : 1, PIA_AUTO));
        char *text = read_text(path);
        assert_non_null(strstr(text, which == 0 ? "ADVANCED_FACE" : "RATIONAL_B_SPLINE_CURVE"));
        long defined = 0, largest = 0;
        for (char *at = text; (at = strchr(at, '#')) != NULL; at++) {
            char *end;
            long number = strtol(at + 1, &end, 10);
            if (*end == '=') assert_int_equal(number, ++defined);
            if (number > largest) largest = number;
        }
        assert_int_equal(largest, defined);
        free(text);
    }
    pia_model_destroy(models[0]);
    pia_model_destroy(models[1]);
    pia_model_destroy(curve);
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
        IN_FOLDER(a_step_file_refers_to_nothing_it_does_not_define),
        IN_FOLDER(models_outside_space_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
