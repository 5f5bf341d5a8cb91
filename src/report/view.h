/* A view of space: orthographic, from a direction given by azimuth and elevation, of a box that holds the scene. */
#ifndef PIA_REPORT_VIEW_H
#define PIA_REPORT_VIEW_H

#include "canvas.h"

typedef struct pia_view {
    double low[3], high[3];            /* the box, in data units */
    double stretch[3];                 /* factors by which the directions are drawn larger */
    double right[3], up[3], toward[3]; /* unit vectors of the page and towards the viewer, in stretched space */
    pia_spot middle;                   /* page position of the box's centre */
    double scale;                      /* points a stretched unit */
} pia_view;

/* Aims the view; low, high and stretch are set already. azimuth from x towards y, elevation above the plane of x and y, in degrees. */
void pia_view_aim(pia_view *view, double azimuth, double elevation);
/* Scales and centres the box in the page, which includes room for labels. */
void pia_view_fit(pia_view *view, const pia_box *page);
/* Height of a page of this width that the box and its labels fill. */
double pia_view_height(const pia_view *view, double width);

pia_spot pia_view_spot(const pia_view *view, const double at[3]);
/* Nearness to the viewer, in stretched units. */
double pia_view_depth(const pia_view *view, const double at[3]);

/* The three far faces with grid lines, tick labels and names of the axes. */
void pia_view_draw_box(pia_canvas *canvas, const pia_view *view, const char *const name[3]);

#endif
