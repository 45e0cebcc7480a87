/* tests/random/stress/stress_mechanisms.c -- Random mechanisms in texts: different methods agree. */
#include "stress.h"

#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_D = 4, MOST_DAMPERS = 3, ROOM = 600 };

typedef struct {
    size_t d, dampers, constraints, forces;
    char lagrangian[ROOM], damper[MOST_DAMPERS][200], constraint[120], force[120];
    double x0[MOST_D], v0[MOST_D], T;
} mechanism;

static double draw(gsl_rng *random, double low, double high)
{
    return stress_uniform(random, low, high);
}

/* Masses that depend on the position, springs of degree four, and sometimes a term of first order in v, or a
 * term with t. */
static void draw_lagrangian(gsl_rng *random, mechanism *m)
{
    size_t at = 0;
    char *to = m->lagrangian;
    for (size_t i = 1; i <= m->d; i++)
        at += (size_t)snprintf(to + at, ROOM - at, "%.3f*v%zu^2-%.3f*x%zu^2-%.3f*x%zu^4+",
                               draw(random, 0.4, 2), i, draw(random, 0.1, 2), i,
                               draw(random, 0, 0.3), i);
    for (size_t i = 1; i < m->d; i++)
        at += (size_t)snprintf(to + at, ROOM - at, "%.3f*v%zu*v%zu*cos(x%zu-x%zu)+",
                               draw(random, 0, 0.5), i, i + 1, i, i + 1);
    if (gsl_rng_uniform_int(random, 3) == 0)
        at += (size_t)snprintf(to + at, ROOM - at, "%.3f*v1*sin(x%zu)+",
                               draw(random, 0, 1), m->d);
    snprintf(to + at, ROOM - at, "%.3f*cos(x1+%s)", draw(random, 0, 1),
             gsl_rng_uniform_int(random, 3) ? "1" : "t");
}

static void draw_damper(gsl_rng *random, const mechanism *m, char *to)
{
    const size_t i = 1 + gsl_rng_uniform_int(random, m->d),
                 j = 1 + i % m->d;
    const double rho = stress_decades(random, 0.03, 1),
                 alpha = draw(random, 0.05, 0.5);
    char g[80], law[80];
    switch (gsl_rng_uniform_int(random, 4)) {
    case 0:
        snprintf(g, sizeof g, "x%zu", i);
        break;
    case 1:
        snprintf(g, sizeof g, "x%zu-x%zu", i, j);
        break;
    case 2:
        snprintf(g, sizeof g, "sqrt((x%zu-x%zu)^2+%.3f)", i, j,
                 draw(random, 0.5, 2));
        break;
    default:
        snprintf(g, sizeof g, "sin(x%zu)+%.3f*x%zu^2", i, draw(random, 0, 0.4), j);
    }
    switch (gsl_rng_uniform_int(random, 4)) {
    case 0:
        snprintf(law, sizeof law, "viscous:%.4f", rho);
        break;
    case 1:
        snprintf(law, sizeof law, "maxwell:%.4f,%.3f", rho, draw(random, 0.2, 2));
        break;
    case 2:
        snprintf(law, sizeof law, "zener:%.4f,%.4f,%.3f", rho, smaller(alpha, 0.4),
                 draw(random, 0.2, 2));
        break;
    default:
        snprintf(law, sizeof law, "power:%.4f,%.4f", rho, alpha);
    }
    snprintf(to, 200, "%s : %s", g, law);
}

/* A sphere around the start, and a velocity along it. */
static void draw_constraint(gsl_rng *random, mechanism *m)
{
    double radius = 0, speed = 0;
    for (size_t i = 0; i < 2; i++)
        m->x0[i] = draw(random, 0.3, 1);
    radius = m->x0[0] * m->x0[0] + m->x0[1] * m->x0[1];
    speed = draw(random, -1, 1);
    m->v0[0] = -speed * m->x0[1];
    m->v0[1] = speed * m->x0[0];
    snprintf(m->constraint, sizeof m->constraint, "x1^2+x2^2-%.17g", radius);
    m->constraints = 1;
}

static void draw_mechanism(gsl_rng *random, mechanism *m)
{
    *m = (mechanism){ .d = 1 + gsl_rng_uniform_int(random, MOST_D),
                      .dampers = gsl_rng_uniform_int(random, MOST_DAMPERS + 1),
                      .T = draw(random, 1, 3) };
    draw_lagrangian(random, m);
    for (size_t j = 0; j < m->dampers; j++)
        draw_damper(random, m, m->damper[j]);
    for (size_t i = 0; i < m->d; i++) {
        m->x0[i] = draw(random, -1, 1);
        m->v0[i] = draw(random, -1, 1);
    }
    if (m->d > 1 && gsl_rng_uniform_int(random, 3) == 0)
        draw_constraint(random, m);
    if (gsl_rng_uniform_int(random, 3) == 0)
        m->forces = (size_t)snprintf(m->force, sizeof m->force,
                                     "1=%.3f*(1-x%zu^2)*v1+%.3f*sin(2*t)",
                                     draw(random, -0.5, 0.5), m->d,
                                     draw(random, 0, 1)) > 0;
}

/* Compute x at T in N steps, d numbers. Returns a status. */
static int last_of(const fvi_method *method, const fvi_system *system,
                   const mechanism *m, const double *p0, size_t N, double *x)
{
    const fvi_run run =
        fvi_run_default(system, m->x0, p0, m->T / (double)N, N);
    fvi_stepper *s;
    int status = fvi_stepper_start(method, &run, &s, NULL);
    if (status)
        return status;
    while (s->k < N && !status)
        status = fvi_stepper_step(s);
    memcpy(x, s->x, m->d * sizeof *x);
    fvi_stepper_free(s);
    return status;
}

/* The error of a method of order 2 is a third of the change by the last halving. A better method, with its own
 * change, is the truth. Both allowances are wide, because a method reaches its order only with small steps. */
static double compare(const fvi_system *system, const mechanism *m,
                      const double *p0, char *describe, size_t size)
{
    enum { N = 120 };
    double x[5][MOST_D];
    const struct {
        const fvi_method *method;
        size_t steps;
    } runs[5] = { { &fvi_cq2_midpoint, N },
                  { &fvi_cq2_midpoint, 2 * N },
                  { &fvi_lobatto_m4, N },
                  { &fvi_lobatto_m4, 2 * N },
                  { m->constraints ? &fvi_lobatto_m3 : &fvi_lobatto_d4,
                    2 * N } };
    for (int i = 0; i < 5; i++) {
        const int status = last_of(runs[i].method, system, m, p0, runs[i].steps, x[i]);
        if (status) {
            snprintf(describe, size, "%s: %d", runs[i].method->name, status);
            return 2;
        }
    }
    const double of_nodes = stress_distance(m->d, x[0], x[1]),
                 of_stages = stress_distance(m->d, x[2], x[3]),
                 off = stress_distance(m->d, x[1], x[3]),
                 other = stress_distance(m->d, x[4], x[3]);
    if (of_nodes > 0.05 || of_stages > 1e-3)
        return -1; /* the steps are too long for a comparison */
    return larger(off / (1.2 * of_nodes + 2 * of_stages + 1e-11),
                  other / (300 * of_stages + 1e-3 * of_nodes + 1e-10));
}

/* 200 systems of texts: the node scheme converges to the same motion as forms M and D. */
double stress_mechanisms(gsl_rng *random, char *describe, size_t size)
{
    mechanism m;
    draw_mechanism(random, &m);
    const char *dampers[MOST_DAMPERS], *constraint = m.constraint,
               *force = m.force;
    for (size_t j = 0; j < MOST_DAMPERS; j++)
        dampers[j] = m.damper[j];
    const fvi_mechanism_texts texts = { .lagrangian = m.lagrangian,
                                        .dampers = m.dampers,
                                        .damper = dampers,
                                        .constraints = m.constraints,
                                        .constraint = &constraint,
                                        .forces_on = m.forces,
                                        .force_on = &force };
    fvi_typed_mechanism *typed;
    fvi_error error = { 0 };
    snprintf(describe, size, "L = %s; %s; %s; %s", m.lagrangian,
             m.dampers ? m.damper[0] : "-", m.constraint, m.force);
    if (fvi_parse_mechanism(&texts, m.d, NULL, &typed, &error))
        return 2;
    const fvi_system system = { .d = m.d, .mechanism = fvi_mechanism_typed(typed) };
    double p0[MOST_D];
    double used = 2;
    /* The start must satisfy the constraint, whatever L is. So compute p0 as L_v of v0. */
    if (!fvi_momentum_of_velocity(&system, 0, m.x0, m.v0, p0))
        used = compare(&system, &m, p0, describe, size);
    fvi_typed_mechanism_free(typed);
    return used;
}
