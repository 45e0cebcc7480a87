/* stage_1.c -- Chapter 2: one mass on a spring, with friction, by Algorithm 2. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

double m = 1, c = 1, cubic = 0, rho = 0.2, x0 = 1, p0 = 0.5, kappa = 0.5;

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

/* (2.9) with f+ = -rho (x_{k+1} - x_k). */
void integrate(double h, int N, double *x, double *p)
{
    x[0] = x0;
    p[0] = p0;
    for (int k = 0; k < N; k++) {
        double d = solve(m / h, h, x[k], p[k]);
        x[k + 1] = x[k] + d;
        p[k + 1] = p[k] - h * grad(x[k] + (1 - kappa) * d) - rho * d;
    }
}

/* m x'' + rho x' + c x = 0 from x0, p0, for rho^2 < 4 m c. */
double exact(double t)
{
    double s = sqrt(4 * m * c - rho * rho) / (2 * m), rate = rho / (2 * m);
    return exp(-rate * t)
           * (x0 * cos(s * t) + (p0 / m + rate * x0) * sin(s * t) / s);
}

int main(void)
{
    enum { N = 30 };
    double x[N + 1], p[N + 1], h = 0.5;
    integrate(h, N, x, p);
    for (int k = 0; k <= N; k++)
        printf("%4.1f %10.6f %10.6f\n", k * h, x[k], exact(k * h));
    return 0;
}
