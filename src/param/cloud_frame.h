/* What the bases of a cloud share: frames, centres and turns, of the first three components of points [count x dim]. */
#ifndef PIA_PARAM_CLOUD_FRAME_H
#define PIA_PARAM_CLOUD_FRAME_H

#include "context.h"

/* Both columns of uv [count x 2] to [0, 1] by their ranges. Errors: PIA_E_DATA when one has none; `surface` is for the message. */
pia_status pia_cloud_to_unit(pia_context *context, double *uv, pia_index count, const char *surface);
/* Mean and principal axes (rows, unit length), longest first; spread: the sums of squares along them. */
void pia_cloud_axes(const double *points, pia_index count, int dim, double mean[3], double axes[3][3], double spread[3]);
/* Coordinate of a point along an axis, from the mean. */
double pia_cloud_along(const double *point, const double mean[3], const double axis[3]);
/* The centre of the circle (two axes) or sphere (three) that fits best algebraically (Kasa): |x|^2 = 2 c . x + k, in coordinates along
 * the axes, relative to the mean; scale: the size of the cloud. Returns 0 when there is none. */
int pia_cloud_centre(const double *points, pia_index count, int dim, const double mean[3], double axes[3][3], int count_axes,
                     double scale, double centre[3]);
/* The angle of (x, y) as a share of a turn in [0, 1). */
double pia_cloud_turn(double y, double x);
/* Turns in [0, 1), the first column of uv, whose largest gap is a sixteenth or more are opened there and stretched to [0, 1]. Returns 1
 * when they are closed. */
int pia_cloud_open_gap(double *uv, pia_index count);

/* Base surfaces, as pia_cloud.compute. The cylinder stands on the principal axis about which the cloud is roundest: u the share of the
 * turn, v the height. The sphere has longitude and latitude, or, where a pole would lie among points that leave a wide cap free, the
 * map of a disc around the middle of the points (azimuthal, equidistant). */
pia_status pia_cloud_by_cylinder(pia_context *context, const double *points, pia_index count, int dim, double *uv, int *closed);
pia_status pia_cloud_by_sphere(pia_context *context, const double *points, pia_index count, int dim, double *uv, int *closed);

#endif
