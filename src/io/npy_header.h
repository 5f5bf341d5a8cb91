/* The header of NumPy's array files, versions 1 to 3 (numpy.lib.format). */
#ifndef PIA_IO_NPY_HEADER_H
#define PIA_IO_NPY_HEADER_H

#include "io.h"

enum { PIA_NPY_MAX_DIRECTIONS = 3 };

typedef struct pia_npy_header {
    char type;     /* 'f' float, 'i' signed, 'u' unsigned, 'b' truth value */
    int size;      /* bytes of a value: 1, 2, 4 or 8 */
    int big;       /* 1: big-endian */
    int transpose; /* 1: Fortran order, first index fastest */
    int directions;
    pia_index shape[PIA_NPY_MAX_DIRECTIONS];
    pia_index count;    /* values */
    const char *values; /* count * size bytes, inside the file */
} pia_npy_header;

/* Checks what the header claims against the size of the file. PIA_E_FORMAT. */
pia_status pia_npy_read_header(pia_context *context, const pia_input *input, pia_npy_header *out);

/* Version 1, little-endian doubles in C order. */
void pia_npy_write_header(pia_output *output, const pia_index *shape, int directions);

#endif
