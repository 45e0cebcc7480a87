"""H 5. Discrete fractional integration by parts.

Proved here, with alpha symbolic and the terms G_k, F_k of both sequences as independent symbols, for N = 6, 7, 8:
  (5.4)  the identity over the full range, without any hypothesis;
  (5.5)  the difference of both sides of the first printed identity: F_0 G_0 - F_N G_N;
  (5.6)  the difference of both sides of the second one;
  (5.7)  Delta_+ is Delta_- conjugated by time reversal;
  (5.8)  the difference of both sides of the out-of-phase identity, which the paper's remark
         calls false: it is 0 if F_0 = G_0 = G_N = 0; (5.9), the shift the other
         way, needs no hypothesis;
  (5.10) the misprint in the printed proof, with its integer counterexample;
  (5.11) alpha = 1 is summation by parts;
  (5.13) (5.4) to (5.9) for any weights, as symbols; and that T and T'
         are conjugate by reversal if T is Toeplitz; if one entry is changed, they are not;
  (5.14) the order, and the next term of its error.
Scalars are enough: a product of vectors is the sum over the components. Printed: values of both operators from the
definition (mpmath, 60 and 90 digits), and both sides of every identity for integer vectors, as exact rationals."""
from random import Random

import mpmath
from sympy import Matrix, Rational, binomial, exp, expand, expand_func, log, series, symbols

from shared.refgen import array, claim, header, hexd, hexd_real, prove, table

a = symbols("alpha")


def weight(order, n):
    """Return alpha_n by its definition."""
    return expand_func((-1) ** n * binomial(order, n))


def minus(w, z, k):
    """Return h^alpha Delta_- z_k, as (5.1) prints it."""
    return sum(w[n] * z[k - n] for n in range(k + 1))


def plus(w, z, k):
    """Return h^alpha Delta_+ z_k, as (5.2) prints it."""
    return sum(w[n] * z[k + n] for n in range(len(z) - k))


def first(w, F, G, N):
    """Return both sides of the first identity of the paper's Lemma 4.1, times h^alpha."""
    return (sum(plus(w, G, k) * F[k] for k in range(0, N)),
            sum(G[k] * minus(w, F, k) for k in range(1, N + 1)))


def second(w, F, G, N):
    """Return both sides of the second identity of the lemma."""
    return (sum(G[k + 1] * minus(w, F, k + 1) for k in range(0, N)),
            sum(plus(w, G, k) * F[k] for k in range(1, N)))


def out_of_phase(w, F, G, N):
    """Return both sides of the identity that the paper's Remark 4.2 calls false."""
    return (sum(plus(w, G, k) * F[k + 1] for k in range(0, N)),
            sum(G[k] * minus(w, F, k + 1) for k in range(1, N)))


#> leftovers
def left_first(w, F, G, N):
    return w[0] * (F[0] * G[0] - F[N] * G[N])


def left_second(w, F, G, N):
    return F[0] * sum(w[n] * G[n] for n in range(1, N + 1)) + w[0] * F[N] * G[N]


def left_out_of_phase(w, F, G, N):
    return (w[0] * G[0] * F[1] + G[N] * sum(w[N + 1 - j] * F[j] for j in range(1, N + 1))
            - F[0] * sum(w[k + 1] * G[k] for k in range(1, N)))
#< leftovers


IDENTITIES = [("5.5", first, left_first), ("5.6", second, left_second),
              ("5.8", out_of_phase, left_out_of_phase)]


def prove_all(w, N, what):
    F, G = symbols(f"F0:{N + 1}"), symbols(f"G0:{N + 1}")
    #> full
    prove(f"(5.4) full range, N = {N}, {what}",
          expand(sum(plus(w, G, k) * F[k] for k in range(N + 1))
                 - sum(G[k] * minus(w, F, k) for k in range(N + 1))))
    #< full
    for number, sides, left in IDENTITIES:
        lhs, rhs = sides(w, F, G, N)
        prove(f"({number}) what is left over, N = {N}, {what}",
              expand(lhs - rhs - left(w, F, G, N)))
    ends = {F[0]: 0, F[N]: 0, G[0]: 0, G[N]: 0}
    for number, sides, left in IDENTITIES:
        prove(f"({number}) nothing is left under the lemma's hypotheses",
              left(w, F, G, N).subs(ends))
    prove("(5.8) F_N is free", left_out_of_phase(w, F, G, N).subs(
        {F[0]: 0, G[0]: 0, G[N]: 0}))
    prove("(5.6) G_0 is free, and one of F_N, G_N", left_second(w, F, G, N).subs(
        {F[0]: 0, F[N]: 0}), left_second(w, F, G, N).subs({F[0]: 0, G[N]: 0}))
    back = G[::-1]
    for k in range(N + 1):
        prove(f"(5.7) Delta_+ = J Delta_- J, N = {N}, k = {k}",
              expand(plus(w, G, k) - minus(w, back, N - k)))
    prove(f"(5.9) the other shift, N = {N}, {what}",
          expand(sum(plus(w, G, k) * F[k - 1] for k in range(1, N + 1))
                 - sum(G[k] * minus(w, F, k - 1) for k in range(1, N + 1))))
    printed = sum(minus(w, G, k) * F[k] for k in range(0, N))
    meant = sum(plus(w, G, k) * F[k] for k in range(0, N))
    off = sum(w[k - j] * (G[k] * F[j] - G[j] * F[k])
              for k in range(1, N) for j in range(1, k))
    prove(f"(5.10) the printed step 2 is off by this, N = {N}, {what}",
          expand((meant - printed).subs(ends) - off))


for N in (6, 7, 8):
    prove_all([weight(a, n) for n in range(N + 2)], N, "alpha symbolic")
    prove_all(symbols(f"w0:{N + 2}"), N, "(5.13) any weights")

# (5.10), alpha = 1 and h = 1: the two sides of step 2 for these integers.
w = [weight(1, n) for n in range(6)]
F, G = [0, 1, 0, 0], [0, 0, 1, 0]
claim("(5.10) the counterexample: -1, not 0",
      (first(w, F, G, 3)[1], sum(minus(w, G, k) * F[k] for k in range(3)),
       sum(plus(w, G, k) * F[k] for k in range(3))) == (-1, 0, -1))
N = 7
F, G = symbols(f"F0:{N + 1}"), symbols(f"G0:{N + 1}")
w = [weight(1, n) for n in range(N + 2)]
lhs, rhs = first(w, F, G, N)
prove("(5.11) alpha = 1: the first identity is summation by parts",
      expand(lhs + sum((G[k + 1] - G[k]) * F[k] for k in range(N))),
      expand(rhs - sum(G[k] * (F[k] - F[k - 1]) for k in range(1, N + 1))),
      expand(rhs - lhs - (G[N] * F[N] - G[0] * F[0])))

#> toeplitz
N = 5
w = symbols(f"w0:{N + 1}")
T = Matrix(N + 1, N + 1, lambda k, j: w[k - j] if k >= j else 0)
J = Matrix(N + 1, N + 1, lambda k, j: int(k + j == N))
prove("(5.13) T' = J T J", *(T.T - J * T * J))
A = Matrix(N + 1, N + 1, lambda k, j: symbols(f"A{k}{j}"))
F, G = Matrix(symbols(f"F0:{N + 1}")), Matrix(symbols(f"G0:{N + 1}"))
prove("(5.13) any matrix and its transpose", expand((G.T * A * F - (A.T * G).T * F)[0]))
T[3, 1] += 1
claim("(5.13) one entry off its diagonal, and the mirror is broken", T.T != J * T * J)
#< toeplitz

# (5.14), x = s h: the factor divided by s^alpha, by its logarithm.
x = symbols("x", positive=True)
factor = exp(a * series(log(series((1 - exp(-x)) / x, x, 0, 4).removeO()), x, 0, 3).removeO())
prove("(5.14) both operators are of order one", series(factor, x, 0, 3).removeO().expand()
      - expand(1 - a * x / 2 + a * (3 * a + 1) * x ** 2 / 24))

# ---- values of both operators, doubles as they are ----

Z = [3, -1, 4, 1, -5, 9, 2, -6, 5, 3, -5, 8, -9]
RUNS = [(0.0, 0.3), (0.1, 1.0), (0.25, 0.1), (1 / 3, 0.5), (0.5, 0.2), (0.75, 1e-3),
        (0.9, 7.0), (1.0, 0.1), (1.5, 0.25), (2.0, 3.0)]


def value(order, h, terms, sizes=False):
    """Return h^-alpha sum_n alpha_n terms_n, or with sizes the sum of the absolute values, as a double literal."""
    def digits_of(digits):
        mpmath.mp.dps = digits + 20
        o, weights = mpmath.mpf(order), []
        for n in range(len(terms)):
            weights.append((-1) ** n * mpmath.binomial(o, n))
        pick = abs if sizes else (lambda x: x)
        return mpmath.nstr(mpmath.mpf(h) ** (-o) * mpmath.fsum(
            pick(x * z) for x, z in zip(weights, terms)), digits)
    return hexd_real(digits_of)


header("verify/integration_by_parts/integration_by_parts.py")
array("ref_z", Z, "the sequence of the next table")
rows = []
for order, h in RUNS:
    for k in range(len(Z)):
        past, future = Z[k::-1], Z[k:]
        rows.append([hexd(order), hexd(h), k, value(order, h, past), value(order, h, future),
                     value(order, h, past, True), value(order, h, future, True),
                     f"alpha = {order!r}, h = {h!r}"])
table("ref_values", "double alpha, h; size_t k; double minus, plus, size_minus, size_plus;", rows)

# ---- both sides of every identity, integer vectors of R^2, h = 1 ----

N, D = 8, 2
random = Random(5)
inner = {s: [[random.choice([-3, -2, -1, 1, 2, 3]) for _ in range(D)] for _ in range(N + 1)]
         for s in "FG"}
END = {"F0": (2, 1), "FN": (-1, 3), "G0": (3, -2), "GN": (1, 2)}
CASES = ["", "F0", "FN", "G0", "GN", "F0 G0", "FN GN", "F0 FN", "G0 GN", "F0 GN", "FN G0",
         "F0 FN G0", "F0 FN G0 GN"]


def sequences(case):
    """Return integer vectors F and G. Of the four end values, only those that `case` names are not zero."""
    out = {}
    for s in "FG":
        z = [list(v) for v in inner[s]]
        z[0], z[N] = ([*END[s + e]] if s + e in case.split() else [0] * D for e in "0N")
        out[s] = z
    return out["F"], out["G"]


def both_sides(order, F, G):
    w = [Rational(weight(order, n)) for n in range(N + 2)]
    values, expected = [], []
    for _, sides, left in IDENTITIES:
        per = [sides(w, [v[i] for v in F], [v[i] for v in G], N) for i in range(D)]
        lhs, rhs = (sum(p[j] for p in per) for j in (0, 1))
        rest = sum(left(w, [v[i] for v in F], [v[i] for v in G], N) for i in range(D))
        claim("the leftover is the difference", lhs - rhs == rest)
        values += [lhs, rhs]
        expected.append(rest)
    return values, expected


def exactly(x):
    """Return a rational that is a double, as this double."""
    claim(f"{x} is a double", Rational(float(x)) == Rational(x))
    return hexd(x)


def braces(numbers):
    return "{ " + ", ".join(numbers) + " }"


rows, seen = [], {}
for case in CASES + ["F0 G0 FN GN, F0.G0 = FN.GN"]:
    F, G = sequences(case.replace(",", ""))
    if "." in case:  # such that F_0 . G_0 = 4 = F_N . G_N
        G[N] = [2, 2]
    for order in (Rational(1, 4), Rational(1, 2), 1, Rational(3, 2)):
        sides, rest = both_sides(order, F, G)
        if order != 1:  # for alpha = 1 there are two weights, so some differences vanish
            seen.setdefault(case, []).append([r == 0 for r in rest])
        flat = [[str(c) for v in z for c in v] for z in (F, G)]
        rows.append([f'"{case or "none"}"', hexd(order), braces(flat[0]), braces(flat[1]),
                     braces([exactly(s) for s in sides]), braces([exactly(r) for r in rest])])
# not zero        first  second out of phase: whether the identity holds
for case, flags in {"": [True, True, True],
                    "F0": [True, False, False], "FN": [True, True, True],
                    "G0": [True, True, False], "GN": [True, True, False],
                    "F0 G0": [False, False, False], "FN GN": [False, False, False],
                    "FN G0": [True, True, False], "F0 GN": [True, False, False],
                    "F0 G0 FN GN, F0.G0 = FN.GN": [True, False, False]}.items():
    claim(f"which identities survive {case!r}", all(f == flags for f in seen[case]))
print(f"\nenum {{ REF_N = {N}, REF_D = {D} }};")
print("\n/* Which end values are not zero; the order; F; G; both sides of the first, the\n"
      " * second and the out-of-phase identity; what is left over. h = 1. All exact. */")
size = (N + 1) * D
table("ref_sums", f"const char *ends; double alpha; double F[{size}]; double G[{size}]; "
      "double sides[6]; double left[3];", rows)
