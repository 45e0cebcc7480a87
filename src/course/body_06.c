/* body.c, stage 6: the integrator. */
#include <math.h>
#include <stdio.h>

//> head
enum { MAX = 20001 };
double m = 1, c = 1, g = 0, rho = 0.5, alpha = 0.25; /* the body */
double x0 = 1, p0 = 0, h = 0.1, kappa = 0.5;         /* the run */
double push = 0, until = 0;                          /* a force */
double x[MAX], p[MAX], z[MAX], w[MAX];
//< head

/* The potential, its slope and its curvature. */
double U(double q) { return c * q * q / 2 + g * q * q * q * q / 4; }
double dU(double q) { return c * q + g * q * q * q; }
double ddU(double q) { return c + 3 * g * q * q; }

/* The force: push until the time until, then nothing. */
double F(double t) { return t <= until ? push : 0; }

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

/* N steps of the integrator: solve (6c), then push by (6d). */
void run(int N)
{
    weights(2 * alpha, N + 1);
    x[0] = x0, p[0] = p0, z[0] = 0; /* held at x0 until t = 0 */
    for (int k = 0; k < N; k++) {
        double d = solve(m / h, x[k], p[k]);
        x[k + 1] = x[k] + d;
        z[k + 1] = x[k + 1] - x0;
        p[k + 1] = p[k] - h * dU(x[k] + (1 - kappa) * d) + h * F((k + 1) * h)
                   - h * rho * derivative(2 * alpha, k + 1, z);
    }
}

int main(void)
{
    h = 1, kappa = 1; /* the steps that we did by hand */
    run(5);
    for (int k = 0; k <= 5; k++)
        printf("%d  x = %8.5f  p = %8.5f\n", k, x[k], p[k]);
    h = 0.1, kappa = 0.5; /* the running body, for seven orders */
    for (int i = 0; i < 7; i++) {
        double alphas[] = { 0, 0.25, 0.4, 0.5, 0.6, 0.75, 1 };
        alpha = alphas[i];
        run(140);
        printf("alpha = %-4g  x(7) = %.15g  x(14) = %.15g\n", alpha, x[70], x[140]);
    }
}
