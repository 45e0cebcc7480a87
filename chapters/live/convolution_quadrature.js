// H 13: order 1 and order 2; the scene is in orders.js.
FVI_LIVE.orders("convolution_quadrature", ["fvi", "fvi-shifted", "fvi-bdf2"]);
