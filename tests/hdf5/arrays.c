/* Arrays of HDF5 files, made by HDF5 itself: the same doubles come back, and what cannot be read is told. */
#include "files.h"

#include <hdf5.h>

static const char *pia;

/* Makes `name` in the file, with groups on the way, from doubles; chunk NULL: in one piece, else deflated in chunks. */
static void put(hid_t file, const char *name, hid_t type, int directions, const hsize_t *shape, const hsize_t *chunk,
                const double *values)
{
    hid_t space = H5Screate_simple(directions, shape, NULL), layout = H5Pcreate(H5P_DATASET_CREATE), links = H5Pcreate(H5P_LINK_CREATE);
    H5Pset_create_intermediate_group(links, 1);
    if (chunk != NULL) {
        H5Pset_chunk(layout, directions, chunk);
        H5Pset_deflate(layout, 6);
    }
    hid_t set = H5Dcreate2(file, name, type, space, links, layout, H5P_DEFAULT);
    assert_true(set >= 0);
    if (values != NULL) assert_true(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    H5Dclose(set);
    H5Pclose(links);
    H5Pclose(layout);
    H5Sclose(space);
}

static hid_t create(const char *name)
{
    hid_t file = H5Fcreate(path_of(name), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(file >= 0);
    return file;
}

static double *wave(pia_index count)
{
    double *values = malloc((size_t)count * sizeof *values);
    for (pia_index i = 0; i < count; i++) values[i] = sin(0.1 * (double)i) * (1 + 1e-7 * (double)i);
    return values;
}

static void make_kinds(const double *values)
{
    hid_t file = create("kinds.h5");
    put(file, "/scan/points", H5T_IEEE_F64LE, 2, (hsize_t[]){100, 3}, NULL, values);
    put(file, "/scan/big", H5T_IEEE_F64BE, 2, (hsize_t[]){100, 3}, NULL, values);
    put(file, "/scan/single", H5T_IEEE_F32LE, 2, (hsize_t[]){100, 3}, (hsize_t[]){7, 2}, values);
    put(file, "/scan/whole", H5T_STD_I16BE, 1, (hsize_t[]){5}, NULL, (const double[]){-3, 1, 4, 1, 5});
    put(file, "/grid", H5T_IEEE_F64LE, 3, (hsize_t[]){10, 15, 2}, (hsize_t[]){4, 4, 2}, values);
    put(file, "/deep", H5T_IEEE_F64LE, 4, (hsize_t[]){2, 5, 5, 2}, NULL, values);
    put(file, "/empty", H5T_IEEE_F64LE, 2, (hsize_t[]){0, 3}, NULL, NULL);
    H5Fclose(file);
}

static void check_array(pia_context *context, const char *name, int grid, pia_index rows, pia_index columns, int dim,
                        const double *expected, int single)
{
    pia_points_options options;
    pia_points_info info;
    pia_points_options_init(&options);
    options.grid = grid;
    pia_points *points = read_points(context, name, &options, &info);
    assert_string_equal(info.format, "hdf5");
    assert_int_equal(info.count[0], rows);
    assert_int_equal(info.count[1], columns);
    assert_int_equal(info.dim, dim);
    for (pia_index i = 0; i < rows * columns * dim; i++)
        assert_near(info.points[i], single ? (double)(float)expected[i] : expected[i], 0);
    pia_points_destroy(points);
}

static void every_kind_of_number_comes_back(void **state)
{
    double *values = wave(300);
    make_kinds(values);
    check_array(*state, "kinds.h5:/scan/points", 0, 100, 1, 3, values, 0);
    check_array(*state, "kinds.h5:/scan/big", 0, 100, 1, 3, values, 0);
    check_array(*state, "kinds.h5:/scan/single", 0, 100, 1, 3, values, 1);
    check_array(*state, "kinds.h5:/scan/whole", 0, 5, 1, 1, (const double[]){-3, 1, 4, 1, 5}, 0);
    check_array(*state, "kinds.h5:/grid", 0, 10, 15, 2, values, 0);
    free(values);
}

static void the_only_array_needs_no_name(void **state)
{
    double *values = wave(12);
    hid_t file = create("heights.hdf5");
    put(file, "/terrain/heights", H5T_IEEE_F64LE, 2, (hsize_t[]){3, 4}, NULL, values);
    H5Fclose(file);
    check_array(*state, "heights.hdf5", 0, 3, 1, 4, values, 0);
    pia_points_options options;
    pia_points_info info;
    pia_points_options_init(&options);
    options.grid = 1;
    pia_points *points = read_points(*state, "heights.hdf5:/terrain/heights", &options, &info);
    assert_int_equal(info.kind, PIA_GRID);
    assert_near(info.points[3 * 7], 3, 0);
    assert_near(info.points[3 * 7 + 1], 1, 0);
    assert_near(info.points[3 * 7 + 2], values[7], 0);
    pia_points_destroy(points);
    free(values);
}

/* More rows than are read at once, in chunks that do not divide them. */
static void long_arrays_come_whole(void **state)
{
    enum { ROWS = 700001 };
    double *values = wave(2 * ROWS);
    hid_t file = create("long.h5");
    put(file, "/points", H5T_IEEE_F64LE, 2, (hsize_t[]){ROWS, 2}, (hsize_t[]){9973, 2}, values);
    H5Fclose(file);
    check_array(*state, "long.h5", 0, ROWS, 1, 2, values, 0);
    free(values);
}

static void what_cannot_be_read_is_told(void **state)
{
    double *values = wave(300);
    make_kinds(values);
    free(values);
    assert_refused(*state, "kinds.h5", NULL, PIA_E_FORMAT, "several arrays, /empty, /grid, /scan/big");
    assert_refused(*state, "kinds.h5:/scan/no", NULL, PIA_E_FORMAT, "no array '/scan/no'; there is /empty");
    assert_refused(*state, "kinds.h5:/scan", NULL, PIA_E_FORMAT, "no array '/scan'");
    assert_refused(*state, "kinds.h5:/deep", NULL, PIA_E_FORMAT, "other than one to three directions");
    assert_refused(*state, "kinds.h5:/empty", NULL, PIA_E_FORMAT, "holds no values");
    make_text("text.h5", "no such file\n");
    assert_refused(*state, "text.h5", NULL, PIA_E_FORMAT, "not an HDF5 file");
    assert_refused(*state, "none.h5:/a", NULL, PIA_E_FILE, "none.h5: does not exist");
    hid_t file = create("nothing.h5");
    H5Fclose(file);
    assert_refused(*state, "nothing.h5", NULL, PIA_E_FORMAT, "holds no array");
}

/* Values that were never written need no room in the file. */
static void claims_are_held_against_the_size(void **state)
{
    hid_t file = create("huge.h5");
    put(file, "/points", H5T_IEEE_F64LE, 2, (hsize_t[]){1000000000000000000, 3}, (hsize_t[]){1000, 3}, NULL);
    H5Fclose(file);
    assert_refused(*state, "huge.h5", NULL, PIA_E_FORMAT, "claims 2.4e+19 bytes");
}

/* HDF5 may fall over a damaged file, its program and not this one. */
static void damaged_files_are_answered(void **state)
{
    double *values = wave(300);
    make_kinds(values);
    free(values);
    const char *path = path_of("kinds.h5");
    FILE *file = fopen(path, "rb");
    static unsigned char bytes[1 << 16], hurt[1 << 16];
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    unsigned random = 1;
    for (int round = 0; round < 40; round++) {
        memcpy(hurt, bytes, size);
        for (int k = 0; k < 30; k++) {
            random = random * 1664525 + 1013904223;
            hurt[(random >> 8) % size] = (unsigned char)(random >> 24);
        }
        make_file("hurt.h5", hurt, round % 4 == 3 ? size / 40 * (size_t)round : size);
        pia_points *points = NULL;
        pia_status status = pia_points_read(*state, path_of("hurt.h5:/scan/single"), NULL, &points);
        assert_true(status == PIA_OK || status == PIA_E_FORMAT);
        if (status == PIA_OK) pia_points_destroy(points);
    }
}

static void without_the_program_the_package_is_named(void **state)
{
    (void)state;
    char command[1024], *text;
    make_text("a.h5", "HDF");
    snprintf(command, sizeof command,
             "cp '%s' %s/alone; cd %s; PIA_PLUGIN_PATH= ASAN_OPTIONS=detect_leaks=0 ./alone info a.h5 2>told; test $? -eq 2", pia,
             test_folder, test_folder);
    assert_int_equal(system(command), 0);
    text = read_text(path_of("told"));
    assert_non_null(strstr(text, "libhdf5-dev"));
    free(text);
}

static void the_command_takes_an_array(void **state)
{
    (void)state;
    char command[1024], *text;
    double *values = wave(300);
    make_kinds(values);
    free(values);
    snprintf(command, sizeof command,
             "cd %s; '%s' fit kinds.h5:/scan/points --degree 1 -o m.json -q >said && '%s' fit - --format hdf5 -q <kinds.h5 2>told; "
             "test $? -eq 3 && '%s' fit kinds.h5:/grid --tolerance 1 --json >said",
             test_folder, pia, pia, pia);
    assert_int_equal(system(command), 0);
    text = read_text(path_of("said"));
    assert_non_null(strstr(text, "\"grid\""));
    free(text);
    text = read_text(path_of("told"));
    assert_non_null(strstr(text, "standard input: HDF5 is read from files"));
    free(text);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(every_kind_of_number_comes_back),
        IN_FOLDER(the_only_array_needs_no_name),
        IN_FOLDER(long_arrays_come_whole),
        IN_FOLDER(what_cannot_be_read_is_told),
        IN_FOLDER(claims_are_held_against_the_size),
        IN_FOLDER(damaged_files_are_answered),
        IN_FOLDER(without_the_program_the_package_is_named),
        IN_FOLDER(the_command_takes_an_array),
    };
    if (argc != 2) return 2;
    pia = argv[1];
    return cmocka_run_group_tests(tests, NULL, NULL);
}
