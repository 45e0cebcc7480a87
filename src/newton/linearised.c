/* src/newton/linearised.c -- Take the steps of a linearised run, which is the derivative of another run.  [H 23] */
#include "linearised.h"

#include "system/fail.h"

#include <string.h>

fvi_linearised fvi_linearised_begin(const fvi_system *system, size_t stages)
{
    return (fvi_linearised){ .d = system->d,
                             .diagonals = system->potential.diagonals,
                             .size = system->potential.hessian
                                         ? fvi_potential_hessian_size(system)
                                         : 0,
                             .stages = stages };
}

static const double *hessian_of_stage(const fvi_linearised *l)
{
    return l->G
           + (l->reversed ? l->stages - 1 - l->stage : l->stage) * l->size;
}

/* Compute g = G x from the stored diagonals of G. */
static void multiply_band(size_t d, size_t w, const double *restrict G,
                          const double *restrict x, double *restrict g)
{
    for (size_t i = 0; i < d; i++)
        g[i] = G[i * w] * x[i];
    for (size_t i = 0; w > 1 && i < d; i++)
        for (size_t k = 1; k < w && i + k < d; k++) {
            g[i] += G[i * w + k] * x[i + k];
            g[i + k] += G[i * w + k] * x[i];
        }
}

int fvi_linearised_gradient(size_t d, const double *x, void *of, double *g)
{
    const fvi_linearised *l = of;
    if (!l->G) {
        memset(g, 0, d * sizeof *g);
        return 0;
    }
    const double *G = hessian_of_stage(l);
    if (l->diagonals > 0)
        multiply_band(d, l->diagonals, G, x, g);
    for (size_t i = 0; l->diagonals == 0 && i < d; i++) {
        g[i] = 0;
        for (size_t j = 0; j < d; j++)
            g[i] += G[i * d + j] * x[j];
    }
    return 0;
}

static int write_hessian(size_t d, const double *x, void *of, double *H)
{
    const fvi_linearised *l = of;
    (void)d, (void)x;
    if (l->G)
        memcpy(H, hessian_of_stage(l), l->size * sizeof *H);
    else
        memset(H, 0, l->size * sizeof *H);
    return 0;
}

/* Return 0, because no caller needs the energy of a linearised run. */
static int value(size_t d, const double *x, void *of, double *U)
{
    (void)d, (void)x, (void)of;
    *U = 0;
    return 0;
}

int fvi_linearised_force(double t, size_t d, void *of, double *F)
{
    fvi_linearised *l = of;
    (void)t;
    if (l->source)
        memcpy(F, l->source + l->evaluated_stages++ * d, d * sizeof *F);
    else
        memset(F, 0, d * sizeof *F);
    return 0;
}

fvi_system fvi_linearised_system(const fvi_system *system, fvi_linearised *of)
{
    fvi_system linear = *system;
    linear.d = of->d;
    linear.force = (fvi_force){ .value = fvi_linearised_force, .params = of };
    if (!system->matrices)
        linear.potential = (fvi_potential){ .value = value,
                                            .gradient = fvi_linearised_gradient,
                                            .hessian = write_hessian,
                                            .params = of,
                                            .diagonals = of->diagonals };
    return linear;
}

/* ---- the equation of a step ---- */

/* Solve the equation of one stage if G is diagonal: divide once for each coordinate. */
static int solve_diagonal(const fvi_newton *n, const fvi_linearised *l, const double *x,
                          const double *r, double *d, double *g)
{
    const double *G = l->G ? hessian_of_stage(l) : NULL;
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < l->d; j++) {
        const double H = G ? G[j] : 0, J = n->A[j] + n->s[j] * n->theta * H;
        if (J == 0)
            status = FVI_ESING;
        d[j] = (r[j] - n->s[j] * (H * x[j])) / J;
        g[j] = H * (x[j] + n->theta * d[j]);
    }
    return status;
}

/* Store the entry (j, c) of the Hessian of stage i in the q rows of coordinate j. */
static void add_entry(fvi_newton *n, size_t i, size_t j, size_t c, double H)
{
    const size_t q = n->q;
    const double *s = n->s + j * q * q + i;
    for (size_t l = 0; l < q; l++)
        fvi_band_row(&n->J, j * q + l)[c * q + i] = s[l * q] * n->theta * H;
}

/* Fill the columns of stage i in the rows of the first d coordinates of J. The caller adds A afterwards. */
static void add_stage(fvi_newton *n, const fvi_linearised *l, size_t i, size_t d)
{
    const size_t w = l->diagonals;
    const double *G = hessian_of_stage(l);
    for (size_t j = 0; j < d; j++)
        for (size_t k = 0; k < (w ? w : d) && (w ? j + k : k) < d; k++) {
            const double H = G[j * (w ? w : d) + k];
            add_entry(n, i, j, w ? j + k : k, H);
            if (w && k > 0)
                add_entry(n, i, j + k, j, H);
        }
}

/* Copy the factors of the first coordinate to all other coordinates. */
static void copy_factors(fvi_newton *n, size_t d)
{
    const size_t q = n->q, bytes = q * sizeof *n->J.entry;
    for (size_t row = q; row < d * q; row++) {
        const size_t first = row % q, block = row - first;
        memcpy(fvi_band_row(&n->J, row) + block, fvi_band_row(&n->J, first), bytes);
        n->J.pivot[row] = n->J.pivot[first] + block;
    }
}

/* Fill the matrix of the step and factorise it. */
static int factorise(fvi_newton *n, fvi_linearised *l)
{
    const size_t d = l->is_one_body ? 1 : l->d;
    fvi_band some = n->J; /* the first rows of J */
    fvi_band_clear(&n->J);
    for (size_t i = 0; l->G && i < n->q; i++) {
        l->stage = n->first + i;
        add_stage(n, l, i, d);
    }
    for (size_t row = 0; row < d * n->q; row++)
        fvi_band_row(&n->J, row)[row] += n->A[row / n->q];
    some.n = d * n->q;
    if (fvi_band_factorise(&some))
        return FVI_ESING;
    if (l->is_one_body)
        copy_factors(n, l->d);
    return FVI_SUCCESS;
}

/* Write r - s grad U(x) to n->step. */
static void assemble_right_hand_side(fvi_newton *n, fvi_linearised *l, const double *x,
                                     const double *r, double *g)
{
    const size_t dim = l->d, q = n->q;
    for (size_t i = 0; i < q; i++) {
        l->stage = n->first + i;
        fvi_linearised_gradient(dim, x, l, g + i * dim);
    }
    const double *s = n->s;
    for (size_t j = 0, row = 0; j < dim; j++)
        for (size_t i = 0; i < q; i++, row++) {
            n->step[row] = r[i * dim + j];
            for (size_t c = 0; c < q; c++)
                n->step[row] -= *s++ * g[c * dim + j];
        }
}

int fvi_newton_by_linearised(fvi_newton *n, const double *x, const double *r,
                             double *d, double *g)
{
    fvi_linearised *l = fvi_linearised_of(n->system);
    const size_t dim = l->d, q = n->q;
    l->stage = n->first;
    if (q == 1 && (l->diagonals == 1 || dim == 1))
        return solve_diagonal(n, l, x, r, d, g);
    const int status = n->has_factors ? FVI_SUCCESS : factorise(n, l);
    if (status)
        return status;
    n->has_factors = l->is_constant;
    assemble_right_hand_side(n, l, x, r, g);
    fvi_band_solve(&n->J, n->step);
    for (size_t j = 0; j < dim; j++)
        for (size_t i = 0; i < q; i++)
            d[i * dim + j] = n->step[j * q + i];
    return fvi_newton_gradients(n, x, d, g);
}
