/* chapters/play/no_lanes.c -- No run of a page takes its steps together with others. */
#include "expression/expression_lanes.h"
#include "newton/newton_lanes.h"

const fvi_lane_functions fvi_expression_slope_lanes, fvi_expression_value_lanes, fvi_lanes_together;

int fvi_lane_pairs_prepare(size_t count, void *const *params, void **prepared)
{
    (void)count, (void)params, (void)prepared;
    return FVI_EUNSUP;
}

int fvi_lane_numbers_prepare(size_t count, void *const *params, void **prepared)
{
    return fvi_lane_pairs_prepare(count, params, prepared);
}

int fvi_newton_by_lanes(fvi_newton *n, const double *x, const double *r, double *d, double *g)
{
    (void)n, (void)x, (void)r, (void)d, (void)g;
    return FVI_EUNSUP;
}
