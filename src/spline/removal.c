#include "removal.h"

#include <math.h>

void pia_removal_open(const double *knots, int degree, pia_index index, int multiplicity, pia_removal *out)
{
    *out = (pia_removal){.index = index, .first = index - degree, .multiplicity = multiplicity, .count = degree - multiplicity + 1};
    double value = 1, sum = 0;
    for (int k = 0; k < out->count; k++) {
        pia_index i = out->first + k;
        out->a[k] = (knots[index] - knots[i]) / (knots[i + degree + 1] - knots[i]);
        if (k > 0) value *= -out->a[k - 1] / (1 - out->a[k]);
        out->null[k] = value;
        sum += fabs(value);
    }
    for (int k = 0; k < out->count; k++) out->null[k] /= sum;
}

/* With the residuals known, each half of the new points follows from its own end, where the divisors are at least 1/2. */
static void solve_component(const pia_removal *r, const double *old, pia_index stride, int width, double defect, double *points)
{
    int left = 0, last = r->count - 1;
    double before = old[-stride], after = old[r->count * stride];
    for (; left < last && r->a[left] >= 0.5; left++) {
        double target = old[left * stride] - copysign(defect, defect * r->null[left]);
        before = (target - (1 - r->a[left]) * before) / r->a[left];
        points[left * width] = before;
    }
    for (int k = last; k > left; k--) {
        double target = old[k * stride] - copysign(defect, defect * r->null[k]);
        after = (target - r->a[k] * after) / (1 - r->a[k]);
        points[(k - 1) * width] = after;
    }
}

void pia_removal_solve(const pia_removal *r, const double *line, pia_index stride, int width, double *points, double *defect)
{
    const double *old = line + r->first * stride;
    int last = r->count - 1;
    for (int c = 0; c < width; c++) {
        double sum = -r->null[0] * (1 - r->a[0]) * old[c - stride] - r->null[last] * r->a[last] * old[c + r->count * stride];
        for (int k = 0; k < r->count; k++) sum += r->null[k] * old[c + k * stride];
        defect[c] = sum;
        solve_component(r, old + c, stride, width, sum, points + c);
    }
}
