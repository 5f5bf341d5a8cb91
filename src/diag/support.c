#include "support.h"

#include <math.h>
#include <string.h>

#include "knots.h"

/* Walks over the different parameters of positive weight, round and round when closed. */
typedef struct cursor {
    const pia_support_line *line;
    pia_index index; /* < count, or count: at the end */
    double shift;    /* periods walked */
} cursor;

static double here(const cursor *c)
{
    return c->line->parameters[c->index] + c->shift;
}

static int counts(const pia_support_line *line, pia_index i)
{
    return line->weights == NULL || line->weights[i] > 0;
}

static double period(const pia_support_line *line)
{
    return line->closed ? line->knots[line->degree + line->control] - line->knots[line->degree] : 0;
}

/* To the next row that counts, at or after the present one. */
static void settle(cursor *c, int may_turn)
{
    const pia_support_line *line = c->line;
    while (c->index < line->count && !counts(line, c->index)) c->index++;
    if (c->index < line->count || !may_turn) return;
    c->index = 0;
    c->shift += period(line);
    settle(c, 0);
}

static cursor start(const pia_support_line *line)
{
    cursor c = {line, 0, 0};
    settle(&c, 0);
    return c;
}

static void advance(cursor *c)
{
    double t = c->line->parameters[c->index];
    while (c->index < c->line->count && (c->line->parameters[c->index] == t || !counts(c->line, c->index))) c->index++;
    settle(c, c->line->closed);
}

/* Column s in the order of the walk: closed lines start with the function that begins at the start of the domain. */
static pia_index column_of(const pia_support_line *line, pia_index s)
{
    return line->closed ? s + line->degree : s;
}

/* -1: t lies before the places where the function is positive, 1: after them, 0: among them, as (degree + 1)-fold ends are. */
static int side(const pia_support_line *line, pia_index s, double t)
{
    const double *u = line->knots + column_of(line, s);
    int p = line->degree;
    if (t < u[0] || (t == u[0] && u[0] != u[p])) return -1;
    if (t > u[p + 1] || (t == u[p + 1] && u[p + 1] != u[1])) return 1;
    return 0;
}

/* Gives the columns from, from + 1, ... the parameters from c on, earliest first, up to `limit`. Returns how many get one. */
static pia_index match(const pia_support_line *line, pia_index from, cursor c, double limit, unsigned char *held)
{
    pia_index found = 0;
    memset(held, 0, (size_t)line->control * sizeof *held);
    for (pia_index s = from; s < line->control; s++) {
        while (c.index < line->count && side(line, s, here(&c)) < 0) advance(&c);
        if (c.index == line->count || here(&c) >= limit) break;
        if (side(line, s, here(&c)) > 0) continue;
        held[column_of(line, s) % line->control] = 1;
        found++;
        advance(&c);
    }
    return found;
}

/* A closed walk may begin with any of the parameters of its first column. The first degree + 1 are enough: at most `degree` columns at
 * the end of the walk reach back into that support, so that one of these parameters is left for the first column. */
static pia_index match_closed(const pia_support_line *line, cursor c, unsigned char *held)
{
    pia_index from = 0, found = 0, most = -1;
    cursor best = c;
    for (; from < line->control; from++) {
        while (side(line, from, here(&c)) < 0) advance(&c);
        if (side(line, from, here(&c)) == 0) break;
    }
    for (int k = 0; k <= line->degree && most < line->control && side(line, from, here(&c)) == 0; k++) {
        found = match(line, from, c, here(&c) + period(line), held);
        if (found > most) {
            most = found;
            best = c;
        }
        advance(&c);
    }
    return found == most ? found : match(line, from, best, here(&best) + period(line), held);
}

pia_index pia_support_find(const pia_support_line *line, unsigned char *held)
{
    cursor c = start(line);
    int nothing = c.index == line->count;
    return line->control - (line->closed && !nothing ? match_closed(line, c, held) : match(line, 0, c, INFINITY, held));
}

/* Sums of degree + 1 neighbours: what lies in the spans i .. i + degree, from what lies in each span. */
static void widen(pia_index *data, pia_index count, pia_index step, int degree)
{
    for (pia_index i = 0; i < count; i++)
        for (pia_index k = 1; k <= degree && i + k < count; k++) data[i * step] += data[(i + k) * step];
}

pia_index pia_support_count(const int degree[2], const double *const knots[2], const pia_index control[2], const double *pairs,
                            const double *weights, pia_index count, pia_index *data)
{
    pia_index zeroes = 0, size = control[0] * control[1];
    memset(data, 0, (size_t)size * sizeof *data);
    for (pia_index i = 0; i < count; i++) {
        if (weights != NULL && !(weights[i] > 0)) continue;
        pia_index u = pia_knots_span(knots[0], degree[0], control[0], pairs[2 * i]);
        pia_index v = pia_knots_span(knots[1], degree[1], control[1], pairs[2 * i + 1]);
        data[u * control[1] + v]++;
    }
    for (pia_index i = 0; i < control[0]; i++) widen(data + i * control[1], control[1], 1, degree[1]);
    for (pia_index j = 0; j < control[1]; j++) widen(data + j, control[0], control[1], degree[0]);
    for (pia_index i = 0; i < size; i++) zeroes += data[i] == 0;
    return zeroes;
}
