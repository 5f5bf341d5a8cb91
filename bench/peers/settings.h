/* The command line of a program that is measured beside its peers. */
#ifndef PIA_BENCH_SETTINGS_H
#define PIA_BENCH_SETTINGS_H

typedef struct settings {
    const char *data, *only, *directory; /* of the cases; NULL or a part of their names; of the peers' programs */
    int distance;                        /* 1: asked for; -1 before: there is no such option */
    int peers;                           /* a bit each */
    double limit;                        /* seconds */
} settings;

/* --data DIRECTORY, --only TEXT, --limit SECONDS, --peers NAME,NAME or --no-peers, --distance. name [count]: of the peers, without the
 * prefix that all have. Ends the program with status 2 where an argument is something else. */
settings read_settings(int argc, char **argv, const char *const *name, int count, const char *prefix, int distance);

#endif
