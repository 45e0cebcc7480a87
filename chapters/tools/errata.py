"""Run what chapter 16 says, row by row: the counterexample, or the repair, in numbers.

    errata.py FVI 17      one row, as the table has it, and its numbers   (make erratum-17)
    errata.py FVI         all rows; exit 1 if a claim does not hold, or if a row of the
                          table has no numbers here                       (make errata)

FVI is the program, for the rows that are about runs. Fractions are exact; what is not is
computed from formulas with math.gamma, and never by the library. A `claim` is a line
that is printed and must be true; what is only said has nothing to compute. Only Python's standard library is used."""
import math
import pathlib
import re
import subprocess
import sys
from fractions import Fraction as Q
from math import gamma, sqrt, pi

PAGE = pathlib.Path("chapters/16-errata.md")
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


# ---- derivatives (chapter 1) ----

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


# ---- the continuous principle (chapters 3, 15) ----

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


# ---- sums (chapters 5, 6, 7) ----

INSIDE_F, INSIDE_G = [Q(2), Q(-3), Q(1)], [Q(1), Q(4), Q(-2)]


def sums(F, G, a=Q(1, 2)):
    """What (5.5), (5.6) and (5.8) leave, h = 1."""
    w, N = weights(a, len(F)), len(F) - 1
    dF, dG = minus(w, F), plus(w, G)
    return (sum(dG[k] * F[k] for k in range(N)) - sum(G[k] * dF[k] for k in range(1, N + 1)),
            sum(G[k + 1] * dF[k + 1] for k in range(N)) - sum(dG[k] * F[k] for k in range(1, N)),
            sum(dG[k] * F[k + 1] for k in range(N)) - sum(G[k] * dF[k + 1] for k in range(1, N)))


@row(15)
def hypotheses():
    F, G = [Q(2), *INSIDE_F, Q(3)], [Q(3), *INSIDE_G, Q(2)]
    claim(f"F_0 G_0 = F_N G_N = 6, none of the four zero: (b) is off by {sums(F, G)[0]}", sums(F, G)[0] == 0)
    F, G = [Q(0), *INSIDE_F, Q(3)], [Q(3), *INSIDE_G, Q(0)]
    claim(f"F_0 = G_N = 0, F_N = G_0 = 3: (c) is off by {sums(F, G)[1]}", sums(F, G)[1] == 0)
    F, G = [Q(1), *INSIDE_F, Q(0)], [Q(0), *INSIDE_G, Q(0)]
    claim(f"F_0 = 1, all others 0: (c) is off by {sums(F, G)[1]}", sums(F, G)[1] != 0)


@row(16)
def step_two():
    F, G, w = [0, 1, 0, 0], [0, 0, 1, 0], weights(1, 4)
    left = sum(G[k] * minus(w, F)[k] for k in range(1, 4))
    wrong, right = (sum(d[k] * F[k] for k in range(3)) for d in (minus(w, G), plus(w, G)))
    claim(f"alpha = h = 1, F = (0,1,0,0), G = (0,0,1,0): {left} on one side, {wrong} with Delta_-, {right} with Delta_+",
          (left, wrong, right) == (-1, 0, -1))


@row(17)
def out_of_phase():
    F, G = [Q(0), *INSIDE_F, Q(0)], [Q(0), *INSIDE_G, Q(0)]
    w = weights(Q(1, 2), 5)
    side = sum(plus(w, G)[k] * F[k + 1] for k in range(4))
    claim(f"F = (0, 2, -3, 1, 0), G = (0, 1, 4, -2, 0), alpha = 1/2, h = 1: {side} on both sides", sums(F, G)[2] == 0)
    F[-1] = Q(7)
    claim(f"and with F_N = 7 they differ by {sums(F, G)[2]}, too", sums(F, G)[2] == 0)
    say("the paper says that they are not equal")


@row(21)
def full_range():
    F, G = [Q(5), *INSIDE_F, Q(-1)], [Q(2), *INSIDE_G, Q(7)]
    w = weights(Q(1, 3), 5)
    left = sum(a * b for a, b in zip(plus(w, G), F))
    right = sum(a * b for a, b in zip(G, minus(w, F)))
    claim(f"alpha = 1/3, no end value zero, the sums from 0 to N: {left} = {right}", left == right)


@row(18)
def end_term():
    w = weights(Q(1, 3), 5)
    left = [Q(1, 2) * Q(3, 5) * w[4 - k] for k in (1, 2, 3)]
    claim("N = 4, alpha = 1/3, h = 1/2, rho = 3/5: where (a) and (b) hold, the derivatives of the printed action are "
          + ", ".join(map(str, left)) + ", times h^(-2 alpha) y_4", left == [Q(-1, 54), Q(-1, 30), Q(-1, 10)])


@row(19)
def shifted_term():
    w = weights(Q(1, 3), 4)
    left = [Q(1, 2) * Q(3, 5) * w[k] for k in (1, 2, 3)]
    claim("the same with k + 1: " + ", ".join(map(str, left)) + ", times h^(-2 alpha) x_0, are left over", all(left))


@row(20)
def ranges():
    N = 5
    holds = [i for i in range(N)]                   # L^i holds x_0..x_{i+1}, y_i..y_N
    claim(f"N = 5: y_N stands in L^i for i = {holds}, so its sum runs to N - 1 = 4; y_0 stands in L^0",
          all(N in range(i, N + 1) for i in range(N)) and 0 in range(0, N + 1))


@row(22)
def mirror():
    def force(kappa, back, here, ahead):            # U = -z^3/3: U' = -z^2; the terms of (b) at k
        z, y = kappa * here + (1 - kappa) * ahead, kappa * back + (1 - kappa) * here
        return kappa * z**2 + (1 - kappa) * y**2

    k = Q(1, 4)
    x = (Q(0), Q(0), Q(1))
    here, same, other = force(k, *x), force(k, *x[::-1]), force(1 - k, *x[::-1])
    claim(f"kappa = 1/4, U' = -z^2, x = 0, 0, 1: the force on x is {here}, on its mirror {same}; with 1 - kappa {other}",
          here == other != same)


@row(23)
def induction():
    a = [Q(1), Q(-1, 2), Q(-1, 8), Q(0)]            # not the weights: a_3 is wrong
    beta = lambda j: 2 * a[j] + sum(a[i] * a[j - i] for i in range(1, j))
    claim(f"1, -1/2, -1/8, 0: beta_0^2 = {beta(2)}, so the induction would give beta_0^3 = 0; it is {beta(3)}",
          beta(2) == 0 and beta(3) == Q(1, 8))
    w = weights(Q(1, 2), 4)
    say("and the product of k - 1 and 1 is counted twice: " + ", ".join(str(w[k - 1] * w[1]) for k in (2, 3, 4)) + " times x_0")
    square = [sum(w[i] * w[n - i] for i in range(n + 1)) for n in range(4)]
    claim("one line: the square of 1, -1/2, -1/8, -1/16, ... is " + ", ".join(map(str, square)) + ", ...", square == [1, -1, 0, 0])


# ---- momenta and runs (chapters 8, 9, 10, 14) ----

@row(24)
def shapes():
    row_, swap, column = (2, 3), ((0, 1), (1, 0)), (5, 7)
    swapped = [sum(a * b for a, b in zip(line, column)) for line in swap]
    say(f"operators 2, 3, slopes 5, 7: as printed {sum(a * b for a, b in zip(row_, swapped))}, one number; "
          f"on the diagonal {[a * b for a, b in zip(row_, swapped)]}")


@row(25)
def start():
    say("x enters the coupling as x^alpha rho y^alpha: its slope in x^alpha is y^alpha, which a start of x cannot know;"
          " that in y^alpha is rho x^alpha")


@row(26)
def momentum():
    h, rho, a, k = Q(1, 4), Q(2), Q(1, 2), 3
    x = [Q(1), Q(3), Q(2), Q(5)]
    d = minus(weights(a, 4), x)[k]
    say(f"h = 1/4, rho = 2, x = 1, 3, 2, 5: the new p^alpha is {-h * rho * d}, h times {-rho * d}, in units of h^(-1/2)")


@row(27)
def backwards():
    m, h = 2, Q(1, 2)
    x = [Q(0), Q(1), Q(3), Q(4)]
    N, k = 3, 1
    y = x[::-1]
    p_y, p_x = m * (y[k + 1] - y[k]) / h, m * (x[N - k] - x[N - k - 1]) / h
    claim(f"m = 2, h = 1/2, x = 0, 1, 3, 4: p_y at 1 is {p_y} = -p_x at {N - k - 1}, not at {N - k}", p_y == -p_x)


@row(28)
def explicit():
    say("kappa = 0, m = c = h = 1, rho = 0, x = 1, p = 1/2: x_1 = 1 + 1/2 = 3/2 is known, then p_1 = 1/2 - 3/2 = -1")
    _, x, p = run("run", "--kappa", "0", "--rho", "0", "--h", "1", "--steps", "1", "--x0", "1", "--p0", "0.5", "--columns", "t,x,p")
    claim(f"the program: x_1 = {x[1]:g}, p_1 = {p[1]:g}", x[1] == 1.5 and p[1] == -1)


@row(29)
def other_start():
    errors = {0: [], 1: []}
    for N in (100, 200, 400, 800):
        h = 1.0 / N
        kick = 0.2 * h ** (1 - 2 * 0.25)
        for tilde in errors:
            t, x = run("run", "--alpha", "0.25", "--h", str(h), "--steps", str(N), "--columns", "t,x",
                       "--derivative", "rl", "--p0", repr(0.5 - tilde * kick))
            e = run("exact", "--alpha", "0.25", "--h", "1", "--steps", "1", "--columns", "t,x", "--derivative", "rl")[1][-1]
            errors[tilde].append(abs(x[-1] - e))
    order = {s: math.log2(errors[s][-2] / errors[s][-1]) for s in errors}
    claim(f"alpha = 1/4, Riemann-Liouville, x(1), h = 1/400 and 1/800: order {order[0]:.2f} as printed, "
          f"{order[1]:.2f} with the start that is called meaningless", order[0] < 0.6 and order[1] > 0.9)


@row(30)
def energy():
    m, rho, c = 1, Q(1, 5), 1
    out = 1 - Q(1, 10) * rho / m + Q(1, 100) * c / m, 1 / (1 + Q(1, 5) * rho / m + Q(1, 25) * c / m)
    true = math.exp(-0.02), math.exp(-0.04)
    claim(f"explicit Euler, h = 0.1: a step multiplies areas by {float(out[0]):.3f}, the motion by {true[0]:.3f}: it gains", out[0] > true[0])
    claim(f"implicit Euler, h = 0.2: by {float(out[1]):.3f}, the motion by {true[1]:.3f}: it loses", out[1] < true[1])


@row(14)
def ends():
    for alpha in ("0", "0.5", "1"):
        _, x = run("exact", "--alpha", alpha, "--rho", "0.2", "--h", "0.05", "--steps", "4000", "--columns", "t,x")
        early, late = max(map(abs, x[:400])), max(map(abs, x[-400:]))
        claim(f"alpha = {alpha}: the largest |x| up to t = 20 is {early:.3f}, and from 180 to 200 it is {late:.3g}",
              near(early, late, 1e-2) if alpha != "0.5" else late < 1e-6)


@row(32)
def left_open():
    say("the list of what the captions leave open, and of our choices, is chapter 10, What is not said")


@row(34)
def bound():
    for R in (1.98, 2.02):                          # kappa = alpha = 1/2: 4^(1/2) R < 4
        _, x = run("run", "--alpha", "0.5", "--kappa", "0.5", "--rho", str(R), "--h", "1", "--steps", "2000", "--columns", "t,x")
        claim(f"kappa = alpha = 1/2, h = m = c = 1, rho = {R}: |x| at step 2000 is {abs(x[-1]):.1e}",
              (abs(x[-1]) < 1e-3) == (R < 2))


def table():
    """{number: (place, printed, right)} of chapter 16."""
    rows = re.findall(r"^\| (\d+) \| (.*) \|$", PAGE.read_text(), re.M)
    return {int(n): re.sub(r"\]\([^)]*\)", "]", cells).replace("`", "").split(" | ")[:3] for n, cells in rows}


def show(number, cells):
    print(f"{number}. {cells[0]}\n  printed: {cells[1]}\n  right:   {cells[2]}")
    if number in ROWS:
        ROWS[number]()
    else:
        print("  lettering, with nothing to run")


def main():
    rows = table()
    if set(rows) - {7} != set(ROWS):
        sys.exit(f"rows without numbers, or numbers without a row: {sorted((set(rows) - {7}) ^ set(ROWS))}")
    for number in [int(n) for n in sys.argv[2:]] or sorted(rows):
        if number not in rows:
            sys.exit(f"there is no erratum {number}: chapter 16 has 1 to {max(rows)}")
        show(number, rows[number])


main()
