/* src/estimation/rheology_elements.c -- List the elements of a law and their numbers. [H 24] */
#include "rheology_model.h"

/* The words have the order of the elements, but the dashpot is the first word and the second element. */
fvi_element fvi_element_of_word(size_t i)
{
    return (fvi_element)(i < 2 ? 1 - i : i);
}

static const fvi_kernel_class *class_of(fvi_element kind)
{
    return fvi_kernel_classes[fvi_kernel_words[fvi_element_of_word(kind)].kind];
}

const fvi_kernel_number *fvi_element_numbers(fvi_element kind)
{
    return class_of(kind)->number;
}

int fvi_element_has_time(fvi_element kind)
{
    return class_of(kind)->has_time;
}

const char *fvi_element_number(fvi_element kind, size_t i, size_t *field)
{
    const size_t word = fvi_element_of_word(kind);
    if (word >= fvi_kernel_word_count || i >= fvi_kernel_word_numbers(word))
        return NULL;
    if (field)
        *field = fvi_element_numbers(kind)[i].field;
    return i == 0 && fvi_kernel_words[word].first ? fvi_kernel_words[word].first : fvi_element_numbers(kind)[i].name;
}

const char *fvi_element_number_typed(fvi_element kind, size_t i, int is_exchanged, size_t *field)
{
    const char *name = fvi_element_number(kind, i, field);
    if (name && is_exchanged && kind == FVI_ELEMENT_MAXWELL2)
        fvi_element_number(kind, (i + 2) % 4, field);
    return name;
}

fvi_kernel_term fvi_element_term(fvi_element kind, const double *number)
{
    const fvi_kernel_word *word = &fvi_kernel_words[fvi_element_of_word(kind)];
    double field[FVI_KERNEL_FIELDS] = { 0, word->alpha, 0, 0 };
    for (size_t i = 0; fvi_element_number(kind, i, NULL); i++)
        field[fvi_element_numbers(kind)[i].field] = number[i];
    if (kind == FVI_ELEMENT_MAXWELL2)
        field[2] = number[2] > 0 ? number[0] / number[2] : 0;
    return (fvi_kernel_term){ word->kind, field[0], field[1], field[2], field[3] };
}

fvi_element fvi_element_of(const fvi_kernel_term *term)
{
    if (term->kind == FVI_KERNEL_POWER)
        return term->alpha == 0     ? FVI_ELEMENT_SPRING
               : term->alpha == 0.5 ? FVI_ELEMENT_VISCOUS
                                    : FVI_ELEMENT_POWER;
    size_t word = 0;
    while (word < fvi_kernel_word_count && fvi_kernel_words[word].kind != term->kind)
        word++;
    return fvi_element_of_word(word);
}
