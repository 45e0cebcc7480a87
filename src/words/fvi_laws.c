/* src/words/fvi_laws.c -- Laws of damping: --damping zener:1,0.3,2. */
#include "fvi_laws.h"

#include <stdio.h>
#include <string.h>

/* In the order of fvi_law_kind, with how many numbers each takes. */
static const struct {
    const char *word, *form;
    int count;
} kinds[] = { { "power", "power:R,A", 2 },
              { "zener", "zener:R,A,T", 3 },
              { "maxwell", "maxwell:R,T", 2 },
              { "distributed", "distributed:R,A,B", 3 } };

/* The numbers where the term has its own. */
static fvi_law_term term_of(fvi_law_kind kind, const double *p)
{
    fvi_law_term t = { .kind = kind, .rho = p[0], .alpha = p[1] };
    if (kind == FVI_LAW_MAXWELL)
        t.alpha = 0, t.time = p[1];
    if (kind == FVI_LAW_ZENER)
        t.time = p[2];
    if (kind == FVI_LAW_DISTRIBUTED)
        t.end = p[2];
    return t;
}

int fvi_laws_add(fvi_laws *laws, const char *text, fvi_complaint c)
{
    const size_t used = strlen(laws->text), room = sizeof laws->text - used;
    for (int i = 0; i < 4; i++) {
        double p[3];
        if (!fvi_word_call(text, kinds[i].word, kinds[i].count, p))
            continue;
        const fvi_law_term term = term_of((fvi_law_kind)i, p);
        if (fvi_law_check(&(fvi_law){ 1, &term }) != 0)
            return fvi_refuse(c,
                              "--damping: '%s': %s with R, T >= 0 and "
                              "0 <= A < B <= 1",
                              text, kinds[i].form);
        const int length = snprintf(laws->text + used, room, "%s%s",
                                    used > 0 ? " + " : "", text);
        if (laws->law.count == FVI_MOST_TERMS || (size_t)length >= room)
            return fvi_refuse(c, "--damping: '%s': too many terms", text);
        laws->term[laws->law.count++] = term;
        laws->law.term = laws->term;
        return 0;
    }
    return fvi_refuse(c,
                      "--damping: '%s' is none of power:R,A  zener:R,A,T  "
                      "maxwell:R,T  distributed:R,A,B",
                      text);
}
