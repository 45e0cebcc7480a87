/* src/expression/expression_lanes.h -- Evaluate expressions for several oscillators at once. [H 28] */
#ifndef FVI_EXPRESSION_LANES_H
#define FVI_EXPRESSION_LANES_H

#include "system/lanes.h"

/* fvi_expression_slope_lanes, fvi_expression_value_lanes -- The functions that compute U' and U'' of a potential, or F
 * of a force, in each lane. The params are fvi_expression of one variable. All lanes have the same text, with their own
 * values of its parameters. */
extern const fvi_lane_functions fvi_expression_slope_lanes, fvi_expression_value_lanes;

#endif
