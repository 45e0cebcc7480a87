/* src/problem/typed_problem.c -- Parse a whole problem, such as m=1; U=duffing:1,0.7. */
#define _GNU_SOURCE /* for strdup */
#include "words.h"

#include "system/larger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The names that a problem may contain. */
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
    NAMES /* how many there are */
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

enum { LISTS = NAMES - DAMPERS, MOST_LISTED = 64 /* largest number of values of one name */ };

/* The values of a name that may be repeated. */
typedef struct {
    size_t count;
    const char *value[MOST_LISTED];
} value_list;

struct fvi_typed_problem {
    char *copy;               /* copy of the text, cut into pieces, to which the next two point */
    const char *text[NAMES];  /* the value of each name that is not repeated, or its preset; NULL without both */
    value_list list[LISTS];   /* of DAMPERS, CONSTRAINT, IMPOSE and FORCE_ON, see list_of */
    fvi_typed_mechanism *mechanism;
    fvi_user_parameters parameters;
    fvi_typed_potential potential;
    fvi_typed_damping damping;
    fvi_typed_force *force;
    double *mass, *rho, *x0, *p0, *v0; /* d numbers each; one block, which begins at mass */
    fvi_problem problem;      /* points into the other members */
};

/* Return the values of a name that may be repeated. */
static value_list *list_of(fvi_typed_problem *p, name_index i)
{
    return &p->list[i - DAMPERS];
}

/* ---- pieces ---- */

/* Cut the blanks off both ends of a text, in place. Return where it begins. */
static char *trim(char *text)
{
    text += strspn(text, " \t\n");
    size_t length = strlen(text);
    while (length > 0 && strchr(" \t\n", text[length - 1]))
        length--;
    text[length] = '\0';
    return text;
}

static int add_to_list(fvi_typed_problem *p, name_index i, const char *value,
                       fvi_error *error)
{
    value_list *list = list_of(p, i);
    if (list->count == MOST_LISTED)
        return fvi_refuse(error, names[i].name, "'%s': too many of them", value);
    list->value[list->count++] = value;
    return FVI_SUCCESS;
}

/* Record the value of a piece "NAME=VALUE", which is cut in place. A damper with a colon between blanks is a damper of
 * a mechanism, any other one is the damping of all coordinates. */
static int parse_piece(fvi_typed_problem *p, char *piece, fvi_error *error)
{
    char *equals = strchr(piece, '='), room_for_hint[64];
    const char *words[NAMES + 1] = { NULL }; /* for the hint */
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
                        fvi_word_hint(name, strlen(name), words, room_for_hint));
    const char *value = trim(equals + 1);
    if (i == DAMPING && strstr(value, " : "))
        i = DAMPERS;
    if (i >= DAMPERS)
        return add_to_list(p, (name_index)i, value, error);
    if (p->text[i])
        return fvi_refuse(error, names[i].name, "given twice");
    p->text[i] = value;
    return FVI_SUCCESS;
}

/* Return the value of a name that is left out; NULL if it has none. A law has rho = 1, a mechanism has rho = 0. */
static const char *default_value(const fvi_typed_problem *p, size_t i, int has_law, int has_mechanism)
{
    if (i == RHO && has_mechanism)
        return "0";
    if (i == RHO && has_law)
        return "1";
    if (i == POTENTIAL && p->text[LAGRANGIAN])
        return "free";
    return names[i].preset;
}

/* Refuse names that do not go together, and fill in the values of names that are left out. */
static int complete_pieces(fvi_typed_problem *p, fvi_error *error)
{
    const int has_law = p->text[DAMPING] != NULL,
              has_mechanism = p->text[LAGRANGIAN] || list_of(p, DAMPERS)->count > 0;
    static const name_index dampings[] = { ALPHA, RHO, DAMPING, DERIVATIVE };
    if (has_law && (p->text[ALPHA] || p->text[RHO]))
        return fvi_refuse(error, "damping", "not together with %s", p->text[ALPHA] ? "alpha" : "rho");
    for (size_t i = 0; i < sizeof dampings / sizeof *dampings; i++)
        if (has_mechanism && p->text[dampings[i]])
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
            p->text[i] = default_value(p, i, has_law, has_mechanism);
    return FVI_SUCCESS;
}

/* Cut the text at its semicolons, and record the values. */
static int parse_pieces(fvi_typed_problem *p, fvi_error *error)
{
    int status = FVI_SUCCESS;
    char *piece = p->copy;
    while (piece && !status) {
        char *semicolon = strchr(piece, ';');
        if (semicolon)
            *semicolon = '\0';
        piece = trim(piece);
        if (*piece)
            status = parse_piece(p, piece, error);
        piece = semicolon ? semicolon + 1 : NULL;
    }
    return status ? status : complete_pieces(p, error);
}

/* ---- values ---- */

/* Return the largest index of a coordinate in the texts of a mechanism and of the potential. Return 0 if the texts of a
 * mechanism have none, and for a chain, which states its own number of masses. */
static size_t largest_index(const fvi_typed_problem *p)
{
    size_t largest =
        p->text[LAGRANGIAN] ? fvi_largest_index(p->text[LAGRANGIAN]) : 0;
    for (size_t n = 0; n < LISTS; n++)
        for (size_t i = 0; i < p->list[n].count; i++)
            largest = larger_count(largest, fvi_largest_index(p->list[n].value[i]));
    if (largest == 0 || p->potential.kind == FVI_POTENTIAL_CHAIN)
        return 0;
    return larger_count(largest, p->potential.d);
}

/* Parse the parameters and the potential, and find the dimension d of the problem: as given; or the largest index of a
 * mechanism; or that of the potential; or 1. */
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
    p->problem.system.d = d > 0 ? d : larger_count(p->potential.d, 1);
    if (!status && d > p->potential.d
        && p->potential.kind == FVI_POTENTIAL_EXPRESSION) {
        fvi_typed_potential_free(&p->potential); /* parse it again with more coordinates */
        status = fvi_parse_potential(p->text[POTENTIAL], d, &p->parameters,
                                     &p->potential, error);
    }
    p->problem.system.potential = fvi_potential_typed(&p->potential);
    return status;
}

/* Parse the mechanism, and compute the momentum of v0. In a mechanism all dampings are dampers. So if constraints,
 * imposed motions or forces on coordinates are all that is given of it, the dampings of the coordinates become texts of
 * dampers. */
static int parse_mechanism(fvi_typed_problem *p, fvi_error *error)
{
    fvi_problem *problem = &p->problem;
    const size_t d = problem->system.d;
    const value_list *dampers = list_of(p, DAMPERS), *constraints = list_of(p, CONSTRAINT),
                     *imposed = list_of(p, IMPOSE), *forces_on = list_of(p, FORCE_ON);
    char **made = NULL; /* texts of dampers that stand for the dampings of the coordinates */
    fvi_mechanism_texts texts = { .lagrangian = p->text[LAGRANGIAN],
                                  .dampers = dampers->count,
                                  .damper = dampers->value,
                                  .constraints = constraints->count,
                                  .constraint = constraints->value,
                                  .imposed = imposed->count,
                                  .impose = imposed->value,
                                  .forces_on = forces_on->count,
                                  .force_on = forces_on->value };
    int status = FVI_SUCCESS;
    if (texts.lagrangian || texts.dampers + texts.constraints + texts.imposed
                                + texts.forces_on > 0) {
        if (!texts.lagrangian && texts.dampers == 0) {
            status = fvi_damper_texts(d, p->rho, problem->alpha,
                                      p->text[DAMPING], p->text[DERIVATIVE],
                                      &texts.dampers, &made, error);
            texts.damper = (const char *const *)made;
            memset(p->rho, 0, d * sizeof *p->rho);
        }
        if (!status)
            status = fvi_parse_mechanism(&texts, d, &p->parameters,
                                         &p->mechanism, error);
        free(made);
        if (status)
            return status;
        problem->system.mechanism = fvi_mechanism_typed(p->mechanism);
        problem->law = NULL;
    }
    if (p->text[V0])
        status = fvi_momentum_of_velocity(&problem->system, 0, p->x0, p->v0, p->p0);
    return p->text[V0] && !status ? fvi_check_start_velocity(&problem->system, p->x0, p->v0, p->p0, error) : status;
}

/* Parse masses, rho, x0, p0 and v0: d numbers each. */
static int parse_numbers_of_coordinates(fvi_typed_problem *p, fvi_error *error)
{
    const size_t d = p->problem.system.d;
    p->mass = malloc(5 * d * sizeof *p->mass);
    if (!p->mass)
        return fvi_no_memory(error, "problem");
    p->rho = p->mass + d;
    p->x0 = p->rho + d;
    p->p0 = p->x0 + d;
    p->v0 = p->p0 + d;
    const struct {
        name_index i;
        double low;           /* the numbers lie between low and infinity; brackets says which ends are allowed */
        const char *brackets;
        double *numbers;
    } lists[] = { { MASS, 0, "()", p->mass },
                  { RHO, 0, "[)", p->rho },
                  { X0, -INFINITY, "()", p->x0 },
                  { P0, -INFINITY, "()", p->p0 },
                  { V0, -INFINITY, "()", p->v0 } };
    int status = FVI_SUCCESS;
    for (size_t n = 0; n < sizeof lists / sizeof *lists && !status; n++)
        if (p->text[lists[n].i])
            status = fvi_parse_numbers(names[lists[n].i].name,
                                       p->text[lists[n].i], lists[n].low,
                                       INFINITY, lists[n].brackets, d,
                                       lists[n].numbers, error);
    p->problem.system.mass = p->mass;
    p->problem.system.damping = p->rho;
    p->problem.x0 = p->x0;
    p->problem.p0 = p->p0;
    return status;
}

/* Parse the damping of all coordinates: alpha, or a law. */
static int parse_damping(fvi_typed_problem *p, fvi_error *error)
{
    if (!p->text[DAMPING])
        return fvi_parse_number("alpha", p->text[ALPHA], 0, 1, "[]",
                                &p->problem.alpha, error);
    p->problem.law = &p->damping.law;
    return fvi_parse_damping(p->text[DAMPING], &p->parameters, &p->damping,
                             error);
}

/* Parse the time at the end of the run, and the force until then. */
static int parse_force(fvi_typed_problem *p, fvi_error *error)
{
    fvi_problem *problem = &p->problem;
    int status = fvi_parse_number("time", p->text[TIME], 0, INFINITY, "()",
                                  &problem->T, error);
    if (!status)
        status = fvi_parse_force(p->text[FORCE], problem->system.d, &p->parameters,
                                 problem->T, &p->force, error);
    if (!status)
        problem->system.force = fvi_force_typed(p->force);
    return status;
}

/* Parse all values. The order matters: the numbers need d, which the potential gives, and the mechanism needs the
 * damping and the start. */
static int parse_all(fvi_typed_problem *p, fvi_error *error)
{
    size_t past = 0;
    int status = parse_pieces(p, error);
    if (!status)
        status = parse_potential(p, error);
    if (!status)
        status = parse_numbers_of_coordinates(p, error);
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
    free(p->mass);
    free(p->copy);
    free(p);
}
