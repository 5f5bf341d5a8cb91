/* Assertions of the tests. cmocka's assert_float_equal casts to float, so doubles are compared here, with their ulps in the message. */
#ifndef PIA_TESTS_CHECK_H
#define PIA_TESTS_CHECK_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "pia/pia.h"

static inline int64_t check_ulps(double a, double b)
{
    int64_t x, y;
    memcpy(&x, &a, sizeof x);
    memcpy(&y, &b, sizeof y);
    if (x < 0) x = INT64_MIN - x;
    if (y < 0) y = INT64_MIN - y;
    return x > y ? x - y : y - x;
}

static inline void check_near(double actual, double expected, double tolerance, const char *what, const char *file, int line)
{
    if (fabs(actual - expected) <= tolerance || actual == expected) return; /* NaN fails both */
    print_error("%s = %.17g, expected %.17g within %g (off by %g, %lld ulps)\n", what, actual, expected, tolerance, actual - expected,
                (long long)check_ulps(actual, expected));
    _fail(file, line);
}

#define assert_near(actual, expected, tolerance) check_near((actual), (expected), (tolerance), #actual, __FILE__, __LINE__)

static inline void check_status(pia_context *context, pia_status status, pia_status expected, const char *what, const char *file,
                                int line)
{
    if (status == expected) return;
    print_error("%s gave \"%s\" (%s), expected \"%s\"\n", what, pia_strerror(status), pia_message(context), pia_strerror(expected));
    _fail(file, line);
}

#define assert_ok(context, call) check_status((context), (call), PIA_OK, #call, __FILE__, __LINE__)
#define assert_status(context, call, expected) check_status((context), (call), (expected), #call, __FILE__, __LINE__)

#endif
