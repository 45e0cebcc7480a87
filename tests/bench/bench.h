/* tests/bench/bench.h -- A clock, and a description of the machine. [H 12, 18]
 *
 * Define _POSIX_C_SOURCE as 200809L before you include this file. */
#ifndef BENCH_H
#define BENCH_H

#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>

/* Return the processor time of this process in seconds. Other processes do not count. */
static inline double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Print the processor's name, if the kernel tells it, the compiler and its options. */
static inline void describe(void)
{
    char line[256] = "", *name = line;
    struct utsname u;
    FILE *cpu = fopen("/proc/cpuinfo", "r");
    while (cpu && fgets(line, sizeof line, cpu))
        if (strncmp(line, "model name", 10) == 0 && (name = strchr(line, ':')))
            break;
    if (cpu)
        fclose(cpu);
    name = name && *name ? name + 2 : line;
    name[strcspn(name, "\n")] = 0;
    printf("# machine: %s, %s; one core\n", name, uname(&u) ? "?" : u.machine);
#ifdef __clang__
    printf("# compiler: clang %s\n", __clang_version__);
#else
    printf("# compiler: gcc %s\n", __VERSION__);
#endif
#ifdef OPTIONS
    printf("# options, of all that runs: %s\n", OPTIONS);
#endif
}

#endif
