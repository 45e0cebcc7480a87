/* src/python/declarations/problem.h -- For cffi: potentials, forces, mechanisms, structures and columns as typed. */
typedef struct { size_t count; double value[64]; unsigned char used[64]; ...; } fvi_user_parameters;
size_t fvi_formulas_write(size_t size, char *text);
#define FVI_USED_BY_FORCE ...
#define FVI_USED_BY_DAMPING ...
#define FVI_USED_BY_MECHANISM ...
int fvi_user_parameters_set(fvi_user_parameters *parameters, const char *name, double value, fvi_error *error);
int fvi_user_parameters_are_used(const fvi_user_parameters *parameters, fvi_error *error);
typedef enum { FVI_POTENTIAL_HARMONIC, FVI_POTENTIAL_DUFFING, FVI_POTENTIAL_PENDULUM, FVI_POTENTIAL_CHAIN,
               FVI_POTENTIAL_EXPRESSION, ... } fvi_potential_kind;
typedef struct fvi_expression fvi_expression;
typedef struct { fvi_potential_kind kind; size_t d; double constants[2]; fvi_expression *expression;
} fvi_typed_potential;
int fvi_parse_potential(const char *text, size_t d, fvi_user_parameters *parameters, fvi_typed_potential *potential,
                        fvi_error *error);
fvi_potential fvi_potential_typed(const fvi_typed_potential *potential);
void fvi_typed_potential_free(fvi_typed_potential *potential);
fvi_kernel fvi_kernel_of_function(const fvi_kernel_function *function);
typedef struct { fvi_kernel law; fvi_kernel_function function; ...; } fvi_typed_damping;
int fvi_parse_damping(const char *text, fvi_user_parameters *parameters, fvi_typed_damping *damping, fvi_error *error);
int fvi_pair_is_exchanged(const fvi_user_parameters *parameters, size_t term, size_t terms);
void fvi_typed_damping_free(fvi_typed_damping *damping);
typedef struct fvi_typed_force fvi_typed_force;
typedef struct fvi_ground fvi_ground;
int fvi_parse_ground(const char *text, const fvi_system *system, const double *r, fvi_user_parameters *parameters,
                     double last, fvi_ground **ground, fvi_error *error);
int fvi_ground_alloc(const fvi_force *acceleration, const fvi_system *system, const double *r, fvi_ground **ground,
                     fvi_error *error);
fvi_force fvi_ground_force(const fvi_ground *ground);
const fvi_force *fvi_ground_acceleration(const fvi_ground *ground);
const fvi_typed_force *fvi_ground_typed(const fvi_ground *ground);
const double *fvi_ground_load_vector(const fvi_ground *ground);
void fvi_ground_free(fvi_ground *ground);
int fvi_parse_force(const char *text, size_t d, fvi_user_parameters *parameters, double last, fvi_typed_force **force,
                    fvi_error *error);
fvi_force fvi_force_typed(const fvi_typed_force *force);
int fvi_check_force(const fvi_method *method, double h, size_t steps, const char *field, const char *text,
                    const fvi_typed_force *force, fvi_error *error);
int fvi_check_start_velocity(const fvi_system *system, const double *x0, const double *v0, const double *p0,
                             fvi_error *error);
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
int fvi_parse_events(size_t count, const char *const *texts, size_t d, const double *mass,
                     fvi_user_parameters *parameters, fvi_typed_events **events, fvi_error *error);
void fvi_typed_events_of(fvi_typed_events *events, const struct fvi_mechanism *mechanism);
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
