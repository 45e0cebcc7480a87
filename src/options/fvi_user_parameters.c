/* src/options/fvi_user_parameters.c -- Parameters of expressions: --let k=3. */
#include "fvi_user_parameters.h"

#include <fvi/error.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

int fvi_user_parameters_add(fvi_user_parameters *lets, const char *text, fvi_complaint c)
{
    const size_t used = strlen(lets->text), room = sizeof lets->text - used;
    const int length =
        snprintf(lets->text + used, room, "%s%s", used > 0 ? "," : "", text);
    return (size_t)length < room
               ? 0
               : fvi_refuse(c, "--let: '%s': too many parameters", text);
}

/* Notes which parameters an expression, which has been understood, speaks of. */
static void note(fvi_user_parameters *lets, const char *text, unsigned char by)
{
    static const char inside[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789."
                                 "abcdefghijklmnopqrstuvwxyz";
    while (*(text += strcspn(text, inside))) {
        const size_t length = strspn(text, inside);
        for (size_t i = 0; i < lets->count; i++)
            if (strlen(lets->name[i]) == length
                && strncmp(text, lets->name[i], length) == 0)
                lets->used[i] |= by;
        text += length;
    }
}

int fvi_user_parameters_parse(fvi_user_parameters *lets, const char *variable, size_t d,
                   const char *text, fvi_expression **e, fvi_misprint *wrong)
{
    const fvi_symbols names = { variable, d, lets->name, lets->count };
    int status = fvi_expression_parse(text, &names, lets->value, e, wrong);
    if (!status)
        note(lets, text, !variable ? 4 : *variable == 't' ? 2 : 1);
    return status;
}

int fvi_user_parameters_are_used(const fvi_user_parameters *lets, fvi_complaint c)
{
    for (size_t i = 0; i < lets->count; i++)
        if (!lets->used[i])
            return fvi_refuse(c, "--let: '%s' is in no expression",
                              lets->name[i]);
    return 0;
}

static int evaluate(fvi_user_parameters *lets, const char *text, double *value,
                    fvi_complaint c)
{
    fvi_misprint wrong;
    fvi_expression *e;
    int status = fvi_user_parameters_parse(lets, NULL, 0, text, &e, &wrong);
    if (status == FVI_ENOMEM) {
        fvi_refuse(c, "not enough memory");
        return 1;
    }
    if (status)
        return fvi_refuse_at(c, "let", text, wrong);
    *value = fvi_expression_value(e, NULL);
    fvi_expression_free(e);
    return isfinite(*value) ? 0
                            : fvi_refuse(c, "--let: '%s' is not finite", text);
}

/* The same name may come again with the same value. */
static int take(fvi_user_parameters *lets, const char *name, double value, fvi_complaint c)
{
    for (size_t i = 0; i < lets->count; i++)
        if (strcmp(name, lets->name[i]) == 0)
            return value == lets->value[i]
                       ? 0
                       : fvi_refuse(c, "--let: '%s' is given twice", name);
    if (lets->count == FVI_MOST_LETS)
        return fvi_refuse(c, "--let: '%s': too many parameters", name);
    lets->name[lets->count] = name;
    lets->value[lets->count++] = value;
    return 0;
}

int fvi_user_parameters_interpret(fvi_user_parameters *lets, fvi_complaint c)
{
    char *at = strcpy(lets->names, lets->text);
    for (char *next = at; next; at = next) {
        if ((next = strchr(at, ',')))
            *next++ = '\0';
        char *equals = strchr(at, '=');
        double value = 0;
        if (!equals)
            return fvi_refuse(c, "--let: '%s' is not NAME=VALUE", at);
        *equals = '\0';
        if (!fvi_symbol_is_free(at, "x") || !fvi_symbol_is_free(at, "t"))
            return fvi_refuse(c, "--let: '%s' is not a name for a parameter",
                              at);
        int status = evaluate(lets, equals + 1, &value, c);
        if (!status)
            status = take(lets, at, value, c);
        if (status)
            return status;
    }
    return 0;
}
