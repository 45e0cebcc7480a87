/* src/options/fvi_range.c -- Evenly spaced numbers, as they are typed. */
#include "fvi_range.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The decimal number of fewest digits that is as near to v as the formula of a point is to
 * the point, or v if that number has more than 12 digits: 79.99999999999999 is 80. */
static double nearest_decimal(double v, double error)
{
    if (!isfinite(error))
        return v;
    if (fabs(v) <= error)
        return 0;
    for (int digits = 1; digits <= 12; digits++) {
        char text[32];
        snprintf(text, sizeof text, "%.*g", digits, v);
        const double decimal = strtod(text, NULL);
        if (fabs(decimal - v) <= error)
            return decimal;
    }
    return v;
}

/* Point i of the axis. Its roundings are bounded by 4 units of the larger end, or, where
 * points grow by a factor, by 4 units and one for each power of e between the ends. Ends whose
 * difference or ratio is too large for a double, as 1e-300 and 1e300, have one of halves. */
double fvi_range_value(const fvi_range *a, size_t i)
{
    if (i == 0 || i == a->count - 1)
        return i == 0 ? a->from : a->to;
    const double part = (double)i / (double)(a->count - 1);
    if (!a->log)
        return nearest_decimal(isfinite(a->to - a->from) ? a->from + part * (a->to - a->from)
                                                         : (1 - part) * a->from + part * a->to,
                               4 * DBL_EPSILON
                                   * fmax(fabs(a->from), fabs(a->to)));
    const double ratio = a->to / a->from, root = sqrt(fabs(a->to)) / sqrt(fabs(a->from)),
                 v = isnormal(ratio) ? a->from * pow(ratio, part) : a->from * pow(root, part) * pow(root, part);
    return nearest_decimal(v, (4 + 2 * fabs(log(root))) * DBL_EPSILON * fabs(v));
}

int fvi_word_range(const char *field, const char *shape, const char *text,
                   const char *range, fvi_range *a, fvi_error *c)
{
    char place[3][40] = { "", "", "" };
    double count = 0;
    int used = 0;
    const int found = sscanf(range, "%39[^:]:%39[^:]:%39[^:]%n", place[0],
                             place[1], place[2], &used);
    a->log = found == 3 && strcmp(range + used, ":log") == 0;
    if (found != 3 || (range[used] && !a->log))
        return fvi_refuse(c, field, "'%s' is not %s", text, shape);
    int status = fvi_parse_number(field, place[0], -INFINITY, INFINITY, "()",
                                 &a->from, c);
    if (!status)
        status = fvi_parse_number(field, place[1], -INFINITY, INFINITY, "()",
                                 &a->to, c);
    if (!status)
        status = fvi_parse_number(field, place[2], 1, 1e9, "[]", &count, c);
    if (status)
        return status;
    if (count != floor(count) || (count == 1 && a->from != a->to))
        return fvi_refuse(c, field, "'%s': %s values from %s to %s", text, place[2], place[0], place[1]);
    if (a->log && !(a->from > 0 && a->to > 0) && !(a->from < 0 && a->to < 0))
        return fvi_refuse(c, field, "'%s': log needs two ends of one sign", text);
    a->count = (size_t)count;
    return 0;
}
