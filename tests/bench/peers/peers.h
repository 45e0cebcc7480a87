/* tests/bench/peers/peers.h -- What others would take.                  [H 18]
 *
 * A peer is one file of less than 250 lines after a publication. How to add one:
 * README.md in this folder. */
#ifndef PEERS_H
#define PEERS_H

#include "../problems.h"

/* PEER_INLINE -- a function that is compiled anew for each constant that it is called with,
 * such as d = 1 or the number of stages: its loops are unrolled. */
#define PEER_INLINE static inline __attribute__((always_inline))

/* PEER_SCALAR -- at the head of a file about one mass: gcc unrolls its short loops, and does not
 * pack pairs of numbers into vectors, which costs it a third here; clang does neither unasked. */
#ifdef __clang__
#define PEER_SCALAR
#else
#define PEER_SCALAR _Pragma("GCC optimize (\"O3\", \"no-tree-slp-vectorize\")")
#endif

/* task -- one run.
 *
 *   N          steps, or T over the longest, if the peer goes by them; else of no use
 *   tolerance  > 0: what the peer is to reach, or of the compression of its memory
 *              (0: as exact as it can be)
 */
typedef struct {
    const problem *p;
    size_t N;
    double tolerance;
} task;

/* peer -- a method that is not ours.
 *
 *   name       as the tables have it
 *   after      who described it, and where
 *   why        in a clause, why it is fast where it is
 *   fewest     the least N that is tried; 0: it goes by its tolerance alone
 *   tolerance  nonzero: it reads the tolerance
 *   any        nonzero: N may be any number; 0: only a multiple of `fewest`
 *   takes      nonzero if it can solve the problem
 *   run        writes the ROWS + 1 rows of d positions; all that the problem, N or the
 *              tolerance decide is made within. Tables of numbers that belong to the
 *              method alone may be kept from one call to the next.
 *              Returns FVI_SUCCESS or any other code */
typedef struct {
    const char *name, *after, *why;
    int tolerance;
    size_t fewest;
    int any;
    int (*takes)(const problem *p);
    int (*run)(const task *task, double *rows);
} peer;

/* peers -- all of them, ended by NULL. */
extern const peer *const peers[];

/* exact_by_rows -- no peer, but run as one: our exact solution at all rows together. */
extern const peer exact_by_rows;

#endif
