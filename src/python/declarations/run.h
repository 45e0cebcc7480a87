/* src/python/declarations/run.h -- For cffi: systems, methods, steppers, whole runs, events and warnings. */
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
typedef struct { ...; } fvi_matrices;
typedef struct {
    size_t d;
    const double *mass, *damping;
    fvi_potential potential;
    fvi_force force;
    const fvi_matrices *matrices;
    const struct fvi_mechanism *mechanism;
    ...;
} fvi_system;
typedef enum { FVI_INITIAL_HISTORY_HELD, FVI_INITIAL_HISTORY_CAPUTO, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
               ... } fvi_initial_history;
typedef enum { FVI_HISTORY_AUTO, FVI_HISTORY_DIRECT, FVI_HISTORY_MODES, ... } fvi_history_kind;
typedef enum { FVI_KERNEL_POWER, FVI_KERNEL_MAXWELL2, FVI_KERNEL_SYMBOL, ... } fvi_kernel_kind;
typedef struct { fvi_kernel_kind kind; double rho, alpha, time, end; } fvi_kernel_term;
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
    fvi_error *failure;
} fvi_run;
typedef struct {
    const char *name, *order, *memory;
    int lowest, highest, stages, damped_inertia;
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
typedef enum { FVI_EVENT_MARK, FVI_EVENT_STOP, FVI_EVENT_IMPACT, FVI_EVENT_CONTACT } fvi_event_action;
typedef struct fvi_event {
    int (*value)(double t, size_t d, const double *x, const double *p, void *params, double *z);
    int (*gradient)(double t, size_t d, const double *x, void *params, double *normal, double *rate);
    void *params;
    int direction;
    fvi_event_action action;
    double restitution, rest;
    int (*hessian)(double t, size_t d, const double *x, double factor, void *params, double *H);
} fvi_event;
typedef struct { double t; size_t event; int at_rest, lifts_off; } fvi_event_time;
const fvi_event_time *fvi_stepper_events(const fvi_stepper *s, size_t *n);
int fvi_stepper_is_over(const fvi_stepper *s);
typedef struct { size_t steps, rejected; double longest; ...; } fvi_step_statistics;
int fvi_variable_step_takes_structure(const fvi_system *system, double alpha, const fvi_kernel *law);
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
    const struct fvi_event *events;
    size_t event_count;
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
    int (*event)(const fvi_event_time *at, const double *x, const double *p, void *params);
    ...;
} fvi_outputs;
typedef struct { const fvi_method *method; size_t steps, rejected, rows; double h, error, step_error; ...; } fvi_report;
int fvi_energy(const fvi_system *system, const double *x, const double *p, double *E);
const char *fvi_batch_refusal(const fvi_method *method, size_t count, const fvi_run *run);
int fvi_batch_trajectories(const fvi_method *method, size_t count, const fvi_run *run, size_t rows, const size_t *row,
                           double *const *x, double *const *p, int *status);
size_t fvi_common_steps(size_t count, const double *t, double T);
const fvi_method *fvi_method_for_error(const fvi_run *run, double tolerance);
int fvi_solve(const fvi_problem *problem, const fvi_solve_options *options, const fvi_accuracy *accuracy,
              const fvi_outputs *outputs, fvi_report *report, fvi_error *error);
enum { FVI_WARNING_ROOM = 400 };
int fvi_warning_of_initial_history(const fvi_run *run, const char **text);
int fvi_warning_of_step(const fvi_method *method, const fvi_run *run, size_t size, char *text);
int fvi_warning_of_memory(const fvi_method *method, const fvi_run *run, size_t size, char *text);
int fvi_warning_of_inertia_in_rows(const fvi_system *system, size_t rows, const double *t, const double *x,
                                   const double *p, size_t size, char *text);
typedef struct { double stiffest; size_t next; } fvi_watch;
fvi_watch fvi_watch_begin(const fvi_method *method, const fvi_run *run, int is_unstable);
int fvi_warning_along(fvi_watch *watch, const fvi_method *method, const fvi_run *run, size_t k,
                      const double *x, size_t size, char *text);
