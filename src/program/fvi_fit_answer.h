/* src/program/fvi_fit_answer.h -- What `fvi fit` was asked, and what it prints. */
#ifndef FVI_FIT_ANSWER_H
#define FVI_FIT_ANSWER_H

#include <fvi/fvi.h>
#include "fvi_subcommand_options.h"

#include <stdio.h>

/* Its own options, words.own[FIT] and so on. */
enum { FIT, SIGMA, STARTS, CURVE };

/* What the words say, and what is read. */
typedef struct {
    fvi_subcommand_options words;
    fvi_options o;
    fvi_free_parameter which[FVI_ESTIMATION_MOST];
    const char *name[FVI_ESTIMATION_MOST];
    char names[200], preset[200]; /* in pieces; without --fit */
    fvi_estimation fit;
    double low[FVI_ESTIMATION_MOST], high[FVI_ESTIMATION_MOST];
    double *t, *x, *curve;
} fvi_fit_request;

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
