/* Numbers as text, in any locale. */
#ifndef PIA_BASE_NUMBER_H
#define PIA_BASE_NUMBER_H

#include <stddef.h>

enum { PIA_NUMBER_SIZE = 32 }; /* room for any double as text */

/* The shortest of %.15g, %.16g, %.17g that reads back as the same double; "nan", "inf", "-inf" otherwise. Returns its length. */
int pia_number_format(double value, char text[PIA_NUMBER_SIZE]);

/* Reads one decimal number at `begin`, not past `end`; the result is correctly rounded (equal to strtod in the C locale). Accepts
 * nan, inf and infinity in any case. Returns the first character after it, or NULL when no number starts here. */
const char *pia_number_parse(const char *begin, const char *end, double *value);

#endif
