/* src/reference/exact_solution.c -- Solve the linear problem exactly.    [H 11] */
#include "exact_inverse.h"
#include "system/fail.h"

#include <gsl/gsl_math.h>

static const double LARGEST_PHASE_ERROR = 1e-14; /* largest error of a phase */

static int in_range(double a, double low, double high)
{
    return gsl_finite(a) && a >= low && a <= high;
}

static int refuse(const char *field, double value, fvi_error *error)
{
    return fvi_fail(error, FVI_EDOM, field, value, "%s is %g, out of range", field, value);
}

int fvi_exact_check(const fvi_linear_oscillator *p, fvi_error *error)
{
    const double most = GSL_DBL_MAX;
    if (!p)
        return fvi_fail(error, FVI_EFAULT, "problem", NAN, "there is no problem");
    if (p->forcing != FVI_FORCING_NONE && p->forcing != FVI_FORCING_STEP
        && p->forcing != FVI_FORCING_COSINE)
        return fvi_refuse(error, "forcing", "unknown forcing");
    if (!in_range(p->m, GSL_DBL_MIN, most))
        return refuse("m", p->m, error);
    if (!in_range(p->c, 0, most))
        return refuse("c", p->c, error);
    if (!in_range(p->rho, 0, most))
        return refuse("rho", p->rho, error);
    if (!in_range(p->alpha, 0, 1))
        return refuse("alpha", p->alpha, error);
    if (!gsl_finite(p->x0))
        return refuse("x0", p->x0, error);
    if (!gsl_finite(p->v0))
        return refuse("v0", p->v0, error);
    if (p->forcing && !gsl_finite(p->A))
        return fvi_fail(error, FVI_EDOM, "A", p->A, "A must be finite");
    if (p->forcing == FVI_FORCING_STEP && !in_range(p->T, 0, most))
        return fvi_fail(error, FVI_EDOM, "T", p->T, "T must be finite and not negative");
    if (p->forcing == FVI_FORCING_COSINE && !gsl_finite(p->w))
        return fvi_fail(error, FVI_EDOM, "w", p->w, "w must be finite");
    if (p->past != FVI_INITIAL_HISTORY_HELD && p->past != FVI_INITIAL_HISTORY_CAPUTO
        && p->past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
        return fvi_fail(error, FVI_EINVAL, "past", p->past, "unknown past");
    if (p->law) {
        const int status = fvi_kernel_check(p->law);
        if (status)
            return fvi_fail(error, status, "law", NAN, "not a law of damping: %s", fvi_error_name(status));
        if (p->past != FVI_INITIAL_HISTORY_HELD
            && !(p->past == FVI_INITIAL_HISTORY_CAPUTO
                 && fvi_kernel_takes_caputo(p->law)))
            return fvi_fail(error, FVI_EUNSUP, "past", p->past, "a law of damping is for a body that was held");
        return FVI_SUCCESS;
    }
    if (!fvi_initial_history_solvable(p->past, p->alpha, p->rho, p->x0))
        return fvi_fail(error, FVI_EDOM, "past", NAN,
                        "Riemann-Liouville with x0 != 0 has no solution for alpha > 1/2");
    return FVI_SUCCESS;
}

static int check_times(size_t n, const double *t, const double *x,
                       const double *v, fvi_error *error)
{
    if (!t || (!x && !v))
        return fvi_fail(error, FVI_EFAULT, "t", NAN, "there are no times, or no outputs");
    if (n == 0)
        return fvi_refuse(error, "n", "n must be at least 1");
    for (size_t i = 0; i < n; i++)
        if (!in_range(t[i], 0, GSL_DBL_MAX))
            return fvi_fail(error, FVI_EDOM, "t", t[i], "a time must be finite and not negative");
    return FVI_SUCCESS;
}

/* Check the problem and the times, and prepare the problem. */
static int prepare_problem(const fvi_linear_oscillator *problem, size_t n, const double *t,
                           const double *x, const double *v, fvi_inverse *S,
                           fvi_error *error)
{
    int status = fvi_exact_check(problem, error);
    if (!status)
        status = check_times(n, t, x, v, error);
    if (!status)
        status = fvi_inverse_prepare(problem, S, error);
    return status;
}

int fvi_exact_phase_is_lost(const fvi_inverse *S, double t)
{
    int lost = 0;
    for (size_t i = 0; i < S->roots && t > 0; i++)
        lost = lost || fvi_pole_phase_error(&S->root[i], t) > LARGEST_PHASE_ERROR;
    return lost;
}

static int write_solution(size_t i, double xi, double vi, double *x, double *v,
                          fvi_error *error)
{
    if (!gsl_finite(xi) || !gsl_finite(vi))
        return fvi_fail(error, FVI_EOVRFLW, NULL, NAN, "a value is not finite");
    if (x)
        x[i] = xi;
    if (v)
        v[i] = vi;
    return FVI_SUCCESS;
}

/* Set the sources at a time t. Soon after the end of a step there are two: the start with its force, and the end of the
 * force. Later the two forces are one pulse, which has a smaller rounding error. Return the number of sources. */
static size_t sources_at(const fvi_linear_oscillator *p, double t, fvi_exact_source at[2])
{
    at[0] = (fvi_exact_source){ .t = t, .start = 1, .sign = 1 };
    if (p->forcing != FVI_FORCING_STEP || t <= p->T)
        return 1;
    if (t >= 2 * p->T) {
        at[0].lasts = p->T;
        at[0].sign = p->T > 0;
        return 1;
    }
    at[1] = (fvi_exact_source){ .t = t - p->T, .sign = -1 }; /* exact: t < 2 T */
    return 2;
}

void fvi_exact_evaluate(fvi_inverse *S, double t, double *x, double *v)
{
    fvi_exact_source at[2];
    const size_t sources = t > 0 ? sources_at(&S->p, t, at) : 0;
    *x = t > 0 ? 0 : S->p.x0;
    *v = t > 0 ? 0 : S->p.v0;
    for (size_t j = 0; j < sources; j++)
        fvi_inverse_add(S, &at[j], x, v);
}

int fvi_exact_at(const fvi_linear_oscillator *problem, size_t n, const double *t, double *x,
                 double *v, fvi_error *error)
{
    fvi_inverse S;
    int status = prepare_problem(problem, n, t, x, v, &S, error);
    if (status)
        return status;
    for (size_t i = 0; i < n && !status; i++) {
        double xi, vi;
        status = fvi_interrupted();
        if (status)
            return status;
        if (fvi_exact_phase_is_lost(&S, t[i]))
            return fvi_fail(error, FVI_ELOSS, "t", t[i], "the phase of the oscillation is lost");
        fvi_exact_evaluate(&S, t[i], &xi, &vi);
        status = write_solution(i, xi, vi, x, v, error);
    }
    return status;
}

int fvi_exact_oscillation(const fvi_linear_oscillator *problem, size_t n, const double *t,
                          double *x, double *v, fvi_error *error)
{
    fvi_inverse S;
    int status = prepare_problem(problem, n, t, x, v, &S, error);
    if (status)
        return status;
    if (S.roots == 0)
        return fvi_fail(error, FVI_EDOM, NULL, NAN, "there are no complex poles");
    for (size_t i = 0; i < n && !status; i++) {
        double xi = 0, vi = 0;
        fvi_exact_source at = { .t = t[i], .start = 1, .sign = 1 };
        if (fvi_exact_phase_is_lost(&S, t[i]))
            return fvi_fail(error, FVI_ELOSS, "t", t[i], "the phase of the oscillation is lost");
        if (problem->forcing == FVI_FORCING_STEP && t[i] > problem->T) {
            at.lasts = problem->T;
            at.sign = problem->T > 0;
        }
        fvi_inverse_oscillation(&S, &at, &xi, &vi);
        status = write_solution(i, xi, vi, x, v, error);
    }
    return status;
}

int fvi_exact_pole(const fvi_linear_oscillator *problem, double *re, double *im,
                   fvi_error *error)
{
    fvi_inverse S;
    if (!re || !im)
        return fvi_fail(error, FVI_EFAULT, "re", NAN, "nowhere to put the pole");
    int status = fvi_exact_check(problem, error);
    if (!status)
        status = fvi_inverse_prepare(problem, &S, error);
    if (status)
        return status;
    if (S.roots == 0)
        return fvi_fail(error, FVI_EDOM, NULL, NAN, "there is no complex pole");
    const fvi_pole *slowest = S.root;
    for (size_t i = 1; i < S.roots; i++)
        if (creal(S.root[i].s) > creal(slowest->s))
            slowest = &S.root[i];
    *re = creal(slowest->s) + creal(slowest->low);
    *im = cimag(slowest->s) + cimag(slowest->low);
    return FVI_SUCCESS;
}
