/* chapters/play/strtod.c -- A number from text, in place of src/system/decimal.c: a page has no locale.
 *
 * wasi-libc's is 4 kB and wants a file system. This rounds right up to 15 digits with a power
 * of ten up to 22 either way, where both numbers are exact; beyond, to some units in the last
 * place. */
#include "system/decimal.h"

#include <stddef.h>

double fvi_strtod(const char *text, char **end)
{
    double digits = 0, scale = 1;
    int power = 0, exponent = 0, sign = 1, after = 0;
    for (; (*text >= '0' && *text <= '9') || *text == '.'; text++) {
        if (*text == '.') {
            after = 1;
            continue;
        }
        digits = 10 * digits + (*text - '0');
        power -= after;
    }
    if (*text == 'e' || *text == 'E') {
        text++;
        sign = *text == '-' ? -1 : 1;
        text += *text == '-' || *text == '+';
        for (; *text >= '0' && *text <= '9' && exponent < 1000; text++)
            exponent = 10 * exponent + (*text - '0');
    }
    if (end)
        *end = (char *)(size_t)text;
    power += sign * exponent;
    for (int i = power < 0 ? -power : power; i > 0; i--)
        scale *= 10;
    return power < 0 ? digits / scale : digits * scale;
}
