/* chapters/live/pendulum.c -- H 29: stage 13 of the Course's program, as the figure that moves asks for it. */
__attribute__((unused)) static int body_main(void); /* so that nothing is printed here */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_13.c"
#undef main

#define EXPORT(name) __attribute__((export_name(#name))) name

double *live_array(int which);

/* N steps of h from the place and the velocity in array 0, four numbers, with one damper along the
 * spring or one along each axis. Arrays 0 and 1 become the path, 2 the energy, 3 the angular momentum. */
void EXPORT(live_pendulum)(double order, double strength, int is_strut, int N)
{
    alpha = order;
    rho = strength;
    strut = is_strut;
    for (int i = 0; i < DIM; i++) {
        x0[i] = live_array(0)[i];
        p0[i] = live_array(0)[DIM + i];
    }
    run(N);
    for (int k = 0; k <= N; k++) {
        live_array(0)[k] = x[k][0];
        live_array(1)[k] = x[k][1];
        live_array(2)[k] = energy(k);
        live_array(3)[k] = turning(k);
    }
}
