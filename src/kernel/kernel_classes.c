/* src/kernel/kernel_classes.c -- The kinds of kernels: all that the library knows of a kind.   [H 26] */
#include "kernel_classes.h"

#include "symbol_poles.h"
#include "system/fail.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <string.h>

/* ---- a range of orders ---- */

static int check_range(const fvi_kernel_term *t)
{
    const int status = fvi_check_order(t);
    if (!status && !(t->end > t->alpha && t->end <= 1))
        FVI_FAIL("the end of a range of orders must be in (alpha, 1]", FVI_EDOM);
    return status;
}

/* Integrate e^{2 a L}, L = ln s, over the range of orders, and write the derivative by L to *slope. */
static double complex range_symbol(const fvi_kernel_term *t, double modulus,
                                   double angle, double complex *slope)
{
    const double middle = (t->alpha + t->end) / 2, width = t->end - t->alpha;
    const double complex L = log(modulus) + I * angle,
                         q = fvi_power_at(middle, modulus, angle);
    if (L == 0) {
        *slope = 2 * middle * width;
        return width;
    }
    const double complex ratio = csinh(width * L) / L;
    *slope = q * (2 * middle * ratio + (width * ccosh(width * L) - ratio) / L);
    return q * ratio;
}

static double range_growth(const fvi_kernel_term *t)
{
    return 2 * t->end;
}

static fvi_kernel_side range_side(const fvi_kernel_term *t)
{
    return t->end <= 0.5 ? FVI_SIDE_ABOVE : t->alpha >= 0.5 ? FVI_SIDE_BELOW : FVI_SIDE_ANYWHERE;
}

/* dC/da and dC/de of a range of orders. (23.21) */
static double complex derivative_of_range(const fvi_kernel_term *t, double complex s, size_t field)
{
    return field == 1 ? -cpow(s, 2 * t->alpha) : cpow(s, 2 * t->end);
}

static const fvi_kernel_class range_of_orders = {
    { FVI_RHO, FVI_HALF_ORDER(1), { "end", 3, FVI_RANGE_ORDER, 1 } }, check_range, range_symbol, range_growth,
    .by = derivative_of_range, .side = range_side
};

/* ---- Cole and Davidson ---- */

static double complex davidson_symbol(const fvi_kernel_term *t, double modulus,
                                      double angle, double complex *slope)
{
    const double complex part =
        1 + t->time * modulus * (cos(angle) + I * sin(angle));
    const double complex C =
        fvi_power_at(t->alpha, modulus, angle)
        * fvi_power_at(-t->alpha, cabs(part), carg(part));
    *slope = 2 * t->alpha * C / part;
    return C;
}

/* Of order 1 it is a Maxwell element, without a time a power, and of order 0 a spring. */
static int davidson_fraction(const fvi_kernel_term *t, fvi_kernel_simple *f)
{
    if (t->alpha == 0.5)
        return fvi_zener_fraction(t, f);
    return (t->time == 0 || t->alpha == 0) && fvi_power_fraction(t, f);
}

/* For r > 1 / T it is real and positive. */
static fvi_kernel_side davidson_side(const fvi_kernel_term *t)
{
    return t->alpha < 0.5 ? FVI_SIDE_ABOVE_OR_ON : FVI_SIDE_ANYWHERE;
}

static double davidson_growth(const fvi_kernel_term *t)
{
    return t->time == 0 ? 2 * t->alpha : 0;
}

/* Return ln(1 + z), accurate also for |z| much smaller than 1. */
static double complex log_of_1_and(double complex z)
{
    return cabs(z) > 1e-4 ? clog(1 + z) : z * (1 - z * (1. / 2 - z * (1. / 3 - z * (1. / 4 - z / 5))));
}

/* ln(s / (1 + time s)). For |time s| > 1 the quotient is divided by s first, because ln s and ln(1 + time s) are then
 * nearly alike and their difference would lose digits. */
static double complex davidson_log(const fvi_kernel_term *t, double complex s)
{
    const double complex Ts = t->time * s;
    return cabs(Ts) > 1 ? -log(t->time) - log_of_1_and(1 / Ts) : clog(s) - log_of_1_and(Ts);
}

static double complex derivative_of_davidson(const fvi_kernel_term *t, double complex s, size_t field)
{
    const double complex ln = davidson_log(t, s);
    return field == 1 ? 2 * ln * cexp(2 * t->alpha * ln) : -2 * t->alpha * cexp((2 * t->alpha + 1) * ln);
}

static const fvi_kernel_class davidson = {
    { FVI_RHO, FVI_HALF_ORDER(1), FVI_TIME }, fvi_check_order_and_time, davidson_symbol, davidson_growth,
    davidson_fraction, fvi_davidson_modes, derivative_of_davidson, davidson_side, .has_time = 1
};

/* ---- Havriliak and Negami ---- */

static int check_havriliak(const fvi_kernel_term *t)
{
    const int status = fvi_check_order_and_time(t);
    if (!status && !(t->alpha <= 0.5))
        FVI_FAIL("2 alpha of this law must be at most 1: above, it has a branch point off the negative axis", FVI_EDOM);
    if (!status && !(t->end > 0 && t->end <= 1))
        FVI_FAIL("the exponent of this law must be in (0, 1]", FVI_EDOM);
    return status;
}

//> havriliak
/* Return q / (1 + T q)^B with q = s^{2 a}, and write s times its derivative to *slope. */
static double complex havriliak_symbol(const fvi_kernel_term *t, double modulus, double angle, double complex *slope)
{
    const double complex q = fvi_power_at(t->alpha, modulus, angle), part = 1 + t->time * q,
                         C = q * cexp(-t->end * log_of_1_and(t->time * q));
    *slope = 2 * t->alpha * C * (1 + (1 - t->end) * t->time * q) / part;
    return C;
}
//< havriliak

static double havriliak_growth(const fvi_kernel_term *t)
{
    return t->time == 0 ? 2 * t->alpha : 2 * t->alpha * (1 - t->end);
}

/* Without a time it is a power, with the exponent 1 the law of Zener, and of order 0 a spring. */
static int havriliak_fraction(const fvi_kernel_term *t, fvi_kernel_simple *f)
{
    if (t->alpha > 0)
        return (t->time == 0 || t->end == 1) && fvi_zener_fraction(t, f);
    *f = (fvi_kernel_simple){ t->rho * pow(1 + t->time, -t->end), 0, 0, 0 };
    return 1;
}

/* The angle of (1 + T q)^B is between 0 and the angle of q. */
static fvi_kernel_side havriliak_side(const fvi_kernel_term *t)
{
    return t->alpha < 0.5 ? FVI_SIDE_ABOVE : FVI_SIDE_ANYWHERE;
}

static double complex derivative_of_havriliak(const fvi_kernel_term *t, double complex s, size_t field)
{
    const double complex C = fvi_kernel_at(&(fvi_kernel){ 1, t }, s, NULL), q = t->time * cexp(2 * t->alpha * clog(s));
    if (field == 1)
        return 2 * clog(s) * C * (1 + (1 - t->end) * q) / (1 + q);
    if (field == 2)
        return -t->end * C * cexp(2 * t->alpha * clog(s)) / (1 + q);
    return -C * log_of_1_and(q);
}

static const fvi_kernel_class havriliak = {
    { FVI_RHO, FVI_HALF_ORDER(0.5), FVI_TIME, { "beta", 3, FVI_RANGE_EXPONENT, 1 } }, check_havriliak,
    havriliak_symbol, havriliak_growth, havriliak_fraction,
    .by = derivative_of_havriliak, .side = havriliak_side
};

/* ---- the table of kinds ---- */

static const fvi_kernel_class symbol = { .check = fvi_symbol_check, .symbol = fvi_symbol_value };

const fvi_kernel_class *const fvi_kernel_classes[] = {
    [FVI_KERNEL_POWER] = &fvi_kernel_of_power,         [FVI_KERNEL_ZENER] = &fvi_kernel_of_zener,
    [FVI_KERNEL_MAXWELL] = &fvi_kernel_of_maxwell,     [FVI_KERNEL_DISTRIBUTED] = &range_of_orders,
    [FVI_KERNEL_MAXWELL2] = &fvi_kernel_of_maxwell2,   [FVI_KERNEL_DAVIDSON] = &davidson,
    [FVI_KERNEL_SYMBOL] = &symbol,                     [FVI_KERNEL_HAVRILIAK] = &havriliak,
};
const size_t fvi_kernel_class_count = sizeof fvi_kernel_classes / sizeof *fvi_kernel_classes;

/* ---- their words ---- */

/* The table of all words, but for symbol: a word, the letters of its numbers, its formula, its kind, and the members of
 * fvi_kernel_word behind the kind. The three lists below are made of it. The dashpot is the first word, but the spring
 * is the first fvi_element. */
#define DASHPOT(row) row("viscous", "R", "R s, a dashpot: the force R x'", FVI_KERNEL_POWER, "R >= 0", NULL, 0.5)
#define SPRING(row) row("spring", "K", "K, a spring that is not stretched at x0", FVI_KERNEL_POWER, "K >= 0", "k", 0)
#define OTHER_WORDS(row)                                                                                               \
    row("power", "R,A", "R s^{2A}, a springpot: R D^{2A}", FVI_KERNEL_POWER, "R >= 0 and 0 <= A <= 1", NULL, 0)        \
    row("zener", "R,A,T", "R s^{2A}/(1 + T s^{2A})", FVI_KERNEL_ZENER, "R, T >= 0 and 0 <= A <= 1", NULL, 0)           \
    row("maxwell", "R,T", "R s/(1 + T s), a dashpot and a spring R/T in series", FVI_KERNEL_MAXWELL, "R, T >= 0",      \
        NULL, 0)                                                                                                       \
    row("maxwell2", "R1,A,R2,B", "1/(1/(R1 s^{2A}) + 1/(R2 s^{2B})), springpots in series", FVI_KERNEL_MAXWELL2,       \
        "R1, R2 >= 0 and A, B in [0, 1]", NULL, 0)                                                                     \
    row("davidson", "R,A,T", "R (s/(1 + T s))^{2A}, of Cole and Davidson", FVI_KERNEL_DAVIDSON,                        \
        "R, T >= 0 and 0 <= A <= 1", NULL, 0)                                                                          \
    row("distributed", "R,A,B", "the integral of R s^{2a} over a from A to B", FVI_KERNEL_DISTRIBUTED,                 \
        "R >= 0 and 0 <= A < B <= 1", NULL, 0)                                                                         \
    row("havriliak", "R,A,T,B", "R s^{2A}/(1 + T s^{2A})^B, of Havriliak and Negami", FVI_KERNEL_HAVRILIAK,            \
        "R, T >= 0, 0 <= 2A <= 1 and 0 < B <= 1; for 2A > 1 it has a branch point off the cut", NULL, 0)

#define FORMULA(word, letters, formula, kind, range, first, alpha) { word ":" letters, formula },
#define KIND(word, letters, formula, kind, range, first, alpha) { kind, range, first, alpha },
#define WORD(word, letters, formula, kind, range, first, alpha) word,

const fvi_formula fvi_law_formulas[] = {
    DASHPOT(FORMULA) SPRING(FORMULA) OTHER_WORDS(FORMULA)
    { "symbol:C", "C, an expression in s; it stands alone" },
    { NULL, NULL },
};

const fvi_kernel_word fvi_kernel_words[] = { DASHPOT(KIND) SPRING(KIND) OTHER_WORDS(KIND) };
const size_t fvi_kernel_word_count = sizeof fvi_kernel_words / sizeof *fvi_kernel_words;

const char *const fvi_element_words[] = { SPRING(WORD) DASHPOT(WORD) OTHER_WORDS(WORD) NULL };

size_t fvi_kernel_word_numbers(size_t i)
{
    size_t n = 1;
    for (const char *at = fvi_law_formulas[i].form; (at = strchr(at, ',')); at++)
        n++;
    return n;
}

const fvi_kernel_number *fvi_kernel_number_of(const fvi_kernel_term *t, size_t field)
{
    const fvi_kernel_number *of = fvi_kernel_classes[t->kind]->number;
    for (size_t i = 0; i < FVI_KERNEL_FIELDS && of[i].name; i++)
        if (of[i].field == field)
            return of + i;
    return NULL;
}

/* ---- values ---- */

double complex fvi_kernel_unit_at(const fvi_kernel_term *t, double modulus, double angle)
{
    double complex slope;
    return fvi_kernel_classes[t->kind]->symbol(t, modulus, angle, t->kind == FVI_KERNEL_SYMBOL ? NULL : &slope);
}

double complex fvi_kernel_term_at(const fvi_kernel_term *t, double modulus, double angle)
{
    return t->rho * fvi_kernel_unit_at(t, modulus, angle);
}
