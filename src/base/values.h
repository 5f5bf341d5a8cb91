/* Parameters of a record (method, limiter) given as texts "name=value". */
#ifndef PIA_BASE_VALUES_H
#define PIA_BASE_VALUES_H

#include "context.h"

enum { PIA_MAX_VALUES = 12 };

/* In the order of the record: a number, or the index of a word where `values` of the parameter lists words ("column|scalar|number":
 * "number" stands for any number in range). */
typedef struct pia_values {
    double number[PIA_MAX_VALUES];
    int is_word[PIA_MAX_VALUES];
} pia_values;

/* The record's defaults. parameters ends with name NULL; NULL: none. */
void pia_values_default(const pia_parameter *parameters, pia_values *out);
/* Sets one parameter; PIA_E_ARGUMENT names the record, the parameter, what it takes and what the record knows. */
pia_status pia_values_set(pia_context *context, const char *record, const pia_parameter *parameters, const char *name,
                          const char *value, pia_values *values);
/* `count` texts "name=value" one after the other. */
pia_status pia_values_read(pia_context *context, const char *record, const pia_parameter *parameters, const char *const *texts,
                           pia_index count, pia_values *values);

#endif
