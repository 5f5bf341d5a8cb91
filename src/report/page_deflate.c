#include "page_deflate.h"

#define ZLIB_CONST
#include <zlib.h>

/* Bytes become base64 in threes; up to two wait for the next ones. */
typedef struct base64 {
    pia_output *output;
    unsigned waiting; /* the bytes that wait, first one highest */
    int count;
} base64;

static void put_letters(base64 *to, unsigned three, int letters)
{
    static const char letter[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char text[4] = {'=', '=', '=', '='};
    for (int k = 0; k < letters; k++) text[k] = letter[three >> (18 - 6 * k) & 63];
    pia_output_bytes(to->output, text, sizeof text);
}

static void put_bytes(base64 *to, const unsigned char *byte, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        to->waiting = to->waiting << 8 | byte[i];
        if (++to->count < 3) continue;
        put_letters(to, to->waiting, 4);
        to->waiting = 0;
        to->count = 0;
    }
}

static void finish(base64 *to)
{
    if (to->count > 0) put_letters(to, to->waiting << (24 - 8 * to->count), to->count + 1);
}

static void *take(void *context, unsigned count, unsigned size)
{
    return pia_take(context, count, size);
}

static void give(void *context, void *block)
{
    pia_give(context, block);
}

/* zlib counts in 32 bits: the input is handed over in pieces. */
static void deflate_all(z_stream *stream, base64 *to, const unsigned char *byte, pia_index count)
{
    enum { PIECE = 1 << 24, BUFFER = 1 << 14 };
    unsigned char buffer[BUFFER];
    do {
        pia_index piece = count < PIECE ? count : PIECE;
        stream->next_in = byte;
        stream->avail_in = (unsigned)piece;
        byte += piece;
        count -= piece;
        do {
            stream->next_out = buffer;
            stream->avail_out = BUFFER;
            deflate(stream, count > 0 ? Z_NO_FLUSH : Z_FINISH);
            put_bytes(to, buffer, BUFFER - stream->avail_out);
        } while (stream->avail_out == 0);
    } while (count > 0);
}

pia_status pia_page_deflate(pia_context *context, pia_output *output, const void *bytes, pia_index count)
{
    z_stream stream = {.zalloc = take, .zfree = give, .opaque = context};
    base64 to = {.output = output};
    if (deflateInit(&stream, Z_BEST_COMPRESSION) != Z_OK) return pia_fail(context, PIA_E_MEMORY, "out of memory for deflating a page");
    deflate_all(&stream, &to, bytes, count);
    deflateEnd(&stream);
    finish(&to);
    return PIA_OK;
}
