#include "files.h"

#include "output.h"

#include <fcntl.h>
#include <sys/stat.h>

static void assert_holds(const char *path, const char *expected)
{
    char *text = read_text(path);
    assert_string_equal(text, expected);
    free(text);
}

static void write_file(pia_context *context, const char *path, const char *text)
{
    pia_output *output;
    assert_ok(context, pia_output_open(context, path, &output));
    pia_output_bytes(output, text, strlen(text));
    assert_ok(context, pia_output_commit(output));
}

static void a_new_file_holds_what_was_written(void **state)
{
    pia_output *output;
    assert_ok(*state, pia_output_open(*state, path_of("new"), &output));
    pia_output_text(output, "%d,", 7);
    pia_output_number(output, 0.1);
    pia_output_bytes(output, "\n", 1);
    assert_int_equal(access(path_of("new"), F_OK), -1);
    assert_ok(*state, pia_output_commit(output));
    assert_holds(path_of("new"), "7,0.1\n");
    assert_int_equal(file_count(), 1);
}

static void an_abandoned_output_leaves_the_old_file(void **state)
{
    write_file(*state, path_of("file"), "old");
    pia_output *output;
    assert_ok(*state, pia_output_open(*state, path_of("file"), &output));
    pia_output_text(output, "new");
    pia_output_abandon(output);
    assert_holds(path_of("file"), "old");
    assert_int_equal(file_count(), 1);
    pia_output_abandon(NULL);
}

static void a_replaced_file_keeps_its_permissions(void **state)
{
    struct stat about;
    write_file(*state, path_of("file"), "old");
    assert_int_equal(chmod(path_of("file"), 0640), 0);
    write_file(*state, path_of("file"), "new");
    assert_int_equal(stat(path_of("file"), &about), 0);
    assert_int_equal(about.st_mode & 0777, 0640);
    assert_holds(path_of("file"), "new");
}

static void a_symbolic_link_stays_a_link(void **state)
{
    struct stat about;
    write_file(*state, path_of("file"), "old");
    assert_int_equal(symlink("file", path_of("link")), 0);
    write_file(*state, path_of("link"), "new");
    assert_int_equal(lstat(path_of("link"), &about), 0);
    assert_true(S_ISLNK(about.st_mode));
    assert_holds(path_of("file"), "new");
}

static void assert_target_refused(pia_context *context, const char *path, const char *why)
{
    pia_output *output = NULL;
    assert_status(context, pia_output_open(context, path, &output), PIA_E_FILE);
    assert_null(output);
    assert_non_null(strstr(pia_message(context), why));
}

static void targets_that_cannot_be_files_are_refused(void **state)
{
    assert_target_refused(*state, test_folder, "is a directory");
    assert_target_refused(*state, path_of("missing/file"), "check that its folder exists");
    assert_target_refused(*state, "", "is empty");
    assert_int_equal(symlink("nowhere", path_of("link")), 0);
    assert_target_refused(*state, path_of("link"), "is a symbolic link to nothing");
    if (geteuid() == 0) return; /* the superuser may write everything */
    write_file(*state, path_of("file"), "old");
    assert_int_equal(chmod(path_of("file"), 0440), 0);
    assert_target_refused(*state, path_of("file"), "must not be written");
}

static void a_full_device_is_told(void **state)
{
    if (access("/dev/full", W_OK) != 0) skip();
    pia_output *output;
    assert_ok(*state, pia_output_open(*state, "/dev/full", &output));
    pia_output_text(output, "text");
    assert_status(*state, pia_output_commit(output), PIA_E_FILE);
    assert_non_null(strstr(pia_message(*state), "/dev/full: could not be written: No space left on device"));
}

static void a_device_is_written_in_place(void **state)
{
    struct stat about;
    write_file(*state, "/dev/null", "text");
    assert_int_equal(stat("/dev/null", &about), 0);
    assert_true(S_ISCHR(about.st_mode));
}

static void large_outputs_pass_the_buffer(void **state)
{
    enum { SIZE = 300000 };
    struct stat about;
    char *block = calloc(1, SIZE);
    pia_output *output;
    assert_ok(*state, pia_output_open(*state, path_of("large"), &output));
    for (int i = 0; i < 10000; i++) pia_output_bytes(output, block, 10);
    pia_output_bytes(output, block, SIZE);
    assert_ok(*state, pia_output_commit(output));
    assert_int_equal(stat(path_of("large"), &about), 0);
    assert_int_equal(about.st_size, 100000 + SIZE);
    free(block);
}

static void standard_output_is_written_whole(void **state)
{
    fflush(stdout);
    int saved = dup(STDOUT_FILENO), file = open(path_of("standard"), O_WRONLY | O_CREAT, 0666);
    struct stat about;
    pia_output *output;
    assert_ok(*state, pia_output_open(*state, "-", &output));
    assert_true(dup2(file, STDOUT_FILENO) >= 0);
    for (int i = 0; i < 20000; i++) pia_output_bytes(output, "0123456789", 10);
    int early = fstat(file, &about) != 0 || about.st_size != 0;
    pia_status status = pia_output_commit(output);
    assert_true(dup2(saved, STDOUT_FILENO) >= 0);
    close(saved);
    close(file);
    assert_int_equal(status, PIA_OK);
    assert_false(early);
    assert_int_equal(stat(path_of("standard"), &about), 0);
    assert_int_equal(about.st_size, 200000);
}

static void text_too_long_for_one_call_is_an_error_not_a_cut(void **state)
{
    char text[2000];
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    pia_output *output;
    assert_ok(*state, pia_output_open(*state, path_of("file"), &output));
    pia_output_text(output, "%s", text);
    assert_status(*state, pia_output_commit(output), PIA_E_FILE);
    assert_int_equal(file_count(), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(a_new_file_holds_what_was_written),
        IN_FOLDER(an_abandoned_output_leaves_the_old_file),
        IN_FOLDER(a_replaced_file_keeps_its_permissions),
        IN_FOLDER(a_symbolic_link_stays_a_link),
        IN_FOLDER(targets_that_cannot_be_files_are_refused),
        IN_FOLDER(a_full_device_is_told),
        IN_FOLDER(a_device_is_written_in_place),
        IN_FOLDER(large_outputs_pass_the_buffer),
        IN_FOLDER(standard_output_is_written_whole),
        IN_FOLDER(text_too_long_for_one_call_is_an_error_not_a_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
