#include "equations.h"

void pia_equations_clear(pia_context *context, pia_equations *e)
{
    pia_give(context, e->first);
    pia_give(context, e->entry);
}

/* The equation of a frozen unknown becomes d = 0. */
static void freeze_equation(pia_equations *e, pia_index c)
{
    for (int k = 0; k < e->width; k++) e->entry[c * e->width + k] = (e->first[c] + k) % e->n == c;
}

pia_status pia_equations_open(pia_context *context, const pia_collocation *c, const unsigned char *frozen, pia_equations *out)
{
    pia_equations e = {.n = c->unknowns, .width = c->degree + 1};
    e.first = pia_take(context, e.n, sizeof *e.first);
    e.entry = pia_take(context, e.n, (size_t)e.width * sizeof *e.entry);
    if (e.first == NULL || e.entry == NULL) {
        pia_equations_clear(context, &e);
        return PIA_E_MEMORY;
    }
    pia_index span = c->degree;
    for (pia_index row = 0; row < c->rows; row++) {
        span = pia_collocation_advance(c, row, span);
        if (!pia_collocation_entries(c, row, span, &e.first[row], e.entry + row * e.width)) e.wraps = 1;
        if (frozen != NULL && frozen[row]) freeze_equation(&e, row);
    }
    *out = e;
    return PIA_OK;
}
