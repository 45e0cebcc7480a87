/* src/estimation/identification_data.h -- The data of a question, whatever form they have.
 *                                                                     [H 24]
 *
 * Internal: nothing is checked here but by fvi_estimation_check_data. The rows of all data stand in
 * one long column: record by record, and in a record column by column. A **piece** is one column of
 * one record. */
#ifndef FVI_IDENTIFICATION_DATA_H
#define FVI_IDENTIFICATION_DATA_H

#include <fvi/identification.h>

/* Rows first, first + 1, ... of all; what its sensor shows, NULL: the first coordinate. */
typedef struct {
    size_t first, n, column;
    const double *t, *x;
    double sigma; /* 0: unknown */
    const fvi_expression *shows;
} fvi_estimation_piece;

size_t fvi_estimation_records(const fvi_estimation *fit);
size_t fvi_estimation_columns(const fvi_estimation *fit);
size_t fvi_estimation_pieces(const fvi_estimation *fit);
size_t fvi_estimation_rows(const fvi_estimation *fit);

/* Record r; of a question without records measured is NULL. */
fvi_record fvi_estimation_record(const fvi_estimation *fit, size_t r);
fvi_estimation_piece fvi_estimation_piece_of(const fvi_estimation *fit, size_t r, size_t column);
fvi_estimation_piece fvi_estimation_piece_at(const fvi_estimation *fit, size_t k);

int fvi_estimation_knows_sigma(const fvi_estimation *fit);

/* The last time of all records; the largest |x| of a column in all records. */
double fvi_estimation_last_time(const fvi_estimation *fit);
double fvi_estimation_size(const fvi_estimation *fit, size_t column);

/* The steps that a method of equal steps would take to the last time: of the length asked for,
 * or of the shortest gap between the times. */
double fvi_estimation_equal_steps(const fvi_estimation *fit);

/* As fvi_estimate_multistart, of data, h and huber. */
int fvi_estimation_check_data(const fvi_estimation *fit);

#endif
