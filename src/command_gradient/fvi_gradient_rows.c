/* src/command_gradient/fvi_gradient_rows.c -- Name the rows of `fvi gradient`. */
#include "fvi_gradient_rows.h"

#include "fvi_gradient_dampers.h"

#include <fvi/formulas.h>
#include <fvi/rheology.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef fvi_gradient_request request;
typedef fvi_gradient_visitor visitor;

enum { LETTERS = FVI_GRADIENT_LETTERS };

/* Return a pointer to number i of an array; NULL if the array is not asked for. */
static const double *number_or_null(const double *by, size_t i)
{
    return by ? by + i : NULL;
}

static void report_row(const visitor *v, const char *name, const double *by)
{
    v->visit(v->to, name, by, NULL);
}

static void warn(const visitor *v, const char *name, const char *text, const char *about)
{
    char whole[3 * LETTERS];
    snprintf(whole, sizeof whole, text, about);
    v->visit(v->to, name, NULL, whole);
}

/* Visit a row for each coordinate: name, or name_1, name_2, ... `warning` returns the text that takes the place of the
 * row of coordinate i, or NULL. In the text, %s stands for the name of the row. */
static void rows_of_coordinates(const visitor *v, const request *r, const char *name, const double *by,
                                const char *(*warning)(const request *r, size_t i))
{
    for (size_t i = 0; i < r->o.d; i++) {
        const char *text = warning(r, i);
        char whole[LETTERS], number[24] = "";
        if (r->o.numbered)
            snprintf(number, sizeof number, "_%zu", i + 1);
        snprintf(whole, sizeof whole, "%s%s", name, number);
        if (text)
            warn(v, whole, text, whole);
        else
            report_row(v, whole, number_or_null(by, i));
    }
}

static const char *no_warning(const request *r, size_t i)
{
    (void)r, (void)i;
    return NULL;
}

/* A coordinate without mass has no kinetic energy. With a small mass it would have one, from a velocity that is not
 * p/m. So the energy has no derivative by such a mass. */
static const char *warning_of_mass(const request *r, size_t i)
{
    return r->of == 2 && r->o.mass[i] == 0
               ? "no derivative by %s: the energy does not know the velocity of a coordinate without mass"
               : NULL;
}

/* The start of an imposed coordinate is prescribed. */
static const char *warning_of_start(const request *r, size_t i)
{
    const fvi_constraints *c =
        r->system.mechanism ? r->system.mechanism->constraints : NULL;
    for (size_t l = 0; c && c->imposed && l < c->count; l++)
        if (c->imposed[l] == i + 1)
            return "no derivative by %s: this coordinate is imposed";
    return NULL;
}

static const char *warning_of_place(const request *r, size_t i)
{
    const char *warning = warning_of_start(r, i);
    if (!warning && r->to.x0 && isnan(r->to.x0[i]) && fvi_gradient_is_short_beside(r, i))
        warning = "no derivative by %s: from another start this force comes from steps shorter than those of the run";
    return warning;
}

/* Return why a law has no derivatives, or only that by its factor. */
static const char *reason_of_laws(const request *r)
{
    return r->o.method->scheme == FVI_SCHEME_VARIABLE_STEP
               ? "steps of any length have only that by the factor of a law that stands alone"
               : "with stages a sum of laws that grows faster than s has none; by fvi-stable it has";
}

/* Visit the row of one parameter of a term, or a warning why there is no derivative. Two springpots in series need both
 * fields, because their kernel has rho = rho1 and time = rho1/rho2. */
static void row_of_number(const visitor *v, const request *r, const char *name, size_t term,
                          fvi_element kind, size_t field)
{
    const double *const fields[] = { r->to.terms, r->to.orders, r->to.times, r->to.ends };
    char text[3 * LETTERS];
    const int is_known = r->has_orders
                         || (r->has_terms && field == 0 && kind != FVI_ELEMENT_MAXWELL2);
    snprintf(text, sizeof text, "no derivative by %%s: %s", reason_of_laws(r));
    if (is_known)
        report_row(v, name, number_or_null(fields[field], term));
    else
        warn(v, name, text, name);
}

/* Write the end of the row of number l of a kind: its letter in zener:R,A,T, as "_A"; nothing for the first number. The
 * numbers of two springpots in series have the names that they have everywhere. */
static void name_end_of_row(fvi_element kind, size_t l, size_t size, char *end)
{
    const char *word = fvi_element_words[kind], *at = word;
    for (size_t i = 0; fvi_law_formulas[i].form; i++)
        if (strncmp(fvi_law_formulas[i].form, word, strlen(word)) == 0 && fvi_law_formulas[i].form[strlen(word)] == ':')
            at = fvi_law_formulas[i].form;
    for (size_t i = 0; i < l && strchr(at, ','); i++)
        at = strchr(at, ',') + 1;
    if (kind == FVI_ELEMENT_MAXWELL2)
        snprintf(end, size, "_%s", fvi_element_number(kind, l, NULL));
    else
        snprintf(end, size, l > 0 ? "_%c" : "", *at);
}

/* Visit the rows of the parameters of term i of --damping. A spring and a dashpot are stored as a power, so they have
 * A, too. */
static void rows_of_term(const visitor *v, const request *r, size_t i)
{
    const fvi_kernel_term *term = r->run.law->term + i;
    char number[24] = "", name[LETTERS], whole[2 * LETTERS];
    if (r->terms > 1)
        snprintf(number, sizeof number, "_%zu", i + 1);
    snprintf(name, sizeof name, "damping%s", number);
    if (term->kind == FVI_KERNEL_SYMBOL) {
        warn(v, name, "no derivatives by the numbers of %s", name);
        return;
    }
    const fvi_element kind = term->kind == FVI_KERNEL_POWER ? FVI_ELEMENT_POWER : fvi_element_of(term);
    const int is_exchanged = fvi_pair_is_exchanged(&r->o.lets, i, r->terms);
    for (size_t l = 0, field; fvi_element_number_typed(kind, l, is_exchanged, &field); l++) {
        char end[LETTERS];
        name_end_of_row(kind, l, sizeof end, end);
        snprintf(whole, sizeof whole, "%s%s", name, end);
        row_of_number(v, r, whole, i, kind, field);
    }
}

/* Visit the rows of a damper: a factor of its law, and its parameters with the names of `fvi fit`. `first` is the
 * position of its terms among the terms of all dampers. */
static void rows_of_damper(const visitor *v, const request *r, size_t j, size_t first)
{
    const fvi_damper *damper = r->system.mechanism->damper + j;
    const fvi_kernel *law = damper->kernel;
    char name[LETTERS / 2];
    snprintf(name, sizeof name, "d%zu", j + 1);
    if (damper->name)
        snprintf(name, sizeof name, "%s", damper->name);
    char whole[LETTERS];
    snprintf(whole, sizeof whole, "%s.factor", name);
    report_row(v, whole, number_or_null(r->to.damping, j));
    for (size_t i = 0; i < law->count; i++) {
        char part[LETTERS / 2] = ".";
        const char *number;
        if (law->term[i].kind == FVI_KERNEL_SYMBOL) {
            warn(v, name, "no derivatives by the numbers of the law of %s", name);
            return;
        }
        const fvi_element kind = fvi_element_of(law->term + i);
        const int is_exchanged =
            fvi_pair_is_exchanged(&r->o.lets, first + i, fvi_gradient_terms(r));
        if (law->count > 1)
            snprintf(part, sizeof part, ".%s%zu.", fvi_element_words[kind], i + 1);
        for (size_t l = 0, field;
             (number = fvi_element_number_typed(kind, l, is_exchanged, &field)); l++) {
            snprintf(whole, sizeof whole, "%s%s%s", name, part, number);
            row_of_number(v, r, whole, first + i, kind, field);
        }
    }
}

static void rows_of_dampers(const visitor *v, const request *r)
{
    const fvi_mechanism *of = r->system.mechanism;
    for (size_t j = 0, first = 0; of && j < of->damper_count;
         first += of->damper[j++].kernel->count)
        rows_of_damper(v, r, j, first);
}

#define OF_A_JUMP "what acts jumps at a row, where the two sides of form D count differently"

/* Visit the rows of the masses, or the row of a factor of M. */
static void rows_of_inertia(const visitor *v, const request *r)
{
    if (r->has_mass && r->ground_jumps)
        warn(v, "mass", "no derivative by mass: %s", OF_A_JUMP);
    else if (r->has_mass && r->system.matrices)
        report_row(v, "mass", r->to.mass);
    else if (r->has_mass)
        rows_of_coordinates(v, r, "mass", r->to.mass, warning_of_mass);
    else if (!r->o.text[LAGRANGIAN])
        warn(v, "mass", "no derivative by mass: %s",
             r->o.ground ? "steps of any length ask for the ground between the rows"
                         : "the potential knows the time");
}

/* Visit the rows of rho, or of a factor of C, and of alpha. */
static void rows_of_power(const visitor *v, const request *r)
{
    if (r->system.matrices)
        report_row(v, "rho", r->to.damping);
    else
        rows_of_coordinates(v, r, "rho", r->to.damping, no_warning);
    if (r->has_alpha)
        report_row(v, "alpha", r->to.alpha);
    else
        warn(v, "alpha", "no derivative by alpha: %s",
             r->system.matrices ? "of a folder steps of any length have none at 0"
             : r->o.method->scheme == FVI_SCHEME_VARIABLE_STEP
                 ? "there x has a logarithm at 0, for which these steps are not made"
                 : "p of this method jumps at 1");
}

/* Visit the rows of the constants of a potential that is no expression, or the row of a factor of K. */
static void rows_of_potential(const visitor *v, const request *r)
{
    static const char *const c_and_g[] = { "c", "g" };
    const int is_pendulum = r->o.potential.kind == FVI_POTENTIAL_PENDULUM;
    if (r->system.matrices)
        report_row(v, "c", r->to.parameters);
    for (size_t j = 0; !r->system.matrices && !r->to.lagrangian && !r->o.potential.expression
                       && j < r->to.sensitivity.count; j++)
        report_row(v, is_pendulum ? "g" : c_and_g[j], number_or_null(r->to.parameters, j));
}

void fvi_gradient_rows(const request *r, const visitor *v)
{
    rows_of_coordinates(v, r, "x0", r->to.x0, warning_of_place);
    rows_of_coordinates(v, r, "p0", r->to.p0, warning_of_start);
    rows_of_inertia(v, r);
    for (size_t i = 0; i < r->terms; i++)
        rows_of_term(v, r, i);
    rows_of_dampers(v, r);
    if (r->terms == 0 && !r->system.mechanism)
        rows_of_power(v, r);
    rows_of_potential(v, r);
    for (size_t j = 0; j < r->o.lets.count; j++)
        if (r->o.lets.used[j] & FVI_USED_BY_DAMPING)
            warn(v, r->o.lets.name[j], "no derivative by %s, of which the law speaks",
                 r->o.lets.name[j]);
        else if (r->is_tied[j])
            warn(v, r->o.lets.name[j], "no derivative by %s: by a constraint the start would have to "
                 "follow it, or by a damper of the past rl that must not be stretched",
                 r->o.lets.name[j]);
        else if (r->is_jumped[j])
            warn(v, r->o.lets.name[j], "no derivative by %s: " OF_A_JUMP, r->o.lets.name[j]);
        else
            report_row(v, r->o.lets.name[j], r->lets + j);
}
