#include "io.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* Whether `word` of `length` is one of the blank-separated words of `list`, in any case. */
static int holds_word(const char *list, const char *word, size_t length)
{
    while (*list != '\0') {
        size_t size = strcspn(list, " ");
        if (size == length && strncasecmp(list, word, length) == 0) return 1;
        list += size + (list[size] == ' ');
    }
    return 0;
}

static const char *extension_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash != NULL ? slash : path, '.');
    return dot != NULL ? dot + 1 : "";
}

const pia_format *pia_format_find(const char *name, const char *path)
{
    const char *extension = name != NULL ? name : extension_of(path != NULL ? path : "");
    if (*extension == '\0') return NULL;
    const pia_format *format;
    for (pia_index i = 0; (format = pia_format_list(i)) != NULL; i++) {
        if (name != NULL && strcmp(name, format->name) == 0) return format;
        if (holds_word(format->extensions, extension, strlen(extension))) return format;
    }
    return NULL;
}

const char *pia_format_inside(const char *name, const char *path)
{
    char file[PATH_MAX];
    for (const char *at = path; (at = strstr(at, ":/")) != NULL; at++) {
        snprintf(file, sizeof file, "%.*s", (int)(at - path), path);
        const pia_format *format = pia_format_find(name, file);
        if (format != NULL && format->holds_arrays) return at + 1;
    }
    return NULL;
}
