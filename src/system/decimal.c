/* src/system/decimal.c -- Read a number with a decimal point in every locale. */
#define _POSIX_C_SOURCE 200809L /* for uselocale, which concerns this thread only */
#include "decimal.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>

double fvi_strtod(const char *text, char **end)
{
    const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!plain) {
        if (end)
            *end = (char *)text;
        return NAN;
    }
    const locale_t of_caller = uselocale(plain);
    const double value = strtod(text, end);
    uselocale(of_caller);
    freelocale(plain);
    return value;
}
