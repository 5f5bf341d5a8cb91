/* Spans side by side in the lanes of a vector, row by row: knots and the inverses of their differences stay in registers for all rows
 * of a span, and nothing is added across lanes. Where a span has fewer rows than its neighbours, its lane adds zeros. */
#include "span_lanes.h"

#include "lanes.h"

/* What the lanes work on; those past the last span repeat it. */
typedef struct team {
    pia_index begin[PIA_LANES], last[PIA_LANES]; /* a row to read where there is none left is `last` */
    pia_lane_masks rows;
    pia_index most;
    pia_lanes knot[2 * PIA_MAX_DEGREE], inverse[PIA_MAX_DEGREE * (PIA_MAX_DEGREE + 1) / 2], origin[PIA_MAX_DIM];
} team;

PIA_INLINE void load_team(const pia_span_data *data, pia_index first, int count, int degree, int dim, team *out)
{
    const pia_collocation *line = data->line;
    pia_index span[PIA_LANES];
    out->most = 0;
    for (int l = 0; l < PIA_LANES; l++) {
        span[l] = first + (l < count ? l : count - 1);
        pia_index begin = line->begin[span[l]], rows = line->begin[span[l] + 1] - begin;
        out->begin[l] = begin < line->rows ? begin : line->rows - 1;
        out->last[l] = rows > 0 ? begin + rows - 1 : out->begin[l];
        out->rows[l] = rows;
        if (rows > out->most) out->most = rows;
    }
    for (int k = 0; k < 2 * degree; k++) out->knot[k] = pia_lanes_load(line->knots + 1 + k, span);
    pia_lanes_inverses(out->knot, degree, out->inverse);
    pia_lane_masks empty = out->knot[degree - 1] == out->knot[degree];
    for (int k = 0; k < degree * (degree + 1) / 2; k++) out->inverse[k] = pia_lanes_choose(empty, (pia_lanes){0}, out->inverse[k]);
    for (int d = 0; d < dim; d++) out->origin[d] = pia_lanes_component(data->targets->points, out->begin, dim, d);
}

/* Row k of each span, sums [room] as in a share. */
PIA_INLINE void add_row(const pia_span_data *data, const team *t, pia_index k, int degree, int dim, pia_lanes *sum)
{
    pia_index at[PIA_LANES];
    pia_lanes value[PIA_MAX_DEGREE + 1], weighted[PIA_MAX_DEGREE + 1];
    pia_lane_masks live = t->rows > k;
    for (int l = 0; l < PIA_LANES; l++) at[l] = t->begin[l] + k < t->last[l] ? t->begin[l] + k : t->last[l];
    pia_lanes_exact_basis(t->knot, t->inverse, degree, pia_lanes_load(data->line->parameters, at), value);
    for (int i = 0; i <= degree; i++) weighted[i] = value[i] = pia_lanes_choose(live, value[i], (pia_lanes){0});
    if (data->weights != NULL) {
        pia_lanes w = pia_lanes_load(data->weights, at);
        for (int i = 0; i <= degree; i++) weighted[i] *= w;
    }
    for (int i = 0; i <= degree; i++)
        for (int j = i; j <= degree; j++) *sum++ += weighted[i] * value[j];
    pia_lanes q[PIA_MAX_DIM];
    for (int d = 0; d < dim; d++) q[d] = pia_lanes_component(data->targets->points, at, dim, d) - t->origin[d];
    for (int i = 0; i <= degree; i++)
        for (int d = 0; d < dim; d++) *sum++ += weighted[i] * q[d];
}

PIA_INLINE void sum_team(const pia_span_data *data, pia_index first, int count, int degree, int dim, double *share)
{
    enum { ROOM = (PIA_MAX_DEGREE + 1) * (PIA_MAX_DEGREE + 2) / 2 + (PIA_MAX_DEGREE + 1) * PIA_MAX_DIM };
    team t;
    pia_lanes sum[ROOM];
    int sums = (degree + 1) * (degree + 2) / 2 + (degree + 1) * dim, room = sums + dim;
    load_team(data, first, count, degree, dim, &t);
    for (int i = 0; i < sums; i++) sum[i] = (pia_lanes){0};
    for (pia_index k = 0; k < t.most; k++) add_row(data, &t, k, degree, dim, sum);
    for (int l = 0; l < count; l++) {
        for (int i = 0; i < sums; i++) share[l * room + i] = sum[i][l];
        for (int d = 0; d < dim; d++) share[l * room + sums + d] = t.origin[d][l];
    }
}

/* The cubic in up to three dimensions is what nearly everybody fits. */
PIA_CLONES static void sum_any_team(const pia_span_data *data, pia_index first, int count, int degree, int dim, double *share)
{
    if (degree == 3 && dim == 3)
        sum_team(data, first, count, 3, 3, share);
    else if (degree == 3 && dim == 2)
        sum_team(data, first, count, 3, 2, share);
    else if (degree == 3 && dim == 1)
        sum_team(data, first, count, 3, 1, share);
    else
        sum_team(data, first, count, degree, dim, share);
}

void pia_span_lanes(const pia_span_data *data, pia_index first, int count, double *share)
{
    sum_any_team(data, first, count, data->line->degree, data->targets != NULL ? data->targets->dim : 0, share);
}
