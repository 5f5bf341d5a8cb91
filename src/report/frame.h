/* A frame: the part of the data plane that a rectangle of the page shows, with its axes. */
#ifndef PIA_REPORT_FRAME_H
#define PIA_REPORT_FRAME_H

#include "canvas.h"
#include "ticks.h"

typedef struct pia_frame {
    pia_box page;
    double low[2], high[2]; /* data at the left bottom and the right top corner, low < high; decimal logarithms where logarithmic */
    int logarithmic;        /* 1: the vertical axis */
    const char *name[2];    /* of the axes */
} pia_frame;

/* Adds pad * extent on both sides of [low, high], low <= high. extent is the size of the whole picture in these units; where it is 0,
 * or too small for numbers of this magnitude to resolve, one that can be drawn takes its place. */
void pia_range_widen(double *low, double *high, double extent, double pad);

/* Widens one direction about its centre until both have the same scale. */
void pia_frame_equalise(pia_frame *frame);

pia_spot pia_frame_spot(const pia_frame *frame, double x, double y);

/* Grid lines, ticks, labels and names of the axes. The labels lie outside the box: PIA_FRAME_LEFT and PIA_FRAME_BELOW points hold them.
 */
enum { PIA_FRAME_LEFT = 58, PIA_FRAME_BELOW = 34 };
void pia_frame_draw(pia_canvas *canvas, const pia_frame *frame);

#endif
