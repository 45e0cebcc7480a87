/* src/stages/lobatto_eigenvalues.c -- The eigenvalues and eigenvectors of the Lobatto IIIC matrix.   [H 27] */
#include "lobatto_eigenvalues.h"

#include "variable_rule.h"

#include "lobatto_eigenvalues_ref.h"

/* Read the rows of a table. A row holds the real and the imaginary part of lambda, then those of each entry of v. */
static size_t read_table(size_t s, size_t count, const double *row,
                         fvi_lobatto_pair *pair)
{
    for (size_t l = 0; l < count; l++, row += 2 + 2 * s) {
        pair[l].lambda = row[0] + I * row[1];
        for (size_t i = 0; i < s; i++)
            pair[l].v[i] = row[2 + 2 * i] + I * row[3 + 2 * i];
    }
    return count;
}

/* Read the pairs of 6 or 8 stages from the tables of the method with variable steps. */
static size_t read_rule(const fvi_variable_rule *rule, fvi_lobatto_pair *pair)
{
    for (size_t l = 0; l < rule->s / 2; l++) {
        pair[l].lambda = rule->lambda_re[l] + I * rule->lambda_im[l];
        for (size_t i = 0; i < rule->s; i++)
            pair[l].v[i] = rule->re[l][i] + I * rule->im[l][i];
    }
    return rule->s / 2;
}

size_t fvi_lobatto_eigenvalues(size_t s, fvi_lobatto_pair *pair)
{
    switch (s) {
    case 2:
        return read_table(s, 1, *pairs_2, pair);
    case 3:
        return read_table(s, 2, *pairs_3, pair);
    case 4:
        return read_table(s, 2, *pairs_4, pair);
    case 5:
        return read_table(s, 3, *pairs_5, pair);
    case 7:
        return read_table(s, 4, *pairs_7, pair);
    case 6:
    case 8:
        return read_rule(fvi_variable(s), pair);
    }
    return 0;
}
