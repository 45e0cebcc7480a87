/* tests/bench/peers/peers.h -- The interface of peers, the methods of others. [H 18]
 *
 * A peer is one file of less than 250 lines that follows a publication. README.md in this folder says how to add
 * one. */
#ifndef PEERS_H
#define PEERS_H

#include "../problems.h"

/* PEER_INLINE -- a function that is compiled anew for each constant with which it is called, such as d = 1 or
 * the number of stages, so that its loops are unrolled. */
#define PEER_INLINE static inline __attribute__((always_inline))

/* PEER_SCALAR -- write it at the head of a file about one mass. gcc then unrolls its short loops but does not
 * pack pairs of numbers into vectors, which would cost a third here. clang does neither without being told. */
#ifdef __clang__
#define PEER_SCALAR
#else
#define PEER_SCALAR _Pragma("GCC optimize (\"O3\", \"no-tree-slp-vectorize\")")
#endif

/* task -- one run.
 *
 *   N          the number of steps, or T divided by the longest step, for peers that use it
 *   tolerance  > 0: the wanted error of the peer, or of the compression of its memory
 *              (0: as exact as possible) */
typedef struct {
    const problem *p;
    size_t N;
    double tolerance;
} task;

/* peer -- a method that is not the library's.
 *
 *   name       its name in the tables
 *   after      who described it, and where
 *   why        a clause that says why it is fast where it is fast
 *   fewest     the least N that is tried; 0: the tolerance alone decides the steps
 *   tolerance  nonzero: it reads the tolerance
 *   any        nonzero: N may be any number; 0: only a multiple of `fewest`
 *   takes      nonzero if it can solve the problem
 *   run        writes the ROWS + 1 rows of d positions. Everything that depends on the problem, N or
 *              the tolerance is made inside. Tables that depend on the method alone may be kept from
 *              one call to the next. Returns FVI_SUCCESS or any other code */
typedef struct {
    const char *name, *after, *why;
    int tolerance;
    size_t fewest;
    int any;
    int (*takes)(const problem *p);
    int (*run)(const task *task, double *rows);
} peer;

/* peers -- all peers; NULL ends the list. */
extern const peer *const peers[];

/* exact_by_rows -- the library's exact solution in all rows together, which is no peer but runs like one. */
extern const peer exact_by_rows;

#endif
