/* tests/program/test_fvi_options.c -- The parser of the command line, in the process.
 * Run alone: make test-fvi_options */
#define _GNU_SOURCE /* mkdtemp, setenv */
#include "harness/ulp.h"
#include "output/fvi_table.h"
#include "options/fvi_options.h"
#include "system/seeded.h"
#include <fvi/expression.h>
#include <fvi/format_double.h>
#include <fvi/parse_words.h>
#include "options/fvi_words.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

static uint64_t seed = 20240229;

static size_t dice(size_t n)
{
    return (size_t)(fvi_seeded_next(&seed) >> 33) % n;
}

/* Random words never crash the parser, and what it accepts is in range. */
START_TEST(random_words_are_understood_or_refused)
{
    static char words[][24] = {
        "--alpha", "--rho", "--mass", "--potential", "--force", "--derivative", "--kappa", "--x0", "--p0", "--h",
        "--steps", "--columns", "--every", "--memory", "--tolerance", "--time", "--error", "--method", "--count", "-o",
        "--", "-", "", "0.5", "1", "-1", "1e6", "nan", "inf", "0x1p-1", "1,2,3", ",", ":", "harmonic:1", "chain:3,1,1",
        "chain:99999,1,1", "duffing:1,2", "free", "pendulum:9", "step:1,2", "cosine:1,2", "none", "held", "rl",
        "caputo", "-h", "--apha", "help", "fvi", "lda", "fvi-lobatto3", "exponentials", "direct", "t,x,y", "energy",
        "--alpha=0.2", "--h=", "\x01\xff", "--help", "1e-999", "9007199254740993", "--let", "k=3", "k=2*k", "x=1", "k",
        "--dimension", "--format", "csv", "x^2/2", "x1*x2", "k*x**4 - sin(x)", "x^^2", "1/0", "cos(2*t) + step:1,2",
        "file:nowhere", "@nowhere"
    };
    static char run[] = "run", weights[] = "coefficients", program[] = "fvi";
    size_t accepted = 0;
    for (size_t round = 0; round < 100000; round++) {
        char *argv[12] = { program, dice(4) ? run : weights },
             complaint[FVI_COMPLAINT] = "";
        fvi_error error;
        int argc = 2 + (int)dice(9);
        for (int i = 2; i < argc; i++)
            argv[i] = words[dice(LEN(words))];
        fvi_options o;
        const int status = fvi_options_parse(argc, argv, &o, &error);
        ck_assert(status == 0 || status == error.code);
        if (status)
            ck_assert_int_eq(fvi_complaint(&error, complaint), 2);
        const char *second = strchr(complaint, '\n'); /* a caret, if anything */
        ck_assert(!second || strspn(second, "\n ") + 1 == strlen(second));
        if (status == 0 && o.command == FVI_COMMAND_RUN) {
            ck_assert(o.alpha >= 0 && o.alpha <= 1 && o.h > 0 && o.steps >= 1);
            ck_assert(o.error >= 0 && o.alpha >= o.method->alpha_least
                      && o.alpha <= o.method->alpha_most);
            ck_assert(o.rho[0] >= 0 && o.mass[0] >= 0 && o.d >= 1 && o.x0
                      && o.method);
            accepted++;
        }
        if (status == 0)
            fvi_options_free(&o);
    }
    ck_assert_uint_gt(accepted, 500); /* else nothing was tried */
}
END_TEST

/* What was not said has the value of the manual. */
START_TEST(defaults_are_those_of_the_manual)
{
    char program[] = "fvi", run[] = "run";
    char *argv[] = { program, run, NULL };
    fvi_options o;
    fvi_forcing force;
    double constants[2];
    ck_assert_int_eq(fvi_options_parse(2, argv, &o, NULL), 0);
    ck_assert(o.alpha == 0.5 && o.rho[0] == 0.2 && o.mass[0] == 1
              && o.kappa == 0.5);
    ck_assert(o.h == 0.1 && o.steps == 200 && o.every == 1 && o.d == 1);
    ck_assert(o.x0[0] == 1 && o.p0[0] == 0.5 && o.past == FVI_INITIAL_HISTORY_HELD
              && !o.output);
    ck_assert(o.potential.kind == FVI_POTENTIAL_HARMONIC
              && o.potential.constants[0] == 1);
    ck_assert(fvi_typed_force_is_simple(o.force, &force, constants)
              && force == FVI_FORCING_NONE);
    ck_assert(o.memory == FVI_HISTORY_AUTO && o.tolerance == 1e-13);
    ck_assert(o.error == 0);
    const fvi_column columns[] = { FVI_COLUMN_T, FVI_COLUMN_X, FVI_COLUMN_P,
                                   FVI_COLUMN_ENERGY };
    ck_assert(o.columns.count == 4
              && memcmp(o.columns.at, columns, sizeof columns) == 0);
    ck_assert_str_eq(o.method->name, "fvi");
    fvi_options_free(&o);
}
END_TEST

/* Parse up to two words behind the program's name; the exit code. */
static int parse(const char *first, const char *second, const char *third,
                 char complaint[FVI_COMPLAINT])
{
    static char words[4][40] = { "fvi" };
    char *argv[5] = { words[0], words[1], words[2], words[3], NULL };
    const char *const given[] = { first, second, third };
    int argc = 1;
    for (size_t i = 0; i < LEN(given) && given[i]; i++)
        snprintf(words[argc++], sizeof *words, "%s", given[i]);
    fvi_options o;
    fvi_error error;
    if (fvi_options_parse(argc, argv, &o, &error))
        return fvi_complaint(&error, complaint);
    fvi_options_free(&o);
    return 0;
}

/* A slip of the finger: a letter too many, too few, another one, two swapped, a word
 * not written out, capitals. NULL: nothing that is near enough. */
START_TEST(the_nearest_known_word_is_named)
{
    static const struct {
        const char *first, *second, *third, *meant;
    } slips[] = { { "run", "--apha", "1", "--alpha" },
                  { "run", "--apha=1", NULL, "--alpha" },
                  { "run", "--alhpa", "1", "--alpha" },
                  { "run", "-alpha", "1", "--alpha" },
                  { "run", "--alp", "1", "--alpha" },
                  { "run", "--potental", "free", "--potential" },
                  { "run", "--Mass", "1", "--mass" },
                  { "run", "--halp", NULL, "--help" },
                  { "run", "--bogus", "1", NULL },
                  { "run", "-x", NULL, NULL },
                  { "exact", "--kapa", "1", NULL }, /* not its option */
                  { "coefficients", "--cuont", "1", "--count" },
                  { "rnu", NULL, NULL, "run" },
                  { "exat", NULL, NULL, "exact" },
                  { "gradint", NULL, NULL, "gradient" },
                  { "swep", NULL, NULL, "sweep" },
                  { "help", "fitt", NULL, "fit" },
                  { "help", "method", NULL, "methods" },
                  { "--hlp", NULL, NULL, "--help" },
                  { "--", NULL, NULL, "--help" },
                  { "-x", NULL, NULL, NULL },
                  { "walk", NULL, NULL, NULL },
                  { "", NULL, NULL, NULL },
                  { "run", "--method", "fvi-lobato3", "fvi-lobatto3" },
                  { "run", "--method", "rk4", NULL },
                  { "run", "--derivative", "cauputo", "caputo" },
                  { "run", "--derivative", "hled", "held" },
                  { "run", "--derivative", "riemann", NULL },
                  { "run", "--potential", "duffin:1,1", "duffing" },
                  { "run", "--potential", "chian:3,1,1", "chain" },
                  { "run", "--potential", "duffing", NULL }, /* but no C */
                  { "run", "--potential", "harmonc", "harmonic" },
                  { "run", "--force", "cosine:1", NULL },
                  { "run", "--force", "cosin:1,2", "cosine" },
                  { "run", "--memory", "exponential", "exponentials" },
                  { "run", "--columns", "t,enrgy,x", "energy" },
                  { "run", "--columns", "t,q", NULL } };
    for (size_t i = 0; i < LEN(slips); i++) {
        char complaint[FVI_COMPLAINT] = "", hint[60];
        ck_assert_int_eq(parse(slips[i].first, slips[i].second, slips[i].third,
                               complaint),
                         2);
        const char *said = strstr(complaint, "; did you mean ");
        if (!slips[i].meant) {
            ck_assert_msg(!said, "%s", complaint);
            continue;
        }
        snprintf(hint, sizeof hint, "; did you mean %s?", slips[i].meant);
        ck_assert_msg(said && strcmp(said, hint) == 0, "%s", complaint);
    }
    char complaint[FVI_COMPLAINT] = ""; /* all methods are named, to the last */
    parse("run", "--method", "rk4", complaint);
    ck_assert_ptr_nonnull(strstr(complaint, ", fvi-stable"));
}
END_TEST

/* On 32 bits a size_t ends at 4 294 967 295, and half of that is what is taken; more
 * known words than there is room for are cut, not written behind it. */
START_TEST(words_stay_within_their_bounds)
{
    char text[FVI_COMPLAINT] = "";
    fvi_error error;
    size_t value = 7;
    ck_assert_int_eq(
        fvi_parse_whole("steps", "1e10", 2147483647, &value, &error), FVI_EDOM);
    ck_assert_int_eq(fvi_complaint(&error, text), 2);
    ck_assert_str_eq(error.field, "steps");
    ck_assert_double_eq(error.value, 1e10);
    ck_assert_str_eq(text, "--steps: '1e10' is outside [1, 2.14748e+09]");
    ck_assert_uint_eq(value, 7);
    ck_assert_int_eq(
        fvi_parse_whole("steps", "2e9", 2147483647, &value, NULL), 0);
    ck_assert_uint_eq(value, 2000000000);
    ck_assert_int_eq(fvi_parse_whole("steps", "1e16", SIZE_MAX, &value, NULL),
                     FVI_EDOM);
    const char *many[101];
    for (size_t i = 0; i < 100; i++)
        many[i] = "a-word-of-some-length";
    many[100] = NULL;
    ck_assert_int_eq(fvi_parse_word("x", "else", many, &value, &error),
                     FVI_EINVAL);
    ck_assert_uint_lt(strlen(error.text), strlen("'else' is none of ") + 320);
}
END_TEST

/* Of a list of 400 numbers that is one too long the beginning is said, and what is
 * wrong with it. */
START_TEST(a_long_word_is_shortened_and_its_reason_stays)
{
    static const char reason[] = "3,3,3' has 400 numbers, not 1 or 399";
    char word[800];
    fvi_error error;
    double values[399];
    for (size_t i = 0; i < 400; i++)
        memcpy(word + 2 * i, i < 399 ? "3," : "3", 2);
    ck_assert_int_eq(
        fvi_parse_numbers("x0", word, -1, 9, "[]", 399, values, &error),
        FVI_EINVAL);
    ck_assert_uint_eq(strlen(error.text), 399);
    ck_assert_int_eq(strncmp(error.text, "'3,3,3,", 7), 0);
    ck_assert_ptr_nonnull(strstr(error.text, "..."));
    ck_assert_str_eq(error.text + 399 - strlen(reason), reason);
}
END_TEST

/* The fewest of 15 to 17 digits that come back, or fewer for subnormal numbers, as the C
 * library writes them: random bits, decimals, powers of two and ten and their neighbours. */
START_TEST(digits_are_those_of_the_c_library)
{
    for (int i = 0; i < 200000; i++) {
        const double sign = dice(2) ? 1 : -1,
                     ten = pow(10, (double)dice(42) - 21),
                     two = ldexp(1, (int)dice(140) - 70);
        const uint64_t bits = (uint64_t)dice(1u << 31) << 33
                              ^ (uint64_t)dice(1u << 31) << 11 ^ dice(1u << 12);
        double v;
        memcpy(&v, &bits, sizeof v);
        const double some[] = { v,
                                (double)dice(100000000) * ten,
                                (double)dice(1u << 30) / 1e9,
                                ten,
                                nextafter(ten, i % 2 ? 0 : 1e300),
                                two,
                                nextafter(two, i % 2 ? 0 : 1e300),
                                (double)(dice(1u << 30) * 2 + 1) * 0.5,
                                ldexp((double)dice(1000), -1074) };
        v = sign * some[i % 9];
        if (!isfinite(v))
            continue;
        char want[40], text[32];
        for (int digits = fabs(v) < DBL_MIN ? 1 : 15; digits <= 17; digits++) {
            snprintf(want, sizeof want, "%.*g", digits, v);
            if (strtod(want, NULL) == v)
                break;
        }
        ck_assert_int_eq(fvi_format_double(v, text), (int)strlen(want));
        ck_assert_str_eq(text, want);
    }
}
END_TEST

/* A number of any size has a point where the locale has a comma, too: written, also in the text of a damper, and read in
 * an option and in an expression. The test makes such a locale, if it can. */
START_TEST(numbers_have_a_point_in_every_locale)
{
    static const struct {
        double v;
        const char *text;
    } some[] = { { 0.5, "0.5" }, { -1.5e300, "-1.5e+300" }, { 2.5e-300, "2.5e-300" }, { 1.5e-320, "1.5e-320" } };
    char folder[] = "/tmp/fvi_locale_XXXXXX", command[120], text[32];
    const fvi_symbols names = { "x", 1, NULL, 0 };
    const double one = 1;
    double read = 0, rho = 2.5;
    size_t count;
    char **dampers;
    fvi_expression *e;
    ck_assert_ptr_nonnull(mkdtemp(folder));
    snprintf(command, sizeof command, "localedef -i de_DE -f ISO-8859-1 %s/comma >%s/log 2>&1", folder, folder);
    const int is_made = system(command) == 0 && setenv("LOCPATH", folder, 1) == 0 && setlocale(LC_NUMERIC, "comma");
    ck_assert(!is_made || strcmp(localeconv()->decimal_point, ",") == 0);
    for (size_t i = 0; i < LEN(some); i++) {
        ck_assert_int_eq(fvi_format_double(some[i].v, text), (int)strlen(some[i].text));
        ck_assert_str_eq(text, some[i].text);
        ck_assert_int_eq(fvi_parse_number("x", some[i].text, -INFINITY, INFINITY, "()", &read, NULL), FVI_SUCCESS);
        ck_assert(read == some[i].v);
    }
    ck_assert_int_eq(fvi_expression_parse("1.5*x^2 + .25", &names, NULL, &e, NULL), FVI_SUCCESS);
    ck_assert(fvi_expression_value(e, &one) == 1.75);
    fvi_expression_free(e);
    ck_assert_int_eq(fvi_damper_texts(1, &rho, 0.3, NULL, NULL, &count, &dampers, NULL), FVI_SUCCESS);
    ck_assert_str_eq(dampers[0], "x1 : power:2.5,0.3 : held");
    free(dampers);
    setlocale(LC_NUMERIC, "C");
    unsetenv("LOCPATH");
    snprintf(command, sizeof command, "rm -r %s", folder);
    ck_assert_int_eq(system(command), 0);
}
END_TEST

/* A run of 10 steps, of which every 4th is printed: without the mirror nothing else is asked
 * for; with it, wherever y stands among the columns, also the nodes 10 - k. */
START_TEST(only_the_mirror_asks_for_other_nodes)
{
    static const struct {
        const char *columns;
        size_t count, nodes[6];
    } some[] = { { "t,x", 4, { 0, 4, 8, 10 } },
                 { "t,x,y", 6, { 0, 2, 4, 6, 8, 10 } },
                 { "y,t", 6, { 0, 2, 4, 6, 8, 10 } } };
    for (size_t i = 0; i < LEN(some); i++) {
        char columns[8],
            *line[] = { "fvi",     "run", "--steps",   "10",
                        "--every", "4",   "--columns", columns };
        fvi_options o;
        fvi_table table;
        const fvi_system system = { 0 };
        strcpy(columns, some[i].columns);
        ck_assert_int_eq(fvi_options_parse(LEN(line), line, &o, NULL), 0);
        fvi_table_shape(&table, &o, &system);
        size_t k = 0;
        for (size_t n = 1; n < some[i].count; n++) {
            k = fvi_table_next(&table, k);
            ck_assert_uint_eq(k, some[i].nodes[n]);
        }
        fvi_options_free(&o);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the words of fvi");
    ADD_CASE(suite, "values", defaults_are_those_of_the_manual,
             digits_are_those_of_the_c_library,
             numbers_have_a_point_in_every_locale);
    ADD_CASE(suite, "errors", random_words_are_understood_or_refused,
             the_nearest_known_word_is_named,
             only_the_mirror_asks_for_other_nodes,
             words_stay_within_their_bounds,
             a_long_word_is_shortened_and_its_reason_stays);
    return run_suite(suite);
}
