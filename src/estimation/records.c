/* src/estimation/records.c -- Give access to the records of a laboratory, and check them.                  [H 24] */
#include "identification_data.h"

#include "system/fail.h"
#include "system/larger.h"

#include <math.h>

/* ---- a question's data ---- */

size_t fvi_estimation_records(const fvi_estimation *fit)
{
    return fit->records > 0 ? fit->records : 1;
}

size_t fvi_estimation_columns(const fvi_estimation *fit)
{
    return fit->records > 0 ? fit->columns : 1;
}

fvi_record fvi_estimation_record(const fvi_estimation *fit, size_t r)
{
    return fit->records > 0 ? fit->record[r] : (fvi_record){ .n = fit->n, .t = fit->t };
}

size_t fvi_estimation_pieces(const fvi_estimation *fit)
{
    return fvi_estimation_records(fit) * fvi_estimation_columns(fit);
}

fvi_estimation_piece fvi_estimation_piece_of(const fvi_estimation *fit, size_t r, size_t column)
{
    const fvi_record record = fvi_estimation_record(fit, r);
    const fvi_measured plain = { fit->x, fit->sigma, NULL },
                       *m = fit->records > 0 ? record.measured + column : &plain;
    size_t first = column * record.n;
    for (size_t i = 0; i < r; i++)
        first += fit->record[i].n * fit->columns;
    return (fvi_estimation_piece){ first, record.n, column, record.t, m->x, m->sigma, m->shows };
}

fvi_estimation_piece fvi_estimation_piece_at(const fvi_estimation *fit, size_t k)
{
    const size_t columns = fvi_estimation_columns(fit);
    return fvi_estimation_piece_of(fit, k / columns, k % columns);
}

size_t fvi_estimation_rows(const fvi_estimation *fit)
{
    const fvi_estimation_piece last =
        fvi_estimation_piece_at(fit, fvi_estimation_pieces(fit) - 1);
    return last.first + last.n;
}

int fvi_estimation_knows_sigma(const fvi_estimation *fit)
{
    return fvi_estimation_piece_at(fit, 0).sigma > 0;
}

double fvi_estimation_last_time(const fvi_estimation *fit)
{
    double last = 0;
    for (size_t r = 0; r < fvi_estimation_records(fit); r++) {
        const fvi_record record = fvi_estimation_record(fit, r);
        last = larger(last, record.t[record.n - 1]);
    }
    return last;
}

double fvi_estimation_size(const fvi_estimation *fit, size_t column)
{
    double size = 0;
    for (size_t r = 0; r < fvi_estimation_records(fit); r++) {
        const fvi_estimation_piece p = fvi_estimation_piece_of(fit, r, column);
        size = larger(size, largest_abs(p.n, p.x));
    }
    return size;
}

/* ---- is it one? ---- */

static int check_times(size_t n, const double *t)
{
    if (!fvi_all_finite(n, t) || t[0] < 0)
        FVI_FAIL("data are finite; t, sigma, h not negative", FVI_EDOM);
    for (size_t i = 1; i < n; i++)
        if (!(t[i] > t[i - 1]))
            FVI_FAIL("the times increase", FVI_EINVAL);
    return FVI_SUCCESS;
}

static int check_piece(const fvi_estimation *fit, const fvi_estimation_piece *p, int known)
{
    if (!p->x)
        FVI_FAIL("a pointer of the fit is NULL", FVI_EFAULT);
    if (!fvi_all_finite(p->n, p->x) || !isfinite(p->sigma) || p->sigma < 0)
        FVI_FAIL("data are finite; t, sigma, h not negative", FVI_EDOM);
    if ((p->sigma > 0) != known)
        FVI_FAIL("sigma is known of all columns, or of none", FVI_EINVAL);
    if (p->shows && fvi_expression_variables(p->shows) != 2 * fit->run->system->d + 1)
        FVI_FAIL("a sensor shows an expression of x, v and t", FVI_EINVAL);
    return FVI_SUCCESS;
}

static int check_records(const fvi_estimation *fit)
{
    const size_t d = fit->run->system->d;
    if (!fit->record)
        FVI_FAIL("a pointer of the fit is NULL", FVI_EFAULT);
    if (fit->columns == 0 || fit->columns > FVI_MEASURED_MOST)
        FVI_FAIL("a record has 1 to 8 columns", FVI_EINVAL);
    for (size_t r = 0; r < fit->records; r++) {
        const fvi_record *o = fit->record + r;
        if (!o->t || !o->measured)
            FVI_FAIL("a pointer of a record is NULL", FVI_EFAULT);
        if (o->n == 0)
            FVI_FAIL("a record has rows", FVI_EINVAL);
        if ((o->x0 && !fvi_all_finite(d, o->x0)) || (o->p0 && !fvi_all_finite(d, o->p0)))
            FVI_FAIL("the start of a record is finite", FVI_EDOM);
    }
    return FVI_SUCCESS;
}

int fvi_estimation_check_data(const fvi_estimation *fit)
{
    int status = fit->records > 0 ? check_records(fit) : FVI_SUCCESS;
    if (status)
        return status;
    if (fit->records == 0 && (!fit->t || !fit->x))
        FVI_FAIL("a pointer of the fit is NULL", FVI_EFAULT);
    if (fvi_estimation_rows(fit) <= fit->parameters)
        FVI_FAIL("a fit needs more data than parameters", FVI_EINVAL);
    if (!isfinite(fit->h) || fit->h < 0 || !isfinite(fit->huber) || fit->huber < 0)
        FVI_FAIL("h and huber are finite and not negative", FVI_EDOM);
    const int known = fvi_estimation_knows_sigma(fit);
    for (size_t r = 0; !status && r < fvi_estimation_records(fit); r++) {
        const fvi_record record = fvi_estimation_record(fit, r);
        for (size_t c = 0; !status && c < fvi_estimation_columns(fit); c++) {
            const fvi_estimation_piece p = fvi_estimation_piece_of(fit, r, c);
            status = check_piece(fit, &p, known);
        }
        if (!status)
            status = check_times(record.n, record.t);
    }
    return status;
}
