/* src/system/decimal.h -- Read a number with a decimal point in every locale. */
#ifndef FVI_DECIMAL_H
#define FVI_DECIMAL_H

/* fvi_strtod -- Do what strtod does in a locale whose decimal point is '.', whatever the locale of the program is.
 * Other threads keep their locales. If the C library has no memory for such a locale, return NaN with *end = text,
 * because 2.5 must not be read as 2. (glibc and musl need no memory for it.) */
double fvi_strtod(const char *text, char **end);

#endif
