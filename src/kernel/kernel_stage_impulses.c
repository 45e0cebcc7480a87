/* src/kernel/kernel_stage_impulses.c -- Compute the impulses of a kernel at the stages of a step.  [H 26] */
#include "kernel_impulses_state.h"

#include "system/lagrange_polynomial.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <string.h>

/* Return point q of the Gauss-Legendre rule with n nodes on [0, 1], and write its weight to *weight. */
static double gauss(int n, int q, double *weight)
{
    double y = cos(M_PI * (q + 0.75) / (n + 0.5)), slope = 0;
    for (int tries = 0; tries < 5; tries++) {
        double P = 1, lower = 0;
        for (int k = 0; k < n; k++) {
            const double next = ((2 * k + 1) * y * P - k * lower) / (k + 1);
            lower = P;
            P = next;
        }
        slope = n * (y * P - lower) / (y * y - 1);
        y -= tries < 4 ? P / slope : 0;
    }
    *weight = 1 / ((1 - y * y) * slope * slope);
    return (1 + y) / 2;
}

enum { POINTS = 40 };
typedef struct {
    int is_made;
    double u[POINTS], part[POINTS];
} gauss_rule;

/* Return the rule with POINTS nodes. Each thread computes it once, because the start of a run needs the moments of some
 * hundred modes. */
static const gauss_rule *gauss_of_moments(void)
{
    static _Thread_local gauss_rule rule;
    for (int q = 0; q < POINTS && !rule.is_made; q++)
        rule.u[q] = gauss(POINTS, q, rule.part + q);
    rule.is_made = 1;
    return &rule;
}

void fvi_stage_moments(const fvi_impulses_of_kernel *o, double complex z,
                       double complex *w)
{
    const gauss_rule *rule = gauss_of_moments();
    for (size_t i = 0; i < o->n; i++)
        w[i] = 0;
    for (int q = 0; q < POINTS; q++) {
        const double u = rule->u[q];
        const double complex grown = cexp(z * u);
        for (size_t i = 0; i < o->n; i++)
            w[i] += rule->part[q] * fvi_lagrange_polynomial(o->n, o->c, i, u) * grown;
    }
}

/* ---- step 0 ---- */

/* Compute the same nodes as fvi_inverse_nodes with the weights of C(s)/s^2. */
static size_t nodes_of(const fvi_impulses_of_kernel *o, double t, double complex *s,
                       double complex *weight)
{
    const size_t count = fvi_inverse_nodes(o, t, s, weight);
    for (size_t j = 0; j < count; j++)
        weight[j] /= s[j] * s[j];
    return count;
}

/* Add the integral from u = a to 2 a, where q is smooth. */
static void add_piece(fvi_impulses_of_kernel *o, double a)
{
    enum { FEW = 20 };
    double complex s[NODES + MOST_POLES], weight[NODES + MOST_POLES];
    const size_t count = nodes_of(o, a * o->h, s, weight);
    for (int q = 0; q < FEW; q++) {
        double part, value = 0;
        const double u = a * (1 + gauss(FEW, q, &part));
        for (size_t j = 0; j < count; j++)
            value += creal(weight[j] * cexp(s[j] * (u * o->h)));
        for (size_t i = 0; i < o->n; i++)
            o->start[i] += o->h * a * part * fvi_lagrange_polynomial(o->n, o->c, i, u) * value;
    }
}

/* Add the integral from u = 0 to e, where q is infinite at u = 0. Only the first four powers of u in l_i are used.
 * Integration by parts turns their integrals into inverse transforms at t = e h. */
static void add_corner(fvi_impulses_of_kernel *o, double e)
{
    enum { POWERS = 4 };
    double complex s[NODES + MOST_POLES], weight[NODES + MOST_POLES];
    const size_t count = nodes_of(o, e * o->h / SPAN, s, weight);
    double moment[POWERS] = { 0 };
    for (size_t j = 0; j < count; j++) {
        const double complex z = s[j] * (e * o->h), f = weight[j] * cexp(z);
        double complex m = 1 / z; /* m_k = (1 - k m_{k-1}) / z */
        for (int k = 0; k < POWERS; k++, m = (1 - k * m) / z)
            moment[k] += creal(f * m);
    }
    for (size_t i = 0; i < o->n; i++) {
        double a[MOST_IMPULSES + 1] = { 1 };
        for (size_t m = 0, degree = 0; m < o->n; m++) {
            if (m == i)
                continue;
            degree++;
            for (size_t k = degree + 1; k-- > 0;)
                a[k] = ((k > 0 ? a[k - 1] : 0) - (k < degree ? a[k] * o->c[m] : 0))
                       / (o->c[i] - o->c[m]);
        }
        double power = e * o->h;
        for (size_t k = 0; k < POWERS && k < o->n; k++, power *= e)
            o->start[i] += a[k] * power * moment[k];
    }
}

static void start_at_stages(fvi_impulses_of_kernel *o)
{
    enum { HALVINGS = 16 };
    double a = 1;
    for (int m = 0; m < HALVINGS; m++) {
        a /= 2;
        add_piece(o, a);
    }
    add_corner(o, a);
}

int fvi_impulses_of_kernel_at_stages(const fvi_kernel *law, double h, size_t n,
                                     const double *c,
                                     fvi_impulses_of_kernel **impulses)
{
    const int status = fvi_impulses_of_kernel_alloc(law, h, impulses);
    if (status)
        return status;
    (*impulses)->at_stages = 1;
    (*impulses)->n = n;
    memcpy((*impulses)->c, c, n * sizeof *c);
    start_at_stages(*impulses);
    return FVI_SUCCESS;
}
