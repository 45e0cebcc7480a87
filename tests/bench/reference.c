/* tests/bench/reference.c -- Compute the reference for the methods: problems.h. [H 18] */
#include "problems.h"
#include "system/larger.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_NODES = 20 };
typedef long double real;

typedef struct {
    const problem *p;
    size_t d, panels;
    int n;
    real gamma, unit; /* 2 - beta, 1 / Gamma(gamma) */
    real c[MOST_NODES], b[MOST_NODES], bary[MOST_NODES];
    real A[MOST_NODES][MOST_NODES], B[MOST_NODES][MOST_NODES];
    real *t;         /* the starts of the panels, and T */
    real *V, *X, *P; /* panels n d; panels n d; d: v, x, J(F - grad U) so far */
    real *x, *g, *H, *G; /* d; n d each */
    double *point, *grad, *F;
} collocation;

/* Compute Gauss's nodes and weights on [0, 1], and the barycentric weights. */
static void gauss(int n, real *c, real *b)
{
    const real pi = acosl(-1);
    for (int i = 0; i < n; i++) {
        real z = cosl(pi * ((real)(n - i) - 0.25L) / ((real)n + 0.5L)),
             slope = 1;
        for (int k = 0; k < 20; k++) {
            real p = 1, q = 0;
            for (int j = 1; j <= n; j++) {
                real r = ((2 * j - 1) * z * p - (j - 1) * q) / j;
                q = p;
                p = r;
            }
            slope = n * (z * p - q) / (z * z - 1);
            z -= p / slope;
        }
        c[i] = (1 + z) / 2;
        b[i] = 1 / ((1 - z * z) * slope * slope);
    }
}

/* Compute the polynomials l_j of the nodes at s. */
static void lagrange(const collocation *o, real s, real *l)
{
    real sum = 0;
    for (int j = 0; j < o->n; j++)
        if (s == o->c[j]) {
            for (int i = 0; i < o->n; i++)
                l[i] = i == j;
            return;
        }
    for (int j = 0; j < o->n; j++)
        sum += l[j] = o->bary[j] / (s - o->c[j]);
    for (int j = 0; j < o->n; j++)
        l[j] /= sum;
}

/* Return u^e for u > 0 with an error of some units of rounding. powl has an error of one unit, but takes six
 * times as long. */
static real power(real u, real e)
{
    return exp2l(e * log2l(u));
}

/* w_j += the integral of u^{gamma-1} l_j(t - u) over near <= u <= far. The range is halved where 0 is too near,
 * and left out where it is below rounding. */
static void moments(const collocation *o, real t, real near, real far, real *w)
{
    const real length = far - near;
    if (near == 0 && powl(far, o->gamma) < 1e-22L)
        return;
    if (near < length) {
        moments(o, t, near, near + length / 2, w);
        moments(o, t, near + length / 2, far, w);
        return;
    }
    for (int g = 0; g < o->n; g++) {
        const real u = near + length * o->c[g],
                   k = length * o->b[g] * power(u, o->gamma - 1);
        real l[MOST_NODES];
        lagrange(o, t - u, l);
        for (int j = 0; j < o->n; j++)
            w[j] += k * l[j];
    }
}

static void tables(collocation *o)
{
    gauss(o->n, o->c, o->b);
    for (int j = 0; j < o->n; j++) {
        o->bary[j] = 1;
        for (int i = 0; i < o->n; i++)
            if (i != j)
                o->bary[j] /= o->c[j] - o->c[i];
    }
    for (int i = 0; i < o->n; i++) {
        for (int g = 0; g < o->n; g++) {
            real l[MOST_NODES];
            lagrange(o, o->c[i] * o->c[g], l);
            for (int j = 0; j < o->n; j++)
                o->A[i][j] += o->c[i] * o->b[g] * l[j];
        }
        moments(o, o->c[i], 0, o->c[i], o->B[i]);
    }
}

/* Make the panels, which double from 0 and from the jump on. Return their number. */
static size_t mesh(const problem *p, real longest, real *t)
{
    const real ends[] = { p->jump > 0 ? p->jump : p->T, p->T };
    size_t k = 0;
    real now = 0;
    for (int e = 0; e < 2; e++)
        for (real h = 1e-6L * longest; now < ends[e];
             h = fminl(2 * h, longest)) {
            if (t)
                t[k] = now;
            k++;
            now = now + 1.5L * h > ends[e] ? ends[e] : now + h;
        }
    if (t)
        t[k] = now;
    return k;
}

/* Compute H at node i of panel k, from all panels before k. */
static void history(collocation *o, size_t k, int i)
{
    const size_t d = o->d;
    const int n = o->n;
    const real h = o->t[k + 1] - o->t[k], t = o->t[k] + h * o->c[i];
    for (size_t l = 0; l < k; l++) {
        const real length = o->t[l + 1] - o->t[l],
                   *V = o->V + l * (size_t)n * d,
                   scale = powl(length, o->gamma);
        real w[MOST_NODES] = { 0 };
        const real at = (t - o->t[l]) / length;
        if (at < 2)
            moments(o, at, at - 1, at, w);
        else /* as there, at once: Gauss's nodes are those of l_j */
            for (int j = 0; j < n; j++)
                w[j] = o->b[j] * power(at - o->c[j], o->gamma - 1);
        for (int j = 0; j < n; j++)
            for (size_t a = 0; a < d; a++)
                o->H[(size_t)i * d + a] += scale * w[j] * V[(size_t)j * d + a];
    }
}

/* Compute G = F - grad U at all nodes of panel k, and the positions from V. */
static int evaluate_forces(collocation *o, size_t k, const real *V, real *X)
{
    const size_t d = o->d;
    const int n = o->n;
    const real h = o->t[k + 1] - o->t[k];
    const fvi_system *s = &o->p->system;
    for (int i = 0; i < n; i++) {
        real *Xi = X + (size_t)i * d;
        memcpy(Xi, o->x, d * sizeof *Xi);
        for (int j = 0; j < n; j++)
            for (size_t a = 0; a < d; a++)
                Xi[a] += h * o->A[i][j] * V[(size_t)j * d + a];
        for (size_t a = 0; a < d; a++)
            o->point[a] = (double)Xi[a];
        int status = fvi_potential_gradient(s, o->point, o->grad);
        memset(o->F, 0, d * sizeof *o->F);
        if (!status && s->force.value)
            status = s->force.value((double)(o->t[k] + h * o->c[i]), d,
                                    s->force.params, o->F);
        if (status)
            return status;
        for (size_t a = 0; a < d; a++)
            o->G[(size_t)i * d + a] = o->F[a] - o->grad[a];
    }
    return FVI_SUCCESS;
}

/* Make one Picard iteration on panel k. *moved: the change of V, divided by its size. */
static int iterate(collocation *o, size_t k, real *V, real *X, real *moved)
{
    const size_t d = o->d;
    const int n = o->n;
    const problem *p = o->p;
    const real h = o->t[k + 1] - o->t[k], own = powl(h, o->gamma) * o->unit;
    const real s = p->alpha > 0.5, t0 = o->t[k];
    real largest = 1;
    *moved = 0;
    int status = evaluate_forces(o, k, V, X);
    memcpy(o->g, V, (size_t)n * d * sizeof *V);
    for (int i = 0; i < n && !status; i++)
        for (size_t a = 0; a < d; a++) {
            const real m = p->system.mass[a], rho = p->system.damping[a],
                       v0 = p->p0[a] / m, t = t0 + h * o->c[i];
            real sum =
                m * v0 + o->P[a] - rho * o->unit * o->H[(size_t)i * d + a]
                + rho * s * v0 * powl(t, o->gamma) / tgammal(o->gamma + 1);
            for (int j = 0; j < n; j++)
                sum += h * o->A[i][j] * o->G[(size_t)j * d + a]
                       - (i == j ? 0
                                 : rho * own * o->B[i][j]
                                       * o->g[(size_t)j * d + a]);
            const real new = sum / (m + rho * own * o->B[i][i]);
            *moved = larger((double)*moved,
                            (double)fabsl(new - V[(size_t)i * d + a]));
            largest = larger((double)largest, (double)fabsl(new));
            V[(size_t)i * d + a] = new;
        }
    *moved /= largest;
    return status;
}

/* Write the rows within panel k. x is a polynomial through its start and the nodes. */
static void write_rows(const collocation *o, size_t k, const real *X,
                       double *rows)
{
    const size_t d = o->d;
    const real h = o->t[k + 1] - o->t[k];
    for (size_t r = 0; r <= ROWS; r++) {
        const real s = ((real)o->p->T * (real)r / ROWS - o->t[k]) / h;
        if (s < 0 || (s >= 1 && r < ROWS) || (r == ROWS && k + 1 < o->panels))
            continue;
        real l[MOST_NODES],
            first = 1; /* first: the polynomial that is 1 at 0 */
        lagrange(o, s, l);
        for (int j = 0; j < o->n; j++)
            first *= 1 - s / o->c[j];
        for (size_t a = 0; a < d; a++) {
            real sum = first * o->x[a];
            for (int j = 0; j < o->n; j++)
                sum += s / o->c[j] * l[j] * X[(size_t)j * d + a];
            rows[r * d + a] = (double)sum;
        }
    }
}

static int solve_panel(collocation *o, size_t k, double *rows)
{
    const size_t d = o->d, nd = (size_t)o->n * d;
    const real h = o->t[k + 1] - o->t[k];
    real *V = o->V + k * nd, *X = o->X, moved = 1;
    memset(o->H, 0, nd * sizeof *o->H);
    for (int i = 0; i < o->n; i++) {
        history(o, k, i);
        for (size_t a = 0; a < d; a++) /* the first guess is the last velocity */
            V[(size_t)i * d + a] =
                k ? *(V + a - d) : o->p->p0[a] / o->p->system.mass[a];
    }
    for (int i = 0, after = 0; after < 2; i++) {
        int status = iterate(o, k, V, X, &moved);
        if (status || i == 400 || moved != moved)
            return status ? status : FVI_EMAXITER;
        after += moved < 1e-15L; /* the last digit of grad U, a double, moves a light mass by this much */
    }
    int status = evaluate_forces(o, k, V, X);
    write_rows(o, k, X, rows);
    for (int j = 0; j < o->n; j++)
        for (size_t a = 0; a < d; a++) {
            o->x[a] += h * o->b[j] * V[(size_t)j * d + a];
            o->P[a] += h * o->b[j] * o->G[(size_t)j * d + a];
        }
    return status;
}

int reference(const problem *p, int nodes, double panel, double *rows)
{
    const size_t d = p->system.d, n = (size_t)nodes,
                 panels = mesh(p, panel, NULL);
    collocation o = { .p = p, .d = d, .panels = panels, .n = nodes };
    o.gamma = 2 - 2 * (real)p->alpha;
    o.unit = 1 / tgammal(o.gamma);
    tables(&o);
    o.t = calloc(panels + 1 + (panels + 4) * n * d + 2 * d, sizeof *o.t);
    o.point = calloc(3 * d, sizeof *o.point);
    int status = o.t && o.point ? FVI_SUCCESS : FVI_ENOMEM;
    if (!status) {
        o.V = o.t + panels + 1;
        o.X = o.V + panels * n * d;
        o.g = o.X + n * d;
        o.H = o.g + n * d;
        o.G = o.H + n * d;
        o.P = o.G + n * d;
        o.x = o.P + d;
        o.grad = o.point + d;
        o.F = o.grad + d;
        mesh(p, panel, o.t);
        for (size_t a = 0; a < d; a++)
            o.x[a] = rows[a] = p->x0[a];
    }
    for (size_t k = 0; k < panels && !status; k++)
        status = solve_panel(&o, k, rows);
    free(o.t);
    free(o.point);
    return status;
}
