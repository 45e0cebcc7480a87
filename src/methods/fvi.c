/* src/methods/fvi.c -- The fractional variational integrator, Algorithm 3.               [H 9]
 *
 * A step takes one of three ways, which give the same digits:
 *
 *   step_fractional      any system
 *   step_one_coordinate  one damped coordinate with a quadratic potential
 *   step_by_parts        many damped coordinates, kappa = 1 */
#include <fvi/fvi.h>

#include "damping.h"
#include "mechanism/mechanism.h"
#include "stability_number.h"
#include "memory/history_parts.h"
#include "newton/newton_stages.h"
#include "system/vectors.h"

/* ---- the state of a method is the list of its dampers ---- */

static int start_fractional(fvi_stepper *s)
{
    fvi_damping *dampers;
    if (fvi_has_mechanism_steps(s->run.system))
        return fvi_mechanism_start(s, FVI_MECHANISM_FIRST_ORDER, 0);
    int status = fvi_variational_solver(s);
    if (status)
        return status;
    status = fvi_damping_start(s, 0, &dampers);
    s->method_state = dampers; /* also after an error, so that stop_fractional frees what was allocated */
    return status;
}

static void stop_fractional(fvi_stepper *s)
{
    fvi_damping_free(s->method_state);
}

static int copy_fractional(const fvi_stepper *from, fvi_stepper *to)
{
    fvi_damping *dampers;
    int status = fvi_damping_copy(from->method_state, &dampers);
    to->method_state = dampers; /* also after an error, as in start_fractional */
    return status;
}

static int serialize_fractional(fvi_stepper *s, fvi_archive *archive)
{
    return fvi_damping_archive(s->method_state, s->k, archive);
}

/* ---- a step of any system ---- */

//> apply-damping
/* Compute p_{k+1} -= h rho Delta_-^alpha Delta_-^alpha x_{k+1} for every damper of the list. */
static int apply_damping(fvi_stepper *s, fvi_damping *damper)
{
    int status = FVI_SUCCESS;
    for (; damper && !status; damper = damper->next) {
        double *sums = damper->z; /* the sums overwrite their newest terms */
        status = fvi_damping_set_terms(damper, s);
        if (!status)
            status = fvi_damping_update_history(damper, sums);
        fvi_damping_note_momentum(damper, s->p);
        if (!status)
            status = fvi_damping_apply_force(damper, 1, sums, s->p);
        fvi_damping_add_impulse(damper, s->p);
        fvi_damping_add_work(damper, s->run.h, s->dx);
    }
    return status;
}
//< apply-damping

//> step
static int step_fractional(fvi_stepper *s)
{
    const double h = s->run.h;
    int status = fvi_newton_solve(s->newton, s->x, s->p, s->dx, s->g);
    if (!status)
        status = fvi_force_value(s, (double)(s->k + 1) * h);
    if (status)
        return status;
#pragma omp simd
    for (size_t i = 0; i < s->run.system->d; i++) {
        s->x[i] += s->dx[i];
        s->p[i] += h * (s->F[i] - s->g[i]);
    }
    return apply_damping(s, s->method_state); /* (9.4) */
}
//< step

/* ---- a step of one coordinate ---- */

/* Return 1 if there is one coordinate, which is damped, and U is quadratic. Then the solver has one number for the
 * matrix J = A + s theta U'' of (2.11), and one for U''. */
static int is_single_equation(const fvi_stepper *s)
{
    const fvi_damping *damper = s->method_state;
    return damper && damper->covers_all && damper->count == 1 && fvi_newton_is_diagonal(s->newton);
}

/* Do the operations of step_fractional in the same order, with about half of its instructions. With one coordinate the
 * time of a step goes into instructions and not into memory, so this function has no loops. A damper has no impulse
 * sums here, because only systems with matrices keep them. */
static int step_one_coordinate(fvi_stepper *s)
{
    const fvi_damping *damper = s->method_state;
    const fvi_newton *newton = s->newton;
    const fvi_potential *potential = &s->run.system->potential;
    const double h = s->run.h, t = (double)(s->k + 1) * h;
    double gradient, sum; /* the gradient at x_k, then at x_k + theta dx; the sum of the history */
    int status = potential->gradient(1, s->x, potential->params, &gradient);
    if (!status)
        status = fvi_force_value(s, t);
    if (status)
        return status;
    const double J = *fvi_band_row(&newton->J, 0);
    const double dx = (*s->p - *newton->s * gradient) / J;
    gradient += newton->theta * *newton->H * dx;
    const double x = *s->x + dx, z = x - *damper->origin, dz = dx - *damper->drift;
    status = fvi_history_push(damper->memory, &z, &dz, &sum);
    *s->x = x;
    *s->dx = dx;
    *s->g = gradient;
    *s->p = *s->p + h * (*s->F - gradient) - *damper->factor * sum;
    return status;
}

/* ---- a step of many coordinates ---- */

/* Number of coordinates in a part. Its ten arrays have 16 KiB each, and stay in the cache of the processor. */
enum { PART = 2048 };

/* Return 1 if x_{k+1} is explicit (kappa = 1), every coordinate is damped, the history takes parts of a term, and
 * nobody reads its last sums (damper->H). */
static int can_step_by_parts(const fvi_stepper *s)
{
    const fvi_damping *damper = s->method_state;
    return damper && s->run.kappa == 1 && damper->covers_all && !damper->H
           && fvi_history_takes_parts(damper->memory);
}

//> drift
/* For some coordinates, compute x_{k+1}, p without the damping, and the newest terms z and dz of the history. A is
 * m / h; origin and drift are those of fvi_damping. */
FVI_VECTORS static void drift_part(double h, size_t count, const double *A,
                                   const double *gradient, const double *F,
                                   const double *origin, const double *drift,
                                   double *x, double *p, double *z, double *dz)
{
#pragma omp simd
    for (size_t j = 0; j < count; j++) {
        const double dx = (p[j] - h * gradient[j]) / A[j];
        x[j] += dx;
        p[j] += h * (F[j] - gradient[j]);
        z[j] = x[j] - origin[j];
        dz[j] = dx - drift[j];
    }
}

/* Give the digits of step_fractional in nine tenths of its time for a million coordinates. Each part of the coordinates
 * is loaded from memory once and goes through the whole step. So z and dz of the damper hold one part only, and s->dx
 * is not written. */
static int step_by_parts(fvi_stepper *s)
{
    static const double zeros[PART];
    const fvi_system *system = s->run.system;
    fvi_damping *damper = s->method_state;
    const double *A = fvi_newton_diagonal(s->newton);
    int status = fvi_potential_gradient(system, s->x, s->g);
    if (!status)
        status = fvi_force_value(s, (double)(s->k + 1) * s->run.h);
    for (size_t i = 0; i < system->d && !status; i += PART) {
        const size_t count = system->d - i < PART ? system->d - i : PART;
        const double *F = system->force.value ? s->F + i : zeros,
                     *drift = damper->sums_increments ? damper->drift + i : zeros,
                     *factor = damper->factor + i;
        double *p = s->p + i, *sums = damper->z; /* the sums take the place of z */
        drift_part(s->run.h, count, A + i, s->g + i, F, damper->origin + i, drift, s->x + i, p,
                   damper->z, damper->dz);
        status = fvi_history_push_part(damper->memory, i, count, damper->z, damper->dz, sums);
#pragma omp simd
        for (size_t j = 0; j < count; j++)
            p[j] -= factor[j] * sums[j];
    }
    return status;
}
//< drift

/* Take the step of any other system. If this function were inlined, step_one_coordinate would save registers for it. */
__attribute__((noinline)) static int step_coordinates(fvi_stepper *s)
{
    return can_step_by_parts(s) ? step_by_parts(s) : step_fractional(s);
}

static int step(fvi_stepper *s)
{
    return is_single_equation(s) ? step_one_coordinate(s) : step_coordinates(s);
}

const fvi_method fvi_fractional = { .name = "fvi",
                                    .order = "1",
                                    .lowest = 1,
                                    .highest = 1,
                                    .memory = "full",
                                    .alpha_most = 1,
                                    .memories = FVI_ALL_MEMORIES,
                                    .scheme = FVI_SCHEME_FVI,
                                    .takes_kappa = 1,
                                    .takes_laws = 1,
                                    .takes_matrices = 1,
                                    .takes_mechanism = 1,
                                    .implicit = 1,
                                    .paper_convention = 1,
                                    .stability_number = fvi_stability_number_backward,
                                    .stability_number_grows = 1,
                                    .start = start_fractional,
                                    .step = step,
                                    .copy = copy_fractional,
                                    .serialize = serialize_fractional,
                                    .damper = fvi_damping_sums,
                                    .keep_dampers = fvi_damping_keep_sums,
                                    .stop = stop_fractional };
