/* src/options/fvi_problem.c -- Build the system from the options. */
#define _GNU_SOURCE /* for PATH_MAX */
#include "fvi_problem.h"
#include "fvi_mechanism_options.h"
#include "input/fvi_files.h"
#include "input/fvi_shared.h"

#include <fvi/error.h>
#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Read x0, p0, mass and rho: one value for all masses, or a list. */
int fvi_problem_lists(fvi_options *o, fvi_error *c)
{
    o->x0 = malloc(4 * o->d * sizeof *o->x0);
    if (!o->x0)
        return fvi_fail(c, FVI_ENOMEM, NULL, NAN, "no memory for the start");
    o->p0 = o->x0 + o->d;
    o->mass = o->p0 + o->d;
    o->rho = o->mass + o->d;
    const struct {
        option_index option;
        double *values, low;
        const char *brackets;
    } lists[] = { { RHO, o->rho, 0, "[)" },
                  { MASS, o->mass, 0,
                    o->command == FVI_COMMAND_RUN ? "[)" : "()" },
                  { X0, o->x0, -INFINITY, "()" },
                  { P0, o->p0, -INFINITY, "()" } };
    int status = 0;
    const size_t own = o->directory ? 2 : 0; /* a folder has its own masses and dampings */
    if (o->directory) {
        const fvi_system s = fvi_directory_system(o->directory);
        memcpy(o->mass, s.mass, o->d * sizeof *o->mass);
        memcpy(o->rho, s.damping, o->d * sizeof *o->rho);
    }
    for (size_t i = own; !status && i < sizeof lists / sizeof *lists; i++) {
        const char *text = o->text[lists[i].option];
        if (!text && lists[i].option == RHO && (o->text[LAGRANGIAN] || o->text[DAMPER]))
            text = "0";
        status = fvi_read_numbers(fvi_option_list[lists[i].option].name,
                                  text ? text : "1", /* rho has no text with a law, nor mass with a Lagrangian */
                                  lists[i].low, INFINITY, lists[i].brackets,
                                  o->d, lists[i].values, c);
    }
    return status;
}

/* Mark the files of a folder as read, so that no output replaces them. Marked are also the files that would be read if
 * they existed. */
static void mark_directory(const fvi_options *o)
{
    char path[2 * PATH_MAX];
    const char *file;
    for (size_t i = 0; (file = fvi_directory_file(o->directory, i)); i++) {
        snprintf(path, sizeof path, "%s/%s", o->text[SYSTEM], file);
        fvi_mark_read("system", path);
    }
}

/* Refuse a law without C.mtx, because nothing is damped then and the law would have no effect. */
static int check_damping(const fvi_options *o, fvi_error *c)
{
    static const option_index laws[] = { ALPHA, ORDER, DAMPING };
    char path[2 * PATH_MAX];
    snprintf(path, sizeof path, "%s/C.mtx", o->text[SYSTEM]);
    if (o->text[DAMPER] || access(path, F_OK) == 0)
        return 0;
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++)
        if (o->text[laws[i]] && o->text[laws[i]] != fvi_option_list[laws[i]].preset)
            return fvi_refuse(c, fvi_option_list[laws[i]].name, "'%s' damps nothing: there is no C.mtx in %s",
                              o->text[laws[i]], o->text[SYSTEM]);
    return 0;
}

static int read_system(fvi_options *o, fvi_error *c)
{
    const fvi_option_values *dampers = fvi_dampers_typed(o);
    if (!*o->text[SYSTEM]) /* otherwise the folder would be / */
        return fvi_refuse(c, "system", "'' is not a folder's name");
    const int status =
        fvi_directory_open_dampers(o->text[SYSTEM], dampers->count, dampers->value,
                                   &o->lets, &o->directory, c);
    if (status)
        return status;
    if (check_damping(o, c))
        return FVI_EINVAL;
    mark_directory(o);
    o->d = fvi_directory_system(o->directory).d;
    o->potential.kind = FVI_POTENTIAL_FREE;
    o->numbered = 1;
    return 0;
}

/* Find the number of masses, and the potential. */
int fvi_problem_potential(fvi_options *o, fvi_error *c)
{
    int status = 0;
    size_t d = 0;
    if (o->text[LET])
        status = fvi_parse_user_parameters(o->text[LET], &o->lets, c);
    if (!status && o->text[SYSTEM])
        return read_system(o, c);
    if (!status && o->text[DIMENSION])
        status = fvi_parse_whole("dimension", o->text[DIMENSION], 1000000, &d,
                                 c);
    if (status)
        return status;
    if (!o->text[DIMENSION])
        d = fvi_mechanism_dimension(o);
    if (o->text[LAGRANGIAN]) {
        o->potential.kind = FVI_POTENTIAL_FREE;
    } else if (fvi_shared_name(o->text[POTENTIAL])
        && !strchr(o->text[POTENTIAL], ':')) {
        o->potential.kind = FVI_POTENTIAL_FREE; /* the library has its own potential */
        status =
            fvi_shared_open(o->text[POTENTIAL], &o->library, &o->user, c);
    } else {
        status = fvi_parse_potential(o->text[POTENTIAL], d, &o->lets,
                                     &o->potential, c);
        if (status == FVI_EINVAL && o->command == FVI_COMMAND_RUN
            && fvi_potential_in_time(o, d))
            return 0;
    }
    o->d = d                  ? d
           : o->potential.d ? o->potential.d
                            : 1;
    o->numbered = o->d > 1 || o->potential.kind == FVI_POTENTIAL_CHAIN;
    return status;
}

int fvi_problem_force(fvi_options *o, fvi_error *c)
{
    int found = 0;
    const double last = (double)o->steps * o->h;
    if (o->directory) {
        int status = fvi_directory_force(o->directory, last, &found, c);
        if (status)
            return status;
    }
    if (found && o->text[FORCE] != fvi_option_list[FORCE].preset) /* a `none` that was typed, too */
        return fvi_refuse(c, "force", "'%s': there is %s/f.tsv, too", o->text[FORCE], o->text[SYSTEM]);
    if (found) { /* the head contains the force that acts */
        o->text[FORCE] = fvi_directory_force_name(o->directory);
        return 0;
    }
    const int status = fvi_parse_force(o->text[FORCE], o->d, &o->lets, last,
                                       &o->force, c);
    const char *name;
    for (size_t i = 0; !status && (name = fvi_typed_force_file(o->force, i));
         i++)
        fvi_mark_read("force", name);
    return status;
}

/* Read --ground. Call it when the masses and the other forces are known. */
int fvi_problem_ground(fvi_options *o, fvi_error *c)
{
    if (o->text[ALONG] && !o->text[GROUND])
        return fvi_refuse(c, "along", "without --ground nothing moves along it");
    if (!o->text[GROUND])
        return 0;
    if (o->text[LAGRANGIAN])
        return fvi_refuse(c, "ground", "not together with --lagrangian, which may hold the motion itself");
    double *r = malloc(o->d * sizeof *r);
    if (!r)
        return fvi_no_memory(c, NULL);
    const char *along = o->text[ALONG] ? o->text[ALONG] : "1";
    const fvi_system system = fvi_options_system(o);
    int status = fvi_read_numbers("along", along, -INFINITY, INFINITY, "()",
                                  o->d, r, c);
    if (!status)
        status = fvi_parse_ground(o->text[GROUND], &system, r, &o->lets,
                                  (double)o->steps * o->h, &o->ground, c);
    free(r);
    const char *name;
    for (size_t i = 0;
         !status && (name = fvi_typed_force_file(fvi_ground_typed(o->ground), i));
         i++)
        fvi_mark_read("ground", name);
    return status;
}

/* Read the numbers of the unknowns, for example "3,17" of x1, ..., xd. Without --unknowns all are shown. */
int fvi_problem_unknowns(fvi_options *o, fvi_error *c)
{
    const char *text = o->text[UNKNOWNS];
    o->shown = malloc(o->d * sizeof *o->shown);
    if (!o->shown)
        return fvi_no_memory(c, NULL);
    for (; !text && o->shown_count < o->d; o->shown_count++)
        o->shown[o->shown_count] = o->shown_count;
    while (text) {
        char *stop;
        const size_t i =
            isdigit((unsigned char)*text) ? strtoul(text, &stop, 10) : 0;
        if (i < 1 || i > o->d || (*stop && *stop != ','))
            return fvi_refuse(c, "unknowns", "'%s' is not a list of numbers from 1 to %zu", o->text[UNKNOWNS], o->d);
        for (size_t k = 0; k < o->shown_count; k++)
            if (o->shown[k] == i - 1)
                return fvi_refuse(c, "unknowns", "%zu stands twice in '%s'", i, o->text[UNKNOWNS]);
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
    else
        s.potential = o->library ? o->user : fvi_potential_typed(&o->potential);
    if (o->force)
        s.force = fvi_force_typed(o->force);
    if (o->ground)
        s.force = fvi_ground_force(o->ground);
    if (o->mechanism)
        s.mechanism = fvi_mechanism_typed(o->mechanism);
    return s;
}

fvi_run fvi_options_run(const fvi_options *o, const fvi_system *system)
{
    size_t event_count;
    const fvi_event *events = fvi_events_typed(o->events, &event_count);
    return (fvi_run){ .system = system,
                      .events = events,
                      .event_count = event_count,
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
                      .law = o->text[DAMPING] && !o->mechanism
                                 ? &o->damping.law
                                 : NULL };
}
