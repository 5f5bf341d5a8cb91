/* How readers of other software failed: a damaged file wrote over foreign memory. Here every file that can be written is cut and
 * changed, byte for byte; reading it succeeds or fails in words, and never leaves a pointer behind. */
#include "files.h"

enum { MOST = 6000 };

static void read_either(pia_context *context, const char *path, int as_points)
{
    pia_points *points = NULL;
    pia_model **models = NULL;
    pia_index count = 0;
    pia_status status =
        as_points ? pia_points_read(context, path, NULL, &points) : pia_model_read(context, path, NULL, &models, &count);
    if (status == PIA_OK) {
        assert_true(as_points ? points != NULL : models != NULL && count > 0);
    } else {
        assert_null(points);
        assert_null(models);
        assert_true(pia_message(context)[0] != '\0');
        assert_null(strchr(pia_message(context), '\n'));
    }
    pia_points_destroy(points);
    pia_models_destroy(models, count);
}

static void damage(pia_context *context, const char *name, int as_points)
{
    static char whole[MOST];
    FILE *file = fopen(path_of(name), "rb");
    assert_non_null(file);
    size_t size = fread(whole, 1, MOST, file);
    fclose(file);
    assert_true(size > 0 && size < MOST);
    char other[80];
    snprintf(other, sizeof other, "damaged_%s", name);
    static const char bytes[] = {0, '9', '-', ' ', '\n', 'e', '(', '\x7f', '\xff'};
    for (size_t cut = 0; cut < size; cut += 1 + size / 400) read_either(context, make_file(other, whole, cut), as_points);
    for (size_t at = 0; at < size; at += 1 + size / 400) {
        char kept = whole[at];
        whole[at] = bytes[at % sizeof bytes];
        read_either(context, make_file(other, whole, size), as_points);
        whole[at] = kept;
    }
}

static void t_peer_17_damaged_files_of_models_end_in_words(void **state)
{
    static const double knots[] = {0, 0, 0, 0.5, 1, 1, 1};
    static const char *const name[] = {"model.json", "model.g2"};
    double points[16 * 3], weights[16];
    for (int i = 0; i < 48; i++) points[i] = sin(i);
    for (int i = 0; i < 16; i++) weights[i] = 1 + i % 3;
    const double *both[] = {knots, knots};
    pia_model *model = NULL;
    assert_ok(*state, pia_model_create(*state, 2, (int[]){2, 2}, both, (pia_index[]){4, 4}, 3, points, weights, &model));
    for (size_t k = 0; k < sizeof name / sizeof *name; k++) {
        assert_ok(*state, pia_model_write(*state, path_of(name[k]), NULL, (const pia_model *const[]){model}, 1, PIA_AUTO));
        damage(*state, name[k], 0);
    }
    pia_model_destroy(model);
}

static void t_peer_17_damaged_files_of_points_end_in_words(void **state)
{
    double table[40];
    for (int i = 0; i < 40; i++) table[i] = sin(i);
    assert_ok(*state, pia_table_write(*state, path_of("table.csv"), NULL, "x,y", table, 20, 2));
    assert_ok(*state, pia_table_write(*state, path_of("table.npy"), NULL, NULL, table, 20, 2));
    make_text("grey.pgm", "P2\n# made by hand\n3 2\n255\n1 2 3\n4 5 255\n");
    make_text("grid.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 1\ncellsize 2\nNODATA_value -9\n1 2 3\n4 -9 6\n");
    make_text("mesh.obj", "# made by hand\nv 1 2 3\nv 4 5 6\nf 1 2\n");
    make_text("cloud.ply",
              "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
              "property list uchar int i\nend_header\n1 2 3\n4 5 6\n2 0 1\n");
    static const char *const name[] = {"table.csv", "table.npy", "grey.pgm", "grid.asc", "mesh.obj", "cloud.ply"};
    for (size_t k = 0; k < sizeof name / sizeof *name; k++) damage(*state, name[k], 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(t_peer_17_damaged_files_of_models_end_in_words),
        IN_FOLDER(t_peer_17_damaged_files_of_points_end_in_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
