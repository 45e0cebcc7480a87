/* body.c, stage 3: a step from an action. */
#include <math.h>
#include <stdio.h>

//> head
enum { MAX = 20001 };
double m = 1, c = 1, g = 0, rho = 0.5, alpha = 0.25; /* the body */
double x0 = 1, p0 = 0, h = 0.1, kappa = 0.5;         /* the run */
double x[MAX], p[MAX], z[MAX], w[MAX];
//< head

/* The potential, its slope and its curvature. */
double U(double q) { return c * q * q / 2 + g * q * q * q * q / 4; }
double dU(double q) { return c * q + g * q * q * q; }
double ddU(double q) { return c + 3 * g * q * q; }

/* The energy of a body at q with the momentum v. */
double energy(double q, double v) { return v * v / (2 * m) + U(q); }

/* w becomes the first count weights of order b, (2b). */
void weights(double b, int count)
{
    w[0] = 1;
    for (int n = 1; n < count; n++)
        w[n] = w[n - 1] * (n - 1 - b) / n;
}

/* The derivative of order b of a path at the node k, (2c); w holds its weights. */
double derivative(double b, int k, const double *path)
{
    double sum = 0;
    for (int n = 0; n <= k; n++)
        sum += w[n] * path[k - n];
    return pow(h, -b) * sum;
}

/* The d with A d + kappa h U'(q + (1 - kappa) d) = r, (3d), by Newton's method. */
double solve(double A, double q, double r)
{
    double d = r / A;
    for (int i = 0; i < 50; i++) {
        double inside = q + (1 - kappa) * d;
        double change = (r - A * d - kappa * h * dU(inside))
                        / (A + kappa * (1 - kappa) * h * ddU(inside));
        d += change;
        if (fabs(change) <= 1e-15 * fabs(d))
            break;
    }
    return d;
}

/* N steps: move, remember, push. */
void run(int N)
{
    weights(2 * alpha, N + 1);
    x[0] = x0, p[0] = p0, z[0] = 0;
    for (int k = 0; k < N; k++) {
        double d = solve(m / h, x[k], p[k]);
        x[k + 1] = x[k] + d;
        z[k + 1] = x[k + 1] - x0;
        p[k + 1] = p[k] - h * dU(x[k] + (1 - kappa) * d)
                   - h * rho * derivative(2 * alpha, k + 1, z);
    }
}

/* The larger of two errors; a run that failed has no small one. */
double worse(double a, double b) { return b > a || isnan(b) ? b : a; }

/* Euler's method for N steps without damping: the energy at the end. */
double euler(int N)
{
    double q = x0, v = p0;
    for (int k = 0; k < N; k++) {
        double force = -dU(q);
        q += h * v / m;
        v += h * force;
    }
    return energy(q, v);
}

int main(void)
{
    rho = 0; /* no damping: the energy should stay at 1/2 */
    for (int i = 0; i < 3; i++) {
        double steps[] = { 0.1, 0.05, 0.01 };
        h = steps[i];
        printf("Euler, h = %-4g: E(200) = %.5g\n", h, euler((int)(200 / h + 0.5)));
    }
    h = 0.1;
    for (kappa = 0; kappa <= 1; kappa += 0.5) {
        double largest = 0;
        run(2000);
        for (int k = 0; k <= 2000; k++)
            largest = worse(largest, fabs(energy(x[k], p[k]) - 0.5));
        printf("kappa = %.1f: E within %.2g of 1/2\n", kappa, largest);
    }
    kappa = 1, rho = 0.5;
    run(28);
    printf("as in chapter 1: x(2.8) = %.15g\n", x[28]);
}
