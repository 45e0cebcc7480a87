"""What of the library Python calls, compiled by cffi into fvi._fvi.

The declarations repeat those of src/fvi/*.h, as far as they are needed. In a struct `...;` stands for all other
fields: the compiler finds the places. tests/python/test_python_interface.py compares all of them with the headers."""
import pathlib
import shlex
import subprocess

from cffi import FFI

HERE = pathlib.Path(__file__).resolve().parent

ffi = FFI()
ffi.cdef("""
typedef struct { int code; const char *field; double value; size_t index; char text[400]; } fvi_error;
typedef struct {
    int (*value)(size_t d, const double *x, void *params, double *value);
    int (*gradient)(size_t d, const double *x, void *params, double *grad);
    int (*hessian)(size_t d, const double *x, void *params, double *H);
    void *params;
    int (*quadratic)(const void *params);
    size_t diagonals;
    ...;
} fvi_potential;
typedef struct {
    double t;
    const double *J;
} fvi_impulse;
typedef struct {
    int (*value)(double t, size_t d, void *params, double *F);
    void *params;
    const fvi_impulse *impulses;
    size_t impulse_count;
    ...;
} fvi_force;
typedef struct { size_t remembered; ...; } fvi_matrices;
typedef struct {
    size_t d;
    const double *mass, *damping;
    fvi_potential potential;
    fvi_force force;
    const fvi_matrices *matrices;
    const struct fvi_mechanism *mechanism;
    ...;
} fvi_system;
typedef enum { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_CAPUTO, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, ... } fvi_initial_history;
typedef enum { FVI_HISTORY_AUTO, FVI_HISTORY_DIRECT, FVI_HISTORY_MODES, ... } fvi_history_kind;
typedef enum { FVI_KERNEL_POWER, FVI_KERNEL_ZENER, FVI_KERNEL_MAXWELL, FVI_KERNEL_DISTRIBUTED, FVI_KERNEL_MAXWELL2,
               FVI_KERNEL_SYMBOL, ... } fvi_kernel_kind;
typedef struct { fvi_kernel_kind kind; double rho; ...; } fvi_kernel_term;
typedef struct { size_t count; const fvi_kernel_term *term; } fvi_kernel;
typedef struct {
    fvi_kernel_term term;
    void (*value)(double re, double im, void *params, double *C_re, double *C_im);
    void *params;
} fvi_kernel_function;
typedef struct {
    const fvi_system *system;
    const double *x0, *p0;
    double h;
    size_t steps;
    double kappa, alpha;
    fvi_initial_history past;
    fvi_history_kind memory;
    double tolerance, step_error, longest;
    size_t most_steps;
    const fvi_kernel *law;
    const struct fvi_event *events;
    size_t event_count;
} fvi_run;
typedef struct {
    const char *name, *order, *memory;
    int lowest, highest, stages;
    double alpha_least, alpha_most;
    int takes_kappa, implicit, paper_convention;
    ...;
} fvi_method;
typedef struct {
    size_t k;
    double t;
    double *x, *p;
    ...;
} fvi_stepper;
typedef enum { FVI_EVENT_MARK, FVI_EVENT_STOP, FVI_EVENT_IMPACT } fvi_event_action;
typedef struct fvi_event {
    int (*value)(double t, size_t d, const double *x, const double *p, void *params, double *z);
    int (*gradient)(double t, size_t d, const double *x, void *params, double *normal, double *rate);
    void *params;
    int direction;
    fvi_event_action action;
    double restitution;
} fvi_event;
typedef struct { double t; size_t event; int at_rest; } fvi_event_time;
const fvi_event_time *fvi_stepper_events(const fvi_stepper *s, size_t *n);
int fvi_stepper_is_over(const fvi_stepper *s);
typedef struct { size_t steps, rejected; double longest; ...; } fvi_step_statistics;
int fvi_stepper_statistics(const fvi_stepper *s, fvi_step_statistics *counts);
typedef struct fvi_typed_events fvi_typed_events;
extern const fvi_method *const fvi_methods[];
const fvi_method *fvi_method_find(const char *name);
fvi_run fvi_run_default(const fvi_system *system, const double *x0, const double *p0, double h, size_t steps);
int fvi_stepper_start(const fvi_method *method, const fvi_run *run, fvi_stepper **stepper, fvi_error *error);
int fvi_stepper_step(fvi_stepper *s);
int fvi_stepper_copy(const fvi_stepper *from, fvi_stepper **to);
int fvi_stepper_reset(fvi_stepper *s);
int fvi_stepper_kick(fvi_stepper *s, const double *J);
int fvi_stepper_free(fvi_stepper *s);
typedef struct {
    fvi_system system;
    const double *x0, *p0;
    double T, alpha;
    const fvi_kernel *law;
    fvi_initial_history past;
    ...;
} fvi_problem;
typedef struct {
    const fvi_method *method;
    double h;
    const double *kappa;
    double longest, step_error;
    fvi_history_kind history;
    double history_tolerance;
    ...;
} fvi_solve_options;
typedef struct { double tolerance; size_t most_steps; ...; } fvi_accuracy;
typedef struct {
    size_t rows;
    const double *t;
    double *x, *p, *energy;
    int (*row)(size_t k, double t, const double *x, const double *p, void *params);
    void *params;
    ...;
} fvi_outputs;
typedef struct { const fvi_method *method; size_t steps, rejected; double h, error; ...; } fvi_report;
int fvi_energy(const fvi_system *system, const double *x, const double *p, double *E);
int fvi_solve(const fvi_problem *problem, const fvi_solve_options *options, const fvi_accuracy *accuracy,
              const fvi_outputs *outputs, fvi_report *report, fvi_error *error);
enum { FVI_WARNING_ROOM = 400 };
int fvi_warning_of_initial_history(const fvi_run *run, const char **text);
int fvi_warning_of_step(const fvi_method *method, const fvi_run *run, size_t size, char *text);
typedef struct { double stiffest; size_t next; } fvi_watch;
fvi_watch fvi_watch_begin(const fvi_method *method, const fvi_run *run, int is_unstable);
int fvi_warning_along(fvi_watch *watch, const fvi_method *method, const fvi_run *run, size_t k,
                      const double *x, size_t size, char *text);

typedef struct { size_t count; double value[64]; unsigned char used[64]; ...; } fvi_user_parameters;
#define FVI_USED_BY_FORCE ...
#define FVI_USED_BY_DAMPING ...
int fvi_user_parameters_set(fvi_user_parameters *parameters, const char *name, double value, fvi_error *error);
int fvi_user_parameters_are_used(const fvi_user_parameters *parameters, fvi_error *error);
typedef enum { FVI_POTENTIAL_HARMONIC, FVI_POTENTIAL_DUFFING, FVI_POTENTIAL_PENDULUM, FVI_POTENTIAL_CHAIN,
               FVI_POTENTIAL_EXPRESSION, ... } fvi_potential_kind;
typedef struct fvi_expression fvi_expression;
typedef struct { fvi_potential_kind kind; size_t d; double constants[2]; fvi_expression *expression; } fvi_typed_potential;
int fvi_parse_potential(const char *text, size_t d, fvi_user_parameters *parameters, fvi_typed_potential *potential,
                        fvi_error *error);
fvi_potential fvi_potential_typed(const fvi_typed_potential *potential);
void fvi_typed_potential_free(fvi_typed_potential *potential);
fvi_kernel fvi_kernel_of_function(const fvi_kernel_function *function);
typedef struct { fvi_kernel law; fvi_kernel_function function; ...; } fvi_typed_damping;
int fvi_parse_damping(const char *text, fvi_user_parameters *parameters, fvi_typed_damping *damping, fvi_error *error);
void fvi_typed_damping_free(fvi_typed_damping *damping);
typedef struct fvi_typed_force fvi_typed_force;
typedef struct fvi_ground fvi_ground;
int fvi_parse_ground(const char *text, const fvi_system *system, const double *r, fvi_user_parameters *parameters,
                     double last, fvi_ground **ground, fvi_error *error);
int fvi_ground_alloc(const fvi_force *acceleration, const fvi_system *system, const double *r, fvi_ground **ground,
                     fvi_error *error);
fvi_force fvi_ground_force(const fvi_ground *ground);
const fvi_force *fvi_ground_acceleration(const fvi_ground *ground);
void fvi_ground_free(fvi_ground *ground);
int fvi_parse_force(const char *text, size_t d, fvi_user_parameters *parameters, double last, fvi_typed_force **force,
                    fvi_error *error);
fvi_force fvi_force_typed(const fvi_typed_force *force);
void fvi_typed_force_free(fvi_typed_force *force);
typedef struct {
    const char *lagrangian;
    size_t dampers, constraints, imposed, forces_on;
    const char *const *damper, *const *constraint, *const *impose, *const *force_on;
    ...;
} fvi_mechanism_texts;
typedef struct fvi_typed_mechanism fvi_typed_mechanism;
int fvi_parse_mechanism(const fvi_mechanism_texts *texts, size_t d, fvi_user_parameters *parameters,
                        fvi_typed_mechanism **mechanism, fvi_error *error);
const struct fvi_mechanism *fvi_mechanism_typed(const fvi_typed_mechanism *mechanism);
void fvi_typed_mechanism_free(fvi_typed_mechanism *mechanism);
int fvi_parse_events(size_t count, const char *const *texts, size_t d, const double *mass, fvi_user_parameters *parameters,
                     fvi_typed_events **events, fvi_error *error);
const fvi_event *fvi_events_typed(const fvi_typed_events *events, size_t *count);
const char *fvi_typed_event_name(const fvi_typed_events *events, size_t i);
void fvi_typed_events_free(fvi_typed_events *events);
size_t fvi_largest_index(const char *text);
typedef struct { size_t n; int *start, *row; double *entry; } fvi_sparse;
typedef struct { const double *row; ...; } fvi_elongation;
typedef struct {
    const char *name;
    fvi_elongation of;
    const fvi_sparse *matrix;
    const fvi_kernel *kernel;
    fvi_initial_history past;
    ...;
} fvi_damper;
typedef struct fvi_structure fvi_structure;
int fvi_structure_alloc(const fvi_sparse *M, const fvi_sparse *K, const fvi_sparse *C, fvi_structure **structure,
                        char *fault);
int fvi_structure_alloc_dampers(const fvi_sparse *M, const fvi_sparse *K, size_t count, const fvi_damper *damper,
                                fvi_structure **structure, fvi_error *error);
fvi_system fvi_structure_system(const fvi_structure *structure);
void fvi_structure_free(fvi_structure *structure);

typedef struct { const fvi_system *system; double alpha; const fvi_kernel *law; const double *at, *along; ...; } fvi_linear_motion;
typedef struct fvi_response fvi_response;
typedef enum { FVI_RESPONSE_RECEPTANCE, FVI_RESPONSE_MOBILITY, FVI_RESPONSE_ACCELERANCE, FVI_RESPONSE_GROUND }
    fvi_response_kind;
typedef struct { size_t count, expected, d; double *pole, *shape, *residual; ...; } fvi_poles;
int fvi_response_alloc(const fvi_linear_motion *motion, fvi_response **response, fvi_error *error);
void fvi_response_free(fvi_response *response);
int fvi_response_at(fvi_response *response, fvi_response_kind kind, size_t n, const double *omega, size_t at, size_t by,
                    double *H, fvi_error *error);
int fvi_poles_find(fvi_response *response, size_t count, fvi_poles *poles, fvi_error *error);
void fvi_poles_free(fvi_poles *poles);
int fvi_response_warning_of_place(const fvi_system *system, const double *x, const char **text);
int fvi_response_warning_of_poles(const fvi_poles *poles, size_t size, char *text);
int fvi_kernel_moduli(const fvi_kernel *law, double omega, double *storage, double *loss);
typedef struct {
    double alpha, kappa, T, damping, lipschitz, gradient, variation, start, speed, acceleration, room;
    ...;
} fvi_smoothness;
typedef struct { double C, lambda, h; } fvi_error_bound;
int fvi_error_bound_compute(const fvi_smoothness *motion, fvi_error_bound *bound);
int fvi_stability_number(const fvi_method *method, const fvi_run *run, double *load);
int fvi_stability_longest_step(const fvi_method *method, const fvi_run *run, double *h);
typedef struct { double cost, miss, change; size_t iterations; ...; } fvi_control_result;
int fvi_control_solve(const fvi_method *method, const fvi_run *run, const double *x, const double *p, double *u,
                      fvi_control_result *found);
typedef struct { size_t n, columns; const double *t, *F; ...; } fvi_force_rows;
fvi_force fvi_force_table(const fvi_force_rows *rows);

typedef enum { FVI_FREE_PARAMETER_ALPHA, FVI_FREE_PARAMETER_RHO, FVI_FREE_PARAMETER_MASS, FVI_FREE_PARAMETER_X0,
               FVI_FREE_PARAMETER_P0, FVI_FREE_PARAMETER_OFFSET, FVI_FREE_PARAMETER_DRIFT,
               FVI_FREE_PARAMETER_CONSTANT, ... } fvi_free_parameter;
enum { FVI_ESTIMATION_MOST = 8, FVI_EDOM = 1, FVI_EINVAL = 4, FVI_ENOMEM = 8, FVI_ERUNAWAY = 10, FVI_EMAXITER = 11, FVI_ETOL = 14, FVI_EOVRFLW = 16, FVI_ESING = 21, FVI_EUNSUP = 23 };
typedef struct {
    const fvi_method *method;
    const fvi_run *run;
    double *constants;
    size_t n;
    const double *t, *x;
    double sigma;
    size_t parameters;
    const fvi_free_parameter *which;
    size_t starts;
    double h;
    const double *low, *high;
    ...;
} fvi_estimation;
typedef struct {
    double estimate[8], sd[8], correlation[8][8];
    double quantile, sigma, chi2, probability, neighbours;
    size_t agree;
    double h, bias, reached;
    ...;
} fvi_estimate;
typedef struct {
    double lower[8], upper[8];
    unsigned flags, grave;
    double probability[5];
    ...;
} fvi_examination;
int fvi_estimate_examine(const fvi_estimation *fit, const fvi_estimate *fitted, fvi_examination *examined);
int fvi_estimate_flag_text(const fvi_estimation *fit, const fvi_estimate *fitted, const fvi_examination *examined,
                           unsigned flag, const char *const *names, size_t size, char *text);
int fvi_estimate_warning_of_unseen(const fvi_estimation *fit, const fvi_estimate *fitted,
                                   const fvi_examination *examined, size_t which, const char *const *names,
                                   size_t size, char *text);
int fvi_estimate_box(const fvi_estimation *fit, double *low, double *high);
typedef enum { FVI_MATERIAL_MODULI, FVI_MATERIAL_CREEP, FVI_MATERIAL_RELAXATION } fvi_material_test;
typedef enum { FVI_ELEMENT_SPRING, ... } fvi_element;
extern const char *const fvi_element_words[];
const char *fvi_element_number(fvi_element kind, size_t i, size_t *field);
typedef struct {
    fvi_material_test test;
    size_t n;
    const double *at, *first, *second;
    const double *unit, *second_unit;
    double sigma, load;
    size_t elements;
    const fvi_element *kind;
    size_t starts;
    ...;
} fvi_material_data;
typedef struct {
    size_t numbers;
    double estimate[24], sd[24], lower[24], upper[24];
    double sigma, chi2, probability, quantile, neighbours;
    size_t starts, agree;
    unsigned flags, grave;
    ...;
} fvi_material;
int fvi_material_fit(const fvi_material_data *data, double *curve, fvi_material *material, fvi_error *error);
int fvi_material_curve(fvi_material_test test, const fvi_kernel *kernel, double load, size_t n, const double *at,
                       double *first, double *second, fvi_error *error);
int fvi_material_flag_text(const fvi_material_data *data, const fvi_material *material, unsigned flag, size_t size,
                           char *text);
int fvi_estimate_multistart(const fvi_estimation *fit, double *curve, fvi_estimate *fitted);

typedef enum { FVI_FORCING_NONE, FVI_FORCING_STEP, FVI_FORCING_COSINE } fvi_forcing;
typedef struct {
    double m, c, rho, alpha;
    fvi_initial_history past;
    double x0, v0;
    fvi_forcing forcing;
    double A, T, w;
    const fvi_kernel *law;
} fvi_linear_oscillator;
int fvi_typed_force_is_simple(const fvi_typed_force *force, fvi_forcing *kind, double *constants);
int fvi_estimate_warning_of_pair(const fvi_estimate *fitted, size_t i, size_t j, const char *name_i,
                            const char *name_j, size_t size, char *text);
int fvi_estimate_reason(int status, const fvi_estimation *fit, const fvi_estimate *fitted, const char *names,
                   const char *dashes, size_t size, char *text);
const char *fvi_estimate_warning_of_initial_history(const fvi_estimation *fit, const fvi_estimate *fitted);
int fvi_exact_at(const fvi_linear_oscillator *problem, size_t n, const double *t, double *x, double *v,
                 fvi_error *error);
int fvi_exact_grid(const fvi_linear_oscillator *problem, double h, size_t n, double tolerance, double *x, double *v,
                   fvi_error *error);

int fvi_gl_weights(double alpha, size_t count, double *w);
const char *fvi_error_name(int code);
const char *fvi_version(void);

typedef struct { size_t count; int (*column)(size_t j, size_t d, const double *x, void *params, double *S); }
    fvi_parameter_gradient;
fvi_parameter_gradient fvi_parameter_gradient_of(const fvi_potential *potential);
typedef struct {
    int (*slopes)(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp);
    void *params;
    int has_momenta;
    ...;
} fvi_objective;
typedef struct {
    double *x0, *p0, *mass, *damping, *alpha, *terms, *orders, *times, *ends, *force, *parameters;
    fvi_parameter_gradient sensitivity;
    ...;
} fvi_sensitivities;
int fvi_adjoint(const fvi_method *method, const fvi_run *run, const double *x, const double *p,
                const fvi_objective *objective, const fvi_sensitivities *gradients);
double fvi_typed_force_by_parameter(const fvi_typed_force *force, size_t j, double t);
double fvi_lobatto_abscissa(size_t s, size_t i);
int places_within(fvi_stepper *s, size_t count, const double *t, double *x);
int fvi_tangent(const fvi_run *run, size_t P, const fvi_free_parameter *which, double *x, double *slope);

typedef struct { const double *Jx, *Jp; ...; } cotangents;
int read_slopes(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp);
int by_parameter(size_t j, size_t d, const double *x, void *params, double *S);
int energy_slopes(const fvi_system *system, size_t rows, const double *x, const double *p, const double *by,
                  double *Jx, double *Jp);
int energy_by_parameter(const fvi_typed_potential *potential, size_t d, size_t j, const double *x, double *value);
const char *why(int code);
void listen(unsigned long thread);
void begin(void);
typedef struct { size_t rows, all; void *tell; ...; } row_count;
int count_row(size_t k, double t, const double *x, const double *p, void *params);
typedef struct fvi_observer fvi_observer;
enum { FVI_OBSERVE_VELOCITY = 1, FVI_OBSERVE_ACCELERATION = 2, FVI_OBSERVE_FORCE = 4, FVI_OBSERVE_IMPULSE = 8,
       FVI_OBSERVE_WORK = 16, FVI_OBSERVE_ENERGY = 32, FVI_OBSERVE_APPLIED = 64, FVI_OBSERVE_MULTIPLIER = 128 };
int fvi_observer_start(const fvi_stepper *s, unsigned wanted, fvi_observer **o, fvi_error *error);
size_t fvi_observer_dampers(const fvi_observer *o);
size_t fvi_observer_width(const fvi_observer *o, size_t j);
void fvi_observer_free(fvi_observer *o);
typedef struct { double *a, *force, *impulse, *work, *multiplier, *work_of_force, *balance; } observed;
int observe(fvi_observer *o, fvi_stepper *s, size_t rows, const double *t, const observed *to, size_t *done);
size_t constraints(const fvi_system *system);
size_t imposed_on(const fvi_system *system, size_t i);
int rows_to_event(fvi_stepper *s, size_t rows, const double *t, double *x, double *p, row_count *count);
int accelerations_of_ground(const fvi_ground *ground, size_t rows, const double *t, double *ag);
const char *damper_name(const fvi_system *system, size_t j);
int energies(const fvi_system *system, size_t rows, const double *t, const double *x, const double *p, double *energy,
             size_t *done);
int velocities(const fvi_system *system, size_t rows, const double *t, const double *x, const double *p, double *v);
int fvi_momentum_of_velocity(const fvi_system *system, double t, const double *x, const double *v, double *p);
void obey(const int *flag);
int is_dense(const fvi_method *method);
extern "Python" int report_progress(size_t rows, size_t all, void *tell);
int take_steps(fvi_stepper *s, size_t count, const fvi_watch *watch, size_t *taken);
int look_along(fvi_watch *watch, const fvi_method *method, const fvi_run *run, size_t rows, const double *t,
               const double *x, size_t size, char *text);
extern "Python" int look_up(void);
extern "Python" int ask_value(size_t d, const double *x, void *params, double *value);
extern "Python" int ask_gradient(size_t d, const double *x, void *params, double *grad);
extern "Python" int ask_hessian(size_t d, const double *x, void *params, double *H);
extern "Python" int ask_force(double t, size_t d, void *params, double *F);
extern "Python" int ask_quadratic(const void *params);
extern "Python" int ask_event(double t, size_t d, const double *x, const double *p, void *params, double *z);
extern "Python" int ask_normal(double t, size_t d, const double *x, void *params, double *normal, double *rate);
extern "Python" void ask_symbol(double re, double im, void *params, double *C_re, double *C_im);
""")


def flags(what):
    return shlex.split(subprocess.run(["pkg-config", what, "gsl"], check=True,
                                      capture_output=True, text=True).stdout)


ffi.set_source(
    "fvi._fvi",
    (HERE / "glue.h").read_text(),
    include_dirs=[str(HERE / "include")],
    extra_compile_args=["-std=c11", "-Werror=incompatible-pointer-types", *flags("--cflags")],
    extra_objects=[str(HERE / "libfvi.a")],
    # GSL's own products come before those of the library that SuiteSparse needs: the program's digits.
    extra_link_args=["-Wl,--no-as-needed", *flags("--libs"), "-lumfpack", "-lcholmod", "-Wl,--disable-new-dtags", "-Wl,-rpath,$ORIGIN"],
    py_limited_api=True,
)
