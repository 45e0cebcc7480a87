/* src/command_sweep/sweep_grid.c -- Read the options of a sweep, and build its runs. */
#include "sweep_grid.h"
#include "input/fvi_problem_words.h"
#include "options/fvi_option_columns.h"
#include "options/fvi_options.h"
#include <fvi/format_double.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

double sweep_grid_value(const sweep_grid *g, size_t i, size_t n)
{
    for (size_t m = g->count - 1; m > n; m--)
        i /= g->axis[m].range.count;
    const fvi_range *a = &g->axis[n].range;
    return fvi_range_value(a, i % a->count);
}

int sweep_grid_has(const sweep_grid *g, const char *name)
{
    for (size_t n = 0; n < g->count; n++)
        if (strcmp(g->axis[n].name, name) == 0)
            return 1;
    return 0;
}

/* "fvi run" and the varied options are put in front of the other words. So if the last word has no value, the parser
 * does not take a varied option for it. */
enum { AHEAD = 2 + FVI_MOST_AXES };

int sweep_grid_options(const sweep_grid *g, size_t i, fvi_options *o,
                       fvi_error *c)
{
    /* The words are static, because o keeps pointers to them. */
    static char fvi[] = "fvi", run[] = "run", word[FVI_MOST_AXES][140];
    char value[32];
    char **words = g->words + (FVI_MOST_AXES - g->count);
    words[0] = fvi;
    words[1] = run;
    for (size_t n = 0; n < g->count; n++) {
        fvi_format_double(sweep_grid_value(g, i, n), value);
        snprintf(word[n], sizeof word[n],
                 g->axis[n].is_let ? "--let=%s=%s" : "--%s=%s", g->axis[n].name,
                 value);
        words[2 + n] = word[n];
    }
    return fvi_options_parse(2 + (int)g->count + g->word_count, words, o, c);
}

/* ---- words ---- */

/* The options that a sweep can vary. It can also vary the parameters of expressions. */
static const char *const numbers[] = {
    "alpha", "order", "rho",  "mass",  "kappa",      "x0",        "p0", "v0", "h",
    "steps", "time", "error", "step-error", "longest",
    "tolerance", NULL
};

static int is_option(const char *name)
{
    for (int i = 0; i < OPTIONS; i++)
        if (strcmp(fvi_option_list[i].name, name) == 0)
            return 1;
    return 0;
}

/* Add an axis. */
static int parse_axis(sweep_grid *g, const char *text, fvi_error *c)
{
    static const char shape[] = "NAME=A:B:N, NAME=A:B:N:log or NAME=V1,V2,...";
    const char *equals = strchr(text, '=');
    const size_t length = equals ? (size_t)(equals - text) : 0,
                 end = strlen(g->text);
    fvi_axis *a = &g->axis[g->count];
    if (g->count == FVI_MOST_AXES)
        return fvi_refuse(c, "vary", "'%s': at most %d are varied", text, FVI_MOST_AXES);
    if (length == 0 || length >= sizeof a->name)
        return fvi_refuse(c, "vary", "'%s' is not %s", text, shape);
    memcpy(a->name, text, length);
    a->name[length] = '\0';
    a->is_let = !fvi_is_one_of(a->name, numbers);
    if (sweep_grid_has(g, a->name))
        return fvi_refuse(c, "vary", "'%s' is varied twice", a->name);
    if (a->is_let
        && (is_option(a->name) || !fvi_symbol_is_free(a->name, "x")
            || !fvi_symbol_is_free(a->name, "t")))
        return fvi_refuse(c, "vary", "'%s' is not a number that can be varied", a->name);
    g->count++;
    if (!equals[1])
        return fvi_refuse(c, "vary", "'%s' is not %s", text, shape);
    const int status = fvi_word_range("vary", shape, text, equals + 1, -INFINITY, &a->range, c);
    if (status)
        return status;
    snprintf(g->text + end, sizeof g->text - end, "%s%s", end ? "," : "", text);
    return 0;
}

static int parse_part(sweep_grid *g, const char *text, fvi_error *c)
{
    char first[32] = "", rest[32] = "";
    int used = 0;
    if (sscanf(text, "%31[^/]/%31[^/]%n", first, rest, &used) != 2
        || text[used])
        return fvi_refuse(c, "part", "'%s' is not I/K", text);
    int status = fvi_parse_whole("part", rest, 1000000, &g->parts, c);
    if (!status)
        status = fvi_parse_whole("part", first, g->parts, &g->part, c);
    snprintf(g->part_text, sizeof g->part_text, "%s", text);
    return status;
}

/* The options of a sweep that are given at most once, in this order. */
enum { JOBS, LANES_TOGETHER, PART, ONCE };
static const char *const once[ONCE] = { "jobs", "lanes", "part" };

/* Take the value of such an option. *text is its earlier value, or NULL. */
static int parse_once(sweep_grid *g, int which, const char *value,
                      const char **text, fvi_error *c)
{
    const int status =
        fvi_word_once("--", once[which], text, value, c);
    return status          ? status
           : which == JOBS ? fvi_parse_whole("jobs", value, 1024, &g->jobs, c)
           : which == PART ? parse_part(g, value, c)
                           : fvi_parse_whole("lanes", value, 8, &g->lanes, c);
}

/* Refuse a word that is no option of `fvi run`, but near an option of a sweep. Also refuse options of `fvi run` that a
 * sweep does not have. */
static int check_word(const char *word, fvi_error *c)
{
    static const char *const names[] = { "vary", "jobs", "lanes", "part", "rows", NULL };
    const option_index i = fvi_option_named(word);
    if (i == PLOT || i == SNAPSHOT || i == CHECKPOINT || i == CONTINUE)
        return fvi_refuse(c, fvi_option_list[i].name, "not an option of this command");
    if (strncmp(word, "--", 2) != 0 || i < OPTIONS
        || !fvi_nearest_word(word + 2, strcspn(word + 2, "="), names))
        return 0;
    return fvi_refuse_option(c, word, names);
}

/* Sort the words: read those of a sweep, and keep those of `fvi run`. */
static int sort_words(sweep_grid *g, int argc, char **argv, fvi_error *c)
{
    const char *texts[ONCE] = { NULL };
    int every = 0;
    for (int i = 2; i < argc; i++) {
        if (strcmp(argv[i], "--rows") == 0) {
            g->has_rows = 1;
            continue;
        }
        every = every || fvi_option_named(argv[i]) == EVERY;
        const char *value, *given = argv[i];
        int status = 0;
        const int vary = fvi_option_with_value(argv, &i, "vary", &value);
        int which = vary ? ONCE : 0;
        while (which < ONCE && !fvi_option_with_value(argv, &i, once[which], &value))
            which++;
        if (vary || which < ONCE)
            status = strchr(given, '=') ? 0 : fvi_value_is_missing(given, value, c);
        if (status)
            return status;
        if (vary)
            status = parse_axis(g, value, c);
        else if (which < ONCE)
            status = parse_once(g, which, value, &texts[which], c);
        else {
            status = check_word(argv[i], c);
            g->words[AHEAD + g->word_count++] = argv[i];
        }
        int at = i;
        if (!vary && which == ONCE && fvi_option_with_value(argv, &at, "let", &value)
            && value) {
            const size_t end = strlen(g->lets);
            snprintf(g->lets + end, sizeof g->lets - end, "%s%s",
                     end ? "," : "", value);
        }
        if (status)
            return status;
    }
    return every && !g->has_rows
               ? fvi_refuse(c, "every", "without --rows a run has one row")
               : 0;
}

/* Compute the points of each range once, because the search for decimal numbers is slow and would be repeated for each
 * run. */
static int list_ranges(sweep_grid *g)
{
    enum { MANY = 1000000 };
    for (size_t n = 0; n < g->count; n++) {
        fvi_range *a = &g->axis[n].range;
        if (a->list || a->count > MANY)
            continue;
        double *list = malloc(a->count * sizeof *list);
        if (!list)
            return FVI_ENOMEM;
        for (size_t i = 0; i < a->count; i++)
            list[i] = fvi_range_value(a, i);
        a->list = list;
    }
    return FVI_SUCCESS;
}

int sweep_grid_parse(int argc, char **argv, sweep_grid *g, fvi_error *c)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    double all = 1;
    *g = (sweep_grid){ .part = 1,
                     .parts = 1,
                     .jobs = cores > 0 ? (size_t)cores : 1 };
    g->words = calloc(AHEAD + (size_t)argc, sizeof *g->words);
    if (!g->words) {
        return fvi_no_memory(c, NULL);
    }
    int status = sort_words(g, argc, argv, c);
    if (status)
        return status;
    if (g->count == 0)
        return fvi_refuse(c, NULL, "sweep: --vary NAME=A:B:N is missing");
    for (size_t n = 0; n < g->count; n++)
        all *= (double)g->axis[n].range.count;
    if (all > 1e9)
        return fvi_refuse(c, "vary", "%g runs are too many", all);
    /* Part I has the runs from (I - 1) R / K to I R / K. It has none if there are more parts than runs. */
    const size_t runs = (size_t)all;
    g->first = (g->part - 1) * runs / g->parts;
    g->runs = g->part * runs / g->parts - g->first;
    return list_ranges(g) ? fvi_no_memory(c, NULL) : 0;
}

int sweep_grid_check(const sweep_grid *g, fvi_error *c)
{
    for (size_t n = 0; n < g->count; n++) {
        const char *name = g->axis[n].name;
        char place[64];
        int found = 0;
        for (int i = 0; i < g->word_count; i++)
            found = found || fvi_text_speaks_of(g->words[AHEAD + i], name);
        if (g->axis[n].is_let && !found)
            return fvi_refuse(c, "vary", "'%s' is no option that can be varied, and in no expression%s", name,
                              fvi_word_hint(name, strlen(name), numbers, place));
    }
    return 0;
}

void sweep_grid_free(sweep_grid *g)
{
    for (size_t n = 0; n < g->count; n++)
        free(g->axis[n].range.list);
    free(g->words);
}
