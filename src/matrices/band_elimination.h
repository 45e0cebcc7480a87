/* src/matrices/band_elimination.h -- L D L^T of a symmetric band.         [H 27]
 *
 * Included once for each kind of number, which defines
 *
 *   NUMBER          double, or double complex
 *   TIMES(a, b)     their product
 *   IS_POSITIVE(a)  can it be a pivot? Of a complex matrix the real part says so
 *
 * Row i of a band of half width w is L_{i,i-w}, ..., L_{i,i-1}, 1 / D_i. */

//> band
/* A = L D L^T, row by row: L_ij D_j is what is left of A_ij. */
static int factorise_band(size_t n, size_t w, NUMBER *band)
{
    const size_t row = w + 1;
    for (size_t i = 0; i < n; i++) {
        NUMBER *a = band + i * row, pivot = a[w];
        const size_t first = i > w ? i - w : 0;
        for (size_t j = first; j < i; j++) {
            const NUMBER *b = band + j * row;
            NUMBER left = a[w + j - i];
            for (size_t l = j > w && j - w > first ? j - w : first; l < j; l++)
                left -= TIMES(a[w + l - i], b[w + l - j]);
            a[w + j - i] = left; /* times D_j, until the row is done */
        }
        for (size_t j = first; j < i; j++) {
            const NUMBER left = a[w + j - i], l = TIMES(left, band[j * row + w]);
            pivot -= TIMES(left, l);
            a[w + j - i] = l;
        }
        if (!IS_POSITIVE(pivot))
            return FVI_ESING;
        a[w] = 1 / pivot;
    }
    return FVI_SUCCESS;
}

static void solve_band(size_t n, size_t w, const NUMBER *band, NUMBER *r)
{
    const size_t row = w + 1;
    for (size_t i = 0; i < n; i++) {
        const NUMBER *a = band + i * row;
        for (size_t j = i > w ? i - w : 0; j < i; j++)
            r[i] -= TIMES(a[w + j - i], r[j]);
    }
    for (size_t i = 0; i < n; i++)
        r[i] = TIMES(r[i], band[i * row + w]);
    for (size_t i = n; i-- > 0;) {
        const NUMBER *a = band + i * row;
        for (size_t j = i > w ? i - w : 0; j < i; j++)
            r[j] -= TIMES(a[w + j - i], r[i]);
    }
}
//< band
