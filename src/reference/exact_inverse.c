/* src/reference/exact_inverse.c -- Invert the Laplace transform of the linear problem.        [H 11] */
#include "exact_inverse.h"

#include "frequency/exact_law.h"
#include "kernel/kernel_terms.h"
#include <fvi/error.h>

#include <gsl/gsl_math.h>
#include <math.h>

enum { CIRCLE = 40 };

static const double MU = 3;     /* the hyperbola crosses the real axis left of this */
static const double PHI = 1.35; /* largest phi, so that the hyperbola keeps its distance from the cut */
static const double FOLDS = 40; /* terms below e^-FOLDS are neglected */

//> contour
/* (11.10): make the contour for phi in the middle of interval number `place`, when (0, PHI) is divided into `places`
 * equal intervals. The contour ends where the integrand has decayed by e^-(reach FOLDS). */
static void prepare_contour(double beta, size_t place, size_t places,
                            double reach, fvi_contour *k)
{
    double room = PHI / 2 / (double)places, h = 2 * M_PI * room / FOLDS;
    double phi = (double)(2 * place + 1) * room;
    double last = acosh((1 + reach * FOLDS / MU) / sin(phi));
    k->count = (size_t)GSL_MIN(ceil(last / h), FVI_NODES);
    for (size_t i = 0; i < k->count; i++) {
        double u = ((double)i + 0.5) * h;
        double complex z =
            MU * (1 - sin(phi) * cosh(u) + I * (cos(phi) * sinh(u)));
        double complex dz =
            MU * (-sin(phi) * sinh(u) + I * (cos(phi) * cosh(u)));
        k->z[i] = z;
        k->weight[i] = h / M_PI * cexp(z) * dz;
        k->power[i] = cexp(beta * clog(z));
    }
}
//< contour

/* ---- what is done once ---- */

static void prepare_root(fvi_inverse *S, const fvi_pole *root)
{
    const fvi_linear_oscillator *p = &S->p;
    const double complex s = root->s, i_w = I * p->w;
    const double complex slope = fvi_pole_derivative(root);
    double complex unused;
    const double complex memory = p->rho
                                  * (p->law         ? fvi_kernel_at(p->law, s, &unused) / s
                                     : S->beta == 1 ? 1
                                                    : cexp((S->beta - 1) * clog(s)));
    fvi_residue *a = &S->pole[S->poles++];
    *a = (fvi_residue){ .s = s };
    a->low = root->low;
    a->start = ((p->m * s + S->keeps_x0 * memory) * p->x0
                + (p->m + S->keeps_v0 * memory / s) * p->v0)
               / slope; /* (11.7) */
    if (p->forcing == FVI_FORCING_STEP)
        a->force = p->A / (s * slope);
    if (p->forcing == FVI_FORCING_COSINE)
        a->force = -p->A * s / (fvi_pole_from(root, i_w) * (s + i_w) * slope);
}

/* Return Q(iw). Near a zero s the factor iw - s is computed separately, without cancellation. */
static double complex symbol_at_frequency(const fvi_inverse *S)
{
    const fvi_linear_oscillator *p = &S->p;
    const double complex i_w = I * p->w;
    double complex unused;
    for (size_t i = 0; i < S->roots; i++) {
        const double complex from = fvi_pole_from(&S->root[i], i_w);
        if (cabs(from) < p->w / 2)
            return from * fvi_pole_quotient(&S->root[i], i_w);
    }
    return p->c - p->m * p->w * p->w
           + p->rho
                 * (p->law ? fvi_kernel_at(p->law, i_w, &unused)
                           : cexp(S->beta * clog(i_w)));
}

/* Find the zeros of Q. A law that is one power, or nothing, becomes the problem without a law. */
static int find_roots(fvi_inverse *S, fvi_error *error)
{
    fvi_linear_oscillator *p = &S->p;
    size_t active = 0;
    const fvi_kernel_term *last = NULL;
    for (size_t i = 0; p->law && i < p->law->count; i++)
        if (p->law->term[i].rho > 0) {
            last = &p->law->term[i];
            active++;
        }
    if (p->law && p->rho > 0 && active > 0
        && !(active == 1 && last->kind == FVI_KERNEL_POWER))
        return fvi_kernel_poles(p->m, p->c, p->rho, p->law, FVI_BEHIND_CONTOURS, FVI_ZEROS, S->root,
                                &S->roots, error);
    if (p->law) {
        p->rho *= last ? last->rho : 0;
        p->alpha = last ? last->alpha : 0;
        p->law = NULL;
    }
    S->beta = 2 * p->alpha;
    S->roots = (size_t)fvi_pole_find(p->m, p->c, p->rho, S->beta, S->root);
    return FVI_SUCCESS;
}

int fvi_inverse_prepare(const fvi_linear_oscillator *problem, fvi_inverse *S,
                        fvi_error *error)
{
    const fvi_linear_oscillator *p = &S->p;
    S->p = *problem; /* no struct assignment to *S, because most of it is room for contours */
    S->p.w = fabs(p->w);
    if (p->law)
        S->p.past = FVI_INITIAL_HISTORY_HELD; /* the other pasts that are allowed for a law give the same motion */
    S->beta = 0; /* a law has no beta */
    S->roots = S->poles = 0;
    int status = find_roots(S, error);
    if (status)
        return status;
    S->keeps_x0 = p->past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE || p->alpha == 0.5;
    S->keeps_v0 = p->past == FVI_INITIAL_HISTORY_CAPUTO && p->alpha > 0.5;
    for (size_t i = 0; i < S->roots; i++)
        prepare_root(S, &S->root[i]);
    if (p->forcing == FVI_FORCING_COSINE && p->w > 0)
        S->pole[S->poles++] =
            (fvi_residue){ .s = I * p->w,
                           .force = p->A / (2 * symbol_at_frequency(S)) };
    int whole = !p->law
                && (p->rho == 0 || S->beta == 1 || S->beta == 2
                    || (S->beta == 0 && !S->keeps_x0));
    S->closed = S->roots == 1 && whole
                && (p->forcing == FVI_FORCING_NONE
                    || (p->forcing == FVI_FORCING_COSINE && p->w > 0));
    for (size_t i = 0; i <= S->poles; i++)
        S->contour[i].count = 0;
    return FVI_SUCCESS;
}

const fvi_contour *fvi_inverse_contour(fvi_inverse *S, size_t place)
{
    fvi_contour *k = &S->contour[place];
    if (k->count == 0)
        prepare_contour(S->beta, place, S->poles + 1,
                        S->p.forcing == FVI_FORCING_STEP ? 2 : 1, k);
    return k;
}

/* ---- what is done at a time ---- */

//> place
/* (11.11): return the contour in the lowest interval without a pole. k poles leave at least one of k + 1 intervals
 * free. passed[i] becomes nonzero if pole i lies on the right of the contour. */
static const fvi_contour *choose_contour(fvi_inverse *S, double t,
                                         int passed[FVI_POLES])
{
    size_t places = S->poles + 1, in[FVI_POLES], free = 0;
    for (size_t i = 0; i < S->poles; i++) {
        double phi = -creal(casin(S->pole[i].s * t / MU - 1));
        double place = floor(phi / PHI * (double)places);
        in[i] = (size_t)GSL_MIN(GSL_MAX(place, 0), (double)places - 1);
    }
    for (size_t tries = 0; tries < S->poles; tries++)
        for (size_t i = 0; i < S->poles; i++)
            if (in[i] == free)
                free++;
    for (size_t i = 0; i < S->poles; i++)
        passed[i] = in[i] < free;
    return fvi_inverse_contour(S, free);
}
//< place

/* Return e^{st}, or for a force that has ended the difference e^{st} - e^{s(t - T)}. */
static double complex growth_factor(const fvi_residue *a, const fvi_exact_source *at,
                                    double lasts)
{
    double complex e = fvi_pole_exp(a->s, a->low, at->t, 0);
    if (lasts > 0 && cabs(a->s) * lasts < 1)
        return -fvi_complex_expm1(-a->s * lasts) * e;
    if (lasts > 0) {
        double since = at->t - lasts;
        e -= fvi_pole_exp(a->s, a->low, since, (at->t - since) - lasts);
    }
    return e;
}

double complex fvi_inverse_residue(const fvi_residue *a, const fvi_exact_source *at,
                                   int with_force)
{
    double complex r = 0;
    if (a->start != 0)
        r = at->start * a->start * growth_factor(a, at, 0);
    if (with_force && a->force != 0)
        r += at->sign * a->force * growth_factor(a, at, at->lasts);
    return r;
}

//> residues
static void add_residue(const fvi_residue *a, const fvi_exact_source *at,
                        int with_force, double *x, double *v)
{
    double complex r = fvi_inverse_residue(a, at, with_force);
    *x += 2 * creal(r);
    *v += 2 * creal(a->s * r);
}
//< residues

//> resonance
/* (11.12): near resonance the residues of a zero and of the cosine are of order 1 / |iw - s| each and nearly cancel.
 * Their sum is a mean over a circle that contains both poles. Return 0 if they are far enough from each other. */
int fvi_inverse_resonance(const fvi_inverse *S, const fvi_pole *root, double t,
                          double *x, double *v)
{
    const fvi_residue *forced = &S->pole[S->roots];
    const double w = S->p.w, radius = fmin(0.5 / t, w / 4);
    const double complex gap = -fvi_pole_from(root, forced->s);
    if (3 * cabs(gap) > radius)
        return 0;
    const double complex e = S->p.A / CIRCLE * fvi_pole_exp(forced->s, 0, t, 0);
    for (int k = 0; k < CIRCLE; k++) {
        double complex d = radius * cexp(I * (2 * M_PI * k / CIRCLE));
        double complex s = forced->s + d;
        double complex q = (d - gap) * fvi_pole_quotient(root, s);
        double complex r = e * cexp(d * t) * s / ((s + forced->s) * q);
        *x += 2 * creal(r);
        *v += 2 * creal(s * r);
    }
    return 1;
}
//< resonance

/* Return the transform of the force on the contour, multiplied by t / m and divided by A t^2 / m. */
static double complex force_at(const fvi_inverse *S, const fvi_exact_source *at,
                               double complex z)
{
    if (S->p.forcing == FVI_FORCING_COSINE) {
        double wt = S->p.w * at->t;
        return z / (z * z + wt * wt);
    }
    return at->lasts > 0 ? -fvi_complex_expm1(-z * at->lasts / at->t) / z
                         : 1 / z;
}

//> integral
/* (11.10), with t as the unit of time. The small terms are added first. */
static void add_integral(const fvi_inverse *S, const fvi_contour *k,
                         const fvi_exact_source *at, double *x, double *v)
{
    const fvi_linear_oscillator *p = &S->p;
    const double t = at->t, C = p->c / p->m * t * t;
    const double R = p->rho / p->m * (p->law ? t * t : pow(t, 2 - S->beta));
    double complex unused;
    const double x0 = at->start * p->x0, v0 = at->start * p->v0 * t;
    const double F = p->forcing ? at->sign * p->A / p->m * t * t : 0;
    double sum_x = 0, sum_v = 0;
    for (size_t i = k->count; i-- > 0;) {
        double complex z = k->z[i];
        double complex damping =
            R * (p->law ? fvi_kernel_at(p->law, z / t, &unused) : k->power[i]);
        double complex keeps = S->keeps_v0 * damping / z;
        double complex f = F != 0 ? F * force_at(S, at, z) : 0;
        double complex w = k->weight[i] / (z * z + C + damping);
        sum_x += cimag(w
                       * ((z + S->keeps_x0 * damping / z) * x0
                          + (z + keeps) / z * v0 + f));
        sum_v += cimag(w
                       * ((z + keeps) * v0 + z * f
                          - (C + (1 - S->keeps_x0) * damping) * x0));
    }
    *x += sum_x;
    *v += sum_v / t;
}
//< integral

void fvi_inverse_add(fvi_inverse *S, const fvi_exact_source *at, double *x, double *v)
{
    int passed[FVI_POLES], all = 1;
    const fvi_contour *k = choose_contour(S, at->t, passed);
    size_t near = S->poles; /* the zero with which a cosine is in resonance */
    for (size_t i = 0; i < S->poles; i++)
        all = all && passed[i];
    for (size_t i = 0; near == S->poles && i < S->roots; i++)
        if (S->poles > S->roots && passed[i] && passed[S->roots]
            && fvi_inverse_resonance(S, &S->root[i], at->t, x, v))
            near = i;
    for (size_t i = 0; i < S->poles; i++)
        if (passed[i])
            add_residue(&S->pole[i], at,
                        near == S->poles || (i != near && i != S->roots), x, v);
    if (!(S->closed && all)) /* otherwise the integral is zero */
        add_integral(S, k, at, x, v);
}

void fvi_inverse_oscillation(const fvi_inverse *S, const fvi_exact_source *at,
                             double *x, double *v)
{
    for (size_t i = 0; i < S->roots; i++)
        add_residue(&S->pole[i], at, 1, x, v);
}
