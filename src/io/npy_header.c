#include "npy_header.h"

#include "bytes.h"

#include <stdio.h>
#include <string.h>

/* The dictionary is Python text: {'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), } in any order. */

typedef struct scanner {
    const char *p, *end;
} scanner;

static void skip_blanks(scanner *s)
{
    while (s->p < s->end && (*s->p == ' ' || *s->p == '\n' || *s->p == '\t')) s->p++;
}

static int accept(scanner *s, const char *word)
{
    size_t length = strlen(word);
    skip_blanks(s);
    if ((size_t)(s->end - s->p) < length || memcmp(s->p, word, length) != 0) return 0;
    s->p += length;
    return 1;
}

/* 'text' or "text", at most size - 1 characters. */
static int scan_string(scanner *s, char *text, size_t size)
{
    size_t length = 0;
    char quote = accept(s, "'") ? '\'' : accept(s, "\"") ? '"' : '\0';
    if (quote == '\0') return 0;
    for (; s->p < s->end && *s->p != quote && length + 1 < size; s->p++) text[length++] = *s->p;
    text[length] = '\0';
    if (s->p >= s->end || *s->p != quote) return 0;
    s->p++;
    return 1;
}

/* A count; numbers that do not fit in 64 bits are not one. */
static int scan_count(scanner *s, pia_index *value)
{
    const char *begin = s->p;
    *value = 0;
    for (; s->p < s->end && *s->p >= '0' && *s->p <= '9'; s->p++)
        if (!pia_multiply(*value, 10, value) || __builtin_add_overflow(*value, *s->p - '0', value)) return 0;
    return s->p > begin;
}

static int scan_shape(scanner *s, pia_npy_header *header)
{
    if (!accept(s, "(")) return 0;
    while (!accept(s, ")")) {
        if (header->directions == PIA_NPY_MAX_DIRECTIONS || !scan_count(s, &header->shape[header->directions++])) return 0;
        if (!accept(s, ",") && (skip_blanks(s), s->p == s->end || *s->p != ')')) return 0;
        skip_blanks(s);
    }
    return header->directions > 0;
}

static int scan_type(scanner *s, pia_npy_header *header)
{
    char text[8];
    int size;
    if (!scan_string(s, text, sizeof text) || strchr("<>|=", text[0]) == NULL || text[0] == '\0') return 0;
    if (sscanf(text + 1, "%c%1d", &header->type, &size) != 2 || strchr("fiub", header->type) == NULL || text[3] != '\0') return 0;
    header->size = size;
    header->big = text[0] == '>' || (text[0] == '=' && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
    return size == 4 || size == 8 || (header->type != 'f' && (size == 1 || size == 2));
}

static pia_status scan_dictionary(pia_context *context, const pia_input *input, scanner s, pia_npy_header *header)
{
    char key[20];
    int found = 0;
    if (!accept(&s, "{")) return pia_input_fail(context, input, NULL, "its NPY header is no dictionary; write it again");
    while (!accept(&s, "}")) {
        if (!scan_string(&s, key, sizeof key) || !accept(&s, ":")) break;
        if (strcmp(key, "descr") == 0 && (found & 1) == 0) {
            if (!scan_type(&s, header))
                return pia_input_fail(context, input, NULL,
                                      "its values are no plain numbers (f4, f8, i1 to i8, u1 to u8); convert them with astype('f8')");
            found |= 1;
        } else if (strcmp(key, "fortran_order") == 0) {
            header->transpose = accept(&s, "True");
            if (!header->transpose && !accept(&s, "False")) break;
            found |= 2;
        } else if (strcmp(key, "shape") == 0 && (found & 4) == 0) {
            if (!scan_shape(&s, header))
                return pia_input_fail(context, input, NULL,
                                      "its shape is not one to three counts of at most 64 bits; reshape it or write it again");
            found |= 4;
        } else {
            break;
        }
        accept(&s, ",");
    }
    return found == 7 ? PIA_OK
                      : pia_input_fail(context, input, NULL, "its NPY header lacks descr, fortran_order or shape; write it again");
}

pia_status pia_npy_read_header(pia_context *context, const pia_input *input, pia_npy_header *out)
{
    const char *begin = input->begin;
    pia_index size = input->end - begin;
    if (size < 10 || memcmp(begin, "\x93NUMPY", 6) != 0)
        return pia_input_fail(context, input, NULL, "is not an NPY file; name its format");
    int version = begin[6], wide = version > 1 ? 4 : 2;
    if (version < 1 || version > 3)
        return pia_input_fail(context, input, NULL, "has NPY version %d; write it as version 1 to 3", version);
    if (size < 8 + wide) return pia_input_fail(context, input, NULL, "ends inside its NPY header");
    pia_index length = (pia_index)pia_bytes_load_little(begin + 8, wide), rest = size - 8 - wide;
    if (length > rest) return pia_input_fail(context, input, NULL, "ends inside its NPY header");
    pia_npy_header header = {0};
    const char *dictionary = begin + 8 + wide;
    pia_status status = scan_dictionary(context, input, (scanner){dictionary, dictionary + length}, &header);
    if (status != PIA_OK) return status;
    header.values = dictionary + length;
    header.count = 1;
    pia_index bytes = 0;
    int fits = 1;
    for (int d = 0; d < header.directions; d++) fits = fits && pia_multiply(header.count, header.shape[d], &header.count);
    if (!fits || !pia_multiply(header.count, header.size, &bytes) || bytes > rest - length)
        return pia_input_fail(context, input, NULL,
                              "its NPY header claims more values than the %lld bytes of the file hold; copy it again", (long long)size);
    *out = header;
    return PIA_OK;
}

void pia_npy_write_header(pia_output *output, const pia_index *shape, int directions)
{
    enum { MAGIC = 10, SIZE = 128 }; /* values begin at a multiple of 64 */
    char text[SIZE] = "\x93NUMPY\x01";
    int length = MAGIC + snprintf(text + MAGIC, SIZE - MAGIC, "{'descr': '<f8', 'fortran_order': False, 'shape': (");
    for (int d = 0; d < directions; d++) length += snprintf(text + length, (size_t)(SIZE - length), "%lld, ", (long long)shape[d]);
    length += snprintf(text + length, (size_t)(SIZE - length), "), }");
    memset(text + length, ' ', (size_t)(SIZE - length));
    text[SIZE - 1] = '\n';
    pia_bytes_store_little(text + 8, 2, SIZE - MAGIC);
    pia_output_bytes(output, text, SIZE);
}
