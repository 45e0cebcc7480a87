/* tests/random/fuzz/random_states.c -- Damage the state of a run and continue the run. */
#include "random_states.h"
#include "random_words.h"

#include <fvi/fvi.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { MOST_D = 20, MOST_STEPS = 300, PIECES = 200, ROOM = 1 << 20 };

static unsigned char state[ROOM];

/* The pieces of a state, one after the other. */
typedef struct {
    fvi_archive archive; /* the first member, so that a pointer to it is a pointer to the shelf */
    size_t at, pieces;
    size_t begin[PIECES], bytes[PIECES];
    int constant[PIECES];
} shelf;

static char said[200];

const char *random_state_words(void)
{
    return said;
}

static int save(fvi_archive *v, void *data, size_t bytes, int constant)
{
    shelf *s = (shelf *)v;
    if (bytes > ROOM - s->at || s->pieces == PIECES)
        return -1;
    if (bytes > 0)
        memcpy(state + s->at, data, bytes);
    s->begin[s->pieces] = s->at;
    s->bytes[s->pieces] = bytes;
    s->constant[s->pieces++] = constant;
    s->at += bytes;
    return 0;
}

/* Refuse a piece of another length, as the reader of a file does. */
static int load(fvi_archive *v, void *data, size_t bytes, int constant)
{
    shelf *s = (shelf *)v;
    if (s->pieces == PIECES || s->bytes[s->pieces] != bytes)
        return -2;
    const unsigned char *from = state + s->begin[s->pieces++];
    if (constant)
        return memcmp(data, from, bytes) == 0 ? 0 : -2;
    if (bytes > 0)
        memcpy(data, from, bytes);
    return 0;
}

/* ---- runs ---- */

typedef struct {
    double mass[MOST_D], rho[MOST_D], x0[MOST_D], p0[MOST_D], J[MOST_D];
    fvi_impulse impulses[2];
    fvi_system system;
    fvi_run run;
} problem;

static double number(void)
{
    return (double)dice(1000) / 250 - 2;
}

static void random_system_of(problem *o)
{
    static const double cg[] = { 1, 0.5 }, aw[] = { 1, 1.5 };
    static const double jumps[] = { 0.31, 0.9 };
    const fvi_potential potentials[] = { { 0 },
                                         fvi_potential_harmonic(cg),
                                         fvi_potential_duffing(cg),
                                         fvi_potential_pendulum(cg),
                                         fvi_potential_chain(cg) };
    static const size_t ds[] = { 1, 1, 2, 3, MOST_D };
    fvi_system *system = &o->system;
    *system = (fvi_system){ .d = ds[dice(LEN(ds))],
                            .mass = o->mass,
                            .damping = o->rho,
                            .potential = potentials[dice(LEN(potentials))] };
    for (size_t i = 0; i < MOST_D; i++) {
        o->mass[i] = i > 0 && dice(2) ? o->mass[i - 1] : 0.5 + (double)dice(3);
        o->rho[i] = dice(4) ? 0.25 * (double)dice(6) : 0;
        o->x0[i] = number();
        o->p0[i] = number();
        o->J[i] = number();
    }
    if (dice(2))
        system->force = fvi_force_cosine(aw);
    if (dice(3) == 0) {
        system->force.jumps = jumps;
        system->force.jump_count = LEN(jumps);
    }
    if (dice(4) == 0) {
        o->impulses[0] = (fvi_impulse){ 0.4, o->J };
        o->impulses[1] = (fvi_impulse){ 1.1, o->J };
        system->force.impulses = o->impulses;
        system->force.impulse_count = 2;
    }
}

static const fvi_method *random_run_of(problem *o)
{
    static const double alphas[] = { 0, 0.1, 0.3, 0.5, 0.7, 0.95, 1 };
    static const fvi_kernel_term terms[] = {
        { .kind = FVI_KERNEL_POWER, .alpha = 0.3, .rho = 0.5 }
    };
    static const fvi_kernel law = { LEN(terms), terms };
    size_t methods = 0;
    while (fvi_methods[methods])
        methods++;
    random_system_of(o);
    o->run = fvi_run_default(&o->system, o->x0, o->p0, 0.05,
                             1 + dice(dice(2) ? 20 : MOST_STEPS));
    o->run.alpha = alphas[dice(LEN(alphas))];
    o->run.kappa = (double)dice(3) / 2;
    o->run.memory = (fvi_history_kind)dice(4);
    o->run.past = dice(2) ? FVI_INITIAL_HISTORY_HELD : (fvi_initial_history)dice(3);
    o->run.law = dice(6) ? NULL : &law;
    static const double errors[] = { 0, 1e-2, 1e-5, 1e-12 };
    o->run.step_error = errors[dice(LEN(errors))];
    return dice(3) ? fvi_methods[dice(methods)] : &fvi_variable_step;
}

/* ---- damage ---- */

/* Change a double or a count: some of its bits, or the whole number. */
static void change_number(unsigned char *at, size_t bytes)
{
    static const double doubles[] = { 0,        -1,  1e308,     -1e308, 5e-324,
                                      INFINITY, NAN, -INFINITY, 1e-300, 0.31 };
    const size_t width = bytes % 8 == 0 ? 8 : 4,
                 place = dice(bytes / width) * width;
    uint64_t bits = 0;
    memcpy(&bits, at + place, width);
    switch (dice(4)) {
    case 0: /* a bit */
        bits ^= (uint64_t)1 << dice(8 * width);
        break;
    case 1: /* a small change */
        bits += dice(9) - (uint64_t)4;
        break;
    case 2: /* a number of any size */
        bits = ~(uint64_t)0 >> dice(64);
        break;
    default:
        memcpy(&bits, &doubles[dice(LEN(doubles))], sizeof bits);
    }
    memcpy(at + place, &bits, width);
}

/* Change some pieces that are not constant. Prefer the short ones, which hold counts. */
static void change_state(const shelf *all)
{
    size_t at[PIECES], n = 0;
    for (size_t i = 0; i < all->pieces; i++)
        if (!all->constant[i] && all->bytes[i] >= 4
            && (all->bytes[i] <= 8 || dice(4) == 0))
            at[n++] = i;
    for (size_t times = 1 + dice(3); n > 0 && times > 0; times--) {
        const size_t i = at[dice(n)];
        change_number(state + all->begin[i], all->bytes[i]);
    }
}

/* ---- a case ---- */

static void go_on(fvi_stepper *s, size_t most)
{
    double x[MOST_D], p[MOST_D];
    fvi_stepper *copy;
    fvi_stepper_advance_to(s, s->t, x, p);
    fvi_stepper_advance_to(s, s->t * 0.99, x, p);
    for (size_t n = 0; n < most && s->k < s->run.steps; n++)
        if (fvi_stepper_step(s))
            return;
    if (!fvi_stepper_copy(s, &copy)) {
        fvi_stepper_step(copy);
        fvi_stepper_free(copy);
    }
}

/* A stepper whose state was refused must be able to start anew. */
static const char *begin_anew(const problem *o, fvi_stepper *s)
{
    if (fvi_stepper_reset(s))
        return "no reset after a refusal";
    if (s->k != 0 || memcmp(s->x, o->x0, o->system.d * sizeof *s->x) != 0)
        return "reset to another start";
    go_on(s, 3);
    return NULL;
}

const char *random_state(size_t *refused)
{
    static problem o;
    static shelf all;
    fvi_stepper *s, *again;
    const fvi_method *method = random_run_of(&o);
    const size_t N = o.run.steps;
    snprintf(said, sizeof said, "%s, d = %zu, N = %zu, alpha = %g, memory %d",
             method->name, o.system.d, N, o.run.alpha, (int)o.run.memory);
    if (fvi_stepper_start(method, &o.run, &s, NULL))
        return NULL; /* the method does not take this run */
    for (size_t n = dice(N + 1); n > 0 && s->k < N; n--)
        if (fvi_stepper_step(s)) {
            fvi_stepper_free(s);
            return NULL;
        }
    all = (shelf){ .archive = { save } };
    int status = fvi_stepper_archive(s, &all.archive);
    fvi_stepper_free(s);
    if (status || fvi_stepper_start(method, &o.run, &again, NULL))
        return "not saved";
    all.archive.serialize = load;
    all.pieces = 0;
    const char *wrong = fvi_stepper_archive(again, &all.archive) ? "not loaded" : NULL;
    change_state(&all);
    all.pieces = 0;
    status = wrong ? 0 : fvi_stepper_archive(again, &all.archive);
    if (status && status != FVI_EINVAL && status != FVI_ESING && status != -2)
        wrong = "refused with another code";
    *refused += status != 0;
    if (!wrong && !status)
        go_on(again, 60);
    else if (!wrong)
        wrong = begin_anew(&o, again);
    fvi_stepper_free(again);
    return wrong;
}
