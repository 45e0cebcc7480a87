/* body.c, stage 8: friction. */
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

/* The motion of a mass M for alpha = 1/2, rho^2 < 4 M c, (8c). */
double exact(double M, double t)
{
    double rate = rho / (2 * M), omega = sqrt(c / M - rate * rate);
    return exp(-rate * t)
           * (x0 * cos(omega * t) + (p0 / M + rate * x0) * sin(omega * t) / omega);
}

/* N steps of the integrator: solve (6c), then push by (6d). */
void run(int N)
{
    weights(2 * alpha, N + 1);
    double origin = past == RL ? 0 : x0; /* (7a) */
    double drift = past == CAPUTO && 2 * alpha > 1 ? p0 / m : 0;
    x[0] = x0, p[0] = p0, z[0] = x0 - origin;
    for (int k = 0; k < N; k++) {
        double d = solve(m / h, x[k], p[k]);
        x[k + 1] = x[k] + d;
        z[k + 1] = x[k + 1] - origin - drift * h * (k + 1);
        p[k + 1] = p[k] - h * dU(x[k] + (1 - kappa) * d) + h * F((k + 1) * h)
                   - h * rho * derivative(2 * alpha, k + 1, z);
    }
}

/* The larger of two errors; a run that failed has no small one. */
double worse(double a, double b) { return b > a || isnan(b) ? b : a; }

/* The largest distance from the motion of a mass M, until t = T. */
double error(double T, double M)
{
    int N = (int)(T / h + 0.5);
    double largest = 0;
    run(N);
    for (int k = 0; k <= N; k++)
        largest = worse(largest, fabs(x[k] - exact(M, k * h)));
    return largest;
}

/* Friction without a memory, (8b): how far it is from N steps of the integrator. */
double apart(int N)
{
    double q = x0, v = p0, largest = 0;
    run(N);
    for (int k = 0; k < N; k++) {
        double d = solve(m / h, q, v);
        v -= h * dU(q + (1 - kappa) * d) + rho * d;
        q += d;
        largest = worse(largest, fabs(q - x[k + 1]));
    }
    return largest;
}

int main(void)
{
    static double once[MAX];
    run(140); /* any path will do: the running body */
    weights(0.5, 141);
    for (int k = 0; k <= 140; k++)
        once[k] = derivative(0.5, k, x);
    for (int k = 1; k <= 140; k *= 4)
        printf("k = %2d: twice %.14f, difference %.14f\n", k,
               derivative(0.5, k, once), (x[k] - x[k - 1]) / h);
    alpha = 0.5;
    printf("with and without memory: %.1e apart\n", apart(140));
    for (h = 0.4; h > 0.01; h /= 2)
        printf("h = %-6g mass m: %.6f, mass m - rho h/2: %.6f\n", h,
               error(14, m), error(14, m - rho * h / 2));
}
