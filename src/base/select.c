#include "select.h"

static void exchange(double *a, double *b)
{
    double value = *a;
    *a = *b;
    *b = value;
}

/* Median of the first, middle and last value. */
static double pivot_of(const double *values, pia_index low, pia_index high)
{
    double a = values[low], b = values[low + (high - low) / 2], c = values[high];
    if (a > b) exchange(&a, &b);
    if (b > c) b = c;
    return a > b ? a : b;
}

/* Hoare's selection: both scans stop at values equal to the pivot, so that many equal values split evenly. */
double pia_select(double *values, pia_index count, pia_index rank)
{
    pia_index low = 0, high = count - 1;
    while (low < high) {
        double pivot = pivot_of(values, low, high);
        pia_index i = low, j = high;
        while (i <= j) {
            while (values[i] < pivot) i++;
            while (values[j] > pivot) j--;
            if (i > j) break;
            exchange(&values[i++], &values[j--]);
        }
        if (rank <= j)
            high = j;
        else if (rank >= i)
            low = i;
        else
            break;
    }
    return values[rank];
}
