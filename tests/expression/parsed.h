/* tests/expression/parsed.h -- What the tests of expressions share. */
#ifndef PARSED_H
#define PARSED_H

#include <fvi/fvi.h>
#include "harness/ulp.h"

static const fvi_symbols one = { "x", 1, NULL, 0 };

static inline fvi_expression *parsed(const char *text, const fvi_symbols *names,
                              const double *values)
{
    fvi_expression *e = NULL;
    fvi_misprint wrong = { 0, "" };
    int status = fvi_expression_parse(text, names, values, &e, &wrong);
    ck_assert_msg(status == FVI_SUCCESS, "%s: %zu: %s", text, wrong.at,
                  wrong.reason);
    return e;
}

#endif
