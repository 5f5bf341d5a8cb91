/* Thinning: what lies closer together than paper can show is drawn once. The result depends on the input alone. */
#ifndef PIA_REPORT_THIN_H
#define PIA_REPORT_THIN_H

#include "canvas.h"

/* Vertices of a polyline, in place; returns how many stay. Of a run inside one column of `width` points only the first, lowest,
 * highest and last vertex stay, in their order: no stroke moves by more than `width` (Jugel et al., M4, PVLDB 2014). */
pia_index pia_thin_line(pia_spot *spots, pia_index count, double width);

/* At most one dot a square cell of side `size`, the one of largest value (value NULL: the first); order [count] receives the indices
 * of the dots that stay, by increasing value. Dots outside `box` are dropped. *kept is how many stay. PIA_E_MEMORY. */
pia_status pia_thin_dots(pia_context *context, const pia_spot *spots, const double *value, pia_index count, const pia_box *box,
                         double size, pia_index *order, pia_index *kept);

#endif
