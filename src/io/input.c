#include "io.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static pia_status refuse(pia_context *context, const char *path, int error)
{
    switch (error) {
    case ENOENT: return pia_fail(context, PIA_E_FILE, "%s: does not exist; check the name", path);
    case EISDIR: return pia_fail(context, PIA_E_FILE, "%s: is a directory; give the name of a file", path);
    case EACCES: return pia_fail(context, PIA_E_FILE, "%s: must not be read; check its permissions", path);
    default: return pia_fail(context, PIA_E_FILE, "%s: cannot be read: %s; check the file and its disk", path, strerror(error));
    }
}

static pia_status map(int file, pia_index size, pia_input *input)
{
    void *block = mmap(NULL, (size_t)size, PROT_READ, MAP_PRIVATE, file, 0);
    if (block == MAP_FAILED) return PIA_E_FILE;
    (void)madvise(block, (size_t)size, MADV_SEQUENTIAL);
    input->block = block;
    input->begin = block;
    input->end = input->begin + size;
    input->mapped = 1;
    return PIA_OK;
}

static pia_status read_whole(pia_context *context, int file, pia_input *input)
{
    const pia_memory *memory = pia_memory_of(context);
    pia_index size = 0, capacity = 0;
    for (;;) {
        if (!pia_memory_grow(memory, &input->block, &capacity, size + (1 << 16), 1))
            return pia_fail(context, PIA_E_MEMORY, "%s: out of memory after %lld bytes; free memory or split the file", input->path,
                            (long long)size);
        ssize_t got = read(file, (char *)input->block + size, (size_t)(capacity - size));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return refuse(context, input->path, errno);
        if (got == 0) break;
        size += got;
    }
    input->begin = input->block;
    input->end = input->begin + size;
    return PIA_OK;
}

static pia_status open_named(pia_context *context, const char *path, pia_input *input)
{
    int file;
    while ((file = open(path, O_RDONLY | O_CLOEXEC)) < 0 && errno == EINTR) continue;
    if (file < 0) return refuse(context, path, errno);
    struct stat about;
    pia_status status = PIA_OK;
    if (fstat(file, &about) != 0)
        status = refuse(context, path, errno);
    else if (S_ISDIR(about.st_mode))
        status = refuse(context, path, EISDIR);
    else if (!S_ISREG(about.st_mode) || about.st_size == 0 || map(file, about.st_size, input) != PIA_OK)
        status = read_whole(context, file, input); /* pipes, devices, files whose size is not known beforehand */
    (void)close(file);                             /* nothing was written: nothing can be lost */
    return status;
}

/* Editors begin text with a byte order mark, which is no part of any format. */
static void skip_mark(pia_input *input)
{
    if (input->end - input->begin >= 3 && memcmp(input->begin, "\xef\xbb\xbf", 3) == 0) input->begin += 3;
}

pia_status pia_input_open(pia_context *context, const char *path, pia_input *out)
{
    if (path == NULL || *path == '\0')
        return pia_fail(context, PIA_E_FILE, "the name of the input file is empty; give one, or - for standard input");
    int standard = strcmp(path, "-") == 0;
    pia_input input = {.path = standard ? "standard input" : path};
    pia_status status = standard ? read_whole(context, STDIN_FILENO, &input) : open_named(context, path, &input);
    if (status == PIA_OK) {
        skip_mark(&input);
        *out = input;
    } else
        pia_input_close(context, &input);
    return status;
}

void pia_input_close(pia_context *context, pia_input *input)
{
    if (input->mapped)
        (void)munmap(input->block, (size_t)(input->end - (const char *)input->block));
    else
        pia_give(context, input->block);
    *input = (pia_input){0};
}

pia_index pia_input_line(const pia_input *input, const char *at)
{
    pia_index line = 1;
    for (const char *p = input->begin; p < at; p++) {
        int lone_return = *p == '\r' && (p + 1 == input->end || p[1] != '\n');
        line += *p == '\n' || lone_return;
    }
    return line;
}

pia_status pia_input_fail(pia_context *context, const pia_input *input, const char *at, const char *format, ...)
{
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    const char *remedy = strchr(text, ';') == NULL ? "; correct the file" : "";
    if (at == NULL) return pia_fail(context, PIA_E_FORMAT, "%s: %s%s", input->path, text, remedy);
    return pia_fail(context, PIA_E_FORMAT, "%s:%lld: %s%s", input->path, (long long)pia_input_line(input, at), text, remedy);
}

pia_status pia_input_judge(pia_context *context, const pia_input *input, const char *at, const char *where, pia_status status)
{
    char why[300];
    if (status == PIA_OK || status == PIA_E_MEMORY || status == PIA_E_FORMAT) return status;
    snprintf(why, sizeof why, "%s", pia_message(context));
    return pia_input_fail(context, input, at, "%s%s", where, why);
}

void pia_input_quote(const char *begin, const char *end, char quote[32])
{
    enum { MOST = 24 };
    int length = end - begin > MOST ? MOST : (int)(end - begin);
    for (int i = 0; i < length; i++) quote[i] = (unsigned char)begin[i] >= ' ' && begin[i] != 127 ? begin[i] : '?';
    snprintf(quote + length, 4, "%s", end - begin > MOST ? "..." : "");
}
