/* PLY: the three encodings against values written here byte by byte, lists and other elements skipped, lies in the header refused. */
#include "files.h"

static void assert_rows(pia_context *context, const char *name, const char *columns, pia_index rows, int dim, const double *expected)
{
    pia_points_options options;
    pia_points_options_init(&options);
    options.columns = columns;
    pia_points_info info;
    pia_points *points = read_points(context, name, &options, &info);
    assert_int_equal(info.kind, PIA_CURVE);
    assert_int_equal(info.count[0], rows);
    assert_int_equal(info.dim, dim);
    assert_string_equal(info.format, "ply");
    for (pia_index i = 0; i < rows * dim; i++) assert_near(info.points[i], expected[i], 0);
    pia_points_destroy(points);
}

static void ascii_vertices_are_read_between_other_elements_and_lists(void **state)
{
    static const double expected[] = {1, 2, 3, 4, -5e-3, 6}, chosen[] = {255, 3, 7, 6};
    make_text("a.ply", "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nelement camera 2\r\nproperty list uchar int seen\r\n"
                       "property float f\r\nelement vertex 2\r\nproperty float x\r\nproperty float y\r\n"
                       "property list uint8 float32 weights\r\nproperty double z\r\nproperty uchar red\r\nelement face 1\r\n"
                       "property list uchar int vertex_indices\r\nend_header\r\n3 0 1 2 0.5\r\n0 0.5\r\n1 2 2 0.25 0.75 3 255\r\n"
                       "4 -5e-3 0 6 7\r\n3 0 1 2\r\n");
    assert_rows(*state, "a.ply", NULL, 2, 3, expected);
    assert_rows(*state, "a.ply", "red,z", 2, 2, chosen);
    assert_rows(*state, "a.ply", "5,4", 2, 2, chosen);
}

/* Numbers at the end of a buffer, in the byte order asked for. */
typedef struct bytes {
    unsigned char at[1024];
    size_t size;
    int big;
} bytes;

static void put(bytes *b, const void *value, size_t size)
{
    unsigned char turned[8];
    memcpy(turned, value, size); /* the tests run on little-endian machines */
    for (size_t i = 0; i < size; i++) b->at[b->size++] = turned[b->big ? size - 1 - i : i];
}

static void put_text(bytes *b, const char *text)
{
    memcpy(b->at + b->size, text, strlen(text));
    b->size += strlen(text);
}

static void binary_numbers_of_every_type_are_read_in_both_orders(void **state)
{
    static const double expected[] = {-3, 250, -1000, 60000, -100000, 4e9, 0.5, 1e-300, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    static const int8_t i1[] = {-3, 0};
    static const uint8_t u1[] = {250, 0};
    static const int16_t i2[] = {-1000, 0};
    static const uint16_t u2[] = {60000, 0};
    static const int32_t i4[] = {-100000, 0};
    static const uint32_t u4[] = {4000000000u, 0};
    static const float f4[] = {0.5f, 0}, last[] = {7, 0};
    static const double f8[] = {1e-300, 0};
    for (int big = 0; big < 2; big++) {
        bytes b = {.big = big};
        put_text(&b, "ply\nformat ");
        put_text(&b, big ? "binary_big_endian 1.0\n" : "binary_little_endian 1.0\n");
        put_text(&b, "element before 3\nproperty short a\nproperty double b\nelement more 2\nproperty list ushort short c\n"
                     "element vertex 2\nproperty char a\nproperty uchar b\nproperty short c\nproperty ushort d\nproperty int e\n"
                     "property uint f\nproperty float g\nproperty list uint uchar skipped\nproperty double h\nproperty float32 k\n"
                     "end_header\n");
        for (int i = 0; i < 3; i++) {
            put(&b, i2, 2);
            put(&b, f8, 8);
        }
        static const uint16_t lengths[] = {2, 0};
        for (int i = 0; i < 2; i++) {
            put(&b, &lengths[i], 2);
            for (int k = 0; k < lengths[i]; k++) put(&b, i2, 2);
        }
        for (int i = 0; i < 2; i++) {
            uint32_t length = i == 0 ? 3 : 0;
            put(&b, &i1[i], 1);
            put(&b, &u1[i], 1);
            put(&b, &i2[i], 2);
            put(&b, &u2[i], 2);
            put(&b, &i4[i], 4);
            put(&b, &u4[i], 4);
            put(&b, &f4[i], 4);
            put(&b, &length, 4);
            for (uint32_t k = 0; k < length; k++) put(&b, u1, 1);
            put(&b, &f8[i], 8);
            put(&b, &last[i], 4);
        }
        make_file("b.ply", b.at, b.size);
        assert_rows(*state, "b.ply", "a,b,c,d,e,f,g,h,k", 2, 9, expected);
        make_file("b.ply", b.at, b.size - 1);
        pia_points_options options = {.struct_size = sizeof options, .columns = "a"};
        assert_refused(*state, "b.ply", &options, PIA_E_FORMAT, "ends inside its data, at a property k");
    }
}

static void planar_vertices_and_rows_to_be_skipped_are_known(void **state)
{
    static const double planar[] = {1, 2, 3, 4};
    make_text("p.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float y\nproperty float x\nend_header\n2 1\n4 3");
    assert_rows(*state, "p.ply", NULL, 2, 2, planar);
    make_text("n.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
                       "1 2 3\nnan nan nan\n4 5 6\n");
    assert_refused(*state, "n.ply", NULL, PIA_E_FORMAT, "component 0 of row 1 is nan");
    pia_points_options options = {.struct_size = sizeof options, .skip_invalid = 1};
    pia_points_info info;
    pia_points *points = read_points(*state, "n.ply", &options, &info);
    assert_int_equal(info.count[0], 2);
    assert_int_equal(info.skipped, 1);
    assert_int_equal(info.row[1], 2);
    assert_string_equal(info.names[2], "z");
    pia_points_destroy(points);
}

static void lies_and_errors_are_refused_with_their_line(void **state)
{
#define VERTEX "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
    static const struct {
        const char *text;
        pia_status status;
        const char *what;
    } bad[] = {
        {"plyx\n", PIA_E_FORMAT, "is not a PLY file"},
        {"ply\nformat ascii 1.0\n" VERTEX, PIA_E_FORMAT, "ends inside its PLY header"},
        {"ply\nformat zip 1.0\n" VERTEX "end_header\n", PIA_E_FORMAT, ":2: 'format zip 1.0' is no format of PLY"},
        {"ply\n" VERTEX "end_header\n", PIA_E_FORMAT, ":2: 'element vertex 2' comes before the line of the format"},
        {"ply\nformat ascii 1.0\nelement vertex -2\nend_header\n", PIA_E_FORMAT, ":3: 'element vertex -2' is no element"},
        {"ply\nformat ascii 1.0\nelement vertex 2\nproperty half x\nend_header\n", PIA_E_FORMAT, "has a type that PLY does not know"},
        {"ply\nformat ascii 1.0\nelement vertex 2\nproperty list list x\nend_header\n", PIA_E_FORMAT, "is no property"},
        {"ply\nformat ascii 1.0\nelement vertex 2\nproperty list uchar list x\nend_header\n", PIA_E_FORMAT, "a type that PLY does not"},
        {"ply\nformat ascii 1.0\nproperty float x\nend_header\n", PIA_E_FORMAT, "is no property"},
        {"ply\nformat ascii 1.0\nelement face 1\nproperty float x\nend_header\n1", PIA_E_FORMAT, "has no element vertex"},
        {"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n", PIA_E_FORMAT, "holds no vertices"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nend_header\n", PIA_E_FORMAT, "holds no vertices"},
        {"ply\nformat ascii 1.0\n" VERTEX "hello\nend_header\n", PIA_E_FORMAT, ":7: 'hello' means nothing"},
        {"ply\nformat ascii 1.0\n" VERTEX "end_header\n1 2 3\n4 five 6\n", PIA_E_FORMAT, ":9: 'five' is not a number"},
        {"ply\nformat ascii 1.0\n" VERTEX "end_header\n1.25 2 3\n4 5\n", PIA_E_FORMAT, "ends inside its data, at a property z"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float a\nproperty float b\nend_header\n1 2", PIA_E_ARGUMENT,
         "there is no column 'x'; give names (a b) or numbers from 1 to 2"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty list uchar int y\nend_header\n1 1 2", PIA_E_ARGUMENT,
         "the property y is a list"},
        {"ply\nformat ascii 1.0\nelement v 1\nproperty list float int y\n" VERTEX "end_header\n-1 1 2", PIA_E_FORMAT,
         "a list y has the length -1"},
        {"ply\nformat ascii 1.0\nelement vertex 999999999999999999\nproperty float x\nproperty float y\nend_header\n1 2", PIA_E_FORMAT,
         "claims 999999999999999999 items"},
        {"ply\nformat binary_little_endian 1.0\nelement nothing 999999999999999999\nelement vertex 999999999999999999\n"
         "property list uchar uchar x\nend_header\n1",
         PIA_E_FORMAT, "claims 999999999999999999 items"},
        {"ply\nformat ascii 1.0\nelement v 1\nproperty list int int y\n" VERTEX "end_header\n99999999999999999 1 2", PIA_E_FORMAT,
         "ends inside its data"},
        {"ply\nformat binary_little_endian 1.0\nelement v 1\nproperty list int int y\n" VERTEX "end_header\n\xff\xff\xff\x7f   ",
         PIA_E_FORMAT, "ends inside its data"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        make_text("bad.ply", bad[i].text);
        assert_refused(*state, "bad.ply", NULL, bad[i].status, bad[i].what);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(ascii_vertices_are_read_between_other_elements_and_lists),
        IN_FOLDER(binary_numbers_of_every_type_are_read_in_both_orders),
        IN_FOLDER(planar_vertices_and_rows_to_be_skipped_are_known),
        IN_FOLDER(lies_and_errors_are_refused_with_their_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
