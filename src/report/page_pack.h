/* Lattices of numbers packed for a page: quantised, predicted from their neighbours, cut into byte planes, which deflate well.
 *
 * A lattice [rows x columns x components] becomes integers 0 .. 2^bits - 2, value = low + step * integer; 2^bits - 1 is NaN. Each is
 * predicted as left + up - corner (Lorenzo; Ibarria et al., "Out-of-core compression and decompression of large n-dimensional scalar
 * fields", 2003), the first row from the left and the first column from above alone; a lattice that follows one of its own shape is
 * predicted in its difference to that one. What is left, folded to unsigned, is written component by component, lowest bytes first. */
#ifndef PIA_REPORT_PAGE_PACK_H
#define PIA_REPORT_PAGE_PACK_H

#include "context.h"

typedef struct pia_pack {
    pia_context *context;
    void *byte; /* [count] */
    pia_index count, capacity;
} pia_pack;

enum { PIA_SERIES_COMPONENTS = 3 };

/* Lattices that share their quantisation; a lone one is a series of one. */
typedef struct pia_series {
    int components, bits;
    double low[PIA_SERIES_COMPONENTS], step[PIA_SERIES_COMPONENTS];
    pia_index rows, columns; /* of the last lattice; 0 before the first */
    uint32_t *code;          /* its integers [components x rows x columns] */
} pia_series;

/* Where a lattice lies in the pack. */
typedef struct pia_packed {
    pia_index at;
    int planes;  /* bytes a number, 1 to 4 */
    int follows; /* 1: predicted from the lattice before it */
} pia_packed;

/* components 1 to 3, bits 2 to 32, values between low [components] and high [components]; equal ones are fine. */
pia_series pia_series_between(int components, int bits, const double *low, const double *high);
/* values [rows x columns], `stride` doubles apart, rows * columns * components < 2^40. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_series_add(pia_pack *pack, pia_series *series, const double *values, pia_index stride, pia_index rows, pia_index columns,
                          pia_packed *out);
void pia_series_close(pia_context *context, pia_series *series);
void pia_pack_close(pia_pack *pack);

#endif
