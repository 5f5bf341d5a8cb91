/* What the STEP writer is made of: numbered instances, shapes, faces, products. Failures of the output are remembered by it. */
#ifndef PIA_IO_STEP_H
#define PIA_IO_STEP_H

#include "cad.h"

typedef struct pia_step {
    pia_output *output;
    const pia_write_options *options;
    long long last;  /* the number of the last instance written */
    long long space; /* the geometric context with units and tolerance */
    long long plane; /* the context of curves in parameter planes; 0: none was needed yet */
} pia_step;

/* "#n=" and the text, at most 500 characters; returns n. */
long long pia_step_put(pia_step *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The pieces of longer instances: '#n=' for the next n, which is returned; a number; "(1.,2.,...)"; (#a,#b,...); .T. or .F. */
long long pia_step_begin(pia_step *s);
void pia_step_real(pia_step *s, double value);
void pia_step_list(pia_step *s, const long long *item, pia_index count);
const char *pia_step_logical(int value);
/* #first, #first + stride, ... in brackets. */
void pia_step_references(pia_step *s, long long first, pia_index count, pia_index stride);
/* A CARTESIAN_POINT or DIRECTION of `dim` coordinates. */
long long pia_step_coordinates(pia_step *s, const char *entity, const double *x, int dim);

/* The start of the file up to the first instance, and what all products share. */
void pia_step_header(pia_step *s);
/* Units, tolerance and the application's context; sets s->space and returns the application context. */
long long pia_step_context(pia_step *s);
/* A part of this name (safe to stand in quotes) whose shape is the representation of this kind with this item. */
void pia_step_product(pia_step *s, long long application, const char *name, const char *kind, long long item);

/* All control points, one instance each, in the order of the model; returns the first. */
long long pia_step_points(pia_step *s, const pia_model *model);
/* A line of control points: of a curve all, of a surface an edge. */
typedef struct pia_step_line {
    pia_index first, stride, count;
    int degree, closed;
    const double *knots;
} pia_step_line;
/* All of a curve. */
pia_step_line pia_step_whole(const pia_model *curve);
/* points: the instance of the model's first control point. */
long long pia_step_curve(pia_step *s, const pia_model *model, long long points, const pia_step_line *line);
long long pia_step_surface(pia_step *s, const pia_model *model, long long points);

/* Whether at least two sides of a surface have a length: less bounds no face. */
int pia_step_has_edges(const pia_model *surface);
/* A shell of one face: a trimmed surface, or one that has edges: a seam where it is closed, none where a side is a point. PIA_E_MEMORY;
 * PIA_E_ARGUMENT, PIA_E_DATA of a trim. */
pia_status pia_step_shell(pia_context *context, pia_step *s, const pia_model *model, long long surface, long long points,
                          long long *shell);

#endif
