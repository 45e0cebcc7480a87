"""Forces of laws in the first rows of an oscillator. Prints tests/observer/observer_laws_ref.h.

    x'' + c x + C(D) (x - x0) = 0,     x(0) = x0, x'(0) = v0, held before t = 0.

z = x - x0 has Laplace's transform Z(s) = (v0 - c x0/s) / (s^2 + c + C(s)), and the force has the transform C Z. If
the past jumps, C acts on x, and X(s) = (s x0 + v0) / (s^2 + c + C(s)). In a third problem a mass 1 at 1 pulls, by a
spring 1, at a point without mass at 0 that C holds: x1'' = x2 - x1 and C(D) x2 = x1 - x2. All transforms are inverted
along Talbot's contour, with two numbers of nodes that must agree. The responses of a law to 1, t and t^2/2 are
(26.21), the inverse transforms of C/s^m. Claimed: for a Maxwell element they agree with the integrals of exp(-t/T),
and the oscillator with a Maxwell element is the solution of three linear equations of first order."""
from functools import cache

from mpmath import cot, exp, expm, log, matrix, mp, mpc, mpf, quad, workdps

from shared.refgen import claim, header, nearest as nearest_of, table

mp.dps = 40
H, c = mpf(1) / 64, mpf(2)
ROWS = (1, 2, 3, 4, 7, 13)
STARTS = ((0, 1), (1, 0), (mpf(1) / 2, mpf(3) / 4))


def nearest(v):
    return nearest_of(v, 20)


def double(x):
    return mpf(float(x))


def zener(rho, alpha, T):
    """A fraction with the relaxation time T."""
    return ("ZENER", double(rho), double(alpha), double(mpf(T) ** (2 * double(alpha))), mpf(0), mpf(0))


LAWS = [zener(0.75, a, T * H) for a in (0.1, 0.25, 0.4) for T in (0.1, 1, 10, 100)]
LAWS += [("MAXWELL", mpf(0.75), mpf(0), double(T * H), mpf(0), mpf(0)) for T in (0.1, 1, 10, 100)]
LAWS += [zener(0.75, 0.6, 8 * H), zener(0.75, 0.9, 8 * H),
         ("ZENER", mpf(0.75), double(0.3), double(0.1), mpf(0), mpf(0.25)),       # and a dashpot
         ("MAXWELL2", mpf(0.75), double(0.4), double(0.05), double(0.1), mpf(0)),
         ("DAVIDSON", mpf(0.75), double(0.3), double(H), mpf(0), mpf(0)),
         ("DISTRIBUTED", mpf(0.75), double(0.1), mpf(0), double(0.4), mpf(0))]
LAWS += [("POWER", mpf(0.75), double(a), mpf(0), mpf(0), mpf(0)) for a in (0.05, 0.25, 0.4, 0.5, 0.6, 0.9)]


def symbol(law, s, L):
    """Return C(s), where L = ln s."""
    kind, rho, alpha, time, end, dashpot = law
    a = 2 * alpha
    value = {"POWER": lambda: exp(a * L),
             "ZENER": lambda: 1 / (exp(-a * L) + time),
             "MAXWELL": lambda: s / (1 + time * s),
             "MAXWELL2": lambda: 1 / (exp(-a * L) + time * exp(-2 * end * L)),
             "DAVIDSON": lambda: (s / (1 + time * s))**a,
             "DISTRIBUTED": lambda: (exp(2 * end * L) - exp(a * L)) / (2 * L)}[kind]()
    return rho * value + dashpot * s


@cache
def talbot(n):
    """Return points and weights of Talbot's contour for t = 1: f(1) is the real part of sum weight F(point)."""
    points, weights = [mpf(2 * n) / 5], [exp(mpf(2 * n) / 5) / 5]
    for k in range(1, n):
        angle = k * mp.pi / n
        slope = cot(angle)
        points.append(2 * k * mp.pi / 5 * mpc(slope, 1))
        weights.append(mpc(1, angle * (1 + slope**2) - slope) * exp(points[-1]) * 2 / 5)
    return points, weights


@cache
def contour(t, n):
    """Return the points of the contour for t, their logarithms and their weights."""
    points, weights = talbot(n)
    return [(p / t, log(p / t), w / t) for p, w in zip(points, weights)]


@cache
def symbols(law, t, n):
    """Return C(s) at these points. The forces of all starts share it."""
    return [symbol(law, s, L) for s, L, _ in contour(t, n)]


def inverse(F, law, t):
    """Return f(t) to 20 digits, the inverse of F(s, C(s)). Contours of 60 and of 75 nodes must agree."""
    with workdps(80):
        first, second = (sum((w * F(s, C)).real for (s, _, w), C in zip(contour(t, n), symbols(law, t, n)))
                         for n in (60, 75))
    claim("Talbot's contour has enough nodes", abs(first - second) <= mpf(10)**-26 * (abs(first) + mpf(10)**-6))
    return second


def force(law, x0, v0, t):
    return inverse(lambda s, C: C * (v0 - c * x0 / s) / (s**2 + c + C), law, t)


def force_of_jump(law, x0, v0, t):
    return inverse(lambda s, C: C * (s * x0 + v0) / (s**2 + c + C), law, t)


def massless(law, t):
    """Return x2', x2'', the force of the element that holds the point, and x2."""
    def X(s, C):
        return s / (s**2 * (1 + C) + C)
    return [inverse(F, law, t) for F in (lambda s, C: s * X(s, C), lambda s, C: s**2 * X(s, C), lambda s, C: C * X(s, C), X)]


def responses(law, t):
    return [inverse(lambda s, C, m=m: C / s**m, law, t) for m in (1, 2, 3, 4)]


def near(a, b):
    return abs(a - b) <= mpf(10)**-22 * (abs(a) + mpf(10)**-10)


for alpha in (0.25, 0.9):
    power = ("POWER", mpf(0.75), double(alpha), mpf(0), mpf(0), mpf(0))
    for m, G in enumerate(responses(power, 5 * H), 1):
        e = m - 1 - 2 * double(alpha)
        claim("a power answers with powers", near(G, mpf(0.75) * (5 * H)**e * mp.rgamma(1 + e)))

for t in (H, 5 * H):  # a dashpot 1/2 has x1 - x2 = (1 - t) exp(-t)
    half = ("POWER", mpf(1) / 2, mpf(1) / 2, mpf(0), mpf(0), mpf(0))
    want = 2 * (1 - t) * exp(-t), 2 * (t - 2) * exp(-t), (1 - t) * exp(-t), 2 * t * exp(-t)
    claim("a point without mass", all(map(near, massless(half, t), want)))

maxwell = LAWS[12]
rho, T = maxwell[1], maxwell[3]
for t in (H, 5 * H):
    G = responses(maxwell, t)
    claim("a jump of a Maxwell element relaxes", near(G[0], rho / T * exp(-t / T)))
    for m in (1, 2, 3):
        parts = [0, T, min(t, 20 * T), t]
        exact = quad(lambda u, m=m: rho / T * exp(-u / T) * (t - u)**(m - 1) / mp.factorial(m - 1), sorted(set(parts)))
        claim("its integrals are the other answers", near(G[m], exact))
    # (x, v, f)' = (v, -c x - f, (rho v - f)/T)
    motion = expm(matrix([[0, 1, 0], [-c, 0, -1], [0, rho / T, -1 / T]]) * t, method="taylor")
    for x0, v0 in STARTS:
        claim("the oscillator with a Maxwell element", near((motion * matrix([x0, v0, 0]))[2], force(maxwell, x0, v0, t)))

header(__file__)
print("\n/* h = 1/64, c = 2. The rows of forces and answers name the law by its number. */")
table("ref_laws", "int kind; double rho, alpha, time, end, dashpot;",
      [[f"FVI_KERNEL_{kind}", *map(nearest, numbers)] for kind, *numbers in LAWS])
table("ref_responses", "size_t law, k; double G_1, G_2, G_3, G_4;",
      [[i, k, *map(nearest, responses(law, k * H))] for i, law in enumerate(LAWS) for k in (1, 5, 27)
       if law[0] != "POWER" or law[2] != mpf(1) / 2])  # the response of a dashpot to a jump is 0
table("ref_forces", "size_t law, k; double x0, v0, force;",
      [[i, k, nearest(mpf(x0)), nearest(mpf(v0)), nearest(force(law, x0, v0, k * H))]
       for i, law in enumerate(LAWS) for x0, v0 in STARTS for k in ROWS])
table("ref_jumps", "size_t law, k; double x0, v0, force;",
      [[i, k, nearest(mpf(1) / 2), nearest(mpf(v0)), nearest(force_of_jump(LAWS[i], mpf(1) / 2, v0, k * H))]
       for i in (2, 6, 10, 13, 15) for v0 in (0, mpf(3) / 4) for k in (1, 2, 3)])
table("ref_jumps_of_powers", "size_t law, k; double v0, force;",
      [[i, k, nearest(mpf(v0)), nearest(force_of_jump(LAWS[i], mpf(1) / 2, v0, k * H))]
       for i in (22, 23, 24) for v0 in (0, mpf(3) / 4) for k in ROWS])
table("ref_massless", "size_t law, k; double v, a, force;",
      [[i, k, *map(nearest, massless(LAWS[i], k * H)[:3])] for i in (0, 5, 14, 22, 23, 25) for k in ROWS])
table("ref_massless_means", "size_t law; double v;", [[i, nearest(massless(LAWS[i], H)[3] / H)] for i in (0, 5, 14, 22, 23, 25)])
