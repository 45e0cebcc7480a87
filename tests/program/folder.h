/* tests/program/folder.h -- A folder of matrices, for the tests of --system. */
#ifndef FOLDER_H
#define FOLDER_H

#include "program.h"

#include <string.h>

#define HEAD "%%MatrixMarket matrix coordinate real symmetric\n"

/* The rows without the head, into `rows`. */
static inline void table_of(const char *words, char *rows, size_t size)
{
    ck_assert_msg(fvi(words) == 0, "%s: %s", words, err);
    const char *at = strrchr(out, '#');
    snprintf(rows, size, "%s", strchr(at, '\n') + 1);
}

/* All numbers of two tables are equal to `bound`. */
static inline size_t compare(const char *a, const char *b, double bound)
{
    size_t count = 0;
    for (char *stop;; a = stop, count++) {
        const double x = strtod(a, &stop);
        if (stop == a)
            break;
        const double y = strtod(b, (char **)&b);
        ck_assert_near(x, y, bound, "number %zu", count);
    }
    return count;
}

/* Three masses between two walls. */
static inline void write_chain(void)
{
    ck_assert_int_eq(shell("mkdir -p chain"), 0);
    write_file("chain/M.mtx", HEAD "% masses\n3 3 3\n1 1 1\n2 2 2\n3 3 0.5\n");
    write_file("chain/K.mtx",
               HEAD "3 3 5\n1 1 4\n2 1 -2\n2 2 4\n3 2 -2\n3 3 4\n");
    write_file("chain/C.mtx", HEAD "3 3 2\n1 1 0.3\n3 3 0.1\n");
}

/* The number of a row of a gradient. */
static inline double by(const char *name)
{
    char start[40];
    snprintf(start, sizeof start, "\n%s\t", name);
    const char *at = strstr(out, start);
    ck_assert_msg(at, "%s is not in %s", name, out);
    return strtod(at + strlen(start), NULL);
}

#endif
