/* src/fvi_options.c -- What the command line of build/fvi says. */
#define _GNU_SOURCE /* getopt_long */
#include "fvi_options.h"

#include "convolution_quadrature.h"
#include "discrete_mechanics.h"
#include "fvi.h"
#include "fvi_words.h"
#include "lobatto.h"

#include <float.h>
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const fvi_method *const fvi_options_methods[] = {
    &fvi_fractional,     &fvi_lagrange_dalembert,
    &fvi_euler_explicit, &fvi_euler_implicit,
    &fvi_shifted,        &fvi_bdf2,
    &fvi_lobatto2,       &fvi_lobatto3,
    &fvi_lobatto4,       NULL
};

/* ---- the table of options ---- */

enum { RUN = 1, EXACT = 2, COEFFICIENTS = 4 };

typedef enum {
    METHOD,
    ALPHA,
    RHO,
    MASS,
    POTENTIAL,
    FORCE,
    DERIVATIVE,
    KAPPA,
    X0,
    P0,
    H,
    STEPS,
    TIME,
    ERROR,
    COLUMNS,
    EVERY,
    MEMORY,
    TOLERANCE,
    COUNT,
    OUTPUT,
    OPTIONS
} option_index;

static const struct {
    const char *name;
    int commands;       /* which of them know it */
    const char *preset; /* NULL: none */
} table[OPTIONS] = {
    [METHOD] = { "method", RUN, "fvi" },
    [ALPHA] = { "alpha", RUN | EXACT | COEFFICIENTS, "0.5" },
    [RHO] = { "rho", RUN | EXACT, "0.2" },
    [MASS] = { "mass", RUN | EXACT, "1" },
    [POTENTIAL] = { "potential", RUN | EXACT, "harmonic:1" },
    [FORCE] = { "force", RUN | EXACT, "none" },
    [DERIVATIVE] = { "derivative", RUN | EXACT, "rl" },
    [KAPPA] = { "kappa", RUN, "0.5" },
    [X0] = { "x0", RUN | EXACT, "1" },
    [P0] = { "p0", RUN | EXACT, "0.5" },
    [H] = { "h", RUN | EXACT, "0.1" },
    [STEPS] = { "steps", RUN | EXACT, "200" },
    [TIME] = { "time", RUN | EXACT, NULL },
    [ERROR] = { "error", RUN, NULL },
    [COLUMNS] = { "columns", RUN | EXACT, "t,x,p,energy" },
    [EVERY] = { "every", RUN | EXACT, "1" },
    [MEMORY] = { "memory", RUN, "auto" },
    [TOLERANCE] = { "tolerance", RUN, "1e-13" },
    [COUNT] = { "count", COEFFICIENTS, "10" },
    [OUTPUT] = { "o", RUN | EXACT | COEFFICIENTS, NULL },
};

static int mask(fvi_command command)
{
    return command == FVI_COMMAND_RUN            ? RUN
           : command == FVI_COMMAND_EXACT        ? EXACT
           : command == FVI_COMMAND_COEFFICIENTS ? COEFFICIENTS
                                                 : 0;
}

int fvi_options_describe(const fvi_options *o, size_t i, const char **name,
                         const char **value)
{
    size_t seen = 0;
    for (size_t j = 0; j < OUTPUT; j++)
        if (table[j].commands & mask(o->command) && o->text[j] && seen++ == i) {
            *name = table[j].name;
            *value = o->text[j];
            return 1;
        }
    return 0;
}

/* ---- words to values ---- */

/* The number of option i; see fvi_word_number. */
static int number(const fvi_options *o, option_index i, double low, double high,
                  const char *brackets, double *value, fvi_complaint c)
{
    return fvi_word_number(table[i].name, o->text[i], low, high, brackets,
                           value, c);
}

static int whole(const fvi_options *o, option_index i, size_t *value,
                 fvi_complaint c)
{
    return fvi_word_whole(table[i].name, o->text[i], value, c);
}

static int choice(const fvi_options *o, option_index i,
                  const char *const *words, size_t *which, fvi_complaint c)
{
    return fvi_word_choice(table[i].name, o->text[i], words, which, c);
}

/* ---- what belongs together ---- */

/* A jump of the force that is not at a row is what no estimate can see. */
static int interpret_error(fvi_options *o, fvi_complaint c)
{
    int status = number(o, ERROR, 0, INFINITY, "()", &o->error, c);
    if (status || o->force != 's')
        return status;
    const double end = o->forcing[1] / o->h, row = round(end);
    if (row <= (double)o->steps && fabs(end - row) > 4 * DBL_EPSILON * row)
        return fvi_refuse(c,
                          "--error: the force '%s' ends between two rows; "
                          "take other --steps",
                          o->text[FORCE]);
    return 0;
}

static int is_lobatto(const fvi_method *m)
{
    return m == &fvi_lobatto2 || m == &fvi_lobatto3 || m == &fvi_lobatto4;
}

static int interpret_run(fvi_options *o, fvi_complaint c)
{
    static const char *const memories[] = { "auto", "direct", "fft",
                                            "exponentials", NULL };
    size_t which;
    int status = number(o, KAPPA, 0, 1, "[]", &o->kappa, c);
    if (!status)
        status = number(o, TOLERANCE, 1e-14, 1, "[)", &o->tolerance, c);
    if (!status)
        status = choice(o, MEMORY, memories, &which, c);
    if (status)
        return status;
    o->memory = (fvi_memory_kind)which;

    const char *names[sizeof fvi_options_methods / sizeof *fvi_options_methods];
    for (which = 0; fvi_options_methods[which]; which++)
        names[which] = fvi_options_methods[which]->name;
    names[which] = NULL;
    status = choice(o, METHOD, names, &which, c);
    if (status)
        return status;
    o->method = fvi_options_methods[which];
    if (o->method->half_only && o->alpha != 0.5)
        return fvi_refuse(c, "--alpha: '%s' is not 0.5, all that %s knows",
                          o->text[ALPHA], o->method->name);
    if (is_lobatto(o->method) && o->memory == FVI_MEMORY_FFT)
        return fvi_refuse(c, "--memory: 'fft' is not known to %s",
                          o->method->name);
    if (!o->method->half_only && o->method != &fvi_fractional) {
        o->caputo = 1; /* they know nothing else, and the head says so */
        o->text[DERIVATIVE] = "caputo";
    }
    return o->text[ERROR] ? interpret_error(o, c) : 0;
}

/* The rows are at t_k = k h: by --h, or by --time. */
static int interpret_grid(fvi_options *o, fvi_complaint c)
{
    int status = whole(o, STEPS, &o->steps, c);
    if (status || !o->text[TIME])
        return status ? status : number(o, H, 0, INFINITY, "()", &o->h, c);
    double time = 0;
    status = number(o, TIME, 0, INFINITY, "()", &time, c);
    o->h = time / (double)o->steps;
    if (!status && !(o->h > 0))
        return fvi_refuse(c, "--time: '%s' is too short for so many steps",
                          o->text[TIME]);
    return status;
}

/* What run and exact share: the system, its start, the grid, the columns. */
static int interpret_trajectory(fvi_options *o, fvi_complaint c)
{
    static const char *const derivatives[] = { "rl", "caputo", NULL };
    size_t which = 0;
    int status = number(o, RHO, 0, INFINITY, "[)", &o->rho, c);
    if (!status)
        status = number(o, MASS, 0, INFINITY, "()", &o->mass, c);
    if (!status)
        status = fvi_word_potential(o->text[POTENTIAL], &o->potential, &o->d,
                                    o->spring, c);
    if (!status)
        status = fvi_word_force(o->text[FORCE], &o->force, o->forcing, c);
    if (!status)
        status = choice(o, DERIVATIVE, derivatives, &which, c);
    o->caputo = which == 1;
    if (!status)
        status = interpret_grid(o, c);
    if (!status)
        status = whole(o, EVERY, &o->every, c);
    if (!status)
        status = fvi_word_columns(o->text[COLUMNS], o->columns, c);
    if (!status && o->command == FVI_COMMAND_RUN)
        status = interpret_run(o, c);
    if (!status && o->command == FVI_COMMAND_EXACT
        && !(o->potential == 'f' || (o->potential == 'h' && o->spring[0] >= 0)))
        return fvi_refuse(c,
                          "--potential: '%s' has no exact solution here; "
                          "harmonic:C with C >= 0 and free have",
                          o->text[POTENTIAL]);
    if (status)
        return status;

    o->x0 = malloc(2 * o->d * sizeof *o->x0);
    if (!o->x0) {
        fvi_refuse(c, "no memory for the start");
        return 1;
    }
    o->p0 = o->x0 + o->d;
    status = fvi_word_list("x0", o->text[X0], o->d, o->x0, c);
    if (!status)
        status = fvi_word_list("p0", o->text[P0], o->d, o->p0, c);
    if (!status && o->command == FVI_COMMAND_EXACT && !o->caputo && o->rho > 0
        && o->alpha > 0.5 && o->x0[0] != 0)
        status = fvi_refuse(c, "--derivative: 'rl' has no solution for x0 != 0 "
                               "and alpha > 1/2; take caputo");
    if (status)
        fvi_options_free(o);
    return status;
}

static int interpret(fvi_options *o, fvi_complaint c)
{
    if (o->text[OUTPUT] && !*o->text[OUTPUT])
        return fvi_refuse(c, "-o: '' is not a file's name");
    o->output = o->text[OUTPUT];
    /* The weights go up to the order 2 alpha of the damping. */
    int only_weights = o->command == FVI_COMMAND_COEFFICIENTS;
    int status = number(o, ALPHA, 0, only_weights ? 2 : 1, "[]", &o->alpha, c);
    if (status)
        return status;
    return only_weights ? whole(o, COUNT, &o->count, c)
                        : interpret_trajectory(o, c);
}

/* ---- getopt ---- */

static int command_of(const char *name, fvi_command *command)
{
    static const char *const names[] = {
        "run", "coefficients", "exact", "methods", "--help", "--version"
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0) {
            *command = (fvi_command)i;
            return 1;
        }
    return 0;
}

/* One more option with its text. A long name must be written in full. */
static int take(fvi_options *o, int found, const char *given, fvi_complaint c)
{
    if (found == '?')
        return fvi_refuse(c, "%s: no such option", given);
    if (found == ':')
        return fvi_refuse(c, "%s: a value is missing", given);
    option_index i = (option_index)(found - 256);
    size_t length = strcspn(given, "=");
    if (i != OUTPUT
        && (length != strlen(table[i].name) + 2
            || strncmp(given + 2, table[i].name, length - 2) != 0))
        return fvi_refuse(c, "%s: no such option", given);
    if (!(table[i].commands & mask(o->command)))
        return fvi_refuse(c, "%s%s: not an option of this command",
                          i == OUTPUT ? "-" : "--", table[i].name);
    if (o->text[i] && strcmp(o->text[i], optarg) != 0)
        return fvi_refuse(c, "%s%s: given twice, as '%s' and as '%s'",
                          i == OUTPUT ? "-" : "--", table[i].name, o->text[i],
                          optarg);
    o->text[i] = optarg;
    return 0;
}

int fvi_options_parse(int argc, char **argv, fvi_options *o, char *text,
                      size_t size)
{
    fvi_complaint c = { text, size };
    *o = (fvi_options){ .about = FVI_COMMAND_HELP };
    if (argc < 2)
        return fvi_refuse(c, "a command is missing");
    if (!command_of(argv[1], &o->command))
        return fvi_refuse(c, "'%s' is not a command", argv[1]);

    struct option longs[OPTIONS + 1] = { { 0 } };
    for (int i = 0; i < OUTPUT; i++)
        longs[i] =
            (struct option){ table[i].name, required_argument, NULL, 256 + i };
    longs[OUTPUT] = (struct option){ "help", no_argument, NULL, 256 + OPTIONS };

    int left = argc - 1, status = 0;
    char **words = argv + 1;
    optind = 0; /* start afresh, whoever parsed before */
    opterr = 0;
    for (;;) {
        const char *given = words[optind ? optind : 1];
        int found = getopt_long(left, words, "+:o:", longs, NULL);
        if (found == -1)
            break;
        if (found == 256 + OPTIONS && strcmp(given, "--help") == 0) {
            o->about = o->command;
            o->command = FVI_COMMAND_HELP;
            return 0;
        }
        status = take(o,
                      found == 'o'             ? 256 + OUTPUT
                      : found == 256 + OPTIONS ? '?'
                                               : found,
                      given, c);
        if (status)
            return status;
    }
    if (optind < left)
        return fvi_refuse(c, "'%s': not expected here", words[optind]);
    const option_index instead = o->text[ERROR] ? ERROR : TIME;
    if (o->text[H] && o->text[instead])
        return fvi_refuse(c, "--h: not together with --%s",
                          table[instead].name);
    if (o->text[ERROR] && !o->text[TIME])
        o->text[TIME] = "20";
    for (int i = 0; i < OPTIONS; i++)
        if (!o->text[i] && !(i == H && o->text[TIME]))
            o->text[i] = table[i].preset;
    return mask(o->command) ? interpret(o, c) : 0;
}

void fvi_options_free(fvi_options *o)
{
    free(o->x0);
    o->x0 = o->p0 = NULL;
}

fvi_system fvi_options_system(const fvi_options *o, double *storage)
{
    fvi_system s = { .d = o->d, .mass = storage, .damping = storage + o->d };
    for (size_t i = 0; i < o->d; i++) {
        storage[i] = o->mass;
        storage[o->d + i] = o->rho;
    }
    switch (o->potential) {
    case 'h':
        s.potential = fvi_potential_harmonic(o->spring);
        break;
    case 'd':
        s.potential = fvi_potential_duffing(o->spring);
        break;
    case 'p':
        s.potential = fvi_potential_pendulum(o->spring);
        break;
    case 'c':
        s.potential = fvi_potential_chain(o->spring);
        break;
    default:
        break; /* free */
    }
    if (o->force == 's')
        s.force = fvi_force_step(o->forcing);
    else if (o->force == 'c')
        s.force = fvi_force_cosine(o->forcing);
    return s;
}
