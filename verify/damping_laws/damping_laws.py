"""H 26: damping by its symbol. Prints tests/damping_laws/damping_laws_ref.h.

  (26.2)  every law is passive: Im C(i w) >= 0, from the symbols;
  (26.3)  the weights, from the power series of C(delta(z)/h) in 40 digits;
  (26.5)  in a fraction's division all products have one sign;
  (26.6)  C over the cut, and the weights as integrals along it;
  (26.7)  the weights of a Maxwell element are geometric sequences;
  (26.8)  W = S^2 with S a real power series whenever W(0) > 0;
  (26.9)  motions of an oscillator, by inversion of its Laplace transform;
  (26.12) weights on two and three Lobatto nodes, by Cauchy's integral and by the cut;
  (26.13) the memory of the alternating path of two stages;
  (26.15) means, and delta of BDF2 on the unit circle;
  (26.11) zeros of m s^2 + c + C(s), counted along the boundary of the upper half plane;
  (26.22) a law from its loss at all frequencies, and Theorem 17.3 of two stages for each frequency.

All inputs are exact doubles."""
import cmath
import functools

import mpmath
from mpmath import mp, mpc, mpf
from sympy import I, Matrix, cos, eye, im, lambdify, sin, sqrt, symbols, trigsimp

from shared.arithmetic import circle, coefficients
from shared.refgen import claim, header, prove

mp.dps = 40
POWER, ZENER, MAXWELL, DISTRIBUTED, MAXWELL2, DAVIDSON = range(6)
# kind, rho, alpha, time, end: exact in binary
LAWS = [
    [(POWER, 1, "0.3125", 0, 0)],
    [(POWER, 1, "0.125", 0, 0), (POWER, "0.5", "0.375", 0, 0)],
    [(ZENER, 1, "0.3125", "0.75", 0)],
    [(MAXWELL, 1, 0, "0.75", 0), (MAXWELL, "0.5", 0, 3, 0)],
    [(DISTRIBUTED, 1, 0, 0, "0.5")],
    [(POWER, "0.5", "0.125", 0, 0), (POWER, "0.25", "0.75", 0, 0), (MAXWELL, "0.5", 0, "0.75", 0)],
    [(DISTRIBUTED, "0.5", "0.125", 0, "0.875")],
    [(POWER, "0.5", 0, 0, 0), (POWER, "0.25", "0.75", 0, 0), (ZENER, "0.5", "0.4375", "1.5", 0)],
    [(MAXWELL2, 1, "0.375", "0.75", "0.125")],
    [(MAXWELL2, "0.5", "0.9375", "1.5", "0.625"), (POWER, "0.25", "0.25", 0, 0)],
    [(DAVIDSON, 1, "0.3125", "0.75", 0)],
    [(DAVIDSON, "0.5", "0.4375", "1.5", 0), (POWER, "0.25", "0.75", 0, 0)],
]
LAWS = [[(kind, *map(mpf, numbers)) for kind, *numbers in law] for law in LAWS]

#> passive
# q / (1 + T q) with q = r e^{i phi} has the imaginary part r sin(phi) over a square, so it is >= 0 for phi in [0,
# pi]. s^{2a} at s = i w has phi = pi a, a Maxwell element has phi = pi/2, and an integral of numbers >= 0 is >= 0.
r, T, phi = symbols("r T phi", positive=True)
q = r * (cos(phi) + I * sin(phi))
bottom = (1 + T * r * cos(phi))**2 + (T * r * sin(phi))**2
prove("(26.2)", im((q * (1 + T * q.conjugate())).expand()).expand() - r * sin(phi),
      (1 + T * q) * (1 + T * q.conjugate()) - bottom)
#< passive


@functools.cache
def logarithm(s, precision):
    """Return log s. It is cached, because all laws are evaluated at the same points."""
    return mpmath.log(s)


def symbol(law, s):
    """Return C(s) in mpmath numbers, or in doubles if s is a double."""
    double = isinstance(s, complex)
    log, exp = (cmath.log(s), cmath.exp) if double else (logarithm(s, mp.prec), mpmath.exp)

    def term(kind, rho, alpha, time, end):
        if kind == DISTRIBUTED:
            return rho * (exp(2 * end * log) - exp(2 * alpha * log)) / (2 * log)
        if kind == DAVIDSON:
            return rho * exp(2 * alpha * log) * (1 + time * s)**(-2 * alpha)
        q = s if kind == MAXWELL else exp(2 * alpha * log)
        below = exp(2 * (alpha - end) * log) if kind == MAXWELL2 else q
        return rho * (q if kind == POWER else q / (1 + time * below))
    return sum(term(*t) for t in law)


# ---- power series in z, as lists of coefficients ----

def times(a, b):
    return [mpmath.fdot(a[:n + 1], b[n::-1]) for n in range(len(a))]


def over(a, b):
    out = []
    for n, top in enumerate(a):
        out.append((top - mpmath.fdot(b[1:n + 1], out[::-1])) / b[0])
    return out


@functools.cache
def power(base, nu):
    """Return base^nu by n b_0 w_n = sum_j (nu j - n + j) b_j w_{n-j}; base is a polynomial."""
    w, scaled = [base[0]**nu], [(nu + 1) * j * b for j, b in enumerate(base)]
    for n in range(1, COUNT):
        w.append(sum((scaled[j] - n * base[j]) * w[n - j]
                     for j in range(1, min(n, len(base) - 1) + 1)) / (n * base[0]))
    return w


COUNT = 151
DELTA = [[mpf(1), mpf(-1)], [mpf(3) / 2, mpf(-2), mpf(1) / 2]]  # Euler, BDF2
ORDERS = mpmath.calculus.quadrature.GaussLegendre(mp).calc_nodes(5, 160)


#> weights
def weights(law, delta, h):
    """Return the coefficients of C(delta(z)/h)."""
    base = tuple(d / h for d in delta)
    total = [mpf(0)] * COUNT
    for kind, rho, alpha, time, end in law:
        if kind == DISTRIBUTED:
            half, middle = (end - alpha) / 2, (end + alpha) / 2
            for node, weight in ORDERS:
                nu = 2 * (middle + half * node)         # these powers serve every h
                share = rho * half * weight * h**-nu
                total = [a + share * b for a, b in zip(total, power(tuple(delta), nu))]
            continue
        if kind == DAVIDSON:
            q = power(base, 2 * alpha)
            below = power((1 + time * base[0], *(time * b for b in base[1:])), -2 * alpha)
            total = [a + rho * b for a, b in zip(total, times(q, below))]
            continue
        q = power(base, mpf(1) if kind == MAXWELL else 2 * alpha)
        if kind != POWER:
            below = power(base, 2 * (alpha - end)) if kind == MAXWELL2 else q
            q = over(q, [int(n == 0) + time * c for n, c in enumerate(below)])
        total = [a + rho * b for a, b in zip(total, q)]
    return total
#< weights


# (26.5): all coefficients of (1-z)^beta, 0 < beta <= 1, but the first are <= 0, and their sum is more than -1. By
# induction the same holds for q / (1 + T q), so all products in the division have one sign.
for law in LAWS:
    for kind, rho, alpha, time, end in law:
        if kind == ZENER:
            w = weights([(kind, rho, alpha, time, end)], DELTA[0], mpf(1) / 8)
            claim("(26.5)", w[0] > 0 and all(c < 0 for c in w[1:]) and sum(w) > 0)


#> cut
def on_the_cut(law, n, delta, h):
    """Return w_n by (26.6), the integral along the cut, n >= 1, for a law without poles there."""
    def density(s):
        z = mpmath.exp(s)
        radius = -sum(d * z**j for j, d in enumerate(delta)) / h
        return (symbol(law, mpc(-radius, mpf(10)**-35)).imag) * mpmath.exp(-n * s)
    end = mpmath.inf if len(delta) == 2 else mpmath.log(3)
    return -mpmath.quad(density, [0, mpf(1) / n, mpf(10) / n, 1 if n < 10 else mpf(60) / n] +
                        ([end] if n < 10 and end != mpmath.inf else [])) / mpmath.pi
#< cut


mp.dps = 30
for law in LAWS[:3] + LAWS[4:5]:
    w = weights(law, DELTA[0], mpf(1) / 8)
    claim("(26.6)", all(abs(on_the_cut(law, n, DELTA[0], mpf(1) / 8) / w[n] - 1) < mpf(10)**-9
                        for n in (20, 120)))
mp.dps = 40

# ---- (26.7) ----
h, z, Tm = symbols("h z T", positive=True)
ratio = Tm / (h + Tm)
prove("(26.7)", (1 - z) / (h + Tm * (1 - z))
      - (1 / Tm) * (1 - h / (h + Tm) / (1 - ratio * z)))
root = symbols("w", positive=True)  # sqrt(1 - 2 h / T)
bottom = h + Tm * (1 - z) * (3 - z) / 2
prove("(26.7), BDF2", (bottom - Tm / 2 * (z - 2 + root) * (z - 2 - root)).subs(h, Tm * (1 - root**2) / 2))

# ---- (26.8): the square root of a power series with W(0) > 0, and its square ----
for law in LAWS:
    W = weights(law, DELTA[0], mpf(1) / 8)[:60]
    S = [mpmath.sqrt(W[0])]
    for n in range(1, 60):
        S.append((W[n] - mpmath.fdot(S[1:n], S[:0:-1])) / (2 * S[0]))
    claim("(26.8)", max(abs(a - b) for a, b in zip(times(S, S), W)) < mpf(10)**-30)


@functools.cache
def contour(n):
    """Return points and weights of the fixed contour of Talbot, as Abate and Valko state it, at t = 1."""
    points = [(mpf(2 * n) / 5, mpmath.exp(mpf(2 * n) / 5) / 5)]
    for k in range(1, n):
        theta = mpmath.pi * k / n
        cot = mpmath.cot(theta)
        point = mpf(2 * n) / 5 * theta * mpc(cot, 1)
        points.append((point, mpmath.exp(point) * mpc(1, theta * (1 + cot**2) - cot) * 2 / 5))
    return points


def inverse(F, t, n):
    """Return the functions of t whose transforms are the list F(s). The sums lose 0.17 n digits."""
    with mp.workdps(50 + n // 5):
        points, weights = zip(*contour(n))
        return [mpmath.re(mpmath.fdot(weights, column)) / t for column in zip(*(F(p / t) for p in points))]


#> motion
def motion(law, t, x0, v0, A):
    """Return the motion (26.9) of m = c = 1, held at x0 before t = 0, under a constant force A."""
    def transform(s):
        C = symbol(law, s)
        return [(s * x0 + v0 + C * x0 / s + A / s) / (s * s + 1 + C)]
    first, second = (inverse(transform, t, n)[0] for n in (56, 72))
    claim("both inversions agree", abs(first - second) < mpf(10)**-22)
    return second
#< motion


# ---- exact solutions: fractions with their own poles, and the contributions of forces ----
HARD = [
    [(ZENER, 2, "0.75", "0.5", 0)],
    [(ZENER, 2, "0.75", "0.5", 0), (ZENER, 1, "0.875", "0.0625", 0)],
    [(ZENER, "0.5", "0.9375", 1, 0), (POWER, "0.25", "0.25", 0, 0)],
    [(DISTRIBUTED, 8, "0.125", 0, "0.875"), (MAXWELL, 64, 0, 2, 0)],
    [(POWER, 32, "0.4375", 0, 0), (POWER, "0.125", "0.9375", 0, 0)],
    [(MAXWELL2, 2, "0.875", "0.5", "0.125")],
]
HARD = [[(kind, *map(mpf, numbers)) for kind, *numbers in law] for law in HARD]


def parts(C, m, c, x0, v0, omega, t):
    """Return (x(t), x'(t)) with C(s) of three problems: the start alone, a step of 1, and cos(omega t)."""
    def transforms(s):
        memory = C(s)
        over = 1 / (m * s * s + c + memory)
        free = (m * s * x0 + m * v0 + memory * x0 / s) * over
        step, wave = over / s, s * over / (s * s + omega * omega)
        return [free, s * free - x0, step, s * step, wave, s * wave]

    first, second = (inverse(transforms, t, n) for n in ((180, 220) if t > 2 else (64, 80)))
    claim("both inversions agree", all(abs(a - b) < mpf(10)**-23 for a, b in zip(first, second)))
    return [mpmath.matrix(second[i:i + 2]) for i in (0, 2, 4)]


#> zeros
def zeros(law, m, c):
    """Return the number of zeros of Q by (26.11): its turns around 0 along the boundary of the upper half plane without
    the cut, plus the number of poles of C."""
    law, low, high = [(kind, *map(float, numbers)) for kind, *numbers in law], 1e-12, 2e12
    poles = sum((kind == ZENER and alpha > 0.5) or (kind == MAXWELL2 and alpha - end > 0.5)
                for kind, _, alpha, _, end in law)
    ray = [low * (high / low)**(i / 4000) for i in range(4001)]      # the ray avoids s = 1, where C is 0/0
    arc = [cmath.exp(1j * cmath.pi * i / 200) for i in range(200)]
    path = ([complex(r) for r in ray] + [high * v for v in arc]
            + [complex(-r, 1e-60) for r in reversed(ray)] + [low * v for v in reversed(arc)])
    values = [m * s * s + c + symbol(law, s) for s in path]
    turned = sum(cmath.phase(b / a) for a, b in zip(values, values[1:])) / (2 * cmath.pi)
    claim("(26.11) a whole number of turns", abs(turned - round(turned)) < 1e-9)
    return round(turned) + poles
#< zeros


#> stages
@functools.cache
def nodes(s):
    """Return b and A^(-1) of s Lobatto nodes; mu, r(-mu) and the matrix a b a~^T on the cut."""
    b, D = {2: ([mpf(1) / 2] * 2, [[-1, 1], [-1, 1]]),
            3: ([mpf(1) / 6, mpf(2) / 3, mpf(1) / 6], [[-3, 4, -1], [-1, 0, 1], [1, -4, 3]])}[s]
    A_inverse = mpmath.matrix(D)
    A_inverse[0, 0] += 1 / b[0]
    cut, x = [], symbols("mu")
    first = (Matrix(s, s, [int(mpmath.nint(v)) for v in A_inverse]) + x * eye(s)).inv("ADJ")[:, 0]
    solved = lambdify(x, list(first), "mpmath")
    for k in range(-700, 200):
        mu = mpmath.exp(mpf(k) / 8)
        a = [v / b[0] for v in solved(mu)]
        r = 1 - mu * mpmath.fdot(b, a)
        cut.append((mu, r, [a[i] * b[j] * a[s - 1 - j] for i in range(s) for j in range(s)]))
    return b, A_inverse, cut


@functools.cache
def around(s, radius, count, h):
    """Return Delta(z)/h on a circle."""
    b, A_inverse, _ = nodes(s)

    def delta(z):
        Delta = A_inverse.copy()
        Delta[0, s - 1] -= z / b[0]
        return Delta / h

    return circle(delta, radius, count)


def stages(law, s, n, h):
    """Return W_n of (26.12), by Cauchy's integral over |z| = 2/5 and along the cut."""
    cut = nodes(s)[2]
    cauchy = coefficients(around(s, mpf(2) / 5, 60 + n, h), lambda v: symbol(law, v) / v, [n])[n]
    imaginary = lambda s: symbol(law, mpc(s, mpf(10)**-40)).imag
    shares = [imaginary(-mu / h) * r**(n - 1) * h / mpmath.pi / 8 for mu, r, _ in cut]
    along = [mpmath.fdot(shares, entries) for entries in zip(*(M for _, _, M in cut))]
    return mpmath.mnorm(cauchy - mpmath.matrix([along[s * i:s * i + s] for i in range(s)])) / mpmath.mnorm(cauchy)
#< stages


#> alternating
# At z = -1 Delta of two stages is 1 + sqrt(3) J with J^2 = -1. So f(Delta) is Re f + Im f J at 1 + i sqrt(3). On the
# path (1, -1), with b = 1/2:
J, u = Matrix([[0, sqrt(3)], [-1 / sqrt(3), 0]]), Matrix([1, -1])
re_f, im_f = symbols("re_f im_f", real=True)
prove("(26.13)", (J * J + eye(2)).norm(), (eye(2) + sqrt(3) * J - Matrix([[1, 3], [-1, 1]])).norm(),
      (u.T * (re_f * eye(2) + im_f * J) * u)[0] / 2 - (re_f - im_f / sqrt(3)))
#< alternating

#> stable
# On z = e^{-i phi} a mean, followed by its mirror image, is cos^2(phi/2). delta of BDF2 has the parts (1 - cos phi)^2
# and (2 - cos phi) sin phi.
turn = cos(phi) - I * sin(phi)
prove("(26.15)", ((1 + turn) * (1 + turn.conjugate()) / 4 - (1 + cos(phi)) / 2).expand().trigsimp(),
      ((1 - turn) * (3 - turn) / 2 - (1 - cos(phi))**2 - I * (2 - cos(phi)) * sin(phi)).expand().trigsimp())
#< stable

# ---- Theorem 17.3 for laws: s^2 / (s^2 + w^2) at Delta = 1 + N of two stages, on z = e^{-i phi}.
w, back = symbols("w z", positive=True)
N, left, right = Matrix([[0, 1 - 2 * back], [-1, 0]]), Matrix([[1, back]]), Matrix([1, 1 / back])  # u^* and u, and B = 1/2
prove("of Delta", *(N * N - (2 * back - 1) * eye(2)), *((eye(2) + N)**2 - 2 * back * eye(2) - 2 * N).expand())
prove("u^* B f(Delta) u of 1, of N and of a mass", (left * right)[0] / 2 - 1,
      ((left * N * right)[0] / 2 - (1 / back - 2 - back) / 2).expand(),
      ((left * (eye(2) + N)**2 * right)[0] / 2 - (1 / back - 2 + back)).expand())
top, bottom = 3 + (w**2 + 2) / back - 1 / back**2, 4 * back + 4 * w**2 - 8 + (w**4 + 4) / back
prove("the quotient", (2 * back + w**2 - (1 / back - 2 - back) - back * top).expand(),
      ((2 * back + w**2)**2 + 4 - 8 * back - back * bottom).expand())
ahead, n = turn.conjugate(), (w**4 + 8) * cos(phi) + 4 * w**2 - 8 + I * w**4 * sin(phi)
top, bottom = 3 + (w**2 + 2) * ahead - ahead**2, 4 * turn + 4 * w**2 - 8 + (w**4 + 4) * ahead
prove("its imaginary part", (bottom - n).expand(), trigsimp(
    (im((top * n.conjugate()).expand()) + 16 * sin(phi) * (1 - cos(phi))**2).expand()))


# ---- (26.22): a law from its loss, by the trapezoidal rule in ln omega; from 0 the range would be too long ----
def from_loss(law, s):
    spring = sum(t[1] for t in law if t[0] == POWER and t[2] == 0)
    mass = sum(t[1] for t in law if t[0] == POWER and t[2] == 1)
    step = 1 / 16
    omegas = [cmath.exp(step * k).real for k in range(-3200, 3200)]
    return float(spring) + float(mass) * s**2 + 2 / cmath.pi * sum(
        step * (symbol(law, 1j * omega).imag * s**2 / (s**2 + omega**2)) for omega in omegas)


mp.dps = 25
for law in (LAWS[0], LAWS[2]):
    claim("(26.12)", all(stages(law, s, n, mpf(1) / 8) < mpf(10)**-20 for s, n in ((2, 4), (3, 9))))
mp.dps = 40


def nearest(x):
    """Return the nearest double of a number that is known to some 20 digits."""
    return "0" if x == 0 else float(mpmath.nstr(x, 20)).hex()


# The cut of these terms and laws is different: orders above 1, poles near the cut and away from it.
STEEP = [
    [(ZENER, 1, "0.46875", "0.75", 0)],
    [(ZENER, 2, "0.75", "0.5", 0), (POWER, "0.5", "0.25", 0, 0)],
    [(ZENER, 1, 1, "0.25", 0)],
    [(POWER, "0.5", "0.9375", 0, 0), (POWER, "0.25", 1, 0, 0), (MAXWELL, "0.5", 0, "0.75", 0)],
    [(MAXWELL2, 1, "0.6875", "0.5", "0.125")],
    [(MAXWELL2, 1, "0.75", "0.5", "0.375")],
]
STEEP = [[(kind, *map(mpf, numbers)) for kind, *numbers in law] for law in STEEP]
for law in LAWS + STEEP:
    if not any(t[0] == DISTRIBUTED and t[2] == 0 or t[0] == ZENER and t[2] == 1 for t in law):
        for s in (0.3 + 0.2j, 2 + 0.5j):
            doubles = [(t[0], *map(float, t[1:])) for t in law]
            claim("(26.22)", abs(from_loss(doubles, s) - symbol(doubles, s)) < 1e-8 * abs(symbol(doubles, s)))

header("verify/damping_laws/damping_laws.py")
print("\n#include <fvi/damping_laws.h>")
for name, laws in (("ref", LAWS), ("steep", STEEP)):
    for i, law in enumerate(laws):
        rows = ", ".join("{ %d, %s }" % (t[0], ", ".join(nearest(n) for n in t[1:])) for t in law)
        print(f"static const fvi_kernel_term {name}_terms_{i}[] = {{ {rows} }};")
    print(f"\nstatic const fvi_kernel {name}_laws[] = {{")
    for i, law in enumerate(laws):
        print(f"    {{ {len(law)}, {name}_terms_{i} }},")
    print("};")

LAGS = [0, 3, 4, 33, 150]
print(f"\nenum {{ REF_LAGS = {len(LAGS)} }};")
print("static const size_t ref_lag[REF_LAGS] = { %s };" % ", ".join(map(str, LAGS)))
print("\n/* W_n of (26.12) with h = 1/8, row by row; the law is of ref_laws, or of steep_laws. */")
print("static const struct { const fvi_kernel *law; size_t s; double W[REF_LAGS][9]; } ref_stages[] = {")
with mp.workdps(50):
    # aliasing leaves (7/10)^192 = 2e-30 of the largest; (10/7)^150 = 2e23 of the digits are lost
    rings = [(s, around(s, mpf(7) / 10, 192, mpf(1) / 8)) for s in (2, 3)]
    for name, laws in (("ref_laws", LAWS), ("steep_laws", STEEP)):
        for i, law in enumerate(laws):
            for s, ring in rings:
                W = coefficients(ring, lambda v: symbol(law, v) / v, LAGS)
                rows = ", ".join("{ %s }" % ", ".join(nearest(W[n][j, l]) for j in range(s) for l in range(s))
                                 for n in LAGS)
                print(f"    {{ &{name}[{i}], {s}, {{ {rows} }} }},")
print("};")

INDICES = [0, 1, 2, 3, 10, 32, 33, 34, 60, 100, 150]
print(f"\nenum {{ REF_INDICES = {len(INDICES)} }};")
print("static const size_t ref_index[REF_INDICES] = { %s };" % ", ".join(map(str, INDICES)))
print("\nstatic const struct { size_t law; int kind; double h, w[REF_INDICES]; } ref_weights[] = {")
for i, law in enumerate(LAWS):
    for kind in (0, 1):
        for step in (mpf(1) / 8, mpf(1) / 512):
            w = weights(law, DELTA[kind], step)
            print(f"    {{ {i}, {kind}, {nearest(step)}, {{ {', '.join(nearest(w[n]) for n in INDICES)} }} }},")
print("};")

print("\nstatic const struct { size_t law; double omega, storage, loss; } ref_moduli[] = {")
for i, law in enumerate(LAWS):
    for omega in (mpf(1) / 64, mpf(3) / 4, mpf(100)):
        C = symbol(law, mpc(0, omega))
        print(f"    {{ {i}, {nearest(omega)}, {nearest(C.real)}, {nearest(C.imag)} }},")
print("};")

print("\nstatic const struct { size_t law; double x0, p0, force, t, x; } ref_motions[] = {")
for i, law in enumerate(LAWS):
    for x0, v0, A in ((1, 0, 0), (mpf(1) / 2, 0, mpf(1) / 4), (0, 1, 0)):
        for t in (1, 4):
            x = motion(law, mpf(t), mpf(x0), mpf(v0), mpf(A))
            print(f"    {{ {i}, {nearest(mpf(x0))}, {nearest(mpf(v0))}, {nearest(mpf(A))}, {t}, {nearest(x)} }},")
print("};")

print("\n/* Laws of which Q has more zeros than one, or strong damping: their number, by the argument")
print(" * principle, and m = 2, c = 3; forcing, A and T or w as in fvi_linear_oscillator. */")
for i, law in enumerate(HARD):
    rows = ", ".join("{ %d, %s }" % (t[0], ", ".join(nearest(n) for n in t[1:])) for t in law)
    print(f"static const fvi_kernel_term hard_terms_{i}[] = {{ {rows} }};")
print("\nstatic const struct { fvi_kernel law; int zeros; } ref_hard[] = {")
for i, law in enumerate(HARD):
    print(f"    {{ {{ {len(law)}, hard_terms_{i} }}, {zeros(law, 2, 3)} }},")
print("};")
for law in LAWS[:5]:  # the orders up to 1 without Maxwell's alone: exactly one pair of zeros
    if law[0][0] != MAXWELL:
        claim("(26.11) orders up to 1", zeros(law, 2, 3) == 1 == zeros(law, 2, 0))
print("\nstatic const struct { size_t law; int forcing; double A, T, t, x, v; } ref_exact[] = {")
for i, law in enumerate(HARD):
    made = functools.cache(lambda t: parts(lambda s: symbol(law, s), 2, 3, 1, mpf(-1) / 2, mpf("1.5"), t))
    for forcing, A, T in ((0, 0, 0), (1, 2, "0.75"), (2, 2, "1.5")):
        for t in (mpf(1) / 64, mpf(1), mpf(8)):
            both = made(t)[0] + A * made(t)[forcing]
            if forcing == 1 and t > mpf(T):     # the end of a step is a second step, with the opposite sign
                both -= A * made(t - mpf(T))[1]
            x, v = both
            print(f"    {{ {i}, {forcing}, {A}, {T}, {nearest(t)}, {nearest(x)}, {nearest(v)} }},")
print("};")
