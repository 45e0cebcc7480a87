/* src/estimation/identification_data.h -- Give access to the data of a fit, whatever form they have. [H 24]
 *
 * This header is internal; only fvi_estimation_check_data checks anything. The rows of all data form one long column:
 * record by record, and within a record column by column. A **piece** is one column of one record. */
#ifndef FVI_IDENTIFICATION_DATA_H
#define FVI_IDENTIFICATION_DATA_H

#include <fvi/identification.h>

/* A piece. Its rows are first, first + 1, ... of the long column. `shows` is the expression that its sensor measures;
 * NULL for the first coordinate. */
typedef struct {
    size_t first, n, column;
    const double *t, *x;
    double sigma; /* standard deviation of x; 0: unknown */
    const fvi_expression *shows;
} fvi_estimation_piece;

size_t fvi_estimation_records(const fvi_estimation *fit);
size_t fvi_estimation_columns(const fvi_estimation *fit);
size_t fvi_estimation_pieces(const fvi_estimation *fit);
size_t fvi_estimation_rows(const fvi_estimation *fit);

/* Return record r. If the data have no records, the members t and n are set, and measured is NULL. */
fvi_record fvi_estimation_record(const fvi_estimation *fit, size_t r);
fvi_estimation_piece fvi_estimation_piece_of(const fvi_estimation *fit, size_t r, size_t column);
fvi_estimation_piece fvi_estimation_piece_at(const fvi_estimation *fit, size_t k);

int fvi_estimation_knows_sigma(const fvi_estimation *fit);

/* Return the last time of all records; the largest |x| of a column in all records. */
double fvi_estimation_last_time(const fvi_estimation *fit);
double fvi_estimation_size(const fvi_estimation *fit, size_t column);

/* Return the number of steps that a method of equal steps would take to the last time. Their length is fit->h or, if
 * that is 0, the shortest gap between the times. */
double fvi_estimation_equal_steps(const fvi_estimation *fit);

/* Check the data, h and huber. Return what fvi_estimate_multistart returns for them. */
int fvi_estimation_check_data(const fvi_estimation *fit);

#endif
