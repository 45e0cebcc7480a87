/* src/memory/history_tiled_product.h -- Compute eight rows of a product with vectors of one width.       [H 28]
 *
 * history_tiled.c includes this file once for each width, with
 *
 *   LANES    number of doubles in a vector
 *   PRODUCT  name of the function
 *   TARGET   attribute that lets the compiler use such vectors, or nothing
 *
 *     out_r += sum_{j < n} table_{jr} in_j - lose_r out_r,    r = 0, ..., 7      (28.4)
 *
 * The rows out_r and in_j have FVI_TILE numbers each; the product is computed for the first `columns` of them. The
 * columns are independent, and the sum of each column ascends in j, so all widths give the same digits. The inner loop
 * needs ten registers: eight vectors of sums, one number of the table, and one vector of a row. Every machine has at
 * least sixteen. */

//> product
TARGET static void PRODUCT(size_t columns, size_t n, const double *table,
                           const double *in, const double *lose, double *out)
{
    typedef double vector
        __attribute__((vector_size(8 * LANES), aligned(8), may_alias));
    enum { ROWS = FVI_EIGHT / 2 };
    for (size_t i = 0; i < columns; i += 2 * LANES)
        for (size_t half = 0; half < FVI_EIGHT; half += ROWS) {
            vector sum[ROWS][2] = { { { 0 } } };
            for (size_t j = 0; j < n; j++) {
                const vector *x = (const vector *)(in + j * FVI_TILE + i);
                const double *row = table + j * FVI_EIGHT + half;
#pragma GCC unroll 4
                for (size_t r = 0; r < ROWS; r++) {
                    sum[r][0] += row[r] * x[0];
                    sum[r][1] += row[r] * x[1];
                }
            }
#pragma GCC unroll 4
            for (size_t r = 0; r < ROWS; r++) {
                vector *to = (vector *)(out + (half + r) * FVI_TILE + i);
                to[0] += sum[r][0] - lose[half + r] * to[0];
                to[1] += sum[r][1] - lose[half + r] * to[1];
            }
        }
}
//< product

#undef LANES
#undef PRODUCT
#undef TARGET
