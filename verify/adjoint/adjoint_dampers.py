"""H 23, 27. Several dampers: derivatives with respect to the numbers of their laws.

Proved here:
  (23.28) the derivatives of the symbol of two springpots in series, and of Cole and Davidson's kernel, with
          respect to their numbers.
Printed: derivatives of runs of three unknowns with three dampers, by Algorithm 3 and (13.7) as they are written in
the chapters, by complex steps of 10^-45 with 100 digits."""
from random import Random

import mpmath
from mpmath import mpc, mpf
from sympy import Rational, diff, exp, log, symbols

from shared.damper_runs import (TINY, growth_of, numbers_of, product, start_impulses, slope, solve, tilted, weights)
from shared.refgen import METHODS, header, hexd, initial_history, nearest, prove, table

#> symbols
a, b, T, L, s = symbols("a b T L s", positive=True)
u = T * exp(2 * (a - b) * L)  # L = ln s
C = exp(2 * a * L) / (1 + u)
prove("(23.28) by the order", diff(C, a) - 2 * L * C / (1 + u))
prove("(23.28) by the time", diff(C, T) + C * exp(2 * (a - b) * L) / (1 + u))
prove("(23.28) by the end", diff(C, b) - 2 * L * C * u / (1 + u))
V = s / (1 + T * s)
prove("Cole and Davidson by the order", diff(V ** (2 * a), a) - 2 * log(V) * V ** (2 * a))
prove("Cole and Davidson by the time", diff(V ** (2 * a), T) + 2 * a * V * V ** (2 * a))
#< symbols

D, N, STEP, DAMPERS = 3, 12, mpf(1) / 16, 3


def run(method, kappa, M, K, x0, p0, matrices, kernels, pasts):
    """Return J = (h/2) sum_{k>=1} |x_k - sin t_k|^2 + |p_N|^2 / 2 of a run."""
    h, printed, each = STEP, method == "fvi", range(D)
    v0 = solve(M, p0)
    theta = [kernel[0][2] if method == "shifted" else mpf(method == "stable") / 2 for kernel in kernels]
    w = [weights(method, kernel, h, N) for kernel in kernels]
    above = [growth_of(kernel) > 1 for kernel in kernels]
    drift = [[h * v if a and (not printed or past == "caputo") else mpf(0) for v in v0]
             for a, past in zip(above, pasts)]
    all_impulses = [None if printed else start_impulses(past, kernel, h, N) for past, kernel in zip(pasts, kernels)]
    damped_amplitudes = [product(C, v0 if a else x0) for C, a in zip(matrices, above)]
    rest = (1 - kappa) * h
    A = [[M[i][j] / h + kappa * rest * K[i][j] + sum(t * h * v[0] * C[i][j] for t, v, C in zip(theta, w, matrices))
          for j in each] for i in each]
    x, p, J = x0, p0, mpf(0)
    z, H = [[[mpf(0)] * D] for _ in kernels], [[mpf(0)] * D for _ in kernels]
    force = lambda k: [mpmath.cos(5 * k * STEP / 4) * (i + 1) / 5 for i in each]
    for k in range(N):
        known = []
        for j, C in enumerate(matrices):
            moved = [x[i] - x0[i] - (k + 1) * drift[j][i] for i in each]
            known.append([w[j][0] * moved[i] + sum(w[j][n] * z[j][k + 1 - n][i] for n in range(1, k + 2))
                          for i in each])
            before, ahead = product(C, H[j]), product(C, known[j])
            for i in each:
                if not printed:
                    p[i] = p[i] - (mpf(1) / 2 - theta[j]) * h * before[i]
                p[i] = p[i] - (all_impulses[j][k][0] * damped_amplitudes[j][i] if all_impulses[j] else 0)
        right = list(p)
        for j, C in enumerate(matrices):
            ahead = product(C, known[j])
            right = [right[i] - theta[j] * h * ahead[i] for i in each]
        if not printed:
            F = force(k)
            p, right = ([v + h / 2 * f for v, f in zip(u, F)] for u in (p, right))
        at = product(K, x)
        d = solve(A, [right[i] - kappa * h * at[i] for i in each])
        grad = product(K, [v + (1 - kappa) * e for v, e in zip(x, d)])
        x = [v + e for v, e in zip(x, d)]
        F = force(k + 1)
        p = [p[i] + h * ((1 if printed else mpf(1) / 2) * F[i] - grad[i]) for i in each]
        for j, C in enumerate(matrices):
            H[j] = [known[j][i] + w[j][0] * d[i] for i in each]
            z[j].append([x[i] - x0[i] - (k + 1) * drift[j][i] for i in each])
            now = product(C, H[j])
            p = [p[i] - (1 if printed else mpf(1) / 2 + theta[j]) * h * now[i]
                 - (all_impulses[j][k][1] * damped_amplitudes[j][i] if all_impulses[j] else 0) for i in each]
        J += h / 2 * sum((v - mpmath.sin((k + 1) * STEP)) ** 2 for v in x)
    return J + sum(v * v for v in p) / 2


def uniform(low, high):
    return round(random.uniform(low, high) * 2**20) / 2**20


def positive(count):
    """Return a positive matrix, a sum of squares, whose entries are whole multiples of 2^-20 and so exact doubles."""
    rows = [[random.randrange(-2**10, 2**10) for _ in range(D)] for _ in range(count)]
    return [[sum(r[i] * r[j] for r in rows) / 2**20 for j in range(D)] for i in range(D)]


def term(kind):
    """Return a random term (kind, rho, alpha, time, end)."""
    alpha = uniform(0.1, 0.9)
    end = {"DISTRIBUTED": uniform(alpha, 1), "MAXWELL2": uniform(0.05, alpha)}.get(kind, 0.0)
    return (kind, uniform(0.3, 1.5), alpha, 0.0 if kind in ("POWER", "DISTRIBUTED") else uniform(0.1, 2), end)


# The alpha of kernels of one power; below, the kinds of the terms of other kernels.
POWERS = [[0.0, 0.25, 1.0], [0.5, 0.05, 0.75], [0.375, 0.95, 0.6875]]
LAWS = [[["ZENER"], ["MAXWELL2"], ["POWER", "DAVIDSON"]], [["DISTRIBUTED"], ["DAVIDSON", "MAXWELL"], ["POWER"]],
        [["MAXWELL2", "POWER"], ["POWER", "ZENER"], ["DISTRIBUTED", "MAXWELL2"]],
        [["MAXWELL"], ["ZENER", "DISTRIBUTED"], ["DAVIDSON"]]]
STEEP = ("MAXWELL2", 0.75, 0.875, 0.5, 0.625)   # its symbol grows faster than s, and it has a relaxation time


def problem(method, kinds):
    kernels, pasts = [], []
    for j in range(DAMPERS):
        if isinstance(kinds[j], float):
            kernels.append([("POWER", uniform(0.3, 1.5), kinds[j], 0.0, 0.0)])
            pasts.append("rl" if method != "fvi" and kinds[j] < 0.5 and j == 1 else ["caputo", "held", "held"][j])
        else:
            kernels.append([term(kind) for kind in kinds[j]])
            pasts.append("held")
    if kinds == LAWS[1]:
        kernels[1][1] = STEEP
    M, K, full = positive(D), positive(D), positive(D)
    for i in range(D):
        M[i][i] += 1.0
    full = [[v / 8 for v in row] for row in full]  # smaller, so that a method that takes it explicitly stays stable
    rows = [[uniform(-0.5, 0.5) for _ in range(D)] for _ in range(2)]
    x0, p0 = ([uniform(-1, 1) for _ in range(D)] for _ in range(2))
    kappa = 0.5 if method == "stable" else uniform(0.2, 0.8)
    exact = lambda A: [[mpf(v) for v in row] for row in A]
    matrices = [exact([[u * v for v in row] for u in row]) for row in exact(rows)] + [exact(full)]
    numbers = [tuple((kind, *map(mpf, rest)) for kind, *rest in kernel) for kernel in kernels]
    of = lambda x, p, terms: run(method, mpf(kappa), exact(M), exact(K), x, list(p), matrices, terms, pasts)
    start, push = ([mpf(v) for v in u] for u in (x0, p0))
    tilt = lambda u, i: [v + mpc(0, TINY) if j == i else v for j, v in enumerate(u)]
    want = [mpf(0)] * 24
    for j, l, i in numbers_of(numbers):
        want[8 * j + 4 * l + i] = slope(of(start, push, tilted(numbers, j, l, i)))
    want += [slope(of(tilt(start, i), push, numbers)) for i in range(D)]
    want += [slope(of(start, tilt(push, i), numbers)) for i in range(D)]
    flat = lambda A: "{ " + ", ".join(hexd(Rational(v)) for row in A for v in row) + " }"
    terms = "{ " + ", ".join("{ " + ", ".join(
        f"{{ FVI_KERNEL_{kind}, {', '.join(hexd(Rational(v)) for v in rest)} }}" for kind, *rest in kernel) + " }"
        for kernel in kernels) + " }"
    return [f"&fvi_{METHODS[method]}", hexd(Rational(kappa)), flat(M), flat(K), flat(rows), flat(full), terms,
            "{ " + ", ".join(str(len(kernel)) for kernel in kernels) + " }",
            "{ " + ", ".join(initial_history(past) for past in pasts) + " }",
            flat([x0]), flat([p0]), "{ " + ", ".join(map(nearest, want)) + " }"]


random = Random(2328)
runs = [problem(method, kinds) for method in METHODS
        for kinds in POWERS + (LAWS if method != "shifted" else [])]
header("verify/adjoint/adjoint_dampers.py")
print("""
/* Three unknowns, F_i = (i + 1) cos(5t/4)/5, h = 1/16, twelve steps, three dampers: along two rows,
   and by a matrix. J = (h/2) sum_{k>=1} |x_k - sin t_k|^2 + |p_N|^2/2, by rho, alpha, time and end of
   two terms of each, then by x0 and p0 */""")
table("ref_dampers", "const fvi_method *method; double kappa, M[9], K[9], row[6], C[9]; fvi_kernel_term term[3][2]; "
      "size_t terms[3]; fvi_initial_history past[3]; double x0[3], p0[3], want[30];", runs)
