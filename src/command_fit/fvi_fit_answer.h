/* src/command_fit/fvi_fit_answer.h -- Hold what `fvi fit` was asked, and print its answer. */
#ifndef FVI_FIT_ANSWER_H
#define FVI_FIT_ANSWER_H

#include <fvi/fvi.h>
#include "command_shared/fvi_subcommand_options.h"

#include <stdio.h>

/* Indices of its own options, as in words.own[FIT]. */
enum { FIT, SIGMA, STARTS, COMPARE, HUBER, CURVE };

/* The options of a fit and the data that were read. Without --compare `columns` is 0, and there is one column, x. */
typedef struct {
    fvi_subcommand_options words;
    fvi_options o;
    fvi_system system; /* system of the options o */
    fvi_run run;
    fvi_free_parameter which[FVI_ESTIMATION_MOST];
    const char *name[FVI_ESTIMATION_MOST];
    char names[400], preset[400]; /* texts that --fit and its preset are split into */
    fvi_estimation fit;
    double low[FVI_ESTIMATION_MOST], high[FVI_ESTIMATION_MOST];
    size_t columns;
    char sensor[FVI_MEASURED_MOST][FVI_SENSOR_ROOM];
    const char *column[FVI_MEASURED_MOST];
    fvi_expression *shows[FVI_MEASURED_MOST];
    double sigma[FVI_MEASURED_MOST];
    fvi_record *record;
    struct fvi_fit_record *read; /* what the records are made of */
    size_t points;
    double *t, *curve; /* times of a plan; fitted motion at all rows */
} fvi_fit_request;

/* Return nonzero if the constants are those of --let, because the potential or the Lagrangian is an expression. */
int fvi_fit_has_lets(const fvi_options *o);

/* Read the parameters of --fit into r->which and r->name. Return 0, or nonzero with the error filled in. */
int fvi_fit_names(fvi_fit_request *r, fvi_error *c);

/* Print everything after the head: estimates, intervals, correlations, warnings and flags. */
void fvi_fit_print_answer(FILE *out, const fvi_fit_request *r,
                          const fvi_estimate *f, const fvi_examination *e);

/* Print the same for a plan: the standard deviations and correlations to be expected. */
void fvi_fit_print_plan(FILE *out, const fvi_fit_request *r, const fvi_estimate *f,
                        const fvi_examination *e);

/* Print only the flags, to standard error and, unless `out` is NULL, to the table. */
void fvi_fit_print_flags(FILE *out, const fvi_fit_request *r, const fvi_estimate *f,
                         const fvi_examination *e);

/* Print the table of --curve, if it is asked for. Return an exit code. */
int fvi_fit_print_curve(const fvi_fit_request *r);

/* Print on standard error why there is no answer that can be believed. Return 1. */
int fvi_fit_complain(int status, const fvi_fit_request *r, const fvi_estimate *f);

#endif
