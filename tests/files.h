/* A folder of its own for every test that reads or writes files. Use with cmocka_unit_test_setup_teardown(test, enter_folder,
 * leave_folder): *state is then a context. */
#ifndef PIA_TESTS_FILES_H
#define PIA_TESTS_FILES_H

#include <dirent.h>
#include <stdlib.h>
#include <unistd.h>

#include "check.h"

static char test_folder[64];

static inline int enter_folder(void **state)
{
    snprintf(test_folder, sizeof test_folder, "/tmp/pia-test-XXXXXX");
    if (mkdtemp(test_folder) == NULL) return -1;
    return pia_context_create(NULL, (pia_context **)state) != PIA_OK;
}

static inline int leave_folder(void **state)
{
    char command[256];
    snprintf(command, sizeof command, "chmod -R u+rwx %s; rm -rf %s", test_folder, test_folder);
    pia_context_destroy(*state);
    return system(command);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, enter_folder, leave_folder)

/* Name inside the folder; valid until the fourth call after it. */
static inline const char *path_of(const char *name)
{
    static char path[4][sizeof test_folder + 64];
    static int turn;
    turn = (turn + 1) % 4;
    snprintf(path[turn], sizeof path[turn], "%s/%.60s", test_folder, name);
    return path[turn];
}

/* Makes a file of the folder; returns its path. */
static inline const char *make_file(const char *name, const void *bytes, size_t size)
{
    const char *path = path_of(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    return path;
}

static inline const char *make_text(const char *name, const char *text)
{
    return make_file(name, text, strlen(text));
}

/* The whole file with a NUL behind it; the caller frees it. */
static inline char *read_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    size_t size = (size_t)ftell(file);
    rewind(file);
    char *text = malloc(size + 1);
    assert_int_equal(fread(text, 1, size, file), size);
    fclose(file);
    text[size] = '\0';
    return text;
}

static inline int file_count(void)
{
    int count = 0;
    DIR *entries = opendir(test_folder);
    assert_non_null(entries);
    while (readdir(entries) != NULL) count++;
    closedir(entries);
    return count - 2; /* itself and the folder above */
}

/* Reads points of a file of the folder; the caller destroys them. */
static inline pia_points *read_points(pia_context *context, const char *name, const pia_points_options *options, pia_points_info *info)
{
    pia_points *points = NULL;
    assert_ok(context, pia_points_read(context, path_of(name), options, &points));
    pia_points_get_info(points, info);
    return points;
}

/* The file is refused with `status`, and the message holds `what` (after the folder's name). */
static inline void assert_refused(pia_context *context, const char *name, const pia_points_options *options, pia_status status,
                                  const char *what)
{
    pia_points *points = NULL;
    assert_status(context, pia_points_read(context, path_of(name), options, &points), status);
    assert_null(points);
    if (strstr(pia_message(context), what) != NULL) return;
    print_error("the message is \"%s\", it should hold \"%s\"\n", pia_message(context), what);
    fail();
}

#endif
