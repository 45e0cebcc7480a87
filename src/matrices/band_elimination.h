/* src/matrices/band_elimination.h -- Factorise a symmetric band matrix as L D L^T.         [H 27]
 *
 * This file is included once for each type of numbers. The including file defines
 *
 *   NUMBER                      double, or the numbers of several matrices side by side
 *   subtract_product(to, a, b)  to -= a b
 *   multiply(to, a, b)          to = a b; to may be a or b
 *   invert(to, a)               to = 1 / a
 *   is_positive(a)              returns 1 if a can be a pivot; for complex numbers its real part must be positive
 *
 * The functions take pointers. Row i of a band of half bandwidth w holds L_{i,i-w}, ..., L_{i,i-1}, 1 / D_i. */

//> band
/* Compute A = L D L^T, row by row. After the subtractions the entry A_ij has become L_ij D_j. */
static inline __attribute__((always_inline)) int factorise_band(size_t n, size_t w, NUMBER *band)
{
    const size_t row = w + 1;
    for (size_t i = 0; i < n; i++) {
        NUMBER *a = band + i * row, pivot = a[w];
        const size_t first = i > w ? i - w : 0;
        for (size_t j = first; j < i; j++) {
            const NUMBER *b = band + j * row;
            NUMBER left = a[w + j - i];
            for (size_t l = j > w && j - w > first ? j - w : first; l < j; l++)
                subtract_product(&left, &a[w + l - i], &b[w + l - j]);
            a[w + j - i] = left; /* holds L_ij D_j until the row is finished */
        }
        for (size_t j = first; j < i; j++) {
            NUMBER *left = &a[w + j - i], l;
            multiply(&l, left, &band[j * row + w]);
            subtract_product(&pivot, left, &l);
            *left = l;
        }
        if (!is_positive(&pivot))
            return FVI_ESING;
        invert(&a[w], &pivot);
    }
    return FVI_SUCCESS;
}

static inline __attribute__((always_inline)) void solve_band(size_t n, size_t w, const NUMBER *band, NUMBER *r)
{
    const size_t row = w + 1;
    for (size_t i = 0; i < n; i++) {
        const NUMBER *a = band + i * row;
        NUMBER left = r[i];
        for (size_t j = i > w ? i - w : 0; j < i; j++)
            subtract_product(&left, &a[w + j - i], &r[j]);
        r[i] = left;
    }
    for (size_t i = 0; i < n; i++)
        multiply(&r[i], &r[i], &band[i * row + w]);
    for (size_t i = n; i-- > 0;) {
        const NUMBER *a = band + i * row, known = r[i];
        for (size_t j = i > w ? i - w : 0; j < i; j++)
            subtract_product(&r[j], &a[w + j - i], &known);
    }
}
//< band
