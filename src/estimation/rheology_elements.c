/* src/estimation/rheology_elements.c -- List the elements of a law and their numbers. [H 24] */
#include "rheology_model.h"

const char *const fvi_element_words[] = { "spring",   "viscous",  "power",       "zener", "maxwell",
                                          "maxwell2", "davidson", "distributed", NULL };

static const struct {
    const char *name[FVI_ELEMENT_NUMBERS];
    size_t field[FVI_ELEMENT_NUMBERS];
} numbers[] = {
    { { "k" }, { 0 } },
    { { "rho" }, { 0 } },
    { { "rho", "alpha" }, { 0, 1 } },
    { { "rho", "alpha", "time" }, { 0, 1, 2 } },
    { { "rho", "time" }, { 0, 2 } },
    { { "rho1", "alpha1", "rho2", "alpha2" }, { 0, 1, 2, 3 } },
    { { "rho", "alpha", "time" }, { 0, 1, 2 } },
    { { "rho", "alpha", "end" }, { 0, 1, 3 } },
};

const char *fvi_element_number(fvi_element kind, size_t i, size_t *field)
{
    if (i >= FVI_ELEMENT_NUMBERS || !numbers[kind].name[i])
        return NULL;
    if (field)
        *field = numbers[kind].field[i];
    return numbers[kind].name[i];
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
    static const fvi_kernel_kind kinds[] = { FVI_KERNEL_POWER,   FVI_KERNEL_POWER,    FVI_KERNEL_POWER,
                                             FVI_KERNEL_ZENER,   FVI_KERNEL_MAXWELL,  FVI_KERNEL_MAXWELL2,
                                             FVI_KERNEL_DAVIDSON, FVI_KERNEL_DISTRIBUTED };
    double field[4] = { 0, kind == FVI_ELEMENT_VISCOUS ? 0.5 : 0, 0, 0 };
    for (size_t i = 0; i < FVI_ELEMENT_NUMBERS && numbers[kind].name[i]; i++)
        field[numbers[kind].field[i]] = number[i];
    if (kind == FVI_ELEMENT_MAXWELL2)
        field[2] = number[2] > 0 ? number[0] / number[2] : 0;
    return (fvi_kernel_term){ kinds[kind], field[0], field[1], field[2], field[3] };
}

fvi_element fvi_element_of(const fvi_kernel_term *term)
{
    switch (term->kind) {
    case FVI_KERNEL_ZENER:
        return FVI_ELEMENT_ZENER;
    case FVI_KERNEL_MAXWELL:
        return FVI_ELEMENT_MAXWELL;
    case FVI_KERNEL_DISTRIBUTED:
        return FVI_ELEMENT_DISTRIBUTED;
    case FVI_KERNEL_MAXWELL2:
        return FVI_ELEMENT_MAXWELL2;
    case FVI_KERNEL_DAVIDSON:
        return FVI_ELEMENT_DAVIDSON;
    default:
        return term->alpha == 0     ? FVI_ELEMENT_SPRING
               : term->alpha == 0.5 ? FVI_ELEMENT_VISCOUS
                                    : FVI_ELEMENT_POWER;
    }
}
