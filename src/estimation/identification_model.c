/* src/estimation/identification_model.c -- Make the model whose parameters a fit changes.    [H 24] */
#include "identification_model.h"

#include "system/arrays.h"
#include "system/larger.h"

#include <fvi/error.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- copies of laws ---- */

static size_t dampers_of(const fvi_run *run)
{
    return run->system->mechanism ? run->system->mechanism->damper_count : 0;
}

const fvi_kernel *fvi_estimation_law(const fvi_run *run, size_t index)
{
    if (index == 0)
        return run->law;
    return index <= dampers_of(run) ? run->system->mechanism->damper[index - 1].kernel : NULL;
}

/* Return nonzero if the law is an array of terms. A law that is a function of s is not copied. */
static int has_terms(const fvi_kernel *law)
{
    return law && law->count > 0 && law->term->kind != FVI_KERNEL_SYMBOL;
}

static int copy_laws(fvi_estimation_model *m)
{
    fvi_estimation_laws *o = &m->laws;
    const fvi_run *run = m->fit->run;
    const size_t dampers = dampers_of(run);
    size_t terms = 0;
    for (size_t k = 0; k <= dampers; k++)
        terms += has_terms(fvi_estimation_law(run, k)) ? fvi_estimation_law(run, k)->count : 0;
    o->kernel = calloc(dampers + 1, sizeof *o->kernel);
    o->term = calloc(terms + 1, sizeof *o->term);
    o->first = calloc(dampers + 1, sizeof *o->first);
    o->damper = calloc(dampers + 1, sizeof *o->damper);
    if (!o->kernel || !o->term || !o->first || !o->damper)
        return FVI_ENOMEM;
    if (dampers > 0) {
        memcpy(o->damper, run->system->mechanism->damper, dampers * sizeof *o->damper);
        o->mechanism = *run->system->mechanism;
        o->mechanism.damper = o->damper;
        m->system.mechanism = &o->mechanism;
    }
    for (size_t k = 0, next = 0; k <= dampers; k++) {
        const fvi_kernel *law = fvi_estimation_law(run, k);
        if (!has_terms(law))
            continue;
        o->first[k] = next;
        memcpy(o->term + next, law->term, law->count * sizeof *o->term);
        o->kernel[k] = (fvi_kernel){ law->count, o->term + next };
        next += law->count;
        if (k == 0)
            m->run.law = o->kernel;
        else
            o->damper[k - 1].kernel = o->kernel + k;
    }
    return FVI_SUCCESS;
}

/* ---- the model ---- */

/* Copy masses, dampings and the start, because the fit changes them. Masses and dampings of matrices are in the
 * matrices. */
static int copy_numbers(fvi_estimation_model *m)
{
    const fvi_run *run = m->fit->run;
    const size_t d = run->system->d;
    m->mass = FVI_ARRAYS({ &m->mass, d }, { &m->damping, d }, { &m->x0, d }, { &m->p0, d });
    if (!m->mass)
        return FVI_ENOMEM;
    memcpy(m->mass, run->system->mass, d * sizeof *m->mass);
    memcpy(m->damping, run->system->damping, d * sizeof *m->damping);
    memcpy(m->x0, run->x0, d * sizeof *m->x0);
    memcpy(m->p0, run->p0, d * sizeof *m->p0);
    m->system.mass = m->mass;
    m->system.damping = m->damping;
    m->run.x0 = m->x0;
    m->run.p0 = m->p0;
    return FVI_SUCCESS;
}

static int needs_laws(const fvi_estimation *fit)
{
    for (size_t j = 0; j < fit->parameters; j++)
        if (fvi_free_parameter_is_of_law(fit->which[j]))
            return 1;
    return 0;
}

/* Return where the caller keeps the constant that parameter j is; NULL if it is none. */
static double *constant_of(const fvi_estimation *fit, size_t j)
{
    const fvi_free_parameter base = fvi_free_parameter_base(fit->which[j]);
    return base >= FVI_FREE_PARAMETER_CONSTANT ? &fit->constants[base - FVI_FREE_PARAMETER_CONSTANT] : NULL;
}

int fvi_estimation_model_init(fvi_estimation_model *m, const fvi_estimation *fit, double *motion)
{
    *m = (fvi_estimation_model){ .fit = fit, .motion = motion, .window = 1 };
    m->system = *fit->run->system;
    m->run = *fit->run;
    if (m->run.most_steps == 0)
        m->run.most_steps = FVI_FIT_MOST_STEPS;
    m->run.system = &m->system;
    for (size_t j = 0; j < fit->parameters; j++)
        m->given[j] = constant_of(fit, j) ? *constant_of(fit, j) : 0;
    double scale[FVI_MEASURED_MOST] = { 0 };
    for (size_t c = 0; c < fvi_estimation_columns(fit); c++) {
        const double size = fvi_estimation_size(fit, c),
                     sigma = fvi_estimation_piece_of(fit, 0, c).sigma;
        scale[c] = sigma > 0 ? sigma : size > 0 ? size : 1;
    }
    fvi_estimation_model_rescale(m, scale);
    const int status = copy_numbers(m);
    return !status && needs_laws(fit) ? copy_laws(m) : status;
}

void fvi_estimation_model_clear(fvi_estimation_model *m)
{
    for (size_t j = 0; m->fit && j < m->fit->parameters; j++)
        if (constant_of(m->fit, j))
            *constant_of(m->fit, j) = m->given[j];
    free(m->mass);
    free(m->laws.kernel);
    free(m->laws.term);
    free(m->laws.first);
    free(m->laws.damper);
}

void fvi_estimation_model_set_step(fvi_estimation_model *m, double h)
{
    const fvi_record first = fvi_estimation_record(m->fit, 0);
    const double T = first.t[fvi_estimation_model_rows(m, first.n) - 1];
    m->run.steps = (size_t)fmax(1, ceil(T / h - 1e-6));
    m->run.h = T > 0 ? T / (double)m->run.steps : h;
}

size_t fvi_estimation_model_rows(const fvi_estimation_model *m, size_t n)
{
    return (size_t)ceil(m->window * (double)n);
}

/* ---- units ---- */

int fvi_estimation_finds_units(const fvi_estimation *fit)
{
    return !fvi_estimation_knows_sigma(fit)
           && (fvi_estimation_columns(fit) > 1 || fit->huber > 0);
}

double fvi_estimation_model_scale(const fvi_estimation_model *m, const fvi_estimation_piece *p)
{
    return p->sigma > 0 ? p->sigma : m->scale[p->column];
}

void fvi_estimation_model_rescale(fvi_estimation_model *m, const double *scale)
{
    m->hopeless = 0;
    for (size_t c = 0; c < fvi_estimation_columns(m->fit); c++) {
        const double size = fvi_estimation_size(m->fit, c);
        m->scale[c] = scale[c];
        m->hopeless = larger(m->hopeless, 1e8 * fmax(1, size / scale[c]));
    }
}

void fvi_estimation_model_weigh(fvi_estimation_model *m, const fvi_estimate *fitted)
{
    if (fvi_estimation_finds_units(m->fit))
        fvi_estimation_model_rescale(m, fitted->column_sigma);
}

double fvi_estimation_model_unit(const fvi_estimation_model *m, const fvi_estimate *fitted)
{
    return fvi_estimation_knows_sigma(m->fit) ? 1 : m->scale[0] / fitted->sigma;
}
