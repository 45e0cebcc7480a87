/* body.c, stage 6 in DIM coordinates: two bodies and three springs. */
#include <math.h>
#include <stdio.h>

//> head
enum { MAX = 20001, DIM = 2 };
double m[DIM] = { 1, 2 }, rho[DIM] = { 0.5, 0.2 }, alpha = 0.25;
double x0[DIM] = { 1, 0 }, p0[DIM], h = 0.1, kappa = 0.5;
double x[MAX][DIM], p[MAX][DIM], z[MAX][DIM], w[MAX];
//< head

/* U = (x1^2 + x2^2 + (x1 - x2)^4) / 2: its slopes and curvatures. */
void dU(const double *q, double *out)
{
    double s = q[0] - q[1];
    out[0] = q[0] + 2 * s * s * s, out[1] = q[1] - 2 * s * s * s;
}
void ddU(const double *q, double out[DIM][DIM])
{
    double s = q[0] - q[1];
    out[0][0] = out[1][1] = 1 + 6 * s * s, out[0][1] = out[1][0] = -6 * s * s;
}

/* w becomes the first count weights of order b, (2b). */
void weights(double b, int count)
{
    w[0] = 1;
    for (int n = 1; n < count; n++)
        w[n] = w[n - 1] * (n - 1 - b) / n;
}

/* The derivative of order b of the coordinate i of z at the node k, (2c). */
double derivative(double b, int k, int i)
{
    double sum = 0;
    for (int n = 0; n <= k; n++)
        sum += w[n] * z[k - n][i];
    return pow(h, -b) * sum;
}

/* Gauss: r becomes the solution of J d = r. */
void gauss(double J[DIM][DIM], double *r)
{
    for (int i = 0; i < DIM; i++)
        for (int j = i + 1; j < DIM; j++) {
            double factor = J[j][i] / J[i][i];
            for (int l = i; l < DIM; l++)
                J[j][l] -= factor * J[i][l];
            r[j] -= factor * r[i];
        }
    for (int i = DIM - 1; i >= 0; i--) {
        for (int l = i + 1; l < DIM; l++)
            r[i] -= J[i][l] * r[l];
        r[i] /= J[i][i];
    }
}

/* The d with (m/h) d + kappa h dU(q + (1 - kappa) d) = r, (3d); slope becomes that dU. */
void solve(const double *q, const double *r, double *d, double *slope)
{
    double inside[DIM], J[DIM][DIM], change[DIM], size = 1;
    for (int i = 0; i < DIM; i++)
        d[i] = r[i] * h / m[i];
    for (int n = 0; n < 50 && size > 1e-30; n++) {
        for (int i = 0; i < DIM; i++)
            inside[i] = q[i] + (1 - kappa) * d[i];
        dU(inside, slope), ddU(inside, J), size = 0;
        for (int i = 0; i < DIM; i++) {
            change[i] = r[i] - m[i] / h * d[i] - kappa * h * slope[i];
            for (int j = 0; j < DIM; j++)
                J[i][j] = kappa * (1 - kappa) * h * J[i][j] + (i == j) * m[i] / h;
        }
        gauss(J, change);
        for (int i = 0; i < DIM; i++)
            d[i] += change[i], size += change[i] * change[i];
    }
}

/* N steps of the integrator: solve (6c), then push by (6d), coordinate by coordinate. */
void run(int N)
{
    double d[DIM], slope[DIM];
    weights(2 * alpha, N + 1);
    for (int i = 0; i < DIM; i++)
        x[0][i] = x0[i], p[0][i] = p0[i], z[0][i] = 0;
    for (int k = 0; k < N; k++) {
        solve(x[k], p[k], d, slope);
        for (int i = 0; i < DIM; i++) {
            x[k + 1][i] = x[k][i] + d[i];
            z[k + 1][i] = x[k + 1][i] - x0[i];
            p[k + 1][i] = p[k][i] - h * slope[i]
                          - h * rho[i] * derivative(2 * alpha, k + 1, i);
        }
    }
}

int main(void)
{
    run(140);
    printf("x(14) = %.15g %.15g\n", x[140][0], x[140][1]);
}
