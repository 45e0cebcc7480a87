/* chapters/live/building.c -- H 27: five storeys on isolators, as the figure that moves asks for them.
 *
 * The building, the ground and the method are those of figures/structures/structures_isolators.c. It is a module of
 * its own: no other figure needs structures. */
#include "matrices/structure.h"

#include <fvi/convolution_quadrature_methods.h>
#include <fvi/error.h>
#include <math.h>
#include <stdlib.h>

#define exit(code) __builtin_trap() /* a page has no process that could end */

enum { STEPS = 4000 };

static const double h = 0.005;

#include "../../figures/structures/frame.h"
#include "../../figures/structures/isolators.h"

#define EXPORT(name) __attribute__((export_name(#name))) name

/* The places of the floors from the slab to the roof, against the ground, at each step; then the
 * acceleration of the ground; then that of the roof, the mean over each step, with the ground's. */
enum { GROUND = FLOORS, ROOF, ARRAYS };

static double arrays[ARRAYS][STEPS + 2];

double *EXPORT(live_array)(int which)
{
    return arrays[which];
}

/* A page shows no words of an error, and has no printf. */
int fvi_fail(fvi_error *error, int code, const char *field, double value,
             const char *format, ...)
{
    (void)error, (void)field, (void)value, (void)format;
    return code;
}

/* A chain of floors is a band: CHOLMOD is not asked, and no matrix is complex. */
void fvi_cholmod_free(fvi_cholmod *c)
{
    (void)c;
}

void fvi_structure_add_complex(fvi_structure *s)
{
    (void)s;
}

/* A wind of 0.1 on each floor. */
static int wind(double t, size_t d, void *params, double *F)
{
    (void)t, (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = 0.1;
    return FVI_SUCCESS;
}

/* `STEPS` steps of a building with isolators of that alpha, 0 without: in an earthquake of 20 seconds, or
 * in a wind that blows from t = 0 to 200. Array ROOF is that of the earthquake alone. Returns the stiffness
 * of the isolators' spring. */
double EXPORT(live_building)(double alpha, int is_wind)
{
    static const double rest[FLOORS];
    double *ground = arrays[GROUND], *roof = arrays[ROOF];
    static int is_shaken;
    building b;
    fvi_stepper *s;
    if (!is_shaken) /* the noise goes on from call to call */
        shake(ground);
    is_shaken = 1;
    build(alpha, &b);
    fvi_system system = fvi_structure_system(b.structure);
    system.force = is_wind ? (fvi_force){ .value = wind } : (fvi_force){ .value = load, .params = ground };
    const fvi_run r = fvi_run_default(&system, rest, rest, is_wind ? 10 * h : h, STEPS);
    fail(fvi_stepper_start(&fvi_cq2_midpoint, &r, &s, NULL));
    for (double before = 0;;) {
        for (int i = 0; i < FLOORS; i++)
            arrays[i][s->k] = s->x[i];
        if (s->k > 0 && !is_wind)
            roof[s->k - 1] = (s->p[FLOORS - 1] - before) / h + (ground[s->k] + ground[s->k - 1]) / 2;
        if (s->k == STEPS)
            break;
        before = s->p[FLOORS - 1];
        fail(fvi_stepper_step(s));
    }
    fvi_stepper_free(s);
    demolish(&b);
    return b.below;
}
