/* body.c, stage 2: half a derivative. */
#include <math.h>
#include <stdio.h>

//> head
enum { MAX = 20001 };
double m = 1, c = 1, rho = 0.5, alpha = 0.25; /* the body */
double x0 = 1, p0 = 0, h = 0.1;               /* the run */
double x[MAX], p[MAX], z[MAX], w[MAX];
//< head

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

/* N steps of the body of chapter 1. */
void run(int N)
{
    weights(2 * alpha, N + 1);
    x[0] = x0, p[0] = p0, z[0] = 0;
    for (int k = 0; k < N; k++) {
        x[k + 1] = x[k] + h * (p[k] - h * c * x[k]) / m;
        z[k + 1] = x[k + 1] - x0;
        p[k + 1] = p[k] - h * c * x[k] - h * rho * derivative(2 * alpha, k + 1, z);
    }
}

int main(void)
{
    for (int N = 4; N <= 4096; N *= 4) { /* half a derivative of t, at t = 1 */
        h = 1.0 / N;
        weights(0.5, N + 1);
        for (int k = 0; k <= N; k++)
            z[k] = k * h;
        double half = derivative(0.5, N, z);
        printf("h = 1/%-4d  %.6f  error %9.6f\n", N, half, half - 1 / tgamma(1.5));
    }
    h = 0.1;
    run(140);
    printf("as in chapter 1: x(2.8) = %.15g, x(14) = %.15g\n", x[28], x[140]);
}
