#include "files.h"

/* An NPY file of the folder: a dictionary, padded as NumPy does, and values. */
static void make_npy(int version, const char *dictionary, const void *values, size_t size)
{
    unsigned char bytes[2048] = "\x93NUMPY";
    size_t begin = version == 1 ? 10 : 12, length = (begin + strlen(dictionary) + 64) / 64 * 64 - begin;
    bytes[6] = (unsigned char)version;
    bytes[8] = (unsigned char)length;
    memset(bytes + begin, ' ', length);
    memcpy(bytes + begin, dictionary, strlen(dictionary));
    bytes[begin + length - 1] = '\n';
    memcpy(bytes + begin + length, values, size);
    make_file("array.npy", bytes, begin + length + size);
}

static void assert_values(const pia_points_info *info, const double *expected)
{
    for (pia_index i = 0; i < info->count[0] * info->count[1] * info->dim; i++) assert_near(info->points[i], expected[i], 0);
}

static void assert_array(pia_context *context, pia_index rows, int dim, const double *expected)
{
    pia_points_info info;
    pia_points *points = read_points(context, "array.npy", NULL, &info);
    assert_int_equal(info.count[0], rows);
    assert_int_equal(info.dim, dim);
    assert_values(&info, expected);
    pia_points_destroy(points);
}

static void reverse_bytes(unsigned char *bytes, size_t count, size_t size)
{
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < size / 2; k++) {
            unsigned char byte = bytes[i * size + k];
            bytes[i * size + k] = bytes[i * size + size - 1 - k];
            bytes[i * size + size - 1 - k] = byte;
        }
    }
}

static void every_version_type_and_byte_order_is_read(void **state)
{
    static const double expected[] = {1, -2, 3, 100, 5, 6};
    static const double unsigned_expected[] = {1, 254, 3, 100, 5, 6};
    double f8[] = {1, -2, 3, 100, 5, 6};
    float f4[] = {1, -2, 3, 100, 5, 6};
    int32_t i4[] = {1, -2, 3, 100, 5, 6};
    int64_t i8[] = {1, -2, 3, 100, 5, 6};
    int16_t i2[] = {1, -2, 3, 100, 5, 6};
    int8_t i1[] = {1, -2, 3, 100, 5, 6};
    make_npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }", f8, sizeof f8);
    assert_array(*state, 3, 2, expected);
    make_npy(2, "{\"shape\": (3, 2), \"fortran_order\": False, \"descr\": \"<f4\"}", f4, sizeof f4);
    assert_array(*state, 3, 2, expected);
    make_npy(3, "{'descr':'<i4','fortran_order':False,'shape':(3,2)}", i4, sizeof i4);
    assert_array(*state, 3, 2, expected);
    make_npy(1, "{'descr': '<i8', 'fortran_order': False, 'shape': (6,), }", i8, sizeof i8);
    assert_array(*state, 6, 1, expected);
    make_npy(1, "{'descr': '<i2', 'fortran_order': False, 'shape': (3, 2), }", i2, sizeof i2);
    assert_array(*state, 3, 2, expected);
    make_npy(1, "{'descr': '|i1', 'fortran_order': False, 'shape': (3, 2), }", i1, sizeof i1);
    assert_array(*state, 3, 2, expected);
    make_npy(1, "{'descr': '|u1', 'fortran_order': False, 'shape': (3, 2), }", i1, sizeof i1);
    assert_array(*state, 3, 2, unsigned_expected);
    reverse_bytes((unsigned char *)f8, 6, 8);
    reverse_bytes((unsigned char *)f4, 6, 4);
    reverse_bytes((unsigned char *)i2, 6, 2);
    make_npy(1, "{'descr': '>f8', 'fortran_order': False, 'shape': (3, 2), }", f8, sizeof f8);
    assert_array(*state, 3, 2, expected);
    make_npy(1, "{'descr': '>f4', 'fortran_order': False, 'shape': (3, 2), }", f4, sizeof f4);
    assert_array(*state, 3, 2, expected);
    make_npy(1, "{'descr': '>i2', 'fortran_order': False, 'shape': (3, 2), }", i2, sizeof i2);
    assert_array(*state, 3, 2, expected);
}

static void fortran_order_is_turned(void **state)
{
    static const double columns[] = {1, 2, 3, 10, 20, 30}, rows[] = {1, 10, 2, 20, 3, 30};
    make_npy(1, "{'descr': '<f8', 'fortran_order': True, 'shape': (3, 2), }", columns, sizeof columns);
    assert_array(*state, 3, 2, rows);
    double c_order[24], f_order[24];
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 3; b++)
            for (int c = 0; c < 4; c++) c_order[(a * 3 + b) * 4 + c] = f_order[a + 2 * (b + 3 * c)] = a * 100 + b * 10 + c;
    make_npy(1, "{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3, 4), }", f_order, sizeof f_order);
    pia_points_info info;
    pia_points *points = read_points(*state, "array.npy", NULL, &info);
    assert_int_equal(info.kind, PIA_GRID);
    assert_int_equal(info.count[0], 2);
    assert_int_equal(info.count[1], 3);
    assert_int_equal(info.dim, 4);
    assert_values(&info, c_order);
    pia_points_destroy(points);
}

static void columns_and_heights_are_taken_on_request(void **state)
{
    static const double values[] = {1, 2, 3, 4, 5, 6}, chosen[] = {3, 1, 6, 4},
                        heights[] = {0, 0, 1, 1, 0, 2, 2, 0, 3, 0, 1, 4, 1, 1, 5, 2, 1, 6};
    pia_points_options options;
    pia_points_options_init(&options);
    pia_points_info info;
    make_npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }", values, sizeof values);
    options.columns = "3,1";
    pia_points *points = read_points(*state, "array.npy", &options, &info);
    assert_int_equal(info.dim, 2);
    assert_values(&info, chosen);
    pia_points_destroy(points);
    options.columns = "4";
    assert_refused(*state, "array.npy", &options, PIA_E_ARGUMENT, "there is no column '4'");
    options.columns = NULL;
    options.grid = 1;
    points = read_points(*state, "array.npy", &options, &info);
    assert_int_equal(info.kind, PIA_GRID);
    assert_int_equal(info.count[1], 3);
    assert_values(&info, heights);
    pia_points_destroy(points);
}

static void values_that_are_not_finite_are_refused_or_dropped(void **state)
{
    static const double values[] = {1, 2, 3, NAN, 5, 6};
    pia_points_options options;
    pia_points_options_init(&options);
    pia_points_info info;
    make_npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }", values, sizeof values);
    assert_refused(*state, "array.npy", NULL, PIA_E_FORMAT, "component 1 of row 1 is nan");
    options.skip_invalid = 1;
    pia_points *points = read_points(*state, "array.npy", &options, &info);
    assert_int_equal(info.count[0], 2);
    assert_int_equal(info.skipped, 1);
    assert_int_equal(info.row[1], 2);
    assert_near(info.points[3], 6, 0);
    pia_points_destroy(points);
    options.skip_invalid = 0;
    options.allow_nan = 1;
    points = read_points(*state, "array.npy", &options, &info);
    assert_true(isnan(info.points[3]));
    pia_points_destroy(points);
    options.allow_nan = 0;
    options.grid = 1;
    assert_refused(*state, "array.npy", &options, PIA_E_FORMAT, "row 1, column 1 of the grid is nan");
}

static void headers_that_lie_are_refused(void **state)
{
    static const double values[20] = {0};
    static const struct {
        const char *dictionary, *message;
    } bad[] = {
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (10000000000000000000, 3), }", "shape is not one to three counts"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000000000, 3), }", "claims more values than"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (4000000000, 4000000000), }", "claims more values than"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (21,), }", "claims more values than"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (), }", "shape is not one to three"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 1, 1), }", "shape is not one to three"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (-1,), }", "shape is not one to three"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (0, 3), }", "holds no values"},
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (1, 17), }", "17 components"},
        {"{'descr': '<c16', 'fortran_order': False, 'shape': (1,), }", "no plain numbers"},
        {"{'descr': '|O', 'fortran_order': False, 'shape': (1,), }", "no plain numbers"},
        {"{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (1,), }", "no plain numbers"},
        {"{'descr': '<f8', 'shape': (1,), }", "lacks descr, fortran_order or shape"},
        {"{'descr': '<f8', 'fortran_order': Maybe, 'shape': (1,), }", "lacks"},
        {"{'descr': '<f8", "no plain numbers"},
        {"[1]", "no dictionary"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        make_npy(1, bad[i].dictionary, values, sizeof values);
        assert_refused(*state, "array.npy", NULL, PIA_E_FORMAT, bad[i].message);
    }
    make_npy(9, "{}", values, 0);
    assert_refused(*state, "array.npy", NULL, PIA_E_FORMAT, "has NPY version 9");
    make_text("array.npy", "x,y\n1,2\n3,4\n");
    assert_refused(*state, "array.npy", NULL, PIA_E_FORMAT, "is not an NPY file");
    make_file("array.npy", "\x93NUMPY\x01\x00\xff\xff{", 11);
    assert_refused(*state, "array.npy", NULL, PIA_E_FORMAT, "ends inside its NPY header");
    make_file("array.npy", "\x93NUMPY\x02\x00\xff\xff", 10);
    assert_refused(*state, "array.npy", NULL, PIA_E_FORMAT, "ends inside its NPY header");
}

static void tables_and_samples_come_back_with_the_same_bits(void **state)
{
    static const double values[] = {1.0 / 3, -0.0, 5e-324, 1e300, 2, 3}, knots[] = {0, 0, 1, 1}, corners[] = {0, 0, 0, 1};
    assert_ok(*state, pia_table_write(*state, path_of("array.npy"), NULL, "ignored", values, 3, 2));
    assert_array(*state, 3, 2, values);
    const double *both[] = {knots, knots};
    pia_model *patch = NULL;
    assert_ok(*state, pia_model_create(*state, 2, (int[]){1, 1}, both, (pia_index[]){2, 2}, 1, corners, NULL, &patch));
    const pia_model *models[] = {patch, patch};
    assert_ok(*state, pia_model_write(*state, path_of("patch.npy"), NULL, models, 1, 3));
    static const double expected[] = {0, 0, 0, 0, 0.25, 0.5, 0, 0.5, 1};
    pia_points_info info;
    pia_points *points = read_points(*state, "patch.npy", NULL, &info);
    assert_int_equal(info.kind, PIA_GRID);
    assert_int_equal(info.count[1], 3);
    assert_values(&info, expected);
    pia_points_destroy(points);
    assert_status(*state, pia_model_write(*state, path_of("patch.npy"), NULL, models, 2, 3), PIA_E_SHAPE);
    pia_model_destroy(patch);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(every_version_type_and_byte_order_is_read),
        IN_FOLDER(fortran_order_is_turned),
        IN_FOLDER(columns_and_heights_are_taken_on_request),
        IN_FOLDER(values_that_are_not_finite_are_refused_or_dropped),
        IN_FOLDER(headers_that_lie_are_refused),
        IN_FOLDER(tables_and_samples_come_back_with_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
