/* body.c, stage 10: how wrong, and how long a step. */
#include <math.h>
#include <stdio.h>

//> head
enum { MAX = 20001 };
double m = 1, c = 1, g = 0, rho = 0.5, alpha = 0.25; /* the body */
double x0 = 1, p0 = 0, h = 0.1, kappa = 0.5;         /* the run */
enum { HELD, CAPUTO, RL };
int past = HELD;            /* before t = 0, (7a) */
double push = 0, until = 0; /* a force */
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
    int velocity = 2 * alpha >= 1; /* then z is a velocity, of order 2 alpha - 1, (10d) */
    double b = 2 * alpha - velocity, unit = velocity ? h : 1;
    double origin = past == RL ? 0 : x0; /* (7a) */
    double drift = past == CAPUTO && 2 * alpha > 1 ? p0 / m : 0;
    weights(b, N + 1);
    x[0] = x0, p[0] = p0, z[0] = (x0 - origin) / unit;
    for (int k = 0; k < N; k++) {
        double d = solve(m / h, x[k], p[k]);
        x[k + 1] = x[k] + d;
        z[k + 1] = velocity ? d / h - drift : x[k + 1] - origin;
        p[k + 1] = p[k] - h * dU(x[k] + (1 - kappa) * d) + h * F((k + 1) * h)
                   - h * rho * derivative(b, k + 1, z);
    }
}

/* A quarter of the left side of (10c): a step is stable if this is below 1. */
double load(void)
{
    double a = h * h * c / m * (1 - 2 * kappa) * (1 - 2 * kappa);
    return (a + pow(4, alpha) * rho * pow(h, 2 - 2 * alpha) / m) / 4;
}

/* x at t = T with N steps. */
double at(double T, int N)
{
    h = T / N;
    run(N);
    return x[N];
}

/* The observed orders (10b) of x(2), for five alphas. */
void orders(void)
{
    for (alpha = 0; alpha <= 1; alpha += 0.25) {
        printf("alpha = %-4g orders of x(2):", alpha);
        for (int N = 40; N <= 640; N *= 2) {
            double one = at(2, N), two = at(2, 2 * N), four = at(2, 4 * N);
            printf(" %.3f", log2((one - two) / (two - four)));
        }
        printf("\n");
    }
    alpha = 0.25;
}

int main(void)
{
    orders();
    for (h = 3; h < 3.5; h += 0.1) {
        run(100);
        printf("h = %.1f: load %.4f, x(99 h) = %9.2g, x(100 h) = %9.2g\n", h, load(),
               x[99], x[100]);
    }
}
