/* tests/bench/peers/peers.c -- The table of the peers.                  [H 18] */
#include "peers.h"

#include <stddef.h>

extern const peer peer_product, peer_flmm_trapezoidal, peer_flmm_newton,
    peer_flmm_bdf2, peer_flmm_modes, peer_radau2_0, peer_radau3_0, peer_radau5_0, peer_radau7_0,
    peer_radau3_1, peer_radau5_1, peer_radau7_1, peer_rk8pd, peer_rk8pd_uniform,
    peer_rk4, peer_rk8, peer_taylor, peer_taylor_4, peer_taylor_6, peer_taylor_8,
    peer_taylor_12, peer_taylor_16, peer_taylor_24, peer_exact, peer_matrix,
    peer_l21sigma, peer_collocation;

const peer *const peers[] = {
    &peer_radau7_1,
    &peer_radau7_0,
    &peer_radau5_1,
    &peer_radau5_0,
    &peer_radau3_1,
    &peer_radau3_0,
    &peer_radau2_0,
    &peer_product,
    &peer_flmm_newton,
    &peer_flmm_trapezoidal,
    &peer_flmm_modes,
    &peer_flmm_bdf2,
    &peer_l21sigma,
    &peer_rk8pd_uniform,
    &peer_rk8pd,
    &peer_rk4,
    &peer_rk8,
    &peer_taylor,
    &peer_taylor_4,
    &peer_taylor_6,
    &peer_taylor_8,
    &peer_taylor_12,
    &peer_taylor_16,
    &peer_taylor_24,
    &peer_collocation,
    &peer_exact,
    &peer_matrix,
    NULL,
};
