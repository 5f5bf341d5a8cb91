#include "plugin.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "plugin_channel.h"

enum { FILE_CHANNEL = PIA_PLUGIN_CHANNEL + 1 };

/* ---- where the plug-in is ---- */

static int is_program(const char *name, const char *folder, int length, const char *below, char path[PATH_MAX])
{
    int size = snprintf(path, PATH_MAX, "%.*s%s/%s", length, folder, below, name);
    return size < PATH_MAX && access(path, X_OK) == 0;
}

static int find_in_list(const char *name, const char *list, char path[PATH_MAX])
{
    for (; list != NULL && *list != '\0'; list += list[strcspn(list, ":")] == ':' ? strcspn(list, ":") + 1 : strcspn(list, ":"))
        if (is_program(name, list, (int)strcspn(list, ":"), "", path)) return 1;
    return 0;
}

/* Beside a library in lib, a program in bin, a program in a build tree. */
static int find_beside(const char *name, const char *file, char path[PATH_MAX])
{
    static const char *const below[] = {"/pia", "/../lib/pia", "/../" PIA_LIBDIR "/pia"};
    char whole[PATH_MAX];
    if (realpath(file, whole) == NULL) return 0;
    int folder = (int)(strrchr(whole, '/') - whole);
    for (size_t i = 0; i < sizeof below / sizeof *below; i++)
        if (is_program(name, whole, folder, below[i], path)) return 1;
    return 0;
}

static int find_plugin(const char *name, char path[PATH_MAX])
{
    static const char anchor = 0;
    Dl_info library;
    if (find_in_list(name, getenv("PIA_PLUGIN_PATH"), path)) return 1;
    if (dladdr(&anchor, &library) != 0 && library.dli_fname != NULL && find_beside(name, library.dli_fname, path)) return 1;
    return find_beside(name, "/proc/self/exe", path);
}

int pia_plugin_is_there(const pia_plugin *plugin)
{
    char path[PATH_MAX];
    return find_plugin(plugin->program, path);
}

/* ---- running it ---- */

static pia_status fail_system(pia_context *context, const pia_input *input, const char *what)
{
    return pia_fail(context, PIA_E_FILE, "%s: %s: %s; free what the system lacks", input->path, what, strerror(errno));
}

/* What is not a file of its own (standard input) becomes one in memory. -1 on failure. */
static int file_of(const pia_input *input)
{
    int file = memfd_create("pia", MFD_CLOEXEC);
    for (const char *at = input->begin; file >= 0 && at < input->end;) {
        ssize_t written = write(file, at, (size_t)(input->end - at));
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) {
            close(file);
            return -1;
        }
        at += written;
    }
    return file;
}

/* The plug-in with its answer on its channel and nothing else to talk to. */
static int start(const char *program, const char *word, const char *path, int answer, int file, pid_t *child)
{
    char words[3][PATH_MAX];
    char *arguments[] = {words[0], words[1], words[2], NULL};
    const char *const text[] = {program, word, path};
    posix_spawn_file_actions_t actions;
    if (strlen(path) >= PATH_MAX) return ENAMETOOLONG;
    for (int i = 0; i < 3; i++) snprintf(words[i], sizeof words[i], "%s", text[i]);
    int error = posix_spawn_file_actions_init(&actions);
    if (error != 0) return error;
    for (int channel = 0; channel < PIA_PLUGIN_CHANNEL && error == 0; channel++)
        error = posix_spawn_file_actions_addopen(&actions, channel, "/dev/null", O_RDWR, 0);
    if (error == 0) error = posix_spawn_file_actions_adddup2(&actions, answer, PIA_PLUGIN_CHANNEL);
    if (error == 0 && file >= 0) error = posix_spawn_file_actions_adddup2(&actions, file, FILE_CHANNEL);
    if (error == 0) error = posix_spawn(child, program, &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

static pia_status read_all(pia_context *context, const pia_input *input, int answer, char **bytes, pia_index *size)
{
    enum { PIECE = 1 << 16 };
    pia_index capacity = 0;
    for (;;) {
        void *block = *bytes;
        int grown = pia_memory_grow(pia_memory_of(context), &block, &capacity, *size + PIECE, 1);
        *bytes = block;
        if (!grown) return pia_fail(context, PIA_E_MEMORY, "%s: out of memory for what it holds; free memory", input->path);
        ssize_t got = read(answer, *bytes + *size, PIECE);
        if (got < 0 && errno != EINTR) return fail_system(context, input, "the plug-in cannot be heard");
        if (got == 0) return PIA_OK;
        if (got > 0) *size += got;
    }
}

static void wait_for(pid_t child)
{
    int status;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
}

static pia_status run(pia_context *context, const pia_input *input, const char *program, const char *word, int file, char **bytes,
                      pia_index *size)
{
    int ends[2];
    pid_t child = 0;
    char path[32];
    snprintf(path, sizeof path, "/dev/fd/%d", FILE_CHANNEL);
    if (pipe2(ends, O_CLOEXEC) != 0) return fail_system(context, input, "no pipe to the plug-in");
    /* neither end may be one of the plug-in's own channels, which adddup2 would close */
    int answer = fcntl(ends[1], F_DUPFD_CLOEXEC, FILE_CHANNEL + 1),
        source = file >= 0 ? fcntl(file, F_DUPFD_CLOEXEC, FILE_CHANNEL + 1) : -1;
    close(ends[1]);
    errno = answer < 0 ? errno : start(program, word, file >= 0 ? path : input->path, answer, source, &child);
    int failed = answer < 0 || errno != 0;
    pia_status status = failed ? fail_system(context, input, "the plug-in that reads it does not start") : PIA_OK;
    if (answer >= 0) close(answer);
    if (source >= 0) close(source);
    if (status == PIA_OK) status = read_all(context, input, ends[0], bytes, size);
    close(ends[0]);
    if (!failed) wait_for(child);
    return status;
}

pia_status pia_plugin_run(pia_context *context, const pia_input *input, const pia_plugin *plugin, const char *word, char **bytes,
                          pia_index *size)
{
    char program[PATH_MAX];
    if (!find_plugin(plugin->program, program))
        return pia_fail(
            context, PIA_E_UNAVAILABLE,
            "%s: reading this format needs the plug-in %s, which is not here; install %s and build with -DPIA_WITH_%s=ON, or "
            "name its folder in PIA_PLUGIN_PATH",
            input->path, plugin->program, plugin->packages, plugin->part);
    int file = input->mapped ? -1 : file_of(input);
    if (!input->mapped && file < 0) return fail_system(context, input, "no memory for a copy");
    *bytes = NULL;
    *size = 0;
    pia_status status = run(context, input, program, word, file, bytes, size);
    if (file >= 0) close(file);
    if (status == PIA_OK) return PIA_OK;
    pia_give(context, *bytes);
    return status;
}

pia_status pia_plugin_broke_off(pia_context *context, const pia_input *input, const pia_plugin *plugin)
{
    return pia_input_fail(context, input, NULL,
                          "the plug-in %s broke off while reading it; the file is damaged or needs more memory than there is",
                          plugin->program);
}
