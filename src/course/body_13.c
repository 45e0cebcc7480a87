/* body.c, stage 13: a damper along any length. */
#include <math.h>
#include <stdio.h>

//> head
enum { MAX = 20001, DIM = 2, MOST = 2 };
double m[DIM] = { 1, 1 }, rho = 0.1, alpha = 0.3; /* the body, and each damper */
double x0[DIM] = { 1.2, 0 }, p0[DIM] = { 0.3, 0.8 }, h = 0.05;
int strut = 1; /* one damper along the spring; 0: one along each axis */
double x[MAX][DIM], p[MAX][DIM], w[MAX];
double z[MOST][MAX], mean[MOST][MAX], work[MAX]; /* of the dampers */
//< head

/* A spring from the origin to the body: U = 2 (r - 1)^2, its slopes and curvatures. */
double U(const double *q) { return 2 * pow(hypot(q[0], q[1]) - 1, 2); }
void dU(const double *q, double *out)
{
    double r = hypot(q[0], q[1]);
    out[0] = 4 * (r - 1) * q[0] / r, out[1] = 4 * (r - 1) * q[1] / r;
}
void ddU(const double *q, double out[DIM][DIM])
{
    double r = hypot(q[0], q[1]);
    for (int i = 0; i < DIM; i++)
        for (int j = 0; j < DIM; j++)
            out[i][j] = 4 * ((i == j) * (1 - 1 / r) + q[i] * q[j] / (r * r * r));
}

/* The elongation g of the damper j at q; out becomes its slopes. */
double elongation(int j, const double *q, double *out)
{
    double r = hypot(q[0], q[1]);
    for (int i = 0; i < DIM; i++)
        out[i] = strut ? q[i] / r : i == j;
    return strut ? r : q[j];
}

/* The energy and the angular momentum at the node k. */
double energy(int k)
{
    double sum = U(x[k]);
    for (int i = 0; i < DIM; i++)
        sum += p[k][i] * p[k][i] / (2 * m[i]);
    return sum;
}
double turning(int k) { return x[k][0] * p[k][1] - x[k][1] * p[k][0]; }

/* w becomes the first count weights of BDF2, the coefficients of (3/2 - 2 s + s^2/2)^b. */
void weights(double b, int count)
{
    w[0] = pow(1.5, b);
    for (int n = 1; n < count; n++)
        w[n] = (4 * (n - 1 - b) * w[n - 1] + (n > 1 ? (2 * b - n + 2) * w[n - 2] : 0))
               / (3 * n);
}

/* What the damper j remembers in the step from k, without that step. */
double recall(int j, int k)
{
    double sum = 0;
    for (int n = 1; n <= k; n++)
        sum += w[n] * mean[j][k - n];
    return rho * pow(h, -2 * alpha) * sum;
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

/* The damper j in the step from k to q takes half of its impulse from r, at k, and half from
 * end, at q; J becomes stiffer. */
void add_damper(int j, int k, const double *q, double known, double *r, double *end,
                double J[DIM][DIM])
{
    double a[DIM], b[DIM], first = rho * pow(h, -2 * alpha) * w[0];
    z[j][k] = elongation(j, x[k], a), z[j][k + 1] = elongation(j, q, b);
    mean[j][k] = (z[j][k] + z[j][k + 1]) / 2 - z[j][0];
    double force = known + first * mean[j][k];
    for (int i = 0; i < DIM; i++) {
        r[i] -= h / 2 * force * a[i], end[i] -= h / 2 * force * b[i];
        for (int l = 0; l < DIM; l++)
            J[i][l] += h / 4 * first * a[i] * b[l];
    }
    work[k + 1] += force * (z[j][k + 1] - z[j][k]);
}

/* The step from the node k, (29.6): solve the first line for x, then the second gives p. */
void step(int k)
{
    int dampers = strut ? 1 : DIM;
    double known[MOST], d[DIM], q[DIM], inside[DIM], J[DIM][DIM], r[DIM], size = 1;
    for (int j = 0; j < dampers; j++)
        known[j] = recall(j, k);
    for (int i = 0; i < DIM; i++)
        d[i] = h * p[k][i] / m[i];
    for (int n = 0; n < 50 && size > 1e-30; n++) {
        for (int i = 0; i < DIM; i++)
            q[i] = x[k][i] + d[i], inside[i] = x[k][i] + d[i] / 2;
        dU(inside, r), ddU(inside, J);
        for (int i = 0; i < DIM; i++) {
            p[k + 1][i] = m[i] / h * d[i] - h / 2 * r[i];
            r[i] = p[k][i] - m[i] / h * d[i] - h / 2 * r[i];
            for (int l = 0; l < DIM; l++)
                J[i][l] = h / 4 * J[i][l] + (i == l) * m[i] / h;
        }
        work[k + 1] = work[k], size = 0;
        for (int j = 0; j < dampers; j++)
            add_damper(j, k, q, known[j], r, p[k + 1], J);
        gauss(J, r);
        for (int i = 0; i < DIM; i++)
            d[i] += r[i], size += r[i] * r[i];
    }
    for (int i = 0; i < DIM; i++)
        x[k + 1][i] = x[k][i] + d[i];
}

/* N steps. */
void run(int N)
{
    weights(2 * alpha, N + 1);
    for (int i = 0; i < DIM; i++)
        x[0][i] = x0[i], p[0][i] = p0[i];
    for (int k = 0; k < N; k++)
        step(k);
}

int main(void)
{
    for (strut = 1; strut >= 0; strut--) {
        run(1200);
        printf("%s\n   t   energy  energy + work  change of the angular momentum\n",
               strut ? "along the spring" : "along the axes");
        for (int k = 0; k <= 1200; k += 240)
            printf("%4.0f %8.4f %14.4f %31.1e\n", k * h, energy(k), energy(k) + work[k],
                   turning(k) - turning(0));
    }
}
