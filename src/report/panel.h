/* The panels of a picture: each draws one view of the scene into a rectangle of the page. */
#ifndef PIA_REPORT_PANEL_H
#define PIA_REPORT_PANEL_H

#include "legend.h"
#include "scene.h"
#include "view.h"

/* Height of a panel of this width in which the scene looks best. */
double pia_plane_height(const pia_scene *scene, double width);
double pia_space_height(const pia_scene *scene, double width);

/* What the colour scale beside a panel shows. */
typedef struct pia_shade {
    int shown; /* 0: no scale */
    pia_ramp ramp;
    double low, high;
    const char *title;
} pia_shade;

/* Plane curves and function graphs. The page includes room for the axes' labels. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
void pia_plane_legend(const pia_scene *scene, pia_legend *legend);
pia_status pia_plane_draw(pia_canvas *canvas, const pia_scene *scene, pia_box page);

/* Surfaces and space curves in a box. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
void pia_space_legend(const pia_scene *scene, pia_legend *legend);
pia_shade pia_space_shade(const pia_scene *scene);
pia_status pia_space_draw(pia_canvas *canvas, const pia_scene *scene, pia_box page);

/* Largest and root-mean-square error against iterations, on a logarithmic axis. Errors: PIA_E_MEMORY. */
pia_status pia_trace_draw(pia_canvas *canvas, pia_context *context, const pia_trace_row *rows, pia_index count, pia_box page);

/* The colour of curve number `index`. */
pia_colour pia_curve_colour(const pia_scene *scene, pia_index index);

/* The entries of the curves. */
void pia_curves_legend(const pia_scene *scene, pia_legend *legend);

/* The entry of the curvature combs, where there are any. */
void pia_comb_legend(const pia_scene *scene, pia_legend *legend);

/* More knots or control points than this get no marks: they would run into each other. */
enum { PIA_MOST_MARKS = 400 };
int pia_knots_shown(const pia_scene *scene, const pia_figure *curve);

/* Radius of the dots that stand for `count` points. */
double pia_dot_radius(pia_index count);

/* Width of the line of a curve. */
double pia_curve_width(const pia_figure *curve);

/* Spots that hold all points and then the samples of all curves, or the control points or teeth of any one figure. */
pia_index pia_spot_room(const pia_scene *scene);

/* Where deviations are shown: a ring about the worst of the points, and "max 1.2×10⁻³ at point 17" beside it, where it hides least.
 * spots [count]: places on the page of all points, and then of what else had better stay visible. */
void pia_worst_draw(pia_canvas *canvas, const pia_scene *scene, const pia_spot *spots, pia_index count, const pia_box *page);

#endif
