/* figures/lagrangian/lagrangian_six.c -- The six mechanisms of the manual.
 *
 * Prints a block for each mechanism with what its panel shows: the path of an elastic pendulum; the positions
 * of a cart and of its pendulum's bob; the tip of a double pendulum; the crank's end and the rocker's end of a
 * linkage; x and v of van der Pol's oscillator; t and x of a bouncing ball. */
#include <fvi/fvi.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 4 };

typedef struct {
    const char *name, *lagrangian, *damper[MOST], *constraint[MOST], *force, *event;
    size_t d, dampers, constraints;
    double x0[MOST], v0[MOST], h;
    size_t steps;
    void (*print)(const fvi_stepper *s);
} mechanism;

static void plane(const fvi_stepper *s)
{
    printf("%.9g %.9g\n", s->x[0], s->x[1]);
}

static void cart_and_bob(const fvi_stepper *s)
{
    printf("%.9g 0 %.9g %.9g\n", s->x[0], s->x[0] + sin(s->x[1]), -cos(s->x[1]));
}

static void tip(const fvi_stepper *s)
{
    printf("%.9g %.9g\n", sin(s->x[0]) + sin(s->x[1]), -cos(s->x[0]) - cos(s->x[1]));
}

static void ends(const fvi_stepper *s)
{
    printf("%.9g %.9g %.9g %.9g\n", s->x[0], s->x[1], s->x[2], s->x[3]);
}

static void phase(const fvi_stepper *s)
{
    printf("%.9g %.9g\n", s->x[0], s->p[0]);
}

static void height(const fvi_stepper *s)
{
    printf("%.9g %.9g\n", s->t, s->x[0]);
}

static const mechanism six[] = {
    { "elastic pendulum", "(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2 - x2",
      { "sqrt(x1^2+x2^2) : power:0.4,0.3" }, .d = 2, .dampers = 1, .x0 = { 1.2, 0 },
      .v0 = { 0.3, 0.8 }, .h = 0.05, .steps = 400, .print = plane },
    { "cart", "3*v1^2/2 + v1*v2*cos(x2) + v2^2/2 + cos(x2) - x1^2/2",
      { "x1 : power:0.3,0.3", "x2 : viscous:0.1" }, .d = 2, .dampers = 2, .x0 = { 0.2, 1.2 },
      .v0 = { 0, 0.5 }, .h = 0.05, .steps = 400, .print = cart_and_bob },
    { "double pendulum", "v1^2 + v2^2/2 + v1*v2*cos(x1-x2) + 2*cos(x1) + cos(x2)",
      { "x1 : power:0.2,0.3", "x2-x1 : power:0.3,0.25" }, .d = 2, .dampers = 2, .x0 = { 1, 1.5 },
      .v0 = { 0, 0.5 }, .h = 0.05, .steps = 400, .print = tip },
    { "linkage", "(v1^2+v2^2)/2 + (v3^2+v4^2) - x2 - 2*x4",
      { "sqrt((x1-2)^2+x2^2) : power:0.5,0.3" },
      { "x1^2+x2^2-0.7^2", "(x3-2)^2+x4^2-1.3^2", "(x1-x3)^2+(x2-x4)^2-1.8^2" },
      .d = 4, .dampers = 1, .constraints = 3,
      .x0 = { 0.6143077933232609, 0.3355978770229421, 2.1388456575059656, 1.2925640732248969 },
      .v0 = { -0.335597877022942, 0.614307793323261, 0.053624452636355, -0.005760273350408 },
      .h = 0.025, .steps = 200, .print = ends },
    { "van der Pol", "v^2/2 - x^2/2", { "x : power:0.3,0.3" }, .force = "1=(1-x^2)*v", .d = 1,
      .dampers = 1, .x0 = { 0.5 }, .v0 = { 0.4 }, .h = 0.05, .steps = 600, .print = phase },
    { "ball", "v^2/2 - x", { "x : power:0.3,0.3" }, .event = "x : impact:0.8", .d = 1, .dampers = 1,
      .x0 = { 1 }, .v0 = { 0 }, .h = 0.02, .steps = 400, .print = height },
};

static int block(const mechanism *m)
{
    const fvi_mechanism_texts texts = { .lagrangian = m->lagrangian, .dampers = m->dampers, .damper = m->damper,
                                        .constraints = m->constraints, .constraint = m->constraint,
                                        .forces_on = m->force != NULL, .force_on = &m->force };
    static const double ones[MOST] = { 1, 1, 1, 1 };
    double p0[MOST];
    fvi_typed_mechanism *typed;
    fvi_typed_events *events = NULL;
    fvi_stepper *s;
    if (fvi_parse_mechanism(&texts, m->d, NULL, &typed, NULL)
        || (m->event && fvi_parse_events(1, &m->event, m->d, ones, NULL, &events, NULL)))
        return EXIT_FAILURE;
    const fvi_system system = { .d = m->d, .mechanism = fvi_mechanism_typed(typed) };
    int status = fvi_momentum_of_velocity(&system, 0, m->x0, m->v0, p0);
    fvi_run run = fvi_run_default(&system, m->x0, p0, m->h, m->steps);
    fvi_typed_events_of(events, system.mechanism);
    run.events = fvi_events_typed(events, &run.event_count);
    run.longest = m->h; /* fvi_variable_step prints the ball at the ends of steps, so they must be short */
    if (!status)
        status = fvi_stepper_start(m->event ? &fvi_variable_step : &fvi_lobatto_m4, &run, &s, NULL);
    if (status)
        return EXIT_FAILURE;
    printf("# %s\n", m->name);
    m->print(s);
    for (size_t k = 0; k < m->steps && !status && !fvi_stepper_is_over(s);) {
        status = fvi_stepper_step(s);
        if (!status && s->k > k) {
            m->print(s);
            k = s->k;
        }
    }
    printf("\n\n");
    fvi_stepper_free(s);
    fvi_typed_events_free(events);
    fvi_typed_mechanism_free(typed);
    return status;
}

int main(void)
{
    int failed = 0;
    for (size_t i = 0; i < sizeof six / sizeof *six; i++)
        failed |= block(six + i) != 0;
    return failed;
}
