/* stage_9.c -- Chapter 13: order 2, by damping half a step later. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double m = 1, c = 1, cubic = 0, rho = 0.2, x0 = 1, p0 = 0.5, kappa = 0.5;
double alpha = 0.5;
int caputo = 0, fast = 0, second = 0;

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

/* (12.5) by the trapezoid rule in log s; it serves the lags from WINDOW + 1 on. */
enum { WINDOW = 32, MODES = 500 };
static int modes;
static double decay[MODES], share[MODES], z[MODES];

static void make_modes(double nu, int N)
{
    const double L = log(1e12), step = 9 / L;
    modes = 0;
    for (double t = -log(N) - L; t < log(L / WINDOW) + 1; t += step) {
        double s = exp(t), size = -sin(M_PI * nu) / M_PI * s * step;
        decay[modes] = exp(-s);
        share[modes] = size * pow(expm1(s), nu) * exp(-(WINDOW + 1) * s);
        z[modes++] = 0;
    }
}

/* Of the sum (12.1) for the node k + 1: its terms with n >= 1. */
static double past(const double *w, const double *term, int k)
{
    double sum = 0;
    int near = fast && k + 1 > WINDOW ? WINDOW : k + 1;
    for (int n = 1; n <= near; n++)
        sum += w[n] * term[k + 1 - n];
    if (near == k + 1)
        return sum;
    for (int q = 0; q < modes; q++) {
        z[q] = decay[q] * z[q] + term[k - WINDOW];
        sum += share[q] * z[q];
    }
    return sum;
}

/* (9.4), and with second != 0 (13.10). */
void integrate(double h, int N, double *x, double *p)
{
    const int increments = 2 * alpha > 1; /* (12.2) */
    const double nu = 2 * alpha - increments, f = rho * pow(h, 1 - 2 * alpha);
    const double theta = second ? alpha : 0, old = second ? 0.5 - alpha : 0;
    const double origin = caputo ? x0 : 0; /* (9.6) */
    const double drift = caputo && increments ? h * p0 / m : 0;
    const int count = fast ? WINDOW + 1 : N + 1;
    double *term = malloc((size_t)(N + 1) * sizeof *term);
    double *w = malloc((size_t)count * sizeof *w);
    weights(nu, count, w);
    make_modes(nu, N);
    x[0] = x0;
    p[0] = p0;
    double H = term[0] = x0 - origin;
    for (int k = 0; k < N; k++) {
        double ahead = past(w, term, k) - drift;
        if (!increments)
            ahead += x[k] - origin;
        double r = p[k] - f * (old * H + theta * ahead);
        double d = solve(m / h + theta * f, h, x[k], r);
        x[k + 1] = x[k] + d;
        term[k + 1] = increments ? d - drift : x[k + 1] - origin;
        p[k + 1] = p[k] - h * grad(x[k] + (1 - kappa) * d) - f * old * H;
        H = ahead + d;
        p[k + 1] -= f * (1 - old) * H;
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

/* The data of the first figure. */
static void figure(void)
{
    enum { N = 30, FINE = 300 };
    const double alphas[] = { 0, 0.25, 0.4, 0.5, 0.6, 0.75, 1 }, h = 0.5;
    double x[N + 1], p[N + 1];
    printf("t \"exact, α = 0.5\"\n");
    for (int k = 0; k <= FINE; k++)
        printf("%.17g %.17g\n", k * (N * h / FINE), exact(k * (N * h / FINE)));
    for (int i = 0; i < 7; i++) {
        alpha = alphas[i];
        integrate(h, N, x, p);
        printf("\n\nt \"α = %g\"\n", alpha);
        for (int k = 0; k <= N; k++)
            printf("%.17g %.17g\n", k * h, x[k]);
    }
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

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "figure") == 0) {
        figure();
        return 0;
    }
    caputo = second = 1;
    for (alpha = 0; alpha <= 1; alpha += 0.25) {
        printf("alpha = %g\n", alpha);
        orders();
    }
    return 0;
}
