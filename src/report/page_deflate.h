/* Bytes into a page: deflated (zlib's format, RFC 1950) and written in base64 (RFC 4648). */
#ifndef PIA_REPORT_PAGE_DEFLATE_H
#define PIA_REPORT_PAGE_DEFLATE_H

#include "output.h"

/* PIA_E_MEMORY. */
pia_status pia_page_deflate(pia_context *context, pia_output *output, const void *bytes, pia_index count);

#endif
