/* Points from a file, as the options shared by fit, check, info and plot ask for them. */
#ifndef PIA_CLI_POINT_SOURCE_H
#define PIA_CLI_POINT_SOURCE_H

#include "arguments.h"
#include "index_list.h"

struct point_source {
    struct session *session;
    const char *path; /* "-": standard input */
    const char *format;
    const char *columns;
    const char *weights; /* name or number of a column that holds weights; NULL: none */
    int skip_invalid;
    int grid;           /* 1: rows are a grid */
    pia_index shape[2]; /* of that grid; {0, 0}: a matrix of heights */
    pia_index part;     /* the only part wanted; PIA_AUTO: all */
};

/* Options of the group "Reading points"; the input is the point_source. */
extern const struct argp point_source_argp;

struct point_set {
    pia_points *file;
    pia_points_info info;  /* points, dim and count may have been changed by `shape` and `weights` */
    const double *weights; /* [count[0]]; NULL: none */
    pia_index total;       /* rows in the file, dropped ones included */
    int any_order;         /* 1: rows were put into another order */
};

void point_source_init(struct point_source *source, struct session *session);
/* Returns an exit status. */
int points_open(struct point_source *source, struct point_set *out);
void points_close(struct point_set *set);
/* Rows of one part; the whole set for part PIA_AUTO. */
struct row_span points_span(const struct point_set *set, pia_index part);
/* The points of one part as a set of their own, which is not closed; all of them for part PIA_AUTO. */
struct point_set points_of_part(const struct point_set *set, pia_index part);

#endif
