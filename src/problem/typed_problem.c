/* src/problem/typed_problem.c -- A whole problem as it is typed: m=1; U=duffing:1,0.7. */
#define _GNU_SOURCE /* strdup */
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
    NAMES
} name_index;

/* The names of the program, short ones, and what stands for a name that is left out. */
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
};

struct fvi_typed_problem {
    char *copy; /* of the text, cut into pieces */
    const char *text[NAMES];
    fvi_user_parameters parameters;
    fvi_typed_potential potential;
    fvi_typed_damping damping;
    fvi_typed_force *force;
    double *numbers; /* masses, rho, x0 and p0 */
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

/* One "NAME=VALUE". */
static int take_piece(fvi_typed_problem *p, char *piece, fvi_error *error)
{
    char *equals = strchr(piece, '='), place[64];
    const char *words[NAMES + 1] = { NULL };
    size_t i = 0;
    if (!equals)
        return fvi_fail(error, FVI_EINVAL, "problem", NAN,
                        "'%s' is not NAME=VALUE", piece);
    *equals = '\0';
    const char *name = trim(piece);
    while (i < NAMES && strcmp(names[i].name, name) != 0
           && strcmp(names[i].brief, name) != 0)
        i++;
    for (size_t n = 0; n < NAMES; n++)
        words[n] = names[n].name;
    if (i == NAMES)
        return fvi_fail(error, FVI_EINVAL, "problem", NAN,
                        "'%s' is no name of a problem%s", name,
                        fvi_word_hint(name, strlen(name), words, place));
    if (p->text[i])
        return fvi_fail(error, FVI_EINVAL, names[i].name, NAN, "given twice");
    p->text[i] = trim(equals + 1);
    return FVI_SUCCESS;
}

static int take_pieces(fvi_typed_problem *p, fvi_error *error)
{
    int status = FVI_SUCCESS;
    for (char *at = p->copy, *next = at; next && !status; at = next) {
        if ((next = strchr(at, ';')))
            *next++ = '\0';
        at = trim(at);
        if (*at)
            status = take_piece(p, at, error);
    }
    const int has_law = p->text[DAMPING] != NULL;
    if (!status && has_law && (p->text[ALPHA] || p->text[RHO]))
        return fvi_fail(error, FVI_EINVAL, "damping", NAN,
                        "not together with %s",
                        p->text[ALPHA] ? "alpha" : "rho");
    for (size_t i = 0; i < NAMES; i++)
        if (!p->text[i])
            p->text[i] = has_law && i == RHO ? "1" : names[i].preset;
    return status;
}

/* ---- values ---- */

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
    p->problem.system.d = d ? d : p->potential.d ? p->potential.d : 1;
    p->problem.system.potential = fvi_potential_typed(&p->potential);
    return status;
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
                  { P0, -INFINITY, "()" } };
    const size_t d = p->problem.system.d;
    p->numbers = malloc(4 * d * sizeof *p->numbers);
    if (!p->numbers)
        return fvi_fail(error, FVI_ENOMEM, "problem", NAN, "not enough memory");
    int status = FVI_SUCCESS;
    for (size_t n = 0; n < 4 && !status; n++)
        status = fvi_parse_numbers(names[lists[n].i].name, p->text[lists[n].i],
                                   lists[n].low, INFINITY, lists[n].brackets, d,
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
    int status = take_pieces(p, error);
    if (!status)
        status = parse_potential(p, error);
    if (!status)
        status = parse_lists(p, error);
    if (!status)
        status = parse_damping(p, error);
    if (!status)
        status = parse_force(p, error);
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
        return fvi_fail(error, FVI_ENOMEM, "problem", NAN, "not enough memory");
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
    free(p->numbers);
    free(p->copy);
    free(p);
}

int fvi_parse_method(const char *text, const fvi_method **method,
                     fvi_error *error)
{
    const char *words[64] = { NULL };
    size_t which;
    for (size_t i = 0; fvi_methods[i] && i < 63; i++)
        words[i] = fvi_methods[i]->name;
    const int status = fvi_parse_word("method", text, words, &which, error);
    if (!status)
        *method = fvi_methods[which];
    return status;
}
