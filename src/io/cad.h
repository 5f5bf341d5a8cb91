/* What the CAD writers share: models checked for space, numbers as those formats spell them, knots with multiplicities. */
#ifndef PIA_IO_CAD_H
#define PIA_IO_CAD_H

#include "io.h"

enum { PIA_CAD_REAL_SIZE = 40, PIA_CAD_NAME_SIZE = 56 };

/* PIA_E_ARGUMENT unless every model has 2 or 3 components (planar curves get z = 0) or, with a fixed dimension, any from 1 to 3. */
pia_status pia_cad_check(pia_context *context, const char *format, const pia_model *const *models, pia_index count);

/* A real with a decimal point, as STEP and IGES want it ("1.", "2.5E-07"), equal to the double when read back. Returns its length. */
int pia_cad_real(double value, char text[PIA_CAD_REAL_SIZE]);

/* Cartesian control point i of a model as x, y, z and its weight (1 for polynomial models). */
void pia_cad_point(const pia_model *model, pia_index i, double xyz[3], double *weight);

/* The next run of equal knots from index `from`: its length. */
pia_index pia_cad_run(const double *knots, pia_index count, pia_index from);

/* The largest distance of a control point from the first one. */
double pia_cad_size(const pia_model *model);

/* The name of model `index` of `count`: that of the options, numbered from 1 when there are several; whatever is no printable ASCII, or
 * means something to a format, becomes '_'. */
void pia_cad_name(const pia_write_options *options, pia_index index, pia_index count, char name[PIA_CAD_NAME_SIZE]);

/* The tolerance of the options, chosen where they leave it open. */
double pia_cad_tolerance(const pia_write_options *options, const pia_model *const *models, pia_index count);

/* Whether the ends of a direction coincide (the curve, or the first and last line of control points), to 1e-12 of the size. */
int pia_cad_is_closed(const pia_model *model, int direction);
/* Whether the weights agree there too. Only then may a file say "closed": readers make such a spline periodic, and OpenCASCADE changes
 * the shape of one whose ends have different weights. */
int pia_cad_is_closed_alike(const pia_model *model, int direction);
/* Whether an edge of a surface shrinks to a point: direction of the edge's own parameter, first or last line across. */
int pia_cad_is_degenerate(const pia_model *model, int along, int last);

#endif
