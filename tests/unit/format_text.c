#include "files.h"

#include "io.h"

#include <sys/stat.h>

static void assert_reads(pia_context *context, const char *text, int dim, pia_index rows, const double *expected)
{
    pia_points_info info;
    make_text("points.txt", text);
    pia_points *points = read_points(context, "points.txt", NULL, &info);
    if (info.dim != dim || info.count[0] != rows)
        print_error("read %lld x %d from \"%.40s\"\n", (long long)info.count[0], info.dim, text);
    assert_int_equal(info.dim, dim);
    assert_int_equal(info.count[0], rows);
    assert_int_equal(info.count[1], 1);
    assert_int_equal(info.kind, PIA_CURVE);
    for (pia_index i = 0; i < rows * dim; i++) assert_near(info.points[i], expected[i], 0);
    pia_points_destroy(points);
}

static void every_delimiter_is_recognised(void **state)
{
    static const double expected[] = {1, -2.5, 3, 4e3};
    static const char *const text[] = {"1,-2.5\n3,4e3\n",    "1;-2.5\n3;4e3\n",          "1\t-2.5\n3\t4e3\n",
                                       "1 -2.5\n3 4e3\n",    "  1  \t -2.5 \n 3\t\t4e3", "1 , -2.5\n3 , 4e3 ",
                                       "+1;\t-2.5\r\n3;4e3", "1,-2.5\r3,4e3\r",          "1,-2.5\r\n3,4e3\r\n\r\n"};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) assert_reads(*state, text[i], 2, 2, expected);
}

static void headers_titles_comments_and_marks_are_skipped(void **state)
{
    static const double expected[] = {1, 2, 3, 4};
    static const char *const text[] = {"x,y\n1,2\n3,4\n",
                                       "\xef\xbb\xbfx,y\n1,2\n3,4\n",
                                       ("\xef\xbb\xbf"
                                        "1,2\n3,4\n"),
                                       "NACA 2412\n1 2\n3 4\n",
                                       "23 AIRFOIL\n1 2\n3 4",
                                       "2\n1 2\n3 4\n",
                                       "# one\n\n# 5 6\n1 2\n3 4",
                                       "prose\nb1 = 1 2\nb2 = 3 4\nthen\n\n1 2\n3 4",
                                       "1,2 # a\n#b\n3,4#c\n#d",
                                       "\"x, m\",\"y\"\n\"1\",\"2\"\n\"3\", \"4\"\n",
                                       "x;y\r\n1;2\r\n3;4",
                                       "2theta,intensity\n1,2\n3,4\n",
                                       "t,1\n1,2\n3,4\n"};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) assert_reads(*state, text[i], 2, 2, expected);
}

static void columns_of_text_are_left_out(void **state)
{
    static const double expected[] = {1, 2, 3, 4};
    static const char *const text[] = {"name,x,y\nabc,1,2\nd\"e,3,4\n",
                                       "1,2020-01-01 10:00,2\n3,2020-01-02 11:00,4\n",
                                       "1,2,\n3,4,\n",
                                       "A 1 2\nB 3 4\n",
                                       "1,\"a, \"\"b\"\"\",2\n3,c,4\n",
                                       "1;nothing;2\n3;;4\n"};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) assert_reads(*state, text[i], 2, 2, expected);
}

static void blank_lines_end_parts(void **state)
{
    pia_points_info info;
    make_text("parts.csv", "\nx,y\n\n1,2\n3,4\n\n\n# comment\n5,6\n  \n7,8\n9,10\n\n");
    pia_points *points = read_points(*state, "parts.csv", NULL, &info);
    assert_int_equal(info.count[0], 5);
    assert_int_equal(info.part_count, 3);
    static const pia_index part[] = {0, 2, 3, 5};
    for (int i = 0; i < 4; i++) assert_int_equal(info.part[i], part[i]);
    pia_points_destroy(points);
    make_text("one.csv", "1,2\n");
    points = read_points(*state, "one.csv", NULL, &info);
    assert_int_equal(info.part_count, 1);
    assert_int_equal(info.part[1], 1);
    pia_points_destroy(points);
}

static void assert_parts(pia_context *context, const char *text, const char *columns, int dim, pia_index count, const pia_index *part)
{
    pia_points_info info;
    pia_points_options options;
    pia_points_options_init(&options);
    options.columns = columns;
    make_text("contours.csv", text);
    pia_points *points = read_points(context, "contours.csv", &options, &info);
    assert_int_equal(info.dim, dim);
    assert_int_equal(info.part_count, count);
    for (pia_index k = 0; k <= count; k++) assert_int_equal(info.part[k], part[k]);
    pia_points_destroy(points);
}

static void contours_are_parts_as_between_blank_lines(void **state)
{
    static const char numbered[] = "contour,x,y\n0,1,2\n0,3,4\n1,5,6\n1,7,8\n1,9,10\n0,1,1\n";
    static const char lettered[] = "x y contour\n1 2 outer\n3 4 outer\n5 6 hole\n7 8 hole\n9 9 hole\n1 1 outer\n";
    static const char quoted[] = "contour;x;y\r\n\"a\";1;2\r\na ;3;4\r\n\r\nb;5;6\r\nb;7;8\r\nb;9;9\r\n\"c\";1;1\r\n";
    static const pia_index part[] = {0, 2, 5, 6}, whole[] = {0, 6};
    assert_parts(*state, numbered, NULL, 2, 3, part);
    assert_parts(*state, numbered, "y", 1, 3, part);
    assert_parts(*state, lettered, NULL, 2, 3, part);
    assert_parts(*state, quoted, NULL, 2, 3, part);
    assert_parts(*state, numbered, "x,contour", 2, 1, whole);
    assert_parts(*state, "contour\n1\n1\n2\n2\n3\n3\n", NULL, 1, 1, whole);
    assert_parts(*state, "contours,x\n1,1\n1,2\n2,3\n2,4\n3,5\n3,6\n", NULL, 2, 1, whole);
}

static void a_matrix_of_heights_has_no_contours(void **state)
{
    pia_points_info info;
    pia_points_options options;
    pia_points_options_init(&options);
    options.grid = 1;
    make_text("heights.csv", "contour,b,c\n0,1,2\n1,3,4\n");
    pia_points *points = read_points(*state, "heights.csv", &options, &info);
    assert_int_equal(info.count[0], 2);
    assert_int_equal(info.count[1], 3);
    pia_points_destroy(points);
}

static void columns_are_chosen_by_name_or_number(void **state)
{
    pia_points_options options;
    pia_points_options_init(&options);
    pia_points_info info;
    make_text("named.csv", "t,label,x,2\n1,a,2,3\n4,b,5,6\n");
    static const char *const list[] = {"x,t", "3,1", "x,1", " x , t\t"};
    for (int i = 0; i < 4; i++) {
        options.columns = list[i];
        pia_points *points = read_points(*state, "named.csv", &options, &info);
        assert_int_equal(info.dim, 2);
        assert_near(info.points[0], 2, 0);
        assert_near(info.points[3], 4, 0);
        assert_string_equal(info.names[0], "x");
        assert_string_equal(info.names[1], "t");
        pia_points_destroy(points);
    }
    options.columns = "2"; /* a name goes before a number */
    pia_points *points = read_points(*state, "named.csv", &options, &info);
    assert_near(info.points[0], 3, 0);
    pia_points_destroy(points);
    options.columns = "z";
    assert_refused(*state, "named.csv", &options, PIA_E_ARGUMENT,
                   "there is no column 'z'; give names (t,label,x,2) or numbers from 1 to 4");
    options.columns = "5";
    assert_refused(*state, "named.csv", &options, PIA_E_ARGUMENT, "there is no column '5'");
    options.columns = "x,";
    assert_refused(*state, "named.csv", &options, PIA_E_ARGUMENT, "there is no column ''");
    options.columns = "x,3";
    assert_refused(*state, "named.csv", &options, PIA_E_ARGUMENT, "column '3' is listed twice");
    options.columns = "label";
    assert_refused(*state, "named.csv", &options, PIA_E_FORMAT, "named.csv:2: field 2 is 'a', not a number");
}

static void names_may_stand_in_a_comment(void **state)
{
    pia_points_info info;
    make_text("named.txt", "# made by hand\n# x\ty\n1 2\n");
    pia_points *points = read_points(*state, "named.txt", NULL, &info);
    assert_string_equal(info.names[1], "y");
    pia_points_destroy(points);
}

/* The same points as Fortran, spreadsheets of half of Europe, and everybody else write them. */
static void exponents_of_fortran_and_decimal_commas_are_read(void **state)
{
    static const char *const texts[] = {
        "0 12\n1500 -0.025\n2.5e-300 1\n",      "0D0 1.2D+01\n1.5d3 -2.5D-02\n0.25D-299 1.D0\n", "0;12\n1500;-0,025\n2,5e-300;1\n",
        "0\t12\n1500\t-0,025\n2,5D-300\t1,0\n", "x;y\n0,0; 12,0\n1500;\"-0,025\"\n2,5E-300;1\n",
    };
    static const double expected[] = {0, 12, 1500, -0.025, 2.5e-300, 1};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        pia_points_info info;
        make_text("numbers.csv", texts[k]);
        pia_points *points = read_points(*state, "numbers.csv", NULL, &info);
        assert_int_equal(info.count[0], 3);
        assert_int_equal(info.dim, 2);
        for (int i = 0; i < 6; i++) assert_near(info.points[i], expected[i], 0);
        pia_points_destroy(points);
    }
}

static void bad_rows_are_refused_with_their_line(void **state)
{
    static const struct {
        const char *text, *message;
    } bad[] = {
        {"", "bad.csv: is empty"},
        {"x,y\n", "bad.csv: holds no row of numbers"},
        {"\n\n#\n", "bad.csv: holds no row of numbers"},
        {"1,2\n3\n", "bad.csv:2: row has 1 field, the rows before had 2"},
        {"1,2\n\n3,4,5\n", "bad.csv:3: row has 3 fields, the rows before had 2"},
        {"1,2\n3,4,\n", "bad.csv:2: row has 3 fields"},
        {"1 2\r\n3 4 5\r\n", "bad.csv:2: row has 3 fields"},
        {"1,2\n3,abc\n", "bad.csv:2: field 2 is 'abc', not a number"},
        {"1,2\n3,4x\n", "bad.csv:2: field 2 is '4x', not a number"},
        {"1,2\n3,0x10\n", "bad.csv:2: field 2 is '0x10', not a number"},
        {"0x10,2\n3,4\n", "bad.csv:1: field 1 is '0x10', not a number"}, /* a damaged row is no header */
        {"1 2.3.4\n3 4\n", "bad.csv:1: field 2 is '2.3.4', not a number"},
        {"1,2\n3,\n", "bad.csv:2: field 2 is empty"},
        {"1,2\n3,nan\n", "bad.csv:2: field 2 is 'nan', not a finite number"},
        {"1,2\r-inf,4\r", "bad.csv:2: field 1 is '-inf', not a finite number"},
        {"1,2\n3,1e999\n", "bad.csv:2: field 2 is '1e999', not a finite number"},
        {"0,5 1,5\n2,5 3,5\n", "bad.csv:1: field 2 holds several numbers, '5 1'; use one delimiter"},
        {"0.5;1,5\n2.5;3,5\n", "bad.csv:1: field 2 holds several numbers, '1,5'; use one delimiter in all rows, and '.'"},
        {"1.000,5;1\n", "bad.csv:1: field 1 holds several numbers"},
        {"0,5;1,5\n1,234,5;3\n", "bad.csv:2: field 1 is '1,234,5', not a number with decimal comma"},
        {"0,5;1,5\n2.5;3,5\n", "bad.csv:2: field 1 is '2.5', not a number with decimal comma, as those before"},
        {"0.5;1\n2,5;3\n", "bad.csv:2: field 1 is '2,5', not a number with decimal point, as those before"},
        {"1,2\n1.5D+0x,2\n", "bad.csv:2: field 1 is '1.5D+0x', not a number"},
        {"\xff\xfe"
         "1\0,\0",
         "UTF-16"},
        {"1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17\n", "bad.csv:1: row has 17 numbers, a point has at most 16"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        make_text("bad.csv", bad[i].text);
        assert_refused(*state, "bad.csv", NULL, PIA_E_FORMAT, bad[i].message);
    }
    make_file("binary.csv", "ab\0cd", 5);
    assert_refused(*state, "binary.csv", NULL, PIA_E_FORMAT, "is not text");
}

static void bad_rows_are_skipped_and_counted_on_request(void **state)
{
    pia_points_options options;
    pia_points_options_init(&options);
    options.skip_invalid = 1;
    pia_points_info info;
    make_text("bad.csv", "x,y\n1,2\n3\n\nnan,1\n4,5\n6,seven\n\n8,9\n1,2,3\n");
    pia_points *points = read_points(*state, "bad.csv", &options, &info);
    static const double expected[] = {1, 2, 4, 5, 8, 9};
    static const pia_index row[] = {0, 3, 5};
    assert_int_equal(info.count[0], 3);
    assert_int_equal(info.skipped, 4);
    assert_int_equal(info.part_count, 3);
    for (int i = 0; i < 6; i++) assert_near(info.points[i], expected[i], 0);
    for (int i = 0; i < 3; i++) assert_int_equal(info.row[i], row[i]);
    pia_points_destroy(points);
    make_text("good.csv", "1,2\n3,4\n");
    points = read_points(*state, "good.csv", &options, &info);
    assert_null(info.row);
    assert_int_equal(info.skipped, 0);
    pia_points_destroy(points);
    make_text("hopeless.csv", "x,y\n1,nan\n");
    assert_refused(*state, "hopeless.csv", &options, PIA_E_FORMAT, "all 1 rows are invalid");
}

static void holes_are_kept_on_request(void **state)
{
    pia_points_options options;
    pia_points_options_init(&options);
    options.allow_nan = 1;
    pia_points_info info;
    make_text("holes.csv", "1,nan\n3,4\n");
    pia_points *points = read_points(*state, "holes.csv", &options, &info);
    assert_true(isnan(info.points[1]));
    pia_points_destroy(points);
    make_text("infinite.csv", "1,inf\n3,4\n");
    assert_refused(*state, "infinite.csv", &options, PIA_E_FORMAT, "infinite.csv:1: field 2 is 'inf'");
}

static void a_matrix_becomes_a_grid_of_heights(void **state)
{
    pia_points_options options;
    pia_points_options_init(&options);
    options.grid = 1;
    pia_points_info info;
    make_text("matrix.csv", "1,2,3\n4,5,6\n");
    pia_points *points = read_points(*state, "matrix.csv", &options, &info);
    static const double expected[] = {0, 0, 1, 1, 0, 2, 2, 0, 3, 0, 1, 4, 1, 1, 5, 2, 1, 6};
    assert_int_equal(info.kind, PIA_GRID);
    assert_int_equal(info.count[0], 2);
    assert_int_equal(info.count[1], 3);
    assert_int_equal(info.dim, 3);
    for (int i = 0; i < 18; i++) assert_near(info.points[i], expected[i], 0);
    pia_points_destroy(points);
    make_text("parts.csv", "1,2\n\n4,5\n");
    assert_refused(*state, "parts.csv", &options, PIA_E_FORMAT, "has 2 parts");
}

static void files_that_cannot_be_opened_are_named(void **state)
{
    assert_refused(*state, "missing.csv", NULL, PIA_E_FILE, "missing.csv: does not exist");
    assert_refused(*state, ".", NULL, PIA_E_FILE, "is a directory");
    make_text("points.unknown", "1 2\n");
    assert_refused(*state, "points.unknown", NULL, PIA_E_ARGUMENT, "no format has this extension");
    pia_points_options options;
    pia_points_options_init(&options);
    options.format = "TXT";
    pia_points_info info;
    pia_points_destroy(read_points(*state, "points.unknown", &options, &info));
    assert_string_equal(info.format, "text");
    options.format = "jpeg";
    assert_refused(*state, "points.unknown", &options, PIA_E_ARGUMENT, "there is no format 'jpeg'");
    if (geteuid() == 0) return; /* the superuser may read everything */
    assert_int_equal(chmod(make_text("secret.csv", "1,2\n"), 0), 0);
    assert_refused(*state, "secret.csv", NULL, PIA_E_FILE, "must not be read");
}

static void many_rows_of_uneven_length_are_read(void **state)
{
    enum { ROWS = 50000 };
    FILE *file = fopen(path_of("many.txt"), "w");
    for (int i = 0; i < ROWS; i++) fprintf(file, "%d %.*f\n", i, i % 18, i / 7.0);
    fclose(file);
    pia_points_info info;
    pia_points *points = read_points(*state, "many.txt", NULL, &info);
    assert_int_equal(info.count[0], ROWS);
    for (int i = 0; i < ROWS; i++) assert_near(info.points[2 * i], i, 0);
    assert_near(info.points[2 * ROWS - 1], (ROWS - 1) / 7.0, 1e-3);
    pia_points_destroy(points);
}

static void shared_data_is_read_as_its_page_says(void **state)
{
    static const struct {
        const char *name;
        pia_index rows;
        int dim;
        double first, second;
    } file[] = {
        {"airfoil/rae2822.dat", 129, 2, 1, 0},
        {"airfoil/clarky.dat", 121, 2, 1, 0.0005993},
        {"airfoil/naca2412.dat", 69, 2, 1, 0.0012573},
        {"airfoil/e387.dat", 61, 2, 1, 0},
        {"airfoil/ag35.dat", 180, 2, 0.999998, 0.00249},
        {"airfoil/sc20714.dat", 205, 2, 1, -0.0095},
        {"series/nist_ENSO.dat", 168, 2, 12.9, 1},
        {"series/nist_Chwirut1.dat", 214, 2, 92.9, 0.5},
        {"series/nist_Gauss1.dat", 250, 2, 97.62227, 1},
        {"series/nist_Thurber.dat", 37, 2, 80.574, -3.067},
        {"nasty/crlf_semicolon.csv", 12, 2, 1, 0},
        {"nasty/tabs_comments.txt", 12, 3, 1, 0},
        {"nasty/utm_offset.csv", 60, 2, 500000, 4649776.25},
        {"nasty/one_point.csv", 1, 2, 1, 2},
        {"coast/greatbritain_wdb2.csv", 18641, 2, -3.97919, 57.9606},
    };
    for (size_t i = 0; i < sizeof file / sizeof *file; i++) {
        char path[512];
        snprintf(path, sizeof path, PIA_DATA "/%s", file[i].name);
        pia_points *points = NULL;
        pia_points_info info;
        assert_ok(*state, pia_points_read(*state, path, NULL, &points));
        pia_points_get_info(points, &info);
        assert_int_equal(info.count[0], file[i].rows);
        assert_int_equal(info.dim, file[i].dim);
        assert_int_equal(info.part_count, 1);
        assert_near(info.points[0], file[i].first, 1e-4);
        assert_near(info.points[1], file[i].second, 1e-4);
        pia_points_destroy(points);
    }
}

static void nasty_files_are_answered(void **state)
{
    static const struct {
        const char *name, *message; /* NULL: is read */
    } file[] = {{"nan_inf", "nan_inf.csv:5: field 1 is 'nan'"},
                {"ragged", "ragged.csv:3: row has 1 field"},
                {"empty", "is empty"},
                {"header_only", "holds no row of numbers"},
                {"repeated_points", NULL},
                {"all_same", NULL},
                {"two_points", NULL},
                {"three_points", NULL},
                {"tiny_1e-9", NULL},
                {"collinear", NULL},
                {"figure8", NULL},
                {"random_order_circle", NULL},
                {"grid_7x5_duplicate_row", NULL}};
    for (size_t i = 0; i < sizeof file / sizeof *file; i++) {
        char path[512];
        snprintf(path, sizeof path, PIA_DATA "/nasty/%s.csv", file[i].name);
        pia_points *points = NULL;
        pia_status status = pia_points_read(*state, path, NULL, &points);
        assert_int_equal(status, file[i].message != NULL ? PIA_E_FORMAT : PIA_OK);
        if (file[i].message != NULL) assert_non_null(strstr(pia_message(*state), file[i].message));
        pia_points_destroy(points);
    }
}

static void tables_come_back_with_the_same_bits(void **state)
{
    static const double values[] = {1.0 / 3, -2e-300, 3, 1e300, 0.1, -0.0};
    assert_ok(*state, pia_table_write(*state, path_of("table.csv"), NULL, "x,y", values, 3, 2));
    char *text = read_text(path_of("table.csv"));
    assert_string_equal(text, "x,y\n0.3333333333333333,-2e-300\n3,1e+300\n0.1,-0\n");
    free(text);
    pia_points_info info;
    pia_points *points = read_points(*state, "table.csv", NULL, &info);
    assert_memory_equal(info.points, values, sizeof values);
    assert_string_equal(info.names[0], "x");
    pia_points_destroy(points);
    assert_status(*state, pia_table_write(*state, path_of("table.json"), NULL, NULL, values, 3, 2), PIA_E_ARGUMENT);
    assert_status(*state, pia_table_write(*state, path_of("table.csv"), NULL, NULL, values, 3, 0), PIA_E_ARGUMENT);
    assert_status(*state, pia_table_write(*state, path_of("table.csv"), NULL, NULL, NULL, 3, 1), PIA_E_ARGUMENT);
}

static void models_are_written_as_samples(void **state)
{
    static const double line[] = {0, 0, 1, 2}, knots[] = {0, 0, 1, 1}, patch[] = {0, 0, 0, 1};
    const double *both[] = {knots, knots};
    const int degree[] = {1, 1};
    const pia_index control[] = {2, 2};
    pia_model *curve = NULL, *surface = NULL;
    assert_ok(*state, pia_model_create(*state, 1, degree, both, control, 2, line, NULL, &curve));
    assert_ok(*state, pia_model_create(*state, 2, degree, both, control, 1, patch, NULL, &surface));
    const pia_model *curves[] = {curve, curve};
    const pia_model *surfaces[] = {surface, curve};
    assert_ok(*state, pia_model_write(*state, path_of("curve.csv"), NULL, curves, 2, 3));
    char *text = read_text(path_of("curve.csv"));
    assert_string_equal(text, "u,x,y\n0,0,0\n0.5,0.5,1\n1,1,2\n\n0,0,0\n0.5,0.5,1\n1,1,2\n");
    free(text);
    assert_ok(*state, pia_model_write(*state, path_of("surface.csv"), NULL, surfaces, 1, 2));
    text = read_text(path_of("surface.csv"));
    assert_string_equal(text, "u,v,x\n0,0,0\n0,1,0\n1,0,0\n1,1,1\n");
    free(text);
    assert_status(*state, pia_model_write(*state, path_of("mixed.csv"), NULL, surfaces, 2, 2), PIA_E_SHAPE);
    assert_status(*state, pia_model_write(*state, path_of("few.csv"), NULL, curves, 1, 1), PIA_E_ARGUMENT);
    assert_ok(*state, pia_model_write(*state, path_of("auto.csv"), NULL, curves, 1, PIA_AUTO));
    pia_points_info info;
    pia_points_destroy(read_points(*state, "auto.csv", NULL, &info));
    assert_true(info.count[0] >= 64);
    pia_model_destroy(curve);
    pia_model_destroy(surface);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(every_delimiter_is_recognised),
        IN_FOLDER(headers_titles_comments_and_marks_are_skipped),
        IN_FOLDER(columns_of_text_are_left_out),
        IN_FOLDER(blank_lines_end_parts),
        IN_FOLDER(contours_are_parts_as_between_blank_lines),
        IN_FOLDER(a_matrix_of_heights_has_no_contours),
        IN_FOLDER(columns_are_chosen_by_name_or_number),
        IN_FOLDER(names_may_stand_in_a_comment),
        IN_FOLDER(exponents_of_fortran_and_decimal_commas_are_read),
        IN_FOLDER(bad_rows_are_refused_with_their_line),
        IN_FOLDER(bad_rows_are_skipped_and_counted_on_request),
        IN_FOLDER(holes_are_kept_on_request),
        IN_FOLDER(a_matrix_becomes_a_grid_of_heights),
        IN_FOLDER(files_that_cannot_be_opened_are_named),
        IN_FOLDER(many_rows_of_uneven_length_are_read),
        IN_FOLDER(shared_data_is_read_as_its_page_says),
        IN_FOLDER(nasty_files_are_answered),
        IN_FOLDER(tables_come_back_with_the_same_bits),
        IN_FOLDER(models_are_written_as_samples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
