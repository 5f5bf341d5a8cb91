#include "survey.h"

#include "scan.h"

#include <math.h>

enum { BLOCK = 512 }; /* rows at least: what is read stays in the cache for who sums them next */

void pia_scout_open(const double *parameters, const double *points, int dim, pia_index from, pia_index to, pia_scout *out)
{
    out->parameters = parameters;
    out->points = points;
    out->next = from;
    out->end = to;
    out->ordered = 1;
    pia_box_open(dim, &out->box);
}

void pia_scout_reach(pia_scout *s, pia_index row)
{
    if (row <= s->next) return;
    pia_index to = row - s->next < BLOCK ? s->next + BLOCK : row;
    if (to > s->end) to = s->end;
    s->ordered &= pia_scan_order(s->parameters, s->next > 0 ? s->next - 1 : 0, to - 1);
    pia_box_add(&s->box, s->points + s->next * s->box.dim, to - s->next);
    s->next = to;
}

pia_survey pia_scout_close(const pia_scout *s)
{
    pia_survey survey = pia_survey_of(&s->box);
    survey.ordered = s->ordered;
    return survey;
}

pia_survey pia_survey_of(const pia_box *box)
{
    pia_survey survey = {.ordered = 1};
    survey.finite = pia_box_close(box, survey.low, survey.high);
    return survey;
}

pia_survey pia_survey_join(const pia_survey *a, const pia_survey *b, int dim)
{
    pia_survey both = {.finite = a->finite & b->finite, .ordered = a->ordered & b->ordered};
    for (int d = 0; d < dim; d++) {
        both.low[d] = fmin(a->low[d], b->low[d]);
        both.high[d] = fmax(a->high[d], b->high[d]);
    }
    return both;
}
