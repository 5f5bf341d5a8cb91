#include "stdin_peek.h"

#include <ctype.h>
#include <sys/mman.h>
#include <unistd.h>

static int copy_all(int from, int to)
{
    char buffer[65536];
    ssize_t got;
    while ((got = read(from, buffer, sizeof buffer)) > 0)
        if (write(to, buffer, (size_t)got) != got) return -1;
    return got < 0 ? -1 : 0;
}

int stdin_peek(void)
{
    unsigned char byte = ' ';
    int file = memfd_create("pia", 0);
    if (file < 0) return -1;
    int failed = copy_all(STDIN_FILENO, file) < 0 || dup2(file, STDIN_FILENO) < 0;
    close(file);
    if (failed || lseek(STDIN_FILENO, 0, SEEK_SET) < 0) return -1;
    while (isspace(byte))
        if (read(STDIN_FILENO, &byte, 1) != 1) byte = 0;
    return lseek(STDIN_FILENO, 0, SEEK_SET) < 0 ? -1 : byte;
}
