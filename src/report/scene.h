/* The scene: everything one picture shows, in drawn coordinates, before anything is laid out. */
#ifndef PIA_REPORT_SCENE_H
#define PIA_REPORT_SCENE_H

#include "sample.h"

typedef struct pia_scene {
    pia_context *context;
    pia_plot_options options;
    pia_figure *figure;
    pia_index figure_count;
    int space;     /* 1: a picture in three dimensions */
    int surface;   /* 1: holds a surface */
    double *point; /* [point_count x 3] */
    pia_index point_count;
    double *deviation;      /* [point_count]; NULL: not shown */
    double *parameter;      /* [point_count x 2] of the closest or given place on its model; with `deviation` */
    pia_index *owner;       /* [point_count] figure that a point's deviation is measured from; with `deviation` */
    int parametric;         /* 1: deviations are those at given parameters; 0: from the closest points */
    double largest, rms;    /* of the deviations */
    pia_index worst;        /* point of the largest deviation */
    double low[3], high[3]; /* bounding box of all that is drawn */
    double comb_scale;      /* length of a tooth of curvature 1 */
    double comb_longest;    /* longer teeth are cut */
} pia_scene;

/* Samples the models (at most `most` samples a direction of surfaces), places the points, measures deviations. points [count x dim of
 * the first model]. Errors: PIA_E_DATA (not finite, too large), PIA_E_ARGUMENT (values of one component without parameters), and those
 * of the models' calls. Cost: the deviations; the closest point of every point where options->parameters is NULL. */
pia_status pia_scene_take(pia_context *context, const pia_model *const *models, pia_index model_count, const double *points,
                          pia_index count, const pia_plot_options *options, pia_index most, pia_scene *out);
void pia_scene_give(pia_scene *scene);

/* The tip of a comb's tooth. */
void pia_scene_tip(const pia_scene *scene, const pia_tooth *tooth, double tip[3]);

#endif
