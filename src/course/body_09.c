/* body.c, stage 9: the experiments. */
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

/* The largest distance from the motion of a mass M, until t = T, (9a). */
double error(double T, double M)
{
    int N = (int)(T / h + 0.5);
    double largest = 0;
    run(N);
    for (int k = 0; k <= N; k++)
        largest = worse(largest, fabs(x[k] - exact(M, k * h)));
    return largest;
}

/* The slope of the straight line through count points, (9b). */
double slope(int count, const double *X, const double *Y)
{
    double a = 0, b = 0, up = 0, down = 0;
    for (int i = 0; i < count; i++)
        a += X[i] / count, b += Y[i] / count;
    for (int i = 0; i < count; i++)
        up += (X[i] - a) * (Y[i] - b), down += (X[i] - a) * (X[i] - a);
    return up / down;
}

int main(void)
{
    double log_h[5], log_error[5];
    rho = 0.2, p0 = 0.5, h = 0.5, past = RL; /* the paper's oscillator */
    for (int i = 0; i < 7; i++) {
        double alphas[] = { 0, 0.25, 0.4, 0.5, 0.6, 0.75, 1 };
        alpha = alphas[i];
        run(30);
        printf("alpha = %-4g  x(15) = %9.6f\n", alpha, x[30]);
    }
    alpha = 0.5, h = 0.1;
    for (int i = 0; i < 5; i++, h /= 2) {
        log_h[i] = log(h), log_error[i] = log(error(15, m));
        printf("h = %-7g error %.6f\n", h, exp(log_error[i]));
    }
    printf("order %.3f, and of the last two %.3f\n", slope(5, log_h, log_error),
           slope(2, log_h + 3, log_error + 3));
    alpha = 0.75, rho = 1, x0 = p0 = 0, push = 8, until = 1; /* Bagley, Torvik */
    for (h = 0.1; h > 0.006; h /= 2) {
        run((int)(20 / h + 0.5));
        printf("h = %-7g x(5) = %.6f\n", h, x[(int)(5 / h + 0.5)]);
    }
}
