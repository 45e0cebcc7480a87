"""H 0: springs, dashpots and springpots. Prints tests/springpot/springpot_ref.h.

  (0.2)  the creep of a springpot, and its recovery when the force ends;
  (0.4)  force over displacement of the ladder: its root, its square, its limit for slow motions, and the
         creep 2 t e^{-2t} (I_0(2t) + I_1(2t)), as a series, with its limit for large t;
  (0.5)  the constant of a graded ladder, from Bessel's equation and at 30 digits.

Times are exact doubles; k = eta = 1."""
import mpmath
from mpmath import mp, mpf
from sympy import Rational, besseli, diff, exp, factorial, gamma, gammasimp, series, sqrt, symbols

from shared.refgen import claim, header, hexd, hexd_real, prove, table

t, s, q, k, rho, z = symbols("t s q k rho z", positive=True)
beta = symbols("beta", positive=True)

# (0.2) In Laplace's transforms the force 1/s makes X = 1 / (rho s^(1 + beta)).
transform = gamma(1 + beta) / s ** (1 + beta) / (rho * gamma(1 + beta))
prove("(0.2) s^beta X = force / rho", gammasimp(rho * s**beta * transform - 1 / s))

#> ladder
# (0.4) From node to node the motion decreases by the factor r; q = eta s / k.
r = 1 + q / 2 - sqrt(q**2 + 4 * q) / 2
Z = k * (1 - r) + k * q / 2                # the first spring, and half a rung
prove("(0.3) the nodes", r**2 - (2 + q) * r + 1)
prove("(0.4) force over displacement", Z - k / 2 * sqrt(q**2 + 4 * q))
prove("(0.4) slow", series(Z / (k * sqrt(q)), q, 0, 2).removeO() - 1 - q / 8)
#< ladder
for number in (Rational(1, 100), 1, 100):
    claim("(0.4) far nodes rest: 0 < r < 1", 0 < r.subs(q, number) < 1)

# Its creep: the derivative is 2 e^{-2t} I_0(2t), whose transform is 1 / (s Z) times s.
creep = 2 * t * exp(-2 * t) * (besseli(0, 2 * t) + besseli(1, 2 * t))
difference = diff(creep, t) - 2 * exp(-2 * t) * besseli(0, 2 * t)
for point in (Rational(1, 3), 2, 17):
    claim("x' = 2 e^{-2t} I_0(2t)", abs(difference.subs(t, point).evalf(30)) < 1e-25)
p = symbols("p", positive=True)            # p = s + 2: the transform of I_0(2t), term by term
terms = sum(factorial(2 * n) / factorial(n) ** 2 * p ** (2 * n) for n in range(8))
prove("the transform of I_0(2t) is 1 / sqrt(p^2 - 4), in 1/p",
      series(1 / sqrt(1 - 4 * p**2), p, 0, 16).removeO() - terms)
prove("1 / Z, k = eta = 1", 1 / (Z / k).subs(q, s) - 2 / sqrt((s + 2) ** 2 - 4))
# Slow motions: both I_nu(z) e^{-z} sqrt(2 pi z) are 1 - (4 nu^2 - 1) / (8 z) + ...
prove("the creep is (1 - 1 / (16 t)) of the springpot's",
      ((1 + 1 / (8 * z)) + (1 - 3 / (8 * z))).subs(z, 2 * t) / 2 - (1 - 1 / (16 * t)))

#> graded
# (0.5) With springs k x^a, dashpots eta x^a, a = 1 - 2 beta and q = eta s / k the equation is (x^a X')' = q x^a X.
# The force at x of its decreasing solution is -k x^a X'.
def graded(b, Q):
    def X(x):
        return x**b * mpmath.besselk(b, mpmath.sqrt(Q) * x)

    def force(x):
        return x ** (1 - b) * mpmath.sqrt(Q) * mpmath.besselk(1 - b, mpmath.sqrt(Q) * x)

    return X, force


with mp.workdps(60):
    for b in (mpf(1) / 4, mpf(1) / 2, mpf(9) / 10):
        for Q in (mpf(1) / 10, mpf(3)):
            X, force = graded(b, Q)
            claim("(0.5) the force", abs(mpmath.diff(X, 2) * mpf(2) ** (1 - 2 * b) + force(2)) < 1e-20)
            claim("(0.5) the equation", abs(mpmath.diff(force, 2) + Q * mpf(2) ** (1 - 2 * b) * X(2)) < 1e-20)
            rho_ = 2 ** (1 - 2 * b) * mpmath.gamma(1 - b) / mpmath.gamma(b)
            near = mpf(10) ** -200         # the error is near^(2 min(b, 1 - b))
            claim("(0.5) rho s^beta", abs(force(near) / X(near) / (rho_ * Q**b) - 1) < mpf(10) ** -35)
#< graded

header("verify/springpot/springpot.py")
start = Rational(80, 1024)                 # 80 steps of 1/1024, then of twice this length, ...
rows = []
for doublings in (1, 4, 8, 12, 16):
    time = start * (2**doublings - 1)

    def value(digits):
        with mp.workdps(digits + 20):
            T = 2 * mpf(time.p) / time.q
            return mpmath.nstr(T * mpmath.exp(-T) * (mpmath.besseli(0, T) + mpmath.besseli(1, T)), digits)

    rows.append([doublings, hexd(time), hexd_real(value), f"t = {float(time):.6g}"])
print("\n/* The creep of the uniform ladder, k = eta = f = 1, after so many times 80 steps. */")
table("ref_creep", "int doublings; double t, x;", rows)
