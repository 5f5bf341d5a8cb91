/* A damaged file may make a library loop or allocate without end: a plug-in gets the time and memory that a sound file of its size
 * needs, amply. */
#ifndef PIA_PLUGIN_LIMIT_H
#define PIA_PLUGIN_LIMIT_H

#include <sys/resource.h>
#include <sys/stat.h>

/* A minute and a second more for each bytes_a_second of the file; 2 GiB and memory_a_byte more for each of its bytes. */
static inline void plugin_limit(const char *path, rlim_t bytes_a_second, rlim_t memory_a_byte)
{
    struct stat about;
    rlim_t size = stat(path, &about) == 0 && about.st_size > 0 ? (rlim_t)about.st_size : 0;
    const struct rlimit seconds = {60 + size / bytes_a_second, 60 + size / bytes_a_second};
    const struct rlimit memory = {((rlim_t)2 << 30) + memory_a_byte * size, RLIM_INFINITY}, none = {0, 0};
    setrlimit(RLIMIT_CPU, &seconds);
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CORE, &none);
}

#endif
