/* src/problem/typed_mechanism.h -- What the texts of a mechanism have become.      [H 29] */
#ifndef FVI_TYPED_MECHANISM_H
#define FVI_TYPED_MECHANISM_H

#include "words.h"

/* An expression, and the coordinate that it is for, from 1: that on which a force acts, or that which
 * is imposed; 0: an elongation or a constraint. */
typedef struct {
    fvi_expression *e;
    size_t index;
} fvi_typed_expression;

typedef struct {
    char *name; /* or NULL */
    fvi_typed_expression of;
    fvi_typed_damping law;
    fvi_initial_history past;
} fvi_typed_damper;

struct fvi_typed_mechanism {
    size_t d, dampers, constraints, forces;
    fvi_expression *lagrangian;
    fvi_typed_damper *typed;
    fvi_damper *damper;
    fvi_typed_expression *constraint, *force;
    const char **name; /* of the constraints: their texts, which are the caller's */
    size_t *imposed;   /* and which coordinate each prescribes, or 0 */
    fvi_lagrangian L;
    fvi_constraints c;
    fvi_state_force F;
    fvi_mechanism all;
};

/* fvi_parse_damper -- name, law and past of '[NAME=] G : LAW [: PAST]', and the text G in *of, which
 * the caller frees. Those of `others`, which have been parsed, have other names.
 * fvi_typed_damper_free -- give back what is in it. */
int fvi_parse_damper(const char *text, size_t count, const fvi_typed_damper *others,
                     fvi_user_parameters *parameters, fvi_typed_damper *damper, char **of,
                     fvi_error *error);
void fvi_typed_damper_free(fvi_typed_damper *damper);

/* fvi_text_value, _slopes, _hessian -- of an expression g(x, t), a fvi_typed_expression: g; its derivatives by x and by t,
 * of which either may be NULL; H += factor times its second ones by x. FVI_SUCCESS; FVI_ENOMEM.
 * fvi_elongation_of_text -- g of these functions. */
int fvi_text_value(double t, size_t d, const double *x, void *params, double *g);
int fvi_text_slopes(double t, size_t d, const double *x, const fvi_typed_expression *of, double *G, double *rate);
int fvi_text_hessian(double t, size_t d, const double *x, double factor, void *params, double *H);
fvi_elongation fvi_elongation_of_text(fvi_typed_expression *of);

/* fvi_mechanism_of_texts -- m->all of what has been parsed. */
void fvi_mechanism_of_texts(fvi_typed_mechanism *m);

#endif
