/* Readers that are programs of their own (plugin/), started for each file: what they link is neither loaded nor harmed by this process.
 */
#ifndef PIA_IO_PLUGIN_H
#define PIA_IO_PLUGIN_H

#include "io.h"

struct pia_plugin {
    const char *program;  /* "pia-occt" */
    const char *part;     /* PIA_WITH_<part> builds it */
    const char *packages; /* what that needs, for the message */
};

extern const pia_plugin pia_plugin_occt, pia_plugin_hdf5;

/* Whether the program was found: in the folders of PIA_PLUGIN_PATH, or in lib/pia beside the library or the program. */
int pia_plugin_is_there(const pia_plugin *plugin);

/* Runs `program word path` and takes what it says, byte for byte; *bytes is taken with pia_take. An answer that is cut short tells that
 * it crashed. PIA_E_UNAVAILABLE without the program, naming what to install; PIA_E_FILE, MEMORY. */
pia_status pia_plugin_run(pia_context *context, const pia_input *input, const pia_plugin *plugin, const char *word, char **bytes,
                          pia_index *size);

/* PIA_E_FORMAT: the answer is cut short. */
pia_status pia_plugin_broke_off(pia_context *context, const pia_input *input, const pia_plugin *plugin);

#endif
