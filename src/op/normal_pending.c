/* No operator has a normal form yet: gradients pass over the data. Whoever brings normal.c removes this file. */
#include "normal.h"

pia_status pia_normal_open(pia_op *op, const pia_targets *targets, pia_normal **out)
{
    (void)targets;
    (void)out;
    return pia_fail(op->context, PIA_E_UNAVAILABLE, "this operator has no normal form");
}

void pia_normal_close(pia_normal *normal)
{
    if (normal != NULL) normal->class->close(normal);
}
