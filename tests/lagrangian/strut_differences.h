/* tests/lagrangian/strut_differences.h -- The body on a strut of stage 13, by differences of its
 * equations of motion instead of an action.                       [chapters/further/29-lagrangian.md]
 *
 *     m x' = p,    p' = -grad U(x) - lambda grad g(x),    lambda = rho D^{2 alpha} (g(x) - g(x_0)),
 *
 * where each ' is a difference of BDF2 (the first one of Euler), and D a power of the same
 * difference. So the damper has the weights of stage 13, the order is 2, too, and a step solves as
 * many equations. Include this after course/body_13.c, whose body, step and weights it uses. */
#ifndef STRUT_DIFFERENCES_H
#define STRUT_DIFFERENCES_H

static double x_differenced[MAX][DIM], p_differenced[MAX][DIM], z_differenced[MAX];

/* The difference for y' at the node k is (a y_k - b)/h. These are a, and b for the coordinate i. */
static double a_of(int k) { return k == 1 ? 1 : 1.5; }
static double b_of(int k, double y[MAX][DIM], int i)
{
    return k == 1 ? y[0][i] : 2 * y[k - 1][i] - y[k - 2][i] / 2;
}

/* r becomes what is missing in the equation for p' if the node k is at q, and J the slopes of -r;
 * past is the sum of the damper over the nodes before. */
static void residual(int k, const double *q, double past, double *r, double J[DIM][DIM])
{
    double a = a_of(k) / h, first = rho * pow(h, -2 * alpha) * w[0], e[DIM], start[DIM];
    double length = elongation(0, q, e);
    z_differenced[k] = length - elongation(0, x0, start);
    double lambda = past + first * z_differenced[k];
    dU(q, r), ddU(q, J);
    for (int i = 0; i < DIM; i++) {
        p_differenced[k][i] = m[i] * (a * q[i] - b_of(k, x_differenced, i) / h);
        r[i] = b_of(k, p_differenced, i) / h - a * p_differenced[k][i] - r[i] - lambda * e[i];
        for (int l = 0; l < DIM; l++)
            J[i][l] += (i == l) * (m[i] * a * a + lambda / length)
                       + (first - lambda / length) * e[i] * e[l];
    }
}

/* N steps with the strut, by Newton's method from a straight line. */
static void run_differences(int N)
{
    weights(2 * alpha, N + 1);
    for (int i = 0; i < DIM; i++)
        x_differenced[0][i] = x0[i], p_differenced[0][i] = p0[i];
    for (int k = 1; k <= N; k++) {
        double past = 0, size = 1, q[DIM], r[DIM], J[DIM][DIM];
        for (int n = 1; n < k; n++)
            past += rho * pow(h, -2 * alpha) * w[n] * z_differenced[k - n];
        for (int i = 0; i < DIM; i++)
            q[i] = x_differenced[k - 1][i] + h * p_differenced[k - 1][i] / m[i];
        for (int n = 0; n < 50 && size > 1e-30; n++) {
            residual(k, q, past, r, J), gauss(J, r);
            size = 0;
            for (int i = 0; i < DIM; i++)
                q[i] += r[i], size += r[i] * r[i];
        }
        residual(k, q, past, r, J);
        for (int i = 0; i < DIM; i++)
            x_differenced[k][i] = q[i];
    }
}

/* The energy and the angular momentum at the node k. */
static double energy_differenced(int k)
{
    double sum = U(x_differenced[k]);
    for (int i = 0; i < DIM; i++)
        sum += p_differenced[k][i] * p_differenced[k][i] / (2 * m[i]);
    return sum;
}
static double turning_differenced(int k)
{
    return x_differenced[k][0] * p_differenced[k][1] - x_differenced[k][1] * p_differenced[k][0];
}
#endif
