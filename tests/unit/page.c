/* The interactive report as a file: what it holds, decoded again by code of its own; what the page shows of it is tested in a browser
 * (tests/page). */
#include "files.h"

#include <jansson.h>
#include <zlib.h>

/* ---- A page read back ---- */

typedef struct page {
    char *text; /* the whole file */
    json_t *head;
    unsigned char *data;
    size_t size;
} page;

/* The text of the script element with this id, NUL-terminated; the caller frees it. */
static char *element_text(const char *text, const char *id)
{
    char mark[64];
    snprintf(mark, sizeof mark, "id=\"%s\">", id);
    const char *begin = strstr(text, mark);
    assert_non_null(begin);
    begin += strlen(mark);
    const char *end = strstr(begin, "</script>");
    assert_non_null(end);
    return strndup(begin, (size_t)(end - begin));
}

static unsigned char *decode_base64(const char *text, size_t *size)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    size_t length = strlen(text);
    unsigned char *out = malloc(length + 1);
    assert_int_equal(length % 4, 0);
    *size = 0;
    for (size_t i = 0; i < length; i += 4) {
        unsigned value = 0;
        int letters_seen = 0;
        for (size_t k = i; k < i + 4; k++) {
            const char *at = text[k] != '=' ? strchr(letters, text[k]) : NULL;
            assert_true(at != NULL || (text[k] == '=' && i + 4 == length));
            value = value << 6 | (at != NULL ? (unsigned)(at - letters) : 0);
            letters_seen += at != NULL;
        }
        for (int byte = 0; byte < letters_seen - 1; byte++) out[(*size)++] = (unsigned char)(value >> (16 - 8 * byte));
    }
    return out;
}

static page read_page(const char *path)
{
    page p = {.text = read_text(path)};
    char *head = element_text(p.text, "pia-head"), *data = element_text(p.text, "pia-data");
    json_error_t error;
    p.head = json_loads(head, JSON_REJECT_DUPLICATES, &error);
    if (p.head == NULL) fail_msg("line %d column %d: %s", error.line, error.column, error.text);
    size_t packed;
    unsigned char *bytes = decode_base64(data, &packed);
    uLongf room = 1 << 26;
    p.data = malloc(room);
    assert_int_equal(uncompress(p.data, &room, bytes, packed), Z_OK);
    p.size = room;
    free(bytes);
    free(head);
    free(data);
    return p;
}

static void close_page(page *p)
{
    json_decref(p->head);
    free(p->text);
    free(p->data);
}

static json_int_t whole(const json_t *object, const char *key)
{
    return json_integer_value(json_object_get(object, key));
}

static double element(const json_t *object, const char *key, size_t index)
{
    return json_number_value(json_array_get(json_object_get(object, key), index));
}

/* The codes of a packed lattice [components][rows x columns]; `last` is the lattice it follows. Word for word what page_pack.h says. */
static uint32_t *codes_of(const page *p, const json_t *packed, const uint32_t *last)
{
    json_int_t rows = (json_int_t)element(packed, "size", 0), columns = (json_int_t)element(packed, "size", 1);
    json_int_t components = (json_int_t)element(packed, "size", 2), planes = whole(packed, "planes"), count = rows * columns;
    const unsigned char *byte = p->data + whole(packed, "at");
    assert_true(whole(packed, "at") + count * components * planes <= (json_int_t)p->size);
    uint32_t *code = calloc((size_t)(count * components), sizeof *code);
    for (json_int_t c = 0; c < components; c++) {
        uint32_t *own = code + c * count;
        for (json_int_t i = 0; i < rows; i++)
            for (json_int_t j = 0; j < columns; j++) {
                json_int_t k = i * columns + j;
                uint32_t folded = 0;
                for (json_int_t plane = 0; plane < planes; plane++)
                    folded |= (uint32_t)byte[(c * planes + plane) * count + k] << (8 * plane);
                uint32_t rest = folded & 1 ? ~(folded >> 1) : folded >> 1;
                own[k] = rest + (j > 0 ? own[k - 1] : 0) + (i > 0 ? own[k - columns] : 0) - (i > 0 && j > 0 ? own[k - columns - 1] : 0);
            }
        for (json_int_t k = 0; k < count && json_is_true(json_object_get(packed, "follows")); k++) own[k] += last[c * count + k];
    }
    return code;
}

/* Values [rows x columns x components] of a packed lattice; NULL `last` unless it follows one. */
static double *values_of(const page *p, const json_t *packed, size_t *count)
{
    uint32_t *code = codes_of(p, packed, NULL);
    size_t components = (size_t)element(packed, "size", 2), nodes = (size_t)(element(packed, "size", 0) * element(packed, "size", 1));
    double none = ldexp(1, (int)whole(packed, "bits")) - 1, *value = malloc(nodes * components * sizeof *value);
    for (size_t c = 0; c < components; c++)
        for (size_t k = 0; k < nodes; k++)
            value[k * components + c] =
                code[c * nodes + k] == none ? NAN : element(packed, "low", c) + element(packed, "step", c) * code[c * nodes + k];
    free(code);
    if (count != NULL) *count = nodes;
    return value;
}

/* ---- Models ---- */

static void even_knots(int degree, pia_index control, double *knots)
{
    for (pia_index i = 0; i < control + degree + 1; i++)
        knots[i] = fmin(fmax((double)(i - degree), 0), (double)(control - degree)) / (double)(control - degree);
}

static pia_model *make_curve(pia_context *context, pia_index control, int dim)
{
    const int degree = 3;
    double *knots = malloc((size_t)(control + 4) * sizeof *knots), *points = malloc((size_t)(control * dim) * sizeof *points);
    even_knots(degree, control, knots);
    for (pia_index i = 0; i < control * dim; i++) points[i] = (double)(i / dim) * (i % dim == 0) + sin(0.9 * (double)i);
    pia_model *model = NULL;
    assert_ok(context, pia_model_create(context, 1, &degree, (const double *const[]){knots}, &control, dim, points, NULL, &model));
    free(knots);
    free(points);
    return model;
}

/* Hills over the unit square, moved up by `lift` times their steepness. */
static pia_model *make_hills(pia_context *context, pia_index side, double lift)
{
    const int degree[2] = {3, 3};
    const pia_index control[2] = {side, side};
    double *knots = malloc((size_t)(side + 4) * sizeof *knots), *points = malloc((size_t)(side * side * 3) * sizeof *points),
           *to = points;
    even_knots(3, side, knots);
    for (pia_index i = 0; i < side; i++)
        for (pia_index j = 0; j < side; j++) {
            double u = (double)i / (double)(side - 1), v = (double)j / (double)(side - 1);
            *to++ = u;
            *to++ = v;
            *to++ = 0.2 * sin(9 * u) * cos(7 * v) + 0.01 * sin(91 * u + 57 * v) + lift * cos(13 * u * v);
        }
    pia_model *model = NULL;
    assert_ok(context, pia_model_create(context, 2, degree, (const double *const[]){knots, knots}, control, 3, points, NULL, &model));
    free(knots);
    free(points);
    return model;
}

static void write_one(pia_context *context, const char *path, const pia_model *model, const double *points, pia_index count,
                      const pia_page_options *options)
{
    assert_ok(context, pia_page_write(context, path, &model, 1, points, count, options));
}

static size_t file_size(const char *path)
{
    char *text = read_text(path);
    size_t size = strlen(text);
    free(text);
    return size;
}

/* ---- Tests ---- */

static void a_page_holds_the_model_and_its_points(void **state)
{
    pia_model *model = make_curve(*state, 12, 2);
    double parameters[40], points[80], control[24];
    for (int i = 0; i < 40; i++) parameters[i] = i / 39.0;
    assert_ok(*state, pia_model_eval(*state, model, parameters, 40, 0, points));
    points[2 * 17 + 1] += 0.25;
    pia_page_options options;
    pia_page_options_init(&options);
    options.parameters = parameters;
    write_one(*state, path_of("a.html"), model, points, 40, &options);

    page p = read_page(path_of("a.html"));
    const json_t *figure = json_array_get(json_object_get(p.head, "figures"), 0), *data = json_object_get(p.head, "data");
    size_t count;
    double *value = values_of(&p, json_object_get(figure, "points"), &count);
    pia_model_control(model, control, NULL);
    assert_int_equal(count, 12);
    for (int i = 0; i < 24; i++) assert_near(value[i], control[i], 1e-8);
    free(value);
    value = values_of(&p, json_array_get(json_object_get(figure, "knots"), 0), &count);
    for (int i = 0; i < 16; i++) assert_near(value[i], pia_model_knots(model, 0)[i], 1e-9);
    free(value);
    value = values_of(&p, json_object_get(data, "position"), &count);
    assert_int_equal(count, 40);
    for (int i = 0; i < 80; i++) assert_near(value[i], points[i], 1e-8);
    free(value);
    assert_near(json_number_value(json_object_get(data, "largest")), 0.25, 1e-12);
    assert_int_equal(whole(data, "worst"), 17);
    value = values_of(&p, json_object_get(data, "deviation"), &count);
    for (int i = 0; i < 40; i++) assert_near(fabs(value[i]), i == 17 ? 0.25 : 0, 1e-7);
    free(value);
    close_page(&p);
    pia_model_destroy(model);
}

/* Elements that would ask the network, and the number of scripts: data cannot open one. */
static void a_page_needs_nothing_but_itself(void **state)
{
    pia_model *model = make_curve(*state, 8, 2);
    write_one(*state, path_of("a.html"), model, NULL, 0, NULL);
    page p = read_page(path_of("a.html"));
    static const char *const forbidden[] = {" src=", "<link", "@import", "url(", "fetch(", "<iframe"};
    for (size_t i = 0; i < sizeof forbidden / sizeof *forbidden; i++)
        if (strstr(p.text, forbidden[i]) != NULL) fail_msg("the page has %s", forbidden[i]);
    assert_non_null(strstr(p.text, "three.js authors"));
    assert_non_null(strstr(p.text, "Permission is hereby granted"));
    assert_null(strstr(p.text, "<!--pia:"));
    close_page(&p);
    pia_model_destroy(model);
}

static int occurrences(const char *text, const char *word)
{
    int count = 0;
    while ((text = strstr(text, word)) != NULL) {
        count++;
        text++;
    }
    return count;
}

static void texts_cannot_leave_their_place(void **state)
{
    static const char evil[] = "</script><script>alert(1)</script><!-- \"q\" \\ & \x01 \t H\u00f6he \u4e2d\u6587 ]]>";
    pia_model *model = make_curve(*state, 8, 2);
    const pia_page_setting setting = {evil, evil, NULL};
    pia_page_options options;
    pia_page_options_init(&options);
    write_one(*state, path_of("plain.html"), model, NULL, 0, &options);
    options.title = options.source = options.command = evil;
    options.settings = &setting;
    options.setting_count = 1;
    write_one(*state, path_of("evil.html"), model, NULL, 0, &options);
    page plain = read_page(path_of("plain.html")), p = read_page(path_of("evil.html"));
    assert_int_equal(occurrences(p.text, "<script"), occurrences(plain.text, "<script"));
    assert_int_equal(occurrences(p.text, "</script"), occurrences(plain.text, "</script"));
    assert_int_equal(occurrences(p.text, "<!--"), occurrences(plain.text, "<!--"));
    assert_string_equal(json_string_value(json_object_get(p.head, "title")), evil);
    assert_string_equal(json_string_value(json_object_get(p.head, "command")), evil);
    const json_t *row = json_array_get(json_object_get(p.head, "settings"), 0);
    assert_string_equal(json_string_value(json_array_get(row, 1)), evil);
    assert_true(json_is_null(json_array_get(row, 2)));
    assert_non_null(strstr(p.text, "<title>&#60;/script&#62;"));
    close_page(&plain);
    close_page(&p);
    pia_model_destroy(model);
}

static void holes_are_left_out_and_rows_keep_their_names(void **state)
{
    pia_model *model = make_hills(*state, 5, 0);
    double points[4][3] = {{0.1, 0.1, 0}, {0.2, NAN, 0}, {0.3, 0.3, 0}, {0.5, 0.5, 0}};
    const pia_index rows[4] = {100, 200, 300, 400}, met[2] = {1, 3};
    pia_page_options options;
    pia_page_options_init(&options);
    options.rows = rows;
    options.met = met;
    options.met_count = 2;
    write_one(*state, path_of("a.html"), model, &points[0][0], 4, &options);
    page p = read_page(path_of("a.html"));
    const json_t *data = json_object_get(p.head, "data");
    size_t count;
    double *row = values_of(&p, json_object_get(data, "row"), &count);
    assert_int_equal(count, 3);
    assert_near(row[0], 100, 0);
    assert_near(row[1], 300, 0);
    assert_near(row[2], 400, 0);
    free(row);
    const json_t *marks = json_object_get(p.head, "met");
    assert_int_equal(json_array_size(marks), 1);
    assert_near(json_number_value(json_array_get(json_array_get(marks, 0), 0)), 0.5, 0);
    close_page(&p);
    pia_model_destroy(model);
}

static void deviations_have_a_side_where_there_are_sides(void **state)
{
    pia_model *hills = make_hills(*state, 6, 0), *space = make_curve(*state, 8, 3);
    const double parameters[4] = {0.3, 0.4, 0.6, 0.7};
    double points[6];
    assert_ok(*state, pia_model_eval(*state, hills, parameters, 2, 0, points));
    points[2] += 0.5;
    points[5] -= 0.25;
    pia_page_options options;
    pia_page_options_init(&options);
    options.parameters = parameters;
    write_one(*state, path_of("a.html"), hills, points, 2, &options);
    page p = read_page(path_of("a.html"));
    const json_t *data = json_object_get(p.head, "data");
    double *value = values_of(&p, json_object_get(data, "deviation"), NULL);
    assert_true(json_is_true(json_object_get(data, "sides")));
    assert_near(value[0], 0.5, 1e-7);
    assert_near(value[1], -0.25, 1e-7);
    free(value);
    size_t nodes;
    const json_t *map = json_object_get(json_array_get(json_object_get(data, "maps"), 0), "map");
    value = values_of(&p, map, &nodes);
    double low = 0, high = 0;
    for (size_t k = 0; k < nodes; k++) {
        low = fmin(low, value[k]);
        high = fmax(high, value[k]);
    }
    assert_near(high, 0.5, 1e-4);
    assert_near(low, -0.25, 1e-4);
    free(value);
    close_page(&p);

    write_one(*state, path_of("b.html"), space, points, 2, NULL);
    p = read_page(path_of("b.html"));
    assert_true(json_is_false(json_object_get(json_object_get(p.head, "data"), "sides")));
    close_page(&p);
    pia_model_destroy(hills);
    pia_model_destroy(space);
}

static void of_many_points_the_farthest_stay(void **state)
{
    enum { COUNT = 100000 };
    pia_model *model = make_curve(*state, 9, 2);
    double *parameters = malloc(COUNT * sizeof *parameters), *points = malloc(2 * COUNT * sizeof *points);
    for (int i = 0; i < COUNT; i++) parameters[i] = (double)i / (COUNT - 1);
    assert_ok(*state, pia_model_eval(*state, model, parameters, COUNT, 0, points));
    for (int i = 0; i < COUNT; i += 1000) points[2 * i + 1] += 1e-3 * (1 + i % 7);
    pia_page_options options;
    pia_page_options_init(&options);
    options.parameters = parameters;
    write_one(*state, path_of("a.html"), model, points, COUNT, &options);
    page p = read_page(path_of("a.html"));
    const json_t *data = json_object_get(p.head, "data");
    size_t count, moved = 0;
    double *row = values_of(&p, json_object_get(data, "row"), &count);
    assert_int_equal(whole(data, "count"), COUNT);
    assert_int_equal(count, 16000);
    for (size_t k = 0; k < count; k++) moved += (int)row[k] % 1000 == 0;
    assert_int_equal(moved, COUNT / 1000);
    json_int_t binned = 0;
    const json_t *bins = json_object_get(json_object_get(data, "histogram"), "counts");
    for (size_t k = 0; k < json_array_size(bins); k++) binned += json_integer_value(json_array_get(bins, k));
    assert_int_equal(binned, COUNT);
    free(row);
    free(parameters);
    free(points);
    close_page(&p);
    pia_model_destroy(model);
}

static void frames_follow_each_other(void **state)
{
    enum { FRAMES = 5, SIDE = 6 };
    pia_model *frame[FRAMES];
    for (int k = 0; k < FRAMES; k++) frame[k] = make_hills(*state, SIDE + (k == 0), ldexp(0.1, -k));
    pia_page_options options;
    pia_page_options_init(&options);
    options.frames = (const pia_model *const *)frame;
    options.frame_count = FRAMES;
    write_one(*state, path_of("a.html"), frame[FRAMES - 1], NULL, 0, &options);
    page p = read_page(path_of("a.html"));
    const json_t *frames = json_object_get(json_array_get(json_object_get(p.head, "figures"), 0), "frames");
    assert_int_equal(json_array_size(frames), FRAMES);
    uint32_t *last = NULL;
    for (int k = 0; k < FRAMES; k++) {
        const json_t *packed = json_object_get(json_array_get(frames, (size_t)k), "points");
        assert_int_equal(json_is_true(json_object_get(packed, "follows")), k > 1); /* the first is of another size */
        uint32_t *code = codes_of(&p, packed, last);
        free(last);
        last = code;
        double control[3 * (SIDE + 1) * (SIDE + 1)];
        pia_model_control(frame[k], control, NULL);
        int nodes = k == 0 ? (SIDE + 1) * (SIDE + 1) : SIDE * SIDE;
        for (int i = 0; i < 3 * nodes; i++) {
            size_t c = (size_t)i % 3;
            assert_near(element(packed, "low", c) + element(packed, "step", c) * code[c * (size_t)nodes + (size_t)i / 3], control[i],
                        1e-6);
        }
    }
    free(last);
    close_page(&p);
    for (int k = 0; k < FRAMES; k++) pia_model_destroy(frame[k]);
}

static void a_large_net_stays_within_a_megabyte_and_its_replay_within_two(void **state)
{
    enum { SIDE = 200, FRAMES = 24, ROWS = 300 };
    pia_model *model = make_hills(*state, SIDE, 0), *frame[FRAMES];
    double *parameters = malloc(2 * ROWS * ROWS * sizeof *parameters), *points = malloc(3 * ROWS * ROWS * sizeof *points);
    for (int i = 0; i < ROWS * ROWS; i++) {
        parameters[2 * i] = i / ROWS / (ROWS - 1.0);
        parameters[2 * i + 1] = i % ROWS / (ROWS - 1.0);
    }
    assert_ok(*state, pia_model_eval(*state, model, parameters, ROWS * ROWS, 0, points));
    unsigned noise = 1;
    for (int i = 0; i < ROWS * ROWS; i++) points[3 * i + 2] += 1e-3 * ((noise = noise * 1664525U + 1013904223U) / 4294967296.0 - 0.5);
    pia_page_options options;
    pia_page_options_init(&options);
    options.parameters = parameters;
    write_one(*state, path_of("a.html"), model, points, ROWS * ROWS, &options);
    size_t still = file_size(path_of("a.html"));
    for (int k = 0; k < FRAMES; k++) frame[k] = make_hills(*state, SIDE, ldexp(0.2, -k));
    options.frames = (const pia_model *const *)frame;
    options.frame_count = FRAMES;
    write_one(*state, path_of("b.html"), model, points, ROWS * ROWS, &options);
    size_t moving = file_size(path_of("b.html"));
    print_message("a 200 x 200 net: %zu bytes, with 24 frames %zu\n", still, moving);
    assert_in_range(still, 200000, 1000000);
    assert_in_range(moving, still, 2000000);
    for (int k = 0; k < FRAMES; k++) pia_model_destroy(frame[k]);
    free(parameters);
    free(points);
    pia_model_destroy(model);
}

static void a_refused_page_leaves_the_old_file(void **state)
{
    pia_model *model = make_curve(*state, 8, 2);
    const char *path = make_text("a.html", "old");
    const pia_index rows[1] = {8}, start[2] = {0, 2};
    const double points[2] = {0, 0};
    pia_page_options options;
    pia_page_options_init(&options);
    assert_int_equal(pia_page_write(*state, path, NULL, 0, NULL, 0, &options), PIA_E_ARGUMENT);
    assert_int_equal(pia_page_write(*state, path, (const pia_model *const[]){NULL}, 1, NULL, 0, &options), PIA_E_ARGUMENT);
    assert_int_equal(pia_page_write(*state, path, (const pia_model *const[]){model}, 1, NULL, 3, &options), PIA_E_ARGUMENT);
    options.unsupported = rows;
    options.unsupported_count = 1;
    assert_int_equal(pia_page_write(*state, path, (const pia_model *const[]){model}, 1, points, 1, &options), PIA_E_ARGUMENT);
    assert_non_null(strstr(pia_message(*state), "unsupported: number 0 is 8; 0 to 7"));
    options.unsupported_count = 0;
    options.corners = rows;
    options.corner_count = 1;
    assert_int_equal(pia_page_write(*state, path, (const pia_model *const[]){model}, 1, points, 1, &options), PIA_E_ARGUMENT);
    options.corner_count = 0;
    options.frame_start = start;
    assert_int_equal(pia_page_write(*state, path, (const pia_model *const[]){model}, 1, points, 1, &options), PIA_E_ARGUMENT);
    char *text = read_text(path);
    assert_string_equal(text, "old");
    free(text);
    pia_model_destroy(model);
}

/* Shapes that give every step and every range 0, extremes, and what is not there. */
static void degenerate_models_have_pages_too(void **state)
{
    const int degree = 1;
    const pia_index control = 2;
    const double knots[4] = {0, 0, 1, 1}, same[4] = {3, 3, 3, 3}, far[2] = {1e149, -1e149}, away[2] = {3, 3 + 1e-9};
    pia_model *point = NULL, *graph = NULL;
    assert_ok(*state, pia_model_create(*state, 1, &degree, (const double *const[]){knots}, &control, 2, same, NULL, &point));
    assert_ok(*state, pia_model_create(*state, 1, &degree, (const double *const[]){knots}, &control, 1, far, NULL, &graph));
    write_one(*state, path_of("a.html"), point, away, 1, NULL);
    page p = read_page(path_of("a.html"));
    assert_null(strstr(p.text, ":nan"));
    close_page(&p);
    write_one(*state, path_of("b.html"), graph, NULL, 0, NULL);
    p = read_page(path_of("b.html"));
    const json_t *figure = json_array_get(json_object_get(p.head, "figures"), 0);
    double *value = values_of(&p, json_object_get(figure, "points"), NULL);
    assert_near(value[1], 1e149, 1e141);
    assert_near(value[3], -1e149, 1e141);
    free(value);
    close_page(&p);
    pia_model_destroy(point);
    pia_model_destroy(graph);
}

static void plots_with_the_extension_html_are_pages(void **state)
{
    pia_model *model = make_curve(*state, 8, 2);
    pia_plot_options options;
    pia_plot_options_init(&options);
    options.title = "As a page";
    assert_ok(*state, pia_plot(*state, path_of("a.html"), (const pia_model *const[]){model}, 1, NULL, 0, &options));
    page p = read_page(path_of("a.html"));
    assert_string_equal(json_string_value(json_object_get(p.head, "title")), "As a page");
    close_page(&p);
    pia_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(a_page_holds_the_model_and_its_points),
        IN_FOLDER(a_page_needs_nothing_but_itself),
        IN_FOLDER(texts_cannot_leave_their_place),
        IN_FOLDER(holes_are_left_out_and_rows_keep_their_names),
        IN_FOLDER(deviations_have_a_side_where_there_are_sides),
        IN_FOLDER(of_many_points_the_farthest_stay),
        IN_FOLDER(frames_follow_each_other),
        IN_FOLDER(a_large_net_stays_within_a_megabyte_and_its_replay_within_two),
        IN_FOLDER(a_refused_page_leaves_the_old_file),
        IN_FOLDER(degenerate_models_have_pages_too),
        IN_FOLDER(plots_with_the_extension_html_are_pages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
