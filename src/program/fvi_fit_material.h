/* src/program/fvi_fit_material.h -- `fvi fit --moduli`, `--creep`, `--relaxation`. */
#ifndef FVI_FIT_MATERIAL_H
#define FVI_FIT_MATERIAL_H

/* fvi_fit_is_material -- does one of the three words stand there? */
int fvi_fit_is_material(int argc, char **argv);

/* fvi_fit_material -- the law of a material from its tables, as fvi_command_fit. */
int fvi_fit_material(int argc, char **argv);

#endif
