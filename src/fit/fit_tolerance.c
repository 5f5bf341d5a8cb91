/* What rows may deviate: a distance, for all or each its own, and beside it what each component may. A deviation counts as its ratio to
 * what is allowed, the largest of them where there are several. */
#include "draft.h"
#include "number.h"
#include "refine.h"
#include "vector.h"

#include <math.h>
#include <string.h>

static pia_status take_rows(pia_fit *fit, const double *tolerances, double *largest)
{
    fit->tolerances = pia_take(fit->context, fit->rows, sizeof(double));
    fit->inverse_tolerance = pia_take(fit->context, fit->rows, sizeof(double));
    if (fit->tolerances == NULL || fit->inverse_tolerance == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < fit->rows; i++) {
        if (!(tolerances[i] > 0) || isinf(tolerances[i]))
            return pia_fail(fit->context, PIA_E_DATA, "tolerance %lld is %g; tolerances are finite and positive", (long long)i,
                            tolerances[i]);
        *largest = fmax(*largest, tolerances[i]);
        fit->tolerances[i] = tolerances[i];
        fit->inverse_tolerance[i] = 1 / tolerances[i];
    }
    return PIA_OK;
}

static pia_status check_axes(pia_fit *fit, const double *axes, pia_index count)
{
    if (count != fit->dim)
        return pia_fail(fit->context, PIA_E_SHAPE, "%lld axis tolerances were given, but %d components are fitted; give one for each",
                        (long long)count, fit->dim);
    for (int d = 0; d < fit->dim; d++)
        if (!(axes[d] > 0) || isinf(axes[d]))
            return pia_fail(fit->context, PIA_E_ARGUMENT, "axis tolerance %d is %g; tolerances are finite and positive", d, axes[d]);
    return PIA_OK;
}

/* The box of the axes is inside a ball: that is the tolerance of the whole where none was asked. */
static pia_status take_axes(pia_fit *fit, const double *axes, pia_index count, double *ball)
{
    double square = 0;
    pia_status status = check_axes(fit, axes, count);
    if (status == PIA_OK && fit->axis_tolerances == NULL) {
        fit->axis_tolerances = pia_take(fit->context, fit->dim, sizeof(double));
        if (fit->axis_tolerances == NULL) status = PIA_E_MEMORY;
    }
    if (status != PIA_OK) return status;
    for (int d = 0; d < fit->dim; d++) square += axes[d] * axes[d];
    memcpy(fit->axis_tolerances, axes, (size_t)fit->dim * sizeof *axes);
    *ball = sqrt(square);
    return PIA_OK;
}

pia_status pia_fit_take_tolerances(pia_fit *fit, const double *tolerances)
{
    double largest = 0, ball = 0;
    pia_status status = tolerances != NULL ? take_rows(fit, tolerances, &largest) : PIA_OK;
    if (status == PIA_OK && fit->options.axis_tolerance_count > 0)
        status = take_axes(fit, fit->options.axis_tolerances, fit->options.axis_tolerance_count, &ball);
    if (!(fit->options.tolerance > 0)) fit->options.tolerance = largest > 0 ? largest : ball;
    return status;
}

/* Numbers between commas into axes [PIA_MAX_DIM]. Returns how many; -1 where the text is something else. */
static pia_index read_axes(const char *text, double *axes)
{
    const char *end = text + strlen(text);
    for (pia_index count = 1; count <= PIA_MAX_DIM; count++) {
        text = pia_number_parse(text, end, &axes[count - 1]);
        if (text == NULL || (*text != '\0' && *text != ',')) return -1;
        if (*text++ == '\0') return count;
    }
    return -1;
}

static pia_status drop_axes(pia_fit *fit)
{
    if (fit->axis_tolerances != NULL) pia_refine_reopen(fit);
    pia_give(fit->context, fit->axis_tolerances);
    fit->axis_tolerances = NULL;
    return PIA_OK;
}

static pia_status exchange_axes(pia_fit *fit, const char *text)
{
    double axes[PIA_MAX_DIM], ball, *residual = fit->iterate.residual;
    pia_index count = read_axes(text, axes);
    if (count < 0)
        return pia_fail(fit->context, PIA_E_ARGUMENT,
                        "axis tolerances are numbers between commas, one for each component, or none; '%.40s' is something else", text);
    if (residual == NULL) residual = pia_take(fit->context, fit->rows * fit->dim, sizeof *residual);
    if (residual == NULL) return PIA_E_MEMORY;
    fit->iterate.residual = residual;
    if (fit->axis_tolerances == NULL || count != fit->dim || memcmp(axes, fit->axis_tolerances, (size_t)count * sizeof *axes) != 0)
        pia_refine_reopen(fit);
    pia_status status = take_axes(fit, axes, count, &ball);
    if (status == PIA_OK) fit->options.tolerance = fit->solve.rules.tolerance = ball;
    return status;
}

pia_status pia_fit_set_axes(pia_fit *fit, const char *text)
{
    pia_status status = strcmp(text, "none") == 0 ? drop_axes(fit) : exchange_axes(fit, text);
    if (status != PIA_OK) return status;
    fit->solve.rules.keeps = pia_fit_is_tolerance_alike(fit) ? NULL : pia_fit_keeps_tolerances;
    fit->solve.stop = PIA_STOP_NONE;
    fit->iterate.errors_known = 0;
    return PIA_OK;
}

int pia_fit_is_tolerance_alike(const pia_fit *fit)
{
    return fit->tolerances == NULL && fit->axis_tolerances == NULL;
}

/* A row without weight says nothing. */
double pia_refine_allowed(const pia_fit *fit, pia_index row)
{
    if (fit->weights != NULL && fit->weights[row] == 0) return INFINITY;
    return fit->tolerances != NULL ? fit->tolerances[row] : fit->options.tolerance;
}

double pia_refine_ratio(const pia_fit *fit, pia_index row, const double *deviation)
{
    double square = 0, allowed = pia_refine_allowed(fit, row);
    for (int d = 0; d < fit->dim; d++) square += deviation[d] * deviation[d];
    double ratio = sqrt(square) / allowed;
    for (int d = 0; fit->axis_tolerances != NULL && isfinite(allowed) && d < fit->dim; d++)
        ratio = fmax(ratio, fabs(deviation[d]) / fit->axis_tolerances[d]);
    return ratio;
}

PIA_INLINE double longest_of(const double *deviation, pia_index count, int dim)
{
    pia_lanes longest = {0};
    double worst = 0;
    pia_index row = 0;
    for (; row + PIA_LANES <= count; row += PIA_LANES) {
        pia_lanes square = {0};
        for (int d = 0; d < dim; d++) {
            pia_lanes x = pia_vector_component(deviation + row * dim, dim, d);
            square += x * x;
        }
        longest = pia_vector_upper(square, longest);
    }
    for (; row < count; row++) {
        double square = 0;
        for (int d = 0; d < dim; d++) square += deviation[row * dim + d] * deviation[row * dim + d];
        worst = fmax(worst, square);
    }
    for (int l = 0; l < PIA_LANES; l++) worst = fmax(worst, longest[l]);
    return sqrt(worst);
}

/* The length of the longest of these deviations [count x dim]. */
PIA_CLONES static double longest_deviation(const double *deviation, pia_index count, int dim)
{
    return dim == 3 ? longest_of(deviation, count, 3) : dim == 2 ? longest_of(deviation, count, 2) : longest_of(deviation, count, dim);
}

/* Whether the distance is all that counts, and the same for every row. */
static int is_alike(const pia_fit *fit)
{
    return pia_fit_is_tolerance_alike(fit) && fit->weights == NULL;
}

double pia_refine_worst(const pia_fit *fit, pia_index begin, pia_index end)
{
    double worst = 0;
    if (is_alike(fit))
        return longest_deviation(fit->iterate.residual + begin * fit->dim, end - begin, fit->dim) / fit->options.tolerance;
    for (pia_index row = begin; row < end; row++)
        worst = fmax(worst, pia_refine_ratio(fit, row, fit->iterate.residual + row * fit->dim));
    return worst;
}

double pia_refine_worst_of_all(const pia_fit *fit)
{
    return is_alike(fit) && fit->iterate.errors_known ? fit->iterate.errors.max / fit->options.tolerance
                                                      : pia_refine_worst(fit, 0, fit->rows);
}

int pia_fit_keeps_tolerances(pia_iterate *iterate)
{
    const pia_fit *fit = iterate->owner;
    pia_op_residual(iterate->op, iterate->points, &iterate->targets, iterate->residual);
    return pia_refine_worst(fit, 0, fit->rows) <= 1;
}

void pia_fit_describe_axes(pia_fit *fit)
{
    double error[PIA_MAX_DIM];
    if (fit->axis_tolerances == NULL || !fit->iterate.errors_known) return;
    pia_fit_axis_errors(fit, error);
    for (int d = 0; d < fit->dim; d++)
        if (error[d] > fit->axis_tolerances[d])
            pia_note_add(pia_memory_of(fit->context), &fit->outcome, "axis %d of %d deviates by up to %g, and may by %g", d + 1,
                         fit->dim, error[d], fit->axis_tolerances[d]);
}

int pia_fit_axis_errors(const pia_fit *fit, double *out)
{
    int worst = 0;
    memset(out, 0, (size_t)fit->dim * sizeof *out);
    for (pia_index row = 0; row < fit->rows; row++) {
        const double *r = fit->iterate.residual + row * fit->dim;
        if (isinf(pia_refine_allowed(fit, row))) continue;
        for (int d = 0; d < fit->dim; d++) out[d] = fmax(out[d], fabs(r[d]));
    }
    for (int d = 1; d < fit->dim; d++)
        if (out[d] * fit->axis_tolerances[worst] > out[worst] * fit->axis_tolerances[d]) worst = d;
    return worst;
}
