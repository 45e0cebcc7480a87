/* chapters/live/inverse.c -- What the figures of H 23 to 25 ask: a gradient, a fit, a
 * control. Numbers go in and out by the arrays of live.c; mass 1, a held past, Algorithm 3.
 *
 * Each function returns 0, or an error of <fvi/error.h>. */
#include "estimation/identification_tangent.h"
#include "run/whole_run.h"
#include "adjoint/adjoint_lobatto.h"
#include "parameter_derivatives/wanted_check.h"
#include "system/larger.h"

#include <fvi/adjoint.h>
#include <fvi/coefficients.h>
#include <fvi/control.h>
#include <fvi/fvi.h>
#include <fvi/identification.h>
#include <fvi/memory.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_sf_psi.h>
#include <math.h>
#include <string.h>

#define EXPORT(name) __attribute__((export_name(#name))) name

double *live_array(int which);

enum { P = 3 }; /* parameters of a fit */

/* The library's check asks the table of all methods, which would bring all of them into the page. A figure has a method
 * of the library. */
int fvi_wanted_check_scheme(const fvi_method *method)
{
    (void)method;
    return FVI_SUCCESS;
}

/* F_k from array 0, where the one number of params is h. */
static int table(double t, size_t d, void *params, double *F)
{
    const double *h = params;
    (void)d;
    F[0] = live_array(0)[(size_t)(t / *h + 0.5)];
    return FVI_SUCCESS;
}

/* ---- H 23: what x_N depends on ---- */

static const double one = 1, zero = 0;

/* GSL's digamma function for x > 0: psi(x) = psi(x + 1) - 1/x up to 12, then Stirling's series. */
double gsl_sf_psi(const double x)
{
    double shifted = x, sum = 0;
    for (; shifted < 12; shifted++)
        sum -= 1 / shifted;
    const double y = 1 / (shifted * shifted);
    return sum + log(shifted) - 0.5 / shifted
           - y
                 * (1. / 12
                    - y
                          * (1. / 120
                             - y * (1. / 252 - y * (1. / 240 - y / 132))));
}

static int last_position(size_t k, size_t d, const double *x, const double *p,
                         void *params, double *Jx, double *Jp)
{
    (void)k, (void)d, (void)x, (void)params, (void)Jp;
    Jx[0] = p != NULL; /* p is there for k = N alone */
    return FVI_SUCCESS;
}

/* A Duffing spring 1, g, from x0 at rest, pushed by the N + 1 forces of array 0. Array 1: x;
 * array 2: dx_N/dF_k; array 3: the mirror, x of a run without force from 0 with p = 1; array 4:
 * dx_N/dx0. Without slopes: array 1 alone. */
int EXPORT(live_gradient)(double alpha, double rho, double g, double x0,
                          double h, int N, int slopes)
{
    const double cg[2] = { 1, g };
    fvi_system system = { .d = 1,
                          .mass = &one,
                          .damping = &rho,
                          .potential = fvi_potential_duffing(cg),
                          .force = { .value = table, .params = &h } };
    fvi_run run = fvi_run_default(&system, &x0, &zero, h, (size_t)N);
    run.alpha = alpha;
    double *x = live_array(1);
    int status = fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL);
    if (status || !slopes)
        return status;
    const fvi_objective J = { .slopes = last_position, .params = NULL };
    const fvi_sensitivities want = { .x0 = live_array(4), .force = live_array(2) };
    status = fvi_adjoint(&fvi_fractional, &run, x, &zero, &J,
                         &want); /* J has no p */
    if (status)
        return status;
    system.force = (fvi_force){ 0 };
    run.x0 = &zero;
    run.p0 = &one;
    return fvi_trajectory(&fvi_fractional, &run, live_array(3), NULL, NULL);
}

/* Algorithm 3 has no stages to give back. */
void fvi_adjoint_lobatto_stop(fvi_adjoint_lobatto *m)
{
    (void)m;
}

/* ---- H 24: a fit ---- */

/* A becomes L with A = L L^T; GSL's for a few numbers. */
int gsl_linalg_cholesky_decomp1(gsl_matrix *A)
{
    for (size_t i = 0; i < A->size1; i++)
        for (size_t j = 0; j <= i; j++) {
            double sum = A->data[i * A->tda + j];
            for (size_t k = 0; k < j; k++)
                sum -= A->data[i * A->tda + k] * A->data[j * A->tda + k];
            if (i == j && !(sum > 0))
                return FVI_EDOM;
            A->data[i * A->tda + j] =
                i == j ? sqrt(sum) : sum / A->data[j * A->tda + j];
        }
    return FVI_SUCCESS;
}

/* b becomes A^-1 b, from that L. */
int gsl_linalg_cholesky_svx(const gsl_matrix *L, gsl_vector *b)
{
    const size_t n = L->size1;
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < i; k++)
            b->data[i] -= L->data[i * L->tda + k] * b->data[k];
        b->data[i] /= L->data[i * L->tda + i];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++)
            b->data[i] -= L->data[k * L->tda + i] * b->data[k];
        b->data[i] /= L->data[i * L->tda + i];
    }
    return FVI_SUCCESS;
}

static int solve(const double A[P * P], double b[P])
{
    double L[P * P];
    memcpy(L, A, sizeof L);
    gsl_matrix_view matrix = gsl_matrix_view_array(L, P, P);
    gsl_vector_view vector = gsl_vector_view_array(b, P);
    return gsl_linalg_cholesky_decomp1(&matrix.matrix)
           || gsl_linalg_cholesky_svx(&matrix.matrix, &vector.vector);
}

/* The data: n numbers in array 0, at the nodes every, 2 every, ...; the start is known. */
typedef struct {
    double h, x0, p0, sigma;
    int n, every;
} data;

/* Arrays 1 and 2 become x and its slopes by theta = alpha, rho, c, (24.6): a run, unless they are. */
static int ride(const data *o, const double theta[P])
{
    static const fvi_free_parameter which[P] = { FVI_FREE_PARAMETER_ALPHA,
                                            FVI_FREE_PARAMETER_RHO,
                                            FVI_FREE_PARAMETER_CONSTANT };
    static double last[P];
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = theta + 1,
                                .potential =
                                    fvi_potential_harmonic(theta + 2) };
    fvi_run run = fvi_run_default(&system, &o->x0, &o->p0, o->h,
                                  (size_t)(o->n * o->every));
    run.alpha = theta[0];
    if (memcmp(last, theta, sizeof last) == 0)
        return FVI_SUCCESS;
    last[0] = NAN;
    int status = fvi_tangent(&run, P, which, live_array(1), live_array(2));
    if (!status)
        memcpy(last, theta, sizeof last);
    return status;
}

/* What the linear problem needs: chi^2 (24.1), A = J^T J, b = -J^T r, over sigma^2. */
typedef struct {
    double chi2, A[P * P], b[P];
} normal;

static int normal_at(const data *o, const double theta[P], normal *e)
{
    int status = ride(o, theta);
    *e = (normal){ .chi2 = 0 };
    for (int i = 0; i < o->n && !status; i++) {
        const int k = (i + 1) * o->every;
        const double r = (live_array(1)[k] - live_array(0)[i]) / o->sigma;
        e->chi2 += r * r;
        for (int j = 0; j < P; j++) {
            const double s = live_array(2)[k * P + j] / o->sigma;
            e->b[j] -= s * r;
            for (int l = 0; l < P; l++)
                e->A[j * P + l] += s * live_array(2)[k * P + l] / o->sigma;
        }
    }
    return status;
}

//> marquardt
/* One step by Levenberg and Marquardt, (A + mu diag A) step = b: mu grows until chi^2 does not.
 * theta and e: in, and out; alpha stays where it is held. far: output, the largest step, measured by
 * what chi^2 + 1 takes. */
static int improve(const data *o, int is_held, double theta[P], normal *e, double *far)
{
    for (double mu = 1e-4; mu < 1e12; mu *= 10) {
        double damped[P * P], step[P], there[P];
        normal next;
        memcpy(damped, e->A, sizeof damped);
        memcpy(step, e->b, sizeof step);
        for (int j = 0; j < P; j++)
            damped[j * P + j] *= 1 + mu;
        for (int j = 1; j < P && is_held; j++)
            damped[j] = damped[j * P] = step[0] = 0;
        if (solve(damped, step))
            return FVI_ESING;
        *far = 0;
        for (int j = 0; j < P; j++) {
            there[j] = theta[j] + step[j];
            *far = larger(*far, fabs(step[j]) * sqrt(e->A[j * P + j]));
        }
        const int inside = there[0] > 0 && there[0] < 1 && there[1] > 0;
        if (inside && !normal_at(o, there, &next) && next.chi2 <= e->chi2) {
            memcpy(theta, there, sizeof there);
            *e = next;
            return FVI_SUCCESS;
        }
    }
    *far = 0; /* none is better */
    return ride(o, theta);
}
//< marquardt

/* Array 3, in: alpha, rho, c; out: those after one step, their sd (24.3), the correlation of
 * alpha and rho, chi^2, and how far the step went: below 1e-6 it was the last that matters.
 * Arrays 1 and 2: x and its slopes there. */
int EXPORT(live_fit)(double x0, double p0, double h, int n, int every,
                     double sigma)
{
    const data o = { h, x0, p0, sigma, n, every };
    double *theta = live_array(3), C[P][P] = { { 0 } }, far;
    normal e;
    int status = normal_at(&o, theta, &e);
    if (!status)
        status = improve(&o, 0, theta, &e, &far);
    for (int j = 0; j < P && !status; j++) {
        C[j][j] = 1;
        status = solve(e.A, C[j]) ? FVI_ESING : FVI_SUCCESS;
        theta[P + j] = sqrt(C[j][j]);
    }
    if (status)
        return status;
    theta[2 * P] = C[0][1] / theta[P] / theta[P + 1];
    theta[2 * P + 1] = e.chi2;
    theta[2 * P + 2] = far;
    return FVI_SUCCESS;
}

/* One place of the profile (24.11). Array 3, in: alpha, and rho and c near its best ones; out: rho and c
 * that are best for this alpha, and chi^2 there. */
int EXPORT(live_valley)(double x0, double p0, double h, int n, int every,
                        double sigma)
{
    const data o = { h, x0, p0, sigma, n, every };
    double *theta = live_array(3), far = 1;
    normal e;
    int status = normal_at(&o, theta, &e);
    for (int i = 0; i < 20 && !status && far > 1e-4; i++)
        status = improve(&o, 1, theta, &e, &far);
    theta[P] = e.chi2;
    return status;
}

/* ---- H 25: to rest, and afterwards ---- */

/* What holds x = 0 from k = N on, after x_0 ... x_{N-1}: the damping's pull, from N + 1 on. */
static int hold(double alpha, double c, const double *x, int N, int last,
                double *u)
{
    fvi_history *m;
    int status =
        fvi_history_alloc(2 * alpha, 1, (size_t)last, FVI_HISTORY_AUTO, 0, &m);
    if (status)
        return status;
    double before = 0, H;
    for (int k = 0; k <= last && !status; k++) {
        const double z = (k < N ? x[k] : 0) - x[0], dz = z - before;
        status = fvi_history_push(m, &z, &dz, &H);
        if (k > N)
            u[k] = c * H;
        before = z;
    }
    fvi_history_free(m);
    return status;
}

/* A spring 1, from x0, p0 to rest at k = N with the least force. Array 0: that force, and after
 * N the one that holds it there; array 1: x with both, to `last`; array 2: x if no force acts
 * after N. Array 3: what (25.1) makes least, the miss. */
int EXPORT(live_control)(double alpha, double rho, double x0, double p0,
                         double h, int N, int last)
{
    double *u = live_array(0), *held = live_array(1), *freed = live_array(2);
    fvi_system system = { .d = 1,
                          .mass = &one,
                          .damping = &rho,
                          .potential = fvi_potential_harmonic(&one) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, h, (size_t)N);
    fvi_control_result found;
    run.alpha = alpha;
    memset(u, 0, (size_t)(last + 1) * sizeof *u);
    int status = fvi_control_solve(&fvi_fractional, &run, &zero, &zero, u, &found);
    if (status)
        return status;
    system.force = (fvi_force){ .value = table, .params = &h };
    run.steps = (size_t)last;
    status = fvi_trajectory(&fvi_fractional, &run, freed, NULL, NULL)
             || hold(alpha, rho * pow(h, -2 * alpha), freed, N, last, u)
             || fvi_trajectory(&fvi_fractional, &run, held, NULL, NULL);
    live_array(3)[0] = found.cost;
    live_array(3)[1] = found.miss;
    return status;
}
