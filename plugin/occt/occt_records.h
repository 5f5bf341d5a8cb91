/* What the reader of CAD files tells the library, record after record, as 64-bit values in the machine's byte order:
 *
 *   PIA_OCCT_SPLINE   directions, rational, degree u, degree v, control u, control v, loops, then doubles: knots u, knots v (surfaces),
 *                     control points (x, y, z; the second index fastest), weights (rational), then for each loop its vertex count and
 *                     (u, v) pairs
 *   PIA_OCCT_ERROR    length, then as many bytes, padded with zeroes to a multiple of 8: what is wrong with the file
 *   PIA_OCCT_END      nothing more comes, all was read
 *
 * The library trusts none of it: the file decides what is in there. */
#ifndef PIA_OCCT_RECORDS_H
#define PIA_OCCT_RECORDS_H

enum { PIA_OCCT_SPLINE = 1, PIA_OCCT_ERROR, PIA_OCCT_END };

/* Whole numbers of a spline's head after its kind. */
enum {
    PIA_OCCT_DIRECTIONS,
    PIA_OCCT_RATIONAL,
    PIA_OCCT_DEGREE_U,
    PIA_OCCT_DEGREE_V,
    PIA_OCCT_CONTROL_U,
    PIA_OCCT_CONTROL_V,
    PIA_OCCT_LOOPS,
    PIA_OCCT_HEAD
};

#endif
