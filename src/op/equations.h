/* The equations of interpolation along one direction. */
#ifndef PIA_OP_EQUATIONS_H
#define PIA_OP_EQUATIONS_H

#include "collocation.h"

/* Row c belongs to unknown c. */
typedef struct pia_equations {
    pia_index n;
    int width;
    pia_index *first; /* [n] first column, modulo n when it wraps */
    double *entry;    /* [n x width] */
    int wraps;
} pia_equations;

/* frozen [n], NULL: none. The equation of a frozen unknown is d = 0. Errors: PIA_E_MEMORY. */
pia_status pia_equations_open(pia_context *context, const pia_collocation *c, const unsigned char *frozen, pia_equations *out);
void pia_equations_clear(pia_context *context, pia_equations *e);

#endif
