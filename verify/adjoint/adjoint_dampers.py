"""H 23, 27. Several dampers: derivatives with respect to the numbers of their laws.

Proved here:
  (23.28) the derivatives of the symbol of two springpots in series, and of Cole and Davidson's kernel, with
          respect to their numbers.
Printed: derivatives of runs of three unknowns with three dampers, by Algorithm 3 and (13.7) as they are written in
the chapters, by dual numbers of 45 digits, with weights from complex steps of 10^-45 with 100 digits."""
from random import Random

import mpmath
from mpmath import mpf
from sympy import Rational, diff, exp, log, symbols

from shared.arithmetic import BITS, HALF, ONE, UNITS, ZERO, Dual, apart, dot, dual, fixed
from shared.damper_runs import TINY, growth_of, numbers_of, start_impulses, tilted, weights
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


def with_slopes(find, kernel, units):
    """Return the numbers find(kernel) as dual numbers. units[l, i] is the unit of the slopes by number i of term l."""
    found = [dual(v) for v in find(kernel)]
    for (l, i), unit in units.items():
        tilted_values = find(tilted([kernel], 0, l, i)[0])
        found = [u + Dual(0, unit * fixed(mpmath.im(v) / TINY)) for u, v in zip(found, tilted_values)]
    return found


def product(A, x):
    return [dot(row, x) for row in A]


def solve(A, right):
    """Return x of A x = right. The matrix of a step needs no pivots."""
    rows = [[*row, r] for row, r in zip(A, right)]
    for k in range(D):
        for i in range(k + 1, D):
            f = rows[i][k] / rows[k][k]
            rows[i] = [a - f * b for a, b in zip(rows[i], rows[k])]
    x = [ZERO] * D
    for i in reversed(range(D)):
        x[i] = (rows[i][D] - dot(rows[i][i + 1:D], x[i + 1:])) / rows[i][i]
    return x


def force(k):
    return [dual(mpmath.cos(5 * k * STEP / 4) * (i + 1) / 5) for i in range(D)]


def run(method, kappa, M, K, x0, p0, matrices, kernels, pasts, units):
    """Return J = (h/2) sum_{k>=1} |x_k - sin t_k|^2 + |p_N|^2 / 2 of a run. All numbers are dual numbers but those of
    the kernels; units[j] are the units of the slopes by the numbers of kernel j."""
    h, half, printed, each = dual(STEP), dual(STEP / 2), method == "fvi", range(D)
    v0 = solve(M, p0)
    values = lambda find: [with_slopes(find, kernel, by) for kernel, by in zip(kernels, units)]
    theta = values(lambda kernel: [kernel[0][2] if method == "shifted" else mpf(method == "stable") / 2])
    theta = [of_one for of_one, in theta]
    ends = [(ZERO, ONE)] * DAMPERS if printed else [(h * (HALF - v), h * (HALF + v)) for v in theta]
    w = values(lambda kernel: weights(method, kernel, STEP, N))
    above = [growth_of(kernel) > 1 for kernel in kernels]
    drift = [[h * v if a and (not printed or past == "caputo") else ZERO for v in v0]
             for a, past in zip(above, pasts)]
    all_impulses = []
    for past, kernel, by in zip(pasts, kernels, units):
        flat = lambda of, past=past: [v for both in start_impulses(past, of, STEP, N) or () for v in both]
        all_impulses.append([] if printed else with_slopes(flat, kernel, by))
    damped_amplitudes = [product(C, v0 if a else x0) for C, a in zip(matrices, above)]
    ahead, behind = h * kappa, h * (ONE - kappa)
    A = [[M[i][j] / h + kappa * behind * K[i][j] for j in each] for i in each]
    for t, v, C in zip(theta, w, matrices):
        A = [[A[i][j] + t * h * v[0] * C[i][j] for j in each] for i in each]
    x, p, J = x0, p0, ZERO
    z, H = [[[ZERO] for _ in each] for _ in kernels], [[ZERO] * D for _ in kernels]
    for k in range(N):
        known = []
        for j, C in enumerate(matrices):
            moved = [x[i] - x0[i] - dual(mpf(k + 1)) * drift[j][i] for i in each]
            known.append([w[j][0] * moved[i] + dot(w[j][1:k + 2], z[j][i][::-1]) for i in each])
            before = product(C, H[j])
            if not printed:
                p = [a - ends[j][0] * b for a, b in zip(p, before)]
            if all_impulses[j]:
                p = [a - all_impulses[j][2 * k] * b for a, b in zip(p, damped_amplitudes[j])]
        right = p
        for j, C in enumerate(matrices):
            right = [a - theta[j] * h * b for a, b in zip(right, product(C, known[j]))]
        if not printed:
            F = force(k)
            p, right = ([a + half * f for a, f in zip(u, F)] for u in (p, right))
        d = solve(A, [a - ahead * b for a, b in zip(right, product(K, x))])
        grad = product(K, [a + (ONE - kappa) * b for a, b in zip(x, d)])
        x, F = [a + b for a, b in zip(x, d)], force(k + 1)
        p = [a + (h if printed else half) * f - h * g for a, f, g in zip(p, F, grad)]
        for j, C in enumerate(matrices):
            H[j] = [a + w[j][0] * b for a, b in zip(known[j], d)]
            for i in each:
                z[j][i].append(x[i] - x0[i] - dual(mpf(k + 1)) * drift[j][i])
            p = [a - (h if printed else ends[j][1]) * b for a, b in zip(p, product(C, H[j]))]
            if all_impulses[j]:
                p = [a - all_impulses[j][2 * k + 1] * b for a, b in zip(p, damped_amplitudes[j])]
        off = [v - dual(mpmath.sin((k + 1) * STEP)) for v in x]
        J += half * dot(off, off)
    return J + HALF * dot(p, p)


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
    exact = lambda A: [[dual(mpf(v)) for v in row] for row in A]
    matrices = [exact([[mpf(u) * v for v in row] for u in row]) for row in rows] + [exact(full)]
    numbers = [tuple((kind, *map(mpf, rest)) for kind, *rest in kernel) for kernel in kernels]
    places = numbers_of(numbers)
    units = [{(l, i): unit for unit, (of, l, i) in zip(UNITS, places) if of == j} for j in range(DAMPERS)]
    own = UNITS[len(places):]
    start, push = ([dual(mpf(v)) + Dual(0, unit << BITS) for v, unit in zip(u, of)]
                   for u, of in ((x0, own[:D]), (p0, own[D:2 * D])))
    J = run(method, dual(mpf(kappa)), exact(M), exact(K), start, push, matrices, numbers, pasts, units)
    found = apart(J.d, len(places) + 2 * D)
    want = [mpf(0)] * 24 + found[len(places):]
    for (j, l, i), derivative in zip(places, found):
        want[8 * j + 4 * l + i] = derivative
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
