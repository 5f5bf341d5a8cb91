/* Models turned into what a picture shows: positions at sample parameters, control points, curvature. */
#ifndef PIA_REPORT_SAMPLE_H
#define PIA_REPORT_SAMPLE_H

#include "context.h"

/* Sample parameters of one direction, increasing over the whole domain. */
typedef struct pia_samples {
    double *parameter;      /* [count] */
    unsigned char *at_knot; /* [count], 1: a knot lies here */
    pia_index count;
} pia_samples;

/* Equally many samples in each knot span, about `wanted` in all, at most 2 * most: where there are more spans than `most`, several
 * neighbours are taken as one. */
pia_status pia_samples_take(pia_context *context, const pia_model *model, int direction, pia_index wanted, pia_index most,
                            pia_samples *out);
/* Samples that lie at knots, ends included. */
pia_index pia_samples_knots(const pia_samples *samples);
void pia_samples_give(pia_context *context, pia_samples *samples);

/* One tooth of a curvature comb. */
typedef struct pia_tooth {
    double root[3];
    double bend[3]; /* curvature vector: towards the centre, of length curvature */
    double curvature;
} pia_tooth;

/* One model as drawn. Positions have three components: the first three of the model, or its parameters and value where it has one. */
typedef struct pia_figure {
    const pia_model *model;
    pia_model_info info;
    pia_samples samples[2]; /* of a curve, samples[1].count is 1 */
    double *at;             /* [samples[0].count x samples[1].count x 3] */
    unsigned char *outside; /* [samples[0].count x samples[1].count], 1: cut away by the trim loops; NULL: untrimmed */
    double *edge;           /* [edge_count x 2 x 3] strokes along the trim loops, from and to; NULL: untrimmed */
    pia_index edge_count;
    double *control;  /* [control[0] x control[1] x 3] */
    pia_tooth *tooth; /* [tooth_count], NULL without a comb */
    pia_index tooth_count;
} pia_figure;

/* most: samples a direction for surfaces. comb 1: curves get teeth. PIA_E_DATA when a position is too large to draw (1e150). */
pia_status pia_figure_take(pia_context *context, const pia_model *model, pia_index most, int comb, pia_figure *out);
void pia_figure_give(pia_context *context, pia_figure *figure);

/* The drawn position of a value [dim] at a parameter [directions]. */
void pia_figure_place(const pia_model_info *info, const double *parameter, const double *value, double at[3]);

/* The drawn positions [control x 3] of the control points; those of a model of one component stand at their Greville abscissas.
 * PIA_E_DATA as above, PIA_E_MEMORY. */
pia_status pia_figure_control(pia_context *context, const pia_model *model, double *at);
/* The drawn positions [count[0] x count[1] x 3] of a lattice of equal steps in the parameters over the whole domain, count at least 2
 * (a curve: count[1] is 1). Errors as above. */
pia_status pia_figure_lattice(pia_context *context, const pia_model *model, const pia_index count[2], double *at);

/* 1 when the horizontal position of a curve is its parameter but for scale: a function graph. */
int pia_figure_is_graph(const pia_figure *curve);
/* 1 when the first component of a curve never turns back. */
int pia_figure_is_monotone(const pia_figure *curve);
/* 1 when a surface is a function of the horizontal plane: its projection folds nowhere. */
int pia_figure_is_terrain(const pia_figure *surface);

#endif
