/* src/estimation/identification_design.c -- Predict what a planned test will tell. [H 24] */
#include "identification_examine.h"

#include "system/fail.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

/* The first step of a fit is divided by FINER, because the data of a plan have no noise in which the error of a longer
 * step could be lost. */
enum { FINER = 4 };

/* Compute the planned motion at the times, which is what the data would be without noise, and the step *h. */
static int plan_motion(const fvi_estimation *fit, double *motion, double *h)
{
    fvi_estimation still = *fit;
    fvi_estimation_model model;
    int status = FVI_SUCCESS;
    memset(motion, 0, fit->n * sizeof *motion);
    still.x = motion;
    for (int pass = 0; pass < 2 && !status; pass++) { /* the second pass knows the frequency of the motion */
        double *next = malloc(fit->n * sizeof *next);
        if (!next)
            return FVI_ENOMEM;
        *h = fit->h > 0 ? fit->h : fvi_estimation_first_step(&still) / FINER;
        status = fvi_estimation_model_init(&model, &still, next);
        if (!status) {
            fvi_estimation_model_set_step(&model, *h);
            status = fvi_estimation_model_run(&model);
        }
        fvi_estimation_model_clear(&model);
        memcpy(motion, next, fit->n * sizeof *motion);
        free(next);
    }
    return status;
}

/* Compute standard deviations, correlations and intervals of the tangent at the values of the run. */
static int plan_estimate(const fvi_estimation *fit, double h, fvi_estimate *planned, fvi_examination *e)
{
    fvi_estimation_work o;
    double low[FVI_ESTIMATION_MOST], high[FVI_ESTIMATION_MOST], u[FVI_ESTIMATION_MOST];
    int status = fvi_estimation_work_alloc(&o, fit, low, high);
    const size_t P = fit->parameters;
    *planned = (fvi_estimate){ .sigma = fit->sigma,
                               .chi2 = (double)(fit->n - P),
                               .probability = 1,
                               .quantile = gsl_cdf_ugaussian_Pinv(0.975) };
    *e = (fvi_examination){ .probability = { 1, 1, 1, 1, 0 }, .chi2 = GSL_POSINF };
    for (size_t j = 0; !status && j < P; j++) {
        planned->estimate[j] = fvi_estimation_model_get(&o.model, j);
        u[j] = fvi_estimation_theta_to_u(&o.model, j, planned->estimate[j]);
        if (!isfinite(u[j]))
            status = FVI_EDOM;
    }
    if (!status) {
        fvi_estimation_model_set_step(&o.model, h);
        planned->h = o.model.run.h;
        status = fvi_estimation_predict_errors(&o, u, planned, e);
    }
    fvi_estimation_work_free(&o);
    return status;
}

int fvi_estimate_design(const fvi_estimation *fit, fvi_estimate *planned,
                        fvi_examination *examined)
{
    if (!fit || !planned || !examined)
        FVI_FAIL("a pointer of the design is NULL", FVI_EFAULT);
    if (fit->records > 0 || fit->huber > 0)
        FVI_FAIL("a plan is of one column, by least squares", FVI_EUNSUP);
    fvi_estimation question = *fit;
    double h, *motion = fit->n > 0 ? calloc(fit->n, sizeof *motion) : NULL;
    if (!motion)
        FVI_FAIL("a design needs times, and memory", fit->n > 0 ? FVI_ENOMEM : FVI_EINVAL);
    question.x = motion;
    question.low = question.high = NULL;
    question.starts = 2;
    int status = fvi_estimation_check(&question);
    if (!status && !(fit->sigma > 0))
        status = FVI_EDOM;
    fvi_quiet();
    if (!status)
        status = plan_motion(&question, motion, &h);
    if (!status)
        status = plan_estimate(&question, h, planned, examined);
    fvi_loud();
    free(motion);
    return status;
}
