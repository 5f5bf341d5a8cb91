/* The summary: what a model remembers of the fit that made it. Owned by the model, written into its file. */
#ifndef PIA_BASE_SUMMARY_H
#define PIA_BASE_SUMMARY_H

#include "notes.h"

typedef struct pia_summary {
    pia_report report;
    pia_notes notes;
    double *parameters;        /* of the rows used, in the order of the data; NULL when none were kept */
    pia_index parameter_count; /* values in `parameters` */
    pia_index *dropped;        /* data rows that were not used, increasing; NULL when none */
    pia_index dropped_count;
} pia_summary;

/* A deep copy, or NULL when memory is short. */
pia_summary *pia_summary_copy(const pia_memory *memory, const pia_summary *summary);
void pia_summary_destroy(const pia_memory *memory, pia_summary *summary);

#endif
