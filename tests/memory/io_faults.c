/* Every reader and writer with every system call failing in turn: the k-th open, read, write, ... says EIO, ENOSPC, EINTR, or does only
 * a part. The linker puts the calls of the library through the __wrap functions here. */
#include <errno.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include "files.h"

#include "checkpoint.h"

typedef enum call { OPEN, FSTAT, MMAP, READ, WRITE, FSYNC, RENAME, CLOSE, CALLS } call;

enum { PARTLY = -1, NOTHING = -2 }; /* beside errno values: half of the bytes, none of them */

static struct {
    int armed;
    call call;
    int at, error; /* the at-th such call, from 1, fails with error */
    int seen[CALLS];
} fault;

/* 0, or how this call is to fail. */
static int fault_of(call which)
{
    if (!fault.armed) return 0;
    return ++fault.seen[which] == fault.at && which == fault.call ? fault.error : 0;
}

static int fail_with(int error)
{
    errno = error;
    return -1;
}

int __real_open(const char *path, int flags, ...);
int __real_fstat(int file, struct stat *about);
void *__real_mmap(void *address, size_t length, int protection, int flags, int file, off_t offset);
ssize_t __real_read(int file, void *bytes, size_t size);
ssize_t __real_write(int file, const void *bytes, size_t size);
int __real_fsync(int file);
int __real_rename(const char *from, const char *to);
int __real_close(int file);
int __wrap_open(const char *path, int flags, ...);
int __wrap_fstat(int file, struct stat *about);
void *__wrap_mmap(void *address, size_t length, int protection, int flags, int file, off_t offset);
ssize_t __wrap_read(int file, void *bytes, size_t size);
ssize_t __wrap_write(int file, const void *bytes, size_t size);
int __wrap_fsync(int file);
int __wrap_rename(const char *from, const char *to);
int __wrap_close(int file);

int __wrap_open(const char *path, int flags, ...)
{
    va_list arguments;
    va_start(arguments, flags);
    mode_t mode = flags & O_CREAT ? va_arg(arguments, mode_t) : 0;
    va_end(arguments);
    int error = fault_of(OPEN);
    return error != 0 ? fail_with(error) : __real_open(path, flags, mode);
}

int __wrap_fstat(int file, struct stat *about)
{
    int error = fault_of(FSTAT);
    return error != 0 ? fail_with(error) : __real_fstat(file, about);
}

void *__wrap_mmap(void *address, size_t length, int protection, int flags, int file, off_t offset)
{
    int error = fault_of(MMAP);
    if (error == 0) return __real_mmap(address, length, protection, flags, file, offset);
    errno = error;
    return MAP_FAILED;
}

ssize_t __wrap_read(int file, void *bytes, size_t size)
{
    int error = fault_of(READ);
    return error == PARTLY ? __real_read(file, bytes, size > 7 ? 7 : size)
           : error != 0    ? fail_with(error)
                           : __real_read(file, bytes, size);
}

ssize_t __wrap_write(int file, const void *bytes, size_t size)
{
    int error = fault_of(WRITE);
    if (error == NOTHING) return 0;
    return error == PARTLY ? __real_write(file, bytes, (size + 1) / 2)
           : error != 0    ? fail_with(error)
                           : __real_write(file, bytes, size);
}

int __wrap_fsync(int file)
{
    int error = fault_of(FSYNC);
    return error != 0 ? fail_with(error) : __real_fsync(file);
}

int __wrap_rename(const char *from, const char *to)
{
    int error = fault_of(RENAME);
    return error != 0 ? fail_with(error) : __real_rename(from, to);
}

int __wrap_close(int file)
{
    int error = fault_of(CLOSE), closed = __real_close(file); /* Linux closes the file whatever it says */
    return error != 0 ? fail_with(error) : closed;
}

static int open_files(void)
{
    int count = 0;
    DIR *entries = opendir("/proc/self/fd");
    assert_non_null(entries);
    while (readdir(entries) != NULL) count++;
    closedir(entries);
    return count;
}

typedef pia_status operation(pia_context *context);

typedef struct outcome {
    pia_status status;
    int reached;
} outcome;

static outcome run(pia_context *context, operation *work, call which, int error, int at)
{
    int before = open_files();
    memset(&fault, 0, sizeof fault);
    fault.call = which;
    fault.error = error;
    fault.at = at;
    fault.armed = 1;
    pia_status status = work(context);
    fault.armed = 0;
    assert_int_equal(open_files(), before);
    return (outcome){status, fault.seen[which] >= at};
}

/* --------------------------------------------------------------------------------------------------- writers ---- */

enum { ROWS = 6000 }; /* several buffers */

static double table[2 * ROWS];
static const char *target;

static pia_status write_table(pia_context *context)
{
    return pia_table_write(context, target, NULL, NULL, table, ROWS, 2);
}

static pia_status write_model(pia_context *context)
{
    static const double knots[] = {0, 0, 1, 1}, line[] = {0, 0, 1, 2};
    const double *both[] = {knots, knots};
    pia_model *model = NULL;
    assert_ok(context, pia_model_create(context, 1, (int[]){1}, both, (pia_index[]){2}, 2, line, NULL, &model));
    const pia_model *models[] = {model};
    pia_status status = pia_model_write(context, target, NULL, models, 1, 3000);
    pia_model_destroy(model);
    return status;
}

static pia_status draw(pia_context *context)
{
    static const double knots[] = {0, 0, 1, 1}, line[] = {0, 0, 1, 2};
    const double *both[] = {knots, knots};
    pia_model *model = NULL;
    assert_ok(context, pia_model_create(context, 1, (int[]){1}, both, (pia_index[]){2}, 2, line, NULL, &model));
    const pia_model *models[] = {model};
    pia_status status = strstr(target, ".html") != NULL ? pia_page_write(context, target, models, 1, line, 2, NULL)
                                                        : pia_plot(context, target, models, 1, line, 2, NULL);
    pia_model_destroy(model);
    return status;
}

static pia_status write_checkpoint(pia_context *context)
{
    pia_output *output = NULL;
    pia_checkpoint_writer writer;
    pia_status status = pia_output_open(context, target, &output);
    if (status != PIA_OK) return status;
    pia_checkpoint_begin(&writer, output);
    pia_checkpoint_put(&writer, "table", PIA_SECTION_DOUBLE, table, 2 * ROWS);
    pia_checkpoint_end(&writer);
    return pia_output_commit(output);
}

/* Either the new content is there, or the old one and an error that names the file; never anything beside it. */
static int write_with_fault(pia_context *context, operation *work, call which, int error, int at)
{
    make_text(strrchr(target, '/') + 1, "old");
    outcome result = run(context, work, which, error, at);
    char *text = read_text(target);
    int old = strcmp(text, "old") == 0;
    free(text);
    if (old != (result.status != PIA_OK) || (old && result.status != PIA_E_FILE) || file_count() != 1)
        print_error("call %d number %d with error %d: status %d, %s file, %d files\n", which, at, error, result.status,
                    old ? "old" : "new", file_count());
    assert_int_equal(old, result.status != PIA_OK);
    assert_int_equal(file_count(), 1);
    if (old) assert_int_equal(result.status, PIA_E_FILE);
    if (old) assert_non_null(strstr(pia_message(context), target));
    int harmless = error == EINTR || error == PARTLY;
    if (harmless) assert_int_equal(result.status, PIA_OK);
    return result.reached;
}

static void assert_writer_survives(pia_context *context, const char *name, operation *work)
{
    static const struct {
        call call;
        int error;
    } kind[] = {{OPEN, EACCES},  {OPEN, EMFILE},  {OPEN, EINTR},    {WRITE, EIO}, {WRITE, ENOSPC},
                {WRITE, EINTR},  {WRITE, PARTLY}, {WRITE, NOTHING}, {FSYNC, EIO}, {FSYNC, EINTR},
                {FSYNC, ENOSPC}, {RENAME, EIO},   {RENAME, EXDEV},  {CLOSE, EIO}, {CLOSE, EINTR}};
    static char path[128];
    snprintf(path, sizeof path, "%s", path_of(name));
    target = path;
    for (size_t i = 0; i < sizeof kind / sizeof *kind; i++) {
        int at = 1;
        while (write_with_fault(context, work, kind[i].call, kind[i].error, at)) at++;
        assert_true(at > 1); /* such a call was there to fail */
    }
    unlink(target);
}

static void writers_leave_the_old_file_or_the_new_one(void **state)
{
    for (int i = 0; i < 2 * ROWS; i++) table[i] = i / 7.0;
    assert_writer_survives(*state, "table.csv", write_table);
    assert_writer_survives(*state, "table.npy", write_table);
    assert_writer_survives(*state, "model.json", write_model);
    assert_writer_survives(*state, "model.csv", write_model);
    assert_writer_survives(*state, "model.npy", write_model);
    assert_writer_survives(*state, "model.obj", write_model);
    assert_writer_survives(*state, "model.g2", write_model);
    assert_writer_survives(*state, "model.step", write_model);
    assert_writer_survives(*state, "model.igs", write_model);
    assert_writer_survives(*state, "state", write_checkpoint);
}

static void pictures_leave_the_old_file_or_the_new_one(void **state)
{
    static const char *const name[] = {"report.html", "picture.svg", "picture.pdf", "picture.png"};
    pia_entry part;
    int cairo = 0;
    for (pia_index i = 0; pia_list("part", i, &part); i++)
        if (strcmp(part.name, "cairo") == 0) cairo = part.detail != NULL && strcmp(part.detail, "in this build") == 0;
    for (int i = 0; i < (cairo ? 4 : 1); i++) assert_writer_survives(*state, name[i], draw);
}

static void a_full_disk_is_named_with_what_to_do(void **state)
{
    static char path[128];
    snprintf(path, sizeof path, "%s", path_of("table.csv"));
    target = path;
    assert_int_equal(run(*state, write_table, WRITE, ENOSPC, 2).status, PIA_E_FILE);
    assert_non_null(strstr(pia_message(*state), "table.csv: could not be written: No space left on device; make room"));
}

/* --------------------------------------------------------------------------------------------------- readers ---- */

static pia_status read_target(pia_context *context)
{
    pia_points *points = NULL;
    pia_status status = pia_points_read(context, target, NULL, &points);
    pia_points_destroy(points);
    return status;
}

static pia_status read_model(pia_context *context)
{
    pia_model **models = NULL;
    pia_index count = 0;
    pia_status status = pia_model_read(context, target, NULL, &models, &count);
    pia_models_destroy(models, count);
    return status;
}

static pia_status read_checkpoint(pia_context *context)
{
    pia_checkpoint *checkpoint = NULL;
    pia_status status = pia_checkpoint_open(context, target, &checkpoint);
    pia_checkpoint_close(checkpoint);
    return status;
}

/* expected: the status when the k-th call fails. */
static void assert_reader_survives(pia_context *context, operation *work, call which, int error, pia_status expected)
{
    outcome result;
    int at = 0;
    do {
        result = run(context, work, which, error, ++at);
        assert_int_equal(result.status, result.reached ? expected : PIA_OK);
        if (result.status != PIA_OK) assert_non_null(strstr(pia_message(context), target));
    } while (result.reached);
    assert_true(at > 1);
}

static void assert_file_reader_survives(pia_context *context, const char *name, operation *work)
{
    static char path[128];
    snprintf(path, sizeof path, "%s", path_of(name));
    target = path;
    assert_reader_survives(context, work, OPEN, EIO, PIA_E_FILE);
    assert_reader_survives(context, work, OPEN, EACCES, PIA_E_FILE);
    assert_reader_survives(context, work, OPEN, EINTR, PIA_OK);
    assert_reader_survives(context, work, FSTAT, EIO, PIA_E_FILE);
    assert_reader_survives(context, work, MMAP, ENODEV, PIA_OK); /* a file that cannot be mapped is read */
    assert_reader_survives(context, work, CLOSE, EIO, PIA_OK);
}

/* LAS 1.2 with one point. */
static void make_scan(const char *name)
{
    unsigned char file[227 + 20] = "LASF";
    double unit = 1;
    file[24] = 1;
    file[25] = 2;
    file[94] = file[96] = 227; /* sizes of the header, little-endian */
    file[105] = 20;            /* of a point */
    file[107] = 1;             /* points */
    for (int d = 0; d < 3; d++) memcpy(file + 131 + 8 * d, &unit, sizeof unit);
    make_file(name, file, sizeof file);
}

static void readers_tell_what_failed_or_do_without(void **state)
{
    for (int i = 0; i < 2 * ROWS; i++) table[i] = i / 7.0;
    static char path[128];
    static const char *const name[] = {"table.csv", "table.npy", "model.json", "model.g2", "mesh.obj", "state"};
    static operation *const writer[] = {write_table, write_table, write_model, write_model, write_model, write_checkpoint};
    static operation *const reader[] = {read_target, read_target, read_model, read_model, read_target, read_checkpoint};
    for (int i = 0; i < 6; i++) {
        snprintf(path, sizeof path, "%s", path_of(name[i]));
        target = path;
        assert_int_equal(writer[i](*state), PIA_OK);
        assert_file_reader_survives(*state, name[i], reader[i]);
    }
    make_text("grey.pgm", "P2 2 2 9\n1 2 3 4\n");
    assert_file_reader_survives(*state, "grey.pgm", read_target);
    make_text("grid.asc", "ncols 2\nnrows 2\ncellsize 1\n1 2 3 4\n");
    assert_file_reader_survives(*state, "grid.asc", read_target);
    make_text("cloud.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n1 2\n");
    assert_file_reader_survives(*state, "cloud.ply", read_target);
    make_scan("cloud.las");
    assert_file_reader_survives(*state, "cloud.las", read_target);
}

/* What cannot be mapped comes by read: a pipe on standard input. */
static pia_status read_pipe(pia_context *context)
{
    static const char text[] = "x,y\n1,2\n3,4\n";
    int ends[2], saved = dup(STDIN_FILENO), armed = fault.armed;
    fault.armed = 0;
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(write(ends[1], text, sizeof text - 1), sizeof text - 1);
    close(ends[1]);
    assert_true(dup2(ends[0], STDIN_FILENO) >= 0);
    close(ends[0]);
    fault.armed = armed;
    pia_points *points = NULL;
    pia_points_info info;
    pia_status status = pia_points_read(context, "-", NULL, &points);
    fault.armed = 0;
    if (status == PIA_OK) {
        pia_points_get_info(points, &info);
        assert_int_equal(info.count[0], 2);
    }
    pia_points_destroy(points);
    assert_true(dup2(saved, STDIN_FILENO) >= 0);
    close(saved);
    return status;
}

static void a_pipe_is_read_through_interruptions(void **state)
{
    target = "standard input";
    assert_reader_survives(*state, read_pipe, READ, EIO, PIA_E_FILE);
    assert_reader_survives(*state, read_pipe, READ, EINTR, PIA_OK);
    assert_reader_survives(*state, read_pipe, READ, PARTLY, PIA_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(writers_leave_the_old_file_or_the_new_one), IN_FOLDER(pictures_leave_the_old_file_or_the_new_one),
        IN_FOLDER(a_full_disk_is_named_with_what_to_do),      IN_FOLDER(readers_tell_what_failed_or_do_without),
        IN_FOLDER(a_pipe_is_read_through_interruptions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
