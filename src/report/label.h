/* Numbers as people read them in pictures: UTF-8, a true minus sign, "1.2×10⁻⁶"; the same in any locale. */
#ifndef PIA_REPORT_LABEL_H
#define PIA_REPORT_LABEL_H

enum { PIA_LABEL_SIZE = 64 }; /* room for any label */

/* `decimals` digits after the point, 0 to 15; |value| * 10^decimals below 2^63. */
void pia_label_fixed(double value, int decimals, char text[PIA_LABEL_SIZE]);

/* At most `digits` significant digits (1 to 15) without trailing zeros; a power of ten outside 1e-3 .. 1e5. "not finite" otherwise. */
void pia_label_significant(double value, int digits, char text[PIA_LABEL_SIZE]);

/* "10⁻⁶" */
void pia_label_power(int exponent, char text[PIA_LABEL_SIZE]);

#endif
