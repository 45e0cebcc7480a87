/* stage_6.c -- Chapter 9: what was before t = 0, and the order. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

double m = 1, c = 1, cubic = 0, rho = 0.2, x0 = 1, p0 = 0.5, kappa = 0.5;
double alpha = 0.5;
int caputo = 0;

/* U = c x^2/2 + cubic x^4/4. */
double grad(double x)
{
    return c * x + cubic * x * x * x;
}

double hess(double x)
{
    return c + 3 * cubic * x * x;
}

/* (2.10): the d with A d + kappa h U'(x + (1 - kappa) d) = r, by Newton's method. */
double solve(double A, double h, double x, double r)
{
    double d = r / A;
    for (int i = 0; i < 50; i++) {
        double S = x + (1 - kappa) * d;
        double J = A + kappa * (1 - kappa) * h * hess(S);
        double change = (r - A * d - kappa * h * grad(S)) / J;
        d += change;
        if (fabs(change) <= 1e-15 * fabs(d))
            break;
    }
    return d;
}

/* (4.2) */
void weights(double order, int count, double *w)
{
    w[0] = 1;
    for (int n = 1; n < count; n++)
        w[n] = w[n - 1] * (n - 1 - order) / n;
}

/* Of the sum (12.1) for the node k + 1: its terms with n >= 1. */
static double past(const double *w, const double *term, int k)
{
    double sum = 0;
    for (int n = 1; n <= k + 1; n++)
        sum += w[n] * term[k + 1 - n];
    return sum;
}

/* (9.4), with the memory summed as in (12.2). */
void integrate(double h, int N, double *x, double *p)
{
    const int increments = 2 * alpha > 1;
    const double nu = 2 * alpha - increments, f = rho * pow(h, 1 - 2 * alpha);
    const double origin = caputo ? x0 : 0; /* (9.6) */
    const double drift = caputo && increments ? h * p0 / m : 0;
    double *term = malloc((size_t)(N + 1) * sizeof *term);
    double *w = malloc((size_t)(N + 1) * sizeof *w);
    weights(nu, N + 1, w);
    x[0] = x0;
    p[0] = p0;
    term[0] = x0 - origin;
    for (int k = 0; k < N; k++) {
        double d = solve(m / h, h, x[k], p[k]);
        x[k + 1] = x[k] + d;
        term[k + 1] = increments ? d - drift : x[k + 1] - origin;
        p[k + 1] = p[k] - h * grad(x[k] + (1 - kappa) * d)
                   - f * (term[k + 1] + past(w, term, k));
    }
    free(term);
    free(w);
}

/* m x'' + rho x' + c x = 0 from x0, p0, for rho^2 < 4 m c. */
double exact(double t)
{
    double s = sqrt(4 * m * c - rho * rho) / (2 * m), rate = rho / (2 * m);
    return exp(-rate * t)
           * (x0 * cos(s * t) + (p0 / m + rate * x0) * sin(s * t) / s);
}

/* How x(2) changes from h to h/2, and the order that this says. */
static void orders(void)
{
    double last = 0, change = 0;
    for (int N = 10; N <= 1280; N *= 2) {
        double *x = malloc((size_t)(2 * (N + 1)) * sizeof *x);
        integrate(2.0 / N, N, x, x + N + 1);
        double now = x[N] - last;
        if (N > 20)
            printf("h = 1/%-4d order %6.3f\n", N / 2, log2(change / now));
        change = now;
        last = x[N];
        free(x);
    }
}

int main(void)
{
    alpha = 0.75;
    for (caputo = 0; caputo <= 1; caputo++) {
        printf(caputo ? "Caputo\n" : "as printed\n");
        orders();
    }
    return 0;
}
