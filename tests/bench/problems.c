/* tests/bench/problems.c -- The eleven problems of the benchmark.       [H 18] */
#include "problems.h"

#include <gsl/gsl_math.h>

enum { MOST = 1000 };

static double ones[MOST], zeros[MOST], tenth[MOST], fifth[MOST], half[MOST],
    wave[MOST], waves[MOST], arch[8], light[8], lightly[8];
static const double one = 1, plate[] = { 8, 1 }, off_grid[] = { 8, 0.7310585 },
                    cubic[] = { 0, 1 }, hard[] = { 1, 1 }, drive[] = { 1, 1 },
                    slow[] = { 1, 0.5 };

/* m, c, rho, alpha, past, x0, v0, forcing, A, T, w, law */
static const fvi_linear_oscillator exactly[] = {
    { 1, 1, 1, 0.75, FVI_INITIAL_HISTORY_CAPUTO, 0, 0, FVI_FORCING_STEP, 8, 1, 0, NULL },
    { 1, 1, 0.2, 0.5, FVI_INITIAL_HISTORY_CAPUTO, 1, 0.5, FVI_FORCING_NONE, 0, 0, 0, NULL },
    { 1, 1, 1, 0.75, FVI_INITIAL_HISTORY_CAPUTO, 0, 0, FVI_FORCING_STEP, 8, 0.7310585, 0, NULL },
    { 1, 1, 1, 0.2, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 1, 0.5, FVI_FORCING_NONE, 0, 0,
      0, NULL },
    { 1, 1, 0.1, 0.3, FVI_INITIAL_HISTORY_CAPUTO, 0, 0, FVI_FORCING_COSINE, 1, 0, 0.5,
      NULL },
};

static problem all[PROBLEMS];

static void set_up(void)
{
    const double ninth = M_PI / 9;
    for (size_t i = 0; i < MOST; i++) {
        ones[i] = 1;
        tenth[i] = 0.1;
        fifth[i] = 0.2;
        half[i] = 0.5;
        wave[i] = sin(3 * M_PI * (double)(i + 1) / 33);
        waves[i] = sin(91 * M_PI * (double)(i + 1) / 1001);
    }
    for (size_t i = 0; i < 8; i++) {
        arch[i] = sin(ninth * (double)(i + 1));
        light[i] = i == 3 ? 0.01 : 1;
        lightly[i] = 0.2 * light[i];
    }
    const fvi_potential spring = fvi_potential_harmonic(&one),
                        quartic = fvi_potential_duffing(cubic),
                        harder = fvi_potential_duffing(hard),
                        pendulum = fvi_potential_pendulum(&one),
                        chain = fvi_potential_chain(hard);
    const fvi_force none = { 0 };
    const fvi_initial_history C = FVI_INITIAL_HISTORY_CAPUTO, RL = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    const problem table[PROBLEMS] = {
        { "Bagley and Torvik's plate",
          { 1, ones, ones, spring, fvi_force_step(plate), NULL, NULL },
          zeros, zeros, 20, 0.75, C, 1, &exactly[0], 0.5, 0.02 },
        { "alpha = 1/2: nothing to remember",
          { 1, ones, fifth, spring, none, NULL, NULL },
          ones, half, 20, 0.5, C, 0, &exactly[1], 0.5, 0.02 },
        { "Duffing's oscillator, a cosine, T = 50",
          { 1, ones, half, quartic, fvi_force_cosine(drive), NULL, NULL },
          zeros, zeros, 50, 0.3, C, 0, NULL, 0.5, 0.02 },
        { "a chain of 32 masses",
          { 32, ones, fifth, chain, none, NULL, NULL },
          wave, zeros, 20, 0.3, C, 0, NULL, 0.5, 0.06 },
        { "a pendulum, alpha = 0.1, with a velocity",
          { 1, ones, half, pendulum, none, NULL, NULL },
          ones, ones, 20, 0.1, C, 0, NULL, 0.5, 0.02 },
        { "the plate, a jump on no uniform grid",
          { 1, ones, ones, spring, fvi_force_step(off_grid), NULL, NULL },
          zeros, zeros, 20, 0.75, C, off_grid[1], &exactly[2], 0.5, 0.02 },
        { "two time scales: a light mass in a chain",
          { 8, light, lightly, chain, none, NULL, NULL },
          arch, zeros, 20, 0.3, C, 0, NULL, 0.15, 0.06 },
        { "Riemann-Liouville, x0 = 1, alpha = 0.2",
          { 1, ones, ones, spring, none, NULL, NULL },
          ones, half, 20, 0.2, RL, 0, &exactly[3], 0.5, 0.02 },
        { "a hard spring, alpha = 1/sqrt(8)",
          { 1, ones, half, harder, none, NULL, NULL },
          ones, zeros, 20, 1 / sqrt(8), C, 0, NULL, 0.4, 0.02 },
        { "driven to T = 10^4",
          { 1, ones, tenth, spring, fvi_force_cosine(slow), NULL, NULL },
          zeros, zeros, 1e4, 0.3, C, 0, &exactly[4], 0.5, 0.4 },
        { "a chain of 1000 masses",
          { MOST, ones, fifth, chain, none, NULL, NULL },
          waves, zeros, 20, 0.3, C, 0, NULL, 0.5, 0.4 },
    };
    for (int P = 0; P < PROBLEMS; P++) {
        all[P] = table[P];
        all[P].system.force.jumps = &all[P].jump; /* all methods are told the jumps */
        all[P].system.force.jump_count = all[P].jump > 0;
    }
}

const problem *problem_number(int P)
{
    if (!all[0].what)
        set_up();
    return &all[P];
}

fvi_run problem_run(const problem *p, size_t N, fvi_history_kind memory,
                    double tolerance)
{
    return (fvi_run){ .system = &p->system,
                      .x0 = p->x0,
                      .p0 = p->p0,
                      .h = p->T / (double)N,
                      .steps = N,
                      .kappa = 0.5,
                      .alpha = p->alpha,
                      .past = p->past,
                      .memory = memory,
                      .tolerance = tolerance };
}
