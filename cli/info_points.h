/* What pia info tells of points. */
#ifndef PIA_CLI_INFO_POINTS_H
#define PIA_CLI_INFO_POINTS_H

#include "point_source.h"

/* Reads and prints. Returns an exit status. */
int info_points(struct point_source *source);

#endif
