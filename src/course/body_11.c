/* body.c, stage 11: a million steps. */
#include <math.h>
#include <stdio.h>
#include <time.h>

//> head
enum { MAX = 1000001, NEAR = 32, MODES = 200 };
double m = 1, c = 1, g = 0, rho = 0.5, alpha = 0.25; /* the body */
double x0 = 1, p0 = 0, h = 0.1, kappa = 0.5;         /* the run */
enum { HELD, CAPUTO, RL };
int past = HELD;            /* before t = 0, (7a) */
double push = 0, until = 0; /* a force */
double x[MAX], p[MAX], z[MAX], w[MAX];
int fast = 0, modes; /* exponentials in the place of old weights, (11b) */
double decay[MODES], share[MODES], mode[MODES];
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

/* (11b) by the trapezoid rule in log s, for the lags beyond NEAR. */
void make_modes(double b, int N)
{
    double pi = acos(-1);
    modes = 0;
    for (double log_s = -log(N) - 28; log_s < 1; log_s += 0.3) {
        double s = exp(log_s);
        decay[modes] = exp(-s);
        share[modes] = -sin(pi * b) / pi * 0.3 * s * pow(expm1(s), b)
                       * exp(-(NEAR + 1) * s);
        mode[modes++] = 0;
    }
}

/* The derivative at the node k: the weights up to the lag NEAR, and the rest by (11c). */
double recall(double b, int k, const double *path)
{
    double sum = 0;
    for (int n = 0; n <= k && n <= NEAR; n++)
        sum += w[n] * path[k - n];
    if (k > NEAR)
        for (int q = 0; q < modes; q++) {
            mode[q] = decay[q] * mode[q] + path[k - NEAR - 1];
            sum += share[q] * mode[q];
        }
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
    make_modes(b, N);
    x[0] = x0, p[0] = p0, z[0] = (x0 - origin) / unit;
    for (int k = 0; k < N; k++) {
        double d = solve(m / h, x[k], p[k]);
        x[k + 1] = x[k] + d;
        z[k + 1] = velocity ? d / h - drift : x[k + 1] - origin;
        p[k + 1] = p[k] - h * dU(x[k] + (1 - kappa) * d) + h * F((k + 1) * h)
                   - h * rho * (fast ? recall(b, k + 1, z) : derivative(b, k + 1, z));
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

/* The time of the processor, in seconds. */
double seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

int main(void)
{
    for (int N = 20000; N <= 1000000; N *= 50)
        for (fast = N > 20000 ? 1 : 0; fast <= 1; fast++) {
            double start = seconds(), end = at(20, N);
            printf("%d steps, %s: x(20) = %.13f, %.3f s\n", N, fast ? "modes" : "sums ",
                   end, seconds() - start);
        }
    printf("%d modes\n", modes);
}
