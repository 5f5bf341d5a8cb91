#include "output.h"

#include "number.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER_SIZE = 1 << 16, NAME_ATTEMPTS = 1000 };

typedef enum kind { REPLACED, IN_PLACE, STANDARD_OUTPUT } kind;

struct pia_output {
    pia_context *context;
    kind kind;
    int file;              /* -1 when none is open */
    char name[PATH_MAX];   /* as the messages call the target */
    char target[PATH_MAX]; /* symbolic links resolved */
    char temporary[PATH_MAX + 32];
    void *buffer;
    pia_index used, capacity;
    int failure;     /* errno of the first failure */
    const char *act; /* what failed: "write", "sync", ... */
};

static pia_status refuse(pia_context *context, const char *path, const char *why)
{
    return pia_fail(context, PIA_E_FILE, "%s: %s", path, why);
}

static void remember(pia_output *output, const char *act)
{
    if (output->failure == 0) {
        output->failure = errno != 0 ? errno : EIO;
        output->act = act;
    }
}

/* Opens a new file beside the target, with the permissions of the file it will replace. */
static void open_temporary(pia_output *output, const struct stat *old)
{
    const char *slash = strrchr(output->target, '/');
    int folder = slash != NULL ? (int)(slash - output->target) + 1 : 0;
    for (int i = 0; i < NAME_ATTEMPTS; i++) {
        snprintf(output->temporary, sizeof output->temporary, "%.*s.pia-%ld-%d", folder, output->target, (long)getpid(), i);
        output->file = open(output->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (output->file >= 0 || (errno != EEXIST && errno != EINTR)) break;
    }
    if (output->file < 0)
        output->temporary[0] = '\0';
    else if (old != NULL)
        (void)fchmod(output->file, old->st_mode & 0777); /* a file system without permissions is fine */
}

static pia_status open_target(pia_output *output, const char *path)
{
    struct stat old;
    int exists = stat(path, &old) == 0;
    if (!exists && lstat(path, &old) == 0) return refuse(output->context, path, "is a symbolic link to nothing; remove the link");
    if (exists && S_ISDIR(old.st_mode)) return refuse(output->context, path, "is a directory; give the name of a file");
    output->kind = exists && !S_ISREG(old.st_mode) ? IN_PLACE : REPLACED;
    if (!exists)
        memcpy(output->target, path, strlen(path) + 1);
    else if (realpath(path, output->target) == NULL)
        return pia_fail(output->context, PIA_E_FILE, "%s: cannot be found: %s", path, strerror(errno));
    if (exists && access(path, W_OK) != 0)
        return refuse(output->context, path, "must not be written; change its permissions or write elsewhere");
    if (output->kind == IN_PLACE)
        output->file = open(path, O_WRONLY | O_CLOEXEC);
    else
        open_temporary(output, exists ? &old : NULL);
    if (output->file >= 0) return PIA_OK;
    return pia_fail(output->context, PIA_E_FILE, "%s: cannot be written: %s; check that its folder exists and may be written", path,
                    strerror(errno));
}

pia_status pia_output_open(pia_context *context, const char *path, pia_output **out)
{
    if (path == NULL || *path == '\0')
        return pia_fail(context, PIA_E_FILE, "the name of the output file is empty; give one, or - for standard output");
    if (strlen(path) >= PATH_MAX) return pia_fail(context, PIA_E_FILE, "%.40s...: the name is too long; shorten it", path);
    pia_output *output = pia_take_zero(context, 1, sizeof *output);
    if (output == NULL) return pia_take_status(context, 1, sizeof *output);
    output->context = context;
    output->file = -1;
    int standard = strcmp(path, "-") == 0;
    if (standard) output->kind = STANDARD_OUTPUT;
    snprintf(output->name, sizeof output->name, "%s", standard ? "standard output" : path);
    pia_status status = standard ? PIA_OK : open_target(output, path);
    if (status == PIA_OK && !pia_memory_grow(pia_memory_of(context), &output->buffer, &output->capacity, BUFFER_SIZE, 1))
        status = pia_fail(context, PIA_E_MEMORY, "%s: out of memory for the output buffer", path);
    if (status == PIA_OK)
        *out = output;
    else
        pia_output_abandon(output);
    return status;
}

static void write_all(pia_output *output, int file, const char *bytes, size_t size)
{
    while (size > 0 && output->failure == 0) {
        ssize_t written = write(file, bytes, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) {
            if (written == 0) errno = ENOSPC;
            remember(output, "written");
            return;
        }
        bytes += written;
        size -= (size_t)written;
    }
}

static void flush(pia_output *output)
{
    write_all(output, output->kind == STANDARD_OUTPUT ? STDOUT_FILENO : output->file, output->buffer, (size_t)output->used);
    output->used = 0;
}

void pia_output_bytes(pia_output *output, const void *bytes, size_t size)
{
    if (output->failure != 0) return;
    if (output->kind != STANDARD_OUTPUT && output->used + (pia_index)size > output->capacity) {
        flush(output);
        if ((pia_index)size > output->capacity) {
            write_all(output, output->file, bytes, size);
            return;
        }
    }
    if (!pia_memory_grow(pia_memory_of(output->context), &output->buffer, &output->capacity, output->used + (pia_index)size, 1)) {
        errno = ENOMEM;
        remember(output, "buffered");
        return;
    }
    memcpy((char *)output->buffer + output->used, bytes, size);
    output->used += (pia_index)size;
}

void pia_output_text(pia_output *output, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length >= 0 && (size_t)length < sizeof text) {
        pia_output_bytes(output, text, (size_t)length);
        return;
    }
    errno = EOVERFLOW;
    remember(output, "formatted");
}

void pia_output_number(pia_output *output, double value)
{
    char text[PIA_NUMBER_SIZE];
    pia_output_bytes(output, text, (size_t)pia_number_format(value, text));
}

/* The new name reaches the disk with the folder. A failure here is not told: the target holds the whole new content, and after a crash
 * either it or the whole old one. */
static void sync_folder(const char *target)
{
    char folder[PATH_MAX];
    const char *slash = strrchr(target, '/');
    snprintf(folder, sizeof folder, "%.*s", slash != NULL ? (int)(slash - target) + 1 : 1, slash != NULL ? target : ".");
    int file = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return;
    (void)fsync(file);
    (void)close(file);
}

static void sync_and_close(pia_output *output)
{
    int synced;
    while ((synced = fsync(output->file)) != 0 && errno == EINTR) continue;
    if (synced != 0) remember(output, "synced to disk");
    if (close(output->file) != 0 && errno != EINTR) remember(output, "closed"); /* after EINTR, Linux has closed it */
    output->file = -1;
}

static void publish(pia_output *output)
{
    sync_and_close(output);
    if (output->failure != 0) return;
    if (rename(output->temporary, output->target) != 0) {
        remember(output, "renamed");
        return;
    }
    output->temporary[0] = '\0';
    sync_folder(output->target);
}

static pia_status describe_failure(const pia_output *output)
{
    if (output->failure == ENOMEM) return pia_fail(output->context, PIA_E_MEMORY, "%s: out of memory while writing", output->name);
    const char *advice =
        output->failure == ENOSPC || output->failure == EDQUOT ? "make room or write elsewhere" : "check the disk or write elsewhere";
    return pia_fail(output->context, PIA_E_FILE, "%s: could not be %s: %s; %s", output->name, output->act, strerror(output->failure),
                    advice);
}

pia_status pia_output_commit(pia_output *output)
{
    flush(output);
    if (output->failure == 0 && output->kind == REPLACED) publish(output);
    if (output->kind == IN_PLACE) {
        if (close(output->file) != 0 && errno != EINTR) remember(output, "closed");
        output->file = -1;
    }
    pia_status status = output->failure == 0 ? PIA_OK : describe_failure(output);
    pia_output_abandon(output);
    return status;
}

void pia_output_abandon(pia_output *output)
{
    if (output == NULL) return;
    if (output->file >= 0) (void)close(output->file);
    if (output->temporary[0] != '\0' && output->kind == REPLACED) (void)unlink(output->temporary);
    pia_give(output->context, output->buffer);
    pia_give(output->context, output);
}
