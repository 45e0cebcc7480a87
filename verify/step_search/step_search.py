"""H 18. When the differences of runs are reliable error estimates.

Proved here, all parameters symbolic:
  (18.2)  errors C (h/2^j)^q have D_j = (2^q - 1) times the error of x^(j), and q_j = q;
  (18.6)  an undamped spring under a method that takes U at the midpoint, started at
          rest: x_k = x_0 cos(k phi), tan(phi/2) = sqrt(W)/2; phi = pi - 4/sqrt(W) + ...;
          so 1 - x_k/x_0 = 8 k^2/W + ... at even k, and D_{j+1}/D_j tends to 16;
  (18.7)  of the angles v in (0, pi), the share with |cos v - c| <= (1 + c)/2 grows up to
          c = 1/3 and falls after it; there it is arccos(-1/3)/pi < 0.61, and
          0.61^128 < 10^-27;
  (18.8)  C_4 is 1 for the ends of steps, and 1/80 for the four nodes of a step of Lobatto's.
That no function of the x^(j) can detect an alias is proved by hand in the chapter.
Printed: x_k = cos(k phi), at 60 digits."""
import mpmath
from sympy import (Matrix, Rational, acos, atan, cos, diff, expand, expand_trig, limit, pi, simplify, sin,
                   sqrt, symbols)

from shared.refgen import claim, header, hexd, hexd_real, prove, table

C, h, q, j = symbols("C h q j", positive=True)
error = lambda j: C * (h / 2**j) ** q
D = lambda j: error(j - 1) - error(j)
prove("(18.2) D_j is 2^q - 1 times the error", D(j) / error(j) - (2**q - 1))
prove("(18.1) D_{j-1} / D_j = 2^q", D(j - 1) / D(j) - 2**q)

# One step in units of x and of p h / m: x' - x = p - (W/2) S, p' = p - W S, S = (x + x')/2.
W, k, u = symbols("W k u", positive=True)
x, p = symbols("x p")
after = (x + p - W / 4 * x) / (1 + W / 4)
momentum = p - W * (x + after) / 2
prove("the step solves its equation", after - x - (p - W / 2 * (x + after) / 2))
step = Matrix([after, momentum]).jacobian([x, p])
phi = 2 * atan(sqrt(W) / 2)
#> turn
turn = Matrix([[cos(phi), sin(phi) / sqrt(W)], [-sqrt(W) * sin(phi), cos(phi)]])
prove("(18.6) a step is a turn by phi, tan(phi/2) = sqrt(W)/2",
      *(step - turn).applyfunc(lambda e: simplify(expand_trig(e))))
#< turn
lack = 2 * atan(2 / sqrt(W))                # pi - phi
prove("(18.6) phi is pi less that", diff(phi + lack, W), (phi + lack).subs(W, 4) - pi)
prove("(18.6) phi = pi - 4/sqrt(W) + ...", limit(lack.subs(W, 1 / u**2) / u, u, 0) - 4)
rest = 1 - cos(k * 2 * atan(2 * u))         # k even: cos(k phi) = cos(k (pi - phi))
prove("(18.6) 1 - x_k/x_0 = 8 k^2/W + ...", limit(rest / u**2, u, 0) - 8 * k**2)
t, c, m = symbols("t c m", positive=True)
still = lambda h: 8 * (t / h) ** 2 / (h**2 * c / m)
prove("(18.6) D_{j+1} / D_j = 16", (still(h / 4) - still(h / 2)) / (still(h / 2) - still(h)) - 16)

# (18.7): below c = 1/3 both ends of the interval lie in [-1, 1], above it only the lower end does.
a = symbols("a", positive=True)
low, high = (a - 1) / 2, (3 * a + 1) / 2
prove("the ends of |cos v - c| <= (1 + c)/2", low - (a - (1 + a) / 2), high - (a + (1 + a) / 2))
claim("the upper end leaves the circle at c = 1/3", high.subs(a, Rational(1, 3)) == 1)
# d/dc of acos(low) - acos(high) is 3/sqrt(4 - (3c+1)^2) - 1/sqrt(4 - (c-1)^2), which is positive.
slope = diff(acos(low) - acos(high), a)
prove("(18.7) the slope below 1/3", slope**2 - (3 / sqrt(4 - (3 * a + 1) ** 2) - 1 / sqrt(4 - (a - 1) ** 2)) ** 2)
prove("(18.7) its sign: 9 (4 - (c-1)^2) - (4 - (3c+1)^2) = 24 + 24 c",
      expand(9 * (4 - (a - 1) ** 2) - (4 - (3 * a + 1) ** 2) - 24 - 24 * a))
claim("(18.7) the slope above 1/3 is negative", diff(acos(low), a).subs(a, Rational(1, 2)) < 0)
claim("(18.7) the largest share", acos(Rational(-1, 3)) / pi < Rational(61, 100))
claim("(18.7) 128 times", Rational(61, 100) ** 128 < Rational(1, 10**27))

# (18.8): as functions of y = (t - 3/2)^2 and of w = t (1 - t) both products are parabolas, so their largest size is
# at the vertex or at an end of the range.
y, w = symbols("y w")
ends, stages = (y - Rational(1, 4)) * (Rational(9, 4) - y), w * (Rational(1, 5) - w)
prove("(18.8) four ends of steps", expand(ends.subs(y, (t - Rational(3, 2)) ** 2) - t * (1 - t) * (2 - t) * (3 - t)))
prove("(18.8) four nodes of Lobatto's", expand(stages.subs(w, t * (1 - t)) - t * (1 - t) * (t**2 - t + Rational(1, 5))))
prove("(18.8) the vertices", diff(ends, y).subs(y, Rational(5, 4)), diff(stages, w).subs(w, Rational(1, 10)))
claim("(18.8) C_4 = 1", max(abs(ends.subs(y, v)) for v in (0, Rational(5, 4), Rational(9, 4))) == 1)
claim("(18.8) C_4 = 1/80", max(abs(stages.subs(w, v)) for v in (0, Rational(1, 10), Rational(1, 4))) == Rational(1, 80))
prove("(18.8) the place of the first", (3 - sqrt(5)) / 2 - (Rational(3, 2) - sqrt(Rational(5, 4))))

header("verify/step_search/step_search.py")
rows = []
for stiffness, length in ((1, 0.5), (1e4, 0.5), (1e8, 0.25), (1e16, 0.125), (1e16, 0.015625)):
    for number in (1, 2, 9, 64, 640):
        def value(digits, W=Rational(stiffness) * Rational(length) ** 2, number=number):
            with mpmath.workdps(digits + 20):
                w = mpmath.sqrt(mpmath.mpf(int(W.p)) / int(W.q))
                return mpmath.nstr(mpmath.cos(number * 2 * mpmath.atan(w / 2)), digits)
        rows.append([hexd(stiffness), hexd(length), number, hexd_real(value)])
table("ref_turns", "double c, h; size_t k; double x;", rows)
