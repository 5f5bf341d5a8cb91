#include "step.h"

#include <stdarg.h>
#include <stdio.h>

long long pia_step_begin(pia_step *s)
{
    pia_output_text(s->output, "#%lld=", ++s->last);
    return s->last;
}

long long pia_step_put(pia_step *s, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    pia_step_begin(s);
    pia_output_text(s->output, "%s;\n", text);
    return s->last;
}

void pia_step_real(pia_step *s, double value)
{
    char text[PIA_CAD_REAL_SIZE];
    int length = pia_cad_real(value, text);
    pia_output_bytes(s->output, text, (size_t)length);
}

const char *pia_step_logical(int value)
{
    return value ? ".T." : ".F.";
}

void pia_step_references(pia_step *s, long long first, pia_index count, pia_index stride)
{
    pia_output_bytes(s->output, "(", 1);
    for (pia_index i = 0; i < count; i++) pia_output_text(s->output, i > 0 ? ",#%lld" : "#%lld", first + (long long)(i * stride));
    pia_output_bytes(s->output, ")", 1);
}

void pia_step_list(pia_step *s, const long long *item, pia_index count)
{
    pia_output_bytes(s->output, "(", 1);
    for (pia_index i = 0; i < count; i++) pia_output_text(s->output, i > 0 ? ",#%lld" : "#%lld", item[i]);
    pia_output_bytes(s->output, ")", 1);
}

long long pia_step_coordinates(pia_step *s, const char *entity, const double *x, int dim)
{
    long long number = pia_step_begin(s);
    pia_output_text(s->output, "%s('',(", entity);
    for (int d = 0; d < dim; d++) {
        if (d > 0) pia_output_bytes(s->output, ",", 1);
        pia_step_real(s, x[d]);
    }
    pia_output_text(s->output, "));\n");
    return number;
}
