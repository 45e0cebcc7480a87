/* src/fvi/parse.h -- Parsers for typed problems: from texts to potentials, dampings, forces, mechanisms and starts.
 *
 *     fvi_typed_potential U = { 0 };
 *     if (fvi_parse_potential("duffing:1,0.5", 0, NULL, &U, &error) == FVI_SUCCESS)
 *         system.potential = fvi_potential_typed(&U);
 *
 * The program, C and Python use the same parsers. A word is followed by its numbers, for example "zener:1,0.3,2". In
 * words capitals count as small letters. The decimal point is '.' under every locale.
 *
 * Errors. Every function with an argument `error` returns FVI_SUCCESS; FVI_EINVAL for a text that it does not
 * understand; FVI_EDOM for a number that is out of its range; FVI_ENOMEM; or FVI_EFAULT if a pointer that must be there
 * is NULL. It describes the error in *error, which may be NULL. The description names the nearest known word if a
 * typing error leads to one. The fields of the error are the words of the program: "potential", "force", "damping",
 * "let". Unless the comment of a function says otherwise, its output is untouched after an error. */
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

/* fvi_typed_potential -- a parsed potential. Start with a zeroed struct; free it with fvi_typed_potential_free.
 *
 *   kind        which potential
 *   d           the dimension; 0: any dimension, the potential treats all coordinates alike
 *   constants   the numbers of the kind, in the order of its params (system.h): c; c, g; or g
 *   expression  the expression of FVI_POTENTIAL_EXPRESSION; NULL for every other kind */
typedef struct {
    fvi_potential_kind kind;
    size_t d;
    double constants[2];
    fvi_expression *expression;
} fvi_typed_potential;

/* fvi_parse_potential -- Parse a potential.
 *
 *   text        harmonic:C, duffing:C,G, pendulum:G, free, chain:D,C,G, or an expression in x, or in x1, ..., xd;
 *               harmonic alone has C = 1
 *   d           the dimension of the system; 0: the text decides, an expression by the largest index in it. A chain of
 *               another dimension is refused
 *   parameters  names and values that the expression may use. The potential keeps the pointer, so the parameters must
 *               outlive it. NULL: no parameters
 *   potential   output
 *
 * For an error in an expression, error->index is the number of the byte, from 0. */
int fvi_parse_potential(const char *text, size_t d, fvi_user_parameters *parameters,
                        fvi_typed_potential *potential, fvi_error *error);

/* fvi_potential_typed -- Return the potential for use in a system. It points into *potential, so that struct must
 * outlive the runs and stay at its address. */
fvi_potential fvi_potential_typed(const fvi_typed_potential *potential);

/* fvi_typed_potential_free -- Free the expression. The struct itself belongs to the caller. NULL is allowed. */
void fvi_typed_potential_free(fvi_typed_potential *potential);

/* ---- dampings ---- */

/* fvi_typed_damping -- a parsed law of damping. Start with a zeroed struct; free it with fvi_typed_damping_free. Do not
 * copy a struct in use, because `law` points into it.
 *
 *   law       the law, for fvi_run.law or a damper
 *   term      its terms
 *   symbol    the expression of a law typed as symbol:EXPRESSION, else NULL
 *   function  the law of this expression; it points to symbol */
enum { FVI_MOST_TERMS = 64 };
typedef struct {
    fvi_kernel law;
    fvi_kernel_term term[FVI_MOST_TERMS];
    fvi_expression *symbol;
    fvi_kernel_function function;
} fvi_typed_damping;

/* fvi_parse_damping -- Parse one or several terms of a law, and append them to *damping.
 *
 *   text        terms with " + " between them: viscous:R, spring:K, power:R,A, zener:R,A,T, maxwell:R,T,
 *               maxwell2:R1,A,R2,B, davidson:R,A,T, distributed:R,A,B, havriliak:R,A,T,B; or symbol:EXPRESSION in s,
 *               which must be the only term. A and B are alpha: the order is 2 alpha. Only the B of havriliak is
 *               another number, its exponent (damping_laws.h)
 *   parameters  names and values that the expression may use; kept, so they must outlive the law. NULL: no parameters
 *   damping     in and out
 *
 *     fvi_typed_damping damping = { 0 };
 *     if (fvi_parse_damping("spring:4 + zener:1,0.3,2", NULL, &damping, &error) == FVI_SUCCESS)
 *         run.law = &damping.law;
 *
 * After an error *damping may have some of the terms: free it. */
int fvi_parse_damping(const char *text, fvi_user_parameters *parameters,
                      fvi_typed_damping *damping, fvi_error *error);

/* fvi_pair_is_exchanged -- Return nonzero if a term holds the two parts of maxwell2:R1,A,R2,B in reversed order. A term
 * holds the part of the larger order first. So if the text has A < B, the term's rho and alpha are R2 and B.
 *
 *   parameters  the parameters with which the laws were parsed; NULL: the function returns 0
 *   terms       a number n: the last n terms that were parsed with these parameters are meant, in their order
 *   term        the place of the term among these n terms, from 0
 *
 *     if (fvi_pair_is_exchanged(&parameters, 0, damping.law.count))
 *         puts("rho1 and alpha1 are those of the second part"); */
int fvi_pair_is_exchanged(const fvi_user_parameters *parameters, size_t term, size_t terms);

/* fvi_typed_damping_free -- Free the expression. The struct itself belongs to the caller. */
void fvi_typed_damping_free(fvi_typed_damping *damping);

/* ---- forces ---- */

typedef struct fvi_typed_force fvi_typed_force;

/* fvi_parse_force -- Parse a sum of forces, with " + " between them. Each force is one of
 *
 *     none                  no force
 *     step:A,T              see fvi_force_step (system.h)
 *     cosine:A,W            see fvi_force_cosine (system.h)
 *     impulse:J,T           every momentum jumps by J at the time T
 *     file:NAME             the columns t and F of a file, linear between two rows
 *     file:NAME:TIME,VALUE  the same, with the names of two other columns
 *     FACTOR*file:...       the same times an expression of numbers, for example -9.81*file:g.csv
 *     an expression in t
 *
 *   d           the dimension of the system
 *   parameters  names and values that the expressions may use; kept, so they must outlive the force. NULL: no
 *               parameters
 *   last        the end of the run: a file must reach it, and an impulse must come before it
 *   force       output; free it with fvi_typed_force_free */
int fvi_parse_force(const char *text, size_t d, fvi_user_parameters *parameters,
                    double last, fvi_typed_force **force, fvi_error *error);

/* fvi_force_typed -- Return the force for use in a system. It is the same on every mass. *force must outlive the
 * runs. */
fvi_force fvi_force_typed(const fvi_typed_force *force);

/* fvi_typed_force_is_simple -- Return nonzero if the force is none, one step or one cosine: the forces of
 * fvi_linear_oscillator (exact_solution.h). Then *kind and constants describe it. */
int fvi_typed_force_is_simple(const fvi_typed_force *force, fvi_forcing *kind, double constants[2]);

/* fvi_typed_force_by_parameter -- Return the derivative of the force at the time t by parameter number j, from 0. */
double fvi_typed_force_by_parameter(const fvi_typed_force *force, size_t j, double t);

/* fvi_typed_force_jump -- Return jump number i, from 0, of the known times at which the force jumps: the ends of its
 * steps, and its impulses. NaN if there is no such jump. */
double fvi_typed_force_jump(const fvi_typed_force *force, size_t i);

/* fvi_typed_force_file -- Return the name of file number i, from 0, that was read; NULL if there is no such file. The
 * text belongs to the force. */
const char *fvi_typed_force_file(const fvi_typed_force *force, size_t i);

/* fvi_typed_force_free -- Free the force. NULL is allowed. */
void fvi_typed_force_free(fvi_typed_force *force);

/* ---- a ground that moves ---- */

typedef struct fvi_ground fvi_ground;

/* fvi_parse_ground -- Parse the acceleration a_g of the ground. The text is that of fvi_parse_force without impulses; a
 * file has the columns t and ag. In coordinates relative to the ground it acts as the force
 *
 *     F(t) = the force of the system - M r a_g(t)
 *
 *   system      with every other force; its force, masses and matrices must outlive the ground
 *   r           the displacement of each coordinate for a ground displacement of 1, d numbers: 1 for a coordinate along
 *               the ground's motion
 *   parameters, last  as fvi_parse_force
 *   ground      output; free it with fvi_ground_free
 *
 * The field of the error is "ground". FVI_EUNSUP for matrices without inertia (fvi_matrices.inertia).
 *
 * fvi_ground_alloc -- Make a ground of an acceleration that is no text.
 *
 *   acceleration  a force of one number, without impulses (FVI_EINVAL); its params must outlive the ground
 *
 *     const fvi_force shaking = { .value = acceleration_of_the_table };
 *     if (fvi_ground_alloc(&shaking, &system, r, &ground, &error) == FVI_SUCCESS)
 *         system.force = fvi_ground_force(ground);
 *
 * Cost O(d), and one product with M.
 *
 * fvi_ground_force -- Return F, to be put into the system for its runs.
 * fvi_ground_acceleration -- Return a_g as a force of one number, for columns (columns.h).
 * fvi_ground_typed -- Return a_g as a typed force, with its files and jumps; NULL if it was not typed.
 * fvi_ground_load_vector -- Return M r, d numbers.
 * fvi_ground_free -- Free the ground. NULL is allowed. The outputs of these functions belong to the ground. */
int fvi_parse_ground(const char *text, const fvi_system *system, const double *r, fvi_user_parameters *parameters,
                     double last, fvi_ground **ground, fvi_error *error);
int fvi_ground_alloc(const fvi_force *acceleration, const fvi_system *system, const double *r, fvi_ground **ground,
                     fvi_error *error);
fvi_force fvi_ground_force(const fvi_ground *ground);
const fvi_force *fvi_ground_acceleration(const fvi_ground *ground);
const fvi_typed_force *fvi_ground_typed(const fvi_ground *ground);
const double *fvi_ground_load_vector(const fvi_ground *ground);
void fvi_ground_free(fvi_ground *ground);

/* fvi_force_rows -- a table of measured forces.
 *
 *   n        number of rows
 *   columns  1: one force, the same on every mass; or d: one force for each coordinate
 *   t        n times, increasing
 *   F        n * columns numbers, row after row */
typedef struct {
    size_t n, columns;
    const double *t, *F;
} fvi_force_rows;

/* fvi_force_table -- Return a force for use in a system: F is linear between two rows, and constant before the first
 * row and after the last. For n = 0 it is a zeroed force. *rows must outlive the runs. Nothing is checked. Cost of a
 * value: O(d log n). */
fvi_force fvi_force_table(const fvi_force_rows *rows);

/* ---- mechanisms ---- */

/* fvi_mechanism_texts -- the texts of a mechanism. A text that is NULL, or a count of 0, stands for a part that the
 * mechanism does not have. With d = 1 the names x and v are allowed for x1 and v1.
 *
 *   lagrangian   L in x1, ..., xd, v1, ..., vd, t; NULL: masses and a potential
 *   dampers, damper          number of texts '[NAME=] G : LAW [: PAST]' with blanks around the colons: the elongation G
 *                in x1, ..., xd, t; LAW as fvi_parse_damping; PAST held, caputo or rl
 *   constraints, constraint  number of texts c in x1, ..., xd, t; the constraint is c = 0
 *   imposed, impose          number of texts 'x1=EXPRESSION in t'; the constraint is x1 - (...) = 0
 *   forces_on, force_on      number of texts 'I=F': I is the number of a coordinate, from 1; F in x1, ..., xd,
 *                v1, ..., vd, t. Forces on one coordinate add up */
typedef struct {
    const char *lagrangian;
    size_t dampers, constraints, imposed, forces_on;
    const char *const *damper, *const *constraint, *const *impose,
        *const *force_on;
} fvi_mechanism_texts;

typedef struct fvi_typed_mechanism fvi_typed_mechanism;

/* fvi_parse_mechanism -- Parse all texts of a mechanism.
 *
 *   texts       the texts of the constraints are kept for messages, so they must outlive the mechanism
 *   d           the dimension of the system, 1 to 10000
 *   parameters  names and values that the expressions may use; kept, so they must outlive the mechanism. NULL: no
 *               parameters
 *   mechanism   output; free it with fvi_typed_mechanism_free
 *
 * The fields of the error are the words of the program: "lagrangian", "damper", "constraint", "impose", "force-on". */
int fvi_parse_mechanism(const fvi_mechanism_texts *texts, size_t d, fvi_user_parameters *parameters,
                        fvi_typed_mechanism **mechanism, fvi_error *error);

/* fvi_damper_texts -- Write the dampings of coordinates as texts of dampers, for example "x1 : power:0.4,0.3 : held"
 * for each coordinate with rho > 0.
 *
 *   d, rho, alpha  the damping rho_i D^{2 alpha} x_i of d coordinates
 *   law            NULL; or a text as fvi_parse_damping, which replaces this damping where rho > 0
 *   past           the word of a past; NULL: held
 *   count, list    outputs: the number of texts, and the texts in one block; free it with free(*list). After
 *                  FVI_ENOMEM they are 0 and NULL */
int fvi_damper_texts(size_t d, const double *rho, double alpha, const char *law, const char *past, size_t *count,
                     char ***list, fvi_error *error);

/* fvi_mechanism_typed -- Return the mechanism for use in a system. It belongs to the typed mechanism. */
const fvi_mechanism *fvi_mechanism_typed(const fvi_typed_mechanism *mechanism);

/* fvi_typed_lagrangian_by_parameter -- Differentiate a typed Lagrangian by parameter j of its text, from 0.
 *
 *   t, d, x, v  the point
 *   params      the params of the fvi_lagrangian
 *   value       output, or NULL: the derivative of L
 *   Sx, Sv      in and out, d numbers each: the derivatives of L_x and of L_v are added
 *
 * fvi_typed_lagrangian_column -- The same without the derivative of L: an fvi_lagrangian_column (sensitivity.h).
 *
 * Both return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_typed_lagrangian_by_parameter(size_t j, double t, size_t d, const double *x, const double *v,
                                      void *params, double *value, double *Sx, double *Sv);
int fvi_typed_lagrangian_column(size_t j, double t, size_t d, const double *x, const double *v,
                                void *params, double *Sx, double *Sv);

/* fvi_typed_mechanism_columns -- Return the derivatives of the forces, elongations and constraints by the `count`
 * parameters of the texts, for `columns` of fvi_sensitivities (sensitivity.h). The struct points to the mechanism. */
fvi_mechanism_columns fvi_typed_mechanism_columns(const fvi_typed_mechanism *mechanism, size_t count);

/* fvi_typed_mechanism_free -- Free the mechanism. NULL is allowed. */
void fvi_typed_mechanism_free(fvi_typed_mechanism *mechanism);

/* ---- events ---- */

typedef struct fvi_typed_events fvi_typed_events;

/* fvi_parse_events -- Parse texts of events (events.h).
 *
 *   count       number of texts
 *   texts       'Z : WHAT' with blanks around the colon. Z is an expression in x1, ..., xd, v1, ..., vd, p1, ..., pd, t
 *               (with d = 1 also x, v, p). WHAT is impact:E or contact:E with 0 <= E <= 1, stop, or mark. Z of an
 *               impact may contain only x and t
 *   d           the dimension of the system
 *   mass        d numbers, kept: v = p / m, unless fvi_typed_events_of names a Lagrangian
 *   parameters  names and values that the expressions may use; kept, so they must outlive the events. NULL: no
 *               parameters
 *   events      output; free it with fvi_typed_events_free
 *
 * The field of the error is "event".
 *
 * fvi_typed_events_of -- Take the velocities of the events from the Lagrangian of a mechanism, which must outlive the
 * events. A mechanism that is NULL, or has no Lagrangian, changes nothing. NULL events are allowed.
 * fvi_events_typed -- Return the events for a run, and their number in *count. They belong to the typed events.
 * fvi_typed_event_name -- Return Z of event i, from 0, as it was typed. The text belongs to the typed events. */
int fvi_parse_events(size_t count, const char *const *texts, size_t d, const double *mass,
                     fvi_user_parameters *parameters, fvi_typed_events **events, fvi_error *error);
void fvi_typed_events_of(fvi_typed_events *events, const fvi_mechanism *mechanism);
const fvi_event *fvi_events_typed(const fvi_typed_events *events, size_t *count);
const char *fvi_typed_event_name(const fvi_typed_events *events, size_t i);

/* fvi_typed_events_free -- Free the events. NULL is allowed. */
void fvi_typed_events_free(fvi_typed_events *events);

/* fvi_largest_index -- Return the largest index i of a name like x3 or v3 in the text; 1 if the text has x or v without
 * an index; else 0. This is the dimension of a problem that does not state its dimension. */
size_t fvi_largest_index(const char *text);

/* ---- whole problems ---- */

typedef struct fvi_typed_problem fvi_typed_problem;

/* fvi_parse_problem -- Parse a whole problem, for example
 * "m=1; U=duffing:1,0.7; damper=zener:1,0.3,0.5; force=step:8,1; x0=1".
 *
 * The text has names and values of the program's options, in any order. A name that is left out has the default value
 * of the program.
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
 *   problem  output; free it with fvi_typed_problem_free
 *
 *     fvi_typed_problem *typed;
 *     if (fvi_parse_problem("U=duffing:1,0.5; alpha=0.3; T=10", &typed, &error) == FVI_SUCCESS)
 *         fvi_solve(fvi_problem_typed(typed), NULL, &accuracy, &outputs, NULL, &error); */
int fvi_parse_problem(const char *text, fvi_typed_problem **problem, fvi_error *error);

/* fvi_problem_typed -- Return the problem for fvi_solve. It belongs to the typed problem. */
const fvi_problem *fvi_problem_typed(const fvi_typed_problem *problem);

/* fvi_typed_problem_free -- Free the problem. NULL is allowed. */
void fvi_typed_problem_free(fvi_typed_problem *problem);

/* fvi_check_force -- Check that a typed force is finite at all times at which a run with steps of length h asks for it.
 * fvi_check_start_force -- Check that a typed force is not infinite at t = 0, for a method that evaluates it just after
 * t = 0: its value there would be huge, and so would be the motion. Algorithm 3 and the classical methods take every
 * force, because they take t = 0 itself, or no force in the first row. [(13.12)]
 *
 *   method       the method of the run
 *   field, text  the name and the text of the force, for the error
 *   force        the force, or the acceleration of the ground (fvi_ground_typed); NULL: nothing is checked
 *
 *     status = fvi_check_start_force(&fvi_cq_bdf2, "force", "1/sqrt(t)", force, &error); // FVI_EINVAL
 *
 * fvi_check_force first calls fvi_check_start_force. A method that takes the limits of a force at nodes takes
 * sin(t-1)/(t-1), but no force that is infinite at a node. For a method that chooses its steps, and for steps = 0, only
 * t = 0 is checked. Cost: some bounds of the force; in the worst case its values in all steps.
 * Returns FVI_SUCCESS; FVI_EINVAL, and then the text names the time, and the value is that of the force. */
int fvi_check_force(const fvi_method *method, double h, size_t steps, const char *field, const char *text,
                    const fvi_typed_force *force, fvi_error *error);
int fvi_check_start_force(const fvi_method *method, const char *field, const char *text,
                          const fvi_typed_force *force, fvi_error *error);

/* fvi_parse_method -- Find the method with this name. The names are those of the program's option `run --method`. */
int fvi_parse_method(const char *text, const fvi_method **method, fvi_error *error);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
