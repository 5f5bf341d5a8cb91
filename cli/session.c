#include "session.h"

#include <malloc.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

struct kept {
    struct kept *next;
    _Alignas(max_align_t) char block[];
};

/* What the library warns of, and with --verbose all it does. */
static void log_to_stderr(void *user, int level, const char *text)
{
    const struct session *session = user;
    if (level >= 2)
        session_warn(session, "%s", text);
    else if (session->verbose)
        fprintf(stderr, "pia: %s\n", text);
}

/* The allocator of the C library, counted. Blocks may come and go on any thread. */
static void *allocate_metered(void *user, size_t size, size_t align)
{
    struct session *session = user;
    void *block = NULL;
    if (posix_memalign(&block, align < sizeof(void *) ? sizeof(void *) : align, size)) return NULL;
    session->bytes += malloc_usable_size(block);
    return block;
}

static void release_metered(void *user, void *block)
{
    struct session *session = user;
    session->bytes -= malloc_usable_size(block);
    free(block);
}

int session_open(struct session *session)
{
    pia_context_options options;
    pia_context_options_init(&options);
    options.threads = session->threads;
    options.backend = session->backend;
    options.user = session;
    options.log = log_to_stderr;
    if (session->metered) {
        options.allocate = allocate_metered;
        options.release = release_metered;
    }
    pia_status status = pia_context_create(&options, &session->context);
    if (status == PIA_E_ARGUMENT || status == PIA_E_UNAVAILABLE)
        return fail(EXIT_USAGE, "threads %d with backend %s: %s; 'pia list backends' shows what this build has", session->threads,
                    session->backend ? session->backend : "auto", pia_strerror(status));
    return session_check(session, status, NULL);
}

void session_close(struct session *session)
{
    pia_context_destroy(session->context);
    session->context = NULL;
    while (session->kept) {
        struct kept *next = session->kept->next;
        free(session->kept);
        session->kept = next;
    }
}

void *session_keep(struct session *session, size_t count, size_t size)
{
    size_t bytes;
    struct kept *kept = NULL;
    if (!__builtin_mul_overflow(count, size, &bytes) && bytes <= SIZE_MAX - sizeof *kept) kept = calloc(1, sizeof *kept + bytes);
    if (!kept) exit(fail(EXIT_MEMORY, "out of memory for %zu items of %zu bytes; use fewer points", count, size));
    kept->next = session->kept;
    session->kept = kept;
    return kept->block;
}

char *session_text(struct session *session, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *text = session_keep(session, (size_t)length + 1, 1);
    vsnprintf(text, (size_t)length + 1, format, again);
    va_end(again);
    return text;
}

/* The room doubles whenever the count is a power of two. */
void session_append(struct session *session, struct texts *texts, const char *text)
{
    size_t count = (size_t)texts->count;
    if ((count & (count - 1)) == 0) {
        const char **item = session_keep(session, count ? 2 * count : 1, sizeof *item);
        if (count) memcpy(item, texts->item, count * sizeof *item);
        texts->item = item;
    }
    texts->item[texts->count++] = text;
}

int fail(int code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fflush(stdout);
    fputs("pia: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return code;
}

static int code_of(pia_status status)
{
    switch (status) {
    case PIA_OK: return EXIT_DONE;
    case PIA_E_ARGUMENT:
    case PIA_E_UNAVAILABLE: return EXIT_USAGE;
    case PIA_E_SHAPE:
    case PIA_E_DATA:
    case PIA_E_CONSTRAINT:
    case PIA_E_FORMAT: return EXIT_DATA;
    case PIA_E_FILE: return EXIT_FILE;
    case PIA_E_MEMORY:
    case PIA_E_SIZE: return EXIT_MEMORY;
    case PIA_E_INTERNAL: break;
    }
    return EXIT_INTERNAL;
}

int session_check(const struct session *session, pia_status status, const char *path)
{
    if (status == PIA_OK) return EXIT_DONE;
    const char *message = pia_message(session->context);
    if (!*message) message = pia_strerror(status);
    int named = !path || strcmp(path, "-") == 0 || strncmp(message, path, strlen(path)) == 0;
    if (named) return fail(code_of(status), "%s", message);
    return fail(code_of(status), "%s: %s", path, message);
}

void session_warn(const struct session *session, const char *format, ...)
{
    if (session->quiet) return;
    va_list arguments;
    va_start(arguments, format);
    fputs("pia: warning: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
}
