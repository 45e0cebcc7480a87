/* src/options/fvi_format_double.h -- A number as a word. */
#ifndef FVI_FORMAT_DOUBLE_H
#define FVI_FORMAT_DOUBLE_H

/* fvi_format_double -- the shortest decimal number that is read back as v, finite. Of those
 * with as many digits the nearest to v. Returns its length. */
int fvi_format_double(double v, char text[32]);

#endif
