/* The header of a PLY file: elements and their properties, up to and including the vertices. */
#ifndef PIA_IO_PLY_HEADER_H
#define PIA_IO_PLY_HEADER_H

#include "records.h"

typedef struct pia_ply_property {
    pia_record_type type;
    pia_record_type length; /* of a list: the type of its count; kind 0: a plain number */
    const char *name;       /* in the file, name_size characters without blanks and quotes */
    pia_index name_size;
} pia_ply_property;

typedef struct pia_ply_element {
    pia_index count;      /* as claimed */
    pia_index first, end; /* its properties */
    pia_index least_size; /* bytes of an item, lists empty; in ASCII, a digit and a blank a property */
    int fixed;            /* 1: no lists, all items have the least size (binary) */
} pia_ply_element;

typedef struct pia_ply_header {
    enum { PIA_PLY_ASCII, PIA_PLY_LITTLE, PIA_PLY_BIG } encoding;
    pia_ply_element *element; /* [element_count] those before the vertices, then the vertices; what comes behind is left */
    pia_index element_count, element_capacity;
    pia_ply_property *property;
    pia_index property_count, property_capacity;
    const char *data; /* behind the header */
} pia_ply_header;

/* PIA_E_FORMAT with the line: no PLY file, an unknown encoding or type, no vertices, no end of the header. PIA_E_MEMORY. */
pia_status pia_ply_read_header(pia_context *context, const pia_input *input, pia_ply_header *out);
void pia_ply_clear(pia_context *context, pia_ply_header *header);

#endif
