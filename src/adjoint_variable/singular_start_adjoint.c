/* src/adjoint_variable/singular_start_adjoint.c -- The derivatives through the singular part of a start. [H 23] */
#include "singular_start_adjoint.h"

#include "system/digamma.h"
#include "system/arrays.h"
#include "system/fail.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

/* ---- the start ---- */

/* The expansion of a body without damping: A t^e, and one term more whose factor rho/m is 0 but has a derivative. It
 * lasts as long as the other expansions; if no body has another one, it lasts to the end of the run. */
static int start_undamped(fvi_singular_start_adjoint *p, const fvi_run *run)
{
    fvi_singular *g = &p->undamped;
    *g = (fvi_singular){ .J = 1,
                         .e = run->alpha > 0.5,
                         .gap = 2 - 2 * run->alpha,
                         .t1 = p->unit.J ? p->unit.t1 : GSL_POSINF };
    int status = fvi_singular_allocate(1, g);
    if (status)
        return status;
    g->c[0] = 1;
    g->c[1] = -1 / tgamma(1 + fvi_singular_power(g, 1));
    p->undamped_psi[1] = fvi_digamma(1 + fvi_singular_power(g, 1));
    return FVI_SUCCESS;
}

static int start_unit(fvi_singular_start_adjoint *p, const fvi_run *run,
                      const fvi_variable_step_state *o)
{
    fvi_singular *g = &p->unit;
    *g = o->singular;
    int status = fvi_singular_allocate(run->system->d, g);
    if (status)
        return status;
    for (size_t j = 0; j < run->system->d; j++)
        p->by_A[j] = 1;
    fvi_singular_fill(run->system, run->alpha, o->T, p->by_A, g);
    for (size_t n = 0; n <= g->J; n++)
        p->psi[n] = fvi_digamma(1 + fvi_singular_power(g, n));
    if (g->gap > 0 && !g->by_euler_transform) /* otherwise G leaves no force, and psi may have a pole */
        p->left = fvi_digamma(1 + fvi_singular_power(g, g->J) - 2 * run->alpha);
    p->turn = g->gap < 0 ? 2 : -2;
    return FVI_SUCCESS;
}

static double amplitude(const fvi_run *run, size_t j)
{
    return fvi_initial_history_amplitude(run->past, run->alpha, run->x0[j],
                              run->p0[j] / run->system->mass[j]);
}

int fvi_singular_start_adjoint_start(const fvi_run *run, const fvi_variable_step_state *o,
                                     fvi_singular_start_adjoint *p)
{
    const size_t d = run->system->d;
    int moves = 0;
    *p = (fvi_singular_start_adjoint){ 0 };
    p->is = fvi_initial_history_acts(run->past, run->alpha) && run->alpha > 0
            && run->alpha < 1;
    for (size_t j = 0; p->is && j < d; j++)
        moves |= amplitude(run, j) != 0;
    p->is = p->is && (moves || o->singular.J);
    if (!p->is)
        return FVI_SUCCESS;
    p->block = FVI_ARRAYS({ &p->A, d }, { &p->by_A, d }, { &p->by_ratio, d }, { &p->by_mass, d },
                          { &p->psi, o->singular.J + 1 }, { &p->moment, o->modes ? fvi_modes_count(o->modes) : 0 });
    if (!p->block)
        FVI_FAIL("no memory for the start", FVI_ENOMEM);
    int status = o->singular.J ? start_unit(p, run, o) : FVI_SUCCESS;
    for (size_t j = 0; j < d; j++) {
        p->by_A[j] = 0;
        p->A[j] = amplitude(run, j);
    }
    return status ? status : start_undamped(p, run);
}

void fvi_singular_start_adjoint_stop(fvi_singular_start_adjoint *p)
{
    free(p->unit.c);
    free(p->undamped.c);
    free(p->block);
}

/* ---- G and its derivatives ---- */

/* The expansion of coordinate j. *j becomes the index of its numbers in the expansion. */
static const fvi_singular *choose_expansion(const fvi_singular_start_adjoint *p, size_t *j,
                                            const double **psi)
{
    if (p->unit.J && p->unit.ratio[*j] > 0) {
        *psi = p->psi;
        return &p->unit;
    }
    *j = 0;
    *psi = p->undamped_psi;
    return &p->undamped;
}

double fvi_singular_start_adjoint_first(const fvi_singular_start_adjoint *p, size_t j)
{
    const double *psi;
    const fvi_singular *g = choose_expansion(p, &j, &psi);
    return g->c[j * (g->J + 1)];
}

double fvi_singular_start_adjoint_at(const fvi_singular_start_adjoint *p, size_t j, double t,
                          double *slope)
{
    const double *psi, A = p->A[j];
    double G;
    const fvi_singular *g = choose_expansion(p, &j, &psi);
    fvi_singular_at(g, j, t, &G, slope, NULL);
    if (slope)
        *slope *= A;
    return A * G;
}

/* The derivatives of G over q = r t^gap by A, by r (times r/q), and by alpha through the a_n; and of G'. */
typedef struct {
    double value[3], slope[3];
} sums;

static sums sum_series(const fvi_singular *g, const double *c, const double *psi,
                       double q, double ln)
{
    sums s = { { 0 }, { 0 } };
    for (size_t n = g->J; n > 0; n--) {
        const double a = fvi_singular_power(g, n), by = (double)n * c[n],
                     turned = ln - psi[n];
        s.value[0] = s.value[0] * q + c[n];
        s.value[1] = s.value[1] * q + by;
        s.value[2] = s.value[2] * q + by * turned;
        s.slope[0] = s.slope[0] * q + c[n] * a;
        s.slope[1] = s.slope[1] * q + by * a;
        s.slope[2] = s.slope[2] * q + by * (a * turned + 1);
    }
    return s;
}

void fvi_singular_start_adjoint_accumulate(fvi_singular_start_adjoint *p, size_t j, double t, double by_G,
                          double by_slope, double by_force)
{
    const double *psi, A = p->A[j];
    size_t at = j;
    const fvi_singular *g = choose_expansion(p, &at, &psi);
    const double *c = g->c + at * (g->J + 1), power = pow(t, g->gap),
                 q = g->ratio[at] * power, first = g->e == 1 ? t : 1;
    const sums s = sum_series(g, c, psi, q, log(t));
    double by[3];
    for (size_t i = 0; i < 3; i++)
        by[i] = first * (by_G * s.value[i] + by_slope * s.slope[i] / t);
    p->by_A[j] += by[0] * q;
    p->by_ratio[j] += A * by[1] * power;
    p->by_alpha += A * by[2] * q * p->turn;
    if (g->residual_force[at] == 0 || by_force == 0)
        return;
    const double J = (double)g->J, most = pow(q, J), /* of the force */
        force =
            by_force * g->residual_force[at] * most * (g->e == 1 ? 1 / t : 1 / (t * t));
    p->by_A[j] += force * q;
    p->by_ratio[j] += A * force * power * (J + 1);
    p->by_mass[j] += A * force * q;
    p->by_alpha += A * force * q * (J * p->turn - 2) * (log(t) - p->left);
}

/* ---- the numbers that the modes take over ---- */

/* The series that (22.20) sums, differentiated by A (with the jump c_0), by r and by alpha. */
typedef struct {
    fvi_singular_series by_A, by_ratio, by_alpha;
} transfer_series;

static void write_series(const fvi_singular_start_adjoint *p, size_t j, transfer_series *f)
{
    enum { MOST = FVI_SINGULAR_MOST };
    const double *psi, A = p->A[j];
    const fvi_singular *g = choose_expansion(p, &j, &psi);
    const double *c = g->c + j * (g->J + 1), t = g->t1, unit = pow(t, g->gap),
                 ln = log(t);
    double a[MOST], by_A[MOST], by_r[MOST], turned[MOST], rate[MOST],
        q = unit; /* r^{n-1} t^{n gap} */
    for (size_t n = 1; n <= g->J; n++, q *= g->ratio[j] * unit) {
        const double power = fvi_singular_power(g, n), k = (double)n,
                     falls = g->e == 1 ? power - 1 : 1,
                     slope = g->e == 1 ? 2 * power - 1 : 1;
        const size_t i = n - 1;
        a[i] = power - g->e;
        by_r[i] = A * k * c[n] * power * falls * q;
        by_A[i] = c[n] * power * falls * q * g->ratio[j];
        turned[i] = A * p->turn * k * by_A[i];
        rate[i] = A * p->turn * k * c[n] * q * g->ratio[j]
                  * (slope + power * falls * (ln - psi[n]));
    }
    fvi_singular_sums(g->J, by_A, a, 0, &f->by_A);
    fvi_singular_sums(g->J, by_r, a, 0, &f->by_ratio);
    fvi_singular_sums_by_order(g->J, turned, rate, a, &f->by_alpha);
    f->by_A.B[0] += c[0];
}

static double accumulate_modes(fvi_singular_start_adjoint *p, const fvi_singular_series *f,
                       size_t j, const fvi_modes *modes, double mu,
                       double *rate)
{
    const double t1 = p->undamped.t1;
    for (size_t q = 0; q < fvi_modes_count(modes); q++)
        p->moment[q] = fvi_singular_moment(f, fvi_modes_decay(modes, q) * t1);
    return fvi_modes_accumulate(modes, j, p->moment, mu, rate);
}

double fvi_singular_start_adjoint_accumulate_modes(fvi_singular_start_adjoint *p, size_t j, double rho,
                                const fvi_modes *modes, double mu, int by_alpha)
{
    transfer_series f;
    double rate = 0;
    write_series(p, j, &f);
    const double all =
        accumulate_modes(p, &f.by_A, j, modes, mu, by_alpha ? &rate : NULL);
    p->by_A[j] -= rho * all;
    if (rho > 0)
        p->by_ratio[j] -= rho * accumulate_modes(p, &f.by_ratio, j, modes, mu, NULL);
    if (rho > 0 && by_alpha)
        p->by_alpha -= rho
                       * (accumulate_modes(p, &f.by_alpha, j, modes, mu, NULL)
                          + 2 * p->A[j] * rate);
    return p->A[j] * all;
}

void fvi_singular_start_adjoint_ratio(const fvi_singular_start_adjoint *p, double m, double rho,
                           double *by_rho, double *by_m)
{
    const int falling = p->unit.gap < 0 && rho > 0;
    *by_rho = falling ? -m / (rho * rho) : 1 / m;
    *by_m = falling ? 1 / rho : -rho / (m * m);
}
