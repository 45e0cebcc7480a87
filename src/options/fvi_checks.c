/* src/options/fvi_checks.c -- Check that the options go together, because what is asked for is done or refused. */
#include "fvi_checks.h"
#include "fvi_problem.h"

#include <fvi/fvi.h>

#include <math.h>

/* ---- what a method takes ---- */

/* Return nonzero if the velocity of a damped mass jumps: at the start, or by an impulse of the force. */
static int has_velocity_jump(const fvi_options *o)
{
    for (size_t i = 0; i < o->d; i++)
        if (o->p0[i] != 0 && o->rho[i] > 0)
            return 1;
    return o->force && fvi_force_typed(o->force).impulse_count > 0;
}

/* Refuse --memory exponentials with steps of one length if the law, or the dampers of a folder, have no sum of
 * exponentials. */
static int check_modes(const fvi_options *o, fvi_error *c)
{
    const int of_folder = o->directory && o->text[DAMPER];
    const fvi_system system =
        of_folder ? fvi_options_system(o) : (fvi_system){ .d = o->d };
    const fvi_run run = { .system = &system,
                          .law = of_folder ? NULL : &o->damping.law,
                          .h = o->h };
    int has = 1;
    if ((o->text[DAMPING] || of_folder) && o->memory == FVI_HISTORY_MODES
        && !o->method->dense && fvi_method_has_modes(o->method, &run, &has))
        return fvi_no_memory(c, NULL);
    return has ? 0
               : fvi_refuse(c, "memory",
                            "'exponentials': of --%s '%s' there are none with this step; 'auto' sums it all",
                            of_folder ? "damper" : "damping", o->text[of_folder ? DAMPER : DAMPING]);
}

int fvi_check_method(const fvi_options *o, fvi_error *c)
{
    const fvi_method *m = o->method;
    const int by_order = o->text[ORDER] != NULL;
    if (o->alpha < m->alpha_least || o->alpha > m->alpha_most)
        return fvi_refuse(c, by_order ? "order" : "alpha", "'%s' is not %g, all that %s knows",
                          o->text[by_order ? ORDER : ALPHA], (1 + by_order) * m->alpha_least, m->name);
    if (o->text[DAMPING] && !m->takes_laws)
        return fvi_refuse(c, "damping", "'%s' is not known to %s", o->text[DAMPING], m->name);
    if (o->text[DAMPING] && m->dense && !o->directory
        && fvi_kernel_growth(&o->damping.law) > 1 && has_velocity_jump(o))
        return fvi_refuse(c, "p0", "fvi-adaptive takes no velocity that jumps with a law that grows faster than s; "
                          "fvi-bdf2 and fvi-stable do, and fvi-adaptive with --damper 'x : LAW' in place of --damping");
    const int status = check_modes(o, c);
    if (status)
        return status;
    if (o->directory && !m->takes_matrices)
        return fvi_refuse(c, "method", "'%s' takes no matrices; fvi, fvi-shifted, fvi-bdf2, fvi-stable, "
                          "fvi-lobatto2d to 8d and fvi-adaptive do", m->name);
    if (o->mechanism && !m->takes_mechanism)
        return fvi_refuse(c, "method", "'%s' takes no Lagrangian, dampers between points, constraints or forces of "
                          "velocity; fvi, fvi-stable, fvi-lobatto2 to 8, 2d to 8d and fvi-adaptive do", m->name);
    if (!m->takes_kappa && o->kappa != 0.5)
        return fvi_refuse(c, "kappa", "'%s' is not for %s, which has no kappa", o->text[KAPPA], m->name);
    if (!fvi_method_takes_history(m, o->memory))
        return fvi_refuse(c, "memory", "'%s' is not known to %s", o->text[MEMORY], m->name);
    return 0;
}

/* ---- what has a solution ---- */

int fvi_is_oscillator(const fvi_options *o)
{
    const fvi_potential_kind kind = o->potential.kind;
    return o->d == 1 && !o->directory && !o->mechanism
           && kind != FVI_POTENTIAL_EXPRESSION && kind != FVI_POTENTIAL_CHAIN;
}

/* Check what the exact solution of several masses, or of a mass whose potential is an expression, needs. Whether the
 * potential is linear is not checked here: the library finds out when it computes the poles. */
int fvi_check_exact_motion(const fvi_options *o, fvi_error *c)
{
    if (o->directory && o->text[FORCE] == fvi_directory_force_name(o->directory))
        return fvi_refuse(c, "system", "%s has no exact solution here; without it, or "
                          "--force step:A,T and cosine:A,W have",
                          o->text[FORCE]);
    if (o->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
        || (o->past == FVI_INITIAL_HISTORY_CAPUTO && o->alpha > 0.5))
        return fvi_refuse(c, "derivative", fvi_is_oscillator(o)
                              ? "'%s' has no exact accelerations and forces here, only x and v; "
                                "held has"
                          : o->d > 1 ? "'%s' has no exact solution of several masses here; held has"
                                     : "'%s' has no exact solution of such a mass here; held has",
                          o->text[DERIVATIVE]);
    return 0;
}

int fvi_check_exact(const fvi_options *o, fvi_error *c)
{
    const fvi_typed_potential *u = &o->potential;
    fvi_forcing kind;
    double constants[2];
    if (!fvi_is_oscillator(o)) {
        const int status = fvi_check_exact_motion(o, c);
        if (status)
            return status;
    } else if (o->library
               || (u->kind != FVI_POTENTIAL_FREE
                   && !(u->kind == FVI_POTENTIAL_HARMONIC && u->constants[0] >= 0))) {
        return fvi_refuse(c, "potential", "'%s' has no exact solution here; harmonic:C with C >= 0 and free have",
                          o->text[POTENTIAL]);
    }
    if (!fvi_typed_force_is_simple(o->force, &kind, constants))
        return fvi_refuse(c, "force", "'%s' has no exact solution here; none, step:A,T and cosine:A,W have",
                          o->text[FORCE]);
    return 0;
}

int fvi_check_solution(fvi_options *o, fvi_error *c)
{
    const fvi_system system = fvi_options_system(o);
    const fvi_run run = fvi_options_run(o, &system);
    if (fvi_warning_of_initial_history(&run, &o->no_solution) < 0)
        return fvi_no_memory(c, NULL);
    if (!o->no_solution || (o->method && o->method->paper_convention && o->error == 0))
        return 0;
    if (system.mechanism) {
        o->no_solution = NULL; /* the start of another method says which damper it is */
        return o->method && o->method->paper_convention
                   ? fvi_refuse(c, "error", "a damper whose order is above 1 has no solution with the past rl "
                                "and an elongation that is not 0 at the start")
                   : 0;
    }
    return fvi_refuse(c, "derivative", "'rl' has no solution for %s != 0 and alpha > 1/2; take held or caputo",
                      o->directory ? "C x0" : "x0");
}

int fvi_check_impulses(const fvi_options *o, fvi_error *c)
{
    int added_mass = 0;
    for (size_t i = 0; i < o->d; i++)
        added_mass |= o->alpha == 1 && o->rho[i] > 0;
    if (added_mass && o->method && o->method->stages && o->force
        && fvi_force_typed(o->force).impulse_count)
        return fvi_refuse(c, "force", "'%s': %s takes no impulse at alpha = 1; fvi-adaptive does", o->text[FORCE],
                          o->method->name);
    return 0;
}

int fvi_check_forces(const fvi_options *o, size_t steps, fvi_error *c)
{
    int status = o->method ? fvi_check_force(o->method, o->h, steps, "force", o->text[FORCE], o->force, c) : 0;
    if (o->method && o->ground && !status)
        status = fvi_check_force(o->method, o->h, steps, "ground", o->text[GROUND], fvi_ground_typed(o->ground), c);
    return status;
}
