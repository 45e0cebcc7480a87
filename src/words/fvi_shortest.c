/* src/words/fvi_shortest.c -- A number as a word. */
#include "fvi_shortest.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Does v come back from so many digits? */
static int comes_back(double v, int digits, char text[32])
{
    snprintf(text, 32, "%.*g", digits, v);
    return strtod(text, NULL) == v;
}

/* A decimal number of up to 15 digits is in its double, and 17 digits bring every double
 * back: the question is 15, 16 or 17. Of subnormal numbers fewer may do. */
int fvi_shortest(double v, char text[32])
{
    if (fabs(v) < DBL_MIN)
        for (int digits = 1; !comes_back(v, digits, text); digits++)
            ;
    else if (!comes_back(v, 16, text))
        snprintf(text, 32, "%.17g", v);
    else if (!comes_back(v, 15, text))
        snprintf(text, 32, "%.16g", v);
    return (int)strlen(text);
}
