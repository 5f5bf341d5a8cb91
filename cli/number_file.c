#include "number_file.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char SEPARATORS[] = " \t,;\r\n";

/* A text file being read; `value` grows. */
struct reading {
    const char *path;
    double *value;
    pia_index count, room, limit; /* reading ends after `limit` values */
    pia_index first_row, rows, line;
};

static int push(struct reading *reading, double value)
{
    if (reading->count == reading->room) {
        pia_index room = reading->room ? 2 * reading->room : 64;
        double *grown = realloc(reading->value, (size_t)room * sizeof *grown);
        if (!grown) return EXIT_MEMORY;
        reading->value = grown;
        reading->room = room;
    }
    reading->value[reading->count++] = value;
    return EXIT_DONE;
}

static int read_row(struct reading *reading, char *text)
{
    pia_index before = reading->count;
    text[strcspn(text, "#")] = 0;
    if (reading->line == 1 && strncmp(text, "\xEF\xBB\xBF", 3) == 0) text += 3;
    for (text += strspn(text, SEPARATORS); *text && reading->count < reading->limit; text += strspn(text, SEPARATORS)) {
        char *end;
        double value = strtod(text, &end);
        int whole = end != text && (!*end || strchr(SEPARATORS, *end));
        if (!whole && reading->rows == 0 && reading->count == before && end == text) return EXIT_DONE; /* the heading */
        if (!whole || !isfinite(value))
            return fail(EXIT_DATA, "%s:%lld: '%.*s' is not a finite number; correct the line", reading->path, (long long)reading->line,
                        (int)strcspn(text, SEPARATORS), text);
        if (push(reading, value)) return fail(EXIT_MEMORY, "%s: out of memory; use fewer numbers", reading->path);
        text = end;
    }
    if (reading->count == before) return EXIT_DONE;
    if (reading->rows++ == 0) reading->first_row = reading->count;
    return EXIT_DONE;
}

static int read_text(struct reading *reading)
{
    int standard = strcmp(reading->path, "-") == 0;
    FILE *stream = standard ? stdin : fopen(reading->path, "r");
    if (!stream) return fail(EXIT_FILE, "%s: %s; check the name", reading->path, strerror(errno));
    char *text = NULL;
    size_t room = 0;
    int code = EXIT_DONE;
    while (!code && reading->count < reading->limit && getline(&text, &room, stream) >= 0) {
        reading->line++;
        code = read_row(reading, text);
    }
    if (!code && ferror(stream)) code = fail(EXIT_FILE, "%s: %s; cannot be read", reading->path, strerror(errno));
    free(text);
    if (!standard) fclose(stream);
    return code;
}

static int is_npy(const char *path)
{
    size_t length = strlen(path);
    return length > 4 && strcmp(path + length - 4, ".npy") == 0;
}

/* A wide matrix can only be read as a grid of heights, whose third component is the number. */
static int read_npy(struct session *session, const char *path, struct numbers *out)
{
    pia_points *points = NULL;
    pia_points_options options;
    pia_points_options_init(&options);
    pia_status status = pia_points_read(session->context, path, &options, &points);
    int heights = status == PIA_E_FORMAT || status == PIA_E_SHAPE || status == PIA_E_DATA;
    if (heights) {
        options.grid = 1;
        status = pia_points_read(session->context, path, &options, &points);
    }
    if (status) return session_check(session, status, path);
    pia_points_info info = {.struct_size = sizeof info};
    pia_points_get_info(points, &info);
    pia_index count = info.count[0] * info.count[1], width = heights ? 1 : info.dim;
    out->rows = info.count[0];
    out->first_row = heights ? info.count[1] : width;
    out->count = count * width;
    out->value = session_keep(session, (size_t)out->count, sizeof *out->value);
    for (pia_index i = 0; i < out->count; i++) out->value[i] = heights ? info.points[3 * i + 2] : info.points[i];
    pia_points_destroy(points);
    return EXIT_DONE;
}

int numbers_read(struct session *session, const char *path, struct numbers *out)
{
    *out = (struct numbers){.path = path};
    if (is_npy(path)) return read_npy(session, path, out);
    struct reading reading = {.path = path, .limit = INT64_MAX};
    int code = read_text(&reading);
    if (!code && reading.count == 0) code = fail(EXIT_DATA, "%s: holds no numbers; write one a line", path);
    if (!code) {
        out->value = session_keep(session, (size_t)reading.count, sizeof *out->value);
        memcpy(out->value, reading.value, (size_t)reading.count * sizeof *out->value);
        out->count = reading.count;
        out->first_row = reading.first_row;
        out->rows = reading.rows;
    }
    free(reading.value);
    return code;
}

/* Lines are not remembered, so that a file of ten million numbers costs no more than its numbers: the file is read again up to the
 * value. */
const char *numbers_place(struct session *session, const struct numbers *numbers, pia_index index)
{
    struct reading reading = {.path = numbers->path, .limit = index + 1};
    int again = access(numbers->path, R_OK) == 0 && !is_npy(numbers->path) && read_text(&reading) == EXIT_DONE;
    free(reading.value);
    return again ? session_text(session, "%s:%lld", numbers->path, (long long)reading.line)
                 : session_text(session, "%s: value %lld", numbers->path, (long long)index);
}

int numbers_check_order(struct session *session, const struct numbers *numbers, pia_index first, pia_index count, const char *what)
{
    for (pia_index i = first + 1; i < first + count; i++)
        if (numbers->value[i] < numbers->value[i - 1])
            return fail(EXIT_DATA, "%s: %s %g follows %g; %ss must not decrease", numbers_place(session, numbers, i), what,
                        numbers->value[i], numbers->value[i - 1], what);
    return EXIT_DONE;
}
