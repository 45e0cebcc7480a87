/* src/problem/typed_mechanism.c -- Parse mechanisms, such as x2-x1 : power:0.4,0.3. [H 29] */
#include "typed_mechanism.h"

#include <fvi/format_double.h>

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- pieces of a text ---- */

/* Return the length of "NAME=" before an elongation, 0 if there is no name. */
static size_t name_length(const char *text)
{
    size_t n = strspn(text, " \t\n"), from = n;
    while (isalnum((unsigned char)text[n]) || text[n] == '_')
        n++;
    if (n == from || isdigit((unsigned char)text[from]))
        return 0;
    n += strspn(text + n, " \t\n");
    return text[n] == '=' ? n + 1 : 0;
}

size_t fvi_largest_index(const char *text)
{
    size_t most = 0;
    for (const char *at = text; *at; at++) {
        const int inside =
            at > text && (isalnum((unsigned char)at[-1]) || at[-1] == '_');
        if ((*at != 'x' && *at != 'v') || inside)
            continue;
        char *end = (char *)at + 1;
        const size_t i = isdigit((unsigned char)at[1])
                             ? strtoul(at + 1, &end, 10)
                             : 1;
        if (!isalnum((unsigned char)*end) && *end != '_' && i > most)
            most = i;
    }
    return most;
}

/* ---- dampers ---- */

static int parse_law(fvi_typed_damper *damper, const char *text,
                     fvi_user_parameters *parameters, fvi_error *error)
{
    char *law = fvi_trimmed_copy(text, strlen(text)), *colon = law ? strstr(law, " : ") : NULL;
    size_t past = 0;
    int status = law ? FVI_SUCCESS : fvi_no_memory(error, "damper");
    if (colon) {
        char *word = fvi_trimmed_copy(colon + 3, strlen(colon + 3));
        status = word ? fvi_parse_word("damper", word, fvi_initial_history_words,
                                       &past, error)
                      : fvi_no_memory(error, "damper");
        free(word);
        while (colon > law && colon[-1] == ' ')
            colon--;
        *colon = '\0';
    }
    damper->past = (fvi_initial_history)past;
    if (!status)
        status = fvi_parse_damping(law, parameters, &damper->law, error);
    free(law);
    if (status && error)
        error->field = "damper";
    return status;
}

/* Check that no damper before number `count` has its name. A damper without a name is called d1, d2, ... by its
 * place. */
static int check_damper_name(const fvi_typed_damper *damper, size_t count, const fvi_typed_damper *others,
                             fvi_error *error)
{
    char mine[24], place[24];
    snprintf(mine, sizeof mine, "d%zu", count + 1);
    const char *name = damper->name ? damper->name : mine;
    for (size_t i = 0; i < count; i++) {
        snprintf(place, sizeof place, "d%zu", i + 1);
        if (strcmp(others[i].name ? others[i].name : place, name) == 0)
            return fvi_refuse(error, "damper", "'%s' is the name of two dampers%s", name,
                              damper->name && others[i].name ? "" : ": one without a name is called so by its place");
    }
    return FVI_SUCCESS;
}

int fvi_parse_damper(const char *text, size_t count, const fvi_typed_damper *others,
                     fvi_user_parameters *parameters, fvi_typed_damper *damper, char **of,
                     fvi_error *error)
{
    const size_t named = name_length(text);
    const char *g = text + named, *colon = strstr(g, " : ");
    *of = NULL;
    if (!colon)
        return fvi_refuse(error, "damper", "'%s' is not '[NAME=] G : LAW [: PAST]', with blanks around the colons",
                          text);
    damper->name = named ? fvi_trimmed_copy(text, named - 1) : NULL;
    *of = fvi_trimmed_copy(g, (size_t)(colon - g));
    if (!*of || (named && !damper->name))
        return fvi_no_memory(error, "damper");
    const int status = check_damper_name(damper, count, others, error);
    return status ? status : parse_law(damper, colon + 3, parameters, error);
}

void fvi_typed_damper_free(fvi_typed_damper *damper)
{
    fvi_expression_free(damper->of.e);
    fvi_typed_damping_free(&damper->law);
    free(damper->name);
}

static int parse_damper(fvi_typed_mechanism *m, size_t j, const char *text,
                        fvi_user_parameters *parameters, fvi_error *error)
{
    fvi_typed_damper *damper = &m->typed[j];
    char *of;
    int status = fvi_parse_damper(text, j, m->typed, parameters, damper, &of, error);
    if (!status)
        status = fvi_parse_state_expression("damper", m->d, 0, of, parameters,
                                            &damper->of.e, error);
    if (!status && fvi_largest_index(of) == 0)
        status = fvi_refuse(error, "damper", "'%s' speaks of no coordinate: nothing is damped", of);
    free(of);
    m->damper[j] = (fvi_damper){
        .name = damper->name,
        .of = fvi_elongation_of_text(&damper->of),
        .kernel = &damper->law.law,
        .past = damper->past,
    };
    return status;
}

/* ---- constraints ---- */

/* Parse "x1=EXPRESSION", which becomes the constraint x1-(EXPRESSION) = 0. The expression may contain only t. */
static int parse_imposed(fvi_typed_mechanism *m, size_t i, const char *text,
                         fvi_user_parameters *parameters, fvi_error *error)
{
    const char *equals = strchr(text, '=');
    char *name = equals ? fvi_trimmed_copy(text, (size_t)(equals - text)) : NULL;
    const int is_x_alone = name && strcmp(name, "x") == 0 && m->d == 1;
    const size_t of = is_x_alone                ? 0
                      : name && *name == 'x' ? fvi_scan_index(name + 1, strlen(name + 1), m->d)
                                             : m->d;
    free(name);
    if (of == m->d)
        return fvi_refuse(error, "impose", "'%s' is not xI=EXPRESSION in t, I from 1 to %zu", text, m->d);
    m->constraint[i] = (fvi_typed_expression){ NULL, of + 1 };
    return fvi_parse_expression("impose", "t", 1, equals + 1, parameters,
                                &m->constraint[i].e, error);
}

/* ---- forces ---- */

static int parse_force_on(fvi_typed_mechanism *m, size_t i, const char *text,
                          fvi_user_parameters *parameters, fvi_error *error)
{
    char *end;
    const char *from = text + strspn(text, " x");
    const size_t on =
        isdigit((unsigned char)*from) ? strtoul(from, &end, 10) : 0;
    if (on < 1 || on > m->d || end[strspn(end, " ")] != '=')
        return fvi_refuse(error, "force-on", "'%s' is not I=F, I from 1 to %zu", text, m->d);
    m->force[i] = (fvi_typed_expression){ NULL, on };
    return fvi_parse_state_expression("force-on", m->d, 1, strchr(end, '=') + 1,
                                      parameters, &m->force[i].e, error);
}

/* ---- all of it ---- */

static int parse_all(fvi_typed_mechanism *m, const fvi_mechanism_texts *texts,
                     fvi_user_parameters *parameters, fvi_error *error)
{
    int status = FVI_SUCCESS;
    if (texts->lagrangian)
        status = fvi_parse_state_expression("lagrangian", m->d, 1,
                                            texts->lagrangian, parameters,
                                            &m->lagrangian, error);
    for (size_t j = 0; !status && j < texts->dampers; j++)
        status = parse_damper(m, j, texts->damper[j], parameters, error);
    for (size_t i = 0; !status && i < texts->constraints; i++) {
        status = fvi_parse_state_expression("constraint", m->d, 0,
                                            texts->constraint[i], parameters,
                                            &m->constraint[i].e, error);
        m->name[i] = texts->constraint[i];
    }
    for (size_t i = 0; !status && i < texts->imposed; i++) {
        status = parse_imposed(m, texts->constraints + i, texts->impose[i],
                               parameters, error);
        m->name[texts->constraints + i] = texts->impose[i];
    }
    for (size_t i = 0; !status && i < texts->forces_on; i++)
        status = parse_force_on(m, i, texts->force_on[i], parameters, error);
    return status;
}

static int allocate(fvi_typed_mechanism *m, const fvi_mechanism_texts *texts)
{
    m->dampers = texts->dampers;
    m->constraints = texts->constraints + texts->imposed;
    m->forces = texts->forces_on;
    m->typed = calloc(m->dampers + 1, sizeof *m->typed);
    m->damper = calloc(m->dampers + 1, sizeof *m->damper);
    m->constraint = calloc(m->constraints + 1, sizeof *m->constraint);
    m->name = calloc(m->constraints + 1, sizeof *m->name);
    m->imposed = calloc(m->constraints + 1, sizeof *m->imposed);
    m->force = calloc(m->forces + 1, sizeof *m->force);
    return m->typed && m->damper && m->constraint && m->name && m->imposed
                   && m->force
               ? FVI_SUCCESS
               : FVI_ENOMEM;
}

int fvi_damper_texts(size_t d, const double *rho, double alpha, const char *law,
                     const char *past, size_t *count, char ***list,
                     fvi_error *error)
{
    past = past ? past : "held";
    const size_t size = 120 + (law ? strlen(law) : 0) + strlen(past);
    *count = 0;
    *list = malloc(d * (sizeof **list + size));
    if (!*list)
        return fvi_no_memory(error, NULL);
    char *text = (char *)(*list + d);
    for (size_t i = 0; i < d; i++) {
        if (rho[i] == 0)
            continue;
        char R[32], A[32];
        fvi_format_double(rho[i], R);
        fvi_format_double(alpha, A);
        if (law)
            snprintf(text, size, "x%zu : %s : %s", i + 1, law, past);
        else
            snprintf(text, size, "x%zu : power:%s,%s : %s", i + 1, R, A, past);
        (*list)[(*count)++] = text;
        text += size;
    }
    return FVI_SUCCESS;
}

int fvi_parse_mechanism(const fvi_mechanism_texts *texts, size_t d,
                        fvi_user_parameters *parameters,
                        fvi_typed_mechanism **mechanism, fvi_error *error)
{
    if (!texts || !mechanism)
        return fvi_fail(error, FVI_EFAULT, "mechanism", NAN, "null pointer");
    if (d == 0 || d > 10000)
        return fvi_fail(error, FVI_EINVAL, "dimension", (double)d,
                        "a mechanism has 1 to 10000 coordinates, not %zu", d);
    fvi_typed_mechanism *m = calloc(1, sizeof *m);
    int status = FVI_ENOMEM;
    if (m) {
        m->d = d;
        status = allocate(m, texts);
    }
    if (status)
        fvi_fail(error, status, "mechanism", NAN, "not enough memory");
    else
        status = parse_all(m, texts, parameters, error);
    if (status) {
        fvi_typed_mechanism_free(m);
        return status;
    }
    fvi_mechanism_of_texts(m);
    *mechanism = m;
    return FVI_SUCCESS;
}

void fvi_typed_mechanism_free(fvi_typed_mechanism *m)
{
    if (!m)
        return;
    fvi_expression_free(m->lagrangian);
    for (size_t j = 0; m->typed && j < m->dampers; j++)
        fvi_typed_damper_free(&m->typed[j]);
    for (size_t i = 0; m->constraint && i < m->constraints; i++)
        fvi_expression_free(m->constraint[i].e);
    for (size_t i = 0; m->force && i < m->forces; i++)
        fvi_expression_free(m->force[i].e);
    free(m->typed);
    free(m->damper);
    free(m->constraint);
    free(m->name);
    free(m->imposed);
    free(m->force);
    free(m);
}
