/* src/adjoint_variable/recorded_steps.c -- A run of fvi_variable_step, recorded step by step. [H 23] */
#include "recorded_steps.h"

#include "system/fail.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static int grow_arrays(fvi_recorded_steps *m)
{
    const size_t room = m->room ? 2 * m->room : 64;
    fvi_recorded_step *step = realloc(m->step, room * sizeof *step);
    if (step)
        m->step = step;
    double *numbers =
        realloc(m->numbers, room * FVI_MESH_NUMBERS * m->d * sizeof *numbers);
    if (numbers)
        m->numbers = numbers;
    if (!step || !numbers)
        FVI_FAIL("no memory for the steps", FVI_ENOMEM);
    m->room = room;
    return FVI_SUCCESS;
}

/* Record the last step. o->impulse_dv belongs to its end, and m->impulse_dv to its beginning. */
static int record_step(fvi_recorded_steps *m, const fvi_variable_step_state *o)
{
    const size_t d = m->d;
    int status = m->steps < m->room ? FVI_SUCCESS : grow_arrays(m);
    if (status)
        return status;
    double *to = m->numbers + m->steps * FVI_MESH_NUMBERS * d;
    m->step[m->steps++] = (fvi_recorded_step){ o->t0, o->length };
    memcpy(to, o->y0, d * sizeof *to);
    memcpy(to + d, o->v0, d * sizeof *to);
    memcpy(to + 2 * d, m->impulse_dv, d * sizeof *to);
    memcpy(to + 3 * d, o->delta, d * FVI_LANES * sizeof *to);
    memcpy(m->impulse_dv, o->impulse_dv, d * sizeof *to);
    return FVI_SUCCESS;
}

static int run_all(const fvi_run *run, fvi_stepper *s, fvi_recorded_steps *m)
{
    const fvi_variable_step_state *o = s->method_state;
    const size_t d = m->d;
    int status = FVI_SUCCESS;
    m->rule = o->rule;
    m->to_x = o->to_x;
    m->W0 = o->W0;
    m->beta = o->beta;
    m->T = o->T;
    m->least = o->least;
    m->modes_kind = o->modes_kind;
    m->singular = o->singular;
    m->singular.c = m->singular.ratio = m->singular.residual_force = NULL;
    memcpy(m->rows, s->x, d * sizeof *m->rows);
    memcpy(m->impulse_dv, o->impulse_dv, d * sizeof *m->impulse_dv);
    for (size_t k = 1; k <= run->steps && !status;) {
        status = fvi_stepper_step(s);
        if (!status)
            status = record_step(m, o);
        for (; !status && k <= run->steps; k++) {
            const double t = fmin((double)k * run->h, m->T);
            if (t > s->t)
                break;
            status = fvi_variable_step_dense(s, t, m->rows + k * d, NULL);
        }
    }
    memcpy(m->p, s->p, d * sizeof *m->p);
    return status;
}

int fvi_recorded_steps_run(const fvi_run *run, int for_adjoint, fvi_recorded_steps *m)
{
    fvi_method method = fvi_variable_step;
    fvi_stepper *s;
    method.start = for_adjoint ? fvi_variable_step_start_for_adjoint : fvi_variable_step_start;
    *m = (fvi_recorded_steps){ .d = run->system->d };
    if (run->steps > SIZE_MAX / sizeof(double) / m->d - 3)
        FVI_FAIL("steps must be addressable", FVI_EINVAL);
    m->rows = malloc((run->steps + 3) * m->d * sizeof *m->rows);
    if (!m->rows)
        FVI_FAIL("no memory for the path", FVI_ENOMEM);
    m->p = m->rows + (run->steps + 1) * m->d;
    m->impulse_dv = m->p + m->d;
    int status = fvi_stepper_start(&method, run, &s, NULL);
    if (status)
        return status;
    status = run_all(run, s, m);
    s->method = &fvi_variable_step; /* `method` does not outlive this function */
    if (run->law || run->system->matrices)
        m->stepper = s;
    else
        fvi_stepper_free(s);
    return status;
}

void fvi_recorded_steps_free(fvi_recorded_steps *m)
{
    fvi_stepper_free(m->stepper);
    free(m->step);
    free(m->numbers);
    free(m->rows);
}

int fvi_recorded_steps_slopes(const fvi_recorded_steps *m, const fvi_run *run, const fvi_objective *J, size_t k,
                              double *Jx, double *Jp, double *Jk)
{
    const int is_last = k == run->steps;
    memset(Jx, 0, m->d * sizeof *Jx);
    memset(Jk, 0, m->d * sizeof *Jk);
    return J->slopes(k, m->d, m->rows + k * m->d, is_last ? m->p : NULL, J->params, Jx,
                     is_last ? Jp : J->has_momenta ? Jk : NULL);
}
