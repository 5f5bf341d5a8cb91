/* The iterate: everything a method may see and change. */
#ifndef PIA_OP_ITERATE_H
#define PIA_OP_ITERATE_H

#include "normal.h"

struct pia_constraints;
struct pia_groups;
struct pia_part;

typedef struct pia_iterate {
    pia_context *context;
    pia_op *op;
    pia_normal *normal; /* least squares: the normal form; NULL: gradients pass over the data */
    pia_targets targets;
    int dim;
    double extent;                       /* diagonal of the data's bounding box, > 0 */
    double *points;                      /* P [cols x dim], centred on the targets' origin; NULL until the first step, where that does
                                            not ask for it: interpolation then starts from the targets, least squares where `start` says */
    double *adjust;                      /* D [cols x dim]; a fused step writes the next P here instead; NULL after such a step where
                                            P was NULL */
    double *residual;                    /* R [rows x dim]; NULL unless the method needs rows or there is no normal form */
    double right_norm;                   /* |A'W(Q - origin)|, the scale of relative gradients; 0: unknown, gradients are absolute */
    struct pia_constraints *constraints; /* NULL: none */
    const struct pia_groups *groups;     /* of the rows, owned by the fit; NULL unless the method needs groups */
    struct pia_part *part;               /* the rows that can still change, owned by the fit; NULL: all */
    pia_index iteration;                 /* updates done */
    pia_errors errors;                   /* of P, when errors_known */
    int errors_known;
    pia_errors next_errors; /* of the next P, when next_errors_known: a fused step may measure them */
    int next_errors_known;
    double adjust_max;        /* largest |D_i| of the step just computed */
    double relative_gradient; /* of P; NAN when the method has none */
    double damping;           /* the loop's factor on the steps of interpolating methods: 1, halved where steps grow */
    double constraint_error;  /* largest violation of P, units of the points; NAN without constraints */
    int stalled;              /* set by a method or limiter: no step helps any more */
    int shortened;            /* set by a limiter: it did not leave the step as it was */
    int finished;             /* set by a finite method: P is the limit, this step is none */
    int square;               /* 1: interpolation, each unknown owns a row; 0: least squares */
    pia_status (*project)(struct pia_iterate *iterate); /* moves the parameters to the closest points of the current iterate; NULL where
                                                           not offered */
    pia_status (*look)(void *owner, const struct pia_survey *survey); /* takes what a step has seen of points that nobody looked at
                                                                         before, and sets extent; NULL: they are known */
    pia_status (*start)(void *owner); /* makes P of least squares, for a step that asks for it; NULL where P is there already */
    void *owner;                      /* of project, look and start */
} pia_iterate;

/* R and errors of the current P (one pass over the data); nothing when they are known. */
void pia_iterate_measure(pia_iterate *iterate);
/* G [cols x dim] = A'W(Q - A P), zero where frozen: from the normal form, or from R (which pia_iterate_measure has filled). Sets
 * relative_gradient. */
void pia_iterate_gradient(pia_iterate *iterate, double *gradient);
/* relative_gradient alone, in one pass that writes nothing; returns 0 where there is no such pass. */
int pia_iterate_gradient_length(pia_iterate *iterate);
/* Sum of products of x and y [cols x dim], in fixed order; and the largest Euclidean length of a row of x. */
double pia_iterate_dot(const pia_iterate *iterate, const double *x, const double *y);
double pia_iterate_longest(const pia_iterate *iterate, const double *x);
/* x += y [cols x dim]. */
void pia_iterate_add(const pia_iterate *iterate, double *x, const double *y);

#endif
