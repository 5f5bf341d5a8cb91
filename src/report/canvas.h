/* The canvas: a page on which pictures are drawn, the same for SVG, PNG and PDF. Lengths are points of 1/72 inch, y grows downwards.
 * The build chooses who implements it (canvas_cairo.c, or canvas_none.c which refuses). */
#ifndef PIA_REPORT_CANVAS_H
#define PIA_REPORT_CANVAS_H

#include "colour.h"
#include "output.h"

typedef enum pia_picture { PIA_PICTURE_SVG, PIA_PICTURE_PNG, PIA_PICTURE_PDF } pia_picture;

typedef struct pia_spot {
    double x, y;
} pia_spot;

typedef struct pia_box {
    double left, top, right, bottom;
} pia_box;

typedef struct pia_pen {
    pia_colour colour;
    double width;
    double dash; /* length of dashes and gaps; 0: solid */
} pia_pen;

typedef struct pia_type {
    double size; /* height of the letters */
    pia_colour colour;
    double across, down; /* where the text's box lies about the spot: 0 begins there, 0.5 is centred, 1 ends there */
    double angle;        /* degrees, counter-clockwise */
    int bold;
    double room; /* longer text is set smaller to fit; 0: any length */
} pia_type;

typedef struct pia_canvas pia_canvas;
struct pia_canvas {
    double width, height;
    void (*line)(pia_canvas *canvas, const pia_spot *spots, pia_index count, pia_pen pen);
    /* Closed shapes, filled, with a rim about them; a rim of width 0 is none. */
    void (*polygon)(pia_canvas *canvas, const pia_spot *spots, pia_index count, pia_colour fill, pia_pen rim);
    void (*disc)(pia_canvas *canvas, pia_spot centre, double radius, pia_colour fill, pia_pen rim);
    void (*text)(pia_canvas *canvas, pia_spot spot, const char *text, pia_type type);
    double (*text_width)(pia_canvas *canvas, const char *text, pia_type type);
    /* Until the next call nothing is drawn outside the box; NULL: the whole page. */
    void (*clip)(pia_canvas *canvas, const pia_box *box);
    /* Sends the picture to its output and frees the canvas. PIA_E_MEMORY, PIA_E_INTERNAL. */
    pia_status (*close)(pia_canvas *canvas);
};

/* A white page of width x height points; a PNG has `scale` pixels a point. The output stays the caller's.
 * PIA_E_UNAVAILABLE in a build without Cairo. */
pia_status pia_canvas_open(pia_context *context, pia_output *output, pia_picture picture, double width, double height, double scale,
                           pia_canvas **out);

#endif
