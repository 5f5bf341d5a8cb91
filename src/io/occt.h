/* Models of files that OpenCASCADE reads: the plug-in pia-occt, a program of its own, is started for each file and tells what it found
 * (plugin/occt/occt_records.h). */
#ifndef PIA_IO_OCCT_H
#define PIA_IO_OCCT_H

#include "plugin.h"

/* format: "step", "iges" or "brep". PIA_E_UNAVAILABLE without the plug-in, naming what to install; PIA_E_FORMAT, FILE, MEMORY. A face
 * whose loops are not simple comes as the whole surface, with a warning to the log. Lengths are millimetres. */
pia_status pia_occt_read(pia_context *context, const pia_input *input, const char *format, pia_model ***out, pia_index *count);

/* The models in what the plug-in said. */
pia_status pia_occt_parse(pia_context *context, const pia_input *input, const char *bytes, pia_index size, pia_model ***out,
                          pia_index *count);

#endif
