"""H 10, the problem x'' + x + D^(3/2) x = F of Bagley and Torvik, F = 8 up to t = 1, then 0, with zero data.

Proved: the transform behind the series (10.8) and its expansion. Claimed: that the series is the sum of error
functions over the roots of w^4 + w^3 + 1; rational values at h = 1/4; the comparisons that give a slope of 0.97 or
0.96; the response of x to an error.

Printed: the exact solution from its series; trajectories of the FVI from (9.3) and of the matrix method (10.9), row
by row with many digits, for h = 1/4 by elimination in rationals; the errors that the C code must reproduce."""
import math
from fractions import Fraction
from functools import cache
from operator import mul

import mpmath
from sympy import Matrix, Rational, expand, symbols

from shared.refgen import array, claim, header, hexd_real, prove, table

mpf = mpmath.mpf

BITS = 256                                  # bits of the series, which loses 40 of them
fixed = lambda v, bits: int(mpmath.floor(v * 2**bits + mpf(1) / 2))
mpmath.mp.prec = BITS + 60


def rounded(v):
    return hexd_real(lambda n: mpmath.nstr(v, n), 20)


def least_squares(points):
    """Return the slope of log error against log h."""
    u = [(mpmath.log(h), mpmath.log(e)) for h, e in points]
    ux, uy = (sum(p[i] for p in u) / len(u) for i in range(2))
    return sum((p[0] - ux) * (p[1] - uy) for p in u) / sum((p[0] - ux)**2 for p in u)


#> series
z = symbols("z")                            # s^(-1/2)
d_ = []                                     # 1 / (1 + z + z^4) = sum d_n z^n
for n in range(400):
    d_.append(int(n == 0) - (d_[n - 1] if n > 0 else 0) - (d_[n - 4] if n > 3 else 0))
prove("(10.8) the transform of the step response, 1 / (s (s^2 + s^(3/2) + 1))",
      z**6 / (1 + z + z**4) - 1 / (z**-2 * (z**-4 + z**-3 + 1)))
prove("(10.8) its expansion", *(expand((1 + z + z**4) * sum(d_[n] * z**n for n in range(40))
                                       - 1).coeff(z, n) for n in range(40)))
COEFFICIENTS = [fixed(d_[n] * mpf(20)**(2 + mpf(n) / 2) * mpmath.rgamma(3 + mpf(n) / 2), BITS)
                for n in range(400)]
claim("(10.8) forty bits cancel at t = 20",
      2**39 < sum(map(abs, COEFFICIENTS)) / abs(sum(COEFFICIENTS)) < 2**40)


@cache
def step_response(time):
    """Return y(t) = sum_n d_n t^(2 + n/2) / Gamma(3 + n/2) for t <= 20, in units of 2^-BITS."""
    if time <= 0:
        return 0
    power = (time.numerator << BITS) // (20 * time.denominator)
    root, y = math.isqrt(power << BITS), 0
    for coefficient in reversed(COEFFICIENTS):
        y = (y * root >> BITS) + coefficient
    return (y * power >> BITS) * power >> BITS


def bagley_torvik(time):
    return 8 * (step_response(time) - step_response(time - 1))
#< series


#> erfc
def by_erfc(time):
    """Return the same y(t) from the four roots of w^4 + w^3 + 1."""
    roots = mpmath.polyroots([1, 1, 0, 0, 1], maxsteps=200, extraprec=200)
    E = lambda u: mpmath.exp(u * u) * mpmath.erfc(-u)
    y = lambda s: 1 + sum(E(r * mpmath.sqrt(s)) / (r * (4 * r**3 + 3 * r**2)) for r in roots)
    return 8 * mpmath.re(y(time) - (y(time - 1) if time > 1 else 0))


for time in (Fraction(1, 10), Fraction(1), Fraction(3, 2), Fraction(7), Fraction(20)):
    claim("(10.8) series and error functions agree to 30 digits",
          abs(mpf(bagley_torvik(time)) / 2**BITS - by_erfc(mpf(time.numerator) / time.denominator)) < mpf(10)**-30)
#< erfc

SCALE = 128                                 # bits of the trajectories


def half_weights(N):
    """Return the weights of order 3/2, in units of 2^-SCALE."""
    g = [2**SCALE]
    for n in range(1, N + 1):
        g.append(g[-1] * (2 * n - 5) // (2 * n))
    return g


def solve_rows(n_per_unit, T, matrix_method):
    """Return x of the FVI or of the matrix method for m = c = rho = 1, alpha = 3/4, in units of 2^-SCALE."""
    N = n_per_unit * T
    n2, g = n_per_unit**2, half_weights(N)
    g32 = fixed(mpf(n_per_unit) ** 1.5, SCALE)
    x = [0, 0]                              # FVI: p_0 = 0 gives x_1 = 0
    for k in range(1, N):
        j = k + 1 if matrix_method else k   # the row whose force and memory enter the step
        past = sum(map(mul, g[j - k:j + 1], reversed(x)))       # w_n x_{j-n}, without the unknown x_{k+1}
        force = (8 << SCALE) if j <= n_per_unit else 0
        rest = force + n2 * (2 * x[k] - x[k - 1]) - (g32 * (past >> SCALE) >> SCALE)
        if matrix_method:
            x.append((rest << SCALE) // ((n2 + 1 << SCALE) + g32))
        else:
            x.append((4 * rest - 2 * x[k] - x[k - 1]) // (4 * n2 + 1))
    return x


fine = lambda v: rounded(mpf(v) / 2**SCALE)


def error_row(n, x, want):
    errors = [abs(u - v) for u, v in zip(x, want)]
    k, tenths = errors.index(max(errors)), max(errors[::n // 10])
    note = f"h = 1/{n}: {mpmath.nstr(mpf(errors[k]) / 2**SCALE, 9)} at t = {k / n}"
    return tenths, [n, fine(errors[k]), k, fine(want[k]), fine(tenths)], note


# The response of x to a unit error in one row of the matrix; then the sum over all rows, and the largest response.
g, answer = [w / 2**SCALE for w in half_weights(800)], []
column = [40**1.5 * w + 1600 * i for w, i in zip(g, [1, -2, 1] + [0] * 798)]
column[0] += 1
for k in range(800):
    answer.append(((k == 0) - sum(map(mul, column[1:k + 1], reversed(answer)))) / column[0])
claim("a unit in every row makes less than 3 in x", sum(map(abs, answer)) < 2.9)
claim("a unit in p makes less than 0.6 in x", max(map(abs, answer)) * 40 < 0.6)

exact = {n: [bagley_torvik(Fraction(k, n)) >> BITS - SCALE for k in range(20 * n + 1)]
         for n in (10, 20, 40, 50, 80, 160, 200)}
header("verify/experiments/experiments_bagley_torvik.py")
print("\n/* x(k / 10), k = 0, ..., 200. */\nstatic const double ref_bagley_torvik[] = {")
for k, v in enumerate(exact[10]):
    print(f"    {fine(v)}," + (f" /* {mpmath.nstr(mpf(v) / 2**SCALE, 18)} */" if k % 10 == 0 else ""))
print("};")
benchmark = solve_rows(200, 20, True)
fields = "size_t per_unit; double error; size_t k; double x; double tenths;"
rows, fvi_errors = [], {}
for n in (10, 20, 40, 50, 80, 160):
    x = solve_rows(n, 20, False)
    tenths, row, note = error_row(n, x, exact[n])
    fvi_errors[n] = tenths, max(abs(u - v) for u, v in zip(x[::n // 10], benchmark[::20]))
    rows.append(row + [fine(fvi_errors[n][1]), note])
#> ninety-seven
orders = lambda i, *ns: float(least_squares([(mpf(1) / n, fvi_errors[n][i]) for n in ns]))
claim("against the exact solution: 0.97 at first, then up to 1",
      0.965 < orders(0, 10, 20) < 0.975 < orders(0, 20, 40) < orders(0, 40, 80) < orders(0, 80, 160) < 1)
claim("against the benchmark: 1.30, 0.92, then downhill no more",
      [round(orders(1, a, b), 2) for a, b in ((10, 20), (20, 40))] == [1.30, 0.92]
      and orders(1, 40, 50) < 0 and orders(1, 80, 160) < 0)
claim("four points of that make 0.96", round(orders(1, 10, 20, 40, 50), 2) == 0.96)
#< ninety-seven
print("\n/* FVI: largest error on the grid, where, x there; largest at the tenths;\n"
      " * there, the largest difference from the matrix method with h = 1/200. */")
table("ref_fvi_errors", fields + " double against;", rows)
rows = []
for n in (10, 20, 40, 80, 200):
    x = benchmark if n == 200 else solve_rows(n, 20, True)
    _, row, note = error_row(n, x, exact[n])
    rows.append(row + [note])
print("\n/* The matrix method, likewise. */")
table("ref_matrix_errors", fields, rows)

#> elimination
# h = 1/4, all rational: the matrices of (10.9) filled and eliminated.
K, g = 9, [Rational(1)]
for n in range(1, K):
    g.append(g[-1] * (n - 1 - Rational(3, 2)) / n)
toeplitz = lambda v: Matrix(K, K, lambda i, j: v[i - j] if 0 <= i - j < len(v) else 0)
M = 16 * toeplitz([1, -2, 1]) + 8 * toeplitz(g) + Matrix.eye(K)
F = Matrix([8 if k <= 4 else 0 for k in range(K)])
small = [Rational(0)] * 2 + list(M[2:, 2:].LUsolve(F[2:, :]))
#< elimination
array("ref_matrix_quarter", small, "The matrix method for h = 1/4: exact")
x = [Rational(0), Rational(0)]
for k in range(1, 5):
    memory = 8 * sum(g[n] * x[k - n] for n in range(k + 1))
    x.append((8 - 16 * (x[k - 1] - 2 * x[k]) - x[k] / 2 - x[k - 1] / 4 - memory) / (16 + Rational(1, 4)))
claim("rational x of the Bagley-Torvik problem, h = 1/4", x[2:] == [
    Rational(32, 65), Rational(5088, 4225), Rational(578112, 274625), Rational(55885888, 17850625)])
array("ref_fvi_quarter", x, "The FVI for h = 1/4: exact")
