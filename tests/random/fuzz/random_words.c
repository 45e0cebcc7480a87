/* tests/random/fuzz/random_words.c -- Random command lines for build/fvi. */
#include "random_words.h"

#include "system/seeded.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* ---- dice ---- */

static uint64_t state;

size_t dice(size_t n)
{
    return (size_t)(fvi_seeded_next(&state) >> 33) % n;
}

void seed(unsigned long long s, size_t n)
{
    state = s * 0x9e3779b97f4a7c15ULL + n * 0xd1342543de82ef95ULL;
    dice(1);
    dice(1);
}

const char *one_of(const char *const *list, size_t n)
{
    return list[dice(n)];
}

/* ---- words ---- */

char words[WORDS][WORD];
int count;

void add(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (count < WORDS)
        vsnprintf(words[count++], WORD, format, arguments);
    va_end(arguments);
}

void spoil(char *word)
{
    static const char *const bits[] = {
        "-", ",", ":",  "(",    ")",   "^",     "*",   "e", ".", "x", "'", "=",
        "@", "%", "\n", "\xff", "nan", "1e999", " + ", "t", "k", "/", "#", "\t"
    };
    for (size_t times = 1 + dice(3); times > 0; times--) {
        const size_t length = strlen(word), at = dice(length + 1);
        const char *bit = ONE_OF(bits);
        if (dice(3) == 0 && at < length)
            memmove(word + at, word + at + 1, length - at);
        else if (length + strlen(bit) + 1 < WORD) {
            memmove(word + at + strlen(bit), word + at, length - at + 1);
            memcpy(word + at, bit, strlen(bit));
        }
    }
}

/* Append a random expression, which is mostly a right one, to the word. */
static void expression(char *word, const char *const *names, size_t depth)
{
    static const char *const functions[] = { "sin",  "cos",  "tan",  "exp",
                                             "log",  "sqrt", "tanh", "abs",
                                             "asin", "cosh", "sine" };
    static const char *const numbers[] = { "1",    "2",  "0.5", ".25",
                                           "3e-1", "pi", "0" };
    const size_t used = strlen(word), room = WORD - used;
    char *end = word + used;
    if (depth == 0 || room < 40) {
        snprintf(end, room, "%s", dice(2) ? names[dice(4)] : ONE_OF(numbers));
        return;
    }
    const size_t kind = dice(6);
    snprintf(end, room, "%s",
             kind == 0   ? ONE_OF(functions)
             : kind == 1 ? "-"
                         : "");
    strcat(word, "(");
    expression(word, names, depth - 1);
    strcat(word, ")");
    if (kind > 2 && strlen(word) + 40 < WORD) {
        static const char *const signs[] = { "+",  "-",   "*",   "/", "^",
                                             "**", " - ", "^2*", "" };
        strcat(word, ONE_OF(signs));
        expression(word, names, depth - 1);
    }
}

static void number(char *word)
{
    static const char *const good[] = { "0.5", "0.3", "1", "0.75", "1e-3" };
    static const char *const numbers[] = {
        "0",     "-1",     "2",      "1e300", "nan",   "inf",      "",  "1,2",
        "1,2,3", "1e-310", "0x1p-1", "@list", "@data", "@nowhere", "-0"
    };
    snprintf(word, WORD, "%s", dice(3) ? ONE_OF(good) : ONE_OF(numbers));
}

const char *few(void)
{
    static const char *const counts[] = { "1",   "2",   "7", "50",   "300", "0",
                                          "2.5", "1e1", "x", "1e18", "-3" };
    return ONE_OF(counts);
}

static void potential(char *word)
{
    static const char *const names[] = { "x", "x", "x1", "k" };
    static const char *const known[] = {
        "harmonic:1",  "harmonic",    "duffing:1,2", "pendulum:9", "free",
        "chain:3,1,1", "chain:1,1,0", "chain:2,1",   "HARMONIC",   "duffing:1"
    };
    *word = '\0';
    if (dice(2))
        strcpy(word, ONE_OF(known));
    else
        expression(word, names, 1 + dice(4));
}

static void force(char *word)
{
    static const char *const names[] = { "t", "t", "k", "x" };
    static const char *const known[] = {
        "none",        "step:1,2",    "cosine:1,2", "file:data",
        "file:list",   "file:",       "step:1",     "file:nowhere",
        "impulse:1,2", "impulse:3,0", "impulse:1"
    };
    *word = '\0';
    for (size_t parts = 1 + dice(3); parts > 0 && strlen(word) < 200; parts--) {
        if (dice(2))
            strcat(word, ONE_OF(known));
        else
            expression(word, names, dice(3));
        if (parts > 1)
            strcat(word, " + ");
    }
}

static void method(char *word)
{
    static const char *const known[] = {
        "fvi",          "lda",          "euler-explicit", "euler-implicit",
        "fvi-shifted",  "fvi-bdf2",     "fvi-lobatto2",   "fvi-lobatto3",
        "fvi-lobatto4", "fvi-adaptive", "fvi-stable",     "rk4"
    };
    strcpy(word, ONE_OF(known));
}

static void columns(char *word)
{
    static const char *const known[] = { "t",      "x",    "p",
                                         "energy", "y",    "t,x,p,energy",
                                         "x,y",    "t,,x", "q" };
    strcpy(word, ONE_OF(known));
}

static void let(char *word)
{
    static const char *const known[] = {
        "k=1", "k=2,c=k*k", "c=1/0", "x=1", "k", "k=", "=1", "k=1,k=1"
    };
    strcpy(word, ONE_OF(known));
}

static void small(const char *option, char *word)
{
    static const struct {
        const char *option, *words[5];
    } known[] = { { "memory", { "auto", "direct", "exponentials" } },
                  { "derivative", { "held", "caputo", "rl" } },
                  { "format", { "tsv", "csv", "json", "JSON" } },
                  { "checkpoint", { "saved" } },
                  { "part", { "1/2", "2/2", "3/2" } },
                  { "vary", { "x0=1:2:3", "alpha=0:1:2", "k=1:4:3:log" } },
                  { "of", { "x", "p", "energy", "x:1" } },
                  { "jobs", { "1", "3" } },
                  { "lanes", { "1", "8" } },
                  { "damping",
                    { "zener:1,0.3,0.1", "maxwell:1,2", "power:1,0.3",
                      "distributed:1,0,1" } },
                  { "error", { "0.1", "1e-3" } } };
    strcpy(word, "1");
    for (size_t i = 0; i < LEN(known); i++)
        if (strcmp(known[i].option, option) == 0) {
            size_t n = 0;
            while (known[i].words[n])
                n++;
            strcpy(word, known[i].words[dice(n)]);
        }
}

static void option(void)
{
    static const char *const numeric[] = { "alpha", "rho",       "mass",
                                           "kappa", "x0",        "p0",
                                           "h",     "tolerance", "time" };
    static const char *const counted[] = { "every", "dimension" };
    static const char *const others[] = { "memory", "derivative", "format" };
    static const char *const rare[] = { "checkpoint", "part",    "vary",
                                        "of",         "damping", "jobs",
                                        "error",      "fit",     "count" };
    static const struct {
        const char *name;
        void (*value)(char *);
    } made[] = { { "potential", potential },
                 { "force", force },
                 { "method", method },
                 { "columns", columns },
                 { "let", let },
                 { "potential", potential } };
    char value[WORD] = "";
    const char *name;
    const size_t kind = dice(10), one = dice(LEN(made));
    if (kind < 4) {
        name = ONE_OF(numeric);
        number(value);
    } else if (kind < 5) {
        add("--%s", ONE_OF(counted));
        add("%s", few());
        return;
    } else if (kind < 8) {
        name = made[one].name;
        made[one].value(value);
    } else {
        name = dice(5) ? ONE_OF(others) : ONE_OF(rare);
        small(name, value);
    }
    if (dice(12) == 0)
        spoil(value);
    if (dice(4)) {
        add("--%s", name);
        if (dice(40))
            add("%s", value);
    } else {
        add("--%.20s=%.370s", name, value);
    }
}

/* ---- a line ---- */

void random_line(void)
{
    static const char *const commands[] = { "run",   "run",      "run",
                                            "exact", "sweep",    "gradient",
                                            "poles", "response" };
    static const char *const grids[] = { "1", "0.1:10:4:log", "0.5,2", "1:2",
                                         "0", "1e300:1e308:3", "1e-300" };
    static const char *const kinds[] = { "receptance", "mobility", "ground",
                                         "accelerance", "moduli", "m" };
    static const char *const rare[] = { "coefficients", "methods", "help",
                                        "--version",    "rum",     "" };
    const char *command = dice(12) ? ONE_OF(commands) : ONE_OF(rare);
    add("fvi");
    add("%s", command);
    if (strcmp(command, "sweep") == 0 && dice(9)) {
        add("--vary");
        add("%s", dice(2) ? "x0=1:2:3" : "k=1:4:3:log");
    } else if (dice(2)) {
        add("--let=k=2");
    }
    for (size_t n = dice(5); n > 0; n--)
        option();
    const int is_linear =
        strcmp(command, "poles") == 0 || strcmp(command, "response") == 0;
    if (strcmp(command, "response") == 0 && dice(9)) {
        add("--omega=%s", ONE_OF(grids));
        add("--of=%s", ONE_OF(kinds));
    }
    if (is_linear && dice(3) == 0)
        add(*command == 'p' ? "--shapes" : "--hertz");
    if (is_linear ? dice(40) == 0 : dice(40))
        add("--steps=%s", dice(9) ? "20" : few());
    if (dice(20) == 0)
        add("%s", dice(2) ? "-h" : "--continue");
    if (dice(4) == 0) {
        add("-o");
        add("out");
    }
    if (dice(30) == 0)
        spoil(words[dice((size_t)count)]);
}
