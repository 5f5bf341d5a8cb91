#include "page_template.h"

#include <string.h>

/* The assembler reads the file whole, whatever compiler calls it; PIA_PAGE_FILE is its path, given by the build. */
__asm__(".pushsection .rodata\n"
        ".hidden pia_page_begin, pia_page_end\n"
        ".globl pia_page_begin, pia_page_end\n"
        "pia_page_begin: .incbin \"" PIA_PAGE_FILE "\"\n"
        "pia_page_end: .byte 0\n"
        ".popsection\n");

extern const char pia_page_begin[] __attribute__((visibility("hidden")));
extern const char pia_page_end[] __attribute__((visibility("hidden")));

void pia_page_template(pia_slice out[3])
{
    static const char *const mark[2] = {"<!--pia:title-->", "<!--pia:data-->"};
    const char *begin = pia_page_begin;
    for (int k = 0; k < 2; k++) {
        const char *end = memmem(begin, (size_t)(pia_page_end - begin), mark[k], strlen(mark[k]));
        if (end == NULL) end = pia_page_end;
        out[k] = (pia_slice){begin, (size_t)(end - begin)};
        begin = end == pia_page_end ? end : end + strlen(mark[k]);
    }
    out[2] = (pia_slice){begin, (size_t)(pia_page_end - begin)};
}
