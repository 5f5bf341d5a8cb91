/* PGM, ESRI ASCII grids and OBJ. */
#include "files.h"

static void assert_grid(pia_context *context, const char *name, pia_index rows, pia_index columns, const double *expected)
{
    pia_points_info info;
    pia_points_options options;
    pia_points_options_init(&options);
    options.allow_nan = 1;
    pia_points *points = read_points(context, name, &options, &info);
    assert_int_equal(info.kind, PIA_GRID);
    assert_int_equal(info.count[0], rows);
    assert_int_equal(info.count[1], columns);
    assert_int_equal(info.dim, 3);
    for (pia_index i = 0; i < 3 * rows * columns; i++) {
        if (isnan(expected[i]))
            assert_true(isnan(info.points[i]));
        else
            assert_near(info.points[i], expected[i], 0);
    }
    pia_points_destroy(points);
}

static void every_kind_of_grey_map_is_read(void **state)
{
    static const double expected[] = {0, 0, 1, 1, 0, 20, 0, 1, 3, 1, 1, 255}, wide[] = {0, 0, 256, 1, 0, 1000};
    make_text("a.pgm", "P2\n# made by hand\n2 2 # size\n255\n1 20\n3 255");
    assert_grid(*state, "a.pgm", 2, 2, expected);
    make_file("b.pgm", "P5 2 2 255\n\x01\x14\x03\xff", 15);
    assert_grid(*state, "b.pgm", 2, 2, expected);
    make_file("c.pgm", "P5\n#\n2 1\n65535\n\x01\x00\x03\xe8", 19);
    assert_grid(*state, "c.pgm", 1, 2, wide);
}

/* Editors begin text with it, whatever the format. */
static void a_byte_order_mark_is_passed_over(void **state)
{
    static const double expected[] = {0, 0, 1, 1, 0, 20};
    static const struct {
        const char *name, *text;
    } file[] = {{"m.pgm", "\xef\xbb\xbf"
                          "P2 2 1 255 1 20"},
                {"m.asc", "\xef\xbb\xbf"
                          "ncols 2\nnrows 1\nxllcenter 0\nyllcenter 0\ncellsize 1\n1 20\n"}};
    for (int k = 0; k < 2; k++) {
        make_text(file[k].name, file[k].text);
        assert_grid(*state, file[k].name, 1, 2, expected);
    }
    make_text("bad.asc", "\xef\xbb\xbf"
                         "ncols 2\nnrows 1\ncellsize x\n");
    assert_refused(*state, "bad.asc", NULL, PIA_E_FORMAT, "bad.asc:3: ");
    make_text("m.obj", "\xef\xbb\xbf"
                       "v 1 2 3\n");
    pia_points_info info;
    pia_points *points = read_points(*state, "m.obj", NULL, &info);
    assert_int_equal(info.count[0], 1);
    pia_points_destroy(points);
}

static void bad_grey_maps_are_refused(void **state)
{
    static const struct {
        const char *text, *message;
    } bad[] = {
        {"", "is not a grey map"},
        {"P6 1 1 255\n123", "is not a grey map"},
        {"P2 2", "must hold width, height"},
        {"P5 0 2 255\n", "must hold width, height"},
        {"P5 2 2 70000\n", "must hold width, height"},
        {"P5 2 2 255\nabc", "claims 2 x 2 values"},
        {"P5 4000000000 4000000000 255\nabc", "more than the file holds"},
        {"P5 99999999999999999999 1 255\nabc", "must hold width"},
        {"P2 2 2 9\n1 2 3 ", "value 3 of 4 is missing"},
        {"P2 2 2 9\n1 2\nx 4 5", "bad.pgm:3: value 2 of 4 is missing or not a number"},
        {"P2 2 1 9\n1 10", "value 1 is 10, above the largest value 9"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        make_text("bad.pgm", bad[i].text);
        assert_refused(*state, "bad.pgm", NULL, PIA_E_FORMAT, bad[i].message);
    }
}

static void ascii_grids_lie_where_their_header_says(void **state)
{
    static const double corner[] = {15, 35, 1, 25, 35, 2, 15, 25, 3, 25, 25, NAN},
                        centre[] = {10, 25, 1, 20, 25, 2, 10, 20, 3, 20, 20, -9};
    make_text("corner.asc", "ncols 2\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 10\nNODATA_value -9\n1 2\n3 -9\n");
    assert_grid(*state, "corner.asc", 2, 2, corner);
    make_text("centre.asc", "NCOLS 2\r\nNROWS 2\r\nXLLCENTER 10\r\nYLLCENTER 20\r\nDX 10\r\nDY 5\r\n1 2\r\n3 -9");
    assert_grid(*state, "centre.asc", 2, 2, centre);
    make_text("nan.asc", "ncols 2\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 10\n1 2 3\nnan");
    assert_grid(*state, "nan.asc", 2, 2, corner);
    assert_refused(*state, "corner.asc", NULL, PIA_E_FORMAT, "row 1, column 1 of the grid is nan");
}

static void bad_ascii_grids_are_refused(void **state)
{
    static const struct {
        const char *text, *message;
    } bad[] = {
        {"", "has no ncols and nrows"},
        {"1 2 3", "has no ncols and nrows"},
        {"ncols x\n", "bad.asc:1: 'ncols' must be followed by a number"},
        {"ncols 2\nrows 2\n", "bad.asc:2: 'rows' is no key"},
        {"ncols 2\nnrows 2\n1 2 3 4", "cell size must be positive"},
        {"ncols 2\nnrows 2\ncellsize nan\n1 2 3 4", "cell size must be positive"},
        {"ncols 2.5\nnrows 2\ncellsize 1\n1 2 3 4", "has no ncols and nrows"},
        {"ncols 1e30\nnrows 1e30\ncellsize 1\n1 2 3 4", "more than the file holds"},
        {"ncols nan\nnrows 2\ncellsize 1\n1 2 3 4", "has no ncols"},
        {"ncols 2\nnrows 2\ncellsize 1\n1.5 2.5 3.5", "ends after 3 of 4 values"},
        {"ncols 2\nnrows 2\ncellsize 1\n1 2\n3 x4", "bad.asc:5: value 3 of 4 is not a number"},
        {"ncols 2\nnrows 2\ncellsize 1\n1 2\n3 inf", "row 1, column 1 of the grid is infinite"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        make_text("bad.asc", bad[i].text);
        assert_refused(*state, "bad.asc", NULL, PIA_E_FORMAT, bad[i].message);
    }
}

static void terrain_files_are_read_as_their_page_says(void **state)
{
    pia_points *points = NULL;
    pia_points_info info;
    assert_ok(*state, pia_points_read(*state, PIA_DATA "/dem/srtm_colorado_144x144.asc", NULL, &points));
    pia_points_get_info(points, &info);
    assert_int_equal(info.count[0] * info.count[1], 144 * 144);
    assert_near(info.points[2], 2588, 0);
    assert_near(info.points[0], -105.560416666684 + 0.000833333333 / 2, 1e-12);
    assert_near(info.points[1], 40.090416666671 + 143.5 * 0.000833333333, 1e-12);
    pia_points_destroy(points);
    assert_ok(*state, pia_points_read(*state, PIA_DATA "/dem/jacksboro_344x403.pgm", NULL, &points));
    pia_points_get_info(points, &info);
    assert_int_equal(info.count[0], 344);
    assert_int_equal(info.count[1], 403);
    pia_points_destroy(points);
}

static void vertices_of_a_mesh_are_points(void **state)
{
    static const double expected[] = {1, 2, 3, -4e1, 5, 6};
    pia_points_info info;
    make_text("mesh.obj", "# mesh\no part\nv 1 2 3 1.0\nvn 0 0 1\nvt 0 0\n\nv\t-4e1 5 6 # end\r\nf 1 2 1\n");
    pia_points *points = read_points(*state, "mesh.obj", NULL, &info);
    assert_int_equal(info.count[0], 2);
    assert_int_equal(info.dim, 3);
    assert_int_equal(info.part_count, 1);
    for (int i = 0; i < 6; i++) assert_near(info.points[i], expected[i], 0);
    pia_points_destroy(points);
    make_text("bad.obj", "v 1 2 3\nv 1 2\n");
    assert_refused(*state, "bad.obj", NULL, PIA_E_FORMAT, "bad.obj:2: a vertex needs three numbers");
    make_text("bad.obj", "vn 1 2 3\n");
    assert_refused(*state, "bad.obj", NULL, PIA_E_FORMAT, "holds no vertex");
    make_text("bad.obj", "v 1 2 nan\n");
    assert_refused(*state, "bad.obj", NULL, PIA_E_FORMAT, "component 2 of row 0 is nan");
}

static void curves_are_polylines_and_surfaces_meshes(void **state)
{
    static const double knots[] = {0, 0, 1, 1}, line[] = {0, 0, 1, 2}, corners[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 1};
    const double *both[] = {knots, knots};
    pia_model *curve = NULL, *patch = NULL;
    assert_ok(*state, pia_model_create(*state, 1, (int[]){1}, both, (pia_index[]){2}, 2, line, NULL, &curve));
    assert_ok(*state, pia_model_create(*state, 2, (int[]){1, 1}, both, (pia_index[]){2, 2}, 3, corners, NULL, &patch));
    const pia_model *models[] = {curve, patch};
    assert_ok(*state, pia_model_write(*state, path_of("both.obj"), NULL, models, 2, 2));
    char *text = read_text(path_of("both.obj"));
    assert_string_equal(text, "o model_0\nv 0 0 0\nv 1 2 0\nl 1 2\no model_1\nv 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 1\nf 3 5 6 4\n");
    free(text);
    pia_model_destroy(curve);
    pia_model_destroy(patch);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(every_kind_of_grey_map_is_read), IN_FOLDER(a_byte_order_mark_is_passed_over),
        IN_FOLDER(bad_grey_maps_are_refused),      IN_FOLDER(ascii_grids_lie_where_their_header_says),
        IN_FOLDER(bad_ascii_grids_are_refused),    IN_FOLDER(terrain_files_are_read_as_their_page_says),
        IN_FOLDER(vertices_of_a_mesh_are_points),  IN_FOLDER(curves_are_polylines_and_surfaces_meshes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
