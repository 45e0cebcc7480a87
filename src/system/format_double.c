/* src/system/format_double.c -- Write a double as a text that reads back to the same double. */
#include <fvi/format_double.h>

#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- slow path: by the C library ---- */

/* Write v with this many digits. Return 1 if the text reads back to v, and 0 if not. */
static int reads_back(double v, int digits, char text[32])
{
    snprintf(text, 32, "%.*g", digits, v);
    return strtod(text, NULL) == v;
}

/* Try 15, 16 and 17 digits. Every decimal number of up to 15 digits survives in a double, and 17 digits bring every
 * double back. A subnormal number may need fewer than 15 digits, so the search for it begins with one digit. */
static void format_by_trials(double v, char text[32])
{
    if (fabs(v) < DBL_MIN)
        for (int digits = 1; !reads_back(v, digits, text); digits++)
            ;
    else if (!reads_back(v, 16, text))
        snprintf(text, 32, "%.17g", v);
    else if (!reads_back(v, 15, text))
        snprintf(text, 32, "%.16g", v);
}

/* ---- fast path: by integer arithmetic, for the exponents that fit into 128 bits ---- */

#ifdef __SIZEOF_INT128__ /* compilers for 64-bit processors have this type; others take the slow path */
__extension__ typedef unsigned __int128 wide;

#define SEVENTEEN 100000000000000000U /* the smallest number of 18 digits */

/* The number |v| = m 2^e, scaled by a power of ten so that its integer part has 17 digits:
 *
 *   |v| 10^k = product / 2^s exactly,  product = m 5^k,  five = 5^k,  s = -(e + k),  whole = integer part */
typedef struct {
    uint64_t m, five, whole;
    wide product;
    int k, s;
} scaled;

/* Scale |v|. Return 1, or 0 if the numbers do not fit into 128 bits. */
static int scale_to_17_digits(double v, scaled *n)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    const int e = (int)(bits >> 52 & 0x7ff) - 1075;
    n->m = (bits & 0xfffffffffffffU) | 0x10000000000000U;
    n->k = 16 - (int)floor((e + 52) * 0.30102999566398120);
    if (n->k > 27)
        return 0;
    n->five = 1;
    for (int k = 0; k < n->k; k++)
        n->five *= 5;
    /* k follows from the logarithm of 2^{e+52}, not of |v|, so k may be too large by one */
    for (;; n->k--, n->five /= 5) {
        n->s = -(e + n->k);
        if (n->k < 0 || n->s < 1 || n->s > 64)
            return 0;
        n->product = (wide)n->m * n->five;
        const wide whole = n->product >> n->s;
        n->whole = (uint64_t)whole;
        if (whole < SEVENTEEN)
            return 1;
    }
}

/* Round the scaled number to a multiple of unit, ties to even. */
static uint64_t nearest(const scaled *n, uint64_t unit)
{
    const uint64_t q = n->whole / unit;
    const wide half = (wide)unit << n->s,
               rest = (n->product - ((wide)(q * unit) << n->s)) * 2;
    return (q + (rest > half || (rest == half && q % 2 == 1))) * unit;
}

/* Return 1 if the decimal number `digits` reads back to |v|, that is, if it is nearer to |v| than half the distance to
 * the next double. In scaled units this half distance is 5^k / 2 (in units of 2^-s), and below a power of two a quarter
 * of 5^k. A tie cannot occur, because 5^k is odd. */
static int is_near(const scaled *n, uint64_t digits)
{
    const wide there = (wide)digits << n->s;
    const int below = there < n->product && n->m == 0x10000000000000U;
    const wide off =
        there < n->product ? n->product - there : there - n->product;
    return off * (below ? 4 : 2) < n->five;
}

/* Write the digits as the format %g would, without zeros at the end. */
static void write_digits(int negative, uint64_t digits, int exponent, int precision,
                         char *text)
{
    char all[17];
    int last = 17;
    for (int i = 17; i-- > 0; digits /= 10)
        all[i] = (char)('0' + digits % 10);
    while (last > 1 && all[last - 1] == '0')
        last--;
    if (negative)
        *text++ = '-';
    const int power = exponent < -4 || exponent >= precision,
              point = power ? 1 : exponent + 1; /* number of digits before the decimal point */
    if (point <= 0) {
        *text++ = '0';
        *text++ = '.';
        for (int i = point; i < 0; i++)
            *text++ = '0';
    }
    for (int i = 0; i < last || i < point; i++) {
        if (i == point && i > 0)
            *text++ = '.';
        *text++ = i < last ? all[i] : '0';
    }
    if (power) {
        const int size = exponent < 0 ? -exponent : exponent; /* at most 17 in magnitude */
        *text++ = 'e';
        *text++ = exponent < 0 ? '-' : '+';
        *text++ = (char)('0' + size / 10);
        *text++ = (char)('0' + size % 10);
    }
    *text = 0;
}

static int format_by_integers(double v, char *text)
{
    scaled n;
    int precision = 15;
    uint64_t digits = 0;
    if (!scale_to_17_digits(v, &n))
        return 0;
    for (uint64_t unit = 100;; unit /= 10, precision++) {
        digits = nearest(&n, unit);
        if (unit == 1 || is_near(&n, digits))
            break;
    }
    const int more = digits == SEVENTEEN; /* digits were rounded up to a power of ten */
    write_digits(v < 0, more ? digits / 10 : digits, 16 - n.k + more, precision, text);
    return 1;
}
#else
static int format_by_integers(double v, char *text)
{
    (void)v;
    (void)text;
    return 0;
}
#endif

/* snprintf writes the decimal point of the locale, which may be several bytes. */
static void write_point(char *text)
{
    const char *point = localeconv()->decimal_point;
    char *at = strstr(text, point);
    if (at) {
        const char *after = at + strlen(point);
        *at = '.';
        memmove(at + 1, after, strlen(after) + 1);
    }
}

int fvi_format_double(double v, char text[32])
{
    if (fabs(v) < DBL_MIN || !format_by_integers(v, text)) {
        format_by_trials(v, text);
        write_point(text);
    }
    return (int)strlen(text);
}
