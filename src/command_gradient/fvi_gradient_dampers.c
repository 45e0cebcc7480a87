/* src/command_gradient/fvi_gradient_dampers.c -- Compute `fvi gradient --of d1.force`: derivatives of the last force or
 * impulse of a damper. */
#include "fvi_gradient_dampers.h"

#include "options/fvi_words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef fvi_gradient_request request;

static const char *const quantities[] = { ".force", ".impulse" };

/* Return where ".force2" begins in the text, and which quantity it is. NULL if the text does not end with a
 * quantity. */
static const char *quantity_of(const char *text, size_t *which)
{
    const char *dot = text ? strrchr(text, '.') : NULL;
    for (*which = 0; dot && *which < 2; ++*which) {
        const size_t length = strlen(quantities[*which]);
        if (strncmp(dot, quantities[*which], length) == 0 && dot[length + strspn(dot + length, "0123456789")] == '\0')
            return dot;
    }
    return NULL;
}

int fvi_gradient_is_of_damper(const char *text)
{
    size_t which;
    return quantity_of(text, &which) != NULL;
}

/* Return the name of damper j. If it has none, write d1, d2, ... to `number`, which has `size` bytes. */
static const char *name_of(const request *r, size_t j, size_t size, char *number)
{
    const fvi_mechanism *m = r->system.mechanism;
    if (m && m->damper[j].name)
        return m->damper[j].name;
    snprintf(number, size, "d%zu", j + 1);
    return number;
}

/* Find r->i and r->of_dampers. `length` is the length of the damper's name in --of. `digits` is the text after the
 * quantity; it may be empty. */
static int find_place(request *r, const fvi_observer *o, size_t length, const char *digits, fvi_error *c)
{
    const char *text = r->words.own[OF];
    const size_t dampers = fvi_observer_dampers(o);
    char room[24];
    r->of_dampers = 0;
    int found = 0;
    for (size_t j = 0; j < dampers; j++) {
        const size_t width = fvi_observer_width(o, j);
        const char *name = name_of(r, j, sizeof room, room);
        size_t number = 1;
        if (strlen(name) == length && strncmp(name, text, length) == 0) {
            found = 1;
            if (width > 1 && !*digits)
                return fvi_refuse(c, "of", "'%s' of which coordinate? %s1 to %s%zu", text, text, text, width);
            if (*digits && fvi_parse_whole("of", digits, width, &number, c))
                return 2;
            r->i = r->of_dampers + number - 1;
        }
        r->of_dampers += width;
    }
    if (found)
        return 0;
    if (dampers == 0)
        return fvi_refuse(c, "of", "'%s': this system has no damper", text);
    return fvi_refuse(c, "of", "'%s': there is no damper '%.*s'; the first is %s", text, (int)length, text,
                      name_of(r, 0, sizeof room, room));
}

int fvi_gradient_find_damper(request *r, fvi_error *c)
{
    const char *text = r->words.own[OF];
    size_t which;
    const char *dot = quantity_of(text, &which);
    fvi_stepper *s = NULL;
    fvi_observer *o = NULL;
    fvi_error error = { 0 };
    if (r->o.method->dense)
        return fvi_refuse(c, "of", "'%s': %s has no derivatives of the forces of dampers; fvi-lobatto2 to 8d, "
                          "fvi-stable and the others whose steps have one length have", text, r->o.method->name);
    r->of = 3 + which;
    int status = fvi_stepper_start(r->o.method, &r->run, &s, &error);
    if (!status)
        status = fvi_observer_start(s, which == 0 ? FVI_OBSERVE_FORCE : FVI_OBSERVE_IMPULSE, &o, &error);
    int failed = status ? 0 : find_place(r, o, (size_t)(dot - text), dot + strlen(quantities[which]), c);
    if (!status && !failed && fvi_observer_short_rows(o) >= r->o.steps)
        failed = fvi_refuse(c, "of", "'%s': the forces of the first %zu rows come from steps shorter than those of the "
                            "run and have no derivatives; take more --steps, or '%.*s.impulse'", text,
                            fvi_observer_short_rows(o), (int)(dot - text), text);
    fvi_observer_free(o);
    fvi_stepper_free(s);
    return failed; /* a run that does not start is refused later, with its reason */
}

/* Compute the value of the last row. */
static int last_value(request *r)
{
    fvi_stepper *s = NULL;
    fvi_observer *o = NULL;
    fvi_observation now;
    int status = fvi_stepper_start(r->o.method, &r->run, &s, NULL);
    if (!status)
        status = fvi_observer_start(s, r->of == 3 ? FVI_OBSERVE_FORCE : FVI_OBSERVE_IMPULSE, &o, NULL);
    while (!status && s->k < r->o.steps)
        status = fvi_observer_step(o, s);
    if (!status)
        status = fvi_observer_read(o, s, s->t, &now);
    if (!status)
        r->value = (r->of == 3 ? now.force : now.impulse)[r->i];
    fvi_observer_free(o);
    fvi_stepper_free(s);
    return status;
}

int fvi_gradient_is_short_beside(const request *r, size_t i)
{
    size_t rows = 0;
    return r->of == 3 && !fvi_observer_short_rows_beside(r->o.method, &r->run, i, &rows) && rows >= r->o.steps;
}

int fvi_gradient_of_damper(request *r, const fvi_objective *objective)
{
    const size_t n = r->of_dampers;
    double *rows = calloc((r->o.steps + 1) * n + 1, sizeof *rows);
    if (!rows)
        return FVI_ENOMEM;
    rows[r->o.steps * n + r->i] = 1;
    int status = last_value(r);
    if (!status)
        status = fvi_adjoint_forces(r->o.method, &r->run, objective, r->of == 3 ? rows : NULL, r->of == 4 ? rows : NULL,
                                    &r->to);
    for (size_t i = 0; !status && r->to.x0 && i < r->o.d; i++)
        if (fvi_gradient_is_short_beside(r, i))
            r->to.x0[i] = NAN;
    free(rows);
    return status;
}
