/* tests/lagrangian/test_lagrangian.c -- H 29: runs of mechanisms, compared with rows of an independent program, and
 * the reports of a run.
 * Run alone: make test-lagrangian */
#include "problems.h"
#include "prototype_values.h"

#include "harness/saved.h"
#include "system/larger.h"

enum { STEPS = 40 };

static double distance(const fvi_stepper *s, size_t d, const double *x,
                       const double *p)
{
    double most = 0;
    for (size_t i = 0; i < d; i++)
        most = larger(most, larger(fabs(s->x[i] - x[i]), fabs(s->p[i] - p[i])));
    return most;
}

static double work_of(const fvi_stepper *s)
{
    double sum = 0, work;
    for (size_t j = 0; j < s->run.system->mechanism->damper_count; j++) {
        OK(fvi_stepper_damper(s, j, NULL, &work));
        sum += work;
    }
    return sum;
}

/* Both programs round: some 1e-14 of numbers of size 1, in 40 steps. Seen 5e-14 of 1e-13. */
START_TEST(eq_29_6_and_29_7_the_rows_are_those_of_another_program)
{
    for (size_t i = 0; i < sizeof prototype_rows / sizeof *prototype_rows; i++) {
        const prototype_row *row = &prototype_rows[i];
        const mechanism_text *t = &problems[row->problem];
        const fvi_method *method = fvi_method_find(row->method);
        mechanism_problem p;
        open_problem(t, &p);
        fvi_stepper *s = stepper_at(method, &p, 0.1, STEPS, 1);
        if (!isnan(row->x1[0]))
            ck_assert_msg(distance(s, t->d, row->x1, row->p1) <= 1e-14,
                          "%s, %s: row 1", t->name, method->name);
        while (s->k < STEPS)
            OK(fvi_stepper_step(s));
        const double off = larger(distance(s, t->d, row->x40, row->p40),
                                  fabs(work_of(s) - row->work));
        ck_assert_msg(off <= 1e-13, "%s, %s: %g", t->name, method->name, off);
        seen_worst(off, "deviation");
        fvi_stepper_free(s);
        close_problem(&p);
    }
}
END_TEST

/* What a Lagrangian of masses and a potential gives is what they give themselves. */
START_TEST(a_potential_is_the_case_of_a_quadratic_lagrangian)
{
    static const mechanism_text text = { .d = 1,
                                         .name = "duffing",
                                         .lagrangian = "2*v^2/2 - x^2/2 - 0.7*x^4/4",
                                         .damper = { "x : power:0.4,0.3" },
                                         .x0 = { 1 },
                                         .v0 = { 0.25 } };
    const double mass = 2, none = 0, cg[] = { 1, 0.7 };
    const fvi_kernel_term term = { FVI_KERNEL_POWER, 0.4, 0.3, 0, 0 };
    const fvi_kernel kernel = { 1, &term };
    const double row[] = { 1 };
    const fvi_damper damper = { .of = fvi_elongation_row(row), .kernel = &kernel };
    const fvi_mechanism mechanism = { .damper_count = 1, .damper = &damper };
    mechanism_problem p, q;
    open_problem(&text, &p);
    q = p;
    q.system = (fvi_system){ .d = 1,
                             .mass = &mass,
                             .damping = &none,
                             .potential = fvi_potential_duffing(cg),
                             .mechanism = &mechanism };
    const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_midpoint,
                                          &fvi_lobatto_m3, &fvi_lobatto_d3 };
    for (int m = 0; m < 4; m++) {
        fvi_stepper *a = stepper_at(methods[m], &p, 0.1, 100, 100),
                    *b = stepper_at(methods[m], &q, 0.1, 100, 100);
        double E, F, v;
        ck_assert_msg(distance(a, 1, b->x, b->p) <= 1e-14, "%s",
                      methods[m]->name);
        OK(fvi_stepper_energy(a, &E));
        OK(fvi_stepper_energy(b, &F));
        ck_assert_double_eq_tol(E, F, 1e-14);
        OK(fvi_stepper_velocity(a, &v));
        ck_assert_double_eq_tol(v, a->p[0] / 2, 1e-15);
        fvi_stepper_free(a);
        fvi_stepper_free(b);
    }
    close_problem(&p);
}
END_TEST

/* A copy, a reset and a state that was saved go on with the same digits. */
START_TEST(a_run_can_be_forked_saved_and_begun_again)
{
    const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_midpoint,
                                          &fvi_lobatto_m3, &fvi_lobatto_d3 };
    for (int m = 0; m < 4; m++)
        for (int i = 0; i < PROBLEMS; i++) {
            if (i == ROD && (m == 0 || m == 3))
                continue;
            const size_t d = problems[i].d;
            mechanism_problem p;
            open_problem(&problems[i], &p);
            fvi_stepper *s = stepper_at(methods[m], &p, 0.05, 300, 150), *fork,
                        *other = stepper_at(methods[m], &p, 0.05, 300, 0);
            OK(fvi_stepper_copy(s, &fork));
            save_and_restore(s, other);
            double x[2], p1[2], work = 0;
            while (s->k < 300)
                OK(fvi_stepper_step(s));
            memcpy(x, s->x, d * sizeof *x);
            memcpy(p1, s->p, d * sizeof *x);
            work = work_of(s);
            OK(fvi_stepper_reset(s));
            fvi_stepper *const again[] = { s, fork, other };
            for (int a = 0; a < 3; a++) {
                while (again[a]->k < 300)
                    OK(fvi_stepper_step(again[a]));
                ck_assert_mem_eq(again[a]->x, x, d * sizeof *x);
                ck_assert_mem_eq(again[a]->p, p1, d * sizeof *x);
                ck_assert(work_of(again[a]) == work);
                fvi_stepper_free(again[a]);
            }
            close_problem(&p);
        }
}
END_TEST

/* A Lagrangian that counts how often its second derivatives are asked for. */
typedef struct {
    const fvi_lagrangian *of;
    size_t count;
} counted;

static int count_and_ask(double t, size_t d, const double *x, const double *v,
                         void *params, double *L, double *Lx, double *Lv,
                         double *Lxx, double *Lxv, double *Lvv)
{
    counted *c = params;
    c->count += Lxx != NULL;
    return c->of->at(t, d, x, v, c->of->params, L, Lx, Lv, Lxx, Lxv, Lvv);
}

/* Newton's method converges as with exact derivatives: a slip in one of them costs iterations. L has
 * terms like v1 x2, the damper and the constraint are curved, the force knows x and v. Seen: 3.13,
 * 2.53, 2.28, 4 and 3.03 iterations a step of 0.25. */
START_TEST(newtons_method_has_exact_derivatives)
{
    const mechanism_text free_text = {
        .name = "gyroscopic",
        .d = 2,
        .lagrangian = "(v1^2+v2^2+v1*v2*cos(x1-x2))/2 + 2*v1*sin(x2) + cos(x1)",
        .damper = { "sqrt((x1+sin(x2))^2+(2-cos(x2))^2) : power:20,0.3" },
        .force_on = { "1=-0.2*v1*sqrt(v1^2+0.01)+x1*x2", "2=0.2*v2*x1" },
        .x0 = { 0.2, 1.2 },
        .v0 = { 0.4, 0.5 }
    };
    mechanism_text tied = problems[ROD];
    tied.lagrangian = "(v1^2+v2^2)/2 - x2 + 3*v1*x2^2";
    tied.constraint[0] = "x1^2+x2^2-1+(x1^4-x2^3)*0";
    const struct {
        const fvi_method *method;
        const mechanism_text *text;
        double most;
    } rows[] = { { &fvi_cq2_midpoint, &free_text, 3.2 },
                 { &fvi_lobatto_m4, &free_text, 2.6 },
                 { &fvi_lobatto_d4, &free_text, 2.4 },
                 { &fvi_cq2_midpoint, &tied, 4.1 },
                 { &fvi_lobatto_m4, &tied, 3.1 } };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mechanism_problem p;
        open_problem(rows[i].text, &p);
        counted c = { p.system.mechanism->lagrangian, 0 };
        const fvi_lagrangian L = { count_and_ask, &c };
        fvi_mechanism m = *p.system.mechanism;
        m.lagrangian = &L;
        p.system.mechanism = &m;
        const size_t stages = rows[i].method->stages ? (size_t)rows[i].method->stages : 1;
        fvi_stepper *s = stepper_at(rows[i].method, &p, 0.25, 40, 40);
        const double each = (double)c.count / (double)(stages * 40);
        ck_assert_msg(each <= rows[i].most, "%s, %s: %g", rows[i].text->name,
                      rows[i].method->name, each);
        seen(each, "%s %s", rows[i].text->name, rows[i].method->name);
        fvi_stepper_free(s);
        close_problem(&p);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lagrangian");
    ADD_CASE(suite, "rows", eq_29_6_and_29_7_the_rows_are_those_of_another_program,
             a_potential_is_the_case_of_a_quadratic_lagrangian,
             a_run_can_be_forked_saved_and_begun_again,
             newtons_method_has_exact_derivatives);
    return run_suite(suite);
}
