/* src/variable_step/variable_step_state.c -- The state of a run: copies, matrices, archive. [H 22] */
#include "variable_step_events.h"
#include "variable_structure.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "system/archive_pieces.h"
#include "system/arrays.h"
#include "system/fail.h"
#include "system/larger.h"

#include <float.h>
#include <gsl/gsl_machine.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    STATE = 8, /* the first arrays of o->y: d numbers each, which the next step reads */
    BOUNDS = FVI_BOUND_ORDER + 1
};

void fvi_variable_step_stop(fvi_stepper *s)
{
    fvi_variable_step_state *o = s->method_state;
    if (!o)
        return;
    fvi_mesh_free(o);
    fvi_structure_mesh_free(o);
    fvi_mechanism_free(s->mechanism);
    fvi_modes_free(o->modes);
    fvi_modes_free(o->rising);
    free(o->kernel);
    free(o->singular.c);
    free(o->events);
    free(o->jacobian);
    fvi_variable_step_band_free(o->band);
    fvi_variable_step_free_events(o->watch);
    free(o->y);
    free(o->group);
    free(o);
}

/* ---- memory and copies ---- */

static size_t count_numbers(const fvi_variable_step_state *o)
{
    return (size_t)(o->most_of_force - o->y) + BOUNDS * o->d;
}

int fvi_variable_step_allocate(fvi_variable_step_state *o)
{
    const size_t d = o->d, s = o->rule->s;
    const int each = o->solve == FVI_SOLVE_DIAGONAL && o->diagonals == 0;
    o->y = FVI_ARRAYS({ &o->y, d }, { &o->y_compensation, d }, { &o->v, d }, { &o->v_compensation, d },
                      { &o->y0, d }, { &o->v0, d }, { &o->centre, d }, { &o->impulse_dv, d },
                      { &o->base, FVI_LANES * d }, { &o->R, FVI_LANES * d }, { &o->delta, FVI_LANES * d },
                      { &o->accel_legendre, FVI_LANES * d },
                      { &o->accel_legendre0, FVI_LANES * d }, { &o->point, s * d }, { &o->gradient, s * d },
                      { &o->hessian, s * d }, { &o->most_of_force, BOUNDS * d });
    o->group = calloc(1, o->groups * sizeof *o->group + 2 * d * sizeof *o->group_of);
    o->jacobian = each ? calloc(d, sizeof *o->jacobian) : NULL;
    if (o->diagonals)
        o->band = fvi_variable_step_band_alloc(o->rule, o->beta, d, o->groups,
                                          o->diagonals);
    if (!o->y || !o->group || (o->diagonals && !o->band) || (each && !o->jacobian))
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    o->group_of = (size_t *)(o->group + o->groups);
    o->index = o->group_of + d;
    o->powers = o->accel_legendre;
    return FVI_SUCCESS;
}

int fvi_variable_step_copy(const fvi_stepper *from, fvi_stepper *to)
{
    const fvi_variable_step_state *old = from->method_state;
    fvi_variable_step_state *o = to->method_state = malloc(sizeof *o);
    if (!o)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    *o = *old;
    o->modes = o->rising = NULL;
    o->kernel = NULL;
    o->singular.c = NULL;
    o->events = NULL;
    o->jacobian = NULL;
    o->band = NULL;
    o->watch = NULL;
    o->mechanism = NULL;
    o->structure = NULL;
    o->y = NULL;
    o->group = NULL;
    o->coupled = old->band ? 0 : old->coupled; /* the factors of a band are not copied */
    int status = fvi_variable_step_allocate(o);
    if (status)
        return status;
    memcpy(o->y, old->y, count_numbers(o) * sizeof *o->y);
    memcpy(o->group_of, old->group_of, 2 * o->d * sizeof *o->group_of);
    memcpy(o->group, old->group, o->groups * sizeof *o->group);
    if (old->mechanism)
        status = fvi_mesh_copy(from, to);
    else if (old->structure)
        status = fvi_structure_mesh_copy(from, to);
    if (status)
        return status;
    if (old->singular.c) {
        const size_t n = o->d * (old->singular.J + 3);
        status = fvi_singular_allocate(o->d, &o->singular);
        if (status)
            return status;
        memcpy(o->singular.c, old->singular.c, n * sizeof *o->singular.c);
    }
    o->events = malloc(o->event_count * sizeof *o->events);
    if (!o->events)
        FVI_FAIL("no memory for the jumps", FVI_ENOMEM);
    memcpy(o->events, old->events, o->event_count * sizeof *o->events);
    if (old->kernel && !(o->kernel = fvi_variable_step_copy_kernel(old->kernel)))
        FVI_FAIL("no memory for the law", FVI_ENOMEM);
    status = fvi_variable_step_copy_events(old->watch, o);
    if (!status && old->modes)
        status = fvi_modes_copy(old->modes, &o->modes);
    return status || !old->rising ? status
                                  : fvi_modes_copy(old->rising, &o->rising);
}

/* ---- limits and impulses ---- */

void fvi_variable_step_limit(fvi_stepper *s, double longest, int growth)
{
    fvi_variable_step_state *o = s->method_state;
    const int most = (int)floor(log(longest) / fvi_variable_spacing());
    o->longest_exponent = (int)smaller(o->longest_exponent, most);
    o->next_exponent = o->first_exponent = (int)smaller(o->first_exponent, o->longest_exponent);
    o->growth = growth;
}

/* The pace of the last PACE steps predicts how many steps the rest will take. Only a run with a singular motion or
 * force predicts more than ENDLESS steps, because a run of so many steps would last for weeks. */
int fvi_variable_step_runs_away(fvi_variable_step_state *o, size_t most_steps)
{
    enum { PACE = 1 << 18 };
    static const double ENDLESS = 0x1p40;
    const size_t steps = o->counts.steps + o->counts.rejected;
    if (most_steps > 0)
        return steps >= most_steps;
    if (steps < o->next_pace_check)
        return 0;
    const double came = o->t - o->pace_checked_at, rest = o->T - o->t;
    const int is_first = o->next_pace_check == 0; /* of a run, or since it came from an archive */
    o->next_pace_check = steps + PACE;
    o->pace_checked_at = o->t;
    return !is_first && rest * PACE > came * ENDLESS;
}

//> apply-impulses
int fvi_variable_step_jump(fvi_stepper *s, fvi_variable_step_state *o, const double *J, double factor)
{
    if (o->mechanism)
        return fvi_mesh_jump(s, o, J, factor);
    if (o->structure)
        return fvi_structure_mesh_jump(s, o, J, factor);
    for (size_t j = 0; j < o->d; j++) {
        const double jump = factor * J[j] / o->group[o->group_of[j]].mass;
        o->impulse_dv[j] += jump;
        o->v[j] += jump;
    }
    return FVI_SUCCESS;
}

int fvi_variable_step_apply_impulses(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_force *force = &s->run.system->force;
    const double now = o->t * (1 + 8 * GSL_DBL_EPSILON);
    int status = FVI_SUCCESS;
    memset(o->impulse_dv, 0, o->d * sizeof *o->impulse_dv);
    for (; o->hits < force->impulse_count && force->impulses[o->hits].t <= now && !status;
         o->hits++) {
        const double *J = force->impulses[o->hits].J;
        status = fvi_variable_step_open_tensile_contacts(s, o, J, 1);
        if (!status)
            status = o->mechanism ? fvi_mesh_apply_impulse(s, o, J) : fvi_variable_step_jump(s, o, J, 1);
    }
    return status;
}
//< apply-impulses

/* ---- matrices ---- */

//> matrices
/* M = a A + b B + c C */
FVI_VECTORS static void combine_squares(double a, const fvi_square *A, double b,
                                        const fvi_square *B, double c,
                                        const fvi_square *C, fvi_square *M)
{
    for (size_t l = 0; l < FVI_LANES; l++)
        for (size_t i = 0; i < FVI_LANES; i += 4)
            *(fvi_four *)(M->column[l] + i) =
                a * *(const fvi_four *)(A->column[l] + i)
                + b * *(const fvi_four *)(B->column[l] + i)
                + c * *(const fvi_four *)(C->column[l] + i);
}

int fvi_variable_step_matrices(fvi_variable_step_state *o, fvi_length length)
{
    const double h = length.h;
    if (h == o->length.h)
        return FVI_SUCCESS;
    const double power = pow(h, 1 - o->beta);
    if (o->kernel) {
        fvi_variable_step_present_kernel(o->rule, o->kernel, h, o->beta, &o->W0, o->W1);
        o->memory_leakage = fvi_memory_leakage(o->rule, &o->W0);
    }
    const int inverse = o->solve == FVI_SOLVE_TOGETHER /* these solvers need L^{-1} */
                        || (!o->band && o->solve != FVI_SOLVE_DIAGONAL);
    o->length.h = 0; /* not ready, until all matrices are */
    for (size_t n = 0; n < o->groups; n++) {
        fvi_coordinate_group *group = &o->group[n];
        group->damping_coeff = o->beta == 1 ? 0 : group->damping * power;
        combine_squares(group->mass, &o->rule->inverse, group->damping_coeff, &o->W0,
                        group->spring * h * h, o->to_x, &group->L);
        if (!inverse)
            continue;
        group->inverse = group->L;
        int status = fvi_square_invert(o->rule->s, &group->inverse);
        if (status)
            return status;
    }
    o->length = length;
    return FVI_SUCCESS;
}
//< matrices

/* ---- the archive ---- */

/* Return nonzero if a run could have these exponents and counts. If an event cuts a step short, the exponent of this
 * step may be as low as that of the least double. */
static int has_possible_control(const fvi_variable_step_state *o)
{
    const double L = fvi_variable_spacing();
    const int lowest = (int)floor(log(DBL_TRUE_MIN) / L) - FVI_VARIABLE_STEP_LESS,
              highest = (int)ceil(log(o->T) / L);
    return o->next_exponent >= lowest && o->next_exponent <= o->longest_exponent && o->first_exponent >= lowest
           && o->first_exponent <= o->longest_exponent && o->longest_solvable >= lowest
           && o->longest_solvable <= highest && o->longest_exponent >= lowest && o->longest_exponent <= highest
           && o->growth >= 0 && o->growth <= FVI_VARIABLE_STEP_GROWTH && o->steps_since_failure >= 0
           && o->steps_since_failure < FVI_VARIABLE_STEP_RETRY && o->stalled_iterations >= 0
           && o->stalled_iterations <= FVI_VARIABLE_STEP_STUCK
           && (o->first_after_event == 0 || o->first_after_event == 1)
           && o->scale > 0 && gsl_finite(o->scale) && !isnan(o->undeclared_jump_until);
}

/* Return nonzero if a run could be at these times, before its next event and after its impulses. */
static int has_possible_times(const fvi_stepper *s, const fvi_variable_step_state *o)
{
    return o->t == s->t && o->t0 >= 0 && o->t0 <= o->t
           && fabs(o->t_compensation) <= 4 * GSL_DBL_EPSILON * o->t
           && o->event < o->event_count
           && o->hits <= s->run.system->force.impulse_count
           && (o->length.h == 0 || fvi_length_is_possible(o->length, o->T));
}

/* Return nonzero if the arrays for the solver `before` are enough for o->solve, too. Only COUPLED and TOGETHER share
 * theirs. */
static int has_room_to_solve(const fvi_variable_step_state *o, fvi_step_solver before)
{
    const int may_change =
        before == FVI_SOLVE_COUPLED || before == FVI_SOLVE_TOGETHER;
    return o->solve == before
           || (may_change
               && (o->solve == FVI_SOLVE_COUPLED
                   || o->solve == FVI_SOLVE_TOGETHER));
}

/* Serialise the numbers that the next step reads and that a start does not compute. Matrices, factors and rows of modes
 * are computed again, both here and in the run that goes on. So both get the same numbers to the last digit. */
//> archive
int fvi_variable_step_archive(fvi_stepper *s, fvi_archive *v)
{
    fvi_variable_step_state *o = s->method_state;
    const fvi_step_solver before = o->solve;
    int status = FVI_SERIALIZE(
        v, FVI_CONSTANT(o->rule->s), FVI_CONSTANT(o->beta), FVI_CONSTANT(o->T), FVI_CONSTANT(o->event_count),
        FVI_CONSTANTS(o->events, o->event_count), FVI_STATE(o->solve), FVI_STATES(o->y, STATE * o->d),
        FVI_STATES(o->accel_legendre0, FVI_LANES * o->d), FVI_STATE(o->t), FVI_STATE(o->t_compensation),
        FVI_STATE(o->t0), FVI_STATE(o->length.h), FVI_STATE(o->length.k), FVI_STATE(o->event), FVI_STATE(o->hits),
        FVI_STATE(o->scale),
        FVI_STATE(o->next_exponent), FVI_STATE(o->first_exponent), FVI_STATE(o->first_after_event),
        FVI_STATE(o->longest_exponent), FVI_STATE(o->growth), FVI_STATE(o->longest_solvable),
        FVI_STATE(o->steps_since_failure), FVI_STATE(o->undeclared_jump_until), FVI_STATE(o->stalled_iterations),
        FVI_STATE(o->counts.steps), FVI_STATE(o->counts.rejected), FVI_STATE(o->counts.longest));
    if (!status
        && !(has_room_to_solve(o, before) && has_possible_times(s, o)
             && has_possible_control(o)))
        FVI_FAIL("not a state of this run", FVI_EINVAL);
    if (!status && o->watch)
        status = fvi_variable_step_archive_events(s, o, v);
    if (!status && o->modes)
        status = fvi_modes_archive(o->modes, v);
    if (!status && o->rising)
        status = fvi_modes_archive(o->rising, v);
    if (status)
        return status;
    const fvi_length length = o->length;
    if (o->mechanism)
        return fvi_mesh_archive(s, v);
    if (o->structure)
        return fvi_structure_mesh_archive(s, v);
    o->length.h = 0;
    o->coupled = 0;
    o->powers_known = 0;
    o->clear_to = 0;
    return length.h > 0 ? fvi_variable_step_matrices(o, length) : FVI_SUCCESS;
}
//< archive
