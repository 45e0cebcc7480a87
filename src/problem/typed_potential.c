/* src/problem/typed_potential.c -- Parse potentials, such as duffing:1,0.5. */
#include "words.h"
#include <fvi/formulas.h>

#include <math.h>
#include <string.h>

/* In the order of fvi_potential_kind and of fvi_potential_formulas. */
static const char *const words[] = { "harmonic", "duffing", "pendulum",
                                     "free",     "chain",   NULL };
static const int counts[] = { 1, 2, 1, 0, 3 };
#define ALL_FORMS "harmonic:C, duffing:C,G, pendulum:G, free, chain:D,C,G"

/* Parse an expression. If it is wrong and its first word is nearly a known one, the error proposes that word instead of
 * saying what is wrong with the expression. */
static int parse_expression(const char *text, size_t d,
                            fvi_user_parameters *parameters,
                            fvi_typed_potential *potential, fvi_error *error)
{
    const char *near = fvi_nearest_word(text, strcspn(text, ":"), words);
    if (d == 0)
        d = fvi_largest_index(text);
    const int status =
        fvi_parse_expression("potential", "x", d ? d : 1, text, parameters,
                             &potential->expression, error);
    if (status == FVI_EINVAL && near)
        return fvi_refuse(error, "potential", "'%s' is none of " ALL_FORMS ", nor an expression; did you mean %s?",
                          text, near);
    potential->d = d ? d : 1;
    return status;
}

/* Take a chain. Its number of masses must be that of the system. */
static int check_chain(const char *text, size_t d, const double *p,
                       fvi_typed_potential *potential, fvi_error *error)
{
    if (!(p[0] >= 1 && p[0] <= 1000000 && p[0] == floor(p[0])))
        return fvi_fail(error, FVI_EINVAL, "potential", p[0], "a chain has 1 to 1000000 masses, not '%s'", text);
    potential->d = (size_t)p[0];
    if (d && d != potential->d)
        return fvi_fail(error, FVI_EINVAL, "dimension", (double)d, "'%zu' is not that of '%s'", d, text);
    memcpy(potential->constants, p + 1, sizeof potential->constants);
    return FVI_SUCCESS;
}

int fvi_parse_potential(const char *text, size_t d,
                        fvi_user_parameters *parameters,
                        fvi_typed_potential *potential, fvi_error *error)
{
    if (!text || !potential)
        return fvi_fail(error, FVI_EFAULT, "potential", NAN, "null pointer");
    const size_t length = strcspn(text, ":"),
                 i = fvi_scan_word(text, length, words);
    fvi_typed_potential new = { (fvi_potential_kind)i, 0, { 1, 0 }, NULL };
    double p[3] = { 0 };
    char place[64];
    int status = FVI_SUCCESS;
    if (!words[i] && text[length])
        return fvi_refuse(error, "potential", "'%s' is none of " ALL_FORMS "%s", text,
                        fvi_word_hint(text, length, words, place));
    if (!words[i]) {
        new.kind = FVI_POTENTIAL_EXPRESSION;
        status = parse_expression(text, d, parameters, &new, error);
    } else if (new.kind != FVI_POTENTIAL_HARMONIC || text[length]) {
        if (!fvi_scan_call(text, words[i], counts[i], p))
            return fvi_refuse(error, "potential", "'%s' is not %s", text, fvi_potential_formulas[i].form);
        if (new.kind == FVI_POTENTIAL_CHAIN)
            status = check_chain(text, d, p, &new, error);
        else
            memcpy(new.constants, p, sizeof new.constants);
    } /* harmonic without a number has c = 1 */
    if (!status)
        *potential = new;
    return status;
}

fvi_potential fvi_potential_typed(const fvi_typed_potential *u)
{
    switch (u->kind) {
    case FVI_POTENTIAL_HARMONIC:
        return fvi_potential_harmonic(u->constants);
    case FVI_POTENTIAL_DUFFING:
        return fvi_potential_duffing(u->constants);
    case FVI_POTENTIAL_PENDULUM:
        return fvi_potential_pendulum(u->constants);
    case FVI_POTENTIAL_CHAIN:
        return fvi_potential_chain(u->constants);
    case FVI_POTENTIAL_EXPRESSION:
        return fvi_potential_expression(u->expression);
    case FVI_POTENTIAL_FREE:
        break;
    }
    return (fvi_potential){ 0 };
}

void fvi_typed_potential_free(fvi_typed_potential *potential)
{
    if (!potential)
        return;
    fvi_expression_free(potential->expression);
    potential->expression = NULL;
}
