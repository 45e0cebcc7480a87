/* src/problem/typed_problem.c -- Parse a whole problem, such as m=1; U=duffing:1,0.7. */
#define _GNU_SOURCE /* for strdup */
#include "words.h"

#include <fvi/methods.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef enum {
    LET,
    DIMENSION,
    POTENTIAL,
    MASS,
    RHO,
    ALPHA,
    DAMPING,
    X0,
    P0,
    TIME,
    FORCE,
    DERIVATIVE,
    LAGRANGIAN,
    V0,
    DAMPERS, /* from here on each name may be repeated */
    CONSTRAINT,
    IMPOSE,
    FORCE_ON,
    NAMES
} name_index;

/* The names of the program, short names, and the values of names that are left out. */
static const struct {
    const char *name, *brief, *preset;
} names[NAMES] = {
    [LET] = { "let", "let", NULL },
    [DIMENSION] = { "dimension", "d", NULL },
    [POTENTIAL] = { "potential", "U", "harmonic:1" },
    [MASS] = { "mass", "m", "1" },
    [RHO] = { "rho", "rho", "0.2" },
    [ALPHA] = { "alpha", "alpha", "0.5" },
    [DAMPING] = { "damping", "damper", NULL },
    [X0] = { "x0", "x0", "1" },
    [P0] = { "p0", "p0", "0.5" },
    [TIME] = { "time", "T", "20" },
    [FORCE] = { "force", "F", "none" },
    [DERIVATIVE] = { "derivative", "past", "held" },
    [LAGRANGIAN] = { "lagrangian", "L", NULL },
    [V0] = { "v0", "v0", NULL },
    [DAMPERS] = { "damper", "damper", NULL }, /* found as DAMPING */
    [CONSTRAINT] = { "constraint", "constraint", NULL },
    [IMPOSE] = { "impose", "impose", NULL },
    [FORCE_ON] = { "force-on", "force-on", NULL },
};

enum { LISTS = NAMES - DAMPERS, MOST_LISTED = 64 };

struct fvi_typed_problem {
    char *copy; /* copy of the text, cut into pieces */
    const char *text[NAMES];
    struct {
        size_t count;
        const char *value[MOST_LISTED];
    } list[LISTS];
    fvi_typed_mechanism *mechanism;
    fvi_user_parameters parameters;
    fvi_typed_potential potential;
    fvi_typed_damping damping;
    fvi_typed_force *force;
    double *numbers; /* masses, rho, x0, p0 and v0 */
    fvi_problem problem;
};

/* ---- pieces ---- */

static char *trim(char *text)
{
    text += strspn(text, " \t\n");
    size_t length = strlen(text);
    while (length > 0 && strchr(" \t\n", text[length - 1]))
        length--;
    text[length] = '\0';
    return text;
}

static int list_value(fvi_typed_problem *p, size_t i, const char *value,
                      fvi_error *error)
{
    const size_t n = i - DAMPERS;
    if (p->list[n].count == MOST_LISTED)
        return fvi_refuse(error, names[i].name, "'%s': too many of them", value);
    p->list[n].value[p->list[n].count++] = value;
    return FVI_SUCCESS;
}

/* Take a piece "NAME=VALUE". */
static int parse_piece(fvi_typed_problem *p, char *piece, fvi_error *error)
{
    char *equals = strchr(piece, '='), place[64];
    const char *words[NAMES + 1] = { NULL };
    size_t i = 0;
    if (!equals)
        return fvi_refuse(error, "problem", "'%s' is not NAME=VALUE", piece);
    *equals = '\0';
    const char *name = trim(piece);
    while (i < NAMES && strcmp(names[i].name, name) != 0
           && strcmp(names[i].brief, name) != 0)
        i++;
    for (size_t n = 0; n < NAMES; n++)
        words[n] = names[n].name;
    if (i == NAMES)
        return fvi_refuse(error, "problem", "'%s' is no name of a problem%s", name,
                        fvi_word_hint(name, strlen(name), words, place));
    const char *value = trim(equals + 1);
    if (i == DAMPING && strstr(value, " : "))
        i = DAMPERS;
    if (i >= DAMPERS)
        return list_value(p, i, value, error);
    if (p->text[i])
        return fvi_refuse(error, names[i].name, "given twice");
    p->text[i] = value;
    return FVI_SUCCESS;
}

/* Refuse names that do not go together, and fill in the values of names that are left out. */
static int check_pieces(fvi_typed_problem *p, fvi_error *error)
{
    const int has_law = p->text[DAMPING] != NULL,
              has_dampers = p->text[LAGRANGIAN] || p->list[0].count > 0;
    static const name_index dampings[] = { ALPHA, RHO, DAMPING, DERIVATIVE };
    if (has_law && (p->text[ALPHA] || p->text[RHO]))
        return fvi_refuse(error, "damping", "not together with %s", p->text[ALPHA] ? "alpha" : "rho");
    for (size_t i = 0; i < 4; i++)
        if (has_dampers && p->text[dampings[i]])
            return fvi_fail(error, FVI_EINVAL, p->text[LAGRANGIAN] ? "lagrangian" : "damper", NAN,
                            "not together with %s", names[dampings[i]].name);
    if (p->text[LAGRANGIAN] && (p->text[POTENTIAL] || p->text[MASS]))
        return fvi_refuse(error, "lagrangian", "not together with %s", p->text[MASS] ? "mass" : "potential");
    if (p->text[V0] && p->text[P0])
        return fvi_refuse(error, "v0", "not together with p0");
    if (p->text[LAGRANGIAN] && (!p->text[X0] || (!p->text[V0] && !p->text[P0])))
        return fvi_refuse(error, "lagrangian", "a start is missing: x0, and v0 or p0");
    for (size_t i = 0; i < DAMPERS; i++)
        if (!p->text[i])
            p->text[i] = has_dampers && i == RHO ? "0"
                         : has_law && i == RHO   ? "1"
                         : i == POTENTIAL && p->text[LAGRANGIAN]
                             ? "free"
                             : names[i].preset;
    return FVI_SUCCESS;
}

static int parse_pieces(fvi_typed_problem *p, fvi_error *error)
{
    int status = FVI_SUCCESS;
    for (char *at = p->copy, *next = at; next && !status; at = next) {
        if ((next = strchr(at, ';')))
            *next++ = '\0';
        at = trim(at);
        if (*at)
            status = parse_piece(p, at, error);
    }
    return status ? status : check_pieces(p, error);
}

/* ---- values ---- */

static size_t larger_count(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* Return the largest index in the texts of a mechanism and of the potential. Return 0 without a mechanism, and for a
 * chain, which states its own number of masses. */
static size_t largest_index(const fvi_typed_problem *p)
{
    size_t most =
        p->text[LAGRANGIAN] ? fvi_largest_index(p->text[LAGRANGIAN]) : 0;
    for (size_t n = 0; n < LISTS; n++)
        for (size_t i = 0; i < p->list[n].count; i++)
            most = larger_count(most, fvi_largest_index(p->list[n].value[i]));
    return p->potential.kind == FVI_POTENTIAL_CHAIN || most == 0
               ? 0
               : larger_count(most, p->potential.d);
}

static int parse_potential(fvi_typed_problem *p, fvi_error *error)
{
    size_t d = 0;
    int status = FVI_SUCCESS;
    if (p->text[LET])
        status = fvi_parse_user_parameters(p->text[LET], &p->parameters, error);
    if (!status && p->text[DIMENSION])
        status = fvi_parse_whole("dimension", p->text[DIMENSION], 1000000, &d,
                                 error);
    if (!status)
        status = fvi_parse_potential(p->text[POTENTIAL], d, &p->parameters,
                                     &p->potential, error);
    if (d == 0)
        d = largest_index(p);
    p->problem.system.d = d ? d : p->potential.d ? p->potential.d : 1;
    if (!status && d > p->potential.d
        && p->potential.kind == FVI_POTENTIAL_EXPRESSION) {
        fvi_typed_potential_free(&p->potential); /* parse it again with more coordinates */
        status = fvi_parse_potential(p->text[POTENTIAL], d, &p->parameters,
                                     &p->potential, error);
    }
    p->problem.system.potential = fvi_potential_typed(&p->potential);
    return status;
}

/* Parse the mechanism, and compute the momentum of v0. */
static int parse_mechanism(fvi_typed_problem *p, fvi_error *error)
{
    fvi_problem *to = &p->problem;
    const size_t d = to->system.d;
    char **made = NULL;
    fvi_mechanism_texts texts = { p->text[LAGRANGIAN],   p->list[0].count,
                                  p->list[1].count,      p->list[2].count,
                                  p->list[3].count,      p->list[0].value,
                                  p->list[1].value,      p->list[2].value,
                                  p->list[3].value };
    int status = FVI_SUCCESS;
    if (texts.lagrangian || texts.dampers + texts.constraints + texts.imposed
                                + texts.forces_on > 0) {
        if (!texts.lagrangian && texts.dampers == 0) {
            status = fvi_damper_texts(d, to->system.damping, to->alpha,
                                      p->text[DAMPING], p->text[DERIVATIVE],
                                      &texts.dampers, &made, error);
            texts.damper = (const char *const *)made;
            memset(p->numbers + d, 0, d * sizeof *p->numbers);
        }
        if (!status)
            status = fvi_parse_mechanism(&texts, d, &p->parameters,
                                         &p->mechanism, error);
        free(made);
        if (status)
            return status;
        to->system.mechanism = fvi_mechanism_typed(p->mechanism);
        to->law = NULL;
    }
    return p->text[V0] ? fvi_momentum_of_velocity(&to->system, 0, to->x0,
                                                  p->numbers + 4 * d,
                                                  p->numbers + 3 * d)
                       : status;
}

static int parse_lists(fvi_typed_problem *p, fvi_error *error)
{
    const struct {
        name_index i;
        double low;
        const char *brackets;
    } lists[] = { { MASS, 0, "()" },
                  { RHO, 0, "[)" },
                  { X0, -INFINITY, "()" },
                  { P0, -INFINITY, "()" },
                  { V0, -INFINITY, "()" } };
    const size_t d = p->problem.system.d;
    p->numbers = malloc(5 * d * sizeof *p->numbers);
    if (!p->numbers)
        return fvi_no_memory(error, "problem");
    int status = FVI_SUCCESS;
    for (size_t n = 0; n < 5 && !status; n++)
        if (p->text[lists[n].i])
            status = fvi_parse_numbers(names[lists[n].i].name,
                                       p->text[lists[n].i], lists[n].low,
                                       INFINITY, lists[n].brackets, d,
                                       p->numbers + n * d, error);
    p->problem.system.mass = p->numbers;
    p->problem.system.damping = p->numbers + d;
    p->problem.x0 = p->numbers + 2 * d;
    p->problem.p0 = p->numbers + 3 * d;
    return status;
}

static int parse_damping(fvi_typed_problem *p, fvi_error *error)
{
    if (!p->text[DAMPING])
        return fvi_parse_number("alpha", p->text[ALPHA], 0, 1, "[]",
                                &p->problem.alpha, error);
    p->problem.law = &p->damping.law;
    return fvi_parse_damping(p->text[DAMPING], &p->parameters, &p->damping,
                             error);
}

static int parse_force(fvi_typed_problem *p, fvi_error *error)
{
    fvi_problem *to = &p->problem;
    int status = fvi_parse_number("time", p->text[TIME], 0, INFINITY, "()",
                                  &to->T, error);
    if (!status)
        status = fvi_parse_force(p->text[FORCE], to->system.d, &p->parameters,
                                 to->T, &p->force, error);
    if (!status)
        to->system.force = fvi_force_typed(p->force);
    return status;
}

static int parse_all(fvi_typed_problem *p, fvi_error *error)
{
    size_t past = 0;
    int status = parse_pieces(p, error);
    if (!status)
        status = parse_potential(p, error);
    if (!status)
        status = parse_lists(p, error);
    if (!status)
        status = parse_damping(p, error);
    if (!status)
        status = parse_force(p, error);
    if (!status)
        status = parse_mechanism(p, error);
    if (!status)
        status = fvi_user_parameters_are_used(&p->parameters, error);
    if (!status)
        status = fvi_parse_word("derivative", p->text[DERIVATIVE],
                                fvi_initial_history_words, &past, error);
    p->problem.past = (fvi_initial_history)past;
    return status;
}

int fvi_parse_problem(const char *text, fvi_typed_problem **problem,
                      fvi_error *error)
{
    if (!text || !problem)
        return fvi_fail(error, FVI_EFAULT, "problem", NAN, "null pointer");
    fvi_typed_problem *p = calloc(1, sizeof *p);
    if (!p || !(p->copy = strdup(text))) {
        free(p);
        return fvi_no_memory(error, "problem");
    }
    const int status = parse_all(p, error);
    if (status)
        fvi_typed_problem_free(p);
    else
        *problem = p;
    return status;
}

const fvi_problem *fvi_problem_typed(const fvi_typed_problem *problem)
{
    return &problem->problem;
}

void fvi_typed_problem_free(fvi_typed_problem *p)
{
    if (!p)
        return;
    fvi_typed_potential_free(&p->potential);
    fvi_typed_damping_free(&p->damping);
    fvi_typed_force_free(p->force);
    fvi_typed_mechanism_free(p->mechanism);
    free(p->numbers);
    free(p->copy);
    free(p);
}

int fvi_parse_method(const char *text, const fvi_method **method,
                     fvi_error *error)
{
    const char *words[64] = { NULL };
    size_t which;
    for (size_t i = 0; i < 63 && fvi_methods[i]; i++)
        words[i] = fvi_methods[i]->name;
    const int status = fvi_parse_word("method", text, words, &which, error);
    if (!status)
        *method = fvi_methods[which];
    return status;
}
