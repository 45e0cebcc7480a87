/* src/frequency/poles.c -- Find all poles of a system, or the lowest.        [H 30] */
#include "oscillator_poles.h"
#include "pole_boxes.h"
#include "pole_count.h"
#include "pole_search.h"
#include "undamped_modes.h"

#include "matrices/sparse.h"
#include "system/larger.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum {
    ALL_ARE_SOUGHT = 64, /* up to this number of unknowns all poles are found, and the lowest are chosen */
    SPARE_MODES = 4,     /* modes beyond those that are asked for */
    MOST_OF_ONE = 8,     /* most poles of one oscillator */
    FOLDS = 12           /* factors of e below and above starts and poles, within which poles are counted */
};
#define ABOVE 1.1 /* times the highest estimate of those that are asked for */

/* The search from n undamped modes, with room for `room` candidates. */
typedef struct {
    fvi_response *response;
    size_t d, n, room, count, wanted;
    int all_are_there; /* nonzero if there are d poles by the theorem */
    double *lambda, *mode;
    double low, high;  /* of ln |s|: poles are counted beyond these, which starts and poles have extended */
    fvi_pole_candidate *candidate;
    double complex *shapes, *form; /* form: a number for each term of Z */
} search;

static void search_free(search *s)
{
    free(s->lambda);
    free(s->candidate);
    free(s->shapes);
}

static int search_alloc(fvi_response *r, size_t count, search *s)
{
    const size_t d = r->d;
    const int all = d <= ALL_ARE_SOUGHT || d - count < SPARE_MODES;
    *s = (search){ .response = r, .d = d, .n = all ? d : count + SPARE_MODES, .wanted = count,
                    .low = INFINITY, .high = -INFINITY };
    s->room = s->n + (d <= FVI_ALWAYS_DENSE ? d + MOST_OF_ONE : 0); /* laws have poles of their own */
    s->lambda = malloc(s->n * (d + 1) * sizeof *s->lambda);
    s->mode = s->lambda + s->n;
    s->candidate = calloc(s->room, sizeof *s->candidate);
    s->shapes = malloc((s->room * d + r->terms) * sizeof *s->shapes);
    s->form = s->shapes + s->room * d;
    for (size_t k = 0; s->candidate && k < s->room; k++)
        s->candidate[k].v = s->shapes + k * d;
    return s->lambda && s->candidate && s->shapes ? FVI_SUCCESS : FVI_ENOMEM;
}

static void extend_range(search *s, double size)
{
    if (size > 0) {
        s->low = smaller(s->low, log(size));
        s->high = larger(s->high, log(size));
    }
}

/* Set candidate k to its undamped mode. */
static void restart_candidate(search *s, size_t k)
{
    fvi_pole_candidate *p = &s->candidate[k];
    for (size_t i = 0; i < s->d; i++)
        p->v[i] = s->mode[k * s->d + i];
    p->s = fvi_pole_start(s->response, s->lambda[k], p->v, s->form);
    p->residual = 1;
}

/* If the theorem does not apply, poles may be real. So a pole that is nearly real is then no oscillation. */
static int is_found(const search *s, size_t k)
{
    return fvi_pole_is_found(&s->candidate[k], s->all_are_there ? 4 : FVI_NEARLY_REAL);
}

/* ---- two at one pole ---- */

static int are_same_pole(const search *s, size_t j, size_t k)
{
    return fvi_pole_is_same(s->d, &s->candidate[j], &s->candidate[k]);
}

/* Mark candidates that are no pole, and all candidates that found the same pole. */
static void mark_candidates_to_repeat(const search *s, unsigned char *wrong)
{
    for (size_t k = 0; k < s->n; k++)
        wrong[k] = !is_found(s, k);
    for (size_t k = 0; k < s->n; k++)
        for (size_t j = 0; j < k; j++)
            if (are_same_pole(s, j, k))
                wrong[j] = wrong[k] = 1;
}

static const double tight[] = { 1, 0.3, 0.1, 0.03, 0.01 };
enum { LEVELS = sizeof tight / sizeof *tight, LEVELS_OF_SOME = 2 };

/* Search again for the wrong candidates of the lowest level, along the damping. Each further level has shorter steps. A
 * pole that is found may show that another candidate was wrong. Return 1 if there was a candidate to search for. */
static int search_again(search *s, const unsigned char *wrong,
                        unsigned char *level, int *status)
{
    const unsigned char most = s->all_are_there ? LEVELS : LEVELS_OF_SOME;
    unsigned char least = most;
    for (size_t k = 0; k < s->n; k++)
        if (wrong[k] && s->lambda[k] > 0 && level[k] < least)
            least = level[k];
    if (least == most)
        return 0;
    for (size_t k = 0; !*status && k < s->n; k++) {
        if (!wrong[k] || !(s->lambda[k] > 0) || level[k] > least)
            continue;
        restart_candidate(s, k);
        *status = fvi_pole_follow(s->response, tight[least], &s->candidate[k]);
        level[k]++;
    }
    return !*status;
}

/* The modes beyond those that are asked for are searched, because damping may change the order. Leave out the last of
 * them if their estimates stay above the others. */
static void drop_last_modes(search *s)
{
    double highest = 0;
    size_t n = s->wanted;
    for (size_t k = 0; k < s->n && s->n < s->d; k++) {
        const double lambda = s->lambda[k];
        double size = 0;
        restart_candidate(s, k);
        if (lambda > 0)
            size = cabs(fvi_pole_estimate(s->response, lambda, s->candidate[k].v, s->form));
        if (k < s->wanted)
            highest = larger(highest, size);
        else if (!(size > ABOVE * highest))
            n = k + 1;
    }
    s->n = s->n < s->d ? n : s->n;
}

/* Search for a pole from each mode. */
static int search_from_modes(search *s)
{
    drop_last_modes(s);
    unsigned char *wrong = calloc(2 * s->n, 1);
    int status = wrong ? FVI_SUCCESS : FVI_ENOMEM;
    for (size_t k = 0; !status && k < s->n; k++) {
        restart_candidate(s, k);
        const double size = cabs(s->candidate[k].s); /* not sqrt(lambda) if lambda <= 0 */
        extend_range(s, sqrt(fabs(s->lambda[k])));
        extend_range(s, size);
        if (size > 0)
            status = fvi_pole_newton(s->response, &s->candidate[k]);
    }
    while (!status) {
        mark_candidates_to_repeat(s, wrong);
        if (!search_again(s, wrong, wrong + s->n, &status))
            break;
    }
    free(wrong);
    s->count = s->n;
    return status;
}

/* ---- one oscillator ---- */

/* Use fvi_oscillator_poles. */
static int search_of_one(search *s)
{
    const fvi_response *r = s->response;
    fvi_pole pole[MOST_OF_ONE];
    const int status = fvi_oscillator_poles(r, MOST_OF_ONE, pole, &s->count);
    for (size_t k = 0; k < s->count; k++) {
        s->candidate[k].s = pole[k].s;
        s->candidate[k].v[0] = 1;
        fvi_stiffness_at(s->response, pole[k].s, 1);
        s->candidate[k].residual = s->candidate[k].uncancelled =
            cabs(r->Z[0]) / fvi_stiffness_norm(r, pole[k].s);
    }
    return status;
}

/* ---- the answer ---- */

static int compare_sizes(const void *a, const void *b)
{
    const double x = cabs(((const fvi_pole_candidate *)a)->s),
                 y = cabs(((const fvi_pole_candidate *)b)->s);
    return (x > y) - (x < y);
}

/* Move the candidates that are poles to the front, each once, in the order of |s|. */
static void keep_poles(search *s)
{
    size_t kept = 0;
    for (size_t k = 0; k < s->count; k++) {
        int is_new = is_found(s, k);
        for (size_t j = 0; is_new && j < kept; j++)
            is_new = !are_same_pole(s, j, k);
        if (is_new) {
            const fvi_pole_candidate other = s->candidate[kept];
            s->candidate[kept++] = s->candidate[k];
            s->candidate[k] = other;
        }
    }
    s->count = kept;
    qsort(s->candidate, kept, sizeof *s->candidate, compare_sizes);
}

/* Return v^T Z' w at the pole at which Z' was computed. */
static double complex quadratic_form(const fvi_response *r, const double complex *v,
                                     const double complex *w, double complex *room)
{
    double complex sum = 0;
    fvi_stiffness_multiply(r, r->slope, w, room);
    for (size_t i = 0; i < r->d; i++)
        sum += v[i] * room[i];
    return sum;
}

/* Scale the shapes to v^T Z' v = 1. For several shapes of the same pole also make v^T Z' w = 0.             (30.5) */
static void normalise(search *s, double complex *room)
{
    fvi_response *r = s->response;
    for (size_t k = 0; k < s->count; k++) {
        double complex *v = s->candidate[k].v;
        fvi_stiffness_at(r, s->candidate[k].s, 1);
        for (size_t j = 0; j < k; j++) {
            const double complex *w = s->candidate[j].v;
            if (!fvi_pole_is_close(&s->candidate[j], &s->candidate[k]))
                continue;
            const double complex part = quadratic_form(r, w, v, room);
            for (size_t i = 0; i < s->d; i++)
                v[i] -= part * w[i];
        }
        const double complex size = csqrt(quadratic_form(r, v, v, room));
        for (size_t i = 0; i < s->d; i++)
            v[i] /= size;
    }
}

/* Return u >= high, so that above e^u inertia is larger than springs and dampings, whose poles are below. A strong
 * damper may have poles far above all undamped frequencies. The search ends after 60 steps, because damping of order 2
 * is a mass. */
static double end_of_stiffness(const fvi_response *r, double high)
{
    const fvi_stiffness_term *M = &r->term[0];
    double least = INFINITY, u = high;
    for (size_t i = 0; i < r->d; i++)
        least = smaller(least, fvi_sparse_entry(M->matrix, i, i));
    while (u < high + 60 && fvi_stiffness_norm(r, I * exp(u)) > exp(2 * u) * (M->norm + 0.1 * least))
        u += 1;
    return u;
}

/* Return how many poles there are: by the theorem, by (26.11), or counted. */
static size_t count_expected(search *s, int all_of_one)
{
    if (s->all_are_there)
        return s->d;
    if (all_of_one)
        return s->count;
    for (size_t k = 0; k < s->count; k++)
        extend_range(s, cabs(s->candidate[k].s));
    s->high = end_of_stiffness(s->response, s->high);
    return s->low <= s->high ? fvi_poles_counted(s->response, s->low - FOLDS, s->high + FOLDS) : 0;
}

static int write_poles(search *s, size_t count, size_t expect, fvi_poles *poles)
{
    const size_t k = count < s->count ? count : s->count, d = s->d;
    double *block = malloc((2 * k * (d + 1) + k + 1) * sizeof *block);
    double complex *room = malloc(d * sizeof *room);
    if (!block || !room) {
        free(block);
        free(room);
        return FVI_ENOMEM;
    }
    normalise(s, room);
    free(room);
    *poles = (fvi_poles){ .count = k, .expected = expect, .d = d,
                          .pole = block, .shape = block + 2 * k,
                          .residual = block + 2 * k * (d + 1) };
    for (size_t i = 0; i < k; i++) {
        poles->pole[2 * i] = creal(s->candidate[i].s);
        poles->pole[2 * i + 1] = cimag(s->candidate[i].s);
        memcpy(poles->shape + 2 * i * d, s->candidate[i].v,
               2 * d * sizeof(double));
        poles->residual[i] = s->candidate[i].residual;
    }
    return FVI_SUCCESS;
}

/* Set a lambda to 0 if it is a rounding error, because a free motion has no undamped frequency. The errors are those of
 * the largest lambda, which may not be among the n lowest, and may be far above |K| / |M| where the masses differ. */
static void round_modes(const fvi_response *r, size_t n, double *lambda)
{
    const double scale = larger(r->term[1].norm / r->term[0].norm, lambda[n - 1]);
    for (size_t k = 0; k < n; k++)
        if (fabs(lambda[k]) < 1e-15 * scale)
            lambda[k] = 0;
}

/* If poles are missing, search for them where they are counted. By the theorem the paths of search_again find all. */
static int search_boxes(search *s, size_t expected)
{
    fvi_pole_list list = { .count = s->count, .room = s->room, .seed = 1, .candidate = s->candidate };
    const fvi_log_box all = { { s->low - FOLDS, s->high + FOLDS }, { 1.5, FVI_NEARLY_REAL } };
    if (s->all_are_there || expected == SIZE_MAX || s->count >= expected)
        return FVI_SUCCESS;
    const int status = fvi_poles_in_box(s->response, &all, expected, &list);
    s->count = list.count;
    qsort(s->candidate, s->count, sizeof *s->candidate, compare_sizes);
    return status;
}

static int find_poles(search *s, size_t count, fvi_poles *poles)
{
    const fvi_response *r = s->response;
    int status = fvi_undamped_modes(r->term[0].matrix, r->term[1].matrix, s->n,
                                    s->lambda, s->mode);
    if (status)
        return status;
    round_modes(r, s->n, s->lambda);
    s->all_are_there = fvi_poles_by_theorem(r, s->lambda[0]);
    if (s->d == 1)
        status = search_of_one(s);
    const int all_of_one = s->count > 0;
    if (!status && !all_of_one)
        status = search_from_modes(s);
    if (status)
        return status;
    keep_poles(s);
    const size_t expected = count_expected(s, all_of_one);
    status = search_boxes(s, expected);
    if (status)
        return status;
    /* If there are more than were counted, rounding errors have turned the phase of det Z. */
    return write_poles(s, count, s->count > expected ? SIZE_MAX : expected, poles);
}

int fvi_poles_find(fvi_response *r, size_t count, fvi_poles *poles,
                   fvi_error *error)
{
    if (!r || !poles)
        return fvi_fail(error, FVI_EFAULT, NULL, NAN, "null pointer");
    if (count > r->d)
        return fvi_fail(error, FVI_EINVAL, "count", (double)count, "%zu poles of %zu unknowns", count, r->d);
    const size_t wanted = count ? count : r->d;
    if (wanted > FVI_MOST_POLES)
        return fvi_fail(error, FVI_EUNSUP, "count", (double)wanted,
                        count ? "%zu: at most %d poles are looked for"
                              : "of %zu unknowns at most %d poles are looked for; say how many of "
                                "the lowest",
                        wanted, FVI_MOST_POLES);
    search s;
    int status = search_alloc(r, wanted, &s);
    if (!status)
        status = find_poles(&s, count ? count : s.room, poles);
    search_free(&s);
    return !status
               ? FVI_SUCCESS
               : fvi_fail(error, status, NULL, NAN,
                          status == FVI_ENOMEM  ? "not enough memory"
                          : status == FVI_ESING ? "M is not positive definite"
                                                : "the undamped modes were not "
                                                  "found");
}

void fvi_poles_free(fvi_poles *poles)
{
    free(poles->pole);
    *poles = (fvi_poles){ 0 };
}
