/* Parameters of points on a model: those of the fit that made it, or those of a named parametrization. */
#ifndef PIA_CLI_STORED_PARAMETERS_H
#define PIA_CLI_STORED_PARAMETERS_H

#include "session.h"

/* One parameter (or pair) for each of the points that the model was fitted to, as pia_model_deviation takes them: the array that the
 * model carries, or computed again by the parametrization that its report names. Rows that the fit of a curve dropped have that of
 * the row they repeat. NULL when the model knows neither, or when it was fitted to another number of points. Kept by the session. */
const double *stored_parameters(struct session *session, const pia_model *model, const pia_points_info *points);
/* The same from a fit, by rows of the points it was opened with; NULL when it dropped rows that repeat no other. Kept by the session.
 */
const double *fit_parameters(struct session *session, pia_fit *fit, const pia_points_info *points);
/* Parameters of a named parametrization on the domain of the model; *out is NULL when points have none of their own, because they
 * repeat. Kept by the session. */
pia_status named_parameters(struct session *session, const pia_model *model, const pia_points_info *points, const char *name,
                            const double **out);
/* u_i and v_j of a grid as pairs (u_i, v_j), second index fastest; kept by the session. */
const double *grid_parameters(struct session *session, const double *u, const double *v, const pia_index count[2]);

#endif
