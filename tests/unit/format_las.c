/* LAS: files of every point format written field after field as the specification lists them, so that the reader's offsets are checked
 * against the order of the fields. */
#include "files.h"

typedef struct las {
    unsigned char at[1024];
    size_t size;
} las;

static void put(las *file, uint64_t value, int size)
{
    for (int i = 0; i < size; i++) file->at[file->size++] = (unsigned char)(value >> 8 * i);
}

static void put_double(las *file, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(file, bits, 8);
}

static void set(las *file, size_t at, uint64_t value, int size)
{
    for (int i = 0; i < size; i++) file->at[at + (size_t)i] = (unsigned char)(value >> 8 * i);
}

/* The public header block in the order of table 3, with two variable records' worth of bytes behind it. */
static void put_header(las *file, int minor, int format, int record_size, uint32_t count)
{
    static const double scale[] = {0.01, 0.25, 2}, offset[] = {500000, -4.5e6, 100};
    int size = minor >= 4 ? 375 : minor == 3 ? 235 : 227;
    memcpy(file->at, "LASF", 4);
    file->size = 4;
    put(file, 0, 2); /* file source */
    put(file, 0, 2); /* global encoding */
    put(file, 0, 8); /* GUID */
    put(file, 0, 8);
    put(file, 1, 1);
    put(file, (uint64_t)minor, 1);
    file->size += 32 + 32; /* system, software */
    put(file, 1, 2);       /* day */
    put(file, 2026, 2);
    put(file, (uint64_t)size, 2);
    put(file, (uint64_t)size + 20, 4);
    put(file, 0, 4); /* variable length records */
    put(file, (uint64_t)format, 1);
    put(file, (uint64_t)record_size, 2);
    put(file, count, 4);
    file->size += 5 * 4; /* points by return */
    for (int d = 0; d < 3; d++) put_double(file, scale[d]);
    for (int d = 0; d < 3; d++) put_double(file, offset[d]);
    file->size = (size_t)size + 20;
}

static void put_record(las *file, int format)
{
    int wide = format >= 6;
    put(file, (uint32_t)-12345, 4);
    put(file, 4, 4);
    put(file, 50, 4);
    put(file, 65535, 2);                                     /* intensity */
    put(file, wide ? 13 | 15 << 4 : 5 | 6 << 3 | 1 << 7, 1); /* return number, number of returns, edge */
    if (wide) put(file, 0xff, 1);                            /* flags */
    put(file, wide ? 200 : 9 | 0xe0, 1);                     /* classification, flags */
    if (!wide) put(file, (uint8_t)-90, 1);                   /* scan angle */
    put(file, 7, 1);                                         /* user data */
    if (wide) put(file, (uint16_t)-15000, 2);
    put(file, 4711, 2); /* point source */
    if (format != 0 && format != 2) put_double(file, 1.5e9);
    if (format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10)
        for (int k = 1; k <= 3; k++) put(file, (uint64_t)(1000 * k), 2);
    if (format == 8 || format == 10) put(file, 4000, 2);
    if (format == 4 || format == 5 || format >= 9) file->size += 29; /* wave packet */
}

static void assert_column(pia_context *context, const char *name, double expected, double tolerance)
{
    pia_points_options options = {.struct_size = sizeof options, .columns = name};
    pia_points_info info;
    pia_points *points = read_points(context, "a.las", &options, &info);
    assert_int_equal(info.count[0], 2);
    assert_int_equal(info.dim, 1);
    assert_near(info.points[1], expected, tolerance);
    pia_points_destroy(points);
}

static void every_point_format_is_read_by_name(void **state)
{
    static const int length[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
    for (int format = 0; format <= 10; format++)
        for (int extra = 0; extra <= 3; extra += 3) {
            las file = {.size = 0};
            int minor = format >= 6 ? 4 : format >= 4 ? 3 : 2, wide = format >= 6;
            put_header(&file, minor, format, length[format] + extra, wide ? 0 : 2);
            if (wide) set(&file, 247, 2, 8);
            for (int i = 0; i < 2; i++) {
                size_t begin = file.size;
                put_record(&file, format);
                assert_int_equal(file.size - begin, length[format]);
                file.size += (size_t)extra;
            }
            make_file("a.las", file.at, file.size);
            assert_column(*state, "x", 500000 - 123.45, 1e-9);
            assert_column(*state, "y", -4.5e6 + 1, 0);
            assert_column(*state, "z", 200, 0);
            assert_column(*state, "intensity", 65535, 0);
            assert_column(*state, "return_number", wide ? 13 : 5, 0);
            assert_column(*state, "number_of_returns", wide ? 15 : 6, 0);
            assert_column(*state, "classification", wide ? 200 : 9, 0);
            assert_column(*state, "scan_angle", -90, 1e-12);
            assert_column(*state, "user_data", 7, 0);
            assert_column(*state, "point_source_id", 4711, 0);
            pia_points_options options = {.struct_size = sizeof options, .columns = "gps_time"};
            if (format == 0 || format == 2)
                assert_refused(*state, "a.las", &options, PIA_E_ARGUMENT, "there is no column 'gps_time'");
            else
                assert_column(*state, "gps_time", 1.5e9, 0);
            if (format == 3) assert_column(*state, "green", 2000, 0);
            if (format >= 7 && format != 9) assert_column(*state, "blue", 3000, 0);
            if (format == 8 || format == 10) assert_column(*state, "nir", 4000, 0);
        }
}

static void coordinates_are_the_columns_unless_others_are_asked_for(void **state)
{
    las file = {.size = 0};
    put_header(&file, 2, 1, 28, 1);
    put_record(&file, 1);
    make_file("a.las", file.at, file.size);
    pia_points_info info;
    pia_points *points = read_points(*state, "a.las", NULL, &info);
    assert_int_equal(info.dim, 3);
    assert_string_equal(info.names[1], "y");
    assert_near(info.points[0], 499876.55, 1e-9);
    pia_points_destroy(points);
}

static void lies_are_refused(void **state)
{
    static const struct {
        size_t at;
        uint64_t value;
        int size;
        const char *what;
    } lie[] = {
        {0, 0, 1, "is not a LAS file"},
        {25, 9, 1, "has LAS version 1.9"},
        {104, 6 | 0x80, 1, "is compressed (LAZ); decompress it first"},
        {104, 11, 1, "has point format 11"},
        {105, 29, 2, "has records of 29 bytes, point format 6 needs 30"},
        {107, 0, 4, "holds no points"},
        {107, 2, 4, "claims 2 points"},
        {247, 1000000000000000000u, 8, "claims 1000000000000000000 points"},
        {96, 0xffffffff, 4, "claims 1 points"},
        {131, 0x7ff8000000000000u, 8, "component 0 of row 0 is nan"},
    };
    las good = {.size = 0};
    put_header(&good, 4, 6, 30, 1);
    put_record(&good, 6);
    for (size_t i = 0; i < sizeof lie / sizeof *lie; i++) {
        las file = good;
        set(&file, lie[i].at, lie[i].value, lie[i].size);
        make_file("a.las", file.at, file.size);
        assert_refused(*state, "a.las", NULL, PIA_E_FORMAT, lie[i].what);
    }
    make_file("a.las", good.at, 200);
    assert_refused(*state, "a.las", NULL, PIA_E_FORMAT, "ends inside its LAS header");
    make_file("a.laz", good.at, good.size);
    assert_refused(*state, "a.laz", NULL, PIA_E_FORMAT, "laszip");
    make_file("a.e57", good.at, good.size);
    assert_refused(*state, "a.e57", NULL, PIA_E_FORMAT, "pdal translate");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(every_point_format_is_read_by_name),
        IN_FOLDER(coordinates_are_the_columns_unless_others_are_asked_for),
        IN_FOLDER(lies_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
