/* src/methods/fvi.c -- Fractional variational integrators.               [Chapter 9] */
#include <fvi/fvi.h>

#include "damping.h"
#include "loads.h"
#include "system/fail.h"
#include "system/newton.h"

static int start_fractional(fvi_stepper *s)
{
    fvi_damping *d;
    int status = fvi_variational_solver(s);
    if (status)
        return status;
    status = fvi_damping_start(s, s->run.past, &d);
    s->own = d;
    return status;
}

static void stop_fractional(fvi_stepper *s)
{
    fvi_damping_free(s->own);
}

static int copy_fractional(const fvi_stepper *from, fvi_stepper *to)
{
    fvi_damping *d;
    int status = fvi_damping_copy(from->own, &d);
    to->own = d;
    return status;
}

static int visit_fractional(fvi_stepper *s, fvi_visitor *v)
{
    return fvi_damping_visit(s->own, v);
}

//> damp
/* p_{k+1} -= h rho Delta_-^alpha Delta_-^alpha x_{k+1} */
static int damp(fvi_stepper *s, fvi_damping *d)
{
    int status = fvi_damping_terms(d, s);
    if (!status)
        status = fvi_memory_push(d->memory, d->z, d->dz, d->z);
    return status ? status : fvi_damping_pull(d, 1, d->z, s->p);
}
//< damp

//> step
static int step_fractional(fvi_stepper *s)
{
    const double h = s->run.h;
    int status = fvi_newton_solve(s->newton, s->x, s->p, s->dx, s->g);
    if (!status)
        status = fvi_force_at(s, (double)(s->k + 1) * h);
    if (status)
        return status;
    for (size_t i = 0; i < s->run.system->d; i++) {
        s->x[i] += s->dx[i];
        s->p[i] += h * (s->F[i] - s->g[i]);
    }
    return s->own ? damp(s, s->own) : FVI_SUCCESS; /* (9.4) */
}
//< step

const fvi_method fvi_fractional = { .name = "fvi",
                                    .order = "1",
                                    .lowest = 1,
                                    .highest = 1,
                                    .memory = "full",
                                    .alpha_most = 1,
                                    .memories = FVI_ALL_MEMORIES,
                                    .scheme = FVI_SCHEME_ALGORITHM_3,
                                    .takes_kappa = 1,
                                    .takes_laws = 1,
                                    .takes_matrices = 1,
                                    .implicit = 1,
                                    .past_as_printed = 1,
                                    .load = fvi_load_backward,
                                    .load_grows = 1,
                                    .start = start_fractional,
                                    .step = step_fractional,
                                    .copy = copy_fractional,
                                    .visit = visit_fractional,
                                    .stop = stop_fractional };
