/* src/estimation/identification.c -- Find parameters from a measured motion by many searches.   [H 24] */
#include <fvi/identification.h>

#include "identification_robust.h"
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_qrng.h>
#include <stdlib.h>
#include <string.h>

/* A search ends at a step of u that is shorter, relative to u: */
#define LAST_STEP_OF_SEARCH 1e-6   /* for the searches from all starts */
#define LAST_STEP_OF_ESTIMATE 1e-9 /* for the last search, from the best of them */
#define LAST_STEP_OF_WINDOW 1e-4   /* for a search that will go on with more rows */

/* With a larger standard deviation of a logit or a logarithm, the data do not determine the parameter. */
#define LARGEST_USEFUL_SD 20

/* In this file o is the search from all starts. A place is where one of its searches began and where it is now. */
typedef fvi_estimation_place place;
typedef fvi_estimation_work search;

/* ---- many starts ---- */

//> starts
/* Set the start of search number `start`. Start 0 has the values of the run. The other starts are points of Sobol's
 * sequence in the box from low to high, uniform in the logarithm of a parameter that is positive and no order. */
static void set_start(search *o, const double *low, const double *high, gsl_qrng *sobol, size_t start)
{
    double share[FVI_ESTIMATION_MOST]; /* of each side of the box, between 0 and 1 */
    fvi_estimation_model *m = &o->model;
    double *u = o->found[start].u;
    if (start > 0)
        gsl_qrng_get(sobol, share);
    for (size_t j = 0; j < o->fdf.p; j++) {
        const int logarithmic =
            low[j] > 0 && fvi_estimation_kind_of(m->fit, j) != FVI_ESTIMATION_ORDER;
        double theta;
        if (start == 0)
            theta = fvi_estimation_model_get(m, j);
        else if (logarithmic)
            theta = low[j] * pow(high[j] / low[j], share[j]);
        else
            theta = low[j] + (high[j] - low[j]) * share[j];
        u[j] = fvi_estimation_theta_to_u(m, j, theta);
    }
    memcpy(o->found[start].from, u, sizeof o->found[start].from);
}
//< starts

/* Make k the best start if it ended lower than the best one. */
static void update_best(const search *o, size_t k, size_t *best)
{
    if (o->found[k].sum < o->found[*best].sum)
        *best = k;
}

/* Search from all starts. When the best chi^2 so far is as good as that of the true parameters would be, a start that
 * makes little progress is given up. Return FVI_SUCCESS or an error code. */
static int search_from_all_starts(search *o, const double *low, const double *high, size_t *best)
{
    const fvi_estimation *fit = o->model.fit;
    gsl_qrng *sobol = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)fit->parameters);
    if (!sobol)
        FVI_FAIL("no memory for the starts", FVI_ENOMEM);
    /* Set all starts before the first search, because only now the model has the values of the run. */
    for (size_t k = 0; k < fit->starts; k++)
        set_start(o, low, high, sobol, k);
    gsl_qrng_free(sobol);
    o->fine = LAST_STEP_OF_SEARCH;
    for (size_t k = 0; k < fit->starts; k++) {
        const double least = o->found[*best].sum;
        o->found[k].sum = GSL_POSINF;
        if (fvi_all_finite(fit->parameters, o->found[k].u))
            fvi_estimation_minimise(o, &o->found[k], k > 0 && least < o->believed ? least : GSL_POSINF);
        update_best(o, k, best);
        const int end = fvi_interrupted();
        if (end)
            return end;
    }
    if (o->model.ended)
        return o->model.ended;
    if (o->found[*best].sum < GSL_POSINF)
        return FVI_SUCCESS;
    if (o->model.callback_status)
        return o->model.callback_status;
    FVI_FAIL("the model has no motion, from any start", FVI_EBADFUNC);
}

/* Continue the searches that were given up. Return nonzero if there were any. */
static int continue_given_up(search *o, size_t *best)
{
    int any = 0;
    for (size_t k = 0; k < o->model.fit->starts && !fvi_interrupted(); k++)
        if (o->found[k].gave_up) {
            any = 1;
            fvi_estimation_minimise(o, &o->found[k], GSL_POSINF);
            update_best(o, k, best);
        }
    return any;
}

//> windows
/* A motion with a swing too many is a false minimum, but not for the first few swings. So all starts begin again
 * with the first tenth of the rows, then go on with two tenths, four tenths and all rows. Return nonzero if a start
 * ended lower than before. */
static int search_with_growing_windows(search *o, size_t *best)
{
    static const double windows[] = { 0.1, 0.2, 0.4, 1 };
    fvi_estimation_model *m = &o->model;
    const double h = m->run.h, fine_before = o->fine;
    int any = 0;
    for (size_t k = 0; k < m->fit->starts && !fvi_interrupted(); k++) {
        place at = { .gave_up = 0 };
        if (!fvi_all_finite(m->fit->parameters, o->found[k].from))
            continue;
        memcpy(at.u, o->found[k].from, sizeof at.u);
        memcpy(at.from, at.u, sizeof at.from);
        for (size_t w = 0; w < sizeof windows / sizeof *windows; w++) {
            m->window = windows[w];
            fvi_estimation_model_set_step(m, h);
            o->fine = m->window < 1 ? LAST_STEP_OF_WINDOW : LAST_STEP_OF_SEARCH;
            fvi_estimation_minimise(o, &at, GSL_POSINF);
        }
        if (at.sum < o->found[k].sum) {
            o->found[k] = at;
            any = 1;
        }
        update_best(o, k, best);
    }
    o->fine = fine_before;
    return any;
}
//< windows

/* Return the size of parameter j at the value theta, against which small changes are compared. A start or a constant
 * may be 0, so its size is at least that which follows from the box. */
static double size_of_parameter(const search *o, size_t j, double theta)
{
    return fvi_estimation_kind_of(o->model.fit, j) != FVI_ESTIMATION_NUMBER
               ? fabs(theta)
               : fmax(fabs(theta), o->size[j]);
}

/* Return the number of starts that ended within sd / 10 of the best, or within 1e-6 of its size. (24.5) */
static size_t count_agreeing_starts(const search *o, const place *best, const fvi_estimate *fitted)
{
    const fvi_estimation_model *m = &o->model;
    size_t agree = 0;
    for (size_t k = 0; k < m->fit->starts; k++) {
        int same = o->found[k].sum < GSL_POSINF;
        for (size_t j = 0; same && j < o->fdf.p; j++) {
            const double here = fvi_estimation_u_to_theta(m, j, o->found[k].u[j]),
                         there = fvi_estimation_u_to_theta(m, j, best->u[j]);
            same = fabs(here - there)
                   <= fmax(fitted->sd[j] / 10, 1e-6 * size_of_parameter(o, j, there));
        }
        agree += same != 0;
    }
    return agree;
}

/* Return nonzero if some parameter of u is farther than a standard deviation from theta. */
static int is_far_from(const search *o, const double *u, const double *theta, const double *sd)
{
    for (size_t j = 0; j < o->fdf.p; j++)
        if (fabs(fvi_estimation_u_to_theta(&o->model, j, u[j]) - theta[j]) > sd[j])
            return 1;
    return 0;
}

/* Record the best places where other starts ended. This comes last, because the sum of each place becomes infinite when
 * it has been looked at. */
static void record_other_minima(search *o, fvi_estimate *fitted)
{
    const size_t starts = o->model.fit->starts;
    fitted->others = 0;
    for (size_t tries = 0; tries < starts; tries++) {
        size_t next = 0;
        for (size_t k = 0; k < starts; k++)
            update_best(o, k, &next);
        place *at = &o->found[next];
        if (!(at->sum < GSL_POSINF) || fitted->others == FVI_ESTIMATION_OTHERS)
            return;
        at->sum = GSL_POSINF;
        int is_new = is_far_from(o, at->u, fitted->estimate, fitted->sd);
        for (size_t i = 0; i < fitted->others; i++)
            is_new &= is_far_from(o, at->u, fitted->other[i], fitted->sd);
        for (size_t j = 0; is_new && j < o->fdf.p; j++)
            fitted->other[fitted->others][j] =
                fvi_estimation_u_to_theta(&o->model, j, at->u[j]);
        fitted->others += is_new != 0;
    }
}

/* ---- what the data say of the parameters ---- */

//> covariance
/* Compute the standard deviations and correlations of (24.3) from the solver's Jacobian by u; for a robust fit
 * (24.20). The solver's residuals and Jacobian are overwritten. Return FVI_SUCCESS, FVI_ESING or FVI_EOVRFLW. */
static int compute_deviations(search *o, const place *at, fvi_estimate *fitted)
{
    const fvi_estimation_model *m = &o->model;
    const size_t P = o->fdf.p, n = o->fdf.n;
    const double huber = m->fit->huber;
    double deviation = fvi_estimation_knows_sigma(m->fit)
                           ? 1
                           : sqrt(at->sum / (double)(n - P)); /* of the residuals f */
    if (huber > 0) {
        fvi_estimation_robust_units(huber, P, o->solver->f, &deviation, &fitted->loss_unit);
        fvi_estimation_undo_loss(huber, o->solver->f, gsl_multifit_nlinear_jac(o->solver));
    }
    if (fvi_estimation_errors(gsl_multifit_nlinear_jac(o->solver), fitted->sd,
                       fitted->correlation))
        return FVI_ESING;
    for (size_t j = 0; j < P; j++) {
        const double slope =
            fabs(fvi_estimation_slope_of_theta(m, j, fitted->estimate[j]));
        fitted->sd[j] *= deviation;
        if (fvi_estimation_kind_of(m->fit, j) != FVI_ESTIMATION_NUMBER
            && !(fitted->sd[j] < LARGEST_USEFUL_SD))
            return FVI_ESING;
        fitted->sd[j] *= slope;
    }
    return fvi_estimate_is_finite(P, fitted) ? FVI_SUCCESS : FVI_EOVRFLW;
}
//< covariance

/* Set the sigma of each column to its unit, and multiply by an estimated factor if sigma is unknown and the fit is not
 * robust. */
static void set_sigma(const search *o, const place *at, fvi_estimate *fitted)
{
    const fvi_estimation_model *m = &o->model;
    const int known = fvi_estimation_knows_sigma(m->fit);
    const double factor = known || m->fit->huber > 0
                               ? 1
                               : sqrt(at->sum / (double)(o->fdf.n - o->fdf.p));
    for (size_t c = 0; c < fvi_estimation_columns(m->fit); c++)
        fitted->column_sigma[c] = m->scale[c] * factor;
    fitted->sigma = fitted->column_sigma[0];
}

/* Fill in everything of *fitted that follows from the place `at` and the solver's Jacobian there. Return FVI_SUCCESS,
 * FVI_ESING or FVI_EOVRFLW. */
static int compute_statistics(search *o, const place *at, fvi_estimate *fitted)
{
    const fvi_estimation_model *m = &o->model;
    const double freedom = (double)(o->fdf.n - o->fdf.p);
    const int known = fvi_estimation_knows_sigma(m->fit), is_robust = m->fit->huber > 0;
    for (size_t j = 0; j < o->fdf.p; j++)
        fitted->estimate[j] = fvi_estimation_u_to_theta(m, j, at->u[j]);
    fitted->neighbours = 0;
    if (at->sum > 0)
        fitted->neighbours = fvi_estimation_neighbours(m->fit, gsl_multifit_nlinear_residual(o->solver)) / at->sum;
    set_sigma(o, at, fitted);
    fitted->probability = !known || is_robust ? 1
                                              : fmin(gsl_cdf_chisq_P(at->sum, freedom),
                                                     gsl_cdf_chisq_Q(at->sum, freedom));
    fitted->quantile = known ? gsl_cdf_ugaussian_Pinv(0.975)
                             : gsl_cdf_tdist_Pinv(0.975, freedom);
    fitted->h = m->run.h;
    fitted->loss_unit = 1;
    const int status = compute_deviations(o, at, fitted);
    fitted->chi2 = is_robust ? fitted->loss_unit * at->sum : known ? at->sum : freedom;
    return status;
}

//> refine
/* Halve the step until no estimate moves by more than sd / 100. An error of the method is an error of the model, and
 * the noise of the data does not show it. If the moves hardly become shorter, the step is not what moves the estimates.
 * Then the halving ends, and `bias` is the last move. */
static int halve_step_until_settled(search *o, place *best, fvi_estimate *fitted)
{
    int status = FVI_SUCCESS, still_moves = 1;
    while (!status && still_moves && o->model.run.steps <= FVI_FIT_MOST_EQUAL_STEPS / 2) {
        const fvi_estimate before = *fitted;
        fvi_estimation_model_set_step(&o->model, o->model.run.h / 2);
        fvi_estimation_minimise(o, best, GSL_POSINF);
        if (!(best->sum < GSL_POSINF))
            return FVI_EMAXITER;
        status = compute_statistics(o, best, fitted);
        fitted->bias = 0;
        for (size_t j = 0; j < o->fdf.p; j++) {
            const double move = fabs(fitted->estimate[j] - before.estimate[j]);
            if (move > 1e-7 * size_of_parameter(o, j, fitted->estimate[j]))
                fitted->bias = larger(fitted->bias, move / fitted->sd[j]);
        }
        still_moves = fitted->bias > 0.01 && !(fitted->bias > 0.75 * before.bias);
    }
    return status;
}
//< refine

/* ---- the whole ---- */

/* Return whether a complete answer can be believed: FVI_SUCCESS, FVI_EMAXITER or FVI_ETOL, as
 * fvi_estimate_multistart. */
static int status_of_answer(const search *o, const fvi_estimate *fitted)
{
    if (fitted->agree < 2)
        return FVI_EMAXITER;
    if (fvi_estimation_knows_sigma(o->model.fit) && fitted->probability < 1e-6)
        return FVI_ETOL;
    return FVI_SUCCESS;
}

/* Search from the end of start `first` to the last digits. Compute the statistics, and count the starts that agree. */
static int refine_estimate(search *o, size_t first, place *best, fvi_estimate *fitted)
{
    *best = o->found[first];
    o->fine = LAST_STEP_OF_ESTIMATE;
    fvi_estimation_minimise(o, best, GSL_POSINF);
    const int status = compute_statistics(o, best, fitted);
    fitted->agree = count_agreeing_starts(o, &o->found[first], fitted);
    return status;
}

/* Return nonzero if the best place is in doubt: at most half of the starts agree on it, and its status is not
 * FVI_SUCCESS. */
static int is_best_in_doubt(const search *o, const fvi_estimate *fitted)
{
    return status_of_answer(o, fitted) && fitted->agree <= o->model.fit->starts / 2;
}

/* Search until two starts agree on a best place that can be believed: from all starts, then also from those that were
 * given up, then with growing windows. */
static int search_everywhere(search *o, size_t *first, place *best, fvi_estimate *fitted)
{
    int status = refine_estimate(o, *first, best, fitted);
    if (fitted->agree < 2 && continue_given_up(o, first))
        status = refine_estimate(o, *first, best, fitted);
    if (!status && is_best_in_doubt(o, fitted) && search_with_growing_windows(o, first))
        status = refine_estimate(o, *first, best, fitted);
    return status;
}

/* Do the whole fit: set the step, search, compute the statistics, halve the step, and record the curve and the other
 * minima. */
static int run_search(search *o, const double *low, const double *high, double *curve, fvi_estimate *fitted)
{
    const fvi_estimation *fit = o->model.fit;
    size_t first = 0;
    const double h = fit->h > 0 ? fit->h : fvi_estimation_first_step(fit),
                 last_time = fvi_estimation_last_time(fit);
    fvi_estimation_model_set_step(&o->model, fmax(h, last_time / FVI_FIT_MOST_EQUAL_STEPS));
    int status = search_from_all_starts(o, low, high, &first);
    if (status)
        return status;
    place best;
    *fitted = (fvi_estimate){ .bias = GSL_NAN };
    status = search_everywhere(o, &first, &best, fitted);
    if (!status && fvi_estimation_finds_units(fit)) {
        status = fvi_estimation_reweigh(o, &best);
        status = status ? status : compute_statistics(o, &best, fitted);
    }
    if (!status && fit->h == 0)
        status = halve_step_until_settled(o, &best, fitted);
    const int end = fvi_interrupted();
    if (end)
        return end;
    gsl_vector_const_view u = gsl_vector_const_view_array(best.u, o->fdf.p);
    fvi_estimation_residuals(&u.vector, o, o->solver->f); /* computes the motion there */
    if (curve)
        memcpy(curve, o->model.motion, o->fdf.n * sizeof *curve);
    if (!status)
        record_other_minima(o, fitted);
    return status ? status : status_of_answer(o, fitted);
}

int fvi_estimate_multistart(const fvi_estimation *fit, double *curve, fvi_estimate *fitted)
{
    search o;
    double low[FVI_ESTIMATION_MOST], high[FVI_ESTIMATION_MOST];
    int status = fvi_estimation_check(fit);
    if (status)
        return status;
    if (!fitted)
        FVI_FAIL("no room for the answer", FVI_EFAULT);
    fvi_quiet();
    status = fvi_estimation_work_alloc(&o, fit, low, high);
    if (!status)
        status = run_search(&o, low, high, curve, fitted);
    fvi_estimation_work_free(&o); /* o.model.ended and o.model.reached keep their values */
    fvi_loud();
    if (o.model.ended == FVI_ERUNAWAY) { /* not a mistake of the caller, so the error handler is not called */
        *fitted = (fvi_estimate){ .reached = o.model.reached };
        return o.model.ended;
    }
    if (o.model.ended)
        FVI_FAIL("no memory for a motion", o.model.ended);
    return status;
}
