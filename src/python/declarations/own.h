/* src/python/declarations/own.h -- For cffi: what glue.h adds, what observers say, and what C calls of Python's. */
typedef struct { const double *Jx, *Jp; ...; } cotangents;
int read_slopes(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp);
int by_parameter(size_t j, size_t d, const double *x, void *params, double *S);
int energy_slopes(const fvi_system *system, size_t rows, const double *t, const double *x, const double *p,
                  const double *by, double *Jx, double *Jp);
int energies_by_lagrangian(const fvi_system *system, size_t rows, const double *t, const double *x, const double *v,
                           const double *by, size_t n, double *parameters);
int start_by_velocity(const fvi_system *system, const double *x0, const double *v0, const double *by_p0, double *by_x0,
                      double *by_v0, size_t n, double *parameters);
size_t dampers_of(const fvi_system *system);
const fvi_kernel *kernel_of(const fvi_system *system, size_t j);
int energy_by_parameter(const fvi_typed_potential *potential, size_t d, size_t j, const double *x, double *value);
typedef struct imposed_places imposed_places;
imposed_places *imposed_places_alloc(const struct fvi_mechanism *typed, const char *const *names, size_t count);
int imposed_places_put(imposed_places *o, size_t i, size_t constraint, void *function, size_t n, const double *t,
                       const double *x);
void imposed_places_at(const imposed_places *o, size_t i, double t, double *u, double *rate);
const struct fvi_mechanism *imposed_places_mechanism(const imposed_places *o);
void imposed_places_free(imposed_places *o);
const char *reason_of_code(int code);
void set_main_thread(unsigned long thread);
void begin(void);
typedef struct { size_t rows, all; void *tell, *happened; ...; } row_count;
int count_row(size_t k, double t, const double *x, const double *p, void *params);
int count_event(const fvi_event_time *at, const double *x, const double *p, void *params);
typedef struct fvi_observer fvi_observer;
enum { FVI_OBSERVE_VELOCITY = 1, FVI_OBSERVE_ACCELERATION = 2, FVI_OBSERVE_FORCE = 4, FVI_OBSERVE_IMPULSE = 8,
       FVI_OBSERVE_WORK = 16, FVI_OBSERVE_ENERGY = 32, FVI_OBSERVE_APPLIED = 64, FVI_OBSERVE_MULTIPLIER = 128,
       FVI_OBSERVE_CONTACT = 256, FVI_OBSERVE_OWN_STEPS = 512 };
int fvi_observer_start(const fvi_stepper *s, unsigned wanted, fvi_observer **o, fvi_error *error);
size_t fvi_observer_dampers(const fvi_observer *o);
size_t fvi_observer_width(const fvi_observer *o, size_t j);
size_t fvi_observer_short_rows(const fvi_observer *o);
int fvi_observer_short_rows_beside(const fvi_method *method, const fvi_run *run, size_t i, size_t *rows);
void fvi_observer_free(fvi_observer *o);
typedef struct { double *v, *a, *force, *impulse, *work, *multiplier, *work_of_force, *balance; } observed;
int observe(fvi_observer *o, fvi_stepper *s, size_t rows, const double *t, const observed *to, size_t *done);
typedef struct {
    size_t d;
    int is_numbered;
    const struct fvi_mechanism *mechanism;
    int is_structure;
    const fvi_force *ground;
    size_t events;
    ...;
} fvi_column_source;
typedef struct fvi_typed_columns fvi_typed_columns;
int fvi_typed_columns_start(const fvi_column_source *source, fvi_typed_columns **columns, fvi_error *error);
void fvi_typed_columns_free(fvi_typed_columns *columns);
int fvi_parse_columns(const char *text, fvi_user_parameters *parameters, fvi_typed_columns *columns, fvi_error *error);
int fvi_parse_reductions(const char *text, fvi_user_parameters *parameters, fvi_typed_columns *columns,
                         fvi_error *error);
unsigned fvi_typed_columns_wanted(const fvi_typed_columns *columns);
size_t fvi_typed_columns_count(const fvi_typed_columns *columns);
const char *fvi_typed_column_name(const fvi_typed_columns *columns, size_t i);
size_t fvi_reductions_count(const fvi_typed_columns *columns);
const char *fvi_reduction_name(const fvi_typed_columns *columns, size_t i);
void fvi_reductions_values(const fvi_typed_columns *columns, double *values);
int table_of_run(fvi_typed_columns *c, fvi_observer *o, fvi_stepper *s, size_t rows, const double *t, double *values,
                 size_t *done);
size_t constraints(const fvi_system *system);
size_t imposed_on(const fvi_system *system, size_t i);
int rows_of_stepper(fvi_stepper *s, size_t rows, const double *t, double *x, double *p, row_count *count,
                    double seconds);
int save_stepper(fvi_stepper *s, unsigned char *to, size_t room, size_t *size);
int load_stepper(fvi_stepper *s, const unsigned char *from, size_t size);
int accelerations_of_ground(const fvi_ground *ground, size_t rows, const double *t, double *ag);
const char *damper_name(const fvi_system *system, size_t j);
int energies(const fvi_system *system, size_t rows, const double *t, const double *x, const double *p, double *energy,
             size_t *done);
int velocities(const fvi_system *system, size_t rows, const double *p, double *v);
int fvi_momentum_of_velocity(const fvi_system *system, double t, const double *x, const double *v, double *p);
void set_stop_flag(const int *flag);
int is_dense(const fvi_method *method);
extern "Python" int report_progress(size_t rows, size_t all, void *tell);
extern "Python" int report_event(const fvi_event_time *at, const double *x, const double *p, void *happened);
int take_steps(fvi_stepper *s, size_t count, const fvi_watch *watch, size_t *taken);
int warn_along_rows(fvi_watch *watch, const fvi_method *method, const fvi_run *run, size_t rows, const double *t,
                    const double *x, size_t size, char *text);
extern "Python" int check_signals(void);
extern "Python" int ask_value(size_t d, const double *x, void *params, double *value);
extern "Python" int ask_gradient(size_t d, const double *x, void *params, double *grad);
extern "Python" int ask_hessian(size_t d, const double *x, void *params, double *H);
extern "Python" int ask_force(double t, size_t d, void *params, double *F);
extern "Python" int ask_imposed(double t, void *function, double *u, double *rate);
extern "Python" int ask_quadratic(const void *params);
extern "Python" int ask_event(double t, size_t d, const double *x, const double *p, void *params, double *z);
extern "Python" int ask_normal(double t, size_t d, const double *x, void *params, double *normal, double *rate);
extern "Python" void ask_symbol(double re, double im, void *params, double *C_re, double *C_im);
