/* Where a plug-in's answer goes: the file descriptor that the library opened for it. */
#ifndef PIA_PLUGIN_CHANNEL_H
#define PIA_PLUGIN_CHANNEL_H

enum { PIA_PLUGIN_CHANNEL = 3 };

#endif
