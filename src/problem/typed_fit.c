/* src/problem/typed_fit.c -- Parse the sensors and parameters of a fit. [H 24] */
#include <fvi/typed_fit.h>

#include "estimation/identification_model.h"
#include "words.h"

#include <fvi/dampers.h>
#include <fvi/parse.h>
#include <fvi/rheology.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A dictionary of the names of all parameters of a fit, with their meanings. */
enum { LETTERS = 100 };
typedef struct {
    size_t count, room;
    char (*name)[LETTERS];
    fvi_free_parameter *which;
} dictionary;

static int add(dictionary *d, const char *name, size_t which)
{
    if (d->count == d->room) {
        const size_t room = 2 * d->room + 32;
        char (*names)[LETTERS] = realloc(d->name, room * sizeof *names);
        d->name = names ? names : d->name;
        fvi_free_parameter *meanings = realloc(d->which, room * sizeof *meanings);
        d->which = meanings ? meanings : d->which;
        if (!names || !meanings)
            return FVI_ENOMEM;
        d->room = room;
    }
    snprintf(d->name[d->count], LETTERS, "%s", name);
    d->which[d->count++] = (fvi_free_parameter)which;
    return FVI_SUCCESS;
}

/* ---- laws ---- */

/* The positions of a law's terms among all terms that were parsed. */
typedef struct {
    const fvi_user_parameters *parameters;
    size_t first, terms;
} places;

/* Add the names of a law's parameters: d1.rho, d1.alpha; or d1.zener2.alpha for the second term of a sum. A law that is
 * a function of s has no parameters but those of its expression. */
static int add_law(dictionary *d, const char *damper, const fvi_kernel *law, size_t index,
                   const places *of)
{
    int status = FVI_SUCCESS;
    for (size_t term = 0; law && term < law->count && !status; term++) {
        if (law->term[term].kind == FVI_KERNEL_SYMBOL)
            return FVI_SUCCESS;
        const fvi_element kind = fvi_element_of(&law->term[term]);
        char place[LETTERS], name[2 * LETTERS];
        const char *number;
        const int is_exchanged = fvi_pair_is_exchanged(of->parameters, of->first + term, of->terms);
        snprintf(place, sizeof place, "%.60s", damper);
        if (law->count > 1)
            snprintf(place, sizeof place, "%.60s.%s%zu", damper, fvi_element_words[kind], term + 1);
        for (size_t i = 0, field; !status && (number = fvi_element_number_typed(kind, i, is_exchanged, &field)); i++) {
            snprintf(name, sizeof name, "%s.%s", place, number);
            status = add(d, name, FVI_FREE_PARAMETER_LAW + 4 * term + field
                                      + index * FVI_FREE_PARAMETER_EACH);
        }
    }
    return status;
}

static int add_laws(dictionary *d, const fvi_run *run, const fvi_user_parameters *parameters)
{
    const fvi_mechanism *mechanism = run->system->mechanism;
    places of = { parameters, 0, run->law ? run->law->count : 0 };
    for (size_t k = 0; mechanism && k < mechanism->damper_count; k++)
        of.terms += mechanism->damper[k].kernel->count;
    int status = add_law(d, "d1", run->law, 0, &of);
    for (size_t k = 0; mechanism && k < mechanism->damper_count && !status; k++) {
        char number[LETTERS];
        const char *name = mechanism->damper[k].name;
        snprintf(number, sizeof number, "d%zu", k + 1);
        status = add_law(d, name ? name : number, mechanism->damper[k].kernel, k + 1, &of);
        of.first += mechanism->damper[k].kernel->count;
    }
    return status;
}

/* ---- sensors, and all others ---- */

static int add_sensors(dictionary *d, const fvi_free_parameter_names *names)
{
    static const char *const words[] = { "offset", "drift" };
    int status = FVI_SUCCESS;
    for (size_t w = 0; w < 2 && !status; w++) {
        const size_t which = FVI_FREE_PARAMETER_OFFSET + w;
        status = add(d, words[w], which);
        for (size_t c = 0; c < names->columns && names->column && !status; c++) {
            char name[LETTERS];
            snprintf(name, sizeof name, "%s.%.80s", words[w], names->column[c]);
            status = add(d, name, which + (c + 1) * FVI_FREE_PARAMETER_EACH);
        }
    }
    return status;
}

static int list_parameters(dictionary *d, const fvi_free_parameter_names *names)
{
    const fvi_run *run = names->run;
    const int has_laws = run->law || run->system->mechanism, is_matrix = run->system->matrices != NULL;
    int status = add_laws(d, run, names->parameters);
    if (!status && !has_laws)
        status = add(d, "alpha", FVI_FREE_PARAMETER_ALPHA);
    if (!status && !has_laws && !is_matrix)
        status = add(d, "rho", FVI_FREE_PARAMETER_RHO);
    if (!status && !is_matrix)
        status = add(d, "mass", FVI_FREE_PARAMETER_MASS);
    if (!status)
        status = add(d, "x0", FVI_FREE_PARAMETER_X0);
    if (!status)
        status = add(d, "p0", FVI_FREE_PARAMETER_P0);
    if (!status)
        status = add_sensors(d, names);
    for (size_t i = 0; i < names->constants && !status; i++)
        status = add(d, names->constant[i], FVI_FREE_PARAMETER_CONSTANT + i);
    return status;
}

/* Return the number after the last _ of a name such as "x0_3", from 1 to d, and the letters before it. Return 0 if
 * there is none. */
static size_t number_of(const char *text, size_t d, char stem[LETTERS])
{
    const char *bar = strrchr(text, '_');
    char *end;
    if (!bar || bar[1] < '1' || bar[1] > '9' || (size_t)(bar - text) >= LETTERS)
        return 0;
    const unsigned long i = strtoul(bar + 1, &end, 10);
    snprintf(stem, LETTERS, "%.*s", (int)(bar - text), text);
    return *end == '\0' && i <= d ? i : 0;
}

static int find_name(const dictionary *d, const char *name, fvi_free_parameter *which)
{
    for (size_t i = 0; i < d->count; i++)
        if (strcmp(d->name[i], name) == 0) {
            *which = d->which[i];
            return 1;
        }
    return 0;
}

static int find_parameter(const char *field, const char *text, const fvi_run *run, const dictionary *d,
                          fvi_free_parameter *which, fvi_error *error)
{
    char stem[LETTERS];
    size_t place;
    if (find_name(d, text, which))
        return FVI_SUCCESS;
    const size_t i = number_of(text, run->system->d, stem);
    if (i > 0 && find_name(d, stem, which) && *which >= FVI_FREE_PARAMETER_RHO
        && *which <= FVI_FREE_PARAMETER_P0) {
        *which = (fvi_free_parameter)(*which + i * FVI_FREE_PARAMETER_EACH);
        return FVI_SUCCESS;
    }
    if ((run->law || run->system->mechanism)
        && (strcmp(text, "alpha") == 0 || strcmp(text, "rho") == 0))
        return fvi_refuse(error, field, "'%s': with a law of damping the numbers are those of the law, %s and so on",
                        text, d->name[0]);
    const char **known = malloc((d->count + 1) * sizeof *known);
    if (!known)
        return fvi_no_memory(error, field);
    for (size_t k = 0; k < d->count; k++)
        known[k] = d->name[k];
    known[d->count] = NULL;
    /* fvi_parse_word also finds names in capitals, and proposes a near name. */
    const int status = fvi_parse_word(field, text, known, &place, error);
    if (!status)
        *which = d->which[place];
    free(known);
    return status;
}

/* Return nonzero if a constraint contains this constant. */
static int is_constrained(const fvi_free_parameter_names *names, size_t constant)
{
    const fvi_user_parameters *of = names->parameters;
    for (size_t i = 0; of && i < of->count; i++)
        if (of->used[i] & FVI_USED_BY_CONSTRAINT && strcmp(of->name[i], names->constant[constant]) == 0)
            return 1;
    return 0;
}

/* Refuse a parameter if the run contains numbers that were computed from it and would keep their old values. */
static int check_can_change(const char *field, const char *text, const fvi_free_parameter_names *names,
                            fvi_free_parameter which, fvi_error *error)
{
    const fvi_mechanism *mechanism = names->run->system->mechanism;
    const size_t base = (size_t)which % FVI_FREE_PARAMETER_EACH;
    const int is_mass = base == FVI_FREE_PARAMETER_MASS,
              is_start = base == FVI_FREE_PARAMETER_X0 || base == FVI_FREE_PARAMETER_P0;
    if (is_mass && names->has_ground)
        return fvi_refuse(error, field, "'%s': the ground pulls each mass by -m a_g, and would keep the old one", text);
    if (is_mass && mechanism && mechanism->lagrangian)
        return fvi_refuse(error, field, "'%s': the masses are those of the Lagrangian", text);
    if ((is_mass || base == FVI_FREE_PARAMETER_P0)
        && fvi_estimation_has_massless(names->run->system, (size_t)which / FVI_FREE_PARAMETER_EACH))
        return fvi_refuse(error, field, "'%s': a coordinate without inertia has no other mass, and no momentum", text);
    if (((is_mass || is_start) && mechanism && mechanism->constraints)
        || (base >= FVI_FREE_PARAMETER_CONSTANT && is_constrained(names, base - FVI_FREE_PARAMETER_CONSTANT)))
        return fvi_refuse(error, field, "'%s': with another one the start breaks a constraint", text);
    return FVI_SUCCESS;
}

int fvi_parse_free_parameter(const char *field, const char *text,
                             const fvi_free_parameter_names *names, fvi_free_parameter *which,
                             fvi_error *error)
{
    dictionary d = { .count = 0 };
    if (!text || !names || !names->run || !names->run->system || !which)
        return fvi_fail(error, FVI_EFAULT, field, NAN, "null pointer");
    int status = list_parameters(&d, names);
    if (status)
        fvi_fail(error, status, field, NAN, "not enough memory");
    else
        status = find_parameter(field, text, names->run, &d, which, error);
    if (!status)
        status = check_can_change(field, text, names, *which, error);
    free(d.name);
    free(d.which);
    return status;
}

const char *fvi_free_parameters_of_laws(const fvi_run *run, size_t most, size_t size, char *text)
{
    dictionary d = { .count = 0 };
    size_t length = 0;
    *text = '\0';
    if (!add_laws(&d, run, NULL))
        for (size_t i = 0; i < d.count && i < most && length < size; i++)
            length += (size_t)snprintf(text + length, size - length, "%s%s", i ? "," : "",
                                       d.name[i]);
    free(d.name);
    free(d.which);
    return *text ? text : "alpha,rho";
}

/* ---- what a column shows ---- */

int fvi_parse_sensor(const char *field, const char *text, size_t d,
                     fvi_user_parameters *parameters, char name[FVI_SENSOR_ROOM],
                     fvi_expression **shows, fvi_error *error)
{
    if (!text || !name || !shows)
        return fvi_fail(error, FVI_EFAULT, field, NAN, "null pointer");
    const char *equals = strchr(text, '=');
    const size_t length = equals ? (size_t)(equals - text) : strlen(text);
    if (length == 0 || length >= FVI_SENSOR_ROOM)
        return fvi_refuse(error, field, "'%s' has no name, or a long one: write NAME=EXPRESSION", text);
    const int status = fvi_parse_state_expression(field, d, 1, equals ? equals + 1 : text,
                                                  parameters, shows, error);
    if (!status)
        snprintf(name, FVI_SENSOR_ROOM, "%.*s", (int)length, text);
    return status;
}
