/* tests/harness/seen.h -- Write down numbers that tests measure, so that the chapters can quote them.
 *
 * `make seen` runs the tests with SEEN=FILE in the environment. Each line of the file is function/name, a tab, a
 * number. chapters/tools/quoted.py keeps the least and the largest number of each name in tests/harness/seen.tsv
 * and compares the chapters with them. Without SEEN nothing is written. */
#ifndef SEEN_H
#define SEEN_H

#include <stdio.h>
#include <stdlib.h>

static inline void seen_in(const char *function, const char *name, double value)
{
    static int asked;
    static FILE *file;
    if (!asked && getenv("SEEN")) {
        file = fopen(getenv("SEEN"), "a");
        if (file)
            setvbuf(file, NULL, _IOLBF, BUFSIZ); /* tests may end by a signal */
    }
    asked = 1;
    if (file)
        fprintf(file, "%s/%s\t%.6g\n", function, name, value);
}

/* Write down a number. The other arguments are a printf format that names it. */
#define seen(value, ...)                                                       \
    do {                                                                       \
        char name_[80];                                                        \
        snprintf(name_, sizeof name_, __VA_ARGS__);                            \
        seen_in(__func__, name_, value);                                       \
    } while (0)

/* The same for a line that runs many times: write the number only if it is a new largest one. */
#define seen_worst(value, name)                                                \
    do {                                                                       \
        static double worst_ = -1;                                             \
        double value_ = (value);                                               \
        if (value_ > worst_)                                                   \
            seen_in(__func__, name, worst_ = value_);                          \
    } while (0)

#endif
