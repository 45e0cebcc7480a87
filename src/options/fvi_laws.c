/* src/options/fvi_laws.c -- Laws of damping: --damping zener:1,0.3,2. */
#include "fvi_laws.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

/* In the order of fvi_kernel_kind, with how many numbers each takes. */
static const char *const words[] = { "power", "zener", "maxwell", "distributed",
                                     NULL };
static const struct {
    const char *form;
    int count;
} kinds[] = { { "power:R,A", 2 },
              { "zener:R,A,T", 3 },
              { "maxwell:R,T", 2 },
              { "distributed:R,A,B", 3 } };

/* The numbers where the term has its own. */
static fvi_kernel_term term_of(fvi_kernel_kind kind, const double *p)
{
    fvi_kernel_term t = { .kind = kind, .rho = p[0], .alpha = p[1] };
    if (kind == FVI_KERNEL_MAXWELL)
        t.alpha = 0, t.time = p[1];
    if (kind == FVI_KERNEL_ZENER)
        t.time = p[2];
    if (kind == FVI_KERNEL_DISTRIBUTED)
        t.end = p[2];
    return t;
}

/* One more term at the end of the sum, as its text. */
static int add(fvi_laws *laws, const fvi_kernel_term *term, const char *text,
               fvi_complaint c)
{
    const size_t used = strlen(laws->text), room = sizeof laws->text - used;
    const int length =
        snprintf(laws->text + used, room, "%s%s", used > 0 ? " + " : "", text);
    if (laws->law.count == FVI_MOST_TERMS || (size_t)length >= room)
        return fvi_refuse(c, "--damping: '%s': too many terms", text);
    laws->term[laws->law.count++] = *term;
    laws->law.term = laws->term;
    return 0;
}

int fvi_laws_add(fvi_laws *laws, const char *text, fvi_complaint c)
{
    const size_t length = strcspn(text, ":");
    double p[3];
    char place[64];
    size_t i = 0;
    while (words[i]
           && (strlen(words[i]) != length
               || strncasecmp(text, words[i], length) != 0))
        i++;
    if (!words[i])
        return fvi_refuse(c,
                          "--damping: '%s' is none of power:R,A  zener:R,A,T  "
                          "maxwell:R,T  distributed:R,A,B%s",
                          text, fvi_word_hint(text, length, words, place));
    if (!fvi_word_call(text, words[i], kinds[i].count, p))
        return fvi_refuse(c, "--damping: '%s' is not %s", text, kinds[i].form);
    const fvi_kernel_term term = term_of((fvi_kernel_kind)i, p);
    if (fvi_kernel_check(&(fvi_kernel){ 1, &term }) != 0)
        return fvi_refuse(c,
                          "--damping: '%s': %s with R, T >= 0 and "
                          "0 <= A < B <= 1",
                          text, kinds[i].form);
    return add(laws, &term, text, c);
}
