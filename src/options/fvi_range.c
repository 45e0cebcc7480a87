/* src/options/fvi_range.c -- Read lists of numbers, and compute evenly spaced numbers in the digits that a user would
 * type. */
#include "fvi_range.h"
#include "input/fvi_files.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Return the decimal number of fewest digits whose distance from v is at most `error`, the rounding error of v. For
 * example 79.99999999999999 becomes 80. Return v if that number has more than 12 digits. */
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

/* Return point i of the axis. The rounding error of the formula is at most 4 units of the larger end. If the points
 * grow by a factor, it is 4 units plus one for each power of e between the ends. For ends such as 1e-300 and 1e300 the
 * difference or the ratio is too large for a double; then the formula works with halves of it. */
double fvi_range_value(const fvi_range *a, size_t i)
{
    if (a->list)
        return a->list[i];
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
                   const char *range, double low, fvi_range *a, fvi_error *c)
{
    if (!strchr(range, ':'))
        return fvi_read_list(field, range, low, INFINITY, "()", &a->count, &a->list, c);
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
