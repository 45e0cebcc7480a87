"""Rows of H 16 about derivatives and the continuous principle; and what all rows
share: a `claim` is a line that is printed and must be true, what is only said has nothing
to compute. Each function runs one row, by its number; errata.py calls them."""
import math
import subprocess
import sys
from fractions import Fraction as Q
from math import gamma, pi, sqrt

FVI = sys.argv[1]
ROWS = {}


def row(number):
    def keep(function):
        ROWS[number] = function
        return function
    return keep


def claim(words, truth):
    print(f"  {words}")
    if not truth:
        sys.exit(f"NOT TRUE: {words}")


def say(words):
    print(f"  {words}")


def near(a, b, tolerance=1e-12):
    return abs(a - b) <= tolerance * max(1, abs(b))


def power(q, order, t=1.0):
    """Riemann-Liouville's derivative of t^q, from 0: (1.6); 0 at the poles of Gamma."""
    e = q - order + 1
    return 0.0 if e <= 0 and e == int(e) else gamma(q + 1) / gamma(e) * t ** (q - order)


def weights(alpha, count):
    w = [Q(1)]
    for n in range(1, count):
        w.append(w[-1] * (n - 1 - alpha) / n)
    return w


def minus(w, z):
    return [sum(w[n] * z[k - n] for n in range(k + 1)) for k in range(len(z))]


def plus(w, z):
    return minus(w, z[::-1])[::-1]


def run(*options):
    """The columns of a run, as lists of numbers."""
    text = subprocess.run([FVI, *options, "--format", "csv"], check=True, capture_output=True, text=True).stdout
    return list(zip(*[[float(cell) for cell in line.split(",")] for line in text.split()[1:]]))


# ---- derivatives (H 1) ----

@row(1)
def sign():
    rl, caputo = power(0, 0.5), 0.0
    printed = -1 / gamma(0.5) + caputo
    claim(f"f = 1, a = 0, alpha = 1/2, t = 1: D_RL f = d/dt 2 sqrt(t)/sqrt(pi) = {rl:.6f}, D_C f = 0", near(rl, 1 / sqrt(pi)))
    claim(f"the printed formula says {printed:.6f}, with the other sign", near(printed, -rl))


@row(2)
def parts():
    say("alpha = 1, F = 1 - t, G = 1 on [0, 1]: int F G' = 0, int -F' G = 1")
    left, right = 0.0, power(0, 0.5) * 2
    claim(f"Caputo, alpha = 1/2, F = G = 1: int F D_C G = {left:g}, int (D_+ F) G = {right:.6f}", near(right, 2 / sqrt(pi)))
    G = gamma                                       # Riemann-Liouville: int (1-t) D t^m, and its mirror
    m, a = 2, 0.5
    one = G(m + 1) / G(m + 1 - a) * G(m - a + 1) * G(2) / G(m - a + 3)
    two = G(2) / G(2 - a) * G(m + 1) * G(2 - a) / G(m - a + 3)
    claim(f"Riemann-Liouville, alpha = 1/2, F = 1 - t, G = t^2: {one:.12f} on both sides", near(one, two))


@row(3)
def additive():
    claim(f"f = 1: D^(1/2) D^1 f = 0, D^(3/2) f = {power(0, 1.5):.6f} at t = 1", power(0, 1.5) != 0)
    claim(f"f = t^(-1/2): D^(1/2) f = {power(-0.5, 0.5):g}, so D^(1/2) D^(1/2) f = 0; D^1 f = {power(-0.5, 1):g} at t = 1",
          power(-0.5, 0.5) == 0 and near(power(-0.5, 1), -0.5))


@row(4)
def pole():
    values = [gamma(1 - a) for a in (0.9, 0.99, 0.999)]
    claim("Gamma(1 - alpha) at alpha = 0.9, 0.99, 0.999: " + ", ".join(f"{v:.1f}" for v in values), values[2] > 999)
    claim(f"and D t^2 = {power(2, 0.999):.4f} at t = 1, alpha = 0.999: the limit 2 is there", near(power(2, 0.999), 2, 1e-3))


@row(31)
def consistent():
    errors = []
    for N in (10, 100, 1000):                       # f = 1 + t at t = 1: sums are products, (4.3)
        w = weights(Q(1, 2), N + 1)
        total = sum(w[n] * (1 + Q(N - n, N)) for n in range(N + 1))
        errors.append(float(total) * sqrt(N) - power(0, 0.5) - power(1, 0.5))
    claim("f = 1 + t, alpha = 1/2, t = 1, h = 1/10, 1/100, 1/1000: errors " + ", ".join(f"{e:.2e}" for e in errors),
          all(abs(errors[i] / errors[i + 1] - 10) < 0.5 for i in range(2)))
    say("each a tenth of the one before: order 1, although f(0) = 1")


# ---- the continuous principle (H 3, 15) ----

@row(5)
def origin():
    largest = []
    for h, N in ((0.5, 30), (0.1, 150), (0.02, 750), (0.004, 3750)):
        _, x = run("run", "--alpha", "0.9", "--h", str(h), "--steps", str(N), "--columns", "t,x", "--derivative", "rl")
        largest.append(max(map(abs, x)))
    claim("alpha = 0.9, the paper's data: largest |x| at h = 0.5, 0.1, 0.02, 0.004: "
          + ", ".join(f"{v:.3g}" for v in largest), largest[0] < largest[1] < largest[2] < largest[3] and largest[3] > 10)
    _, x = run("run", "--alpha", "0.9", "--h", "0.004", "--steps", "3750", "--columns", "t,x")
    claim(f"the same body, held at 1 before: {max(map(abs, x)):.3g}", max(map(abs, x)) < 1.2)


@row(6)
def dimension():
    rows = [[Q(n, 2) ** (q - 1) for n in range(1, 5)] for q in range(1, 5)]
    rank = 0                                        # D^(1/2) t^q is a multiple of t^(q - 1/2)
    for column in range(4):
        pivot = next((i for i in range(rank, 4) if rows[i][column] != 0), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        for i in range(rank + 1, 4):
            factor = rows[i][column] / rows[rank][column]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[rank])]
        rank += 1
    claim(f"d = 1: D^(1/2) of t, t^2, t^3, t^4 at t = 1/2, 1, 3/2, 2 has rank {rank}, not 1", rank == 4)


@row(8)
def smooth():
    for a in (0.25, 0.75):
        acceleration = -power(3 - 2 * a, 2) / gamma(4 - 2 * a)
        claim(f"alpha = {a}: x = t - t^{3 - 2 * a:g}/Gamma: x'' + D^{2 * a:g} t = {acceleration + power(1, 2 * a):.1e} at t = 1",
              near(acceleration, -power(1, 2 * a)))
    claim(f"and x'' = {-power(1, 1.5, 1e-8):.1e} at t = 1e-8 for alpha = 0.75", power(1, 1.5, 1e-8) > 1e3)


@row(9)
def kernel():
    for e in (1e-2, 1e-4, 1e-8):
        a = 0.75
        say(f"alpha = 3/4: the integral of s^(-3/2) from {e:g} to 1 is {(1 - e ** (1 - 2 * a)) / (1 - 2 * a):.4g}")
    first = power(3, 0.75) * 0 + power(3 - 0.75, 0.75) * gamma(4) / gamma(4 - 0.75)
    claim(f"the order alpha taken twice is harmless: D^(3/4) D^(3/4) t^3 = {first:.6f} = D^(3/2) t^3 at t = 1", near(first, power(3, 1.5)))


def exponential(A):
    """exp of a small matrix: Taylor, of A / 2^10, squared ten times."""
    n = len(A)
    B = [[a / 1024 for a in line] for line in A]
    one = [[float(i == j) for j in range(n)] for i in range(n)]
    product = lambda X, Y: [[sum(x * y for x, y in zip(line, c)) for c in zip(*Y)] for line in X]
    term, E = one, one
    for k in range(1, 12):
        term = [[v / k for v in line] for line in product(term, B)]
        E = [[e + v for e, v in zip(*lines)] for lines in zip(E, term)]
    for _ in range(10):
        E = product(E, E)
    return E, product


@row(10)
def form():
    rho = 0.2                                       # (x, x', y, y'), alpha = 1/2, m = c = 1
    P, product = exponential([[0, 1, 0, 0], [-1, -rho, 0, 0], [0, 0, 0, 1], [0, 0, -1, rho]])

    def carried(entries):
        A = [[0.0] * 4 for _ in range(4)]
        for (i, j), v in entries.items():
            A[i][j], A[j][i] = v, -v
        return product(product([list(c) for c in zip(*P)], A), P), A

    got, _ = carried({(0, 1): 1, (0, 3): 1})
    claim(f"after t = 1 the coefficients of dx^dx', dx^dy' are {got[0][1]:.6f}, {got[0][3]:.6f}, not 1, 1", near(got[0][1], math.exp(-rho)))
    claim(f"and those of dx^dy, dx'^dy, dx'^dy' are {got[0][2]:.6f}, {got[1][2]:.6f}, {got[1][3]:.6f}, not 0", abs(got[0][2]) > 0.5)
    got, A = carried({(0, 3): 1, (1, 2): -1, (0, 2): -rho})
    claim("Bateman's dx^dy' + dy^dx' - rho dx^dy is preserved to "
          f"{max(abs(got[i][j] - A[i][j]) for i in range(4) for j in range(4)):.0e}",
          all(near(got[i][j], A[i][j]) for i in range(4) for j in range(4)))


@row(11)
def hamilton():
    say("H = p_y^2/2 + y^2/2 at y = 1, p_y = 0, a body at rest: y' = 0")
    say("y' - dH/dp_y = 0; as printed, y' - dH/dy = -1")


@row(12)
def mirror_momentum():
    t, a = 0.25, 0.25                               # x = t on [0, 1], y its mirror, m = 2, rho = 1
    p_y = -power(1, a, t)                           # p_y^alpha = - rho D_-^alpha x
    claim(f"x = t, m = 2, rho = 1, alpha = t = 1/4: p_y^alpha(t) = {p_y:.6f}; mirrored p_x^alpha is the same", p_y < 0)
    say("mirrored p_x, as printed, is 2: another unit, and another number")


@row(13)
def pull_back():
    say("m = 2: FL takes (x, v) to (x, 2v), so FL* (p dx) = 2v dx lives where the velocities do")
    say("on the phase space 2v dx = p dx needs v = p/2, the inverse; and d(p dx) = dp^dx = -dx^dp")


@row(33)
def two_forces():
    for b in (0.25, 0.5, 0.75):                     # t^2 - 2 t^3 + t^4 is 0 with its slope at t = 1
        difference = power(2, b) - 2 * power(3, b) + power(4, b)
        claim(f"x = t and t + t^2 (1-t)^2 meet at t = 1 with one velocity; D^{b} differs by {difference:.6f}",
              near(difference, -2 * b * (1 - b) / gamma(5 - b)) and difference < -0.02)
