/* src/fvi/identification.h -- Fits: parameters of a system from a measured motion.                       [H 24]
 *
 * Let x_i be measured at the times t_i, for a body that moves as
 *
 *     m x'' + U'(x) + rho D^{2 alpha} x = F(t).
 *
 * A fit finds alpha, rho, the constants of U, the start, and other parameters. If the noise is Gaussian and
 * independent, the best parameters have the least
 *
 *     chi^2 = sum_i (x(t_i) - x_i)^2 / sigma^2.                                                         (24.1)
 *
 * chi^2 has several minima (24.5), so a fit searches from many starts. */
#ifndef FVI_IDENTIFICATION_H
#define FVI_IDENTIFICATION_H

#include "records.h"
#include "sensitivity.h"
#include "trajectory.h"
#include "warnings.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

enum { FVI_ESTIMATION_MOST = 8 };              /* the largest number of parameters of a fit */
enum { FVI_ESTIMATION_OTHERS = 4 };    /* the largest number of other minima in an answer */
enum { FVI_FIT_MOST_STEPS = 1 << 22 }; /* the largest number of steps of a run; a fit makes hundreds of runs */
enum { FVI_FIT_MOST_EQUAL_STEPS = 1 << 17 }; /* the same for a run with equal steps */

/* fvi_estimation -- the question of a fit: the data, the model, and the unknown parameters. The pointers belong to the
 * caller.
 *
 *   method     the integrator. Take one of high order, such as that of fvi_estimate_method, because its error has the
 *              same effect as an error of the data
 *   run        the model: masses, potential or matrices, dampers, force, past, and the values of all parameters that
 *              are not fitted. The values of the fitted parameters are the first start. run->h and run->steps are not
 *              read
 *   constants  NULL; or the params of the potential. A fit of constants writes to them and restores them at its end
 *   n, t, x    number of data, their times, and the measured x of the first coordinate. n > parameters; t[0] >= 0; t
 *              finite and increasing, in any spacing
 *   sigma      standard deviation of each x, in the unit of x, finite; 0: unknown
 *   records, columns, record  0, 0 and NULL; or number of records, number of columns of each, and the records
 *              (records.h). With records n, t, x and sigma are not read. An unknown sigma is estimated for each column
 *   huber      0: least squares. k > 0: a residual r, in units of sigma, contributes r^2 up to |r| = k, and 2 k
 *              |r| - k^2 beyond; so a few wrong readings have a small effect. 1.345 is usual.               [(24.19)]
 *   parameters, which  number of unknown parameters, at most FVI_ESTIMATION_MOST, and the parameters, all different
 *   low, high  NULL; or the box of the starts, one number for each parameter, low < high. NULL: the box of
 *              fvi_estimate_box. The box is no bound of the search. But alpha stays in the range of the method, and rho
 *              and the mass stay positive
 *   starts     number of searches, >= 2
 *   h          0: the fit finds the step. > 0: the step is at most h, and it is not halved. No step is shorter than the
 *              last time divided by FVI_FIT_MOST_EQUAL_STEPS, so a shorter h is refused (FVI_EDOM) */
typedef struct {
    const fvi_method *method;
    const fvi_run *run;
    double *constants;
    size_t n;
    const double *t, *x;
    double sigma;
    size_t parameters;
    const fvi_free_parameter *which;
    const double *low, *high;
    size_t starts;
    double h;
    size_t records, columns;
    const fvi_record *record;
    double huber;
} fvi_estimation;

/* fvi_estimate -- the answer of a fit. The numbers of parameter j are at [j]. */
typedef struct {
    double estimate[FVI_ESTIMATION_MOST];
    double sd[FVI_ESTIMATION_MOST]; /* standard deviations (24.3) */
    double correlation[FVI_ESTIMATION_MOST][FVI_ESTIMATION_MOST];
    double quantile; /* the interval of 95 % is estimate -+ quantile sd; of the normal distribution or of Student's */
    double sigma;    /* of the first column: as given, or sqrt(sum of squares / (n - parameters)) */
    double chi2;     /* (24.1) with that sigma; for a robust fit (24.20) */
    double
        probability; /* of a chi^2 at least as far on the same side; 1 if sigma is estimated */
    double
        neighbours; /* correlation of neighbouring residuals: about 0 -+ n^(-1/2) if the model is right */
    size_t agree; /* number of starts that led to this answer */
    double h;     /* the step of the last run */
    double bias;  /* the largest move of an estimate by the last halving of the step, in sd; a move below 1e-7 of the
                     estimate's size does not count. NaN if the step was not halved */
    double reached; /* after FVI_ERUNAWAY: the time that the last run reached */
    size_t others;  /* number of other minima, the best first: ends of other starts that are more than a standard
                       deviation from this answer and from each other */
    double other[FVI_ESTIMATION_OTHERS][FVI_ESTIMATION_MOST];
    double column_sigma[FVI_MEASURED_MOST]; /* sigma of each column, given or estimated */
    double loss_unit; /* 1; for a robust fit the factor with which chi2 grows by 1 when a parameter moves by one sd */
} fvi_estimate;

/* fvi_estimate_method -- Return the method that suits the data of a question. fit->method is not read.
 *
 * It is fvi_lobatto_d4 for matrices and for a coordinate without inertia. For all other systems it is fvi_lobatto_m4,
 * or fvi_variable_step if the data need more than 8192 equal steps: steps as short as the shortest distance of two
 * times, or as a radian of the fastest oscillation about the start. A mechanism has fvi_lobatto_m4 in any case.
 * Returns NULL if fvi_estimate_multistart would refuse the question. */
const fvi_method *fvi_estimate_method(const fvi_estimation *fit);

/* fvi_estimate_box -- Find a box of plausible starts, from the size and the frequency of the data.
 *
 *   fit        the question; its low and high are not read
 *   low, high  outputs, fit->parameters numbers each
 *
 * Let w be the frequency at which the periodogram of x - mean is largest, A = max |x - mean|, and m the mass of
 * fit->run:
 *
 *     alpha  the range of the method       rho        m w^{2 - 2 alpha} (1/50 ... 2),
 *     m      m (1/3 ... 3)                            alpha = 1/2
 *     x0     mean -+ 3/2 A                 constant 0   m w^2 (1/10 ... 4)
 *     p0     -+ 3/2 m w A                  others       m w^2 / A^2 (-1/2 ... 2)
 *
 * For several columns or coordinates the mean is 0, A is the largest |x|, and w is the frequency of the first column.
 * If the largest force is above 1000 m w^2 A, the inertia of the body is negligible. Then this force divided by A
 * replaces m w^2. Cost: min(n, 1024)^2 sines. Returns as fvi_estimate_multistart for a question that it refuses;
 * FVI_EFAULT if low or high is NULL. */
int fvi_estimate_box(const fvi_estimation *fit, double *low, double *high);

/* fvi_estimate_multistart -- Find the parameters with the least chi^2, by searches from several starts.
 *                                                                                                    [(24.1) - (24.4)]
 *
 *   fit     the question
 *   curve   NULL, or output: x(t_i) of the fitted motion, n numbers. For records: the values of the sensors, record
 *           after record, and in a record column after column
 *   fitted  output
 *
 *     const fvi_free_parameter which[] = { FVI_FREE_PARAMETER_ALPHA, FVI_FREE_PARAMETER_RHO };
 *     fvi_estimation fit = { .run = &run, .n = n, .t = t, .x = x, .parameters = 2, .which = which, .starts = 10 };
 *     fit.method = fvi_estimate_method(&fit);
 *     status = fvi_estimate_multistart(&fit, NULL, &fitted);
 *
 * The search. The method of Levenberg and Marquardt (GSL) runs from the values of the run and from fit->starts - 1
 * points of Sobol's sequence in the box. Its unknowns are the logit of alpha, ln rho and ln m. The derivatives are
 * those of (24.6) for fvi_fractional and of (24.12) for the methods with stages of H 17, if there is one coordinate, no
 * record and no law, and if fvi_parameter_gradient_of knows the constants; else they are differences. If sigma is given
 * and the best chi^2 so far is below its quantile of 0.99, a start is given up when the pace of its last ten iterations
 * promises no better chi^2. Starts that were given up go on if fewer than two starts agree without them. If at most
 * half of the starts agree on a best place that cannot be believed, all starts begin again with the first tenth of the
 * rows, and go on with two tenths, four tenths and all rows.
 *
 * Agreement. A start agrees with the best if all its parameters are within sd / 10 of the best ones, or within 1e-6 of
 * their size. The size is |theta|; for x0, p0 and constants it is at least a sixteenth of the box, or of the box of
 * fvi_estimate_box if that is smaller.
 *
 * The step is at first the longest step that meets all times and is not longer than 1/w (w as in fvi_estimate_box).
 * Then it is halved until no estimate moves by more than sd / 100, or by more than 1e-7 of its size. The halving ends
 * at 2^17 steps, and when the moves no longer become shorter; `bias` is the last move. A row between two steps comes
 * from Hermite's cubic through x and p / m, or from the dense output of a method of variable steps.
 *
 * The searches are repeatable: every call gives the same digits. Cost: seen 60 to 170 runs for each start, with two to
 * five parameters, 200 points and differences. Each search ends after 60 iterations, of P + 1 runs each if all goes
 * well. Each halving is one search, and the last has up to 2^17 steps in a run. The function writes to fit->constants
 * while it works, so no other thread may read them.
 *
 * Returns FVI_SUCCESS, or one of three codes with an answer, for which no handler is called and *fitted and curve are
 * written:
 *
 *   FVI_EMAXITER   fewer than two starts agree on the best
 *   FVI_ETOL       sigma is given, and chi^2 has a probability below 1e-6
 *   FVI_ESING      the data do not determine the parameters; sd and correlation hold no result
 *
 * or a code without an answer:
 *
 *   FVI_EOVRFLW    a number of the answer is not finite
 *   FVI_ERUNAWAY   three runs take more than run->most_steps steps, or FVI_FIT_MOST_STEPS if that is 0; of *fitted only
 *                  `reached` holds a result
 *   FVI_EFAULT     a pointer is NULL
 *   FVI_EINVAL     parameters is 0 or above FVI_ESTIMATION_MOST, there are not more data than parameters, starts < 2, t
 *                  does not increase, `which` has a parameter twice or one that the model does not have, a record
 *                  without rows or with an impossible number of columns, sigma known for some columns only
 *   FVI_EDOM       sigma, h or huber is negative, a number is not finite, low is not below high, h is too short
 *   FVI_EUNSUP     a parameter that cannot be fitted: alpha with a method of one alpha, with a law or with dampers
 *                  (with a law rho multiplies the law); masses and rho of matrices; rho with dampers; masses of a
 *                  Lagrangian; mass and p0 of a coordinate without inertia; masses, x0 and p0 with constraints
 *   FVI_EBADFUNC   the model has no motion from any start; or the caller's own code that the potential or the force
 *                  returned there
 *   FVI_ENOMEM     no memory. (GSL 2.7 does not free a half-made solver, so the function first checks that a whole one
 *                  fits)
 *
 * or what fvi_system_check returns for other reasons than matrices and a mechanism, which a fit takes; or what the
 * interrupter (error.h) returned. */
int fvi_estimate_multistart(const fvi_estimation *fit, double *curve, fvi_estimate *fitted);

/* fvi_estimate_warning_of_pair -- Warn if the data can hardly tell parameters i and j apart: |correlation| > 0.9.
 *
 *   fitted          the answer; not one with FVI_ESING
 *   name_i, name_j  names of the parameters, for the text
 *   size, text      room for FVI_WARNING_ROOM characters (warnings.h); longer names are cut. Untouched without a
 *                   warning
 *
 * Returns 1 and a text, or 0. Nothing is checked.
 *
 * fvi_estimate_warning_of_initial_history -- Return a constant text if no motion has these estimates
 * (fvi_warning_of_initial_history); else NULL. Nothing is checked. */
int fvi_estimate_warning_of_pair(const fvi_estimate *fitted, size_t i, size_t j,
                            const char *name_i, const char *name_j, size_t size,
                            char *text);
const char *fvi_estimate_warning_of_initial_history(const fvi_estimation *fit,
                                    const fvi_estimate *fitted);

/* fvi_estimate_reason -- Write why there is no answer with this code, or none to be believed: for FVI_EMAXITER,
 * FVI_ETOL, FVI_ESING, FVI_EBADFUNC and FVI_ERUNAWAY of fvi_estimate_multistart. If the data need shorter equal steps
 * than a fit makes, the text has their number.
 *
 *   fit, fitted  the question and its answer
 *   names        the names of the parameters, as "alpha,rho"
 *   dashes       the characters before the words starts and sigma: "--" for the program, "" for Python
 *   size, text   as above
 *
 * Returns 1; or 0 for any other code, and text is untouched. */
int fvi_estimate_reason(int status, const fvi_estimation *fit, const fvi_estimate *fitted,
                   const char *names, const char *dashes, size_t size,
                   char *text);

/* fvi_estimate_profile -- Compute the interval of 95 % of one parameter, while the other parameters adapt.  [(24.11)]
 *
 *   fit        the question
 *   fitted     its answer by fvi_estimate_multistart
 *   j          number of the parameter, below fit->parameters
 *   low, high  outputs. For every value between them the least chi^2 over all other parameters, with fitted->sigma, is
 *              at most fitted->chi2 + fitted->quantile^2. If no value is excluded on one side, the output is the bound
 *              of the parameter there: an end of the method's range of alpha, 0 for rho and the mass, or an infinity
 *
 * (24.3) approximates this interval by estimate -+ quantile sd; both are equal if chi^2 is a parabola. The function
 * follows the least chi^2 outward from the fit. It does not look for another minimum beyond a hill. The step is
 * fitted->h. At the ends the square root of the growth of chi^2 is the quantile, to a part in 10^4.
 *
 * Returns FVI_SUCCESS; FVI_EMAXITER if it met a lower chi^2 than that of the fit (no handler is called); FVI_EFAULT if
 * a pointer is NULL; FVI_EINVAL if there is no such parameter; FVI_EDOM if fitted is no answer; FVI_ERUNAWAY as
 * fvi_estimate_multistart; what that function returns for a question that it refuses; FVI_ENOMEM. */
int fvi_estimate_profile(const fvi_estimation *fit, const fvi_estimate *fitted, size_t j,
                    double *low, double *high);

struct fvi_examination;

/* fvi_estimate_design -- Predict the standard deviations of a planned test, before the test is made.  [(24.3), (24.4)]
 *
 *   fit       the plan: method, run with the expected values, times t, sigma > 0, and the parameters to be fitted; x,
 *             low, high and starts are not read
 *   planned   output: estimate has the values of the run; sd and correlation are those of (24.3), from the inverse of
 *             Fisher's matrix; h is the step of the run
 *   examined  output: lower and upper, which are estimate -+ 1.96 sd in the unknowns of the search; unseen and swayed;
 *             no flag is set
 *
 *     if (fvi_estimate_design(&plan, &planned, &examined) == FVI_ESING)
 *         puts("this experiment does not tell them apart");
 *
 * Cost: four runs, and one Jacobian.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_ESING if the data will not determine the parameters;
 * FVI_EUNSUP for records and for huber; FVI_EINVAL without times; FVI_EDOM if sigma is not above 0, or a value is at
 * the end of its range; what fvi_estimate_multistart returns for a question that it refuses, and fvi_stepper_start and
 * fvi_stepper_step for the run; FVI_ENOMEM. */
int fvi_estimate_design(const fvi_estimation *fit, fvi_estimate *planned,
                        struct fvi_examination *examined);

/* Flags of an examination: reasons to doubt an answer.                                          [(24.13) - (24.15)]
 *
 *   NO_MOTION   a constant explains the data as well: no motion was seen
 *   NEIGHBOURS  neighbouring residuals are correlated
 *   OFFSET      the residuals have a mean: the sensor has an offset, or the position of rest is wrong
 *   DRIFT       the residuals have a slope
 *   PATTERN     the residuals have a smooth pattern: the model is not that of the data
 *   VALLEYS     another minimum is nearly as good, and its parameters are outside the intervals
 *   BETTER      a lower chi^2 was met on the way along an interval, or from another minimum
 *   STEP        half the step still moved an estimate, by more than sd / 50
 *   BIASED      half the step moved an estimate by more than one sd
 *   OPEN        the data exclude no value of a parameter
 *
 * Grave flags are NO_MOTION, VALLEYS, BETTER and BIASED. NEIGHBOURS, OFFSET, DRIFT and PATTERN are grave if noise alone
 * makes such residuals in less than one of 10^4 data sets. Do not believe an answer with a grave flag. */
enum {
    FVI_FLAG_NO_MOTION = 1,
    FVI_FLAG_NEIGHBOURS = 2,
    FVI_FLAG_OFFSET = 4,
    FVI_FLAG_DRIFT = 8,
    FVI_FLAG_PATTERN = 16,
    FVI_FLAG_VALLEYS = 32,
    FVI_FLAG_BETTER = 64,
    FVI_FLAG_STEP = 128,
    FVI_FLAG_BIASED = 256,
    FVI_FLAG_OPEN = 512
};

/* fvi_examination -- intervals of 95 %, and reasons to doubt them.
 *
 *   lower, upper  at [j] the interval of parameter j by its profile (24.11)
 *   flags, grave  the flags that are set, and the grave flags among them
 *   probability   five probabilities, in the order of the bits NEIGHBOURS, OFFSET, DRIFT, PATTERN, then NO_MOTION: the
 *                 first four of residuals at least as strange if the model is right; the fifth of a motion at least as
 *                 clear if there is none. 1 if the test is not possible
 *   unseen        [0] the offset of a sensor, [1] its drift over the whole record, in units of sigma, that the tests
 *                 may overlook; 0 if it is fitted
 *   swayed        at [0][j] and [1][j] the number of sd by which that moves parameter j, (24.4)
 *   unseen_column  [0] and [1]: the column, from 0, in which it moves a parameter most
 *   chi2          the least chi^2 of another minimum that raised VALLEYS; infinite if there is none */
typedef struct fvi_examination {
    double lower[FVI_ESTIMATION_MOST], upper[FVI_ESTIMATION_MOST];
    unsigned flags, grave;
    double probability[5];
    double unseen[2], swayed[2][FVI_ESTIMATION_MOST];
    double chi2;
    size_t unseen_column[2];
} fvi_examination;

/* fvi_estimate_examine -- Examine whether an answer can be believed.                           [(24.13) - (24.15)]
 *
 *   fit, fitted  the question, and its answer by fvi_estimate_multistart
 *   examined     output
 *
 *     if (fvi_estimate_multistart(&fit, NULL, &fitted) == FVI_SUCCESS
 *         && fvi_estimate_examine(&fit, &fitted, &examined) == FVI_SUCCESS
 *         && examined.grave == 0)
 *         puts("this answer can be believed");
 *
 * Cost: a profile of each parameter, which takes two or three searches at each end if chi^2 is nearly a parabola, and
 * some twenty in a curved valley; one Jacobian; and one search from each other minimum. If the model is right, chance
 * sets a flag in one of forty data sets.
 *
 * Returns FVI_SUCCESS; what fvi_estimate_profile returns, except FVI_EMAXITER, which sets BETTER. On error *examined is
 * untouched. */
int fvi_estimate_examine(const fvi_estimation *fit, const fvi_estimate *fitted,
                         fvi_examination *examined);

/* fvi_estimate_warning_of_unseen -- Warn if an offset (which = 0) or a drift (which = 1) that the tests may overlook
 * moves a parameter by more than its interval allows. This is no flag, because it is a property of the experiment and
 * not of the data. Arguments and result as fvi_estimate_flag_text. */
int fvi_estimate_warning_of_unseen(const fvi_estimation *fit, const fvi_estimate *fitted,
                                   const fvi_examination *examined, size_t which,
                                   const char *const *names, size_t size, char *text);

/* fvi_estimate_flag_text -- Write what a flag means for this answer.
 *
 *   flag        one flag
 *   names       the names of the fit->parameters parameters
 *   size, text  room for FVI_WARNING_ROOM characters (warnings.h)
 *
 * Returns 1; or 0 if the flag is not set, and text is untouched. */
int fvi_estimate_flag_text(const fvi_estimation *fit, const fvi_estimate *fitted,
                           const fvi_examination *examined, unsigned flag,
                           const char *const *names, size_t size, char *text);

/* fvi_estimate_moduli -- Fit alpha, rho and k to storage and loss moduli.                                [(24.9)]
 *
 *     storage = k + rho w^{2 alpha} cos(pi alpha),   loss = rho w^{2 alpha} sin(pi alpha)
 *
 *   n, w           number of frequencies, n >= 2, and the frequencies, > 0, not all equal, in radians per unit of time
 *   storage, loss  the moduli at these frequencies, n numbers each. The error of each is taken to be proportional to
 *                  (storage^2 + loss^2)^(1/2), which must not be 0; the least squares have weights accordingly
 *   fitted         output: alpha, rho, k in this order, their sd and correlations; sigma is the estimated relative
 *                  error. All other members but quantile, chi2 and probability are 0
 *
 *     if (fvi_estimate_moduli(n, w, storage, loss, &fitted) == FVI_SUCCESS)
 *         printf("alpha = %g -+ %g\n", fitted.estimate[0], fitted.quantile * fitted.sd[0]);
 *
 * For each alpha the best rho and k solve two linear equations. So only alpha is searched, by a scan of (0, 1) and
 * Brent's method, to about 1e-8. rho and k may have either sign. fvi_material_fit (rheology.h) fits any law, with
 * intervals by profiles, but only with orders 2 alpha <= 1 and amplitudes >= 0.
 * Cost: some 150 n powers. Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if n < 2; FVI_EDOM if a
 * number is out of range; FVI_ESING if the data do not determine the three (no handler is called); FVI_EOVRFLW if a
 * number of the answer is not finite; FVI_ENOMEM. */
int fvi_estimate_moduli(size_t n, const double *w, const double *storage,
                   const double *loss, fvi_estimate *fitted);

/* fvi_tangent -- Compute a run by fvi_fractional together with its derivatives by parameters.            [(24.6)]
 *
 *   run       of one mass, for the method fvi_fractional
 *   P, which  number of parameters, P >= 1, and the parameters, all different. A constant must be one that
 *             fvi_parameter_gradient_of knows (sensitivity.h)
 *   x         output: x_k, N + 1 numbers
 *   slope     output: d x_k / d which[j] at [k * P + j], (N + 1) P numbers
 *
 * The function is for callers with a least-squares method of their own; fvi_estimate_multistart uses these derivatives
 * where it can. For several coordinates, laws and other methods use fvi_directional_derivatives (adjoint.h).
 *
 * The slopes are the derivatives of the numbers of the run. (24.6) solves the derived equation of each step, and no
 * difference is taken. For alpha = 1/2 with the past CAPUTO the derivative by alpha is that from below. Cost: a run; a
 * second memory of P coordinates; and a third memory, of x with its rate, if alpha or rho is among the parameters.
 * Accuracy: that of the run with the same memory; there is no proved bound of the rounding errors.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if d != 1, P == 0, or there is no such constant;
 * what fvi_stepper_start, fvi_stepper_step and fvi_history_alloc_by_order return; FVI_EUNSUP for a run with a law;
 * FVI_ESING if m/h + kappa (1 - kappa) h U'' is 0; FVI_EOVRFLW if a slope is not finite; FVI_ENOMEM; what a callback
 * returned. */
int fvi_tangent(const fvi_run *run, size_t P, const fvi_free_parameter *which,
                 double *x, double *slope);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
