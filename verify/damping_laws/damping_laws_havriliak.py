"""H 26: the law of Havriliak and Negami. Prints tests/damping_laws/damping_laws_havriliak_ref.h.

  (26.1)  its derivatives by alpha, time and the exponent, and by ln s;
  (26.2)  it is passive: the angle of (1 + T q)^B is between 0 and the angle of q;
  (26.3)  the weights, from the power series of C(delta(z)/h) in 40 digits;
  (26.9)  a body held at 1, and one under a unit force, by Talbot's inversion of the Laplace transform.

Inputs are the doubles they are."""
import mpmath
from mpmath import mp, mpc, mpf
from sympy import atan2, cos, diff, log, pi, sin, symbols

from shared.refgen import claim, header, prove

mp.dps = 40
s, a, T, B = symbols("s a T B", positive=True)

#> slopes
q = s ** (2 * a)
C = q / (1 + T * q) ** B
prove("by alpha", (diff(C, a) - 2 * log(s) * C * (1 + (1 - B) * T * q) / (1 + T * q)).simplify())
prove("by time", (diff(C, T) + B * C * q / (1 + T * q)).simplify())
prove("by the exponent", diff(C, B) + C * log(1 + T * q))
prove("by ln s", (s * diff(C, s) - 2 * a * C * (1 + (1 - B) * T * q) / (1 + T * q)).simplify())
#< slopes

# q = r e^{i phi} with 0 < phi <= pi/2: the angle of 1 + T q is less than phi, as tan of it is r T sin(phi) over more than
# r T cos(phi); so the angle phi - B angle of C is between 0 and phi.
r, phi = symbols("r phi", positive=True)
prove("(26.2)", (diff(atan2(T * r * sin(phi), 1 + T * r * cos(phi)), r)
                 - T * sin(phi) / (1 + 2 * T * r * cos(phi) + (T * r) ** 2)).simplify())  # it grows with r, to phi

# rho, alpha, time, exponent: exact doubles, and the one of the manual
LAWS = [(mpf(1), mpf("0.3125"), mpf("0.75"), mpf("0.5")), (mpf("0.5"), mpf("0.4375"), mpf(3), mpf("0.875")),
        tuple(mpf(x) for x in (0.4, 0.3, 2.0, 0.6))]


def symbol(law, at):
    rho, alpha, time, exponent = law
    power = mpmath.exp(2 * alpha * mpmath.log(at))
    return rho * power / (1 + time * power) ** exponent


# ---- weights ----

COUNT = 151
DELTA = [[mpf(1), mpf(-1)], [mpf(3) / 2, mpf(-2), mpf(1) / 2]]  # Euler, BDF2
INDICES = [0, 1, 2, 3, 10, 32, 33, 34, 60, 100, 150]


def power(base, nu):
    """base^nu of a power series."""
    w = [base[0] ** nu]
    for n in range(1, COUNT):
        w.append(mpmath.fsum((nu * j - n + j) * base[j] * w[n - j] for j in range(1, min(n, len(base) - 1) + 1))
                 / (n * base[0]))
    return w


def weights(law, delta, h):
    rho, alpha, time, exponent = law
    above = power([d / h for d in delta], 2 * alpha)
    below = power([int(n == 0) + time * c for n, c in enumerate(above)], -exponent)
    return [rho * mpmath.fdot(above[:n + 1], below[n::-1]) for n in range(COUNT)]


# ---- motions: m = c = 1 ----

def transform(law, x0, v0, force):
    def X(at):
        K = symbol(law, at)
        return (at * x0 + v0 + (K * x0 + force) / at) / (at ** 2 + 1 + K)
    return X


def motion(law, x0, v0, force, t):
    values = [mpmath.invertlaplace(transform(law, x0, v0, force), t, method="talbot", degree=degree) for degree in (120, 140)]
    claim("25 digits", abs(values[0] - values[1]) < mpf(10) ** -25)
    return values[1]


#> zener
# With the exponent 1 it is the law of Zener.
for at in (mpf(2), mpc(1, 3)):
    rho, alpha, time, _ = LAWS[0]
    above = at ** (2 * alpha)
    claim("exponent 1", abs(symbol((rho, alpha, time, mpf(1)), at) - rho * above / (1 + time * above)) < mpf(10) ** -35)
#< zener


def nearest(x):
    return "0" if x == 0 else float(mpmath.nstr(x, 20)).hex()


def row(law):
    return "{ FVI_KERNEL_HAVRILIAK, %s }" % ", ".join(nearest(n) for n in law)


header("verify/damping_laws/damping_laws_havriliak.py")
print("\n#include <fvi/damping_laws.h>")
print("\nstatic const fvi_kernel_term ref_havriliak[] = {")
for law in LAWS:
    print(f"    {row(law)},")
print("};")
print(f"\nenum {{ REF_INDICES = {len(INDICES)} }};")
print("static const size_t ref_index[REF_INDICES] = { %s };" % ", ".join(map(str, INDICES)))
print("\nstatic const struct { size_t law; fvi_delta kind; double h, w[REF_INDICES]; } ref_weights[] = {")
for i, law in enumerate(LAWS):
    for kind in (0, 1):
        for step in (mpf(1) / 8, mpf(1) / 512):
            w = weights(law, DELTA[kind], step)
            print(f"    {{ {i}, {('FVI_DELTA_EULER', 'FVI_DELTA_BDF2')[kind]}, {nearest(step)}, "
                  f"{{ {', '.join(nearest(w[n]) for n in INDICES)} }} }},")
print("};")
print("\n/* m = c = 1, and F from t = 0 on. */")
print("static const struct { size_t law; double x0, p0, F, t, x; } ref_motions[] = {")
for i, law in enumerate(LAWS):
    for x0, v0, F in ((1, 0, 0), (0, 0, 1), (1, mpf(1) / 2, 0)):
        for t in (1, 4, 10, 20):
            print(f"    {{ {i}, {x0}, {nearest(mpf(v0))}, {F}, {t}, {nearest(motion(law, x0, v0, F, mpf(t)))} }},")
print("};")
