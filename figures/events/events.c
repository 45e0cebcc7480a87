/* figures/events/events.c -- H 22: a ball that bounces, with three kinds of damping.
 *
 * The equation is x'' + 0.3 D^o (x - 1) = -1 from x = 1 at rest. Each impact on x = 0 keeps 0.8 of the speed.
 * The runs are by fvi_variable_step, without damping and with the orders o = 3/5 and o = 7/5. Prints two blocks
 * for each ball:
 * - t, x and v of the rows, with an empty line at each impact, where v jumps;
 * - the t of each impact, 0, and the speed after the impact. */
#include <fvi/error.h>
#include <fvi/events.h>
#include <fvi/variable_steps.h>

#include <stdio.h>

enum { ROWS = 500 };
static const double T = 5, one = 1, zero = 0;

static int height(double t, size_t d, const double *x, const double *p, void *params,
                  double *z)
{
    (void)t, (void)d, (void)p, (void)params;
    *z = *x;
    return 0;
}

static int upwards(double t, size_t d, const double *x, void *params, double *normal,
                   double *rate)
{
    (void)t, (void)d, (void)x, (void)params;
    *normal = 1;
    *rate = 0;
    return 0;
}

static int weight(double t, size_t d, void *params, double *F)
{
    (void)t, (void)d, (void)params;
    *F = -1;
    return 0;
}

/* Print the rows *next, *next + 1, ... whose time the stepper has reached. */
static int rows(fvi_stepper *s, size_t *next)
{
    for (; *next <= ROWS && (double)*next * s->run.h <= s->t; ++*next) {
        double x, p;
        const double t = (double)*next * s->run.h;
        if (fvi_stepper_advance_to(s, t, &x, &p))
            return 1;
        printf("%.6f %.6f %.6f\n", t, x, p);
    }
    return 0;
}

static int ball(double alpha, double rho)
{
    const fvi_event floor = { .value = height,
                              .gradient = upwards,
                              .action = FVI_EVENT_IMPACT,
                              .restitution = 0.8 };
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .force = { .value = weight } };
    fvi_run run = fvi_run_default(&system, &one, &zero, T / ROWS, ROWS);
    run.alpha = alpha;
    run.events = &floor;
    run.event_count = 1;
    fvi_stepper *s;
    size_t next = 0, before = 0, n;
    double speed[8] = { 0 };
    int status = fvi_stepper_start(&fvi_variable_step, &run, &s, NULL);
    while (!status && s->k < run.steps && !fvi_stepper_is_over(s)) {
        status = fvi_stepper_step(s) || rows(s, &next);
        fvi_stepper_events(s, &n);
        if (!status && n > before) {
            double x, p; /* just before the impact */
            status = fvi_stepper_advance_to(s, s->t * (1 - 1e-12), &x, &p);
            printf("%.6f 0 %.6f\n\n%.6f 0 %.6f\n", s->t, p, s->t, s->p[0]);
            speed[(before = n) - 1] = s->p[0];
        }
    }
    if (status)
        return 1;
    const fvi_event_time *at = fvi_stepper_events(s, &n);
    printf("\n\n");
    for (size_t i = 0; i < n; i++)
        printf("%.6f 0 %.6f\n", at[i].t, speed[i]);
    printf("\n\n");
    fvi_stepper_free(s);
    return 0;
}

int main(void)
{
    return ball(0.5, 0) || ball(0.3, 0.3) || ball(0.7, 0.3);
}
