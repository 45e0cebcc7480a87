/* src/adjoint_variable/adjoint_structure_mesh_rows.c -- The derivatives of J through the rows within a step of a
 * structure. [H 23, 27] */
#include "adjoint_structure_mesh.h"

#include <math.h>
#include <string.h>

/* Let lambda begin at J_p at the end of the run. No history gets this value. */
static int begin_at_end(fvi_adjoint_structure_mesh_run *m)
{
    int status = FVI_SUCCESS;
    memcpy(m->o->v, m->Jp, m->d * sizeof *m->Jp);
    for (size_t j = 0; !status && j < m->of->count; j++) {
        fvi_mesh_matrix *to = m->of->damper + j;
        status = to->of.matrix.select_history(m->d, m->Jp, to->zero, to->of.matrix.params, to->now);
    }
    return status;
}

/* Add the derivatives through one row: of x there, with the slopes Jx, and of p = M v there, with the slopes Jk, by
 * V - v of the stages and by v and x at the beginning of the step. (22.18) */
static int add_row(fvi_adjoint_structure_mesh_run *m, size_t n, double theta)
{
    const double h = m->path.step[n].length.h, *numbers = m->path.numbers + n * FVI_MESH_NUMBERS * m->d;
    const fvi_matrices *matrices = m->run->system->matrices;
    const int has_momentum = m->J->has_momenta && m->row < m->run->steps;
    double twice[FVI_LANES], once[FVI_LANES], of_x[FVI_LANES], of_v[FVI_LANES], whole = 0, sum = 0;
    int status = FVI_SUCCESS;
    fvi_variable_step_twice(theta, twice);
    fvi_variable_step_once(theta, once);
    fvi_adjoint_mesh_shape(m->rule, h, twice, of_x);
    fvi_adjoint_mesh_shape(m->rule, 1, once, of_v);
    if (has_momentum)
        status = matrices->inertia(m->d, m->Jk, matrices->params, m->product);
    for (size_t i = 0; i < m->s; i++) {
        whole += of_x[i];
        sum += of_v[i];
        for (size_t j = 0; j < m->d; j++) {
            m->source[i * m->d + j] += m->Jx[j] * of_x[i];
            if (has_momentum)
                m->source[i * m->d + j] += m->product[j] * of_v[i];
        }
    }
    for (size_t j = 0; j < m->d; j++) {
        m->by_v[j] += m->Jx[j] * (h * theta - whole);
        m->by_x[j] += m->Jx[j];
        if (!has_momentum)
            continue;
        double v = numbers[m->d + j];
        for (size_t i = 0; i < m->s; i++)
            v += of_v[i] * numbers[3 * m->d + j * FVI_LANES + i];
        m->by_v[j] += m->product[j] * (1 - sum);
        m->by_M += m->product[j] * v;
    }
    return status;
}

/* Read all rows in step n that are not at its beginning. */
int fvi_adjoint_structure_mesh_read_rows(fvi_adjoint_structure_mesh_run *m, size_t n)
{
    const fvi_recorded_step *step = m->path.step + n;
    int status = FVI_SUCCESS;
    memset(m->source, 0, m->s * m->d * sizeof *m->source);
    memset(m->by_v, 0, m->d * sizeof *m->by_v);
    memset(m->by_x, 0, m->d * sizeof *m->by_x);
    for (; !status && m->row > 0; m->row--) {
        const double t = (double)m->row * m->run->h, theta = fmin((t - step->t) / step->length.h, 1);
        if (t <= step->t)
            break;
        status = fvi_recorded_steps_slopes(&m->path, m->run, m->J, m->row, m->Jx, m->Jp, m->Jk);
        if (!status && m->row == m->run->steps)
            status = begin_at_end(m);
        if (!status)
            status = add_row(m, n, theta);
    }
    return status;
}
