/* src/options/fvi_laws.c -- Laws of damping: --damping zener:1,0.3,2. */
#include "fvi_laws.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static const char *const words[] = { "viscous", "spring",  "power",
                                     "zener",   "maxwell", "maxwell2",
                                     "distributed", NULL };
static const char forms[] =
    "viscous:R  spring:K  power:R,A  zener:R,A,T  maxwell:R,T  "
    "maxwell2:R1,A,R2,B  distributed:R,A,B";

/* ---- the numbers where the term has its own ---- */

static fvi_kernel_term viscous(const double *p)
{
    return (fvi_kernel_term){ FVI_KERNEL_POWER, p[0], 0.5, 0, 0 };
}

static fvi_kernel_term spring(const double *p)
{
    return (fvi_kernel_term){ FVI_KERNEL_POWER, p[0], 0, 0, 0 };
}

static fvi_kernel_term power(const double *p)
{
    return (fvi_kernel_term){ FVI_KERNEL_POWER, p[0], p[1], 0, 0 };
}

static fvi_kernel_term zener(const double *p)
{
    return (fvi_kernel_term){ FVI_KERNEL_ZENER, p[0], p[1], p[2], 0 };
}

static fvi_kernel_term maxwell(const double *p)
{
    return (fvi_kernel_term){ FVI_KERNEL_MAXWELL, p[0], 0, p[1], 0 };
}

/* The springpot of the higher order stands first, and one that gives no force leaves none. */
static fvi_kernel_term maxwell2(const double *p)
{
    const double *high = p[1] >= p[3] ? p : p + 2,
                 *low = p[1] >= p[3] ? p + 2 : p;
    if (p[0] == 0 || p[2] == 0)
        return (fvi_kernel_term){ FVI_KERNEL_MAXWELL2, 0, high[1], 0, low[1] };
    return (fvi_kernel_term){ FVI_KERNEL_MAXWELL2, high[0], high[1],
                              high[0] / low[0], low[1] };
}

static fvi_kernel_term distributed(const double *p)
{
    return (fvi_kernel_term){ FVI_KERNEL_DISTRIBUTED, p[0], p[1], 0, p[2] };
}

enum { MOST_NUMBERS = 4 };

/* In the order of the words. */
static const struct {
    const char *form;
    int count;
    const char *range;
    fvi_kernel_term (*term)(const double *p);
} kinds[] = {
    { "viscous:R", 1, "R >= 0", viscous },
    { "spring:K", 1, "K >= 0", spring },
    { "power:R,A", 2, "R >= 0 and 0 <= A <= 1", power },
    { "zener:R,A,T", 3, "R, T >= 0 and 0 <= A <= 1", zener },
    { "maxwell:R,T", 2, "R, T >= 0", maxwell },
    { "maxwell2:R1,A,R2,B", 4, "R1, R2 >= 0 and A, B in [0, 1]", maxwell2 },
    { "distributed:R,A,B", 3, "R >= 0 and 0 <= A < B <= 1", distributed },
};

/* ---- texts ---- */

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

static int add_one(fvi_laws *laws, const char *text, fvi_complaint c)
{
    const size_t length = strcspn(text, ":");
    double p[MOST_NUMBERS];
    char place[64];
    size_t i = 0;
    while (words[i]
           && (strlen(words[i]) != length
               || strncasecmp(text, words[i], length) != 0))
        i++;
    if (!words[i])
        return fvi_refuse(c, "--damping: '%s' is none of %s%s", text, forms,
                          fvi_word_hint(text, length, words, place));
    if (!fvi_word_call(text, words[i], kinds[i].count, p))
        return fvi_refuse(c, "--damping: '%s' is not %s", text, kinds[i].form);
    for (int j = 0; j < kinds[i].count; j++)
        if (p[j] < 0)
            return fvi_refuse(c, "--damping: '%s': %s with %s", text,
                              kinds[i].form, kinds[i].range);
    const fvi_kernel_term term = kinds[i].term(p);
    if (fvi_kernel_check(&(fvi_kernel){ 1, &term }) != 0)
        return fvi_refuse(c, "--damping: '%s': %s with %s", text, kinds[i].form,
                          kinds[i].range);
    return add(laws, &term, text, c);
}

int fvi_laws_add(fvi_laws *laws, const char *text, fvi_complaint c)
{
    char one[256];
    const char *end;
    int status = 0;
    for (; !status && (end = strstr(text, " + ")); text = end + 3) {
        if ((size_t)(end - text) >= sizeof one)
            return fvi_refuse(c, "--damping: '%s': too long", text);
        snprintf(one, sizeof one, "%.*s", (int)(end - text), text);
        status = add_one(laws, one, c);
    }
    return status ? status : add_one(laws, text, c);
}
