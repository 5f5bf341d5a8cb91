/* What a careful person writes by hand: rows of basis values into a sparse A', Gram matrix A'A, CHOLMOD with its own choices. */
#ifndef PIA_BENCH_PEER_CHOLMOD_H
#define PIA_BENCH_PEER_CHOLMOD_H

/* Solution [control^2 x dim] of least squares; returns the seconds it took, 0 when this build has no CHOLMOD. */
double peer_cholmod(long count, const double *parameters, const double *points, int dim, int control, int degree, const double *knots,
                    double *solution);

#endif
