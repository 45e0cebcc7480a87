/* tests/balance/test_balance_differences.c -- Properties that schemes of differences share with variational
 * schemes, and properties that they lack. [chapters/handbook/what_the_principle_buys.md]
 * Run alone: make test-balance_differences */
#include "balance/differences.h"
#include "run/whole_run.h"

#include <fvi/fvi.h>
#include <fvi/lobatto.h>
#include "harness/ulp.h"

#include <string.h>

enum { MOST = 1024 };
static const double T = 10, g = 1, x0[] = { 1, 0.25 }, p0[] = { 0.5, -0.75 };
static double x[2 * (MOST + 1)], p[2 * (MOST + 1)], y[2 * (MOST + 1)];

/* U = |x|^2/2 + g |x|^4/4; *params is g. */
static int value(size_t d, const double *q, void *params, double *potential)
{
    const double s = square(d, q);
    *potential = s / 2 + *(const double *)params * s * s / 4;
    return 0;
}

static int gradient(size_t d, const double *q, void *params, double *grad)
{
    for (size_t i = 0; i < d; i++)
        grad[i] = (1 + *(const double *)params * square(d, q)) * q[i];
    return 0;
}

static int hessian(size_t d, const double *q, void *params, double *H)
{
    const double G = *(const double *)params;
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++)
            H[i * d + j] =
                (i == j) * (1 + G * square(d, q)) + 2 * G * q[i] * q[j];
    return 0;
}

/* The same problem by a method of the library, of mass 1. */
static void varied(const fvi_method *method, const differenced *o, double kappa)
{
    const double mass[] = { 1, 1 }, rho[] = { o->rho, o->rho };
    const fvi_system system = {
        .d = o->d,
        .mass = mass,
        .damping = rho,
        .potential = { .value = value,
                       .gradient = gradient,
                       .hessian = hessian,
                       .params = (void *)&o->g }
    };
    fvi_run run = fvi_run_default(&system, x0, p0, o->h, o->steps);
    run.alpha = o->alpha;
    run.kappa = kappa;
    run.memory = FVI_HISTORY_DIRECT;
    ck_assert_int_eq(fvi_trajectory(method, &run, x, p, NULL), FVI_SUCCESS);
}

static differenced problem(size_t d, double rho, double alpha, size_t N)
{
    return (differenced){ d, N, g, rho, alpha, T / (double)N };
}

/* x_1 by Taylor's series of what has no damping yet. */
static void differenced_run(differences kind, const differenced *o, double *z)
{
    double grad[2];
    gradient(o->d, x0, (void *)&o->g, grad);
    for (size_t i = 0; i < o->d; i++) {
        z[i] = x0[i];
        z[o->d + i] = x0[i] + o->h * p0[i] - o->h * o->h / 2 * grad[i];
    }
    difference(kind, o, z);
}

/* From the same two positions: NODE is the FVI with kappa = 1, for any U; and MEAN is
 * that with kappa = 1/2 if U is quadratic, g = 0. Rounding: N steps of some 60 u each, the
 * answers to which grow at most with t, N^2/2 60 u. Else they differ. */
START_TEST(differences_that_are_an_fvi)
{
    for (int mean = 0; mean < 2; mean++)
        for (int linear = 0; linear < 2; linear++)
            for (size_t d = 1; d <= 2; d++) {
                differenced o = problem(d, 0.5, 0.3, 200);
                double worst = 0;
                o.g = linear ? 0 : g;
                varied(&fvi_fractional, &o, mean ? 0.5 : 1);
                memcpy(y, x, 2 * d * sizeof *y);
                difference(mean ? MEAN : NODE, &o, y);
                for (size_t k = 0; k < d * 201; k++)
                    worst = larger(worst, fabs(x[k] - y[k]));
                if (mean && !linear) {
                    seen(worst, "MEAN is another");
                    ck_assert_double_gt(worst, 1e-4);
                } else
                    ck_assert_near(worst, 0, 200. * 200 / 2 * 60 * U,
                                   "mean %d, linear %d", mean, linear);
            }
}
END_TEST

/* max |x_k - x(t_k)|, the truth by the Lobatto method of four stages. */
static double error_of(const double *z, const double *truth, size_t N)
{
    double worst = 0;
    for (size_t k = 0; k <= N; k++)
        worst = larger(worst, fabs(z[k] - truth[k * (MOST / N)]));
    return worst;
}

/* All are of order 1, by fits; MEAN and the FVI err alike, by the delay of the damping.
 * The truth is good to some 1e-9. */
START_TEST(the_same_order_for_the_same_work)
{
    static double truth[MOST + 1];
    const char *name[] = { "NODE", "MEAN", "BACK", "FVI" };
    const differenced fine = problem(1, 0.5, 0.3, MOST);
    varied(&fvi_lobatto_m4, &fine, 0.5);
    memcpy(truth, x, sizeof truth);
    for (int kind = NODE; kind <= VARIED; kind++) {
        double error[2];
        for (size_t j = 0; j < 2; j++) {
            const differenced o = problem(1, 0.5, 0.3, (size_t)256 << j);
            if (kind == VARIED)
                varied(&fvi_fractional, &o, 0.5);
            else
                differenced_run((differences)kind, &o, x);
            error[j] = error_of(x, truth, o.steps);
        }
        seen(log2(error[0] / error[1]), "%s", name[kind]);
        ck_assert_near(log2(error[0] / error[1]), 1, 0.2, "%s", name[kind]);
        seen(error[1], kind == VARIED ? "error, FVI" : "error, differences");
    }
}
END_TEST

/* d x_N / d (impulse at j) from the same scheme run backwards about the trajectory. Where
 * the potential is asked for and where its force acts are the same node, or as in
 * the FVI the same mean of two nodes, it is the derivative of the run, to rounding: N
 * steps of some 60 u, as above. MEAN asks at one node and feels at three, and is off by
 * O(h^2). */
START_TEST(a_gradient_by_the_same_scheme_run_backwards)
{
    static double H[MOST + 1], back[MOST + 1], v[MOST + 1];
    const double alphas[] = { 0.3, 0.7 };
    for (size_t i = 0; i < 2; i++)
        for (int kind = NODE; kind <= VARIED; kind++) {
            double error[2];
            for (size_t j = 0; j < 2; j++) {
                const differenced o =
                    problem(1, 0.5, alphas[i], (size_t)128 << j);
                if (kind == VARIED)
                    varied(&fvi_fractional, &o, 0.5);
                else
                    differenced_run((differences)kind, &o, x);
                error[j] =
                    gradient_error((differences)kind, &o, x, H, back, v);
            }
            if (kind == MEAN) {
                seen(log2(error[0] / error[1]), "order, MEAN");
                seen(error[1], "MEAN");
                ck_assert_near(log2(error[0] / error[1]), 2, 0.1, "MEAN");
            } else {
                seen(error[1], kind == VARIED ? "FVI" : "NODE and BACK");
                ck_assert_near(error[1], 0, 256. * 256 / 2 * 60 * U, "%d",
                               kind);
            }
        }
}
END_TEST

/* Without damping, in the plane. The angular momentum x p' - p x' of the FVI is kept; so is
 * x_k x x_{k+1} / h of NODE. That of MEAN swings by O(h^2) (and a quantity near it is
 * kept: it is the trapezoidal rule, conjugate to the midpoint rule); that of BACK is
 * lost. */
START_TEST(what_turns_without_damping)
{
    double swing[4][2];
    for (int kind = NODE; kind <= VARIED; kind++)
        for (size_t j = 0; j < 2; j++) {
            const differenced o = problem(2, 0, 0.5, (size_t)256 << j);
            double least = INFINITY, largest = -INFINITY;
            if (kind == VARIED)
                varied(&fvi_fractional, &o, 0.5);
            else
                differenced_run((differences)kind, &o, x);
            for (size_t k = 0; k < o.steps; k++) {
                const double *q = x + 2 * k, *r = p + 2 * k;
                const double I = kind == VARIED
                                     ? q[0] * r[1] - q[1] * r[0]
                                     : (q[0] * q[3] - q[1] * q[2]) / o.h;
                least = smaller(least, I);
                largest = larger(largest, I);
            }
            swing[kind][j] = (largest - least) / larger(-least, largest);
        }
    seen(swing[MEAN][1], "MEAN");
    seen(log2(swing[MEAN][0] / swing[MEAN][1]), "order, MEAN");
    seen(swing[BACK][1], "BACK");
    const double bound = 512 * 60 * U / (T / 512); /* differences over h */
    ck_assert_near(swing[NODE][1], 0, bound, "NODE");
    ck_assert_near(swing[VARIED][1], 0, bound, "FVI");
    ck_assert_near(log2(swing[MEAN][0] / swing[MEAN][1]), 2, 0.1, "MEAN");
    ck_assert_double_gt(swing[BACK][1], 0.1);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("21 differences of the same equation");
    ADD_CASE(suite, "differences", differences_that_are_an_fvi,
             the_same_order_for_the_same_work,
             a_gradient_by_the_same_scheme_run_backwards,
             what_turns_without_damping);
    return run_suite(suite);
}
