/* src/options/fvi_problem.c -- From the words of the command line to a system. */
#include "fvi_problem.h"
#include "input/fvi_shared.h"

#include <fvi/error.h>
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* What each mass has: x0, p0, mass, rho, one value for all, or a list. */
int fvi_problem_lists(fvi_options *o, fvi_complaint c)
{
    o->x0 = malloc(4 * o->d * sizeof *o->x0);
    if (!o->x0) {
        fvi_refuse(c, "no memory for the start");
        return 1;
    }
    o->p0 = o->x0 + o->d;
    o->mass = o->p0 + o->d;
    o->rho = o->mass + o->d;
    const struct {
        option_index option;
        double *values, low;
        const char *brackets;
    } lists[] = { { RHO, o->rho, 0, "[)" },
                  { MASS, o->mass, 0, "()" },
                  { X0, o->x0, -INFINITY, "()" },
                  { P0, o->p0, -INFINITY, "()" } };
    int status = 0;
    const size_t own = o->directory ? 2 : 0; /* its masses and dampings */
    if (o->directory) {
        const fvi_system s = fvi_directory_system(o->directory);
        memcpy(o->mass, s.mass, o->d * sizeof *o->mass);
        memcpy(o->rho, s.damping, o->d * sizeof *o->rho);
    }
    for (size_t i = own; !status && i < sizeof lists / sizeof *lists; i++) {
        const char *text = o->text[lists[i].option];
        status = fvi_word_list(fvi_option_list[lists[i].option].name,
                               text ? text : "1", /* rho of a law */
                               lists[i].low, INFINITY, lists[i].brackets, o->d,
                               lists[i].values, c);
    }
    return status;
}

static int no_memory(fvi_complaint c)
{
    fvi_refuse(c, "not enough memory");
    return 1;
}

/* A potential that is none of the words is an expression. */
static int interpret_expression(fvi_options *o, fvi_complaint c)
{
    const char *text = o->text[POTENTIAL],
               *near = fvi_word_near_potential(text);
    fvi_misprint wrong;
    int status =
        fvi_user_parameters_parse(&o->lets, "x", o->d, text, &o->expression, &wrong);
    if (status == FVI_ENOMEM)
        return no_memory(c);
    if (status && near)
        return fvi_refuse(c,
                          "--potential: '%s' is none of harmonic:C, "
                          "duffing:C,G, pendulum:G, free, chain:D,C,G, nor "
                          "an expression; did you mean %s?",
                          text, near);
    return status ? fvi_refuse_at(c, "potential", text, wrong) : 0;
}

static int read_system(fvi_options *o, fvi_complaint c)
{
    int status = fvi_directory_open(o->text[SYSTEM], &o->directory, c);
    if (!status && o->text[LET])
        status = fvi_user_parameters_interpret(&o->lets, c);
    if (status)
        return status;
    o->d = fvi_directory_system(o->directory).d;
    o->potential = FVI_POTENTIAL_FREE;
    o->numbered = 1;
    return 0;
}

/* How many masses there are, and what is between them. */
int fvi_problem_potential(fvi_options *o, fvi_complaint c)
{
    o->d = 1;
    if (o->text[SYSTEM])
        return read_system(o, c);
    int status =
        o->text[DIMENSION]
            ? fvi_word_whole("dimension", o->text[DIMENSION], 1000000, &o->d, c)
            : 0;
    const size_t d = o->d;
    if (!status)
        status = fvi_word_potential(o->text[POTENTIAL], &o->potential, &o->d,
                                    o->spring, c);
    if (!status && o->text[DIMENSION] && o->d != d)
        return fvi_refuse(c, "--dimension: '%s' is not that of '%s'",
                          o->text[DIMENSION], o->text[POTENTIAL]);
    o->numbered = o->d > 1 || o->potential == FVI_POTENTIAL_CHAIN;
    if (!status && o->text[LET])
        status = fvi_user_parameters_interpret(&o->lets, c);
    if (!status && o->potential == FVI_POTENTIAL_EXPRESSION) {
        if (!fvi_shared_name(o->text[POTENTIAL]))
            return interpret_expression(o, c);
        o->potential = FVI_POTENTIAL_SHARED;
        status = fvi_shared_open(o->text[POTENTIAL], &o->library, &o->user, c);
    }
    return status;
}

int fvi_problem_force(fvi_options *o, fvi_complaint c)
{
    int found = 0;
    const double last = (double)o->steps * o->h;
    if (o->directory) {
        int status = fvi_directory_force(o->directory, last, &found, c);
        if (status)
            return status;
    }
    if (found && strcasecmp(o->text[FORCE], "none") != 0)
        return fvi_refuse(c, "--force: '%s': there is %s/f.tsv, too",
                          o->text[FORCE], o->text[SYSTEM]);
    if (found) { /* the head says what acts */
        o->text[FORCE] = fvi_directory_force_name(o->directory);
        return 0;
    }
    if (!fvi_word_force(o->text[FORCE], &o->force, o->forcing))
        return fvi_forces_parse(o->text[FORCE], o->d, &o->lets, last,
                                &o->forces, c);
    if (o->force == FVI_FORCING_STEP && o->forcing[1] < 0)
        return fvi_refuse(c, "--force: '%s' ends before it begins",
                          o->text[FORCE]);
    return 0;
}

/* "3,17" of x1, ..., xd; all of them where nothing is said. */
int fvi_problem_unknowns(fvi_options *o, fvi_complaint c)
{
    const char *text = o->text[UNKNOWNS];
    o->shown = malloc(o->d * sizeof *o->shown);
    if (!o->shown) {
        fvi_refuse(c, "not enough memory");
        return 1;
    }
    for (; !text && o->shown_count < o->d; o->shown_count++)
        o->shown[o->shown_count] = o->shown_count;
    while (text) {
        char *stop;
        const size_t i =
            isdigit((unsigned char)*text) ? strtoul(text, &stop, 10) : 0;
        if (i < 1 || i > o->d || (*stop && *stop != ','))
            return fvi_refuse(c,
                              "--unknowns: '%s' is not a list of numbers from "
                              "1 to %zu",
                              o->text[UNKNOWNS], o->d);
        for (size_t k = 0; k < o->shown_count; k++)
            if (o->shown[k] == i - 1)
                return fvi_refuse(c, "--unknowns: %zu stands twice in '%s'", i,
                                  o->text[UNKNOWNS]);
        o->shown[o->shown_count++] = i - 1;
        text = *stop ? stop + 1 : NULL;
    }
    return 0;
}

fvi_system fvi_options_system(const fvi_options *o)
{
    fvi_system s = { .d = o->d, .mass = o->mass, .damping = o->rho };
    if (o->directory)
        s = fvi_directory_system(o->directory);
    switch (o->potential) {
    case FVI_POTENTIAL_HARMONIC:
        s.potential = fvi_potential_harmonic(o->spring);
        break;
    case FVI_POTENTIAL_DUFFING:
        s.potential = fvi_potential_duffing(o->spring);
        break;
    case FVI_POTENTIAL_PENDULUM:
        s.potential = fvi_potential_pendulum(o->spring);
        break;
    case FVI_POTENTIAL_CHAIN:
        s.potential = fvi_potential_chain(o->spring);
        break;
    case FVI_POTENTIAL_EXPRESSION:
        s.potential = fvi_potential_expression(o->expression);
        break;
    case FVI_POTENTIAL_SHARED:
        s.potential = o->user;
        break;
    case FVI_POTENTIAL_FREE:
        break;
    }
    if (o->forces)
        s.force = fvi_forces_force(o->forces);
    else if (o->force == FVI_FORCING_STEP)
        s.force = fvi_force_step(o->forcing);
    else if (o->force == FVI_FORCING_COSINE)
        s.force = fvi_force_cosine(o->forcing);
    return s;
}

fvi_run fvi_options_run(const fvi_options *o, const fvi_system *system)
{
    return (fvi_run){ .system = system,
                      .x0 = o->x0,
                      .p0 = o->p0,
                      .h = o->h,
                      .steps = o->steps,
                      .kappa = o->kappa,
                      .alpha = o->alpha,
                      .past = o->past,
                      .memory = o->memory,
                      .tolerance = o->tolerance,
                      .step_error = o->step_error,
                      .longest = o->longest,
                      .most_steps = o->most_steps,
                      .law = o->text[DAMPING] ? &o->laws.law : NULL };
}
