/* src/reference/spring_bound.c -- Bound the distance of form D from the motion of a spring after any step. [H 20] */
#include <fvi/spring_bound.h>

#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <complex.h>
#include <math.h>

/* kappa of (20.18) on the cut and at a pole; and a factor above 1 that covers the errors of the sums in this file. */
static const double KAPPA = 1.34, KAPPA_POLE = 1.1, UP = 1.003;

/* The smallest angle between the pole and the cut. */
static const double NEAREST = 1e-3;

/* R = P/Q, the stability function of Lobatto IIIC, with the lowest power first, and C_s of (20.17). */
typedef struct {
    size_t s;
    double P[8], Q[9], C;
} stability_function;

static stability_function stability_of(size_t s)
{
    const double S = (double)s;
    stability_function R = { .s = s, .P = { 1 }, .Q = { 1 },
                             .C = tgamma(S + 1) * tgamma(S - 1) / (tgamma(2 * S - 1) * tgamma(2 * S)) };
    for (size_t i = 0; i < s; i++) {
        const double below = (double)(2 * s - 2 - i) * (double)(i + 1);
        if (i + 2 < s)
            R.P[i + 1] = R.P[i] * (double)(s - 2 - i) / below;
        R.Q[i + 1] = -R.Q[i] * (double)(s - i) / below;
    }
    return R;
}

static double complex stability_at(const stability_function *R, double complex z)
{
    double complex P = 0, Q = 0;
    for (size_t i = R->s + 1; i-- > 0;) {
        Q = Q * z + R->Q[i];
        if (i + 1 < R->s)
            P = P * z + R->P[i];
    }
    return P / Q;
}

/* A spring without a force, measured from its equilibrium, with the start x0 and v0. */
typedef struct {
    double m, c, rho, alpha, x0, v0;
    double complex pole;
} spring;

/* |J| of (20.16). */
static double source(const spring *q, double complex z)
{
    const double complex begins = q->alpha <= 0.5 ? q->m * q->v0 : -q->c * q->v0 / (z * z);
    return cabs(begins - q->c * q->x0 / z);
}

/* |k| of (20.16). */
static double density(const spring *q, double sigma)
{
    const double damping = q->rho * pow(sigma, 2 * q->alpha);
    const double complex Q =
        q->m * sigma * sigma + q->c + damping * cexp(I * M_PI * 2 * q->alpha);
    return damping * fabs(sin(M_PI * 2 * q->alpha)) / (M_PI * creal(Q * conj(Q)));
}

/* Return |R(z) - e^z|. Near 0 the difference would be a rounding error, so the estimate (20.17) is used there. */
static double error_of_step(const stability_function *R, double complex z)
{
    return cabs(z) < 0.25 ? R->C * pow(cabs(z), 2 * (double)R->s - 1)
                          : cabs(stability_at(R, z) - cexp(z));
}

/* Return Upsilon of (20.19). The argument must grow from call to call in small steps. *most is the largest value so
 * far. */
static double upsilon_of(const stability_function *R, double mu, double *most)
{
    *most = larger(*most, (1 + mu) / mu * error_of_step(R, -mu));
    return *most;
}

/* The integrals of (20.19): those of x and v without errors of the modes, and those that multiply rho eps. */
typedef struct {
    double x, v, modes_x, modes_v;
} integrals;

/* Integrate by the trapezoidal rule in ln sigma, from below all rates of the spring to above them and 1/h. The pole is
 * beside the path, so a step is a sixth of its distance; and at most 1/96, because of Upsilon. */
static integrals integrate_over_rates(const spring *q, const stability_function *R, double longest)
{
    const double L = smaller(1. / 16, M_PI - carg(q->pole)) / 6, order = 2 * q->alpha,
                 own = log(q->c / q->m) / 2, slow = log(q->c / q->rho) / order,
                 fast = log(q->rho / q->m) / (2 - order),
                 low = larger(-650, smaller(own, slow) - 40 / smaller(1, order)),
                 high = smaller(650, larger(larger(own, fast), -log(longest)) + 40);
    double most = 0;
    integrals sum = { 0 };
    for (double u = low; u <= high; u += L) {
        const double sigma = exp(u), k = L * sigma * density(q, sigma),
                     part = k * source(q, -sigma) * upsilon_of(R, sigma * longest, &most);
        sum.x += part;
        sum.v += sigma * part;
        sum.modes_x += k / sigma;
        sum.modes_v += k;
    }
    /* Add the part below `low`, where the integrand is proportional to sigma^(2 alpha). For a small alpha this part is
     * large, and |Q| >= c then. */
    sum.modes_x += q->rho * fabs(sin(M_PI * order)) * exp(order * low) / (M_PI * order * q->c * q->c);
    return sum;
}

//> bound
/* Add (20.19), for a spring whose equilibrium is at 0, to *bound. */
static void add_bound(const spring *q, const stability_function *R, size_t n, const double *h, double eps,
                      fvi_spring_bound *bound)
{
    const double complex slope =
        2 * q->m * q->pole + 2 * q->alpha * q->rho * cpow(q->pole, 2 * q->alpha - 1);
    double longest = 0, missed = 0, written = 0;
    for (size_t k = 0; k < n; k++) {
        const double of_R = cabs(stability_at(R, q->pole * h[k])),
                     of_e = exp(creal(q->pole) * h[k]);
        longest = larger(longest, h[k]);
        missed = larger(missed, error_of_step(R, q->pole * h[k]) / (1 - larger(of_R, of_e)));
        written = larger(written, h[k] / (1 - of_R));
    }
    const integrals cut = integrate_over_rates(q, R, longest);
    const double of_pole = 2 * source(q, q->pole) / cabs(slope) * missed,
                 of_modes = 2 * KAPPA_POLE / cabs(slope) * written, size = cabs(q->pole);
    bound->x += UP * (of_pole + cut.x + q->rho * eps * (of_modes + KAPPA * cut.modes_x));
    bound->v += UP * (size * of_pole + cut.v + q->rho * eps * (size * of_modes + KAPPA * cut.modes_v));
}
//< bound

static int check(const fvi_linear_oscillator *p, size_t stages, size_t n, const double *h, double eps,
                 fvi_error *error)
{
    if (stages < 2 || stages > 8)
        return fvi_fail(error, FVI_EINVAL, "stages", (double)stages, "stages must be 2 to 8");
    if (n == 0)
        return fvi_fail(error, FVI_EINVAL, "n", 0, "there must be a step");
    for (size_t k = 0; k < n; k++)
        if (!(h[k] > 0 && isfinite(h[k])))
            return fvi_fail(error, FVI_EDOM, "h", h[k], "a step must be > 0 and finite");
    if (!(eps >= 0 && isfinite(eps)))
        return fvi_fail(error, FVI_EDOM, "eps", eps, "eps must be finite and not negative");
    if (p->law)
        return fvi_fail(error, FVI_EUNSUP, "law", NAN, "the bound is for one power, not for a law");
    if (p->forcing == FVI_FORCING_COSINE)
        return fvi_fail(error, FVI_EINVAL, "forcing", p->forcing, "the bound is for no force or a constant one");
    if (!(p->alpha > 0 && p->alpha < 1))
        return fvi_fail(error, FVI_EDOM, "alpha", p->alpha, "alpha must be in (0, 1)");
    if (!(p->c > 0))
        return fvi_fail(error, FVI_EDOM, "c", p->c, "c must be > 0");
    if (!(p->rho > 0))
        return fvi_fail(error, FVI_EDOM, "rho", p->rho, "rho must be > 0");
    if (p->past != FVI_INITIAL_HISTORY_CAPUTO
        && !(p->past == FVI_INITIAL_HISTORY_HELD && (p->alpha <= 0.5 || p->v0 == 0)))
        return fvi_fail(error, FVI_EUNSUP, "past", p->past,
                        "the bound is for Caputo's past, and held for alpha <= 1/2 or v0 = 0");
    return FVI_SUCCESS;
}

int fvi_spring_bound_compute(const fvi_linear_oscillator *problem, size_t stages, size_t n,
                             const double *h, double eps, fvi_spring_bound *bound, fvi_error *error)
{
    double re, im;
    if (!problem || !h || !bound)
        return fvi_fail(error, FVI_EFAULT, !problem ? "problem" : !h ? "h" : "bound", NAN, "a null pointer");
    int status = check(problem, stages, n, h, eps, error);
    if (!status)
        status = fvi_exact_pole(problem, &re, &im, error);
    if (status)
        return status;
    if (problem->alpha != 0.5 && atan2(im, -re) < NEAREST)
        return fvi_fail(error, FVI_EUNSUP, "alpha", problem->alpha, "the pole is too near to the cut");
    const stability_function R = stability_of(stages);
    const double moved = problem->forcing == FVI_FORCING_STEP ? problem->A / problem->c : 0;
    spring q = { problem->m, problem->c, problem->rho, problem->alpha, problem->x0 - moved, problem->v0,
                 re + I * im };
    fvi_spring_bound sum = { 0, 0 };
    add_bound(&q, &R, n, h, eps, &sum);
    if (moved != 0) { /* after the end of the force */
        q.x0 = moved;
        q.v0 = 0;
        add_bound(&q, &R, n, h, 0, &sum);
    }
    if (!isfinite(sum.x) || !isfinite(sum.v))
        return fvi_fail(error, FVI_EOVRFLW, NULL, NAN, "the bound is not finite");
    *bound = sum;
    return FVI_SUCCESS;
}
