/* tests/lagrangian/test_lagrangian_balance.c -- H 29: momenta that are conserved, and work that is not negative.
 * Run alone: make test-lagrangian_balance */
#include "problems.h"
#include "system/seeded.h"
#include "lagrangian_ref.h"

#include "system/larger.h"

/* sum x p' - y p of bodies in the plane. */
static double turn(const fvi_stepper *s)
{
    double J = 0;
    for (size_t i = 0; i + 1 < s->run.system->d; i += 2)
        J += s->x[i] * s->p[i + 1] - s->x[i + 1] * s->p[i];
    return J;
}

static double along(const fvi_stepper *s, size_t axis)
{
    double P = 0;
    for (size_t i = axis; i < s->run.system->d; i += 2)
        P += s->p[i];
    return P;
}

/* The largest drift of the angular momentum over the run. */
static double drift_of(const fvi_method *method, const mechanism_text *t,
                       double h, size_t steps, double *linear)
{
    mechanism_problem p;
    open_problem(t, &p);
    fvi_stepper *s = stepper_at(method, &p, h, steps, 0);
    const double J = turn(s), P = along(s, 0), Q = along(s, 1);
    double most = 0;
    *linear = 0;
    while (s->k < steps) {
        OK(fvi_stepper_step(s));
        most = larger(most, fabs(turn(s) - J));
        *linear = larger(*linear, larger(fabs(along(s, 0) - P),
                                         fabs(along(s, 1) - Q)));
    }
    fvi_stepper_free(s);
    close_problem(&p);
    return most;
}

#define STRUT "sqrt((x1-x3)^2+(x2-x4)^2)"
static const mechanism_text
    rotor = { .name = "rotor",
              .d = 2,
              .lagrangian = "(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2",
              .damper = { "sqrt(x1^2+x2^2) : power:0.4,0.3" },
              .x0 = { 1.2, 0 },
              .v0 = { 0.3, 0.8 } },
    steep = { .name = "steep rotor",
              .d = 2,
              .lagrangian = "(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2",
              .damper = { "sqrt(x1^2+x2^2) : power:0.4,0.7" },
              .x0 = { 1.2, 0 },
              .v0 = { 0.3, 0.8 } },
    pair = { .name = "two bodies and a strut",
             .d = 4,
             .lagrangian = "(v1^2+v2^2)/2 + v3^2+v4^2 - 2*(" STRUT "-1)^2",
             .damper = { STRUT " : power:0.4,0.3", STRUT " : viscous:0.1",
                         STRUT " : zener:0.5,0.4,2" },
             .x0 = { 1, 0, 0, 0.2 },
             .v0 = { 0.1, 0.7, -0.3, -0.2 } },
    no_strut = { .name = "two bodies, dampers along the coordinates",
                 .d = 4,
                 .lagrangian = "(v1^2+v2^2)/2 + v3^2+v4^2 - 2*(" STRUT "-1)^2",
                 .damper = { "x1-x3 : power:0.4,0.3", "x2-x4 : power:0.4,0.3" },
                 .x0 = { 1, 0, 0, 0.2 },
                 .v0 = { 0.1, 0.7, -0.3, -0.2 } },
    rod_and_strut = {
        .name = "three bodies, a rod and a strut",
        .d = 6,
        .lagrangian = "(v1^2+v2^2)/2 + v3^2+v4^2 + 3*(v5^2+v6^2)/4 - "
                      "2*(sqrt((x3-x5)^2+(x4-x6)^2)-1)^2",
        .damper = { "sqrt((x3-x5)^2+(x4-x6)^2) : power:0.4,0.3" },
        .constraint = { "((x1-x3)^2+(x2-x4)^2-1)/2" },
        .x0 = { 0, 1, 0, 0, 1.2, 0.1 },
        .v0 = { 0.5, 0.2, -0.1, 0.2, 0.3, -0.4 } };

/* 400 steps of roundings u of J = 0.96, each with some ten operations: 1e-12 is their sum, their walk
 * is a tenth of it. Form D keeps linear momentum alone. */
START_TEST(prop_29_2_angular_momentum_stays_to_the_last_digits)
{
    const mechanism_text *const all[] = { &rotor, &steep, &pair, &rod_and_strut };
    const fvi_method *const keep[] = { &fvi_fractional, &fvi_cq2_midpoint,
                                       &fvi_lobatto_m2, &fvi_lobatto_m3,
                                       &fvi_lobatto_m4, &fvi_lobatto_m6 };
    double linear;
    for (size_t i = 0; i < 4; i++)
        for (size_t m = 0; m < 6; m++) {
            if (i == 3 && m == 0)
                continue;
            const double J = drift_of(keep[m], all[i], 0.05, 400, &linear);
            ck_assert_msg(J <= (i == 3 ? 2e-12 : 5e-13), "%s, %s: %g",
                          all[i]->name, keep[m]->name, J);
            ck_assert_msg(i < 2 || linear <= 5e-13, "%s, %s: %g", all[i]->name,
                          keep[m]->name, linear);
            if (i < 3)
                seen_worst(J, "drift");
            if (i == 3)
                seen_worst(J, "drift with a rod");
        }
    const double d3 = drift_of(&fvi_lobatto_d3, &rotor, 0.05, 400, &linear),
                 d4 = drift_of(&fvi_lobatto_d4, &rotor, 0.05, 400, &linear);
    seen(d3, "form D, 3 stages");
    ck_assert_msg(d3 > 4e-9 && d3 < 1e-8 && d4 > 2e-13 && d4 < 1e-12, "%g %g", d3,
                  d4);
    drift_of(&fvi_lobatto_d3, &pair, 0.05, 400, &linear);
    ck_assert_msg(linear <= 1e-13, "%g", linear);
    const double off = drift_of(&fvi_lobatto_m3, &no_strut, 0.05, 200, &linear);
    seen(off, "no strut");
    ck_assert_msg(off > 0.1 && linear <= 1e-13, "%g %g", off, linear);
}
END_TEST

/* The work of a damper is never negative up to any step, whatever the step, the order and the
 * elongation: rounding of sums of some 10^4. Above the order 1 the body starts at rest. Order 1 has no such bound (29.12). */
START_TEST(prop_29_3_dampers_never_give_more_than_they_took)
{
    const fvi_method *const methods[] = { &fvi_cq2_midpoint, &fvi_lobatto_m3,
                                          &fvi_lobatto_d3, &fvi_lobatto_d4,
                                          &fvi_fractional };
    uint64_t state = 29;
    double least[5] = { 0 };
    int done[5] = { 0 };
    for (int n = 0; n < 60; n++) {
        const double order = fvi_seeded_uniform(&state, 0.1, 1.9),
                     rho = pow(10, fvi_seeded_uniform(&state, -1, 2)),
                     h = pow(10, fvi_seeded_uniform(&state, -1.5, 0.3));
        char damper[100];
        snprintf(damper, sizeof damper,
                 "sqrt((x1-2)^2+x2^2+1) : %s:%.17g,%.17g%s",
                 n % 2 && order < 1 ? "zener" : "power", rho, order / 2,
                 n % 2 && order < 1 ? ",0.7" : "");
        const mechanism_text text = {
            .name = "rough",
            .d = 2,
            .lagrangian =
                "(v1^2+v2^2)/2-(x1^2+x2^2)/2-(x1^2+x2^2)^2/4",
            .damper = { damper },
            .x0 = { fvi_seeded_uniform(&state, -1.5, 1.5), fvi_seeded_uniform(&state, -1.5, 1.5) },
            .v0 = { order < 1 ? fvi_seeded_uniform(&state, -1, 1) : 0,
                    order < 1 ? fvi_seeded_uniform(&state, -1, 1) : 0 }
        };
        for (int m = 0; m < 5; m++) {
            mechanism_problem p;
            open_problem(&text, &p);
            fvi_stepper *s = stepper_at(methods[m], &p, h, 60, 0);
            int status = 0;
            while (s->k < 60 && !(status = fvi_stepper_step(s))) {
                double work;
                OK(fvi_stepper_damper(s, 0, NULL, &work));
                least[m] = smaller(least[m], work);
            }
            done[m] += !status;
            fvi_stepper_free(s);
            close_problem(&p);
        }
    }
    for (int m = 0; m < 4; m++) {
        ck_assert_msg(least[m] >= -1e-11, "%s: %g", methods[m]->name, least[m]);
        ck_assert_msg(done[m] >= 52, "%s: %d of 60", methods[m]->name, done[m]);
        seen(done[m], "%s done", methods[m]->name);
    }
    ck_assert_msg(least[4] < -1, "fvi: %g", least[4]);
}
END_TEST

/* Its condition on the start is needed: the least work of a body on a spring by the node scheme. */
START_TEST(prop_29_3_is_for_dampers_that_are_held_and_start_at_rest)
{
    static const struct {
        const char *name, *damper;
        double v0, h, low, high;
    } rows[] = { { "rl", "x : power:1,0.3 : rl", -1, 0.1, -0.665, -0.655 },
                 { "caputo", "x : power:1,0.7 : caputo", 1, 0.1, -0.315, -0.305 },
                 { "held", "x : power:1,0.55", 1, 2, -0.0355, -0.0345 } };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const mechanism_text text = { .name = rows[i].name,
                                      .d = 1,
                                      .lagrangian = "v^2/2-x^2/2",
                                      .damper = { rows[i].damper },
                                      .x0 = { 1 },
                                      .v0 = { rows[i].v0 } };
        mechanism_problem p;
        open_problem(&text, &p);
        fvi_stepper *s = stepper_at(&fvi_cq2_midpoint, &p, rows[i].h, 60, 0);
        double least = 0, work;
        while (s->k < 60) {
            OK(fvi_stepper_step(s));
            OK(fvi_stepper_damper(s, 0, NULL, &work));
            least = smaller(least, work);
        }
        ck_assert_msg(least > rows[i].low && least < rows[i].high, "%s: %g",
                      text.name, least);
        seen(least, "%s", text.name);
        fvi_stepper_free(s);
        close_problem(&p);
    }
}
END_TEST

/* L quadratic, elongations linear: E + W is E_0, to roundings of 300 steps. */
START_TEST(eq_29_13_energy_and_work_add_up_exactly)
{
    static const mechanism_text text = {
        .name = "quadratic",
        .d = 2,
        .lagrangian = "(v1^2+2*v2^2)/2 - x1^2/2 - (x1-x2)^2",
        .damper = { "x1-x2 : power:0.5,0.3", "x2 : zener:1,0.4,0.3" },
        .x0 = { 1, 0 },
        .v0 = { 0, 0.15 }
    };
    mechanism_problem p;
    open_problem(&text, &p);
    fvi_stepper *s = stepper_at(&fvi_cq2_midpoint, &p, 0.3, 300, 0);
    double first, E, a, b, most = 0;
    OK(fvi_stepper_energy(s, &first));
    while (s->k < 300) {
        OK(fvi_stepper_step(s));
        OK(fvi_stepper_energy(s, &E));
        OK(fvi_stepper_damper(s, 0, NULL, &a));
        OK(fvi_stepper_damper(s, 1, NULL, &b));
        most = larger(most, fabs(E + a + b - first));
    }
    ck_assert_msg(most <= 1e-14, "%g", most);
    seen(most, "balance");
    fvi_stepper_free(s);
    close_problem(&p);
}
END_TEST

/* The balance of a nonlinear system converges, and the impulse is what p lost. */
START_TEST(works_and_impulses_are_of_the_order_of_the_method)
{
    static const mechanism_text free_body = { .name = "free",
                                              .d = 1,
                                              .lagrangian = "v^2/2",
                                              .damper = { "x : power:0.4,0.3" },
                                              .x0 = { 0 },
                                              .v0 = { 1 } };
    const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_midpoint,
                                          &fvi_lobatto_m3, &fvi_lobatto_d4 };
    mechanism_problem p;
    for (int m = 0; m < 4; m++) {
        double impulse;
        open_problem(&free_body, &p);
        fvi_stepper *s = stepper_at(methods[m], &p, 0.1, 50, 50);
        OK(fvi_stepper_damper(s, 0, &impulse, NULL));
        ck_assert_double_eq_tol(impulse, 1 - s->p[0], 1e-14);
        fvi_stepper_free(s);
        close_problem(&p);
    }
    double off[2];
    for (int n = 0; n < 2; n++) {
        open_problem(&problems[ELASTIC], &p);
        const size_t N = n ? 160 : 80;
        fvi_stepper *s = stepper_at(&fvi_lobatto_m3, &p, 4.0 / (double)N, N, N);
        double E, W;
        OK(fvi_stepper_energy(s, &E));
        OK(fvi_stepper_damper(s, 0, NULL, &W));
        off[n] = fabs(W - 0.37770794615836);
        ck_assert_double_eq_tol(E + W, 0.445, 1e-6);
        fvi_stepper_free(s);
        close_problem(&p);
    }
    const double order = log2(off[0] / off[1]); /* s + 1 - o = 3.4 */
    ck_assert_msg(order > 3.3 && order < 3.6, "%g %g", off[0], off[1]);
}
END_TEST

/* Two thousand steps of a double pendulum without dampers: the band of its energy. */
START_TEST(an_undamped_double_pendulum_keeps_its_energy)
{
    mechanism_text text = problems[TWIN];
    text.damper[0] = text.damper[1] = NULL;
    text.x0[0] = 0.5;
    text.x0[1] = 0.7;
    text.v0[1] = 0.2;
    mechanism_problem p;
    open_problem(&text, &p);
    const struct {
        const fvi_method *method;
        double least, most;
    } rows[] = { { &fvi_cq2_midpoint, 5e-5, 1e-4 },
                 { &fvi_lobatto_m3, 1e-7, 2e-7 },
                 { &fvi_lobatto_m4, 2e-11, 4e-11 } };
    for (int m = 0; m < 3; m++) {
        fvi_stepper *s = stepper_at(rows[m].method, &p, 0.1, 2000, 0);
        double E, low = INFINITY, high = -INFINITY;
        while (s->k < 2000) {
            OK(fvi_stepper_step(s));
            OK(fvi_stepper_energy(s, &E));
            low = smaller(low, E);
            high = larger(high, E);
        }
        ck_assert_msg(high - low <= rows[m].most && high - low >= rows[m].least,
                      "%s: %g", rows[m].method->name, high - low);
        seen(high - low, "%s", rows[m].method->name);
        fvi_stepper_free(s);
    }
    close_problem(&p);
}
END_TEST

/* The rod's length, its hidden constraint, and its multiplier at t = 4, known to 12 digits. The mean of both
 * steps at that node is of order 2, and 4 from four stages on. Seen: 0.27 h^2 and 0.0055 h^4. */
START_TEST(constraints_hold_to_roundings)
{
    const double h = 0.05;
    mechanism_problem p;
    open_problem(&problems[ROD], &p);
    const fvi_method *const methods[] = { &fvi_cq2_midpoint, &fvi_lobatto_m2,
                                          &fvi_lobatto_m3, &fvi_lobatto_m4,
                                          &fvi_lobatto_m6 };
    for (int m = 0; m < 5; m++) {
        fvi_stepper *s = stepper_at(methods[m], &p, h, 81, 0);
        double length = 0, hidden = 0, v[2], begin, end, at_end = 0;
        while (s->k < 81) {
            OK(fvi_stepper_step(s));
            OK(fvi_stepper_velocity(s, v));
            OK(fvi_stepper_multipliers(s, &begin, &end));
            length = larger(length, fabs(s->x[0] * s->x[0] + s->x[1] * s->x[1] - 1));
            hidden = larger(hidden, fabs(s->x[0] * v[0] + s->x[1] * v[1]));
            if (s->k == 80)
                at_end = end;
        }
        ck_assert_msg(length <= 2e-15 && hidden <= 1e-15, "%s: %g %g",
                      methods[m]->name, length, hidden);
        seen_worst(length, "constraint");
        seen_worst(hidden, "hidden");
        const double multiplier = (at_end + begin) / 2, exact = 0.627466407160;
        ck_assert_msg(fabs(multiplier - exact)
                          <= (m < 3 ? 0.3 * h * h : 0.01 * pow(h, 4)),
                      "%s: %g", methods[m]->name, multiplier);
        fvi_stepper_free(s);
    }
    close_problem(&p);
}
END_TEST

/* Pulled from 0 to 1 at t = 0 and held there: the force is rho t^-o / Gamma(1 - o), and its integral is
 * exact, 4u for each of 40 steps. */
START_TEST(a_relaxation_test_is_exact)
{
    static const mechanism_text text = { .name = "relaxation",
                                         .d = 1,
                                         .lagrangian = "v^2/2",
                                         .damper = { "x : power:0.7,0.3 : rl" },
                                         .imposed = { "x=1" },
                                         .x0 = { 1 } };
    const fvi_method *const methods[] = { &fvi_cq2_midpoint, &fvi_lobatto_m2,
                                          &fvi_lobatto_m4 };
    mechanism_problem p;
    open_problem(&text, &p);
    for (int m = 0; m < 3; m++) {
        fvi_stepper *s = stepper_at(methods[m], &p, 0.05, 40, 40);
        double impulse, work;
        OK(fvi_stepper_damper(s, 0, &impulse, &work));
        ck_assert_double_eq_tol(impulse, relaxation_impulse, 40 * 4 * 0x1p-53);
        ck_assert_double_eq_tol(work, 0, 1e-14);
        fvi_stepper_free(s);
    }
    close_problem(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lagrangian: balance");
    ADD_CASE(suite, "balance",
             prop_29_2_angular_momentum_stays_to_the_last_digits,
             prop_29_3_dampers_never_give_more_than_they_took,
             prop_29_3_is_for_dampers_that_are_held_and_start_at_rest,
             eq_29_13_energy_and_work_add_up_exactly,
             works_and_impulses_are_of_the_order_of_the_method,
             an_undamped_double_pendulum_keeps_its_energy,
             constraints_hold_to_roundings,
             a_relaxation_test_is_exact);
    return run_suite(suite);
}
