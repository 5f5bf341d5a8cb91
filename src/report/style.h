/* The look all pictures share: sizes in points, pens, greys. */
#ifndef PIA_REPORT_STYLE_H
#define PIA_REPORT_STYLE_H

#include "canvas.h"

enum { PIA_MARGIN = 14, PIA_TITLE_SIZE = 13, PIA_TEXT_SIZE = 9, PIA_TICK_SIZE = 8 };

static const pia_colour pia_style_text = {0.13, 0.13, 0.13, 1};
static const pia_colour pia_style_paper = {1, 1, 1, 1};
static const pia_pen pia_style_axis = {{0.40, 0.40, 0.40, 1}, 0.6, 0};
static const pia_pen pia_style_grid = {{0.90, 0.90, 0.90, 1}, 0.5, 0};
static const pia_pen pia_style_control = {{0.55, 0.55, 0.55, 1}, 0.6, 0};
static const pia_pen pia_style_comb = {{0.00, 0.62, 0.45, 1}, 0.9, 0};
static const pia_pen pia_style_tooth = {{0.00, 0.62, 0.45, 0.55}, 0.5, 0};
static const pia_colour pia_style_data = {0.25, 0.25, 0.25, 1};
static const pia_colour pia_style_warning = {0.80, 0.10, 0.10, 1};

#endif
