/* src/system/decimal.h -- Read a number with a decimal point in every locale. */
#ifndef FVI_DECIMAL_H
#define FVI_DECIMAL_H

/* fvi_strtod -- Do what strtod does in a locale whose decimal point is '.', whatever the locale of the program is. */
double fvi_strtod(const char *text, char **end);

#endif
