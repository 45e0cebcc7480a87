/* src/fvi/format_double.h -- Print a double with the fewest digits that read back to the same number.
 *
 *     char text[32];
 *     fvi_format_double(0.1, text);
 *     puts(text);   // prints 0.1 */
#ifndef FVI_FORMAT_DOUBLE_H
#define FVI_FORMAT_DOUBLE_H

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_format_double -- write the shortest decimal number that is read back as v. Of all numbers with as many digits it
 * is the nearest one to v.
 *
 *   v     a finite number
 *   text  output: the digits and a '\0', 32 bytes at most. The decimal point is '.' under every locale
 *
 * Returns the length of the text without the '\0'. Nothing is checked. */
int fvi_format_double(double v, char text[32]);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
