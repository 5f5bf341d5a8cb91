/* What a fit wants to know of its rows before it trusts them, found out along with the sums, a block of rows ahead of them: memory is
 * read once. */
#ifndef PIA_KERNEL_SURVEY_H
#define PIA_KERNEL_SURVEY_H

#include "box.h"

typedef struct pia_survey {
    double low[PIA_MAX_DIM], high[PIA_MAX_DIM]; /* bounding box, when finite */
    int finite;                                 /* 1: all components of all points are */
    int ordered; /* 1: no parameter is less than the one before, or NaN; of a grid they are not looked at */
} pia_survey;

/* One that looks at rows [next, end). */
typedef struct pia_scout {
    const double *parameters, *points; /* of all rows */
    pia_index next, end;
    int ordered;
    pia_box box;
} pia_scout;

void pia_scout_open(const double *parameters, const double *points, int dim, pia_index from, pia_index to, pia_scout *out);
/* Looks at all rows before `row`, and may look further, up to the end. */
void pia_scout_reach(pia_scout *scout, pia_index row);
/* What it saw. */
pia_survey pia_scout_close(const pia_scout *scout);
/* Of points alone, as the box has them. */
pia_survey pia_survey_of(const pia_box *box);
/* Both parts' rows together. */
pia_survey pia_survey_join(const pia_survey *a, const pia_survey *b, int dim);

#endif
