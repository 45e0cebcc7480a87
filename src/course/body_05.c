/* body.c, stage 5: the equation in the action. */
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

/* The residual of one body at the node k, (5d). */
double residual(int N, int k, const double *path)
{
    weights(2 * alpha, N + 1);
    for (int j = 0; j <= k; j++)
        z[j] = path[j] - path[0];
    return m * (2 * path[k] - path[k - 1] - path[k + 1]) / h
           - h * kappa * dU(kappa * path[k] + (1 - kappa) * path[k + 1])
           - h * (1 - kappa) * dU(kappa * path[k - 1] + (1 - kappa) * path[k])
           - h * rho * derivative(2 * alpha, k, z);
}

/* How the action changes when the node k of both bodies is moved. */
double change(int N, int k)
{
    double e = 1e-4, S[2];
    for (int i = 0; i < 2; i++) {
        double move = i == 0 ? e : -e;
        x[k] += move, y[k] += move;
        S[i] = action(N, x, y);
        x[k] -= move, y[k] -= move;
    }
    return (S[0] - S[1]) / (2 * e);
}

/* The change of the action beside the two residuals, at every third node. */
void table(const char *name, int N)
{
    static double mirror[MAX];
    printf("%s\n k   change of S   residual of x   of y\n", name);
    for (int j = 0; j <= N; j++)
        mirror[j] = y[N - j];
    for (int k = 1; k < N; k += 3)
        printf("%2d  %11.1e %13.1e %11.1e\n", k, change(N, k), residual(N, k, x),
               residual(N, N - k, mirror));
}

int main(void)
{
    enum { N = 20 };
    h = 0.5;
    for (int k = 0; k <= N; k++)
        x[k] = cos(k), y[k] = k * (N - k) / 100.0; /* made up */
    table("any two paths", N);
    run(N);
    for (int k = 0; k <= N; k++)
        y[k] = x[N - k];
    table("the run and its mirror", N);
}
