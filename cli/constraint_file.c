#include "constraint_file.h"

#include "join_file.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <string.h>

struct reading {
    struct session *session;
    const char *path;
    const struct row_span *span;
    int dim;
    size_t index; /* of the constraint, for messages */
};

static int refuse(const struct reading *reading, const char *what)
{
    return fail(EXIT_DATA, "%s: constraint %zu: %s; correct the file", reading->path, reading->index, what);
}

/* One or two numbers; 0 when it is something else. */
static int read_pair(const json_t *item, double out[2])
{
    if (json_is_number(item)) {
        out[0] = json_number_value(item);
        return 1;
    }
    if (json_array_size(item) != 2) return 0;
    for (size_t i = 0; i < 2; i++) {
        if (!json_is_number(json_array_get(item, i))) return 0;
        out[i] = json_number_value(json_array_get(item, i));
    }
    return 1;
}

/* *skip = 1: the row lies in another part. */
static int read_place(const struct reading *reading, const json_t *at, pia_constraint *out, int *skip)
{
    *skip = 0;
    if (!json_is_integer(at))
        return read_pair(at, out->at_parameter) ? EXIT_DONE : refuse(reading, "\"at\" must be a row, a parameter or [u,v]");
    pia_index row = json_integer_value(at);
    if (row < 0 || row >= reading->span->total) return refuse(reading, "\"at\" names a row that the points do not have");
    out->at_point = row_in_span(reading->span, row);
    *skip = out->at_point < 0;
    return EXIT_DONE;
}

static int read_derivative(const struct reading *reading, const json_t *item, pia_constraint *out)
{
    double order[2] = {0, 0};
    if (!item) return EXIT_DONE;
    int known = read_pair(item, order);
    for (int d = 0; d < 2; d++) {
        known = known && order[d] >= 0 && order[d] <= PIA_MAX_DEGREE && order[d] == floor(order[d]);
        if (known) out->derivative[d] = (int)order[d];
    }
    return known ? EXIT_DONE : refuse(reading, "\"derivative\" must be an order such as 1, or two such as [1,0]");
}

static int read_value(const struct reading *reading, const json_t *item, pia_constraint *out)
{
    if (!item) return EXIT_DONE;
    int single = json_is_number(item) && reading->dim == 1;
    if (!single && json_array_size(item) != (size_t)reading->dim)
        return fail(EXIT_DATA, "%s: constraint %zu: \"value\" must be a list of %d numbers, as the points have; correct it",
                    reading->path, reading->index, reading->dim);
    double *value = session_keep(reading->session, (size_t)reading->dim, sizeof *value);
    for (int k = 0; k < reading->dim; k++) {
        const json_t *number = single ? item : json_array_get(item, (size_t)k);
        if (!json_is_number(number)) return refuse(reading, "\"value\" holds something that is no number");
        value[k] = json_number_value(number);
    }
    out->value = value;
    return EXIT_DONE;
}

static int read_constraint(const struct reading *reading, json_t *item, pia_constraint *out, int *skip)
{
    const char *key;
    json_t *member;
    if (!json_is_object(item)) return refuse(reading, "must be an object {\"at\": ..., \"value\": ...}");
    json_object_foreach(item, key, member)
    {
        (void)member;
        int known = !strcmp(key, "at") || !strcmp(key, "derivative") || !strcmp(key, "value") || !strcmp(key, "direction");
        if (!known)
            return fail(EXIT_DATA, "%s: constraint %zu: unknown key \"%s\"; at, derivative, value, direction", reading->path,
                        reading->index, key);
    }
    pia_constraint_init(out);
    out->direction_only = json_is_true(json_object_get(item, "direction"));
    int code = read_place(reading, json_object_get(item, "at"), out, skip);
    if (!code) code = read_derivative(reading, json_object_get(item, "derivative"), out);
    if (!code) code = read_value(reading, json_object_get(item, "value"), out);
    int data_point = out->at_point != PIA_AUTO && !out->derivative[0] && !out->derivative[1];
    if (!code && !out->value && !data_point && !*skip)
        code = refuse(reading, "\"value\" is missing, for only the point of a row is known");
    return code;
}

static int read_entry(struct reading *reading, json_t *item, struct constraint_file *out)
{
    if (json_object_get(item, "join")) {
        const char *place = session_text(reading->session, "%s: constraint %zu", reading->path, reading->index);
        pia_index next = out->join_count++;
        return join_file_read(reading->session, place, item, &out->neighbour[next], &out->join[next]);
    }
    int skip = 0, code = read_constraint(reading, item, &out->constraint[out->constraint_count], &skip);
    if (!skip) out->constraint_count++;
    return code;
}

static int read_list(struct reading *reading, const json_t *list, struct constraint_file *out)
{
    if (!json_is_array(list)) return fail(EXIT_DATA, "%s: is no list of constraints; write [...] around them", reading->path);
    size_t count = json_array_size(list);
    out->constraint = session_keep(reading->session, count, sizeof *out->constraint);
    out->join = session_keep(reading->session, count, sizeof *out->join);
    out->neighbour = session_keep(reading->session, count, sizeof *out->neighbour);
    for (reading->index = 0; reading->index < count; reading->index++) {
        int code = read_entry(reading, json_array_get(list, reading->index), out);
        if (code) return code;
    }
    return EXIT_DONE;
}

int constraint_file_read(struct session *session, const char *path, const struct row_span *span, int dim, struct constraint_file *out)
{
    json_error_t error;
    struct reading reading = {.session = session, .path = path, .span = span, .dim = dim};
    *out = (struct constraint_file){.join_count = 0};
    FILE *stream = strcmp(path, "-") == 0 ? stdin : fopen(path, "r");
    if (!stream) return fail(EXIT_FILE, "%s: %s; check the name", path, strerror(errno));
    json_t *list = json_loadf(stream, JSON_REJECT_DUPLICATES, &error);
    if (stream != stdin) fclose(stream);
    if (!list) return fail(EXIT_DATA, "%s:%d: %s; correct the JSON", path, error.line, error.text);
    int code = read_list(&reading, list, out);
    json_decref(list);
    return code;
}

void constraint_file_close(struct constraint_file *file)
{
    for (pia_index i = 0; i < file->join_count; i++) models_close(&file->neighbour[i]);
    file->join_count = 0;
}
