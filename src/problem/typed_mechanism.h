/* src/problem/typed_mechanism.h -- Hold a mechanism that was parsed.      [H 29] */
#ifndef FVI_TYPED_MECHANISM_H
#define FVI_TYPED_MECHANISM_H

#include "words.h"

/* An expression. index is the coordinate on which a force acts, or which is imposed, from 1; 0 for an elongation or a
 * constraint. */
typedef struct {
    fvi_expression *e;
    size_t index;
} fvi_typed_expression;

typedef struct {
    char *name; /* NULL if it has no name */
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
    const char **name; /* texts of the constraints, which belong to the caller */
    size_t *imposed;   /* the coordinate that each constraint prescribes, from 1, or 0 */
    fvi_lagrangian L;
    fvi_constraints c;
    fvi_state_force F;
    fvi_mechanism all;
};

/* fvi_parse_damper -- Parse '[NAME=] G : LAW [: PAST]': name, law and past into *damper, and the text G into *of, which
 * the caller frees. The name must differ from those of the `count` dampers in `others`. Return a code as all parsers
 * do.
 * fvi_typed_damper_free -- Free what is in the damper. */
int fvi_parse_damper(const char *text, size_t count, const fvi_typed_damper *others,
                     fvi_user_parameters *parameters, fvi_typed_damper *damper, char **of,
                     fvi_error *error);
void fvi_typed_damper_free(fvi_typed_damper *damper);

/* fvi_text_value, fvi_text_slopes, fvi_text_hessian -- Evaluate an expression g(x, t), a fvi_typed_expression: compute
 * g; its derivatives by x and by t, of which either may be NULL; add factor times its second derivatives by x to H.
 * Return FVI_SUCCESS or FVI_ENOMEM.
 * fvi_elongation_of_text -- Return the elongation g with these functions. */
int fvi_text_value(double t, size_t d, const double *x, void *params, double *g);
int fvi_text_slopes(double t, size_t d, const double *x, const fvi_typed_expression *of, double *G, double *rate);
int fvi_text_hessian(double t, size_t d, const double *x, double factor, void *params, double *H);
fvi_elongation fvi_elongation_of_text(fvi_typed_expression *of);

/* fvi_mechanism_of_texts -- Fill in m->all from what has been parsed. */
void fvi_mechanism_of_texts(fvi_typed_mechanism *m);

#endif
