/* Legend and colour scale. */
#ifndef PIA_REPORT_LEGEND_H
#define PIA_REPORT_LEGEND_H

#include "canvas.h"

typedef enum pia_mark { PIA_MARK_NONE, PIA_MARK_DISC, PIA_MARK_SQUARE, PIA_MARK_TICK, PIA_MARK_PATCH } pia_mark;

typedef struct pia_legend_entry {
    char text[64];
    pia_pen pen; /* a stroke through the sample; width 0: none */
    pia_mark mark;
    pia_colour fill; /* of the mark */
} pia_legend_entry;

enum { PIA_MAX_LEGEND = 16 };
typedef struct pia_legend {
    pia_legend_entry entry[PIA_MAX_LEGEND];
    int count;
} pia_legend;

/* Entries past PIA_MAX_LEGEND are dropped. */
void pia_legend_add(pia_legend *legend, pia_pen pen, pia_mark mark, pia_colour fill, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* In rows between left and right, from `top` down. Returns the height used, 0 when there is no entry. */
double pia_legend_draw(pia_canvas *canvas, const pia_legend *legend, double left, double right, double top);

/* The mark of one legend entry, also used in the picture itself. */
void pia_mark_draw(pia_canvas *canvas, pia_spot centre, pia_mark mark, double size, pia_colour fill, pia_pen rim);

/* A vertical scale from low (bottom) to high of `ramp` in `box`, ticks and `title` to its right. low < high. */
enum { PIA_SCALE_WIDTH = 11, PIA_SCALE_ROOM = 74 };
void pia_scale_draw(pia_canvas *canvas, const pia_box *box, pia_ramp ramp, double low, double high, const char *title);

#endif
