#include "reader.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hdf5_answer.h"
#include "plugin_channel.h"

void answer_bytes(const void *bytes, size_t size)
{
    const char *at = bytes;
    while (size > 0) {
        ssize_t written = write(PIA_PLUGIN_CHANNEL, at, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) exit(EXIT_FAILURE);
        at += written;
        size -= (size_t)written;
    }
}

void answer_error(const char *format, ...)
{
    char text[300];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    answer_bytes(text, strlen(text));
    answer_bytes(PIA_HDF5_END, strlen(PIA_HDF5_END));
    exit(EXIT_FAILURE);
}
