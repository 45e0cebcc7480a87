/* src/variable_step/variable_step_start.c -- Begin a run with variable steps. [H 22] */
#include "variable_step_events.h"
#include "variable_structure.h"

#include "kernel/kernel_general.h"
#include "system/fail.h"
#include "system/larger.h"
#include "system/quadratic.h"
#include "system/stiffness.h"

#include <stdlib.h>
#include <string.h>

/* Return about how far a body of mass m moves in the time T if its velocity is larger by 1. Without forces this is T.
 * With a damping alone it is at most about (m/rho) t^{2 alpha - 1} / Gamma(2 alpha), which falls after the time
 * (m/rho)^{1/(2 - 2 alpha)} if alpha < 1/2. With a spring alone it is sqrt(m/c); twice this leaves room for a spring
 * that is softer elsewhere. */
static double find_compliance(double m, double rho, double c, double alpha, double T)
{
    double compliance = T;
    if (rho > 0 && alpha < 1)
        compliance = smaller(compliance, alpha > 0.5 ? m / rho * pow(T, 2 * alpha - 1)
                                           : pow(m / rho, 1 / (2 - 2 * alpha)));
    return c > 0 ? fmin(compliance, 2 * sqrt(m / c)) : compliance;
}

/* Form the groups: a new group begins where the mass, damping or spring differs from the coordinate before. Return the
 * number of groups. Fill o->group_of and o->group only if they are allocated. springs: one number for each coordinate,
 * or NULL. */
static size_t group_coordinates(const fvi_stepper *s, const double *springs,
                                fvi_variable_step_state *o)
{
    const fvi_system *system = s->run.system;
    const int heavier = s->run.alpha == 1;
    double mass = 0, damping = 0, spring = 0, last_group_spring = 0, compliance = 0;
    size_t n = 0;
    for (size_t j = 0; j < system->d; j++) {
        const double rho = system->damping[j],
                     m = system->mass[j] + (heavier ? rho : 0),
                     c = springs ? springs[j] : 0,
                     group_spring = o->solve == FVI_SOLVE_LINEAR ? c : 0;
        const int same = j > 0 && m == mass && rho == damping;
        if (o->group_of && !(same && c == spring))
            compliance = find_compliance(m, rho, c, s->run.alpha, o->T);
        n += !(same && group_spring == last_group_spring);
        mass = m;
        damping = rho;
        spring = c;
        last_group_spring = group_spring;
        if (o->group_of) {
            fvi_coordinate_group *group = &o->group[o->group_of[j] = n - 1];
            group->mass = m;
            group->damping = rho;
            group->spring = group_spring;
            group->compliance = larger(group->compliance, compliance);
        }
    }
    return n;
}

/* Choose o->solve. If the Hessian of U is diagonal, write it at x0 to *springs, an array to be freed. */
static int find_springs(fvi_stepper *s, fvi_variable_step_state *o, double **springs)
{
    const fvi_potential *u = &s->run.system->potential;
    const int diagonal = u->diagonals == 1 || o->d == 1;
    const int quadratic = fvi_potential_is_quadratic(u);
    o->solve = !u->gradient || (diagonal && quadratic) ? FVI_SOLVE_LINEAR
               : diagonal                              ? FVI_SOLVE_DIAGONAL
                                                       : FVI_SOLVE_COUPLED;
    if (o->solve == FVI_SOLVE_COUPLED || !u->gradient)
        return FVI_SUCCESS;
    *springs = malloc(fvi_potential_hessian_size(s->run.system) * sizeof **springs);
    if (!*springs)
        FVI_FAIL("no memory for the springs", FVI_ENOMEM);
    return u->hessian(o->d, s->x, u->params, *springs);
}

/* Compute 2/omega of the stiffest spring at x0, as a part of the time h between two rows, at most 1. The coordinates
 * may be coupled. */
static int find_shortest_part(const fvi_stepper *s, double *part)
{
    double stiffness = 0;
    const int status = fvi_potential_stiffness(s->run.system, s->x, &stiffness);
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the springs", FVI_ENOMEM);
    if (!status)
        *part = fmin(1, 2 / sqrt(stiffness) / s->run.h);
    return status;
}

/* Return size, or `next` if size is 0 or only a rounding error of `next`. */
static double size_or_next(double size, double next)
{
    return size > 1e-12 * next ? size : next;
}

double fvi_variable_step_scale(double x, double of_v, double of_a)
{
    const double size = size_or_next(x, size_or_next(of_v, of_a));
    return size > 0 && isfinite(size) ? size : 1;
}

/* Compute the size of the motion for a tolerance that is relative: |x0|; or the distance that the body moves between
 * two rows, or until its spring stops it; or 1. springs: as for group_coordinates. */
static int find_first_scale(fvi_stepper *s, const double *springs, double *scale)
{
    const fvi_system *system = s->run.system;
    const fvi_force *force = &system->force;
    double x = 0, of_v = 0, of_f = 0;
    int status = fvi_potential_gradient(system, s->x, s->g);
    if (!status)
        status = fvi_step_force(s, 0, s->F);
    for (size_t j = 0; !status && j < system->d; j++) {
        const double m = system->mass[j],
                     t = find_compliance(m, 0, springs ? springs[j] : 0, 0, s->run.h);
        double p = fabs(s->p[j]);
        for (size_t i = 0; i < force->impulse_count; i++)
            p = larger(p, fabs(force->impulses[i].J[j]));
        x = larger(x, fabs(s->x[j]));
        of_v = larger(of_v, p / m * t);
        of_f = larger(of_f, fabs(s->F[j] - s->g[j]) / m * t * t);
    }
    double size = size_or_next(x, size_or_next(of_v, of_f)), part = 1;
    if (!status && x > 0 && size != x && !springs && system->potential.gradient)
        status = find_shortest_part(s, &part);
    if (part < 1 && x > 1e-12 * fmax(of_v * part, of_f * part * part))
        size = x;
    *scale = size > 0 ? size : 1;
    return status;
}

/* With fewer digits of a step, the modes need fewer digits, too. But a step's error is absolute, and the error of the
 * modes is a part of the motion. The start cannot tell how large a force will make the motion, because a pulse may come
 * later. So with a force the modes are fine. */
static fvi_modes_kind kind_of_modes(const fvi_run *run, double tolerance)
{
    const fvi_force *force = &run->system->force;
    const int may_grow = (force->value || force->impulse_count) && run->tolerance != FVI_MODES_BY_TOLERANCE;
    return may_grow || run->tolerance == FVI_FINE_MODES ? FVI_MODES_FINE
           : tolerance > 10 * FVI_TOLERANCE_LOOSE ? FVI_MODES_COARSE
           : tolerance > FVI_TOLERANCE_LOOSE / 10 ? FVI_MODES_MEDIUM
                                                  : FVI_MODES_FINE;
}

static int is_damped(const fvi_system *system)
{
    int damped = system->mechanism || system->matrices; /* these have form D */
    for (size_t j = 0; j < system->d && !damped; j++)
        damped |= system->damping[j] > 0;
    return damped;
}

/* Refuse a caller's tolerance that rounding errors hide, and do not replace it by another one. */
static int check_tolerance(fvi_stepper *s, double scale)
{
    const fvi_run *run = &s->run;
    const double least = FVI_TOLERANCE_LEAST * scale;
    const int is_callers = run->tolerance != FVI_FINE_MODES && run->tolerance != FVI_MODES_BY_TOLERANCE
                           && run->tolerance != FVI_ANY_TOLERANCE;
    if (!is_callers || run->step_error == 0 || run->step_error >= least)
        return FVI_SUCCESS;
    return fvi_fail(s->error, FVI_ETOL, "step_error", run->step_error,
                    "%g is hidden by rounding; it must be at least 1e-17 of the size of the motion at first, %g",
                    run->step_error, least);
}

/* Set what does not depend on the arrays of the state: form, stages, tolerance, and lengths of steps. */
static void choose_rule(fvi_stepper *s, fvi_variable_step_state *o, double scale)
{
    const fvi_run *run = &s->run;
    const double L = fvi_variable_spacing(), T = run->h * (double)run->steps,
                 tolerance = run->step_error > 0
                            ? fmax(run->step_error / scale, FVI_TOLERANCE_LEAST)
                            : 1e-10;
    const int damped = is_damped(run->system);
    o->rule = fvi_variable(tolerance > 1e-3 ? 6 : 8);
    o->tolerance = tolerance;
    o->modes_kind = kind_of_modes(run, tolerance);
    o->beta = 2 * run->alpha - 1;
    o->to_x = damped ? &o->rule->A : &o->rule->form_m;
    o->counts.stages = (int)o->rule->s;
    o->counts.form = damped ? 'D' : 'M';
    o->diagonals =
        o->solve == FVI_SOLVE_COUPLED ? run->system->potential.diagonals : 1;
    const int each = o->solve == FVI_SOLVE_DIAGONAL && tolerance > FVI_TOLERANCE_VERY_LOOSE;
    if (run->system->mechanism || run->system->matrices || !damped || each || o->kernel || o->diagonals > o->rule->s)
        o->diagonals = 0; /* form M and a law have other matrices; steps are too long for one Hessian; hessian has room
                             for s diagonals */
    o->scale = scale;
    o->T = T;
    o->least = 1e-14 * T;
    o->growth = FVI_VARIABLE_STEP_GROWTH;
    o->first_exponent = (int)floor(log(0.1 * pow(fmin(tolerance, 1), 0.4) * T) / L);
    o->longest_exponent = o->longest_solvable =
        run->longest > 0 ? (int)floor(log(fmin(run->longest, T)) / L)
                         : (int)ceil(log(T) / L);
    o->first_exponent = (int)smaller(o->first_exponent, o->longest_exponent);
    o->first_after_event = 1;
}

int fvi_variable_step_explain_modes(const fvi_stepper *s, const fvi_variable_step_state *o, int status)
{
    return status == FVI_EDOM
               ? fvi_fail(s->error, status, "T", o->T,
                          "%g is too short: the %s would be above 1.8e308", o->T,
                          isfinite(1e6 / o->least) ? "weights of its memory, times their decay rates,"
                                                   : "fastest decay rate of its memory")
               : status;
}

/* Allocate the modes of a law. */
static int begin_kernel(fvi_stepper *s, fvi_variable_step_state *o)
{
    const int status = fvi_variable_step_explain_modes(
        s, o, fvi_variable_step_begin_kernel(o, o->kernel, o->damped, &o->modes, &o->rising));
    return status == FVI_EUNSUP
               ? fvi_fail(s->error, status, NULL, NAN, "%s of this law is too near to its cut, or off it, for "
                          "fvi-adaptive; %sfvi-bdf2 and fvi-stable take it", fvi_kernel_singularity(s->run.law),
                          s->run.event_count ? "without events " : "")
               : status;
}

/* Prepare the singular start, and allocate the modes if the damping has a memory. */
static int begin_memory(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_system *system = s->run.system;
    for (size_t j = 0; j < o->d; j++)
        if (system->damping[j] > 0)
            o->index[o->damped++] = j;
    if (o->kernel)
        return o->damped ? begin_kernel(s, o) : FVI_SUCCESS;
    fvi_variable_present(o->rule, o->beta, &o->W0);
    const double ones[FVI_LANES] = { 1, 1, 1, 1, 1, 1, 1, 1 };
    fvi_square_apply(o->rule->s, &o->W0, ones, o->W1);
    o->memory_leakage = fvi_memory_leakage(o->rule, &o->W0);
    int status = fvi_singular_start(s, o);
    if (status || o->damped == 0 || fabs(o->beta) == 1 || o->beta == 0)
        return status;
    if (o->singular.J)
        o->least = smaller(o->least, o->singular.t1 / 16);
    if (fvi_variable_step_velocities_jump(&s->run) && o->beta > 0) /* x'' is like h^-beta */
        o->least = smaller(
            o->least, o->T * pow(1e-4 * fmin(o->tolerance, 1), 1 / (1 - o->beta)));
    if (o->least < FVI_SHORTEST / 16 * o->T)
        return fvi_fail(s->error, FVI_EUNSUP, NULL, NAN,
                        "no step is short enough for a velocity that jumps: alpha is too near to 1");
    o->counts.memory = o->modes_kind == FVI_MODES_COARSE   ? 1e-7
                       : o->modes_kind == FVI_MODES_MEDIUM ? 3e-10
                                                           : 0;
    status = fvi_modes_alloc(o->rule, o->modes_kind, o->beta, o->damped, o->T, o->least, &o->modes);
    return fvi_variable_step_explain_modes(s, o, status);
}

/* Prepare a law. Refuse a velocity that jumps if a term of the law grows faster than s, because x'' would be infinite.
 * The nominal alpha of a law, for guesses of lengths, is that of fvi_run_normal. */
static int begin_law(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_system *system = s->run.system;
    if (!s->run.law)
        return FVI_SUCCESS;
    int jumps = fvi_variable_step_velocities_jump(&s->run);
    for (size_t j = 0; j < system->d; j++)
        jumps |= system->damping[j] > 0 && s->p[j] != 0;
    if (jumps && fvi_kernel_growth(s->run.law) > 1)
        return fvi_fail(s->error, FVI_EUNSUP, "p0", NAN, "fvi-adaptive takes no velocity that jumps with a law that "
                        "grows faster than s; fvi-bdf2 and fvi-stable do, and fvi-adaptive if the law is that of a "
                        "damper on each coordinate");
    return fvi_variable_step_prepare_kernel(s->run.law, &o->kernel);
}

/* Set the first exponent: as short as the start needs, but not shorter than `least`. */
static void set_first_exponent(fvi_variable_step_state *o)
{
    o->shortest_exponent = (int)floor(log(o->least) / fvi_variable_spacing());
    o->first_exponent = (int)larger(o->first_exponent, o->shortest_exponent);
    o->next_exponent = o->first_exponent;
}

/* Prepare a run of a mechanism or of matrices: state, dampers, and the modes that the shortest step needs. */
static int begin_coupled(fvi_stepper *s, fvi_variable_step_state *o)
{
    const int has_matrices = s->run.system->matrices != NULL;
    double scale;
    o->groups = has_matrices ? 1 : o->d;
    o->solve = FVI_SOLVE_TOGETHER;
    int status = has_matrices ? fvi_structure_mesh_scale(s, &scale) : fvi_mesh_scale(s, &scale);
    if (!status)
        status = check_tolerance(s, scale);
    if (status)
        return status;
    choose_rule(s, o, scale);
    status = has_matrices ? fvi_structure_mesh_start(s, o) : fvi_mesh_start(s, o);
    if (!status)
        status = fvi_variable_step_allocate(o);
    if (status)
        return status;
    o->least = smaller(o->least, o->T * (has_matrices ? fvi_structure_mesh_shortest(s, o) : fvi_mesh_shortest(s, o)));
    if (o->least < FVI_SHORTEST / 16 * o->T)
        return fvi_fail(s->error, FVI_EUNSUP, "damper", NAN, "no step is short enough for this error: an order is "
                        "too near to 2 behind a velocity that jumps, or to 0 at a coordinate without mass");
    return has_matrices ? fvi_structure_mesh_begin(s, o) : fvi_mesh_begin(s, o);
}

/* Prepare a run of a system with masses: state, groups, and the memory of its damping. */
static int begin_chain(fvi_stepper *s, fvi_variable_step_state *o)
{
    const size_t d = o->d;
    double scale, *springs = NULL;
    int status = begin_law(s, o);
    if (!status)
        status = find_springs(s, o, &springs);
    if (!status)
        status = find_first_scale(s, springs, &scale);
    if (!status)
        status = check_tolerance(s, scale);
    if (!status) {
        choose_rule(s, o, scale);
        o->groups = group_coordinates(s, springs, o);
        if (o->solve == FVI_SOLVE_LINEAR && o->groups < d)
            o->diagonals = 0; /* many coordinates share an inverse, which is faster */
        status = fvi_variable_step_allocate(o);
    }
    if (!status) {
        group_coordinates(s, springs, o);
        status = begin_memory(s, o);
    }
    free(springs);
    for (size_t j = 0; j < d && !status; j++) {
        const double m = s->run.system->mass[j];
        const int start_jumps = s->run.alpha == 1 && s->run.past != FVI_INITIAL_HISTORY_CAPUTO;
        o->y[j] = s->x[j];
        o->v[j] =
            s->p[j] / (start_jumps ? o->group[o->group_of[j]].mass : m); /* (19.5) */
        if (o->singular.J && o->singular.e == 1
            && s->run.system->damping[j] > 0)
            o->v[j] = o->singular.c[j * (o->singular.J + 1)];
        o->centre[j] = s->run.past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE ? 0 : s->x[j];
    }
    return status;
}

static int start(fvi_stepper *s, int for_adjoint)
{
    const fvi_matrices *m = s->run.system->matrices;
    fvi_variable_step_state *o = s->method_state = calloc(1, sizeof *o);
    if (!o)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    o->d = s->run.system->d;
    o->for_adjoint = for_adjoint;
    int status = m || s->run.system->mechanism ? begin_coupled(s, o) : begin_chain(s, o);
    if (!status)
        status = fvi_variable_step_find_events(s, o);
    if (!status)
        status = fvi_variable_step_begin_events(&s->run, o);
    if (!status)
        status = fvi_variable_step_apply_impulses(s, o);
    if (!status && m)
        status = m->inertia(o->d, o->v, m->params, s->p);
    for (size_t j = 0; j < o->d && !status && !m && !o->mechanism; j++)
        s->p[j] += s->run.system->mass[j] * o->impulse_dv[j];
    if (!status)
        set_first_exponent(o);
    return status;
}

int fvi_variable_step_start(fvi_stepper *s)
{
    int status = start(s, 0);
    if (!status)
        status = fvi_variable_step_check_walls(s, s->method_state);
    return status ? status : fvi_variable_step_start_contacts(s, s->method_state);
}

int fvi_variable_step_start_for_adjoint(fvi_stepper *s)
{
    return start(s, 1);
}
