/* tests/lagrangian/problems.h -- The problems of H 29 as they are typed. */
#ifndef PROBLEMS_H
#define PROBLEMS_H

#include "mechanisms.h"

/* Texts of mechanisms with forces that know the velocity. */
#define FRICTION                                                               \
    { .name = "friction",                                                      \
      .d = 1,                                                                  \
      .lagrangian = "v^2/2-x^2/2",                                             \
      .damper = { "x : power:0.2,0.3" },                                       \
      .force_on = { "1=-0.3*tanh(v/0.1)+0.5*sin(1.3*t)" },                     \
      .x0 = { 1 },                                                             \
      .v0 = { 0.1 } }
#define DRAG                                                                   \
    { .name = "drag",                                                          \
      .d = 2,                                                                  \
      .lagrangian = "3*v1^2/2 + v1*v2*cos(x2) + v2^2/2 + cos(x2) - x1^2/2",    \
      .damper = { "x1 : power:0.3,0.3" },                                      \
      .force_on = { "1=-0.2*v1*sqrt(v1^2+0.01)", "2=0.2*v2" },                 \
      .x0 = { 0.2, 1.2 },                                                      \
      .v0 = { 0, 0.5 } }

enum { ELASTIC, CART, TWIN, VAN_DER_POL, MATHIEU, ROD, PULLED, PROBLEMS };

/* sin 1.2 and cos 1.2: the rod stands at the angle 1.2 and turns with 1/2. */
#define SIN 0.93203908596722634967
#define COS 0.36235775447667357764

static const mechanism_text problems[PROBLEMS] = {
    [ELASTIC] = { .name = "elastic pendulum",
                  .d = 2,
                  .lagrangian = "(v1^2+v2^2)/2 - 2*(sqrt(x1^2+x2^2)-1)^2 - x2",
                  .damper = { "sqrt(x1^2+x2^2) : power:0.4,0.3" },
                  .x0 = { 1.2, 0 },
                  .v0 = { 0.3, 0.8 } },
    [CART] = { .name = "cart with a pendulum",
               .d = 2,
               .lagrangian = "3*v1^2/2 + v1*v2*cos(x2) + v2^2/2 + cos(x2) - x1^2/2",
               .damper = { "x1 : power:0.3,0.3", "x2 : viscous:0.1" },
               .x0 = { 0.2, 1.2 },
               .v0 = { 0, 0.5 } },
    [TWIN] = { .name = "double pendulum",
               .d = 2,
               .lagrangian = "v1^2 + v2^2/2 + v1*v2*cos(x1-x2) + 2*cos(x1) + cos(x2)",
               .damper = { "x1 : power:0.2,0.3", "x2-x1 : power:0.3,0.25" },
               .x0 = { 1, 1.5 },
               .v0 = { 0, 0.5 } },
    [VAN_DER_POL] = { .name = "van der Pol",
                      .d = 1,
                      .lagrangian = "v^2/2 - x^2/2",
                      .damper = { "x : power:0.3,0.3" },
                      .force_on = { "1=(1-x^2)*v" },
                      .x0 = { 0.5 },
                      .v0 = { 0.4 } },
    [MATHIEU] = { .name = "Mathieu and Duffing",
                  .d = 1,
                  .lagrangian = "v1^2/2 - (1+0.5*cos(2*t))*x1^2/2 - x1^4/4",
                  .damper = { "x1 : power:0.2,0.3" },
                  .x0 = { 0.5 },
                  .v0 = { 0.3 } },
    [ROD] = { .name = "pendulum on a rod, with a strut",
              .d = 2,
              .lagrangian = "(v1^2+v2^2)/2 - x2",
              .damper = { "sqrt((x1-1.5)^2+x2^2) : power:0.4,0.3" },
              .constraint = { "(x1^2+x2^2-1)/2" },
              .x0 = { SIN, -COS },
              .v0 = { 0.5 * COS, 0.5 * SIN } },
    /* laws above the order 1, and a start with a velocity along the damper */
    [PULLED] = { .name = "pulled",
                 .d = 2,
                 .lagrangian = "(v1^2+v2^2)/2 - (x1^2+x2^2)^2/4",
                 .damper = { "sqrt(x1^2+x2^2) : distributed:0.4,0.2,0.8 + power:0.1,0.7",
                             "x2 : power:0.2,0.7" },
                 .x0 = { 1.2, 0 },
                 .v0 = { 0.3, 0.8 } },
};

#endif
