/* src/command_run/fvi_checkpoint_when.c -- Decide when a checkpoint is written, and how a signal ends a run. */
#define _GNU_SOURCE
#include "fvi_checkpoint.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

static volatile sig_atomic_t signal_number;
static const int ends[] = { SIGINT, SIGTERM, SIGHUP };
enum { ENDS = sizeof ends / sizeof *ends };
static struct sigaction before[ENDS];

static volatile sig_atomic_t in_rows; /* nonzero while the program writes rows */

static void restore_ends(void)
{
    for (size_t i = 0; i < ENDS; i++)
        sigaction(ends[i], &before[i], NULL);
}

/* Note the first signal; the run then ends at the end of its step, however long the step takes. A second signal ends
 * the program at once. */
static void store_signal(int number)
{
    signal_number = number;
    restore_ends();
    alarm(1);
}

/* A second after the first signal, and every second from then on, end the program if it is writing rows, because a
 * reader that does not read would keep it from its end. */
static void raise_again(int number)
{
    (void)number;
    if (in_rows)
        raise(signal_number);
    alarm(1);
}

void fvi_checkpoint_watch(void)
{
    for (size_t i = 0; i < ENDS; i++)
        sigaction(ends[i], NULL, &before[i]);
    signal(SIGALRM, raise_again);
    for (size_t i = 0; i < ENDS; i++)
        if (before[i].sa_handler != SIG_IGN)
            signal(ends[i], store_signal);
}

void fvi_checkpoint_in_rows(int now)
{
    in_rows = now;
}

int fvi_checkpoint_stopped(void)
{
    return signal_number != 0;
}

void fvi_checkpoint_unwatch(void)
{
    alarm(0);
    restore_ends();
}

void fvi_checkpoint_end(void)
{
    if (!signal_number)
        return;
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

int fvi_checkpoint_due(void)
{
    static double last = -1;
    struct timespec clock;
    clock_gettime(CLOCK_MONOTONIC, &clock);
    const double now = (double)clock.tv_sec + 1e-9 * (double)clock.tv_nsec;
    if (last < 0)
        last = now;
    if (now - last < 10)
        return 0;
    last = now;
    return 1;
}
