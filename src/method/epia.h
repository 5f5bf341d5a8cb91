/* The parameters of method epia in the order of its record. The method itself moves control points by group means; groups and knots are
 * made from these by the fit. */
#ifndef PIA_METHOD_EPIA_H
#define PIA_METHOD_EPIA_H

enum {
    PIA_EPIA_ETA,
    PIA_EPIA_FENCE, /* word 0 printed, 1 balanced: the order of pia_fence_rule */
    PIA_EPIA_SMOOTH,
    PIA_EPIA_DOMINANT,
    PIA_EPIA_THRESHOLD, /* a word: half the tolerance */
    PIA_EPIA_ENDS,      /* word 0 keep, 1 free */
    PIA_EPIA_ROUNDS,    /* a word: 100 of a curve, 1 of a patch */
    PIA_EPIA_INSERT
};

#endif
