/* src/fvi/parse.h -- Problems as they are typed: potentials, forces, dampings, starts.
 *
 *     fvi_typed_potential U = { 0 };
 *     if (fvi_parse_potential("duffing:1,0.5", 0, NULL, &U, &error) == FVI_SUCCESS)
 *         system.potential = fvi_potential_typed(&U);
 *
 * One parser serves the program, C and Python. A word is followed by its numbers, "zener:1,0.3,2";
 * capitals count as small letters in words, and the point is '.' under every locale. Every function
 * returns FVI_SUCCESS; FVI_EINVAL for a text that is not understood; FVI_EDOM for a number that is
 * out of its range; FVI_ENOMEM; FVI_EFAULT if a pointer that must be there is NULL; and says in
 * *error, which may be NULL, what is wrong, with the nearest known word where a slip of the finger
 * leads to one. The fields are the words of the program: "potential", "force", "damping", "let". */
#ifndef FVI_PARSE_H
#define FVI_PARSE_H

#include "dampers.h"
#include "damping_laws.h"
#include "error.h"
#include "events.h"
#include "exact_solution.h"
#include "expression.h"
#include "parse_words.h"
#include "sensitivity.h"
#include "solve.h"
#include "system.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* ---- potentials ---- */

typedef enum {
    FVI_POTENTIAL_HARMONIC,
    FVI_POTENTIAL_DUFFING,
    FVI_POTENTIAL_PENDULUM,
    FVI_POTENTIAL_FREE,
    FVI_POTENTIAL_CHAIN,
    FVI_POTENTIAL_EXPRESSION
} fvi_potential_kind;

/* fvi_typed_potential -- what a text has become; begin with a zeroed one, give it back with
 * fvi_typed_potential_free.
 *
 *   d          the dimension; 0: any, its coordinates are alike
 *   constants  c and g of the kinds that have them, as fvi_potential_duffing names them
 *   expression  of FVI_POTENTIAL_EXPRESSION, else NULL */
typedef struct {
    fvi_potential_kind kind;
    size_t d;
    double constants[2];
    fvi_expression *expression;
} fvi_typed_potential;

/* fvi_parse_potential -- harmonic:C, duffing:C,G, pendulum:G, free, chain:D,C,G, or an
 * expression in x, or x1, ..., xd.
 *
 *   d           of the system; 0: what the text says, of an expression the largest index in it. A
 *               chain of another d is refused
 *   parameters  of the expression, kept: they must outlive the potential; NULL if there are none
 *
 * Of a misprint in an expression the error has the byte as its index. */
int fvi_parse_potential(const char *text, size_t d,
                        fvi_user_parameters *parameters,
                        fvi_typed_potential *potential, fvi_error *error);

/* fvi_potential_typed -- U, to be used in a system. It points into *potential, which must outlive
 * the runs and stay where it is. */
fvi_potential fvi_potential_typed(const fvi_typed_potential *potential);

/* fvi_typed_potential_free -- give the expression back; the struct is the caller's. */
void fvi_typed_potential_free(fvi_typed_potential *potential);

/* ---- dampings ---- */

/* fvi_typed_damping -- a law of damping; begin with a zeroed one, give it back with
 * fvi_typed_damping_free. Do not copy one that is in use: law points into it.
 *
 *   symbol  the expression of a law that is typed so, else NULL; function points to it */
enum { FVI_MOST_TERMS = 64 };
typedef struct {
    fvi_kernel law;
    fvi_kernel_term term[FVI_MOST_TERMS];
    fvi_expression *symbol;
    fvi_kernel_function function;
} fvi_typed_damping;

/* fvi_parse_damping -- one more term, or several with " + " between: viscous:R, spring:K, power:R,A,
 * zener:R,A,T, maxwell:R,T, maxwell2:R1,A,R2,B, davidson:R,A,T, distributed:R,A,B; or
 * symbol:EXPRESSION in s, which stands alone.
 *
 *   parameters  of the expression, kept: they must outlive the law; NULL if there are none */
int fvi_parse_damping(const char *text, fvi_user_parameters *parameters,
                      fvi_typed_damping *damping, fvi_error *error);

/* fvi_pair_is_exchanged -- does a term keep the parts of maxwell2:R1,A,R2,B the other way round? It keeps that of
 * the larger order first, so that after A < B its rho and alpha are R2 and B.
 *
 *   parameters  with which the laws were parsed; NULL: nothing is exchanged
 *   term        its place, from 0, among all terms of the last laws that were parsed so, in their order,
 *   terms       as many as these
 *
 *     if (fvi_pair_is_exchanged(&parameters, 0, damping.law.count))
 *         puts("rho1 and alpha1 are those of the second part"); */
int fvi_pair_is_exchanged(const fvi_user_parameters *parameters, size_t term, size_t terms);

/* fvi_typed_damping_free -- give the expression back; the struct is the caller's. */
void fvi_typed_damping_free(fvi_typed_damping *damping);

/* ---- forces ---- */

typedef struct fvi_typed_force fvi_typed_force;

/* fvi_parse_force -- a sum of forces, " + " between: none, step:A,T, cosine:A,W, impulse:J,T
 * (every momentum jumps by J at T), file:NAME (columns t and F, linear in between), or
 * file:NAME:TIME,VALUE with the names of two columns, also with a factor, -9.81*file:g.csv;
 * expressions in t.
 *
 *   d           of the system
 *   parameters  of the expressions, kept: they must outlive the force; NULL if there are none
 *   last        the end of the run: a file must reach it, and an impulse comes before
 *   force       output; give it back with fvi_typed_force_free */
int fvi_parse_force(const char *text, size_t d, fvi_user_parameters *parameters,
                    double last, fvi_typed_force **force, fvi_error *error);

/* fvi_force_typed -- F, the same on every mass, to be used in a system. *force must outlive the
 * runs. */
fvi_force fvi_force_typed(const fvi_typed_force *force);

/* fvi_typed_force_is_simple -- nonzero if the force is none, one step or one cosine, as
 * fvi_linear_oscillator has them. */
int fvi_typed_force_is_simple(const fvi_typed_force *force, fvi_forcing *kind,
                              double constants[2]);

/* fvi_typed_force_by_parameter -- the derivative at t by parameter number j. */
double fvi_typed_force_by_parameter(const fvi_typed_force *force, size_t j,
                                    double t);

/* fvi_typed_force_jump -- number i, from 0, of the times at which the force jumps, as far as it is
 * known: the ends of its steps, and its impulses. NaN if there are not so many. */
double fvi_typed_force_jump(const fvi_typed_force *force, size_t i);

/* fvi_typed_force_file -- the name of file number i, from 0, that was read; NULL if there are not
 * so many. */
const char *fvi_typed_force_file(const fvi_typed_force *force, size_t i);

/* fvi_typed_force_free -- give everything back. NULL is allowed. */
void fvi_typed_force_free(fvi_typed_force *force);

/* ---- a ground that moves ---- */

typedef struct fvi_ground fvi_ground;

/* fvi_parse_ground -- the acceleration a_g of the ground, as fvi_parse_force without impulses: field "ground",
 * and of a file the columns t and ag. In coordinates relative to the ground it acts as
 *
 *     F(t) = the force of the system - M r a_g(t)
 *
 *   system  with all that acts besides; its force, masses and matrices must outlive the ground
 *   r       how each coordinate moves with the ground, d numbers: 1 along it
 *   ground  output; give it back with fvi_ground_free
 *
 * FVI_EUNSUP, too, of matrices without inertia.
 *
 * fvi_ground_alloc -- the same of an acceleration that is no text: a force of one number without
 * impulses (FVI_EINVAL). What its params point to must outlive the ground. Cost O(d), and that of M r.
 *
 *     const fvi_force shaking = { .value = acceleration_of_the_table };
 *     if (fvi_ground_alloc(&shaking, &system, r, &ground, &error) == FVI_SUCCESS)
 *         system.force = fvi_ground_force(ground);
 *
 * fvi_ground_force -- that F, to be put into the system for its runs.
 * fvi_ground_acceleration -- a_g, a force of one number, for columns (columns.h).
 * fvi_ground_typed -- the same as it was typed: its files and jumps; NULL if it was not.
 * fvi_ground_load_vector -- M r, d numbers: F is -M r a_g and what acts besides. */
int fvi_parse_ground(const char *text, const fvi_system *system,
                     const double *r, fvi_user_parameters *parameters,
                     double last, fvi_ground **ground, fvi_error *error);
int fvi_ground_alloc(const fvi_force *acceleration, const fvi_system *system,
                     const double *r, fvi_ground **ground, fvi_error *error);
fvi_force fvi_ground_force(const fvi_ground *ground);
const fvi_force *fvi_ground_acceleration(const fvi_ground *ground);
const fvi_typed_force *fvi_ground_typed(const fvi_ground *ground);
const double *fvi_ground_load_vector(const fvi_ground *ground);
void fvi_ground_free(fvi_ground *ground);

/* fvi_force_rows -- forces that were measured: n rows at increasing times.
 *
 *   columns  1: the same on every mass; or d, one for each
 *   t        n times
 *   F        n columns numbers, row after row */
typedef struct {
    size_t n, columns;
    const double *t, *F;
} fvi_force_rows;

/* fvi_force_table -- F linear between two rows, before the first one and behind the last as it is
 * there; to be used in a system. *rows must outlive the runs. Nothing is checked but n = 0, a
 * force of 0. Cost O(d log n). */
fvi_force fvi_force_table(const fvi_force_rows *rows);

/* ---- mechanisms ---- */

/* fvi_mechanism_texts -- a mechanism as it is typed; what is NULL, or none, it does not have.
 *
 *   lagrangian   L in x1, ..., xd, v1, ..., vd, t (with d = 1 also x, v); NULL: masses and a potential
 *   dampers      '[NAME=] G : LAW [: PAST]', blanks around the colons: G in x1, ..., xd, t; LAW as
 *                fvi_parse_damping; PAST held, caputo or rl
 *   constraints  c in x1, ..., xd, t: c = 0
 *   imposed      'x1=EXPRESSION in t': the constraint x1 - (...) = 0
 *   forces_on    'I=F', I the number of a coordinate, F in x1, ..., xd, v1, ..., vd, t; those on one
 *                coordinate add */
typedef struct {
    const char *lagrangian;
    size_t dampers, constraints, imposed, forces_on;
    const char *const *damper, *const *constraint, *const *impose,
        *const *force_on;
} fvi_mechanism_texts;

typedef struct fvi_typed_mechanism fvi_typed_mechanism;

/* fvi_parse_mechanism -- all of them.
 *
 *   texts       those of constraints are kept, for messages: they must outlive the mechanism
 *   d           of the system
 *   parameters  of the expressions, kept as well; NULL if there are none
 *   mechanism   output; give it back with fvi_typed_mechanism_free
 *
 * The fields of the error are the words of the program: "lagrangian", "damper", "constraint", "impose",
 * "force-on". */
int fvi_parse_mechanism(const fvi_mechanism_texts *texts, size_t d,
                        fvi_user_parameters *parameters,
                        fvi_typed_mechanism **mechanism, fvi_error *error);

/* fvi_damper_texts -- dampers of coordinates as texts: "x1 : power:0.4,0.3 : held" for each rho > 0.
 *
 *   d, rho, alpha  the damping rho_i D^{2 alpha} x_i
 *   law    NULL, or a text as fvi_parse_damping that stands for it where rho > 0
 *   past   the word of a past, or NULL: held
 *   count, list  outputs; the texts stand in one block, free(*list) */
int fvi_damper_texts(size_t d, const double *rho, double alpha, const char *law,
                     const char *past, size_t *count, char ***list,
                     fvi_error *error);

/* fvi_mechanism_typed -- the mechanism, for a system; it belongs to the typed one. */
const fvi_mechanism *fvi_mechanism_typed(const fvi_typed_mechanism *mechanism);

/* fvi_typed_lagrangian_by_parameter -- the derivatives of a typed Lagrangian by parameter j of its text: of
 * L itself to *value, if it is not NULL, and of L_x and L_v added to Sx and Sv, d numbers each.
 * fvi_typed_lagrangian_column -- the last two, an fvi_lagrangian_column (sensitivity.h).
 *
 *   params  those of the fvi_lagrangian
 *
 * Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_typed_lagrangian_by_parameter(size_t j, double t, size_t d, const double *x, const double *v,
                                      void *params, double *value, double *Sx, double *Sv);
int fvi_typed_lagrangian_column(size_t j, double t, size_t d, const double *x, const double *v,
                                void *params, double *Sx, double *Sv);

/* fvi_typed_mechanism_columns -- how its forces, elongations and constraints depend on the `count` parameters of
 * its texts; it points to the mechanism, and `columns` of fvi_sensitivities to it. */
fvi_mechanism_columns fvi_typed_mechanism_columns(const fvi_typed_mechanism *mechanism, size_t count);

/* fvi_typed_mechanism_free -- give everything back. NULL is allowed. */
void fvi_typed_mechanism_free(fvi_typed_mechanism *mechanism);

/* ---- events ---- */

typedef struct fvi_typed_events fvi_typed_events;

/* fvi_parse_events -- texts 'Z : WHAT', blanks around the colon: Z an expression in x1, ..., xd,
 * v1, ..., vd, p1, ..., pd, t (with d = 1 also x, v, p); WHAT impact:E or contact:E, 0 <= E <= 1, stop or mark.
 * Z of an impact knows x and t alone. Field "event".
 *
 *   count       of the texts
 *   mass        d numbers, kept: v = p / m, if fvi_typed_events_of says nothing else
 *   parameters  of the expressions, kept as well; NULL if there are none
 *   events      output; give it back with fvi_typed_events_free
 *
 * fvi_typed_events_of -- the velocities are those of the Lagrangian of a mechanism, which must outlive them; one
 * that is NULL, or has none, changes nothing. NULL events are allowed.
 * fvi_events_typed -- events for a run; they belong to the typed ones. *count becomes their number.
 * fvi_typed_event_name -- Z of event i, from 0, as it was typed. */
int fvi_parse_events(size_t count, const char *const *texts, size_t d,
                     const double *mass, fvi_user_parameters *parameters,
                     fvi_typed_events **events, fvi_error *error);
void fvi_typed_events_of(fvi_typed_events *events, const fvi_mechanism *mechanism);
const fvi_event *fvi_events_typed(const fvi_typed_events *events, size_t *count);
const char *fvi_typed_event_name(const fvi_typed_events *events, size_t i);

/* fvi_typed_events_free -- give everything back. NULL is allowed. */
void fvi_typed_events_free(fvi_typed_events *events);

/* fvi_largest_index -- the largest i of a name like x3 or v3 in the text, or 1 if there is x or v
 * alone, else 0: the dimension of a problem that does not say it. */
size_t fvi_largest_index(const char *text);

/* ---- whole problems ---- */

typedef struct fvi_typed_problem fvi_typed_problem;

/* fvi_parse_problem -- "m=1; U=duffing:1,0.7; damper=zener:1,0.3,0.5; force=step:8,1; x0=1": names
 * and values of the program's options, in any order. A name that is left out has the program's
 * value.
 *
 *     name         or      value
 *     potential    U       as fvi_parse_potential
 *     dimension    d       where the potential does not say it
 *     mass, x0, p0         as fvi_parse_numbers; m is mass
 *     alpha, rho           or, instead of both, damping (damper) as fvi_parse_damping
 *     force        F       as fvi_parse_force
 *     time         T       the end of the motion
 *     derivative   past    held, caputo or rl
 *     let                  as fvi_parse_user_parameters
 *     lagrangian   L       instead of potential and mass; then alpha, rho and damping are none
 *     damper               with " : " in it a damper on an elongation, as fvi_mechanism_texts has them;
 *                          it, and the next three, may be repeated
 *     constraint, impose, force-on   as there; with any of these five the problem has a mechanism
 *     v0                   the velocity, instead of p0
 *
 *   problem  output; give it back with fvi_typed_problem_free
 *
 *     fvi_typed_problem *typed;
 *     if (fvi_parse_problem("U=duffing:1,0.5; alpha=0.3; T=10", &typed, &error) == FVI_SUCCESS)
 *         fvi_solve(fvi_problem_typed(typed), NULL, &accuracy, &outputs, NULL, &error); */
int fvi_parse_problem(const char *text, fvi_typed_problem **problem,
                      fvi_error *error);

/* fvi_problem_typed -- the problem, for fvi_solve; it belongs to the typed one. */
const fvi_problem *fvi_problem_typed(const fvi_typed_problem *problem);

/* fvi_typed_problem_free -- give everything back. NULL is allowed. */
void fvi_typed_problem_free(fvi_typed_problem *problem);

/* fvi_parse_method -- the method with this name, as `run --method` takes it. */
int fvi_parse_method(const char *text, const fvi_method **method,
                     fvi_error *error);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
