/* src/problem/typed_damping.c -- Parse laws of damping, such as zener:1,0.3,2. */
#include "words.h"

#include "estimation/rheology_model.h"

#include <fvi/formulas.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char symbol_word[] = "symbol:";
enum { SYMBOL_LENGTH = sizeof symbol_word - 1 };

/* Make the term. Of two springpots in series the one with the higher order comes first. If one of them has rho = 0, the
 * pair gives no force, and its rho becomes 0. */
static fvi_kernel_term term_of(size_t word, const double *p)
{
    const fvi_element kind = fvi_element_of_word(word);
    if (kind != FVI_ELEMENT_MAXWELL2)
        return fvi_element_term(kind, p);
    const double *high = p[1] >= p[3] ? p : p + 2, *low = p[1] >= p[3] ? p + 2 : p;
    const double rho = p[0] == 0 || p[2] == 0 ? 0 : high[0];
    return fvi_element_term(kind, (double[]){ rho, high[1], rho == 0 ? 0 : low[0], low[1] });
}

/* ---- texts ---- */

static int is_symbol(const char *text)
{
    return strncasecmp(text, symbol_word, SYMBOL_LENGTH) == 0;
}

static int refuse_range(const char *text, size_t i, double value,
                        fvi_error *error)
{
    return fvi_fail(error, FVI_EDOM, "damping", value, "'%s': %s with %s", text,
                    fvi_law_formulas[i].form, fvi_kernel_words[i].range);
}

/* The words of all laws, ended by "symbol" and NULL, in the order of fvi_law_formulas. */
enum { MOST_WORDS = 100 };
static void list_words(const char *words[MOST_WORDS])
{
    for (size_t i = 0; i < fvi_kernel_word_count; i++)
        words[i] = fvi_element_words[fvi_element_of_word(i)];
    words[fvi_kernel_word_count] = "symbol";
    words[fvi_kernel_word_count + 1] = NULL;
}

/* Refuse a text whose word is none of these. */
static int refuse_word(const char *text, size_t length, const char *const *words, fvi_error *error)
{
    char forms[MOST_WORDS * 8] = "", place[64];
    for (size_t i = 0, end = 0; i < fvi_kernel_word_count && end < sizeof forms; i++)
        end += (size_t)snprintf(forms + end, sizeof forms - end, "%s  ", fvi_law_formulas[i].form);
    return fvi_refuse(error, "damping", "'%s' is none of %ssymbol:EXPRESSION%s", text, forms,
                      fvi_word_hint(text, length, words, place));
}

/* Count a term, and note whether it is a pair whose smaller order was typed first. */
static int mark_exchanged_term(const char *text, fvi_user_parameters *parameters, int is_exchanged,
                               fvi_error *error)
{
    const size_t i = parameters ? parameters->terms++ : 0;
    if (!parameters || !is_exchanged)
        return FVI_SUCCESS;
    if (i >= FVI_MOST_EXCHANGED)
        return fvi_refuse(error, "damping", "'%s': of so many terms the larger order must stand first", text);
    parameters->exchanged[i / 8] |= (unsigned char)(1u << i % 8);
    return FVI_SUCCESS;
}

/* Add a term to the sum. */
static int add_term(const char *text, fvi_user_parameters *parameters,
                    fvi_typed_damping *damping, fvi_error *error)
{
    const char *words[MOST_WORDS];
    list_words(words);
    const size_t length = strcspn(text, ":"),
                 i = fvi_scan_word(text, length, words);
    double p[FVI_KERNEL_FIELDS];
    if (is_symbol(text))
        return fvi_refuse(error, "damping", "'%s': a symbol stands alone", text);
    if (i >= fvi_kernel_word_count)
        return refuse_word(text, length, words, error);
    const size_t count = fvi_kernel_word_numbers(i);
    if (!fvi_scan_call(text, words[i], (int)count, p))
        return fvi_refuse(error, "damping", "'%s' is not %s", text, fvi_law_formulas[i].form);
    for (size_t j = 0; j < count; j++)
        if (p[j] < 0)
            return refuse_range(text, i, p[j], error);
    const fvi_kernel_term term = term_of(i, p);
    if (fvi_kernel_check(&(fvi_kernel){ 1, &term }) != 0)
        return refuse_range(text, i, NAN, error);
    if (damping->law.count == FVI_MOST_TERMS)
        return fvi_refuse(error, "damping", "'%s': too many terms", text);
    if (mark_exchanged_term(text, parameters, term.kind == FVI_KERNEL_MAXWELL2 && p[1] < p[3], error))
        return FVI_EINVAL;
    damping->term[damping->law.count++] = term;
    damping->law.term = damping->term;
    return FVI_SUCCESS;
}

/* Parse a law that is an expression in s. It must be the only term, so a colon, which another term would have, is
 * refused. */
static int parse_symbol(const char *text, fvi_user_parameters *parameters,
                        fvi_typed_damping *damping, fvi_error *error)
{
    const char *expression = text + SYMBOL_LENGTH;
    if (damping->law.count > 0 || strchr(expression, ':'))
        return fvi_refuse(error, "damping", "'%s': a symbol stands alone", text);
    int status = mark_exchanged_term(text, parameters, 0, error);
    if (!status)
        status = fvi_parse_expression("damping", "s", 1, expression, parameters,
                                      &damping->symbol, error);
    if (status)
        return status;
    damping->function = fvi_kernel_of_expression(damping->symbol, 1);
    damping->law = fvi_kernel_of_function(&damping->function);
    if (fvi_kernel_check(&damping->law) != 0)
        return fvi_fail(error, FVI_EDOM, "damping", NAN,
                        "'%s' is no law: it must be finite at s = i w, real for s > 0, without a pole off the negative "
                        "axis, and grow no faster than s^2",
                        text);
    return FVI_SUCCESS;
}

int fvi_pair_is_exchanged(const fvi_user_parameters *parameters, size_t term, size_t terms)
{
    if (!parameters || terms > parameters->terms || term >= terms)
        return 0;
    const size_t i = parameters->terms - terms + term;
    return i < FVI_MOST_EXCHANGED && (parameters->exchanged[i / 8] >> i % 8 & 1);
}

void fvi_typed_damping_free(fvi_typed_damping *damping)
{
    fvi_expression_free(damping->symbol);
    damping->symbol = NULL;
}

int fvi_parse_damping(const char *text, fvi_user_parameters *parameters,
                      fvi_typed_damping *damping, fvi_error *error)
{
    if (!text || !damping)
        return fvi_fail(error, FVI_EFAULT, "damping", NAN, "null pointer");
    if (is_symbol(text))
        return parse_symbol(text, parameters, damping, error);
    char *copy = malloc(strlen(text) + 1);
    if (!copy)
        return fvi_no_memory(error, "damping");
    int status = FVI_SUCCESS;
    for (char *at = strcpy(copy, text), *next = at; next && !status;
         at = next) {
        if ((next = strstr(at, " + "))) {
            *next = '\0';
            next += 3;
        }
        status = add_term(at, parameters, damping, error);
    }
    free(copy);
    return status;
}
