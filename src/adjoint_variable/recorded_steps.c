/* src/adjoint_variable/recorded_steps.c -- A run of fvi_variable_step, recorded step by step. [H 23] */
#include "recorded_steps.h"

#include "system/fail.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int fvi_recorded_steps_start(const fvi_run *run, int for_adjoint, fvi_recorded_steps *m)
{
    fvi_method method = fvi_variable_step;
    method.start = for_adjoint ? fvi_variable_step_start_for_adjoint : fvi_variable_step_start;
    *m = (fvi_recorded_steps){ .d = run->system->d };
    if (run->steps > SIZE_MAX / sizeof(double) / m->d - 3)
        FVI_FAIL("steps must be addressable", FVI_EINVAL);
    m->rows = malloc((run->steps + 3) * m->d * sizeof *m->rows);
    if (!m->rows)
        FVI_FAIL("no memory for the path", FVI_ENOMEM);
    m->p = m->rows + (run->steps + 1) * m->d;
    m->impulse_dv = m->p + m->d;
    const int status = fvi_stepper_start(&method, run, &m->stepper, NULL);
    if (!status)
        m->stepper->method = &fvi_variable_step; /* `method` does not outlive this function */
    return status;
}

static int grow_arrays(fvi_recorded_steps *m)
{
    const size_t room = m->room ? 2 * m->room : 64;
    fvi_recorded_step *step = realloc(m->step, room * sizeof *step);
    if (step)
        m->step = step;
    double *numbers = realloc(m->numbers, room * m->size * sizeof *numbers);
    if (numbers)
        m->numbers = numbers;
    if (!step || !numbers)
        FVI_FAIL("no memory for the steps", FVI_ENOMEM);
    m->room = room;
    return FVI_SUCCESS;
}

int fvi_recorded_steps_go(fvi_recorded_steps *m, void (*record)(void *params, double *numbers), void *params)
{
    fvi_stepper *s = m->stepper;
    const fvi_variable_step_state *o = s->method_state;
    const size_t d = m->d;
    int status = FVI_SUCCESS;
    memcpy(m->rows, s->x, d * sizeof *m->rows);
    for (size_t k = 1; k <= s->run.steps && !status;) {
        const size_t hits = o->hits;
        status = fvi_stepper_step(s);
        if (!status && m->steps == m->room)
            status = grow_arrays(m);
        if (status)
            return status;
        record(params, m->numbers + m->steps * m->size);
        m->step[m->steps++] = (fvi_recorded_step){ o->t0, o->length, o->hits > hits };
        for (; !status && k <= s->run.steps; k++) {
            const double t = fmin((double)k * s->run.h, o->T);
            if (t > s->t)
                break;
            status = fvi_variable_step_dense(s, t, m->rows + k * d, NULL);
        }
    }
    memcpy(m->p, s->p, d * sizeof *m->p);
    return status;
}

/* Record the last step. o->impulse_dv belongs to its end, and m->impulse_dv to its beginning. */
static void record_motion(void *params, double *to)
{
    fvi_recorded_steps *m = params;
    const fvi_variable_step_state *o = m->stepper->method_state;
    const size_t d = m->d;
    memcpy(to, o->y0, d * sizeof *to);
    memcpy(to + d, o->v0, d * sizeof *to);
    memcpy(to + 2 * d, m->impulse_dv, d * sizeof *to);
    memcpy(to + 3 * d, o->delta, d * FVI_LANES * sizeof *to);
    memcpy(m->impulse_dv, o->impulse_dv, d * sizeof *to);
}

int fvi_recorded_steps_run(const fvi_run *run, int for_adjoint, fvi_recorded_steps *m)
{
    const int status = fvi_recorded_steps_start(run, for_adjoint, m);
    if (status)
        return status;
    const fvi_variable_step_state *o = m->stepper->method_state;
    m->size = FVI_MESH_NUMBERS * m->d;
    memcpy(m->impulse_dv, o->impulse_dv, m->d * sizeof *m->impulse_dv);
    return fvi_recorded_steps_go(m, record_motion, m);
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
