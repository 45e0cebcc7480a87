/* src/fvi/format_double.h -- A number as a word.
 *
 *     char text[32];
 *     fvi_format_double(0.1, text);
 *     puts(text);                      prints 0.1 */
#ifndef FVI_FORMAT_DOUBLE_H
#define FVI_FORMAT_DOUBLE_H

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_format_double -- the shortest decimal number that is read back as v, finite. Of those
 * with as many digits the nearest to v. Returns its length. */
int fvi_format_double(double v, char text[32]);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
