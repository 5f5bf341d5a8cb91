/* A method is one record in one file: how a residual becomes adjusting vectors. It does not know what it fits.
 *
 * One iteration of the loop (solve.c): residual and errors of P; stop?; adjust: R -> D; the limiter edits D; P += D; trace. A method
 * with a fused `step` does it in one pass over the data: it leaves the next P in `adjust` and the errors of the current P in `errors`.
 */
#ifndef PIA_METHOD_METHOD_H
#define PIA_METHOD_METHOD_H

#include "iterate.h"
#include "values.h"

enum {
    PIA_NEEDS_SQUARE = 1, /* as many unknowns as rows, each unknown with its own row */
    PIA_NEEDS_ROWS = 2,   /* residuals of the rows in every iteration */
    PIA_NEEDS_NORMAL = 4, /* profits from the normal form */
    PIA_NEEDS_GROUPS = 8, /* [2011] */
    PIA_KNOWS_CONSTRAINTS = 16,
    PIA_IS_FINITE = 32,      /* one step reaches the limit */
    PIA_IS_LIMITABLE = 64,   /* a limiter may shorten its steps */
    PIA_LEAST_SQUARES = 128, /* any number of rows, weights, holes */
    PIA_DESCENDS = 256       /* every step goes to the smallest squared error along it, however far that is */
};

typedef struct pia_method {
    const char *name, *title, *reference, *detail;
    unsigned needs;
    pia_index iterations;                                                             /* default of max_iterations */
    const pia_parameter *parameters;                                                  /* ends with name NULL; NULL: none */
    size_t state_size;                                                                /* bytes of `state`, cleared before begin */
    pia_status (*begin)(pia_iterate *iterate, const pia_values *values, void *state); /* NULL: nothing to prepare */
    pia_status (*adjust)(pia_iterate *iterate, void *state);
    pia_status (*update)(pia_iterate *iterate, void *state); /* NULL: P += D */
    pia_status (*step)(pia_iterate *iterate, void *state);   /* NULL: not fused */
    void (*end)(pia_iterate *iterate, void *state);          /* NULL: nothing to release */
    /* History as numbers for a checkpoint: calls visit for each array of the state. NULL: no history beyond begin. */
    void (*history)(pia_iterate *iterate, void *state, void (*visit)(void *user, const char *name, double *numbers, pia_index count),
                    void *user);
} pia_method;

/* The registry, collected from the files method_*.c; NULL past the end. */
const pia_method *pia_method_list(pia_index index);
const pia_method *pia_method_find(const char *name);

#endif
