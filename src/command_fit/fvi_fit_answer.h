/* src/command_fit/fvi_fit_answer.h -- What `fvi fit` was asked, and what it prints. */
#ifndef FVI_FIT_ANSWER_H
#define FVI_FIT_ANSWER_H

#include <fvi/fvi.h>
#include "command_shared/fvi_subcommand_options.h"

#include <stdio.h>

/* Its own options, words.own[FIT] and so on. */
enum { FIT, SIGMA, STARTS, COMPARE, HUBER, CURVE };

/* What the words say, and what is read. Without --compare columns is 0, and one column is x. */
typedef struct {
    fvi_subcommand_options words;
    fvi_options o;
    fvi_system system; /* of o */
    fvi_run run;
    fvi_free_parameter which[FVI_ESTIMATION_MOST];
    const char *name[FVI_ESTIMATION_MOST];
    char names[400], preset[400]; /* in pieces; without --fit */
    fvi_estimation fit;
    double low[FVI_ESTIMATION_MOST], high[FVI_ESTIMATION_MOST];
    size_t columns;
    char sensor[FVI_MEASURED_MOST][FVI_SENSOR_ROOM];
    const char *column[FVI_MEASURED_MOST];
    fvi_expression *shows[FVI_MEASURED_MOST];
    double sigma[FVI_MEASURED_MOST];
    fvi_record *record;
    struct fvi_fit_record *read; /* what they are made of */
    size_t points;
    double *t, *curve; /* the times of a plan; the fitted motion, of all rows */
} fvi_fit_request;

/* Are the constants those of --let: of a potential, or a Lagrangian, that is an expression? */
int fvi_fit_has_lets(const fvi_options *o);

/* The parameters of --fit, into which and name. Returns 0, or 2 with the error written. */
int fvi_fit_names(fvi_fit_request *r, fvi_error *c);

/* Behind the words: estimates, intervals, correlations, warnings, flags. */
void fvi_fit_print_answer(FILE *out, const fvi_fit_request *r,
                          const fvi_estimate *f, const fvi_examination *e);

/* The same of a plan: standard deviations and correlations that are expected. */
void fvi_fit_print_plan(FILE *out, const fvi_fit_request *r, const fvi_estimate *f,
                        const fvi_examination *e);

/* The flags alone, to standard error. */
void fvi_fit_warn_of_flags(const fvi_fit_request *r, const fvi_estimate *f,
                           const fvi_examination *e);

/* The table of --curve, if it is asked for. Returns the exit code. */
int fvi_fit_print_curve(const fvi_fit_request *r);

/* Why there is no answer that can be believed, to standard error. Returns 1. */
int fvi_fit_complain(int status, const fvi_fit_request *r, const fvi_estimate *f);

#endif
