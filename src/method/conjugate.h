/* Conjugate gradients for H x = b (Hestenes, Stiefel 1952), for any way to condition a gradient. The components of the points are
 * independent systems with one matrix, and each has its own scalars, unless conditions couple them. The gradient is that of the
 * iterate, never a recurrence of it, so that what is reported is true. */
#ifndef PIA_METHOD_CONJUGATE_H
#define PIA_METHOD_CONJUGATE_H

#include "product.h"

enum { PIA_CG_GRADIENT, PIA_CG_SEARCH, PIA_CG_IMAGE, PIA_CG_VECTORS };

typedef struct pia_conjugate {
    pia_product product;
    double *vector[PIA_CG_VECTORS]; /* g, p, H p */
    double gamma[PIA_MAX_DIM];      /* (g, z) of the step before; 0: none */
    int coupled;                    /* 1: one scalar for all components */
    double age;                     /* steps since the gradient was the iterate's own */
    double lowest, still;           /* relative gradient so far, and steps since it was found */
} pia_conjugate;

/* z = M^-1 gradient, M symmetric and positive; may first take from the gradient what cannot be followed. */
typedef void pia_condition(pia_iterate *iterate, void *user, double *gradient, double *z);

/* Errors: PIA_E_MEMORY. */
pia_status pia_conjugate_open(pia_iterate *iterate, pia_conjugate *out);
void pia_conjugate_close(pia_iterate *iterate, pia_conjugate *c);
/* D = the step to the minimum along the next conjugate direction. */
void pia_conjugate_step(pia_iterate *iterate, pia_conjugate *c, pia_condition *condition, void *user);
/* The history of a method that keeps a pia_conjugate. */
void pia_conjugate_visit(pia_iterate *iterate, pia_conjugate *c,
                         void (*visit)(void *user, const char *name, double *numbers, pia_index count), void *user);

#endif
