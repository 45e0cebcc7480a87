/* src/command_fit/fvi_fit_names.c -- Read the names of the parameters of `fvi fit --fit`. */
#include "fvi_fit_answer.h"

#include <string.h>

typedef fvi_fit_request request;

int fvi_fit_has_lets(const fvi_options *o)
{
    return o->potential.expression || o->text[LAGRANGIAN];
}

/* Return the name of constant i of the potential: c, g, or a name of --let. NULL if there is no constant i. */
static const char *constant_name(const fvi_options *o, size_t i)
{
    static const char *const c_and_g[] = { "c", "g", NULL };
    if (fvi_fit_has_lets(o))
        return i < o->lets.count ? o->lets.name[i] : NULL;
    switch (o->potential.kind) {
    case FVI_POTENTIAL_HARMONIC:
        return i == 0 ? "c" : NULL;
    case FVI_POTENTIAL_PENDULUM:
        return i == 0 ? "g" : NULL;
    case FVI_POTENTIAL_FREE:
        return NULL;
    default:
        return c_and_g[i];
    }
}

/* Refuse a parameter that is named twice, alpha if the method has only one value of it, and a --let from which another
 * --let was computed. */
static int check(const request *r, size_t n, fvi_error *c)
{
    const fvi_free_parameter which = r->which[n];
    for (size_t i = 0; i < n; i++)
        if (r->which[i] == which)
            return fvi_refuse(c, "fit", "'%s' stands twice", r->name[n]);
    if (which == FVI_FREE_PARAMETER_ALPHA
        && r->o.method->alpha_least == r->o.method->alpha_most)
        return fvi_refuse(c, "fit", "'alpha' is %g for %s, and no other", r->o.method->alpha_least, r->o.method->name);
    const size_t constant = (size_t)which - FVI_FREE_PARAMETER_CONSTANT;
    if (which >= FVI_FREE_PARAMETER_CONSTANT && constant < FVI_MOST_USER_PARAMETERS
        && fvi_fit_has_lets(&r->o) && r->o.lets.used[constant] & FVI_USED_BY_PARAMETER)
        return fvi_refuse(c, "fit",
                          "another --let was made of '%s', and would stay as it is; write it out in the expressions",
                          r->name[n]);
    return 0;
}

int fvi_fit_names(request *r, fvi_error *c)
{
    const char *constants[FVI_MOST_USER_PARAMETERS + 2];
    fvi_free_parameter_names known = { &r->run, r->columns, r->columns ? r->column : NULL, 0,
                                       constants, &r->o.lets, r->o.ground != NULL };
    while (constant_name(&r->o, known.constants)) {
        constants[known.constants] = constant_name(&r->o, known.constants);
        known.constants++;
    }
    if (!r->words.own[FIT])
        r->words.own[FIT] = fvi_free_parameters_of_laws(&r->run, FVI_ESTIMATION_MOST,
                                                        sizeof r->preset, r->preset);
    const char *text = r->words.own[FIT];
    if (strlen(text) >= sizeof r->names)
        return fvi_refuse(c, "fit", "'%s' is too long", text);
    strcpy(r->names, text);
    for (char *at = r->names; at; r->fit.parameters++) {
        const size_t n = r->fit.parameters;
        char *comma = strchr(at, ',');
        if (comma)
            *comma++ = '\0';
        if (n == FVI_ESTIMATION_MOST)
            return fvi_refuse(c, "fit", "more than %d parameters", FVI_ESTIMATION_MOST);
        r->name[n] = at;
        if (fvi_parse_free_parameter("fit", at, &known, &r->which[n], c) || check(r, n, c))
            return 2;
        at = comma;
    }
    return 0;
}
