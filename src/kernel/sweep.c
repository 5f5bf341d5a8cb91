/* Sweeps over long arrays, side by side. */
#include "kernel.h"

#include <string.h>

enum { GRAIN = 16384, MAX_CHUNKS = 64 };

static pia_index chunk_count(pia_index count)
{
    pia_index chunks = pia_chunk_count(count, GRAIN);
    return chunks < MAX_CHUNKS ? chunks : MAX_CHUNKS;
}

typedef struct question {
    pia_check *check;
    const void *data;
    pia_index count, chunks;
    int *answer; /* [chunks] */
} question;

static void ask_chunk(void *work, pia_index chunk)
{
    const question *q = work;
    q->answer[chunk] = q->check(q->data, pia_chunk_begin(q->count, q->chunks, chunk), pia_chunk_begin(q->count, q->chunks, chunk + 1));
}

int pia_all(pia_context *context, pia_index count, pia_check *check, const void *data)
{
    int answer[MAX_CHUNKS], all = 1;
    if (count < 1) return 1;
    question q = {check, data, count, chunk_count(count), answer};
    pia_for_each(context, q.chunks, ask_chunk, &q);
    for (pia_index c = 0; c < q.chunks; c++) all &= answer[c];
    return all;
}

typedef struct copy {
    double *to;
    const double *from;
    pia_index count, chunks;
} copy;

static void copy_chunk(void *work, pia_index chunk)
{
    const copy *c = work;
    pia_index begin = pia_chunk_begin(c->count, c->chunks, chunk), end = pia_chunk_begin(c->count, c->chunks, chunk + 1);
    memcpy(c->to + begin, c->from + begin, (size_t)(end - begin) * sizeof *c->to);
}

void pia_copy(pia_context *context, double *to, const double *from, pia_index count)
{
    copy c = {to, from, count, chunk_count(count)};
    pia_for_each(context, c.chunks, copy_chunk, &c);
}
