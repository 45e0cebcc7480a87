/* tests/lagrangian/test_lagrangian_orders.c -- H 29: orders, from motions that are known to 12 digits.
 * Run alone: make test-lagrangian_orders */
#include "problems.h"

#include "system/larger.h"

/* The references are Prony sums of 120 exponentials with Radau's method, and agree with another
 * such sum to 4e-13 (1e-11 where the order is 1.4). */
typedef struct {
    int problem; /* of problems, or -1: text */
    mechanism_text text;
    double T, digits, x[4];
    struct {
        const char *method;
        size_t N; /* and twice as many */
        double order, off;
    } row[6];
} known;

enum { COUNT = 9 };
static const known references[COUNT] = {
    { CART, { 0 }, 4, 1e-12, { 0.127966315868, -0.687174193121 },
      { { "fvi", 320, 1, 0.1 }, { "fvi-stable", 160, 2, 0.05 },
        { "fvi-lobatto3", 80, 4, 0.1 }, { "fvi-lobatto4", 20, 6, 0.2 },
        { "fvi-lobatto3d", 80, 4, 0.1 }, { "fvi-lobatto4d", 20, 6, 0.5 } } },
    { TWIN, { 0 }, 4, 1e-12, { -0.883946635396, -0.825565360704 },
      { { "fvi", 320, 1, 0.1 }, { "fvi-stable", 160, 2, 0.05 },
        { "fvi-lobatto3", 80, 4, 0.1 }, { "fvi-lobatto4", 40, 6, 0.2 },
        { "fvi-lobatto3d", 80, 4, 0.1 }, { "fvi-lobatto4d", 40, 6, 0.3 } } },
    { VAN_DER_POL, { 0 }, 6, 1e-12, { 1.660268711808 },
      { { "fvi", 320, 1, 0.1 }, { "fvi-stable", 160, 2, 0.1 },
        { "fvi-lobatto3", 80, 4, 0.1 }, { "fvi-lobatto4", 20, 6, 0.2 },
        { "fvi-lobatto3d", 160, 4, 0.1 } } },
    { MATHIEU, { 0 }, 6, 1e-12, { 0.383718180036 },
      { { "fvi", 320, 1, 0.1 }, { "fvi-stable", 160, 2, 0.05 },
        { "fvi-lobatto3", 80, 4, 0.1 }, { "fvi-lobatto3d", 320, 4, 0.2 } } },
    { ROD, { 0 }, 4, 1e-12, { -0.6238293682574, -0.7815605666227 },
      { { "fvi-stable", 160, 2, 0.05 }, { "fvi-lobatto2", 160, 2, 0.05 },
        { "fvi-lobatto3", 160, 4, 0.1 }, { "fvi-lobatto4", 40, 5.4, 0.5 },
        { "fvi-lobatto3d", 80, 4, 0.1 }, { "fvi-lobatto4d", 40, 6, 0.3 } } },
    /* friction that is nearly dry: -0.3 tanh(v/0.1) */
    { -1, FRICTION,
      6, 1e-12, { -0.160835363216 },
      { { "fvi-stable", 320, 2, 0.1 }, { "fvi-lobatto3", 160, 4, 0.1 },
        { "fvi-lobatto4", 160, 6, 0.4 }, { "fvi-lobatto4d", 80, 6, 0.3 } } },
    { -1, DRAG,
      4, 1e-12, { 0.170596353837, -1.704472329246 },
      { { "fvi", 320, 1, 0.1 }, { "fvi-stable", 160, 2, 0.1 },
        { "fvi-lobatto3", 80, 4, 0.2 }, { "fvi-lobatto4", 40, 6, 0.4 },
        { "fvi-lobatto3d", 80, 4, 0.2 } } },
    { -1, { .name = "imposed",
        .d = 2,
        .lagrangian = "3*v1^2/2 + v1*v2*cos(x2) + v2^2/2 + cos(x2)",
        .damper = { "x1 : power:0.3,0.3", "x2 : power:0.2,0.3" },
        .imposed = { "x1=0.3*sin(2*t)" },
        .x0 = { 0, 1.2 },
        .v0 = { 0.6, 0.5 } },
      4, 1e-12, { 0.29680747398701454, -1.815275855394 },
      { { "fvi-stable", 160, 2, 0.05 }, { "fvi-lobatto2", 160, 2, 0.05 },
        { "fvi-lobatto3", 80, 4, 0.1 }, { "fvi-lobatto4", 40, 6, 0.2 },
        { "fvi-lobatto3d", 80, 4, 0.2 }, { "fvi-lobatto4d", 40, 6, 0.5 } } },
    /* order 1.4, held with a velocity along the damper */
    { -1, { .name = "steep",
        .d = 2,
        .lagrangian = "(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2 - x2",
        .damper = { "sqrt(x1^2+x2^2) : power:0.4,0.7" },
        .x0 = { 1.2, 0 },
        .v0 = { 0.3, 0.8 } },
      4, 1e-10, { -0.578302121583, -1.387803211541 },
      { { "fvi", 320, 1, 0.1 }, { "fvi-stable", 160, 2, 0.1 },
        { "fvi-lobatto3", 80, 3.7, 0.15 }, { "fvi-lobatto3d", 80, 4, 0.15 } } },
};

static double error_of(const known *k, const mechanism_problem *p,
                       const fvi_method *method, size_t N)
{
    fvi_stepper *s = stepper_at(method, p, k->T / (double)N, N, N);
    double most = 0;
    for (size_t i = 0; i < k->text.d; i++)
        most = larger(most, fabs(s->x[i] - k->x[i]));
    fvi_stepper_free(s);
    return most;
}

/* From N to 2 N steps the error falls by two to the order, and is above the reference's digits. */
START_TEST(eq_29_10_orders_are_what_the_table_says)
{
    known k_ = references[_i];
    const known *k = &k_;
    mechanism_problem p;
    if (k_.problem >= 0)
        k_.text = problems[k_.problem];
    open_problem(&k->text, &p);
    for (size_t m = 0; m < 6 && k->row[m].method; m++) {
        const fvi_method *method = fvi_method_find(k->row[m].method);
        const double one = error_of(k, &p, method, k->row[m].N),
                     two = error_of(k, &p, method, 2 * k->row[m].N),
                     order = log2(one / two);
        ck_assert_msg(two > 4 * k->digits || method->highest > 4, "%s, %s: %g",
                      k->text.name, method->name, two);
        ck_assert_msg(fabs(order - k->row[m].order) <= k->row[m].off,
                      "%s, %s: order %g of %g, errors %g, %g", k->text.name,
                      method->name, order, k->row[m].order, one, two);
        seen(order, "%s %s", k->text.name, method->name);
    }
    close_problem(&p);
}
END_TEST

/* A linkage of four bars, one of which stands: three rods. Recipe's errors times 1.2. */
START_TEST(a_linkage_of_four_bars_converges)
{
    static const mechanism_text text = {
        .name = "four bars",
        .d = 4,
        .lagrangian = "(v1^2+v2^2)/2 + (v3^2+v4^2) - x2 - 2*x4",
        .damper = { "sqrt((x1-2)^2+x2^2) : power:0.5,0.3" },
        .constraint = { "(x1^2+x2^2-0.49)/2", "((x3-2)^2+x4^2-1.69)/2",
                        "((x1-x3)^2+(x2-x4)^2-3.24)/2" },
        .x0 = { 0.61430779332326091, 0.33559787702294208, 2.1388456575059656,
                1.2925640732248969 },
        .v0 = { -0.335597877022942, 0.614307793323261, 0.053624452636355,
                -0.005760273350408 }
    };
    const known k = { -1, text, 4, 1e-11,
                      { -0.424597813759, -0.556521964123, 0.888658179658,
                        0.674477099952 }, { { 0 } } };
    mechanism_problem p;
    open_problem(&text, &p);
    const struct {
        const fvi_method *method;
        size_t N;
        double least, most;
    } rows[] = { { &fvi_cq2_midpoint, 640, 4e-6, 1.2e-5 },
                 { &fvi_lobatto_m3, 320, 2e-9, 6e-9 },
                 { &fvi_lobatto_m4, 80, 3e-10, 2e-9 } };
    for (int i = 0; i < 3; i++) {
        const double off = error_of(&k, &p, rows[i].method, rows[i].N);
        ck_assert_msg(off >= rows[i].least && off <= rows[i].most, "%s: %g",
                      rows[i].method->name, off);
    }
    close_problem(&p);
}
END_TEST

/* Creep, D^0.6 x + x = 1 from 0, without a mass: x(1) = 1 - E_0.6(-1), to 16 digits by its series. Form D has
 * its full order; the node scheme order 2 in what it shows, (29.17), and its places do not swing. */
START_TEST(eq_29_17_creep_without_a_mass_converges)
{
    static const mechanism_text text = { .name = "creep",
                                         .d = 1,
                                         .lagrangian = "x-x^2/2",
                                         .damper = { "x : power:1,0.3" } };
    const known k = { -1, text, 1, 1e-15, { 0.5866726590568937 }, { { 0 } } };
    mechanism_problem p;
    open_problem(&text, &p);
    const double one = error_of(&k, &p, &fvi_cq2_midpoint, 80),
                 two = error_of(&k, &p, &fvi_cq2_midpoint, 160);
    ck_assert_msg(fabs(log2(one / two) - 2) < 0.05 && two < 3e-6, "%g %g", one, two);
    const double coarse = error_of(&k, &p, &fvi_lobatto_d4, 10),
                 fine = error_of(&k, &p, &fvi_lobatto_d4, 20);
    ck_assert_msg(fabs(log2(coarse / fine) - 6) < 0.4 && fine < 3e-11, "%g %g",
                  coarse, fine);
    fvi_stepper *s = stepper_at(&fvi_cq2_midpoint, &p, 0.1, 30, 1);
    for (double last = s->x[0]; s->k < 30; last = s->x[0]) {
        ck_assert_int_eq(fvi_stepper_step(s), 0);
        ck_assert_msg(s->x[0] > last, "row %zu", s->k);
    }
    fvi_stepper_free(s);
    close_problem(&p);
}
END_TEST

/* Held, with a velocity along a damper that grows like s^1.6 and is no power: the orders of H 17 with that
 * for the order of the damping. */
START_TEST(a_range_of_orders_has_its_order_after_a_start_with_a_velocity)
{
    static const mechanism_text text = {
        .name = "range",
        .d = 1,
        .lagrangian = "v^2/2 - x^2/2 - x^4/8",
        .damper = { "x : distributed:0.4,0.2,0.8" },
        .x0 = { 1 },
        .v0 = { 0.5 }
    };
    mechanism_problem p;
    open_problem(&text, &p);
    double x[3];
    for (size_t n = 0; n < 3; n++) {
        const size_t N = n < 2 ? 40u << n : 640;
        fvi_stepper *s = stepper_at(n < 2 ? &fvi_lobatto_m3 : &fvi_lobatto_m4, &p,
                                    4 / (double)N, N, N);
        x[n] = s->x[0];
        fvi_stepper_free(s);
    }
    const double order = log2(fabs(x[0] - x[2]) / fabs(x[1] - x[2]));
    ck_assert_msg(fabs(x[1] - x[2]) < 1e-7 && order > 3.3 && order < 4.2, "%g %g",
                  fabs(x[1] - x[2]), order);
    close_problem(&p);
}
END_TEST

/* A heavy body stays at 1, and z = x (1 + t) grows by its time alone: z' = 1. A dashpot of 0.5 answers with the force
 * 0.5, so its work in the time 2 is 1. */
START_TEST(a_time_in_an_elongation_does_work)
{
    static const mechanism_text text = { .name = "time",
                                         .d = 1,
                                         .lagrangian = "1e9*v^2/2",
                                         .damper = { "x*(1+t) : viscous:0.5" },
                                         .x0 = { 1 } };
    const fvi_method *const methods[] = { &fvi_fractional, &fvi_cq2_midpoint, &fvi_lobatto_m3, &fvi_lobatto_d4 };
    mechanism_problem p;
    open_problem(&text, &p);
    for (int m = 0; m < 4; m++) {
        double work;
        fvi_stepper *s = stepper_at(methods[m], &p, 0.1, 20, 20);
        OK(fvi_stepper_damper(s, 0, NULL, &work));
        ck_assert_double_eq_tol(work, 1, 1e-8);
        fvi_stepper_free(s);
    }
    close_problem(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lagrangian: orders");
    ADD_LOOP(suite, eq_29_10_orders_are_what_the_table_says, COUNT);
    ADD_CASE(suite, "orders", a_linkage_of_four_bars_converges, eq_29_17_creep_without_a_mass_converges,
             a_range_of_orders_has_its_order_after_a_start_with_a_velocity, a_time_in_an_elongation_does_work);
    return run_suite(suite);
}
