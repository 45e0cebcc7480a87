/* src/python/declarations/analysis.h -- For cffi: responses, fits, exact motions, gradients, control. */
typedef struct { const fvi_system *system; double alpha; const fvi_kernel *law; const double *at, *along; ...;
} fvi_linear_motion;
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
int fvi_kernel_takes_caputo(const fvi_kernel *law);
int fvi_kernel_moduli(const fvi_kernel *law, double omega, double *storage, double *loss);
typedef struct {
    double alpha, kappa, T, damping, lipschitz, gradient, variation, start, speed, acceleration, velocity_variation,
           room;
    ...;
} fvi_smoothness;
typedef struct { double C, lambda, h; } fvi_error_bound;
int fvi_error_bound_compute(const fvi_smoothness *motion, fvi_error_bound *bound);
int fvi_position_bound_compute(const fvi_smoothness *motion, fvi_error_bound *bound);
int fvi_stability_number(const fvi_method *method, const fvi_run *run, double *load);
int fvi_stability_longest_step(const fvi_method *method, const fvi_run *run, double *h);
typedef struct { double cost, miss, change; size_t iterations; ...; } fvi_control_result;
int fvi_control_solve(const fvi_method *method, const fvi_run *run, const double *x, const double *p, double *u,
                      fvi_control_result *found);
typedef struct { size_t n, columns; const double *t, *F; ...; } fvi_force_rows;
fvi_force fvi_force_table(const fvi_force_rows *rows);

typedef enum { FVI_FREE_PARAMETER_ALPHA, FVI_FREE_PARAMETER_RHO, FVI_FREE_PARAMETER_MASS, FVI_FREE_PARAMETER_X0,
               FVI_FREE_PARAMETER_P0, FVI_FREE_PARAMETER_CONSTANT, FVI_FREE_PARAMETER_EACH, ... } fvi_free_parameter;
enum { FVI_MEASURED_MOST = 8, FVI_SENSOR_ROOM = 64 };
typedef struct { const double *x; double sigma; const fvi_expression *shows; } fvi_measured;
typedef struct {
    size_t n;
    const double *t;
    const fvi_measured *measured;
    const double *x0, *p0;
    const fvi_force *force;
} fvi_record;
typedef struct {
    const fvi_run *run;
    size_t columns;
    const char *const *column;
    size_t constants;
    const char *const *constant;
    const fvi_user_parameters *parameters;
    int has_ground;
} fvi_free_parameter_names;
int fvi_parse_sensor(const char *field, const char *text, size_t d, fvi_user_parameters *parameters, char *name,
                     fvi_expression **shows, fvi_error *error);
void fvi_expression_free(fvi_expression *e);
int fvi_parse_free_parameter(const char *field, const char *text, const fvi_free_parameter_names *names,
                             fvi_free_parameter *which, fvi_error *error);
const char *fvi_free_parameters_of_laws(const fvi_run *run, size_t most, size_t size, char *text);
enum { FVI_ESTIMATION_MOST = 8, FVI_EDOM = 1, FVI_EINVAL = 4, FVI_ENOMEM = 8, FVI_EBADFUNC = 9, FVI_ERUNAWAY = 10,
    FVI_EMAXITER = 11, FVI_ETOL = 14, FVI_EOVRFLW = 16, FVI_ESING = 21, FVI_EUNSUP = 23 };
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
    size_t records, columns;
    const fvi_record *record;
    double huber;
    ...;
} fvi_estimation;
int fvi_check_force_of_fit(const fvi_estimation *fit, const char *field, const char *text,
                           const fvi_typed_force *force, fvi_error *error);
typedef struct {
    double estimate[8], sd[8], correlation[8][8];
    double quantile, sigma, chi2, probability, neighbours;
    size_t agree;
    double h, bias, reached;
    double column_sigma[8];
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
const fvi_method *fvi_estimate_method(const fvi_estimation *fit);
typedef enum { FVI_MATERIAL_MODULI, FVI_MATERIAL_CREEP, FVI_MATERIAL_RELAXATION } fvi_material_test;
typedef enum { FVI_ELEMENT_SPRING, FVI_ELEMENT_POWER, ... } fvi_element;
fvi_element fvi_element_of(const fvi_kernel_term *term);
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
typedef struct { double x, v; } fvi_spring_bound;
int fvi_spring_bound_compute(const fvi_linear_oscillator *problem, size_t stages, size_t n, const double *h, double eps,
                             fvi_spring_bound *bound, fvi_error *error);
typedef struct {
    fvi_linear_motion motion;
    const double *x0, *p0;
    fvi_forcing forcing;
    double A, T, w;
} fvi_exact_problem;
typedef struct fvi_exact_motion fvi_exact_motion;
typedef struct { double *x, *v, *a, *force, *impulse; } fvi_exact_outputs;
int fvi_exact_motion_alloc(const fvi_exact_problem *problem, fvi_exact_motion **motion, fvi_error *error);
size_t fvi_exact_motion_forces(const fvi_exact_motion *motion);
int fvi_exact_motion_forces_at(fvi_exact_motion *motion, double t, double first, const fvi_exact_outputs *out,
                               fvi_error *error);
void fvi_exact_motion_free(fvi_exact_motion *motion);

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
typedef struct { size_t count; ...; } fvi_mechanism_columns;
fvi_mechanism_columns fvi_typed_mechanism_columns(const fvi_typed_mechanism *mechanism, size_t count);
typedef struct {
    double *x0, *p0, *mass, *damping, *alpha, *terms, *orders, *times, *ends, *force, *parameters;
    fvi_parameter_gradient sensitivity;
    int (*lagrangian)(size_t j, double t, size_t d, const double *x, const double *v, void *params, double *Sx,
                      double *Sv);
    double *names;
    const fvi_mechanism_columns *columns;
    ...;
} fvi_sensitivities;
int fvi_typed_lagrangian_column(size_t j, double t, size_t d, const double *x, const double *v, void *params,
                                double *Sx, double *Sv);
int fvi_directional_derivatives(const fvi_method *method, const fvi_run *run, size_t count,
                                const fvi_sensitivities *along, double *x, double *p, double *dx, double *dp);
int fvi_adjoint(const fvi_method *method, const fvi_run *run, const double *x, const double *p,
                const fvi_objective *objective, const fvi_sensitivities *gradients);
int fvi_adjoint_forces(const fvi_method *method, const fvi_run *run, const fvi_objective *objective,
                       const double *force, const double *impulse, const fvi_sensitivities *gradients);
double fvi_typed_force_by_parameter(const fvi_typed_force *force, size_t j, double t);
double fvi_lobatto_abscissa(size_t s, size_t i);
int positions_within(fvi_stepper *s, size_t count, const double *t, double *x, double *p);
int fvi_tangent(const fvi_run *run, size_t P, const fvi_free_parameter *which, double *x, double *slope);
