/* chapters/play/play.c -- What the live page asks of the library.
 *
 * Compiled to WebAssembly together with modules of src/, as they are. The page
 * writes the numbers of a run to `input`, calls, and reads the arrays. Nothing
 * is imported: no file, no clock, no console. */
#include "coefficients.h"
#include "discrete_mechanics.h"
#include "exact_solution.h"
#include "fvi.h"
#include "memory_kinds.h"
#include "stability.h"

#include <gsl/gsl_errno.h>

#define EXPORT(name) __attribute__((export_name(#name))) name

enum { MOST_STEPS = 4000 };

/* The order is that of `fields` in model.js. */
static struct {
    double method, alpha, rho, potential, c, g, force, a, b, caputo, kappa, x0,
        p0, h, steps;
} input;

static double x[MOST_STEPS + 1], p[MOST_STEPS + 1], energy[MOST_STEPS + 1],
    weights[MOST_STEPS + 1], exact_t[MOST_STEPS + 1], exact_x[MOST_STEPS + 1],
    exact_v[MOST_STEPS + 1];

void *EXPORT(play_input)(void)
{
    return &input;
}

double *EXPORT(play_array)(int which)
{
    double *const arrays[] = {
        x, p, energy, weights, exact_t, exact_x, exact_v
    };
    return arrays[which];
}

/* ---- from the numbers to a run ---- */

static const double mass = 1;

static fvi_potential potential(void)
{
    switch ((int)input.potential) {
    case 0:
        return fvi_potential_harmonic(&input.c);
    case 1:
        return fvi_potential_duffing(&input.c); /* c, then g */
    case 2:
        return fvi_potential_pendulum(&input.c);
    default:
        return (fvi_potential){ 0 }; /* free */
    }
}

static fvi_system the_system(void)
{
    fvi_system s = {
        .d = 1, .mass = &mass, .damping = &input.rho, .potential = potential()
    };
    if (input.force == 1)
        s.force = fvi_force_step(&input.a); /* a, then b = T */
    if (input.force == 2)
        s.force = fvi_force_cosine(&input.a); /* a, then b = w */
    return s;
}

static fvi_run the_run(const fvi_system *system)
{
    return (fvi_run){ .system = system,
                      .x0 = &input.x0,
                      .p0 = &input.p0,
                      .h = input.h,
                      .steps = (size_t)input.steps,
                      .kappa = input.kappa,
                      .alpha = input.alpha,
                      .caputo = input.caputo != 0,
                      .memory = FVI_MEMORY_DIRECT };
}

/* ---- what the page calls ---- */

/* How many rows of x, p and energy there are: steps + 1, less if a value stopped
 * being finite or the equation of a step was not solved, 0 if refused. */
int EXPORT(play_run)(void)
{
    static const fvi_method *const methods[] = { &fvi_fractional,
                                                 &fvi_lagrange_dalembert,
                                                 &fvi_euler_explicit,
                                                 &fvi_euler_implicit };
    const fvi_system system = the_system();
    const fvi_run run = the_run(&system);
    fvi_stepper *s;
    if (!(input.steps <= MOST_STEPS)
        || fvi_start(methods[(int)input.method], &run, &s))
        return 0;
    int rows = 0, status;
    do {
        x[rows] = s->x[0];
        p[rows] = s->p[0];
        energy[rows++] = fvi_energy(&system, s->x, s->p);
        status = s->k < run.steps ? fvi_step(s) : GSL_EINVAL;
    } while (!status);
    fvi_stop(s);
    return rows;
}

/* The exact solution at t_k, k = 0, every, 2 every, ... <= steps. Returns how
 * many times that is, or 0 if the problem has no exact solution here. */
int EXPORT(play_exact)(int every)
{
    const fvi_linear problem = { .m = mass,
                                 .c = input.potential == 0 ? input.c : 0,
                                 .rho = input.rho,
                                 .alpha = input.alpha,
                                 .caputo = input.caputo != 0,
                                 .x0 = input.x0,
                                 .v0 = input.p0 / mass,
                                 .forcing = (fvi_forcing)input.force,
                                 .A = input.a,
                                 .T = input.b,
                                 .w = input.b };
    if (input.potential == 1 || input.potential == 2)
        return 0;
    size_t n = 0;
    for (int k = 0; k <= (int)input.steps; k += every)
        exact_t[n++] = (double)k * input.h;
    return fvi_exact(&problem, n, exact_t, exact_x, exact_v) ? 0 : (int)n;
}

/* weights[n], n < count: of the order 2 alpha of the damping. */
int EXPORT(play_weights)(int count)
{
    return fvi_coefficients(2 * input.alpha, (size_t)count, weights);
}

/* (14.3); above 1 the run must blow up. -1 if it cannot be said. */
double EXPORT(play_load)(void)
{
    const fvi_system system = the_system();
    const fvi_run run = the_run(&system);
    double load;
    return fvi_stability_load(&run, &load) ? -1 : load;
}

/* (14.4), the largest stable step: 0 if none is, infinity if all are. */
double EXPORT(play_step)(void)
{
    const fvi_system system = the_system();
    const fvi_run run = the_run(&system);
    double h;
    return fvi_stability_step(&run, &h) ? -1 : h;
}
