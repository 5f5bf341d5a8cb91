/* The table of options: what pia_fit_options_init writes, which values are accepted, and what a binding is told, in one place. */
#include "fit.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define AT(member, kind) .name = #member, .type = PIA_OPTION_##kind, .offset = offsetof(pia_fit_options, member)
#define COUNTED(member) .count_offset = offsetof(pia_fit_options, member)
#define RANGE(least, most) .minimum = (least), .maximum = (most)

static const pia_option table[] = {
    {AT(degree, INTEGER), .directions = 2, RANGE(1, PIA_MAX_DEGREE), .initial = 3, .sentence = "degree in each direction"},
    {AT(closed, SWITCH), .directions = 2, RANGE(0, 1), .sentence = "periodic in that direction; a repeated last point is accepted"},
    {AT(control, COUNT), .directions = 2, .automatic = 1, RANGE(1, INFINITY), .initial = PIA_AUTO,
     .sentence = "control points; left out: as many as the method or the tolerance needs"},
    {AT(tolerance, NUMBER), RANGE(0, DBL_MAX),
     .sentence = "largest deviation wanted, units of the points; knots are added until it holds; 0: none asked"},
    {AT(axis_tolerances, NUMBERS), COUNTED(axis_tolerance_count),
     .sentence = "largest deviation wanted of each component that is fitted, beside the tolerance of the whole"},
    {AT(measure_distance, SWITCH), RANGE(0, 1), .sentence = "tolerance and report measure true distance"},
    {AT(method, NAME), .values = "method", .sentence = "how the fit is computed; left out: auto"},
    {AT(method_options, SETTINGS), COUNTED(method_option_count), .sentence = "parameters of the method"},
    {AT(parametrization, NAME), .values = "parametrization",
     .sentence = "how parameters of the points are computed; left out: chord, or the method's own"},
    {AT(placement, NAME), .values = "placement", .sentence = "how knots are placed; left out: the method's own"},
    {AT(limiter, NAME), .values = "limiter", .sentence = "shape that steps must keep; left out: none"},
    {AT(limiter_options, SETTINGS), COUNTED(limiter_option_count), .sentence = "parameters of the limiter"},
    {AT(knots, NUMBERS), COUNTED(knot_count), .directions = 2,
     .sentence = "full knot vectors, control + degree + 1 values each; left out: placed"},
    {AT(start, MODEL), .sentence = "its knots, degrees and control points are iterate 0; left out: the method's own start"},
    {AT(interpolate, INDICES), COUNTED(interpolate_count), .sentence = "data rows met exactly"},
    {AT(constraints, CONSTRAINTS), COUNTED(constraint_count), .sentence = "values and derivatives met exactly"},
    {AT(joins, JOINS), COUNTED(join_count), .sentence = "neighbouring models to go on from"},
    {AT(soft, NUMBER), RANGE(0, DBL_MAX), .sentence = "constraints become least-squares rows of this weight; 0: they are hard"},
    {AT(freeze, INDICES), COUNTED(freeze_count), .sentence = "control points that stay, row-major indices"},
    {AT(fairing, NUMBER), RANGE(0, DBL_MAX),
     .sentence = "weight of the fairing energy, relative: 1 makes it as strong as the data; 0: none"},
    {AT(robust, NAME), .values = "huber|tukey", .sentence = "robust loss, so that outliers pull less; left out: none"},
    {AT(robust_scale, NUMBER), .automatic = 1, RANGE(DBL_MIN, DBL_MAX), .initial = PIA_AUTO,
     .sentence = "tuning constant of the robust loss; left out: 1.345 for huber, 4.685 for tukey"},
    {AT(between, NUMBER), RANGE(0, DBL_MAX), .initial = 0,
     .sentence = "how far a curve found for a tolerance may be from the straight line between far points, in tolerances, beside what "
                 "their bend explains; 0: no matter"},
    {AT(correct, COUNT), RANGE(0, INFINITY), .sentence = "rounds of foot-point correction of the parameters; 0: none"},
    {AT(corners, INDICES), COUNTED(corner_count), .automatic = 1, .sentence = "data rows that are corners of the curve; auto: found"},
    {AT(max_iterations, COUNT), .automatic = 1, RANGE(0, INFINITY), .initial = PIA_AUTO,
     .sentence = "most iterations; left out: the method's own"},
    {AT(stop_change, NUMBER), .automatic = 1, RANGE(0, DBL_MAX), .initial = PIA_AUTO,
     .sentence = "stop when no control point moves more, units of the points; 0: never; left out: 1e-14 of the extent"},
    {AT(stop_gradient, NUMBER), .automatic = 1, RANGE(0, DBL_MAX), .initial = PIA_AUTO,
     .sentence = "stop at this relative gradient; 0: never; left out: 1e-12 where the method has a gradient"},
    {AT(time_limit, NUMBER), RANGE(0, INFINITY), .sentence = "seconds; 0: none"},
    {AT(trace_every, COUNT), RANGE(0, INFINITY), .sentence = "rows of the trace: 0 none, k every k-th iteration and the last"},
};

enum { OPTIONS = sizeof table / sizeof *table };

static int is_number(pia_option_type type)
{
    return type <= PIA_OPTION_NUMBER;
}

int pia_list_options(pia_index index, pia_option *out)
{
    if (index < 0 || index >= OPTIONS || out == NULL) return 0;
    *out = table[index];
    if (out->directions == 0) out->directions = 1;
    return 1;
}

static double number_of(const pia_fit_options *options, const pia_option *option, int d)
{
    const char *member = (const char *)options + option->offset;
    switch (option->type) {
    case PIA_OPTION_SWITCH:
    case PIA_OPTION_INTEGER: return ((const int *)(const void *)member)[d];
    case PIA_OPTION_COUNT: return (double)((const pia_index *)(const void *)member)[d];
    default: return ((const double *)(const void *)member)[d];
    }
}

void pia_fit_options_init(pia_fit_options *options)
{
    memset(options, 0, sizeof *options);
    options->struct_size = sizeof *options;
    pia_option option;
    for (pia_index i = 0; pia_list_options(i, &option); i++) {
        if (!is_number(option.type)) continue;
        char *member = (char *)options + option.offset;
        for (int d = 0; d < option.directions; d++) switch (option.type) {
            case PIA_OPTION_SWITCH:
            case PIA_OPTION_INTEGER: ((int *)(void *)member)[d] = (int)option.initial; break;
            case PIA_OPTION_COUNT: ((pia_index *)(void *)member)[d] = (pia_index)option.initial; break;
            default: ((double *)(void *)member)[d] = option.initial; break;
            }
    }
}

static pia_status check_number(pia_context *context, const pia_option *option, double value)
{
    if (option->type == PIA_OPTION_SWITCH || (option->automatic && value == PIA_AUTO)) return PIA_OK;
    if (value >= option->minimum && value <= option->maximum) return PIA_OK;
    return pia_fail(context, PIA_E_ARGUMENT, "%s is %g; give %s from %g to %g: %s", option->name, value,
                    option->type == PIA_OPTION_NUMBER ? "a number" : "a count", option->minimum, option->maximum, option->sentence);
}

static pia_status check_array(pia_context *context, const pia_fit_options *options, const pia_option *option, int d)
{
    const void *array;
    pia_index count;
    memcpy(&array, (const char *)options + option->offset + (size_t)d * sizeof array, sizeof array);
    memcpy(&count, (const char *)options + option->count_offset + (size_t)d * sizeof count, sizeof count);
    if ((option->automatic && count == PIA_AUTO) || (count >= 0 && (count == 0 || array != NULL))) return PIA_OK;
    return pia_fail(context, PIA_E_ARGUMENT, "%s has %s and a count of %lld; give an array and how many it holds", option->name,
                    array != NULL ? "an array" : "no array", (long long)count);
}

/* Of a curve, what would hold for v is not looked at. */
pia_status pia_fit_check_options(pia_fit *fit, int directions)
{
    pia_option option;
    for (pia_index i = 0; pia_list_options(i, &option); i++)
        for (int d = 0; d < option.directions && d < directions; d++) {
            pia_status status = PIA_OK;
            if (is_number(option.type))
                status = check_number(fit->context, &option, number_of(&fit->options, &option, d));
            else if (option.count_offset > 0)
                status = check_array(fit->context, &fit->options, &option, d);
            if (status != PIA_OK) return status;
        }
    return PIA_OK;
}
