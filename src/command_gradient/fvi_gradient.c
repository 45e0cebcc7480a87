/* src/command_gradient/fvi_gradient.c -- Run the command `fvi gradient`: compute derivatives of a number of the last
 * row. */
#include "fvi_gradient.h"

#include "fvi_gradient_answer.h"
#include "fvi_gradient_complaint.h"
#include "fvi_gradient_dampers.h"
#include "fvi_gradient_forces.h"
#include "fvi_gradient_choice.h"
#include "command_shared/fvi_run_warn.h"
#include "options/fvi_checks.h"
#include "output/fvi_complain.h"
#include "output/fvi_output.h"
#include "output/fvi_table.h"
#include "input/fvi_files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
/* Options of `fvi run` that its derivatives do not use. */
static const char *const not_for_gradient[] = {
    "error",      "columns",  "reduce",   "every",    "format", "plot",
    "checkpoint", "continue", "unknowns", "snapshot", "event",  NULL
};

static const fvi_own_command gradient = {
    .name = "gradient",
    .own = { "of", "by", "forces" },
    .without = not_for_gradient,
    .no_events = "no derivative goes through an event; a change of the time of an impact is a jump of x, "
                 "to which a memory answers without bound"
};

typedef fvi_gradient_request request;

/* ---- words ---- */

/* Read --of: x, p, energy; x:2, p:2; d1.force. */
static int interpret_of(request *r, fvi_error *c)
{
    static const char *const known[] = { "x", "p", "energy", NULL };
    if (!r->words.own[OF])
        r->words.own[OF] = r->system.matrices ? "x:1"
                           : r->o.d > 1       ? "energy"
                                              : "x";
    const char *text = r->words.own[OF], *colon = strchr(text, ':');
    if (fvi_gradient_is_of_damper(text))
        return fvi_gradient_find_damper(r, c);
    char word[64] = "";
    snprintf(word, sizeof word, "%.*s", (int)strcspn(text, ":"), text);
    if (colon && fvi_gradient_is_of_damper(word))
        return fvi_refuse(c, "of", "'%s' has a colon too many: it is %s%s", text, word, colon + 1);
    if (fvi_parse_word("of", word, known, &r->of, c))
        return 2;
    if (!colon && r->of < 2 && r->o.d > 1)
        return fvi_refuse(c, "of", "'%s' of which mass? %s:1 to %s:%zu", text, word, word, r->o.d);
    if (colon && r->of == 2)
        return fvi_refuse(c, "of", "'%s': there is one energy", text);
    int status = colon ? fvi_parse_whole("of", colon + 1, r->o.d, &r->i, c) : 0;
    r->i -= colon != NULL;
    return status;
}

/* Refuse fvi-stable with a coordinate without inertia, because it smooths the positions of such a coordinate. */
static int check_masses(const request *r, fvi_error *c)
{
    for (size_t i = 0; r->o.mass && !r->o.directory && i < r->o.d; i++)
        if (r->o.mass[i] == 0 && r->o.method->scheme == FVI_SCHEME_CQ2_MIDPOINT)
            return fvi_refuse(c, "method", "'%s' has no gradient with a mass of 0; fvi-lobatto2d to 8d have",
                              r->o.method->name);
    return 0;
}

/* Refuse dampers of a folder with which the method has no gradient. */
static int check_dampers(const request *r, fvi_error *c)
{
    const fvi_scheme scheme = r->o.method->scheme;
    if (!r->o.text[DAMPER] || !r->o.directory)
        return 0;
    const fvi_mechanism *of = r->system.mechanism;
    for (size_t j = 0; j < of->damper_count; j++) {
        const fvi_kernel *kernel = of->damper[j].kernel;
        const int is_power = kernel->count == 1 && kernel->term->kind == FVI_KERNEL_POWER,
                  is_rl = of->damper[j].past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
        if ((scheme == FVI_SCHEME_CQ2_SHIFTED && !is_power) || (scheme == FVI_SCHEME_FVI && is_rl))
            return fvi_refuse(c, "method", "'%s' has no gradient with the damper '%s'; fvi-bdf2 and fvi-stable have",
                              r->o.method->name, r->o.list[0].value[j]);
        if (is_rl && !(is_power && kernel->term->alpha <= 0.5))
            return fvi_refuse(c, "damper", "'%s' has no gradient: of the starts that "
                              "stretch it none is known; held has one",
                              r->o.list[0].value[j]);
    }
    return 0;
}

static int interpret(request *r, fvi_error *c)
{
    const fvi_method *m = r->o.method;
    r->system = fvi_options_system(&r->o);
    r->run = fvi_options_run(&r->o, &r->system);
    r->terms = r->run.law ? r->run.law->count : 0;
    if (m->scheme == FVI_SCHEME_CLASSICAL)
        return fvi_refuse(c, "method", "'%s' has no gradient; fvi, fvi-shifted, fvi-bdf2, fvi-stable, fvi-lobatto2 "
                          "to 8d and fvi-adaptive have", m->name);
    if (r->terms && m->scheme == FVI_SCHEME_CQ2_SHIFTED)
        return fvi_refuse(c, "method", "'%s' has no gradient with --damping; fvi, fvi-bdf2, fvi-stable, fvi-lobatto2 "
                          "to 8d and fvi-adaptive have", m->name);
    const int unknown = check_masses(r, c) || check_dampers(r, c) ? 2 : 0;
    if (unknown)
        return unknown;
    for (size_t j = 0; j < r->o.lets.count; j++)
        if (m->scheme == FVI_SCHEME_VARIABLE_STEP && r->o.lets.used[j] & FVI_USED_BY_FORCE)
            return fvi_refuse(c, "let", "'%s' has no gradient with %s, which asks for the force between the rows",
                              r->o.lets.name[j], m->name);
    r->per = m->stages ? (size_t)m->stages - 1 : 1;
    int status = fvi_check_second_file("forces", r->words.own[FORCES], r->o.output, c);
    if (!status)
        status = fvi_check_output("--forces", r->words.own[FORCES], c);
    return status ? status : interpret_of(r, c);
}

/* ---- derivatives ---- */

static double last_time(const request *r)
{
    return (double)r->o.steps * r->o.h;
}

/* Compute the derivatives of E = v . L_v - L: by p it is v, and by x it is -L_x. */
static int slopes_of_energy(request *r, const double *x, const double *p, double *Jx, double *Jp)
{
    const fvi_lagrangian *L = fvi_gradient_lagrangian(r);
    const double t = last_time(r);
    int status = fvi_energy_at(&r->system, t, x, p, &r->value);
    if (!status)
        status = fvi_velocity_of_momentum(&r->system, t, x, p, Jp);
    if (!status)
        status = L->at(t, r->o.d, x, Jp, L->params, NULL, Jx, NULL, NULL, NULL, NULL);
    for (size_t i = 0; i < r->o.d; i++)
        Jx[i] = -Jx[i];
    return status;
}

/* Add the derivatives of E by the parameters of L. At a given x and p, E decreases by as much as L increases. */
static int add_energy_of_lagrangian(request *r, const double *x, const double *p)
{
    const size_t d = r->o.d;
    double *v = calloc(3 * d, sizeof *v);
    int status = v ? fvi_velocity_of_momentum(&r->system, last_time(r), x, p, v) : FVI_ENOMEM;
    for (size_t j = 0; r->to.parameters && !status && j < r->to.sensitivity.count; j++) {
        double value;
        status = fvi_typed_lagrangian_by_parameter(j, last_time(r), d, x, v,
                                                   fvi_gradient_lagrangian(r)->params, &value,
                                                   v + d, v + 2 * d);
        r->to.parameters[j] -= value;
    }
    free(v);
    return status;
}

/* Write the derivatives of the objective at row k. fvi_adjoint calls this function for the last row first. There it
 * also keeps the row and the value of the objective. */
static int slopes(size_t k, size_t d, const double *x, const double *p,
                  void *params, double *Jx, double *Jp)
{
    request *r = params;
    fvi_progress(r->o.steps - k, r->o.steps);
    if (!p || r->of > 2)
        return 0;
    if (r->of < 2) {
        r->value = (r->of ? p : x)[r->i];
        (r->of ? Jp : Jx)[r->i] = 1;
        return 0;
    }
    memcpy(r->last, x, d * sizeof *x);
    memcpy(r->last + d, p, d * sizeof *p);
    if (fvi_gradient_lagrangian(r))
        return slopes_of_energy(r, x, p, Jx, Jp);
    int status = fvi_energy(&r->system, x, p, &r->value);
    if (status)
        return status;
    const int has_masses = r->system.mechanism && !r->system.matrices;
    for (size_t i = 0; has_masses && i < d; i++) /* without inertia p does not count */
        Jp[i] = r->o.mass[i] > 0 ? p[i] / r->o.mass[i] : 0;
    if (!has_masses)
        status = fvi_velocity(&r->system, p, Jp);
    return status ? status : fvi_potential_gradient(&r->system, x, Jx);
}

/* Compute dU/dtheta_j at x. A built-in potential U is linear in its parameters. */
static int energy_by(const request *r, size_t j, const double *x, double *value)
{
    if (r->o.potential.expression) {
        fvi_expression_parameter_gradient(r->o.potential.expression, j, x, value, NULL);
        return 0;
    }
    const double unit[2] = { j == 0, j == 1 };
    fvi_system system = r->system;
    system.potential.params = (void *)unit;
    return fvi_potential_value(&system, x, value);
}

/* Add the derivatives of E by a factor of M, -p^T M^-1 p / 2, and by a factor of K, x^T K x / 2. The part of M is E
 * minus the energy of the same x with p = 0. */
static int add_energy_of_matrices(request *r, const double *x)
{
    const size_t d = r->o.d;
    double still = 0, *none = calloc(d, sizeof *none);
    if (!none)
        return FVI_ENOMEM;
    const int status = fvi_energy(&r->system, x, none, &still);
    if (r->to.mass)
        *r->to.mass -= r->value - still;
    if (r->to.parameters)
        *r->to.parameters += still;
    free(none);
    return status;
}

/* Add the derivatives of the last energy by masses and parameters at fixed x_N and p_N. */
static int add_energy(request *r, const double *x, const double *p)
{
    if (r->system.matrices)
        return add_energy_of_matrices(r, x);
    if (fvi_gradient_lagrangian(r))
        return add_energy_of_lagrangian(r, x, p);
    for (size_t i = 0; r->to.mass && i < r->o.d; i++) {
        const double v = r->o.mass[i] > 0 ? p[i] / r->o.mass[i] : 0;
        r->to.mass[i] -= v * v / 2;
    }
    int status = 0;
    for (size_t j = 0; r->to.parameters && j < r->to.sensitivity.count && !status; j++) {
        double value = 0;
        status = energy_by(r, j, x, &value);
        r->to.parameters[j] += value;
    }
    return status;
}

/* Add the derivatives by a --let in dampers, constraints and forces of velocity. */
static void add_names(request *r)
{
    for (size_t j = 0; r->to.names && j < r->columns.count; j++) {
        r->is_tied[j] = isnan(r->names[j]);
        r->lets[j] += r->is_tied[j] ? 0 : r->names[j];
    }
}

/* Return nonzero if the answer is finite. What an energy and forces add may overflow where the part of the adjoint does
 * not. With the past of Riemann and Liouville a NaN means that there is no derivative by x0. */
static int are_finite(const request *r)
{
    const size_t d = r->o.d, end = fvi_gradient_numbers(r);
    const fvi_mechanism *m = r->system.mechanism;
    const int by_p0 = r->o.method->scheme != FVI_SCHEME_VARIABLE_STEP || !r->terms;
    int by_x0 = r->run.past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    for (size_t j = 0; m && j < m->damper_count; j++)
        by_x0 &= m->damper[j].past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    return isfinite(r->value) && fvi_all_finite(end - 2 * d, r->numbers + 2 * d)
           && (!by_x0 || fvi_all_finite(d, r->numbers))
           && (!by_p0 || fvi_all_finite(d, r->numbers + d));
}

/* Make the run, keep all its rows, and go back. Return 0, or 1 after a message. */
static int differentiate(request *r)
{
    const fvi_objective objective = { .slopes = slopes, .params = r };
    const size_t d = r->o.d;
    r->last = calloc(2 * d, sizeof *r->last);
    fvi_gradient_note_reasons(1);
    int status = !r->last  ? FVI_ENOMEM
                 : r->of > 2 ? fvi_gradient_of_damper(r, &objective)
                             : fvi_adjoint(r->o.method, &r->run, NULL, NULL,
                                        &objective, &r->to);
    fvi_gradient_note_reasons(0);
    fvi_progress_clear();
    if (!status)
        fvi_gradient_name_pairs(r);
    if (!status)
        fvi_gradient_add_forces(r);
    if (!status)
        add_names(r);
    if (!status)
        status = fvi_gradient_add_ground(r);
    if (!status && r->of == 2)
        status = add_energy(r, r->last, r->last + d);
    free(r->last);
    if (!status && !are_finite(r))
        status = FVI_EOVRFLW;
    return status ? fvi_gradient_complain(r, status) : 0;
}

/* ---- the command ---- */

static int compute_answer(request *r)
{
    fvi_error error;
    r->by_lets = 1;
    int failed = fvi_gradient_make_room(r);
    if (!failed && fvi_gradient_choose(r, &error))
        failed = fvi_refused(&error, gradient.name);
    if (!failed)
        failed = fvi_gradient_make_room_of_forces(r);
    if (!failed)
        failed = fvi_run_warn(&r->o, &r->run, sizeof r->unstable, r->unstable);
    if (!failed)
        failed = differentiate(r);
    if (!failed && fvi_gradient_check_answer(r, &error))
        failed = fvi_refused(&error, gradient.name);
    if (!failed)
        failed = fvi_gradient_print_answer(&gradient, r);
    if (!failed)
        failed = fvi_gradient_print_forces(&gradient, r);
    free(r->numbers);
    free(r->force);
    return failed;
}

int fvi_command_gradient(int argc, char **argv)
{
    fvi_error error, *c = &error;
    request r = { .i = 0 };
    int status = fvi_subcommand_options_parse(&gradient, argc, argv, &r.words, &r.o, c);
    if (!status)
        status = interpret(&r, c);
    if (!status)
        status = fvi_check_forces(&r.o, r.o.steps, c);
    status = status ? fvi_refused(&error, gradient.name) : compute_answer(&r);
    fvi_options_free(&r.o);
    return status;
}
