#include "checkpoint.h"

#include "bytes.h"
#include "crc32c.h"

#include <string.h>

static const char magic[8] = "PIACKPT\n";

enum { VERSION = 1, SECTION_HEADER = 16, END_MARK = 12, CHUNK = 2048 };

static int value_size(uint32_t type)
{
    return type == PIA_SECTION_TEXT ? 1 : 8;
}

/* ------------------------------------------------------------------------------------------------ writing ---- */

static uint32_t put_bytes(pia_output *output, uint32_t crc, const void *bytes, size_t size)
{
    pia_output_bytes(output, bytes, size);
    return pia_crc32c(crc, bytes, size);
}

static void put_crc(pia_output *output, uint32_t crc)
{
    unsigned char bytes[4];
    pia_bytes_store_little(bytes, 4, crc);
    pia_output_bytes(output, bytes, sizeof bytes);
}

/* Eight-byte values, a chunk at a time. */
static uint32_t put_words(pia_output *output, uint32_t crc, const void *data, pia_index count)
{
    unsigned char chunk[8 * CHUNK];
    for (pia_index done = 0; done < count;) {
        pia_index now = count - done < CHUNK ? count - done : CHUNK;
        for (pia_index i = 0; i < now; i++) {
            uint64_t word;
            memcpy(&word, (const char *)data + 8 * (done + i), sizeof word);
            pia_bytes_store_little(chunk + 8 * i, 8, word);
        }
        crc = put_bytes(output, crc, chunk, (size_t)(8 * now));
        done += now;
    }
    return crc;
}

void pia_checkpoint_begin(pia_checkpoint_writer *writer, pia_output *output)
{
    unsigned char version[4];
    *writer = (pia_checkpoint_writer){.output = output};
    pia_bytes_store_little(version, 4, VERSION);
    pia_output_bytes(output, magic, sizeof magic);
    pia_output_bytes(output, version, sizeof version);
}

void pia_checkpoint_put(pia_checkpoint_writer *writer, const char *name, pia_section_type type, const void *data, pia_index count)
{
    unsigned char header[SECTION_HEADER];
    size_t length = strlen(name);
    pia_bytes_store_little(header, 4, type);
    pia_bytes_store_little(header + 4, 4, length);
    pia_bytes_store_little(header + 8, 8, (uint64_t)count);
    uint32_t crc = put_bytes(writer->output, 0, header, sizeof header);
    crc = put_bytes(writer->output, crc, name, length);
    if (value_size(type) == 8)
        crc = put_words(writer->output, crc, data, count);
    else
        crc = put_bytes(writer->output, crc, data, (size_t)count);
    put_crc(writer->output, crc);
    writer->section_count++;
}

void pia_checkpoint_end(pia_checkpoint_writer *writer)
{
    unsigned char end[8] = {0};
    pia_bytes_store_little(end + 4, 4, writer->section_count);
    put_crc(writer->output, put_bytes(writer->output, 0, end, sizeof end));
}

/* ------------------------------------------------------------------------------------------------ reading ---- */

typedef struct section {
    char name[PIA_SECTION_NAME_SIZE];
    uint32_t type;
    pia_index count;
    const char *values; /* inside the file */
} section;

struct pia_checkpoint {
    pia_context *context;
    pia_input input; /* of pia_checkpoint_open; the path also of pia_checkpoint_scan */
    int owns_input;
    int section_count;
    section section[PIA_MAX_SECTIONS];
};

static pia_status refuse(const pia_checkpoint *checkpoint, const char *why)
{
    return pia_input_fail(checkpoint->context, &checkpoint->input, NULL, "%s; start the fit anew or take another checkpoint", why);
}

/* The section at *p, which moves behind it. Nothing is believed before its checksum agrees. */
static pia_status scan_section(pia_checkpoint *checkpoint, const char **p, const char *end)
{
    const char *begin = *p;
    uint64_t rest = (uint64_t)(end - begin);
    if (checkpoint->section_count == PIA_MAX_SECTIONS) return refuse(checkpoint, "holds too many sections");
    if (rest < SECTION_HEADER) return refuse(checkpoint, "ends inside a section");
    section *s = &checkpoint->section[checkpoint->section_count];
    s->type = (uint32_t)pia_bytes_load_little(begin, 4);
    uint64_t length = pia_bytes_load_little(begin + 4, 4), count = pia_bytes_load_little(begin + 8, 8);
    if (s->type > PIA_SECTION_TEXT || length < 1 || length >= PIA_SECTION_NAME_SIZE)
        return refuse(checkpoint, "holds a section of an unknown kind");
    uint64_t size = (uint64_t)value_size(s->type), room = rest - SECTION_HEADER;
    if (room < length + 4 || count > (room - length - 4) / size) return refuse(checkpoint, "ends inside a section");
    const char *values = begin + SECTION_HEADER + length, *after = values + count * size;
    if (pia_crc32c(0, begin, (size_t)(after - begin)) != pia_bytes_load_little(after, 4))
        return refuse(checkpoint, "is damaged: a checksum differs");
    memcpy(s->name, begin + SECTION_HEADER, (size_t)length);
    s->name[length] = '\0';
    s->count = (pia_index)count;
    s->values = values;
    checkpoint->section_count++;
    *p = after + 4;
    return PIA_OK;
}

static pia_status scan_file(pia_checkpoint *checkpoint)
{
    const char *p = checkpoint->input.begin, *end = checkpoint->input.end;
    if (end - p < (long)sizeof magic + 4 || memcmp(p, magic, sizeof magic) != 0) return refuse(checkpoint, "is not a checkpoint");
    if (pia_bytes_load_little(p + sizeof magic, 4) != VERSION) return refuse(checkpoint, "is a checkpoint of another version");
    p += sizeof magic + 4;
    while (end - p >= 4 && pia_bytes_load_little(p, 4) != 0) {
        pia_status status = scan_section(checkpoint, &p, end);
        if (status != PIA_OK) return status;
    }
    if (end - p != END_MARK || pia_crc32c(0, p, 8) != pia_bytes_load_little(p + 8, 4) ||
        pia_bytes_load_little(p + 4, 4) != (uint64_t)checkpoint->section_count)
        return refuse(checkpoint, "is damaged: its end is missing");
    return PIA_OK;
}

pia_status pia_checkpoint_scan(pia_context *context, const pia_input *input, pia_checkpoint **out)
{
    pia_checkpoint *checkpoint = pia_take_zero(context, 1, sizeof *checkpoint);
    if (checkpoint == NULL) return pia_take_status(context, 1, sizeof *checkpoint);
    checkpoint->context = context;
    checkpoint->input = *input;
    pia_status status = scan_file(checkpoint);
    if (status == PIA_OK)
        *out = checkpoint;
    else
        pia_checkpoint_close(checkpoint);
    return status;
}

pia_status pia_checkpoint_open(pia_context *context, const char *path, pia_checkpoint **out)
{
    pia_input input;
    pia_status status = pia_input_open(context, path, &input);
    if (status != PIA_OK) return status;
    status = pia_checkpoint_scan(context, &input, out);
    if (status == PIA_OK)
        (*out)->owns_input = 1;
    else
        pia_input_close(context, &input);
    return status;
}

static const section *find(const pia_checkpoint *checkpoint, const char *name, pia_section_type type)
{
    for (int i = 0; i < checkpoint->section_count; i++)
        if (checkpoint->section[i].type == (uint32_t)type && strcmp(checkpoint->section[i].name, name) == 0)
            return &checkpoint->section[i];
    return NULL;
}

static void load(const section *s, void *data)
{
    if (value_size(s->type) == 1) {
        if (s->count > 0) memcpy(data, s->values, (size_t)s->count);
        return;
    }
    for (pia_index i = 0; i < s->count; i++) {
        uint64_t word = pia_bytes_load_little(s->values + 8 * i, 8);
        memcpy((char *)data + 8 * i, &word, sizeof word);
    }
}

pia_status pia_checkpoint_get(pia_checkpoint *checkpoint, const char *name, pia_section_type type, void **data, pia_index *count)
{
    const section *s = find(checkpoint, name, type);
    if (s == NULL)
        return pia_input_fail(checkpoint->context, &checkpoint->input, NULL, "has no section '%s'; start the fit anew", name);
    pia_index room = s->count + (type == PIA_SECTION_TEXT);
    char *block = pia_take(checkpoint->context, room, (size_t)value_size(s->type));
    if (block == NULL) return pia_take_status(checkpoint->context, room, (size_t)value_size(s->type));
    load(s, block);
    if (type == PIA_SECTION_TEXT) block[s->count] = '\0';
    *data = block;
    *count = s->count;
    return PIA_OK;
}

pia_status pia_checkpoint_copy(pia_checkpoint *checkpoint, const char *name, pia_section_type type, void *data, pia_index count)
{
    const section *s = find(checkpoint, name, type);
    if (s == NULL || s->count != count)
        return pia_input_fail(checkpoint->context, &checkpoint->input, NULL, "has no section '%s' of %lld values; start the fit anew",
                              name, (long long)count);
    load(s, data);
    return PIA_OK;
}

int pia_checkpoint_has(const pia_checkpoint *checkpoint, const char *name, pia_section_type type, pia_index *count)
{
    const section *s = find(checkpoint, name, type);
    if (s != NULL && count != NULL) *count = s->count;
    return s != NULL;
}

void pia_checkpoint_close(pia_checkpoint *checkpoint)
{
    if (checkpoint == NULL) return;
    if (checkpoint->owns_input) pia_input_close(checkpoint->context, &checkpoint->input);
    pia_give(checkpoint->context, checkpoint);
}
