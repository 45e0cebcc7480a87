/* src/program/fvi_fit_answer.h -- What `fvi fit` was asked, and what it prints. */
#ifndef FVI_FIT_ANSWER_H
#define FVI_FIT_ANSWER_H

#include <fvi/fvi.h>
#include "fvi_own_words.h"

#include <stdio.h>

/* Its own options, words.own[FIT] and so on. */
enum { FIT, SIGMA, STARTS, CURVE };

/* What the words say, and what is read. */
typedef struct {
    fvi_own_words words;
    fvi_options o;
    fvi_parameter which[FVI_FIT_MOST];
    const char *name[FVI_FIT_MOST];
    char names[80]; /* in pieces */
    fvi_fit fit;
    double low[FVI_FIT_MOST], high[FVI_FIT_MOST];
    double *t, *x, *curve;
} fvi_fit_request;

/* Behind the words: estimates, correlations, warnings, profiles. */
void fvi_fit_print_answer(FILE *out, const fvi_fit_request *r,
                          const fvi_fitted *f);

/* The table of --curve, if it is asked for. Returns the exit code. */
int fvi_fit_print_curve(const fvi_fit_request *r);

/* Why there is no answer that can be believed, to standard error. Returns 1. */
int fvi_fit_complain(int status, const fvi_fit_request *r, const fvi_fitted *f);

#endif
