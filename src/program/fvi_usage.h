/* src/program/fvi_usage.h -- What build/fvi says of itself. */
#ifndef FVI_USAGE_H
#define FVI_USAGE_H

static const char usage[] =
    "usage: fvi run [options]            one trajectory, as a table\n"
    "       fvi exact [options]          the exact solution on the same grid\n"
    "       fvi coefficients [options]   n, alpha_n\n"
    "       fvi methods                  name, order, memory of each method\n"
    "       fvi help [COMMAND]           also: fvi -h, fvi run -h, --version\n"
    "\n"
    "m x'' + grad U(x) + rho D^{2 alpha} x = F(t), stepped by a variational\n"
    "integrator with its whole memory; the body was held at x0 until t = 0.\n";

static const char usage_run[] =
    "usage: fvi run [options]\n"
    "  --method M       fvi, fvi-shifted, fvi-bdf2, fvi-lobatto2,     [fvi]\n"
    "                   fvi-lobatto3, fvi-lobatto4; lda, euler-explicit,\n"
    "                   euler-implicit (A = 0.5 only)\n"
    "  --alpha A        damping of order 2A, 0 <= A <= 1              [0.5]\n"
    "  --rho R          damping, R >= 0                               [0.2]\n"
    "  --mass M         mass, M > 0                                   [1]\n"
    "  --potential P    harmonic:C  duffing:C,G  pendulum:G  free\n"
    "                   chain:D,C,G (D masses between two walls)      "
    "[harmonic:1]\n"
    "  --force F        none  step:A,T  cosine:A,W                    [none]\n"
    "  --derivative D   the past, until t = 0                         [held]\n"
    "                     held: at rest at x0, the memory acts on x - x0\n"
    "                     caputo: the same for A <= 1/2; for A > 1/2 it came\n"
    "                       along a straight line: on x - x0 - t v0\n"
    "                     rl: at 0, then put at x0: on x. No solution for\n"
    "                       x0 != 0 and A > 1/2: fvi warns, the others refuse\n"
    "  --kappa K        potential at K x_k + (1 - K) x_{k+1};         [0.5]\n"
    "                   fvi-lobatto and euler have no kappa\n"
    "  --x0 X, --p0 P   start; for a chain a list, or one for all     [1, "
    "0.5]\n"
    "  --h H            step, H > 0                                   [0.1]\n"
    "  --steps N        number of steps, N >= 1                       [200]\n"
    "  --time T         the last row's time, instead of --h: H = T/N\n"
    "  --error E        instead of --h: N rows to T, and the steps between\n"
    "                   them so short that x is right to E            [T 20]\n"
    "  --columns LIST   any of t,x,p,energy,y                         "
    "[t,x,p,energy]\n"
    "  --every K        rows 0, K, 2K, ... and the last               [1]\n"
    "  --memory W       direct, fft, exponentials, auto               [auto]\n"
    "                   (fvi-lobatto: no fft)\n"
    "  --tolerance E    of the compressed memory, E >= 1e-14          [1e-13]\n"
    "  -o FILE          write there, complete or not at all           "
    "[stdout]\n";

static const char usage_exact[] =
    "usage: fvi exact [options]\n"
    "the linear problem m x'' + C x + rho D^{2A} x = F, solved exactly; "
    "options as\n"
    "of run: --alpha --rho --mass --force --derivative --x0 --p0 --h --steps\n"
    "--time --columns --every -o, and --potential harmonic:C (C >= 0) or "
    "free\n";

static const char usage_coefficients[] =
    "usage: fvi coefficients [options]\n"
    "  --alpha A   order, 0 <= A <= 2   [0.5]\n"
    "  --count N   how many, N >= 1     [10]\n"
    "  -o FILE     write there, complete or not at all\n";

#endif
