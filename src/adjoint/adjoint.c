/* src/adjoint/adjoint.c -- fvi_adjoint: every derivative of a number of a run by one adjoint run. [H 23]
 *
 * check refuses what is not known. walk goes from node N to node 0 and hands each step to the kind of adjoint run that
 * fits the method and the system. Steps of any length and mechanisms walk on their own. */
#include <fvi/adjoint.h>

#include "adjoint_lobatto.h"
#include "adjoint_mechanism/adjoint_mechanism.h"
#include "adjoint_multistep.h"
#include "adjoint_structure.h"
#include "adjoint_variable/adjoint_structure_mesh.h"
#include "adjoint_variable/adjoint_variable.h"
#include "checkpointing.h"
#include "parameter_derivatives/wanted_check.h"
#include "system/fail.h"

#include <stdlib.h>
#include <string.h>

/* Return nonzero if p_k = m v_k. At alpha = 1 a damping is a mass in form M and in fvi-adaptive, and then p_k contains
 * it. */
static int has_known_momenta(const fvi_method *method, const fvi_run *run,
                             const fvi_objective *J)
{
    const int splits = method->scheme == FVI_SCHEME_VARIABLE_STEP
                       || (method->scheme == FVI_SCHEME_LOBATTO
                           && !method->damped_inertia);
    const fvi_system *system = run->system;
    int known = 1;
    for (size_t i = 0; system && system->damping && i < system->d; i++)
        known &= !(system->damping[i] > 0);
    return known || !J->has_momenta || !splits
           || fvi_run_normal(method, run).alpha != 1;
}

/* How many terms the law of a run has, or the laws of all its dampers. */
static size_t count_terms(const fvi_run *run)
{
    const fvi_mechanism *m = run->system ? run->system->mechanism : NULL;
    size_t terms = run->law ? run->law->count : 0;
    for (size_t j = 0; m && j < m->damper_count; j++)
        terms += m->damper[j].kernel->count;
    return terms;
}

/* Refuse laws by fvi-shifted: it replaces a law by another kernel, and that kernel has no adjoint. */
static int check_shifted(const fvi_run *run)
{
    for (size_t j = 0; run->system && j < fvi_run_damper_count(run); j++)
        if (fvi_run_damper_of(run, j).law)
            FVI_FAIL("fvi-shifted has no adjoint with a law; the other methods have", FVI_EUNSUP);
    return FVI_SUCCESS;
}

static int check_stages(const fvi_method *method, const fvi_run *run, const fvi_sensitivities *want)
{
    return run->system->matrices    ? fvi_adjoint_structure_check(method, run, want)
           : run->system->mechanism ? fvi_adjoint_mechanism_check(method, run, want)
                                    : fvi_wanted_check_stage_laws(run, want);
}

/* Refuse derivatives by the numbers of a damping that fvi-adaptive does not have. */
static int check_adaptive(const fvi_run *run, const fvi_sensitivities *want)
{
    const int is_one_term = run->law && run->law->count == 1 && run->law->term[0].rho > 0;
    if (want->orders || want->times || want->ends || (want->terms && !is_one_term))
        FVI_FAIL("fvi-adaptive has no derivative by the numbers of a law but the factor of one that stands alone; "
                 "fvi-bdf2, fvi-stable and the methods with stages have",
                 FVI_EUNSUP);
    if (want->alpha && (run->alpha == 0 || run->alpha == 1) && fvi_initial_history_acts(run->past, run->alpha))
        FVI_FAIL("where the initial history acts, a mesh has no derivative by alpha at 0 and at 1", FVI_EUNSUP);
    return FVI_SUCCESS;
}

/* Let the method check the run: start a run of one step, which needs no long history. */
static int check_start(const fvi_method *method, const fvi_run *run)
{
    fvi_run one = *run;
    fvi_stepper *s;
    one.steps = run->steps > 0;
    const int status = fvi_stepper_start(method, &one, &s, NULL);
    if (!status)
        fvi_stepper_free(s);
    return status;
}

static int check(const fvi_method *method, const fvi_run *run, const double *x,
                 const double *p, const fvi_objective *J,
                 const fvi_sensitivities *want)
{
    if (!method || !run || !J || !J->slopes || !want || !x != !p)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (fvi_wanted_check_scheme(method))
        return FVI_EUNSUP;
    if (run->event_count > 0)
        FVI_FAIL("a run with events has no adjoint: the derivative of x by the time of an impact jumps, and a memory "
                 "answers that by a force without bound",
                 FVI_EUNSUP);
    if (method->dense && run->system && run->system->matrices && want->alpha && run->alpha == 0)
        FVI_FAIL("fvi-adaptive has no derivative by alpha at 0 of a system with matrices; methods without "
                 "stages, and fvi-lobatto2d to 8d, have",
                 FVI_EUNSUP);
    int status = method->scheme == FVI_SCHEME_CQ2_SHIFTED ? check_shifted(run) : FVI_SUCCESS;
    if (!status && run->system && run->system->mechanism && method->scheme != FVI_SCHEME_LOBATTO)
        status = run->system->matrices ? fvi_wanted_check_dampers(method, run, want)
                                       : fvi_adjoint_mechanism_check(method, run, want);
    if (!status && run->system && method->scheme == FVI_SCHEME_LOBATTO)
        status = check_stages(method, run, want);
    if (!status && run->system && fvi_has_mechanism_steps(run->system)
        && method->scheme == FVI_SCHEME_VARIABLE_STEP)
        status = fvi_adjoint_mesh_check(run, J, want);
    if (!status && run->system && fvi_has_mechanism_steps(run->system) && x)
        FVI_FAIL("a mechanism needs its own run", FVI_EUNSUP);
    if (status)
        return status;
    if (run->law ? want->alpha != NULL
                 : !(run->system && run->system->mechanism)
                       && fvi_wanted_kernel_numbers(want))
        FVI_FAIL("a law has terms, and no alpha; a power the other way round",
                 FVI_EINVAL);
    if ((method->scheme == FVI_SCHEME_LOBATTO
         || method->scheme == FVI_SCHEME_VARIABLE_STEP)
        && x)
        FVI_FAIL("stages need their own run", FVI_EUNSUP);
    if (method->scheme == FVI_SCHEME_LOBATTO && !method->damped_inertia
        && want->alpha && run->alpha == 1)
        FVI_FAIL("at alpha = 1 fvi-lobatto2 to 8 have no derivative by alpha, as p jumps there; "
                 "fvi-lobatto2d to 8d have", FVI_EUNSUP);
    status = method->scheme == FVI_SCHEME_VARIABLE_STEP ? check_adaptive(run, want) : FVI_SUCCESS;
    if (status)
        return status;
    if (!has_known_momenta(method, run, J))
        FVI_FAIL("at alpha = 1 the derivatives of this method are by p_N alone",
                 FVI_EUNSUP);
    if (want->parameters && want->sensitivity.count > 0
        && !(run->system && run->system->matrices) && !want->sensitivity.column
        && !want->lagrangian)
        FVI_FAIL("derivatives by parameters need a sensitivity", FVI_EINVAL);
    return check_start(method, run);
}

/* How many rows a step has in the trajectory: its end, and the stages before the end that are kept. */
static size_t rows_per_step(const fvi_method *method)
{
    const size_t first = method->damped_inertia != 0;
    return method->stages ? (size_t)method->stages - 1 + first : 1;
}

/* At how many times of a step a force acts, without the beginning of the step. */
static size_t force_times_per_step(const fvi_method *method)
{
    return method->stages ? (size_t)method->stages - 1 : 1;
}

/* How many derivatives by dampings there are: one for each mass, or for the factor of C, or for each damper. */
static size_t count_dampings(const fvi_system *system)
{
    return system->mechanism  ? system->mechanism->damper_count
           : system->matrices ? 1
                              : system->d;
}

/* Set the derivatives to zero that the steps add to. */
static void clear_outputs(const fvi_run *run, const fvi_sensitivities *want, size_t per)
{
    const size_t d = run->system->d;
    const int whole = run->system->matrices != NULL;
    if (want->alpha)
        *want->alpha = 0;
    double *const of_law[] = { want->terms, want->orders, want->times,
                               want->ends };
    for (size_t l = 0; l < sizeof of_law / sizeof *of_law; l++)
        for (size_t i = 0; of_law[l] && i < count_terms(run); i++)
            of_law[l][i] = 0;
    if (want->damping)
        memset(want->damping, 0, count_dampings(run->system) * sizeof *want->damping);
    if (want->force)
        memset(want->force, 0,
               (run->steps * per + 1) * d * sizeof *want->force);
    for (size_t j = 0; want->parameters && j < (whole ? 1 : want->sensitivity.count);
         j++)
        want->parameters[j] = 0;
}

/* Write dJ/dx_k to Jx, and dJ/dp_k to Jp unless that is NULL. */
static inline int slopes(const fvi_objective *J, size_t k, size_t d, const double *x,
                  const double *p, double *Jx, double *Jp)
{
    *Jx = 0;
    for (size_t i = 1; i < d; i++)
        Jx[i] = 0;
    for (size_t i = 0; Jp && i < d; i++)
        Jp[i] = 0;
    return J->slopes(k, d, x, p, J->params, Jx, Jp);
}

/* One of the three kinds of adjoint runs: of a structure with stages; of a chain with stages; of either without stages
 * (stages = 0). */
typedef struct {
    size_t stages;
    int is_structure;
    fvi_adjoint_structure structure;
    fvi_adjoint_multistep plain;
    fvi_adjoint_lobatto staged;
} adjoint_run;

static int begin(const fvi_method *method, const fvi_run *run,
                 const fvi_sensitivities *want, int jumps, const double *rows,
                 const double *p, const double *Jp, adjoint_run *m)
{
    m->stages = (size_t)method->stages;
    m->is_structure = m->stages && run->system->matrices;
    if (m->is_structure)
        return fvi_adjoint_structure_start(method, run, want, Jp, &m->structure);
    return m->stages ? fvi_adjoint_lobatto_start(method, run, want, jumps, p, Jp,
                                                 &m->staged)
                     : fvi_adjoint_multistep_start(method, run, want, jumps, rows, Jp,
                                                   &m->plain);
}

static int step(adjoint_run *m, size_t k, const double *rows, const double *Jx)
{
    if (m->is_structure)
        return fvi_adjoint_structure_step(&m->structure, k, rows, Jx);
    return m->stages ? fvi_adjoint_lobatto_step(&m->staged, k, rows, Jx)
                     : fvi_adjoint_multistep_step(&m->plain, k, rows, Jx);
}

/* Let lambda_k jump by J_p, because J depends on p_k, 0 < k < N. (23.27) */
static int jump(adjoint_run *m, const double *Jp)
{
    if (m->is_structure)
        return fvi_adjoint_structure_jump(&m->structure, Jp);
    return m->stages ? fvi_adjoint_lobatto_jump(&m->staged, Jp)
                     : fvi_adjoint_multistep_jump(&m->plain, Jp);
}

/* Write the derivatives. Jp: NULL, or dJ/dp_0, which is added to the derivative by p0. */
static int finish(adjoint_run *m, const fvi_sensitivities *want, size_t d,
                  const double *Jx, const double *Jp)
{
    const int status = m->is_structure ? fvi_adjoint_structure_end(&m->structure, Jx)
                       : m->stages     ? fvi_adjoint_lobatto_end(&m->staged, Jx)
                                       : fvi_adjoint_multistep_end(&m->plain, Jx);
    for (size_t i = 0; Jp && want->p0 && i < d; i++)
        want->p0[i] += Jp[i];
    return status;
}

static void stop(adjoint_run *m)
{
    if (m->is_structure) /* the moving figures of the book do not link this function */
        fvi_adjoint_structure_free(&m->structure);
    fvi_adjoint_lobatto_stop(&m->staged);
    fvi_adjoint_multistep_free(&m->plain);
}

//> walk
/* Walk from node N to node 0. J: room for dJ/dx_k, d numbers, and dJ/dp_k, d numbers. */
static int walk(const fvi_method *method, fvi_checkpointing *path,
                const fvi_run *run, const fvi_objective *objective,
                const fvi_sensitivities *want, double *J)
{
    const size_t d = run->system->d, N = run->steps;
    const size_t per = rows_per_step(method);
    const int jumps = objective->has_momenta;
    const double *rows;
    double *Jp = jumps ? J + d : NULL;
    adjoint_run m = { 0 };
    int status = fvi_checkpointing_step(path, N - 1, &rows);
    if (!status)
        status = slopes(objective, N, d, rows + per * d,
                        fvi_checkpointing_momentum(path), J, J + d);
    if (!status && !fvi_all_finite(d, J + d))
        status = FVI_EOVRFLW;
    if (!status)
        status = begin(method, run, want, jumps, rows,
                       fvi_checkpointing_momentum(path), J + d, &m);
    size_t k = N;
    if (!status && m.plain.walks_in_blocks) {
        status = fvi_adjoint_multistep_walk_in_blocks(&m.plain, path, objective, J);
        k = 0;
    }
    while (!status && k-- > 0) {
        if (k % 64 == 0)
            status = fvi_interrupted();
        if (!status && k + 1 < N)
            status = fvi_checkpointing_step(path, k, &rows);
        if (!status)
            status = step(&m, k, rows, J);
        if (!status)
            status = slopes(objective, k, d, rows, NULL, J, Jp);
        if (!status && jumps && k > 0)
            status = jump(&m, Jp);
    }
    if (!status)
        status = finish(&m, want, d, J, Jp);
    stop(&m);
    return status;
}
//< walk

/* Return nonzero if the run must begin at rest. fvi-adaptive demands it if its law grows faster than s. */
static int is_at_rest(const fvi_method *method, const fvi_run *run)
{
    if (method->scheme != FVI_SCHEME_VARIABLE_STEP || run->system->mechanism)
        return 0;
    const fvi_run_damper of = fvi_run_damper_of(run, 0);
    return of.law && of.growth > 1;
}

/* Return nonzero if any damping has Riemann and Liouville's past. */
static int is_liouville(const fvi_run *run)
{
    const fvi_mechanism *m = run->system->mechanism;
    int is = run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    for (size_t j = 0; m && j < m->damper_count; j++)
        is |= m->damper[j].past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    return is;
}

/* Return nonzero if all derivatives are finite. Two of them may be NaN, because they may not exist: the derivative by
 * x0 with Riemann and Liouville's past, and the derivative by p0 where the run must begin at rest. */
static int are_finite(const fvi_method *method, const fvi_run *run,
                      const fvi_sensitivities *want, size_t per)
{
    const int is_still = is_at_rest(method, run);
    const int whole = run->system->matrices != NULL;
    const size_t d = run->system->d, l = count_terms(run),
                 c = whole ? 1 : want->sensitivity.count;
    const struct {
        const double *by;
        size_t count;
    } outputs[] = { { is_liouville(run) ? NULL : want->x0, d },
                    { is_still ? NULL : want->p0, d },
                    { want->mass, whole ? 1 : d },
                    { want->damping, count_dampings(run->system) },
                    { want->alpha, 1 },
                    { want->terms, l },
                    { want->orders, l },
                    { want->times, l },
                    { want->ends, l },
                    { want->force, (run->steps * per + 1) * d },
                    { want->parameters, c } };
    for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++)
        if (outputs[i].by && !fvi_all_finite(outputs[i].count, outputs[i].by))
            return 0;
    return 1;
}

static int differentiate_run(const fvi_method *method, const fvi_run *run,
                             const double *x, const double *p,
                             const fvi_objective *objective,
                             const fvi_sensitivities *want)
{
    fvi_checkpointing *path;
    const int has_mechanism = fvi_has_mechanism_steps(run->system);
    if (method->scheme == FVI_SCHEME_VARIABLE_STEP && run->system->matrices)
        return fvi_adjoint_structure_mesh(run, objective, want);
    if (method->scheme == FVI_SCHEME_VARIABLE_STEP)
        return (has_mechanism ? fvi_adjoint_mesh_run : fvi_adjoint_variable)(run, objective, want);
    if (has_mechanism)
        return fvi_adjoint_mechanism_run(method, run, objective, want);
    int status = fvi_checkpointing_alloc(method, run, x, p, &path);
    if (status)
        return status;
    double *J = calloc(2 * run->system->d, sizeof *J);
    if (!J) {
        fvi_checkpointing_free(path);
        FVI_FAIL("no memory for the slopes", FVI_ENOMEM);
    }
    status = walk(method, path, run, objective, want, J);
    free(J);
    fvi_checkpointing_free(path);
    return status;
}

int fvi_adjoint(const fvi_method *method, const fvi_run *run, const double *x,
                const double *p, const fvi_objective *objective,
                const fvi_sensitivities *want)
{
    int status = check(method, run, x, p, objective, want);
    if (status)
        return status;
    const fvi_run normal = fvi_run_normal(method, run);
    run = &normal;
    clear_outputs(run, want, force_times_per_step(method));
    status = differentiate_run(method, run, x, p, objective, want);
    return status || are_finite(method, run, want, force_times_per_step(method)) ? status
                                                              : FVI_EOVRFLW;
}
