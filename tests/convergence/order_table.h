/* tests/convergence/order_table.h -- H 20: the table of orders, every method and every
 * past. alpha is neither 0 nor 1, kappa = 1/2, v_0 is not 0. */
#ifndef ORDER_TABLE_H
#define ORDER_TABLE_H

#include "series.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>

enum { METHODS = 19, UP_TO_FOUR = 13, OF_X = 0, OF_P = 1 };

/* HALF: order 1, for alpha = 1/2 only. */
typedef enum { HALF, ONE, TWO, FORM_M, FORM_D, FAMILIES } kind;

typedef struct {
    const fvi_method *method;
    kind family;
    double s; /* stages */
} scheme;

static const scheme schemes[METHODS] = { { &fvi_lagrange_dalembert, HALF, 0 },
                                         { &fvi_euler_explicit, HALF, 0 },
                                         { &fvi_euler_implicit, HALF, 0 },
                                         { &fvi_fractional, ONE, 0 },
                                         { &fvi_cq2_shifted, TWO, 0 },
                                         { &fvi_cq_bdf2, TWO, 0 },
                                         { &fvi_cq2_midpoint, TWO, 0 },
                                         { &fvi_lobatto_m2, FORM_M, 2 },
                                         { &fvi_lobatto_d2, FORM_D, 2 },
                                         { &fvi_lobatto_m3, FORM_M, 3 },
                                         { &fvi_lobatto_d3, FORM_D, 3 },
                                         { &fvi_lobatto_m4, FORM_M, 4 },
                                         { &fvi_lobatto_d4, FORM_D, 4 },
                                         { &fvi_lobatto_m5, FORM_M, 5 },
                                         { &fvi_lobatto_d5, FORM_D, 5 },
                                         { &fvi_lobatto_m6, FORM_M, 6 },
                                         { &fvi_lobatto_d6, FORM_D, 6 },
                                         { &fvi_lobatto_m8, FORM_M, 8 },
                                         { &fvi_lobatto_d8, FORM_D, 8 } };

static const fvi_initial_history pasts[] = { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_CAPUTO,
                                  FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
static const char *const past_names[] = { "held", "Caputo",
                                          "Riemann-Liouville" };

/* x_0 is not 0. At alpha = 1/2 the memory has two weights and no kick: the run is bit for bit
 * that of a held body. */
static inline int is_kicked(const duffing *q)
{
    return q->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && q->alpha < 0.5;
}

/* Held, and x'' is not bounded. */
static inline int has_initial_history_force(const duffing *q)
{
    return q->past == FVI_INITIAL_HISTORY_HELD && q->alpha > 0.5;
}

/* What a force that is not linear makes of the singular part of x: (20.12). */
static inline double nonlinear(const duffing *q)
{
    if (is_kicked(q))
        return 5 - 4 * q->alpha;
    return has_initial_history_force(q) ? 7 - 4 * q->alpha : GSL_POSINF;
}

//> fixed
/* At a fixed t > 0, of x or of p. */
static inline double at_fixed_t(const scheme *of, const duffing *q, int what)
{
    if (of->family <= ONE)
        return is_kicked(q) ? 1 - 2 * q->alpha : 1;
    if (of->family == TWO)
        return 2;
    if (q->alpha == 0.5)
        return 2 * of->s - 2;
    double less = is_kicked(q) ? 1 : 0; /* than s + 2 - 2 alpha */
    if (of->family == FORM_M && what == OF_P)
        less = 1;
    if (of->family == FORM_D && q->past == FVI_INITIAL_HISTORY_CAPUTO)
        less = what == OF_P ? -1 : -2;
    const double all = smaller(2 * of->s - 2, of->s + 2 - 2 * q->alpha - less);
    return q->g == 0 ? all : smaller(all, nonlinear(q)); /* (20.11) */
}
//< fixed

//> start
/* In the first steps; over all t the order is the lower one of the two. */
static inline double at_the_start(const scheme *of, const duffing *q, int what)
{
    const double a = q->alpha, more = what == OF_X ? 1 : 0;
    if (of->family <= ONE)
        return (has_initial_history_force(q) ? 2 - 2 * a : is_kicked(q) ? 1 - 2 * a : 1) + more;
    if (a == 0.5)
        return of->method == &fvi_cq_bdf2 ? 1 + more : GSL_POSINF;
    if (a < 0.5)
        return 2 - 2 * a + more;
    return (has_initial_history_force(q) ? 4 - 4 * a : 3 - 2 * a) + more;
}
//< start

/* Does the method know such a problem? */
static inline int takes(const scheme *of, const duffing *q)
{
    return of->family != HALF || q->alpha == 0.5;
}

static inline double table_of(const scheme *of, const duffing *q, int what,
                              int all_t)
{
    const double fixed = at_fixed_t(of, q, what);
    return all_t ? smaller(fixed, at_the_start(of, q, what)) : fixed;
}

/* ---- a generic start ---- */

static const double alphas[] = { 0.3, 0.4, 0.5, 0.6, 0.75, 0.9 };

enum { GENERIC = 36 }; /* alphas, pasts, springs; 24 of them are taken */

/* c = 16 or U = x^4, F = cos(2 t)/2, x_0 = 0.7, v_0 = 1.3. No: held and alpha <= 1/2, which
 * is Caputo's; Riemann-Liouville's with alpha > 1/2, which has no motion. */
static inline int is_generic(size_t i, duffing *q)
{
    const double alpha = alphas[i % LEN(alphas)];
    const fvi_initial_history past = pasts[i / LEN(alphas) % LEN(pasts)];
    const int bent = i / LEN(alphas) >= LEN(pasts);
    *q = (duffing){ past,         alpha, alpha > 0.8 ? 0.2 : 1,
                    0.7,          1.3,   bent ? 0 : 16,
                    bent ? 4 : 0, 0.5,   2 };
    if ((past == FVI_INITIAL_HISTORY_HELD && alpha <= 0.5)
        || (past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && alpha > 0.5))
        return 0;
    return 1;
}

/* The motion that the runs go to. At alpha = 1/2 no run knows its past, so that all pasts
 * have the motion of a held body; the equation of Riemann-Liouville's has a kick there. */
static inline duffing limit_of_runs(const duffing *q)
{
    duffing limit = *q;
    if (q->alpha == 0.5)
        limit.past = FVI_INITIAL_HISTORY_CAPUTO;
    return limit;
}

#endif
