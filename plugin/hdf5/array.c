#include "reader.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DIRECTIONS = 3, BLOCK = 1 << 20 };

/* Deflate, the usual filter, makes data at most so many times smaller. */
enum { MOST_COMPRESSION = 1032 };

static int holds_numbers(hid_t set)
{
    hid_t type = H5Dget_type(set);
    H5T_class_t class = H5Tget_class(type);
    H5Tclose(type);
    return class == H5T_INTEGER || class == H5T_FLOAT;
}

static int directions_of(hid_t set, hsize_t shape[MOST_DIRECTIONS])
{
    hid_t space = H5Dget_space(set);
    int directions = H5Sget_simple_extent_ndims(space);
    if (directions < 1 || directions > MOST_DIRECTIONS || H5Sget_simple_extent_dims(space, shape, NULL) < 0) directions = 0;
    H5Sclose(space);
    return directions;
}

int is_array(hid_t set)
{
    hsize_t shape[MOST_DIRECTIONS];
    return holds_numbers(set) && directions_of(set, shape) > 0;
}

/* Values that were never written take no place in a file, so that it may claim any number of them: no more than it can hold are
 * believed. */
static void check_claim(hid_t file, hid_t set, const char *name, const hsize_t *shape, int directions)
{
    hid_t type = H5Dget_type(set);
    hsize_t size = 0;
    double bytes = (double)H5Tget_size(type);
    H5Tclose(type);
    H5Fget_filesize(file, &size);
    for (int d = 0; d < directions; d++) bytes *= (double)shape[d];
    if (bytes > (double)MOST_COMPRESSION * (double)size)
        answer_error("the array '%.80s' claims %.4g bytes, more than the %llu bytes of the file hold; copy it again", name, bytes,
                     (unsigned long long)size);
}

static void send_header(const hsize_t *shape, int directions)
{
    char text[256], head[10] = "\x93NUMPY\x01";
    int length = snprintf(text, sizeof text, "{'descr': '<f8', 'fortran_order': False, 'shape': (");
    for (int d = 0; d < directions; d++)
        length += snprintf(text + length, sizeof text - (size_t)length, "%llu,", (unsigned long long)shape[d]);
    length += snprintf(text + length, sizeof text - (size_t)length, "), }\n");
    head[8] = (char)length;
    answer_bytes(head, sizeof head);
    answer_bytes(text, (size_t)length);
}

/* Rows that are read at once: whole chunks, so that none is unpacked twice. */
static hsize_t rows_at_once(hid_t set, int directions, hsize_t row)
{
    hsize_t chunk[MOST_DIRECTIONS] = {1, 1, 1}, rows = row < BLOCK ? BLOCK / row : 1;
    hid_t layout = H5Dget_create_plist(set);
    if (H5Pget_layout(layout) != H5D_CHUNKED || H5Pget_chunk(layout, directions, chunk) < 0) chunk[0] = 1;
    H5Pclose(layout);
    return (rows + chunk[0] - 1) / chunk[0] * chunk[0];
}

static void send_values(hid_t set, const hsize_t *shape, int directions)
{
    hsize_t row = 1, begin[MOST_DIRECTIONS] = {0, 0, 0}, count[MOST_DIRECTIONS];
    memcpy(count, shape, sizeof count);
    for (int d = 1; d < directions; d++) row *= shape[d];
    if (row == 0) return;
    hsize_t most = rows_at_once(set, directions, row);
    if (most > shape[0]) most = shape[0];
    double *values = malloc((size_t)(most * row) * sizeof *values);
    hid_t space = H5Dget_space(set);
    for (; begin[0] < shape[0]; begin[0] += count[0]) {
        count[0] = shape[0] - begin[0] < most ? shape[0] - begin[0] : most;
        hid_t memory = H5Screate_simple(directions, count, NULL);
        H5Sselect_hyperslab(space, H5S_SELECT_SET, begin, NULL, count, NULL);
        if (values == NULL || H5Dread(set, H5T_IEEE_F64LE, memory, space, H5P_DEFAULT, values) < 0) exit(EXIT_FAILURE);
        H5Sclose(memory);
        answer_bytes(values, (size_t)(count[0] * row) * sizeof *values);
    }
    H5Sclose(space);
    free(values);
}

void send_array(hid_t file, hid_t set, const char *name)
{
    hsize_t shape[MOST_DIRECTIONS] = {1, 1, 1};
    if (!holds_numbers(set)) answer_error("'%.80s' holds no numbers; name another array", name);
    int directions = directions_of(set, shape);
    if (directions == 0) answer_error("the array '%.80s' has other than one to three directions; name another", name);
    check_claim(file, set, name, shape, directions);
    send_header(shape, directions);
    send_values(set, shape, directions);
}
