/* src/expression/expression_lanes.h -- Expressions of several oscillators at once. [H 28] */
#ifndef FVI_EXPRESSION_LANES_H
#define FVI_EXPRESSION_LANES_H

#include "system/lanes.h"

/* fvi_expression_slope_lanes, fvi_expression_value_lanes -- U' and U'' of the potential, F of the force
 * that an expression of one variable is, in each lane; the params are fvi_expression. All lanes
 * have one text, and its parameters have values of their own. */
extern const fvi_lane_functions fvi_expression_slope_lanes, fvi_expression_value_lanes;

#endif
