/* Every reader and writer with every allocation failing in turn. */
#include "failing.h"
#include "files.h"

#include "checkpoint.h"

static const char labels[] = "name,x,y\na,1,2\nb,3,4\n\nc,5,6\nd,7,x\n";
static const double knots[] = {0, 0, 1, 1}, line[] = {0, 0, 1, 2};

typedef struct read_case {
    const char *name;
    pia_points_options options;
} read_case;

static pia_status read_file(pia_context *context, void *user)
{
    const read_case *which = user;
    pia_points *points = NULL;
    pia_status status = pia_points_read(context, path_of(which->name), &which->options, &points);
    pia_points_destroy(points);
    return status;
}

static void readers_of_points_survive_every_failure(void **state)
{
    (void)state;
    static const size_t size = sizeof(pia_points_options);
    char many[4000] = "";
    for (int i = 0; i < 150; i++) strcat(many, "1,2,3\n\n");
    make_text("labels.csv", labels);
    make_text("many.csv", many);
    make_text("matrix.csv", "1,2\n3,4\n");
    make_text("grey.pgm", "P2 2 2 9\n1 2 3 4\n");
    make_text("grid.asc", "ncols 2\nnrows 2\ncellsize 1\n1 2 3 4\n");
    make_text("mesh.obj", "v 1 2 3\nv 4 5 6\nv 4 5 nan\n");
    make_text("cloud.ply", "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int i\nelement vertex 3\nproperty float x\n"
                           "property float y\nproperty float z\nend_header\n2 0 1\n1 2 3\n4 5 nan\n7 8 9\n");
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_ok(context, pia_table_write(context, path_of("array.npy"), NULL, NULL, line, 2, 2));
    pia_context_destroy(context);
    read_case cases[] = {
        {"labels.csv", {.struct_size = size, .skip_invalid = 1}},
        {"labels.csv", {.struct_size = size, .skip_invalid = 1, .columns = "y,x"}},
        {"many.csv", {.struct_size = size}},
        {"matrix.csv", {.struct_size = size, .grid = 1}},
        {"grey.pgm", {.struct_size = size}},
        {"grid.asc", {.struct_size = size}},
        {"mesh.obj", {.struct_size = size, .skip_invalid = 1}},
        {"cloud.ply", {.struct_size = size, .skip_invalid = 1}},
        {"array.npy", {.struct_size = size}},
        {"array.npy", {.struct_size = size, .grid = 1}},
        {"array.npy", {.struct_size = size, .columns = "2"}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) assert_survives_failures(read_file, &cases[i]);
}

static pia_status write_and_read_model(pia_context *context, void *user)
{
    const char *name = user;
    const double *both[] = {knots, knots};
    pia_model *model = NULL, **back = NULL;
    pia_index count = 0;
    pia_status status = pia_model_create(context, 1, (int[]){1}, both, (pia_index[]){2}, 2, line, NULL, &model);
    if (status != PIA_OK) return status;
    const pia_model *models[] = {model, model};
    int several = strcmp(name, "model.npy") != 0;
    status = pia_model_write(context, path_of(name), NULL, models, 1 + several, 100);
    if (status == PIA_OK && strcmp(name, "model.json") == 0) status = pia_model_read(context, path_of(name), NULL, &back, &count);
    pia_models_destroy(back, count);
    pia_model_destroy(model);
    return status;
}

static void writers_of_models_survive_every_failure(void **state)
{
    (void)state;
    static char name[][12] = {"model.json", "model.csv", "model.npy", "model.obj"};
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        assert_survives_failures(write_and_read_model, name[i]);
        assert_int_equal(file_count(), (int)i + 1);
    }
}

static pia_status read_fitted_model(pia_context *context, void *user)
{
    pia_model **models = NULL;
    pia_index count = 0;
    pia_status status = pia_model_read(context, user, NULL, &models, &count);
    pia_models_destroy(models, count);
    return status;
}

static void the_memory_of_a_fit_is_read_whole_or_not_at_all(void **state)
{
    (void)state;
    static char path[128];
    snprintf(path, sizeof path, "%s",
             make_text("fitted.json",
                       "{\"shape\": {\"type\": \"curve\", \"data\": [{\"degree\": 1, \"knotvector\": [0, 0, 1, 1], \"rational\": true, "
                       "\"control_points\": {\"points\": [[0], [1]], \"weights\": [1, 2]}}]}, \"pia\": {\"parameters\": [0, 1], "
                       "\"dropped_rows\": [3], \"fit\": {\"warnings\": [\"a\", \"b\"]}}}"));
    assert_survives_failures(read_fitted_model, path);
}

static pia_status write_and_read_checkpoint(pia_context *context, void *user)
{
    (void)user;
    pia_output *output = NULL;
    pia_checkpoint_writer writer;
    pia_status status = pia_output_open(context, path_of("state"), &output);
    if (status != PIA_OK) return status;
    pia_checkpoint_begin(&writer, output);
    pia_checkpoint_put(&writer, "line", PIA_SECTION_DOUBLE, line, 4);
    pia_checkpoint_end(&writer);
    status = pia_output_commit(output);
    pia_checkpoint *checkpoint = NULL;
    if (status == PIA_OK) status = pia_checkpoint_open(context, path_of("state"), &checkpoint);
    if (status != PIA_OK) return status;
    void *data = NULL;
    pia_index count;
    status = pia_checkpoint_get(checkpoint, "line", PIA_SECTION_DOUBLE, &data, &count);
    pia_give(context, data);
    pia_checkpoint_close(checkpoint);
    return status;
}

static void checkpoints_survive_every_failure(void **state)
{
    (void)state;
    assert_survives_failures(write_and_read_checkpoint, NULL);
}

/* Standard output is buffered whole, so its buffer has to grow. */
static pia_status write_much(pia_context *context, void *user)
{
    (void)user;
    pia_output *output = NULL;
    pia_status status = pia_output_open(context, "-", &output);
    if (status != PIA_OK) return status;
    for (int i = 0; i < 30000; i++) pia_output_text(output, "%d\n", i);
    pia_output_text(output, "end\n");
    int saved = dup(STDOUT_FILENO);
    assert_non_null(freopen("/dev/null", "w", stdout));
    status = pia_output_commit(output);
    fflush(stdout);
    dup2(saved, STDOUT_FILENO);
    close(saved);
    return status;
}

static void buffered_standard_output_survives_every_failure(void **state)
{
    (void)state;
    fflush(stdout);
    assert_survives_failures(write_much, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(readers_of_points_survive_every_failure),         IN_FOLDER(writers_of_models_survive_every_failure),
        IN_FOLDER(the_memory_of_a_fit_is_read_whole_or_not_at_all), IN_FOLDER(checkpoints_survive_every_failure),
        IN_FOLDER(buffered_standard_output_survives_every_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
