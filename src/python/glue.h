/* src/python/glue.h -- What the Python package has of C besides the library. */
#include <fvi/columns.h>
#include <fvi/fvi.h>
#include <fvi/lobatto.h>
#include <fvi/observer.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "glue_gradient.h"
#include "glue_impose.h"
static int check_signals(void);
static int report_progress(size_t rows, size_t all, void *tell);
/* The last error's reason and code, of this thread: for the text of the exception. */
static _Thread_local const char *reason;
static _Thread_local int reason_of;
static void store_reason(const char *text, const char *file, int line, int code)
{
    (void)file, (void)line;
    reason = text;
    reason_of = code;
}
/* Ctrl-C reaches the main thread, and is seen when that calls Python. */
static unsigned long main_thread;
static int stopped; /* what Python said; it stands until the call has returned */
/* Of another thread: its runs end as soon as *flag is not zero; NULL: no such flag. */
static _Thread_local const volatile int *flag_of_thread;
static void set_stop_flag(const int *flag)
{
    flag_of_thread = flag;
}
/* Have 25 ms passed since this was nonzero? Then they begin anew. */
static int is_time(struct timespec *last)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    if ((double)(now.tv_sec - last->tv_sec) + 1e-9 * (double)(now.tv_nsec - last->tv_nsec) < 0.025)
        return 0;
    *last = now;
    return 1;
}
static int check_python(void)
{
    static struct timespec last;
    if ((unsigned long)pthread_self() != main_thread)
        return flag_of_thread ? -*flag_of_thread : 0;
    if (stopped)
        return stopped;
    return is_time(&last) ? stopped = check_signals() : 0;
}
/* How many rows of a call stand, of how many; and who is told now and then? */
typedef struct {
    size_t rows, all;
    void *tell; /* NULL: nobody */
    void *happened; /* to whom events are told */
    struct timespec last;
} row_count;
static int report_event(const fvi_event_time *at, const double *x, const double *p, void *happened);
static int count_event(const fvi_event_time *at, const double *x, const double *p, void *params)
{
    return report_event(at, x, p, ((row_count *)params)->happened);
}
static int count_row(size_t k, double t, const double *x, const double *p, void *params)
{
    row_count *count = params;
    (void)t, (void)x, (void)p;
    count->rows = k + 1;
    if (!count->tell)
        return 0;
    return k + 1 == count->all || (k % 16 == 0 && is_time(&count->last))
               ? report_progress(k + 1, count->all, count->tell) : 0;
}
/* Does the method choose its steps? */
static int is_dense(const fvi_method *method)
{
    return method->dense != NULL;
}
/* fvi_energy_at of each row; *done of them stand. */
static int energies(const fvi_system *system, size_t rows, const double *t, const double *x, const double *p,
                    double *energy, size_t *done)
{
    const size_t d = system->d;
    int status = 0;
    for (*done = 0; *done < rows && !status; *done += !status)
        status = fvi_energy_at(system, t[*done], x + *done * d, p + *done * d, energy + *done);
    return status;
}
/* How many constraints a system has; and the coordinate, from 1, that number i prescribes, or 0. */
static size_t constraints(const fvi_system *system)
{
    const fvi_constraints *ties = system->mechanism ? system->mechanism->constraints : NULL;
    return ties ? ties->count : 0;
}
static size_t imposed_on(const fvi_system *system, size_t i)
{
    const size_t *imposed = system->mechanism->constraints->imposed;
    return imposed ? imposed[i] : 0;
}
/* What an observer says at the rows, where there is room for it; *done of them stand. */
typedef struct {
    double *v, *a, *force, *impulse, *work, *multiplier, *work_of_force, *balance;
} observed;
static void put_row(double *to, size_t k, size_t n, const double *from)
{
    if (to && n)
        memcpy(to + k * n, from, n * sizeof *to);
}
/* The steps to a row, and what is known there. */
static int observe_row(fvi_observer *o, fvi_stepper *s, double t, fvi_observation *now)
{
    const int is_dense = s->method->dense != NULL;
    const size_t node = (size_t)round(t / s->run.h);
    int status = 0;
    while (!status && (is_dense ? s->t < t : s->k < node))
        status = fvi_observer_step(o, s);
    return status ? status : fvi_observer_read(o, s, is_dense ? t : s->t, now);
}
static int observe(fvi_observer *o, fvi_stepper *s, size_t rows, const double *t, const observed *to, size_t *done)
{
    const size_t dampers = fvi_observer_dampers(o), ties = constraints(s->run.system);
    fvi_observation now;
    size_t width = 0;
    int status = 0;
    for (size_t j = 0; j < dampers; j++)
        width += fvi_observer_width(o, j);
    for (*done = 0; *done < rows && !status; *done += !status) {
        const size_t k = *done;
        status = observe_row(o, s, t[k], &now);
        if (status)
            break;
        put_row(to->v, k, s->run.system->d, now.v);
        put_row(to->a, k, s->run.system->d, now.a);
        put_row(to->force, k, width, now.force);
        put_row(to->impulse, k, width, now.impulse);
        put_row(to->work, k, dampers, now.work);
        put_row(to->multiplier, k, ties, now.multiplier);
        put_row(to->work_of_force, k, 1, &now.work_of_force);
        put_row(to->balance, k, 1, &now.balance);
    }
    return status;
}
/* Typed columns at the rows; or, without room for them, their reductions. *done rows stand. */
static int table_of_run(fvi_typed_columns *c, fvi_observer *o, fvi_stepper *s, size_t rows, const double *t,
                        double *values, size_t *done)
{
    const size_t width = fvi_typed_columns_count(c);
    double *row = malloc((width + 1) * sizeof *row);
    fvi_observation now;
    int status = row ? 0 : FVI_ENOMEM;
    for (*done = 0; *done < rows && !status; *done += !status) {
        status = observe_row(o, s, t[*done], &now);
        if (!status)
            status = fvi_typed_columns_values(c, &now, values ? values + *done * width : row);
        if (!status && !values)
            status = fvi_reductions_add(c, t[*done]);
    }
    free(row);
    return status;
}
/* More rows behind the count->rows that stand, until there is an event, the run is over or so much time has passed. */
static int rows_of_stepper(fvi_stepper *s, size_t rows, const double *t, double *x, double *p, row_count *count,
                           double seconds)
{
    const size_t d = s->run.system->d;
    const int is_dense = s->method->dense != NULL;
    struct timespec begin, here;
    size_t before, now, steps = 0;
    int status = 0;
    fvi_stepper_events(s, &before);
    clock_gettime(CLOCK_MONOTONIC, &begin);
    while (count->rows < rows && !status) {
        const size_t k = count->rows;
        if (is_dense ? s->t >= t[k] : s->k >= (size_t)round(t[k] / s->run.h)) {
            status = fvi_stepper_advance_to(s, is_dense ? t[k] : s->t, x + k * d, p + k * d);
            if (!status)
                status = count_row(k, t[k], NULL, NULL, count);
            continue;
        }
        if (fvi_stepper_is_over(s))
            break;
        status = fvi_stepper_step(s);
        fvi_stepper_events(s, &now);
        if (now > before)
            break;
        if (++steps % 64 == 0) {
            clock_gettime(CLOCK_MONOTONIC, &here);
            if ((double)(here.tv_sec - begin.tv_sec) + 1e-9 * (double)(here.tv_nsec - begin.tv_nsec) >= seconds)
                break;
        }
    }
    return status;
}
/* What steps have changed, as bytes; `to` NULL: how many. */
typedef struct {
    fvi_archive archive;
    unsigned char *bytes;
    size_t at, size;
    int is_loaded;
} stepper_bytes;
static int copy_piece(fvi_archive *archive, void *data, size_t bytes, int constant)
{
    stepper_bytes *b = (stepper_bytes *)archive;
    unsigned char *here = b->bytes + b->at;
    if (b->bytes && bytes > b->size - b->at)
        return FVI_EINVAL;
    b->at += bytes;
    if (!b->bytes || bytes == 0)
        return 0;
    if (b->is_loaded && constant)
        return memcmp(data, here, bytes) == 0 ? 0 : FVI_EINVAL;
    memcpy(b->is_loaded ? data : here, b->is_loaded ? here : data, bytes);
    return 0;
}
static int save_stepper(fvi_stepper *s, unsigned char *to, size_t room, size_t *size)
{
    stepper_bytes b = { .archive = { copy_piece }, .bytes = to, .size = room };
    const int status = fvi_stepper_archive(s, &b.archive);
    *size = b.at;
    return status;
}
static int load_stepper(fvi_stepper *s, const unsigned char *from, size_t size)
{
    stepper_bytes b = { .archive = { copy_piece }, .bytes = (unsigned char *)from, .size = size, .is_loaded = 1 };
    const int status = fvi_stepper_archive(s, &b.archive);
    return status ? status : b.at == size ? 0 : FVI_EINVAL;
}
/* x at increasing times: at the ends of steps, but for roundings, as they are, and by their stages between them; and p,
 * if it is not NULL, likewise. */
static int positions_within(fvi_stepper *s, size_t count, const double *t, double *x, double *p)
{
    const size_t d = s->run.system->d;
    int status = 0;
    for (size_t i = 0; i < count && !status; i++) {
        const double parts = t[i] / s->run.h, node = round(parts);
        const int is_end = fabs(parts - node) <= 1e-12 * fmax(parts, 1);
        const size_t k = (size_t)(is_end ? node : ceil(parts));
        while (!status && s->k < k)
            status = fvi_stepper_step(s);
        if (!status && is_end)
            memcpy(x + i * d, s->x, d * sizeof *x);
        else if (!status)
            status = fvi_lobatto_within(s, t[i], x + i * d);
        if (!status && p && is_end)
            memcpy(p + i * d, s->p, d * sizeof *p);
        else if (!status && p)
            status = fvi_lobatto_momentum_within(s, t[i], p + i * d);
    }
    return status;
}
/* The acceleration of the ground at the rows. */
static int accelerations_of_ground(const fvi_ground *ground, size_t rows, const double *t, double *ag)
{
    const fvi_force *of = fvi_ground_acceleration(ground);
    int status = 0;
    for (size_t k = 0; k < rows && !status; k++)
        if (of->value)
            status = of->value(t[k], 1, of->params, ag + k);
        else
            ag[k] = 0;
    return status;
}
/* NULL: it has none. */
static const char *damper_name(const fvi_system *system, size_t j)
{
    return system->mechanism ? system->mechanism->damper[j].name : NULL;
}
/* fvi_velocity of each row. */
static int velocities(const fvi_system *system, size_t rows, const double *p, double *v)
{
    int status = 0;
    for (size_t k = 0; k < rows && !status; k++)
        status = fvi_velocity(system, p + k * system->d, v + k * system->d);
    return status;
}
static void set_main_thread(unsigned long thread)
{
    main_thread = thread;
    fvi_set_error_handler(store_reason);
    fvi_set_interrupter(check_python);
}
/* Before a call of the library. */
static void begin(void)
{
    reason = NULL;
    if ((unsigned long)pthread_self() == main_thread)
        stopped = 0;
}
/* At most so many steps, until it is time to check whether the run has got too stiff. */
static int take_steps(fvi_stepper *s, size_t count, const fvi_watch *watch, size_t *taken)
{
    int status = 0;
    for (*taken = 0; *taken < count && !status;) {
        status = fvi_stepper_step(s);
        *taken += !status;
        if (s->k >= watch->next)
            break;
    }
    return status;
}
/* fvi_warning_along at the rows of a run, as far as they are finite. */
static int warn_along_rows(fvi_watch *watch, const fvi_method *method, const fvi_run *run, size_t rows, const double *t,
                           const double *x, size_t size, char *text)
{
    const size_t d = run->system->d;
    int warned = 0;
    for (size_t j = 0; !warned && j < rows && fvi_all_finite(d, x + j * d); j++)
        warned = fvi_warning_along(watch, method, run, (size_t)round(t[j] / run->h), x + j * d, size, text);
    return warned;
}
/* The reason of this code, or NULL; no reason is given twice, or for another code. */
static const char *reason_of_code(int code)
{
    const char *text = reason_of == code ? reason : NULL;
    reason = NULL;
    return text;
}
