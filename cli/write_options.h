/* How models are written, as the options shared by convert and fit ask for it. */
#ifndef PIA_CLI_WRITE_OPTIONS_H
#define PIA_CLI_WRITE_OPTIONS_H

#include "arguments.h"

/* Options of the group "CAD files"; the input is a pia_write_options, already initialised. */
extern const struct argp write_options_argp;

#endif
