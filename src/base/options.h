/* Option structs as callers give them: struct_size tells which members the caller's header knew. */
#ifndef PIA_BASE_OPTIONS_H
#define PIA_BASE_OPTIONS_H

#include "context.h"

/* `out` of `size` bytes holds the defaults; the members that `in` has replace them, those its older header lacked keep their default.
 * Both start with size_t struct_size. in NULL: the defaults stay. PIA_E_ARGUMENT when `in` was not filled by its init function
 * (struct_size 0) or comes from a newer header, whose members this library would silently drop; `name` is the struct's, for the
 * message. context may be NULL. */
pia_status pia_options_read(pia_context *context, const char *name, void *out, size_t size, const void *in);

/* The way back: copies `full` of `size` bytes into a struct of the caller, as far as its struct_size says it reaches; a struct_size of
 * 0 stands for the size known here. */
void pia_options_write(void *out, const void *full, size_t size);

#endif
