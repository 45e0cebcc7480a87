/* chapters/play/play.c -- What the live page asks of the library.
 *
 * Compiled to WebAssembly together with modules of src/, as they are. The page
 * writes the numbers of a run to `input`, calls, and reads the arrays. No file,
 * no clock, no console is imported: only names that say so if they are called (wasm.py). */
#include <fvi/coefficients.h>
#include <fvi/convolution_quadrature.h>
#include <fvi/convolution_quadrature_methods.h>
#include <fvi/discrete_mechanics.h>
#include <fvi/expression.h>
#include <fvi/exact_solution.h>
#include <fvi/fvi.h>
#include <fvi/lobatto.h>
#include "stages/lobatto_history.h"
#include <fvi/past.h>
#include <fvi/stability.h>

#include <fvi/error.h>
#include <math.h>
#include <string.h>

/* A page shows no words of an error, and has no printf. */
int fvi_fail(fvi_error *error, int code, const char *field, double value,
             const char *format, ...)
{
    (void)error, (void)field, (void)value, (void)format;
    return code;
}

#define EXPORT(name) __attribute__((export_name(#name))) name

enum { MOST_STEPS = 4000 };

/* The order is that of `fields` in model.js. */
static struct {
    double method, alpha, rho, potential, c, g, force, a, b, past, kappa, x0,
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

/* ---- a potential that is typed ---- */

static char text[256];
static fvi_expression *own; /* while a call lasts */
static fvi_misprint wrong;

char *EXPORT(play_text)(void)
{
    return text;
}

/* Nonzero if it is no expression. What is kept has to be given back: free does its work when
 * the last block has come. */
static int understand(void)
{
    static const fvi_symbols names = { .variable = "x", .d = 1 };
    wrong = (fvi_misprint){ 0, "" };
    return input.potential == 4
           && fvi_expression_parse(text, &names, NULL, &own, &wrong);
}

static void forget(void)
{
    fvi_expression_free(own);
    own = NULL;
}

/* What is wrong with it, "" if nothing; play_wrong_at: at which of its bytes. */
const char *EXPORT(play_wrong)(void)
{
    understand();
    forget();
    return wrong.reason;
}

int EXPORT(play_wrong_at)(void)
{
    return (int)wrong.at;
}

/* ---- from the numbers to a run ---- */

static const double mass = 1;

/* Of all that `fvi methods` names, those that the page knows: the table of the library
 * would bring the others with it. The order is that of `choices.method` in model.js. */
static const fvi_method *the_method(void)
{
    static const fvi_method *const known[] = {
        &fvi_fractional,     &fvi_lagrange_dalembert, &fvi_euler_explicit,
        &fvi_euler_implicit, &fvi_cq2_shifted,            &fvi_cq_bdf2,
        &fvi_lobatto_m2,       &fvi_lobatto_m3,           &fvi_lobatto_m4
    };
    return known[(int)input.method];
}

/* 2, 3 or 4; 0 for a method without stages. */
static size_t stages(void)
{
    return (size_t)the_method()->stages;
}

static fvi_potential potential(void)
{
    switch ((int)input.potential) {
    case 0:
        return fvi_potential_harmonic(&input.c);
    case 1:
        return fvi_potential_duffing(&input.c); /* c, then g */
    case 2:
        return fvi_potential_pendulum(&input.c);
    case 3:
        return (fvi_potential){ 0 }; /* free */
    default:
        return fvi_potential_expression(own);
    }
}

static fvi_system the_system(const double *damping)
{
    fvi_system s = {
        .d = 1, .mass = &mass, .damping = damping, .potential = potential()
    };
    if (input.force == 1)
        s.force = fvi_force_step(&input.a); /* a, then b = T */
    if (input.force == 2)
        s.force = fvi_force_cosine(&input.a); /* a, then b = w */
    return s;
}

/* The sums of the stages are too many to be done anew for each frame. */
static fvi_run the_run(const fvi_system *system)
{
    return (fvi_run){ .system = system,
                      .x0 = &input.x0,
                      .p0 = &input.p0,
                      .h = input.h,
                      .steps = (size_t)input.steps,
                      .kappa = input.kappa,
                      .alpha = input.alpha,
                      .past = (fvi_initial_history)input.past,
                      .memory =
                          stages() ? FVI_HISTORY_AUTO : FVI_HISTORY_DIRECT };
}

/* ---- runs ---- */

/* 0 if no motion starts there: fvi_stepper_start then refuses but for Algorithm 3. */
int EXPORT(play_solvable)(void)
{
    return fvi_initial_history_solvable((fvi_initial_history)input.past, input.alpha, input.rho,
                                 input.x0);
}

/* Whether U is a multiple of x^2, as it stands. */
static int quadratic(void)
{
    return input.potential < 4 && !((input.potential == 1 && input.g != 0)
             || (input.potential == 2 && input.c != 0));
}

/* How many rows of x, p and energy there are: steps + 1, less if a value stopped
 * being finite or the equation of a step was not solved, 0 if refused. */
static int run_of(const fvi_system *system)
{
    const fvi_run run = the_run(system);
    fvi_stepper *s;
    if (!(input.steps <= MOST_STEPS) || fvi_stepper_start(the_method(), &run, &s,
                                                          NULL))
        return 0;
    int rows = 0, status;
    do {
        x[rows] = s->x[0];
        p[rows] = s->p[0];
        if (fvi_energy(system, s->x, s->p, energy + rows)
            || !isfinite(energy[rows])) /* no row, as in build/fvi */
            break;
        rows++;
        status = s->k < run.steps ? fvi_stepper_step(s) : FVI_EINVAL;
    } while (!status);
    fvi_stepper_free(s);
    return rows;
}

int EXPORT(play_run)(void)
{
    int rows = 0;
    if (!understand()) {
        const fvi_system system = the_system(&input.rho);
        rows = run_of(&system);
    }
    forget();
    return rows;
}

/* The exact solution at t_k, k = 0, every, 2 every, ... <= steps, or, if every is
 * 1, at that many parts of each step. Returns how many times that is, or 0 if the
 * problem has no exact solution here. */
int EXPORT(play_exact)(int every, int parts)
{
    const fvi_linear_oscillator problem = { .m = mass,
                                 .c = input.potential == 3 ? 0 : input.c,
                                 .rho = input.rho,
                                 .alpha = input.alpha,
                                 .past = (fvi_initial_history)input.past,
                                 .x0 = input.x0,
                                 .v0 = input.p0 / mass,
                                 .forcing = (fvi_forcing)input.force,
                                 .A = input.a,
                                 .T = input.b,
                                 .w = input.b };
    if (!quadratic())
        return 0;
    size_t n = 0;
    for (int k = 0; k <= (int)input.steps * parts; k += every)
        exact_t[n++] = (double)k / parts * input.h;
    return fvi_exact_at(&problem, n, exact_t, exact_x, exact_v,
                        NULL) ? 0 : (int)n;
}

/* ---- weights ---- */

/* What a step of velocity 1 adds to the derivative at the end of the n-th step
 * after it: the last row of W_n, summed. (17.9) */
static int stage_weights(size_t s, size_t count)
{
    double v[FVI_STAGES] = { 1, 1, 1, 1 }, H[FVI_STAGES];
    fvi_lobatto_history *m;
    int status = fvi_lobatto_history_alloc(s, 2 * input.alpha - 1, 1, count,
                                          FVI_HISTORY_MODES, 0, 0, &m);
    if (status)
        return status;
    const double *last = fvi_lobatto_history_w0(m) + s * (s - 1);
    weights[0] = 0;
    for (size_t i = 0; i < s; i++)
        weights[0] += last[i];
    for (size_t n = 1; n < count; n++) {
        fvi_lobatto_history_push(m, v, H, NULL);
        weights[n] = H[s - 1];
        memset(v, 0, sizeof v);
    }
    fvi_lobatto_history_free(m);
    return FVI_SUCCESS;
}

/* weights[n], n < count: those of x_{k-n}, of the order 2 alpha of the damping; of
 * stages, those of the velocities. */
int EXPORT(play_weights)(int count)
{
    if (stages())
        return stage_weights(stages(), (size_t)count);
    return fvi_cq_weights(the_method()->quadrature, 2 * input.alpha,
                                  (size_t)count, weights);
}

/* ---- stability ---- */

/* In place of stability_lobatto.c, for whose eigenvalues the page has no room: the
 * bound (17.15), with what acts as a spring in (17.16). For s > 2 and 0 < alpha < 1/2
 * that is not known, and left out. */
int fvi_stability_lobatto(size_t s, const fvi_run *run, double *load)
{
    const double bound[] = { 4, 8, 42 - 6 * sqrt(29) }, alpha = run->alpha,
                 h = run->h, rho = run->system->damping[0];
    const fvi_potential *u = &run->system->potential;
    double stiffness = 0, share = 0;
    int status = u->hessian ? u->hessian(1, run->x0, u->params, &stiffness)
                            : FVI_SUCCESS;
    if (status)
        return status;
    if (alpha == 0 || (s == 2 && alpha < 0.5))
        share =
            pow(2, 2 * alpha + 1) / sqrt(3) * sin((1 - 2 * alpha) * M_PI / 3);
    const double inertia = mass + (alpha == 1 ? rho : 0); /* (17.17) */
    *load = (h * h * stiffness / inertia
             + share * pow(h, 2 - 2 * alpha) * rho / mass)
            / bound[s - 2];
    return FVI_SUCCESS;
}

/* Above 1 the run must blow up, or, of stages, may: see model.js. -1 if it cannot
 * be said. */
double EXPORT(play_load)(void)
{
    double load = -1;
    if (!understand()) {
        const fvi_system system = the_system(&input.rho);
        const fvi_run run = the_run(&system);
        if (fvi_stability_number(the_method(), &run, &load))
            load = -1;
    }
    forget();
    return load;
}

/* The h of load 1, the largest stable step: 0 if none is, infinity if all are, -1 if
 * it cannot be said. The load that stands in for that of stages grows with h. */
double EXPORT(play_step)(void)
{
    double h = -1;
    if (!understand()) {
        const fvi_system system = the_system(&input.rho);
        const fvi_run run = the_run(&system);
        fvi_method method = *the_method();
        method.stability_number_grows = 1;
        if (fvi_stability_longest_step(&method, &run, &h))
            h = -1;
    }
    forget();
    return h;
}
