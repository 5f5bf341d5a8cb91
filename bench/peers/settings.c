#include "settings.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int chosen(const char *list, const char *const *name, int count, const char *prefix)
{
    int peers = 0;
    for (int peer = 0; peer < count; peer++) peers |= (strstr(list, name[peer] + strlen(prefix)) != NULL) << peer;
    return peers;
}

settings read_settings(int argc, char **argv, const char *const *name, int count, const char *prefix, int distance)
{
    settings s = {.data = PIA_BENCH "/../data", .directory = ".", .distance = distance, .peers = (1 << count) - 1, .limit = 60};
    static char directory[512];
    char *slash = strrchr(argv[0], '/');
    if (slash != NULL) {
        snprintf(directory, sizeof directory, "%.*s", (int)(slash - argv[0]), argv[0]);
        s.directory = directory;
    }
    for (int i = 1; i < argc; i++) {
        const char *option = argv[i], *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (strcmp(option, "--no-peers") == 0) {
            s.peers = 0;
            continue;
        }
        if (strcmp(option, "--distance") == 0 && distance >= 0) {
            s.distance = 1;
            continue;
        }
        if (strcmp(option, "--data") == 0 && value != NULL) {
            s.data = value;
        } else if (strcmp(option, "--only") == 0 && value != NULL) {
            s.only = value;
        } else if (strcmp(option, "--limit") == 0 && value != NULL) {
            s.limit = atof(value);
        } else if (strcmp(option, "--peers") == 0 && value != NULL) {
            s.peers = chosen(value, name, count, prefix);
        } else {
            fprintf(stderr, "%s: unknown argument %s\n", argv[0], option);
            exit(2);
        }
        i++;
    }
    return s;
}
