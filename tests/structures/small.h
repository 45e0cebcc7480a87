/* tests/structures/small.h -- Random small structures with stages. */
#ifndef SMALL_H
#define SMALL_H

#include "building.h"
#include "stages/stage_dense.h"
#include "system/larger.h"
#include "system/seeded.h"

enum { MOST = 9 };

static inline double draw(uint64_t *seed)
{
    return fvi_seeded_uniform(seed, 0, 1);
}

/* A row of 1 to MOST masses with springs, and up to three dampers across one or two unknowns: powers below and
 * above 1, a fraction, a dashpot beside a power. */
typedef struct {
    int d;
    size_t dampers;
    fvi_kernel_term term[3][2];
    fvi_kernel kernel[3];
    double row[3][MOST], x0[MOST], p0[MOST];
    fvi_damper damper[3];
    fvi_sparse M, K;
    fvi_structure *structure;
    fvi_system system;
} small;

static inline void make_dampers(uint64_t *seed, small *s)
{
    s->dampers = 1 + (size_t)(3 * draw(seed));
    for (size_t j = 0; j < s->dampers; j++) {
        const double kind = draw(seed), alpha = draw(seed), rho = 0.1 + draw(seed);
        s->term[j][0] = (fvi_kernel_term){ FVI_KERNEL_POWER, rho, alpha, 0, 0 };
        s->term[j][1] = (fvi_kernel_term){ FVI_KERNEL_POWER, rho, 0.5, 0, 0 };
        if (kind < 0.3)
            s->term[j][0] = (fvi_kernel_term){ FVI_KERNEL_ZENER, rho, 0.4 * alpha, 0.5 + alpha, 0 };
        s->kernel[j] = (fvi_kernel){ kind > 0.8 ? 2 : 1, s->term[j] };
        const int at = (int)((double)s->d * draw(seed));
        memset(s->row[j], 0, sizeof s->row[j]);
        s->row[j][at] = 1;
        if (at > 0)
            s->row[j][at - 1] = -1;
        s->damper[j] = (fvi_damper){ .of = fvi_elongation_row(s->row[j]), .kernel = s->kernel + j };
        s->damper[j].past = kind > 0.5 && kind < 0.8 ? FVI_INITIAL_HISTORY_CAPUTO : FVI_INITIAL_HISTORY_HELD;
    }
}

static inline void make_small(uint64_t *seed, size_t s, small *of)
{
    const double most = (double)(FVI_STAGE_DENSE / s < MOST ? FVI_STAGE_DENSE / s : MOST);
    of->d = 1 + (int)(most * draw(seed));
    tridiagonal(of->d, 1 + draw(seed), 0.2, &of->M);
    tridiagonal(of->d, 2 + draw(seed) * 40, -1, &of->K);
    for (int i = 0; i < of->d; i++) {
        of->x0[i] = draw(seed) - 0.5;
        of->p0[i] = draw(seed) - 0.5;
    }
    make_dampers(seed, of);
    OK(fvi_structure_alloc_dampers(&of->M, &of->K, of->dampers, of->damper, &of->structure, NULL));
    of->system = fvi_structure_system(of->structure);
}

static inline void drop_small(small *s)
{
    fvi_structure_free(s->structure);
    fvi_sparse_free(&s->M);
    fvi_sparse_free(&s->K);
}

static inline int force_of_cosines(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = cos(3 * t + (double)i);
    return 0;
}

static inline double apart(size_t n, const double *x, const double *y)
{
    double worst = 0;
    for (size_t i = 0; i < n; i++)
        worst = larger(worst, fabs(x[i] - y[i]));
    return worst;
}

#endif
