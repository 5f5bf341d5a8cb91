/* Fences and groups of [2011] against Eq. (43) and (44) read literally. */
#include "fence.h"

#include <stdlib.h>

#include "check.h"

enum { COUNT = 60 };

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static pia_index make(uint64_t seed, double *t, double *k, pia_index *chosen)
{
    double sum = 0;
    pia_index control = 0;
    for (int i = 0; i < COUNT; i++) {
        t[i] = sum;
        sum += 0.1 + random_number(&seed);
        k[i] = random_number(&seed) * 3;
        if (i == 0 || i == COUNT - 1 || random_number(&seed) < 0.2) chosen[control++] = i;
    }
    for (int i = 0; i < COUNT; i++) t[i] /= t[COUNT - 1] > 0 ? sum : 1;
    return control;
}

/* lambda from a to b in the interval that starts at s and ends at e, Eq. (44). */
static double lambda(const double *t, const double *k, pia_index s, pia_index e, pia_index a, pia_index b, int balanced)
{
    double low = k[s], high = k[s], sum = 0;
    for (pia_index j = s; j <= e; j++) {
        low = fmin(low, k[j]);
        high = fmax(high, k[j]);
    }
    for (pia_index j = a; j < b; j++)
        sum += exp((k[j] - low) / (high - low)) * (balanced ? t[j + 1] - t[j] : t[j] - t[s]) / (t[e] - t[s]);
    return sum;
}

static void markers_minimise_the_difference_of_the_lambdas(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++)
        for (int balanced = 0; balanced < 2; balanced++) {
            double t[COUNT], k[COUNT];
            pia_index chosen[COUNT], first[COUNT + 1], control = make(seed, t, k, chosen);
            pia_fence_place(balanced ? PIA_FENCE_BALANCED : PIA_FENCE_PRINTED, t, k, COUNT, chosen, control, first);
            assert_true(first[0] == 0 && first[control] == COUNT);
            for (pia_index i = 1; i < control; i++) {
                pia_index s = chosen[i - 1], e = chosen[i], best = e;
                double least = INFINITY;
                for (pia_index w = s + 1; w < e; w++) {
                    double difference = fabs(lambda(t, k, s, e, s, w, balanced) - lambda(t, k, s, e, w, e, balanced));
                    if (difference < least - 1e-13) best = w;
                    least = fmin(least, difference);
                }
                assert_int_equal(first[i], best);
            }
        }
}

/* What methods without bias should do, and what the printed rule does. */
static void constant_curvature_puts_the_marker_at_the_middle_or_at_root_half(void **state)
{
    (void)state;
    enum { MANY = 1001 };
    double t[MANY], k[MANY];
    pia_index chosen[2] = {0, MANY - 1}, first[3];
    for (int i = 0; i < MANY; i++) {
        t[i] = (double)i / (MANY - 1);
        k[i] = 7;
    }
    pia_fence_place(PIA_FENCE_PRINTED, t, k, MANY, chosen, 2, first);
    assert_near(t[first[1]], sqrt(0.5), 1e-3);
    pia_fence_place(PIA_FENCE_BALANCED, t, k, MANY, chosen, 2, first);
    assert_near(t[first[1]], 0.5, 1e-3);
}

static void groups_hold_their_own_line_and_own_groups_nothing_else(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        double t[COUNT], k[COUNT];
        unsigned char own[COUNT] = {0};
        int group_of[COUNT];
        pia_index chosen[COUNT], first[COUNT + 1], begin[COUNT], end[COUNT], control = make(seed, t, k, chosen);
        uint64_t more = seed + 100;
        for (pia_index i = 0; i < control; i++) own[chosen[i]] = random_number(&more) < 0.4;
        pia_fence_place(PIA_FENCE_PRINTED, t, k, COUNT, chosen, control, first);
        pia_fence_groups(first, chosen, control, own, begin, end);
        for (int j = 0; j < COUNT; j++) group_of[j] = -1;
        for (pia_index i = 0; i < control; i++) {
            assert_true(begin[i] <= chosen[i] && chosen[i] < end[i]); /* never empty */
            if (own[chosen[i]]) assert_int_equal(end[i] - begin[i], 1);
            for (pia_index j = begin[i]; j < end[i]; j++) {
                assert_int_equal(group_of[j], -1);
                group_of[j] = (int)i;
            }
        }
        for (pia_index j = 0; j < COUNT; j++) { /* a line is in no group only between two that keep to themselves */
            pia_index i = 0;
            while (i + 1 < control && chosen[i + 1] <= j) i++;
            int lost = own[chosen[i]] && (i + 1 == control || own[chosen[i + 1]]) && j != chosen[i];
            assert_int_equal(group_of[j] < 0, lost);
        }
    }
}

static void without_own_groups_every_line_is_in_the_group_of_its_markers(void **state)
{
    (void)state;
    double t[COUNT], k[COUNT];
    unsigned char own[COUNT] = {0};
    pia_index chosen[COUNT], first[COUNT + 1], begin[COUNT], end[COUNT], control = make(3, t, k, chosen);
    pia_fence_place(PIA_FENCE_PRINTED, t, k, COUNT, chosen, control, first);
    pia_fence_groups(first, chosen, control, own, begin, end);
    for (pia_index i = 0; i < control; i++) assert_true(begin[i] == first[i] && end[i] == first[i + 1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(markers_minimise_the_difference_of_the_lambdas),
        cmocka_unit_test(constant_curvature_puts_the_marker_at_the_middle_or_at_root_half),
        cmocka_unit_test(groups_hold_their_own_line_and_own_groups_nothing_else),
        cmocka_unit_test(without_own_groups_every_line_is_in_the_group_of_its_markers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
