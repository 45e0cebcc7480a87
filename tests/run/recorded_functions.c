/* tests/run/recorded_functions.c -- The functions of one C library, for a run by another.
 *
 * A shared library for LD_PRELOAD. With FVI_RECORD=FILE each call of exp, pow and so on
 * is written to FILE. With FVI_REPLAY=FILE the next program must make the same calls; its
 * own functions must agree with those of FILE as far as two libraries agree; and it gets
 * the values of FILE. So a run by other functions of libm must be equal to the bit.
 *
 * The most that two libraries may differ by: a function that is off by less than E units
 * of the last place finds one of the 2 E doubles around its value, and two of those are
 * 2 E - 1 apart at most. E is that of glibc's manual, "Known Maximum Errors in Math
 * Functions", for x86_64. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    char name[8];
    double x, y, value;
} call;

static FILE *written, *read_from;

static void stop(const char *message, const call *own, const call *recorded)
{
    fprintf(stderr, "%s: %s(%a, %a) = %a; recorded: %s(%a, %a) = %a\n", message,
            own->name, own->x, own->y, own->value, recorded->name, recorded->x,
            recorded->y, recorded->value);
    _Exit(3);
}

__attribute__((constructor)) static void open_files(void)
{
    const char *record = getenv("FVI_RECORD"), *replay = getenv("FVI_REPLAY");
    written = record ? fopen(record, "wb") : NULL;
    read_from = replay ? fopen(replay, "rb") : NULL;
    if (!written && !read_from) {
        fputs("recorded_functions: no file in FVI_RECORD or FVI_REPLAY\n", stderr);
        _Exit(3);
    }
}

/* A program that makes fewer calls than were recorded is not the same one. */
__attribute__((destructor)) static void close_files(void)
{
    call left;
    if (read_from && fread(&left, sizeof left, 1, read_from) == 1)
        stop("fewer calls than recorded", &left, &left);
    if (written && fclose(written)) {
        fputs("recorded_functions: the calls cannot be written\n", stderr);
        _Exit(3);
    }
}

/* How many doubles apart; the largest number for another sign or a NaN. */
static uint64_t doubles_apart(double a, double b)
{
    int64_t i, j;
    if (memcmp(&a, &b, sizeof a) == 0)
        return 0;
    if (!(signbit(a) == signbit(b)) || isnan(a) || isnan(b))
        return UINT64_MAX;
    memcpy(&i, &a, sizeof i);
    memcpy(&j, &b, sizeof j);
    return (uint64_t)(i > j ? i - j : j - i);
}

static double take(const char *name, double x, double y, double value,
                   unsigned units)
{
    call own = { .x = x, .y = y, .value = value }, recorded = { .x = 0 };
    strcpy(own.name, name);
    if (written)
        fwrite(&own, sizeof own, 1, written);
    if (!read_from)
        return value;
    if (fread(&recorded, sizeof recorded, 1, read_from) != 1)
        stop("more calls than recorded", &own, &recorded);
    if (strcmp(own.name, recorded.name) != 0 || doubles_apart(own.x, recorded.x)
        || doubles_apart(own.y, recorded.y))
        stop("another call than recorded", &own, &recorded);
    if (doubles_apart(own.value, recorded.value) > 2 * units - 1)
        stop("too far from the recorded value", &own, &recorded);
    return recorded.value;
}

static void *find(const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    if (!found) {
        fprintf(stderr, "recorded_functions: no %s\n", name);
        _Exit(3);
    }
    return found;
}

#define OF_ONE(f, units)                                                       \
    double f(double x)                                                         \
    {                                                                          \
        static double (*own)(double);                                          \
        if (!own)                                                              \
            *(void **)&own = find(#f);                                         \
        return take(#f, x, 0, own(x), units);                                  \
    }
OF_ONE(exp, 1)
OF_ONE(expm1, 1)
OF_ONE(log, 1)
OF_ONE(log1p, 1)
OF_ONE(sin, 1)
OF_ONE(cos, 1)
OF_ONE(tgamma, 10)

double pow(double x, double y)
{
    static double (*own)(double, double);
    if (!own)
        *(void **)&own = find("pow");
    return take("pow", x, y, own(x, y), 1);
}

/* What a compiler makes of a sine and a cosine of the same number. */
void sincos(double x, double *sine, double *cosine)
{
    *sine = sin(x);
    *cosine = cos(x);
}
