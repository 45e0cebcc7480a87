/* src/problem/user_parameters.c -- Parse the parameters of expressions, such as k=3,c=2*k. */
#include "words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- expressions ---- */

enum { SHOWN = 60, AHEAD = 40 };

/* Write an error such as "'x^^2': a number, a name or ( is wanted here", with a caret below the place. Of a long text
 * only the part around the place is shown. */
static int refuse_misprint(const char *field, const char *text,
                           fvi_misprint wrong, fvi_error *error)
{
    const size_t length = strlen(text);
    const size_t from =
        length > SHOWN && wrong.at > AHEAD ? wrong.at - AHEAD : 0;
    const char *front = from > 0 ? "..." : "",
               *back = length - from > SHOWN ? "..." : "";
    fvi_refuse(error, field, "'%s%.*s%s': %s", front, SHOWN, text + from, back, wrong.reason);
    if (!error)
        return FVI_EINVAL;
    error->index = wrong.at;
    const size_t end = strlen(error->text),
                 column = 1 + strlen(front) + wrong.at - from;
    if (length > 0 && end + column + 3 < sizeof error->text)
        snprintf(error->text + end, sizeof error->text - end, "\n%*s^",
                 (int)column, "");
    return FVI_EINVAL;
}

/* Note which parameters are used by an expression that has been parsed. */
static void mark_used_parameters(fvi_user_parameters *parameters, const char *text,
                                 unsigned char by)
{
    static const char inside[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789."
                                 "abcdefghijklmnopqrstuvwxyz";
    while (*(text += strcspn(text, inside))) {
        const size_t length = strspn(text, inside);
        for (size_t i = 0; i < parameters->count; i++)
            if (strlen(parameters->name[i]) == length
                && strncmp(text, parameters->name[i], length) == 0)
                parameters->used[i] |= by;
        text += length;
    }
}

enum { NO_STATE = -1 };

/* Parse an expression. Its names are those of the finder, or of one variable, or of a state with or without velocities.
 * Note which parameters it uses. */
static int parse(const char *field, const fvi_name_finder *finder, const char *variable, size_t d, int velocities,
                 const char *text, unsigned char by, fvi_user_parameters *parameters, fvi_expression **e,
                 fvi_error *error)
{
    static fvi_user_parameters none;
    fvi_misprint wrong;
    const fvi_user_parameters *known = parameters ? parameters : &none;
    const fvi_symbols names = { variable, d, known->name, known->count };
    const int status = finder ? fvi_expression_parse_of(text, finder, &names, known->value, e, &wrong)
                       : velocities == NO_STATE ? fvi_expression_parse(text, &names, known->value, e, &wrong)
                       : fvi_expression_parse_state(text, &names, velocities, known->value, e, &wrong);
    if (!status && parameters)
        mark_used_parameters(parameters, text, by);
    return status == FVI_EINVAL ? refuse_misprint(field, text, wrong, error)
           : status ? fvi_fail(error, status, field, NAN, "not enough memory")
                    : FVI_SUCCESS;
}

int fvi_parse_expression_of(const char *field, const fvi_name_finder *finder,
                            const char *text, fvi_user_parameters *parameters,
                            fvi_expression **e, fvi_error *error)
{
    return parse(field, finder, NULL, 0, NO_STATE, text, FVI_USED_BY_COLUMN, parameters, e, error);
}

int fvi_parse_expression(const char *field, const char *variable, size_t d,
                         const char *text, fvi_user_parameters *parameters,
                         fvi_expression **e, fvi_error *error)
{
    const unsigned char by =
        !variable                      ? FVI_USED_BY_PARAMETER
        : strcmp(field, "impose") == 0 ? FVI_USED_BY_MECHANISM | FVI_USED_BY_CONSTRAINT
        : *variable == 't' ? FVI_USED_BY_FORCE
        : *variable == 's' ? FVI_USED_BY_DAMPING
                           : FVI_USED_BY_POTENTIAL;
    return parse(field, NULL, variable, d, NO_STATE, text, by, parameters, e, error);
}

int fvi_parse_state_expression(const char *field, size_t d, int velocities,
                               const char *text,
                               fvi_user_parameters *parameters,
                               fvi_expression **e, fvi_error *error)
{
    for (size_t i = 0; velocities && parameters && i < parameters->count; i++)
        if (!fvi_symbol_is_free(parameters->name[i], "v"))
            return fvi_fail(error, FVI_EINVAL, "let", parameters->value[i],
                            "'%s' is a velocity in '%s'", parameters->name[i], text);
    const unsigned char by = strcmp(field, "lagrangian") == 0   ? FVI_USED_BY_POTENTIAL
                             : strcmp(field, "constraint") == 0 ? FVI_USED_BY_MECHANISM | FVI_USED_BY_CONSTRAINT
                                                                : FVI_USED_BY_MECHANISM;
    return parse(field, NULL, "x", d, velocities, text, by, parameters, e, error);
}

/* ---- parameters ---- */

int fvi_user_parameters_are_used(const fvi_user_parameters *parameters,
                                 fvi_error *error)
{
    for (size_t i = 0; i < parameters->count; i++)
        if (!parameters->used[i])
            return fvi_fail(error, FVI_EINVAL, "let", parameters->value[i],
                            "'%s' is in no expression", parameters->name[i]);
    return FVI_SUCCESS;
}

int fvi_user_parameters_set(fvi_user_parameters *parameters, const char *name,
                            double value, fvi_error *error)
{
    if (!parameters || !name)
        return fvi_fail(error, FVI_EFAULT, "let", NAN, "null pointer");
    if (!fvi_symbol_is_free(name, "x") || !fvi_symbol_is_free(name, "t"))
        return fvi_fail(error, FVI_EINVAL, "let", value, "'%s' is not a name for a parameter", name);
    if (!isfinite(value))
        return fvi_fail(error, FVI_EDOM, "let", value, "'%s' is not finite", name);
    size_t room = sizeof parameters->names;
    char *place = parameters->names;
    for (size_t i = 0; i < parameters->count; i++) {
        if (strcmp(name, parameters->name[i]) == 0)
            return value == parameters->value[i]
                       ? FVI_SUCCESS
                       : fvi_fail(error, FVI_EINVAL, "let", value, "'%s' is given twice", name);
        room -= strlen(place) + 1;
        place += strlen(place) + 1;
    }
    if (parameters->count == FVI_MOST_USER_PARAMETERS || strlen(name) >= room)
        return fvi_fail(error, FVI_EINVAL, "let", value, "'%s': too many parameters", name);
    parameters->name[parameters->count] = strcpy(place, name);
    parameters->value[parameters->count++] = value;
    return FVI_SUCCESS;
}

/* Parse "NAME=VALUE", where VALUE is an expression of the names before. */
static int parse_one(char *text, fvi_user_parameters *parameters,
                     fvi_error *error)
{
    char *equals = strchr(text, '=');
    if (!equals)
        return fvi_refuse(error, "let", "'%s' is not NAME=VALUE", text);
    *equals = '\0';
    const char *value = equals + 1;
    if (!fvi_symbol_is_free(text, "x") || !fvi_symbol_is_free(text, "t"))
        return fvi_user_parameters_set(parameters, text, 0, error);
    fvi_expression *e;
    int status =
        fvi_parse_expression("let", NULL, 0, value, parameters, &e, error);
    if (status)
        return status;
    const double number = fvi_expression_value(e, NULL);
    fvi_expression_free(e);
    if (!isfinite(number))
        return fvi_fail(error, FVI_EDOM, "let", number, "'%s' is not finite", value);
    return fvi_user_parameters_set(parameters, text, number, error);
}

int fvi_parse_user_parameters(const char *text,
                              fvi_user_parameters *parameters,
                              fvi_error *error)
{
    char copy[sizeof parameters->names];
    if (!text || !parameters)
        return fvi_fail(error, FVI_EFAULT, "let", NAN, "null pointer");
    if (strlen(text) >= sizeof copy)
        return fvi_refuse(error, "let", "'%s': too many parameters", text);
    int status = FVI_SUCCESS;
    for (char *at = strcpy(copy, text), *next = at; next && !status; at = next) {
        next = at + fvi_list_item(at);
        next = *next ? next : NULL;
        if (next)
            *next++ = '\0';
        status = parse_one(at, parameters, error);
    }
    return status;
}
