/* stage_5.c -- Chapter 8: which mass does it move? */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

double m = 1, c = 1, cubic = 0, rho = 0.2, x0 = 1, p0 = 0.5, kappa = 0.5;
double alpha = 0.5;

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

/* (9.4): the damping is one sum, of order 2 alpha. */
void integrate(double h, int N, double *x, double *p)
{
    double *w = malloc((size_t)(N + 1) * sizeof *w);
    weights(2 * alpha, N + 1, w);
    x[0] = x0;
    p[0] = p0;
    for (int k = 0; k < N; k++) {
        double d = solve(m / h, h, x[k], p[k]), H = 0;
        x[k + 1] = x[k] + d;
        for (int n = 0; n <= k + 1; n++)
            H += w[n] * x[k + 1 - n];
        p[k + 1] = p[k] - h * grad(x[k] + (1 - kappa) * d)
                   - rho * pow(h, 1 - 2 * alpha) * H;
    }
    free(w);
}

/* m x'' + rho x' + c x = 0 from x0, p0, for rho^2 < 4 m c. */
double exact(double t)
{
    double s = sqrt(4 * m * c - rho * rho) / (2 * m), rate = rho / (2 * m);
    return exp(-rate * t)
           * (x0 * cos(s * t) + (p0 / m + rate * x0) * sin(s * t) / s);
}

/* The largest error of x up to t = 15, against the mass less share rho h / 2. */
static double error(double h, double share)
{
    int N = (int)(15 / h);
    double *x = malloc((size_t)(2 * (N + 1)) * sizeof *x), largest = 0;
    integrate(h, N, x, x + N + 1);
    m -= share * rho * h / 2;
    for (int k = 0; k <= N; k++)
        if (!(fabs(x[k] - exact(k * h)) <= largest)) /* NaN counts as large */
            largest = fabs(x[k] - exact(k * h));
    m += share * rho * h / 2;
    free(x);
    return largest;
}

int main(void)
{
    for (double h = 0.5; h > 0.02; h /= 2)
        printf("h = 1/%-3.0f order %6.3f, against the lighter mass %6.3f\n",
               1 / h, log2(error(h, 0) / error(h / 2, 0)),
               log2(error(h, 1) / error(h / 2, 1)));
    return 0;
}
