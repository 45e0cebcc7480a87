/* body.c, stage 4: a second body. */
#include <math.h>
#include <stdio.h>

//> head
enum { MAX = 20001 };
double m = 1, c = 1, g = 0, rho = 0.5, alpha = 0.25; /* the body */
double x0 = 1, p0 = 0, h = 0.1, kappa = 0.5;         /* the run */
double x[MAX], p[MAX], y[MAX], z[MAX], u[MAX], w[MAX];
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

/* The same looking ahead, from the node k to the end N, (4a). */
double ahead(double b, int k, int N, const double *path)
{
    double sum = 0;
    for (int n = 0; n <= N - k; n++)
        sum += w[n] * path[k + n];
    return pow(h, -b) * sum;
}

/* The action of one step, from q to next, (3b). */
double lagrangian(double q, double next)
{
    double d = next - q;
    return m * d * d / (2 * h) - h * U(kappa * q + (1 - kappa) * next);
}

/* The action of two bodies, (4c), as a sum over the nodes 0 to N. */
double action(int N, const double *X, const double *Y)
{
    double S = 0;
    weights(alpha, N + 1);
    for (int k = 0; k <= N; k++)
        z[k] = X[k] - X[0], u[k] = Y[k] - Y[N];
    for (int k = 0; k < N; k++)
        S += lagrangian(X[k], X[k + 1]) + lagrangian(Y[k], Y[k + 1]);
    for (int k = 0; k <= N; k++)
        S -= h * rho * derivative(alpha, k, z) * ahead(alpha, k, N, u);
    return S;
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

/* The action when a bump is added, a times to x and b times to y. */
double bent(int N, double a, double b)
{
    static double X[MAX], Y[MAX];
    for (int k = 0; k <= N; k++) {
        double s = (double)k / N, bump = 4 * s * s * (1 - s);
        X[k] = x[k] + a * bump, Y[k] = y[k] + b * bump;
    }
    return action(N, X, Y);
}

/* The slope of the action at e = 0 when e a bumps are added to x and e b to y. */
double slope(int N, double a, double b)
{
    double e = 1e-4;
    return (bent(N, e * a, e * b) - bent(N, -e * a, -e * b)) / (2 * e);
}

int main(void)
{
    enum { N = 100 };
    run(N);
    for (int k = 0; k <= N; k++)
        y[k] = x[N - k]; /* the mirror */
    printf("    e     S(x+e, y+e)    S(x+e, y)\n");
    for (int i = -2; i <= 2; i++) {
        double e = i / 10.0;
        printf("%5.1f  %12.8f  %12.8f\n", e, bent(N, e, e), bent(N, e, 0));
    }
    printf("slopes at e = 0: %.1e and %.6f\n", slope(N, 1, 1), slope(N, 1, 0));
    c = 0, alpha = 0.5; /* another pair: x = t, y = t - 1 on [0, 1], no spring */
    h = 1.0 / N;
    for (int k = 0; k <= N; k++)
        x[k] = k * h, y[k] = k * h - 1;
    printf("x = t, y = t - 1: slopes %.1e and %.6f\n", slope(N, 1, 1), slope(N, 1, 0));
}
