/* src/fvi/identification.h -- Parameters from a measured motion.     [H 24]
 *
 * Somebody measured x_i at the times t_i, of a body that moves as
 *
 *     m x'' + U'(x) + rho D^{2 alpha} x = F(t).
 *
 * What are alpha, rho, the constants of U, the start? Those for which
 *
 *     chi^2 = sum_i (x(t_i) - x_i)^2 / sigma^2                          (24.1)
 *
 * is least, if the noise is Gaussian and independent. It has several minima
 * (24.5), so the search begins in many places. */
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

enum { FVI_ESTIMATION_MOST = 8 };              /* parameters in a fit */
enum { FVI_ESTIMATION_OTHERS = 4 };    /* other minima that are kept */
enum { FVI_FIT_MOST_STEPS = 1 << 22 }; /* of a run; a fit is hundreds of them */
enum { FVI_FIT_MOST_EQUAL_STEPS = 1 << 17 }; /* of a run whose steps are equally long */

/* fvi_estimation -- a question: data, model, what is unknown in it.
 *
 *   method     integrator; one of high order, as fvi_estimate_method has one: its error
 *              counts as if it were in the data
 *   run        the model: masses, potential or matrices, dampers, force, past, and the values
 *              of all parameters that are not fitted; those that are, are one of the starts.
 *              run->h and run->steps are not read
 *   constants  NULL, or the numbers that the potential reads as its params; the fit
 *              writes to them, and leaves them as they were
 *   n, t, x    data of the first coordinate, n > parameters; t from t[0] >= 0 on increasing,
 *              finite, in any spacing
 *   sigma      standard deviation of each x, finite; 0: unknown
 *   records, columns, record  0, 0 and NULL; or as many records (records.h), each with so many
 *              columns, and n, t, x and sigma are not read. Where no sigma is known that of each
 *              column is estimated
 *   huber      0: least squares; k > 0: a residual r, in sigma, counts r^2 up to k and 2 k |r| - k^2
 *              beyond, so that a few wrong readings count little. 1.345 is usual  [(24.19)]
 *   parameters, which  how many, at most FVI_ESTIMATION_MOST, and which, all different
 *   low, high  NULL, or the box from which the starts are taken, a number for each
 *              parameter, low < high; fvi_estimate_box stands for NULL. No bounds: the
 *              search may leave it, but alpha stays within what the method knows and
 *              rho and the mass stay positive
 *   starts     how many searches, >= 2
 *   h          0: the step is found; else it is h at most, and not halved. No step is shorter than the
 *              last time divided by FVI_FIT_MOST_EQUAL_STEPS: a shorter h is FVI_EDOM */
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

/* fvi_estimate -- the answer. Numbers of parameter j stand at [j]. */
typedef struct {
    double estimate[FVI_ESTIMATION_MOST];
    double sd[FVI_ESTIMATION_MOST]; /* (24.3) */
    double correlation[FVI_ESTIMATION_MOST][FVI_ESTIMATION_MOST];
    double quantile; /* 95 %: estimate -+ quantile sd; normal's, or Student's */
    double sigma;    /* of the first column: as given, or sqrt(sum of squares / (n - parameters)) */
    double chi2;     /* (24.1) with that sigma; robust: (24.20) */
    double
        probability; /* of a chi^2 beyond that one, on its side; 1 if sigma is
                           estimated */
    double
        neighbours; /* correlation of neighbouring residuals: about 0 -+ n^(-1/2) if
                           the model is right */
    size_t agree; /* starts that led here */
    double h;     /* step of the last run */
    double bias;  /* what the last halving changed, in sd, at most; changes
                           below 1e-7 of an estimate's size do not count */
    double reached; /* after FVI_ERUNAWAY: the time that the last run came to */
    size_t others;  /* places, not within a standard deviation of this one or of each other,
                       where other starts ended, the best first */
    double other[FVI_ESTIMATION_OTHERS][FVI_ESTIMATION_MOST];
    double column_sigma[FVI_MEASURED_MOST]; /* of each column, given or estimated */
    double loss_unit; /* 1; robust: what makes chi2 grow by 1 where a parameter moves by an sd */
} fvi_estimate;

/* fvi_estimate_method -- the method that suits the data: fvi_lobatto_m4; fvi_variable_step where equal
 * steps as short as the least gap of the times, or as a radian of the fastest swing about the start,
 * would be more than 8192; fvi_lobatto_d4 with matrices, and with a coordinate without inertia. fit->method is not read;
 * nothing is checked but what fvi_estimate_multistart checks: NULL for a question that cannot be asked. */
const fvi_method *fvi_estimate_method(const fvi_estimation *fit);

/* fvi_estimate_box -- a box of plausible starts, by the size and the frequency of the data.
 *
 *   fit        low and high are not read
 *   low, high  output, fit->parameters numbers each
 *
 * With w where the periodogram of x - mean is largest, A = max |x - mean|, m the
 * mass of fit->run:
 *
 *     alpha  what the method knows         rho        m w^{2 - 2 alpha} (1/50 ... 2),
 *     m      m (1/3 ... 3)                            alpha = 1/2
 *     x0     mean -+ 3/2 A                 constant 0   m w^2 (1/10 ... 4)
 *     p0     -+ 3/2 m w A                  others       m w^2 / A^2 (-1/2 ... 2)
 *
 * of several columns or coordinates mean is 0, A the largest |x|, and w that of the first column. Where
 * the largest force is above 1000 m w^2 A, the body's inertia is nothing beside it, and m w^2 stands
 * for that force over A. Cost: min(n, 1024)^2 sines. Errors as fvi_estimate_multistart. */
int fvi_estimate_box(const fvi_estimation *fit, double *low, double *high);

/* fvi_estimate_multistart -- the least chi^2, from several starts.     [(24.1) - (24.4)]
 *
 *   fit     the question
 *   curve   NULL, or output: x(t_i) of the fitted motion, n numbers
 *   fitted  output
 *
 * Levenberg's and Marquardt's method by GSL, with the slopes of (24.6) for fvi_fractional
 * and of (24.12) for the methods with stages of H 17, without a law and with constants
 * that fvi_parameter_gradient_of knows, else with differences, in
 * alpha's logit, ln rho and ln m, from the values of the run and from fit->starts - 1
 * points of Sobol's sequence in the box. If sigma is given and the best chi^2 so far is below
 * its quantile of 0.99, a start whose last ten iterations promise no better one is given up,
 * and taken up again if fewer than two agree without it. A start agrees with the best if all its
 * parameters come within sd / 10 of those, or within 1e-6 of their size, which is
 * |theta|, but of x0, p0 and constants at least a sixteenth of the box, or of that of
 * fvi_estimate_box if it is smaller. Then the step, at first the longest that meets all times
 * and is no longer than 1/w, is halved until no estimate moves by more than sd / 100, or
 * 1e-7 of its size; no further than to 2^17 steps, and only while that shortens the moves
 * (bias is the last). Times that no step meets are read off by Hermite's cubic through x
 * and p / m, or as a method of variable steps has them.
 *
 * The searches are repeatable: the same digits each time. Time: seen 60 to 170 runs a
 * start, two to five parameters, 200 points, by differences; each search ends after 60 iterations, P + 1
 * runs each if all goes well. The halvings are one search each, the last of up to 2^17
 * steps a run. fit->constants is written to while it works: no other thread may read them.
 *
 * Returns FVI_SUCCESS; three answers of which no handler is called, *fitted and curve
 * being written: FVI_EMAXITER if fewer than two starts agree on the best, FVI_ETOL
 * if sigma is given and chi^2 has a probability below 1e-6, FVI_ESING if the data do
 * not determine the parameters (sd and correlation are of no use then). FVI_EOVRFLW if a
 * number of the answer is not finite, FVI_ERUNAWAY if three runs take more steps than
 * run->most_steps, or FVI_FIT_MOST_STEPS if that is 0 (bias may be NaN: no halving was asked for). FVI_EFAULT if
 * a pointer is NULL; FVI_EINVAL if the system has not d == 1, if parameters is 0 or
 * above FVI_ESTIMATION_MOST, if n is not larger, if starts < 2, if t does not increase, or
 * which has one twice; FVI_EDOM if sigma < 0 or a number is not finite or low is not
 * below high; FVI_EUNSUP if alpha is to be fitted and the method knows but one, or the run
 * has a law, which does not read it (rho, then, is what multiplies the law); what
 * fvi_system_check returns; FVI_EBADFUNC if the model fails from every start, or
 * what the potential or the force returned there, where that is a code of its own;
 * FVI_ENOMEM. GSL 2.7 frees no half of a solver, so it is asked for one only where there is room
 * for a whole one. */
int fvi_estimate_multistart(const fvi_estimation *fit, double *curve, fvi_estimate *fitted);

/* fvi_estimate_warning_of_... -- what to know before an answer is believed, as the functions of
 * warnings.h: 1 and a text, or 0, and the text is untouched. Nothing is checked.
 *
 *   pair   the data can hardly tell parameters i and j apart: |correlation| > 0.9, not for
 *          an answer with FVI_ESING. The names are for the text
 *   initial_history  no motion has these estimates (fvi_warning_of_initial_history); a constant
 *          text, or NULL
 *
 *   fit, fitted  the question and its answer
 *   size, text   room for FVI_WARNING_ROOM characters; longer names are cut */
int fvi_estimate_warning_of_pair(const fvi_estimate *fitted, size_t i, size_t j,
                            const char *name_i, const char *name_j, size_t size,
                            char *text);
const char *fvi_estimate_warning_of_initial_history(const fvi_estimation *fit,
                                    const fvi_estimate *fitted);

/* fvi_estimate_reason -- 1 and a text, why there is no answer with this code, or none to be
 * believed: FVI_EMAXITER, FVI_ETOL, FVI_ESING, FVI_EBADFUNC and FVI_ERUNAWAY of
 * fvi_estimate_multistart; 0 for another code. Where equal steps that are as short as the data
 * need would be more than a fit makes, the text says how many they are.
 *
 *   fit, fitted  the question and its answer
 *   names   of the parameters, as the text has them: "alpha,rho"
 *   dashes  what stands before the words starts and sigma: "--", or ""
 *   size, text   as above */
int fvi_estimate_reason(int status, const fvi_estimation *fit, const fvi_estimate *fitted,
                   const char *names, const char *dashes, size_t size,
                   char *text);

/* fvi_estimate_profile -- the interval of one parameter, the others making up for it. [(24.11)]
 *
 *   fit        the question
 *   fitted     its answer, by fvi_estimate_multistart
 *   j          which parameter, below fit->parameters
 *   low, high  output: all values between them have, with the others at their best, a
 *              chi^2, with fitted->sigma, of at most fitted->chi2 + fitted->quantile^2.
 *              Where that never ends, what bounds the parameter: an end of what the
 *              method knows of alpha, 0 of rho and the mass, or an infinity
 *
 * That is the interval of 95 % for which (24.3) has estimate -+ quantile sd, and the same
 * where chi^2 is a parabola. It is followed from the fit outward, the others from where
 * they were; another minimum, beyond a hill, is not looked for. The step is fitted->h. The
 * root of what chi^2 grows by is the quantile, at the ends, to a part in 10^4.
 *
 * Returns FVI_SUCCESS; FVI_EMAXITER, of which no handler is called, if a lower chi^2 than
 * that of the fit was met; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if there is no such
 * parameter; FVI_EDOM if fitted is no answer; what fvi_estimate_multistart returns for a question
 * that cannot be asked; FVI_ENOMEM. */
int fvi_estimate_profile(const fvi_estimation *fit, const fvi_estimate *fitted, size_t j,
                    double *low, double *high);

struct fvi_examination;

/* fvi_estimate_design -- what a planned test will tell, before it is made.      [(24.3), (24.4)]
 *
 *   fit       the plan: method, run with the values that are expected, times t, sigma > 0, and
 *             which parameters shall be fitted; x, low, high and starts are not read
 *   planned   output: estimate are the values of the run, sd and correlation those of (24.3), which
 *             are the inverse of Fisher's matrix, and h the step of the run
 *   examined  output: lower and upper, estimate -+ 1.96 sd in the numbers of the search, and
 *             unseen and swayed; no flag is up
 *
 *     if (fvi_estimate_design(&plan, &planned, &examined) == FVI_ESING)
 *         puts("this experiment does not tell them apart");
 *
 * Cost: four runs, and a Jacobian. Returns FVI_SUCCESS; FVI_ESING if the data will not determine
 * the parameters; FVI_EUNSUP for records and huber; FVI_EDOM if sigma is not above 0 or a value is at the end of its range; what
 * fvi_estimate_multistart returns for a question that cannot be asked, and fvi_stepper_start and
 * fvi_stepper_step for the run; FVI_ENOMEM. */
int fvi_estimate_design(const fvi_estimation *fit, fvi_estimate *planned,
                        struct fvi_examination *examined);

/* What speaks against an answer: bits of fvi_examination.flags.          [(24.13) - (24.15)]
 *
 *   NO_MOTION   a constant explains the data as well: nothing was seen to move
 *   NEIGHBOURS  neighbouring residuals are alike
 *   OFFSET      the residuals have a mean: the sensor has an offset, or the rest is elsewhere
 *   DRIFT       the residuals have a slope
 *   PATTERN     the residuals have a smooth pattern: the model is not that of the data
 *   VALLEYS     another minimum is nearly as good, and its parameters are not in the intervals
 *   BETTER      on the way along an interval a lower chi^2 was met
 *   STEP        half the step still moved the estimates, by more than sd / 50
 *   BIASED      it moved them by more than a standard deviation
 *   OPEN        all values of a parameter are possible
 *
 * Grave are NO_MOTION, VALLEYS, BETTER and BIASED, and the four of the residuals where noise alone
 * makes such ones in less than one of 10^4 data sets: the answer is not to be believed. */
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

/* fvi_examination -- intervals of 95 %, and what speaks against them.
 *
 *   lower, upper  the interval of the profile (24.11) of parameter j at [j]
 *   flags, grave  bits as above: all that are up, and the grave ones of them
 *   probability   of residuals as strange as these if the model is right: by their neighbours,
 *                 mean, slope and pattern, and by the motion that is none, in the order of the
 *                 bits; 1 where that cannot be asked
 *   unseen        how large an offset of the sensor, and a drift over the whole record, in sigma,
 *                 the tests may overlook; 0 where it is fitted
 *   swayed        by how many sd that moves parameter j, (24.4)
 *   unseen_column  of which column, from 0: that where it moves a parameter most
 *   chi2          of the best of the other minima, infinite if there is none */
typedef struct fvi_examination {
    double lower[FVI_ESTIMATION_MOST], upper[FVI_ESTIMATION_MOST];
    unsigned flags, grave;
    double probability[5];
    double unseen[2], swayed[2][FVI_ESTIMATION_MOST];
    double chi2;
    size_t unseen_column[2];
} fvi_examination;

/* fvi_estimate_examine -- can this answer be believed?                  [(24.13) - (24.15)]
 *
 *   fit, fitted  the question, and its answer by fvi_estimate_multistart
 *   examined     output
 *
 * Cost: a profile of each parameter, two or three searches an end where chi^2 is nearly a
 * parabola and some twenty in a bent valley; a Jacobian; a search from each of the other
 * minima. If a flag is up by chance, with a model that is right, it is one of forty data sets.
 *
 *     if (fvi_estimate_multistart(&fit, NULL, &fitted) == FVI_SUCCESS
 *         && fvi_estimate_examine(&fit, &fitted, &examined) == FVI_SUCCESS
 *         && examined.grave == 0) ...
 *
 * Returns FVI_SUCCESS; what fvi_estimate_profile returns, but for FVI_EMAXITER, which is a
 * flag here. */
int fvi_estimate_examine(const fvi_estimation *fit, const fvi_estimate *fitted,
                         fvi_examination *examined);

/* fvi_estimate_warning_of_unseen -- 1 and a text if an offset (which = 0) or a drift (1) that the
 * tests may overlook moves a parameter by more than its interval allows. That is no flag: it says
 * of the experiment what nobody sees in the data. As fvi_estimate_flag_text. */
int fvi_estimate_warning_of_unseen(const fvi_estimation *fit, const fvi_estimate *fitted,
                                   const fvi_examination *examined, size_t which,
                                   const char *const *names, size_t size, char *text);

/* fvi_estimate_flag_text -- 1 and what a flag says, or 0 if it is not up.
 *
 *   flag        one bit
 *   names       of the parameters, fit->parameters of them
 *   size, text  room for FVI_WARNING_ROOM characters */
int fvi_estimate_flag_text(const fvi_estimation *fit, const fvi_estimate *fitted,
                           const fvi_examination *examined, unsigned flag,
                           const char *const *names, size_t size, char *text);

/* fvi_estimate_moduli -- alpha, rho and k from storage and loss.             [(24.9)]
 *
 *     storage = k + rho w^{2 alpha} cos(pi alpha),   loss = rho w^{2 alpha} sin(pi alpha)
 *
 *   n, w           frequencies, n >= 2, > 0, two different ones at least
 *   storage, loss  the moduli there, each with an error in proportion to
 *                  (storage^2 + loss^2)^(1/2), which is not 0; the least squares are so
 *                  weighed
 *   fitted         output: alpha, rho, k in this order, their sd and correlations; sigma
 *                  is that relative error, estimated. The rest but quantile, chi2 and
 *                  probability is 0
 *
 * For each alpha the best rho and k solve two linear equations, so alpha alone is searched: a
 * scan of (0, 1), then Brent's method, to about 1e-8. rho and k may have either sign.
 * fvi_material_fit (rheology.h) fits any law, with intervals of profiles, but only orders
 * 2 alpha <= 1 and amplitudes that are not negative.
 * Cost: some 150 n powers. Returns FVI_SUCCESS; FVI_EFAULT if a pointer is
 * NULL; FVI_EINVAL if n < 2; FVI_EDOM if a number is out of range; FVI_ESING, of which no
 * handler is called, if the data do not determine the three; FVI_EOVRFLW if a number of the
 * answer is not finite; FVI_ENOMEM. */
int fvi_estimate_moduli(size_t n, const double *w, const double *storage,
                   const double *loss, fvi_estimate *fitted);

/* fvi_tangent -- a run of Algorithm 3 and its derivatives, side by side.  [(24.6)]
 *
 *   run    of one mass, for the method fvi_fractional
 *   P, which  the parameters by which it is differentiated, P >= 1, all different; a
 *          constant is one that fvi_parameter_gradient_of knows (sensitivity.h)
 *   x      output: x_k, N + 1 numbers
 *   slope  output: d x_k / d which[j] at [k * P + j], (N + 1) P numbers
 *
 * For those who solve least squares of their own; fvi_estimate_multistart takes them where it can. Of many
 * coordinates, of laws and of other methods fvi_directional_derivatives (adjoint.h) has them.
 * They are the derivatives of what the program computes, as (24.6) solves the derived
 * equation of each step: no difference is taken. At alpha = 1/2, CAPUTO, the derivative
 * by alpha is that from below. Cost: a run, a second memory of P coordinates, a third of
 * x with its rate if alpha or rho is asked for. Accuracy: that of the run with the same
 * memory; no bound is proved for the rounding. Returns FVI_SUCCESS; FVI_EFAULT if a
 * pointer is NULL; FVI_EINVAL if the system has not d == 1, P == 0, or there is no such
 * constant; what fvi_stepper_start, fvi_stepper_step and fvi_history_alloc_by_order return; FVI_EUNSUP for a
 * run with a law; FVI_ESING if m/h + kappa (1 - kappa) h U'' is 0; FVI_EOVRFLW if a slope is
 * not finite; FVI_ENOMEM; what a callback returned. */
int fvi_tangent(const fvi_run *run, size_t P, const fvi_free_parameter *which,
                 double *x, double *slope);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
