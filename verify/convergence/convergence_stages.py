"""H 20: form D on any mesh. Prints tests/convergence/convergence_stages_ref.h.

  (20.16) the error of a spring, against the dense power of the matrix of (22.1);
  (20.17) the remainder of R(z), by its integral, exactly, s = 2 to 8; |q(iy)| >= 1 for R = p/q, exactly;
          |R(-mu)| <= 1/(1 + mu) by Sturm's theorem, exactly;
  (20.18), (20.21) bounds of a(mu) and of the resolvent of a step, by Bernstein coefficients
          on subintervals, in 40 digits;
  (20.22) the errors of the stages and of the end of a step, by Peano's kernels, in 40 digits;
  (20.24) the error of the memory of a power of t on random meshes, against the dense power;
  (20.19) for sixteen springs, to 1e-4.

That the sums of (20.16) to (20.25) hold for every number of steps is proved by hand."""
import cmath
import math
import random
from functools import reduce

import mpmath
from mpmath import mp, mpf
from sympy import I, Poly, Rational, binomial, exp, expand, factorial, integrate, symbols

from shared.refgen import claim, header, hexd, largest, nearest, prove, table
from shared.variable_steps_power import dense
from variable_steps import variable_steps as one

STAGES = range(2, 9)
mu, y, u, z = symbols("mu y u z", positive=True)


#> pade
def pade(s):
    """Return p and q of the stability function R = p/q of Lobatto IIIC, with q(0) = 1."""
    whole = factorial(2 * s - 2)
    p = sum(binomial(s - 2, i) * factorial(2 * s - 2 - i) / whole * z**i for i in range(s - 1))
    q = sum(binomial(s, i) * factorial(2 * s - 2 - i) / whole * (-z)**i for i in range(s + 1))
    return p, q


for s in STAGES:
    p, q = pade(s)
    rest = integrate(expand(u**s * (1 - u)**(s - 2)) * exp(z * u), (u, 0, 1))
    prove("(20.17) what R misses", q * exp(z) - p - (-1)**s * z**(2 * s - 1) / factorial(2 * s - 2) * rest)
    prove("(20.17) its size", integrate(expand(u**s * (1 - u)**(s - 2)), (u, 0, 1))
          - factorial(s) * factorial(s - 2) / factorial(2 * s - 1))
    square = Poly(expand(q.subs(z, I * y) * q.subs(z, -I * y)), y)
    claim("(20.17) |q| >= 1 on the imaginary axis", min(square.all_coeffs()) >= 0 and square.eval(0) == 1)
    below = Poly(expand(q.subs(z, -mu)**2 - (1 + mu)**2 * p.subs(z, -mu)**2), mu)
    lowest = min(m for (m,) in below.monoms())
    below = below.quo(Poly(mu**lowest, mu))
    claim("(20.18) |R(-mu)| <= 1/(1 + mu)", below.eval(0) > 0 and below.count_roots(0, None) == 0)
#< pade

mp.dps = 40


def rule_of(s):
    """Return c, b and A^(-1) in 40 digits."""
    c, b, inverse = one.rule(s, 40)
    return [mpf(v) for v in c], [mpf(v) for v in b], inverse


def resolvent(s, inverse):
    """Return d = det(mu + A^(-1)) and the entries of d (mu + A^(-1))^(-1), by Faddeev and Leverrier; lowest power
    first."""
    M, d, parts = mpmath.eye(s), [mpf(1)], []
    for k in range(1, s + 1):
        parts.append(M)
        product = -inverse * M
        d.append(-sum(product[i, i] for i in range(s)) / k)
        M = product + d[-1] * mpmath.eye(s)
    return d[::-1], [[[p[i, l] for p in reversed(parts)] for l in range(s)] for i in range(s)]


def at_most(sums, K, d):
    """Return whether sum |p| <= K d for all arguments >= 0. The argument is t/(1 - t), and the Bernstein coefficients
    of both sides in t are compared on [0, 1], which is bisected where necessary. Coefficients below 10^-30 of the
    largest one count as rounding errors."""
    n = len(d) - 1

    def start(p):
        p = p + [mpf(0)] * (n + 1 - len(p))
        tiny = mpf(10)**-30 * max(map(abs, p))
        return [(v if abs(v) > tiny else mpf(0)) / mpmath.binomial(n, k) for k, v in enumerate(p)]

    def halves(p):
        left, right, p = [], [], list(p)
        while p:
            left.append(p[0])
            right.append(p[-1])
            p = [(v + w) / 2 for v, w in zip(p, p[1:])]
        return left, right[::-1]

    # A polynomial of clear sign enters the sum with this sign, any other one with its largest size.
    pieces = [([start(p) for p in sums], start([K * v for v in d]), 0)]
    while pieces:
        all_p, of_d, depth = pieces.pop()
        total = [mpf(0)] * (n + 1)
        for p in all_p:
            sign = 1 if min(p) >= 0 else -1 if max(p) <= 0 else 0
            most = max(map(abs, p))
            total = [v + (sign * w if sign else most) for v, w in zip(total, p)]
        if all(v <= w + mpf(10)**-28 * abs(w) for v, w in zip(total, of_d)):
            continue
        if depth == 14:
            return False
        cut = [halves(p) for p in all_p]
        low, high = halves(of_d)
        pieces.append(([c[0] for c in cut], low, depth + 1))
        pieces.append(([c[1] for c in cut], high, depth + 1))
    return True


def times(p, q):
    out = [mpf(0)] * (len(p) + len(q) - 1)
    for i, v in enumerate(p):
        for j, w in enumerate(q):
            out[i + j] += v * w
    return out


def peano(s, row, end, order):
    """Return the largest |Peano kernel| for f^(order) of the rule that replaces the integral of f from 0 to end by
    sum row_l f(c_l). Between nodes it is a polynomial, so 400 points are tried and the largest is refined."""
    c, best = rule_of(s)[0], mpf(0)
    for left, right in zip(c, c[1:]):
        # Coefficients of the powers of tau, the highest first. Doubles are enough to find the largest of 400 points.
        powers = lambda n, v: [mpmath.binomial(n, i) * v**(n - i) * (-1)**i / mpmath.factorial(n) for i in range(n, -1, -1)]
        whole = powers(order, end) if end > left else [mpf(0)] * (order + 1)
        for r, v in zip(row, c):
            if v > left:
                whole = [a - r * b for a, b in zip(whole, [0, *powers(order - 1, v)])]
        rough = [float(a) for a in whole]
        kernel = lambda tau, whole: abs(reduce(lambda value, a: value * tau + a, whole))
        width = (right - left) / 400
        points = [left + k * width for k in range(1, 400)] + [left + width * mpf(10)**-30, right - width * mpf(10)**-30]
        top = max(points, key=lambda tau: kernel(float(tau), rough))
        for _ in range(60):
            points = [top - width, top - width / 2, top, top + width / 2, top + width]
            top, width = max((p for p in points if left < p < right), key=lambda tau: kernel(tau, whole)), width / 2
        best = largest((best, kernel(top, whole)))
    return best


KAPPA, OWN, STAGE, IMAGINARY = mpf("1.34"), mpf(2), mpf("2.37"), mpf("1.1")
rows = []
for s in STAGES:
    c, b, inverse = rule_of(s)
    A = inverse**-1
    d, N = resolvent(s, inverse)
    n = [[v / b[0] for v in N[i][0]] for i in range(s)]
    claim("(20.18) |a_i| <= 1", all(at_most([p], 1, d) for p in n))
    claim("(20.18) kappa", at_most([times([b[i], b[i]], n[i]) for i in range(s)], KAPPA, d))
    claim("(20.21) a row of the resolvent", all(at_most([times([mpf(1), mpf(1)], p) for p in N[i]], OWN, d)
                                                for i in range(s)))
    still = lambda i, l: [(d[k] if i == l else 0) - (N[i][l][k - 1] if k else 0) for k in range(s + 1)]
    claim("(20.24) a row of (1 + mu A)^(-1)", all(at_most([still(i, l) for l in range(s)], STAGE, d)
                                                  for i in range(s)))
    # at mu = i y both sides are polynomials in y^2
    squares = lambda p: [sum((-1)**((k - j) // 2 if (k - j) % 2 == 0 else 0) * p[j] * p[k]
                             for j, k in ((j, 2 * q - j) for j in range(2 * q + 1)) if j < len(p) and k < len(p)
                             if (k - j) % 2 == 0) for q in range(len(p))]
    total = [sum(b[i] * v for i, v in enumerate(part)) for part in zip(*(squares(p) for p in n))]
    claim("(20.19) on the imaginary axis", at_most([total], IMAGINARY**2, squares(d)))
    claim("(20.21) the rows of A", largest(sum(abs(A[i, l]) for l in range(s)) for i in range(s)) < 1 + mpf(10)**-30)
    row_of = lambda i: [A[i, l] for l in range(s)]
    K1 = largest(peano(s, row_of(i), c[i], 1) for i in range(s))
    Ks = largest(peano(s, row_of(i), c[i], s - 1) for i in range(s))
    E1, Es = (peano(s, row_of(s - 1), mpf(1), order) for order in (1, s))
    C = mpf(int(factorial(s) * factorial(s - 2))) / (int(factorial(2 * s - 2)) * int(factorial(2 * s - 1)))
    up = lambda v: nearest(v * (1 + mpf(10)**-12), 20)   # round bounds up
    rows.append([s, nearest(C, 30), up(K1), up(Ks), up(E1), up(Es)])

# ---- (20.16) and (20.24) on random meshes -------------------------------------
random.seed(39)
draw = lambda low, high: mpf(random.uniform(low, high))


def stage_times(s, steps):
    c, now, out = rule_of(s)[0], mpf(0), []
    for h in steps:
        out += [now + h * v for v in c]
        now += h
    return out


def matrix_of(s, steps, order):
    """Return DD^order."""
    blocks, count = dense(s, tuple(steps), order, 40), len(steps)
    mp.dps = 40
    M = mpmath.matrix(count * s, count * s)
    for k, row in enumerate(blocks):
        for j, block in row.items():
            for i in range(s):
                for l in range(s):
                    M[k * s + i, j * s + l] = block[i, l]
    return M


def run(s, steps, q):
    """Solve (22.14) of a spring on all steps at once. Return x and v at the last node. F^(j)(0) is q.F[j]."""
    _, b, inverse = rule_of(s)
    n = len(steps) * s
    D, power = mpmath.matrix(n, n), matrix_of(s, steps, 2 * q.alpha - 1)
    for k, h in enumerate(steps):
        for i in range(s):
            for l in range(s):
                D[k * s + i, k * s + l] = inverse[i, l] / h
        if k:
            D[k * s, k * s - 1] -= 1 / (h * b[0])
    ones = mpmath.matrix([1] * n)
    F = mpmath.matrix([sum(f * t**j / mpmath.factorial(j) for j, f in enumerate(q.F)) for t in stage_times(s, steps)])
    back = D**-1
    known = F + q.m * q.v0 * (D * ones) - q.c * q.x0 * ones
    if q.alpha > 0.5:
        known += q.rho * q.v0 * (power * ones)
    V = mpmath.lu_solve(q.m * D + q.rho * power + q.c * back, known)
    return q.x0 + (back * V)[n - 1], V[n - 1]


def misses(s, steps, q, order):
    """Return the right side of (20.16), the error of x (order 0) or of v (order 1)."""
    P, Q = ([mpf(Rational(v).p) / Rational(v).q for v in Poly(p, z).all_coeffs()] for p in pade(s))

    def gap(w):
        g = mpf(1)
        for h in steps:
            g *= mpmath.polyval(P, w * h) / mpmath.polyval(Q, w * h)
        return (g - mpmath.exp(w * sum(steps))) * q.J(w) * w**order
    pole = q.pole()
    found = 2 * mpmath.re(gap(pole) / q.slope(pole))
    L = min(1, mp.pi - mpmath.arg(pole)) / 6    # the step in ln sigma; it is small if the pole is near the cut
    for k in range(int(-12 / L), int(50 / L)):
        sigma = mpmath.exp(L * k)
        found += L * sigma * q.density(sigma) * gap(-sigma)
    return found


class Spring:
    def __init__(self, alpha, s):
        self.alpha = mpf(alpha)
        self.m, self.rho, self.c, self.x0, self.v0 = (draw(0.3, 2) for _ in range(5))
        self.F = [draw(-1, 1) for _ in range(s)]

    def J(self, w):
        begins = self.m * self.v0 if self.alpha < 0.5 else -self.c * self.v0 / w**2
        return sum(f * w**(-j - 1) for j, f in enumerate(self.F)) - self.c * self.x0 / w + begins

    def power(self, w):
        return mpmath.exp(2 * self.alpha * mpmath.log(w))

    def slope(self, w):
        return 2 * self.m * w + 2 * self.alpha * self.rho * self.power(w) / w

    def density(self, sigma):
        size = self.rho * sigma**(2 * self.alpha)
        turn = mpmath.expjpi(2 * self.alpha)
        return size * turn.imag / (mp.pi * abs(self.m * sigma**2 + self.c + size * turn)**2)

    def pole(self):
        f = lambda w: self.m * w**2 + self.rho * self.power(w) + self.c
        for turn in (1.6, 1.9, 2.2, 2.5, 2.8, 3.05):
            for size in (0.3, 1, 3):
                try:
                    w = mpmath.findroot(f, size * mpmath.sqrt(self.c / self.m) * mpmath.expj(turn), tol=mpf(10)**-60)
                except (ValueError, ZeroDivisionError):
                    continue
                if w.imag > mpf(10)**-9:
                    return w
        raise ValueError("no pole")

    def exact(self, t, order):
        """Return x (order 0) or v (order 1), by Talbot's contour."""
        def X(w):
            rest = self.x0 / w + (self.v0 / w**2 if self.alpha > 0.5 else 0)
            X = self.J(w) / (self.m * w**2 + self.rho * self.power(w) + self.c) + rest
            return w * X - self.x0 if order else X
        with mpmath.workdps(40):
            return mpmath.invertlaplace(X, t, method="talbot", degree=48)


for s, alpha in ((2, 0.3), (3, 0.7), (3, 0.1), (4, 0.9), (4, 0.45)):
    q = Spring(alpha, s)
    steps = [draw(0.02, 0.6) for _ in range(5)]
    x, v = run(s, steps, q)
    for order, got in enumerate((x, v)):
        off = got - q.exact(sum(steps), order)
        claim("(20.16) the error of a spring", abs(off - misses(s, steps, q, order)) < mpf(10)**-12)


#> missed
def G(j, theta, A):
    """Return G of (20.23): the integral over all rates of the j-th derivative of a mode's slope is below G t^(theta -
    j)."""
    own = A[0] * mpmath.gamma(j - theta) * (2**(j - theta) - 1)
    return own + 2**(j - theta) * (A[j] * mpmath.gamma(1 - theta) / theta
                                   + sum(A[i] * mpmath.gamma(j - i - theta) for i in range(j)))


def G_more(j, theta, A):
    """Return the same bound with one more factor of the rate, without the part that is not smooth."""
    own = A[0] * mpmath.gamma(j + 1 - theta) * (2**(j + 1 - theta) - 1)
    return own + 2**(j + 1 - theta) * sum(A[i] * mpmath.gamma(j + 1 - i - theta) for i in range(j))


def of_power(left, right, exponent):
    """Return the integral of t^exponent."""
    return (right**(exponent + 1) - left**(exponent + 1)) / (exponent + 1) if exponent != -1 else mpmath.log(right / left)


def memory_misses(s, steps, theta, A, constants):
    """Return the bound (20.24) for each step."""
    K1, Ks, E1, Es = constants
    ends = [sum(steps[:k]) for k in range(len(steps) + 1)]
    weight, out = mpmath.sin(mp.pi * theta) / mp.pi, []
    for n in range(len(steps)):
        total = mpf(0)
        for k in range(n + 1):
            h, left, right = steps[k], ends[k], ends[k + 1]
            if k == 0:
                stage, end = (K * h * G(1, theta, A) * of_power(left, right, theta - 1) for K in (K1, E1))
                past = KAPPA * stage
            else:
                stage = Ks * h**(s - 1) * G(s - 1, theta, A) * of_power(left, right, theta - s + 1)
                end = Es * h**s * G(s, theta, A) * of_power(left, right, theta - s)
                past = KAPPA * Ks * h**s * G_more(s - 1, theta, A) * of_power(left, right, theta - s)
                if k < n:
                    past += (KAPPA * Ks * h**s / weight * (ends[n] - left)**(theta - 1)
                             * 2**(s - 1) * A[s - 1] * of_power(left, right, mpf(1) - s))
            total += STAGE * stage if k == n else end + past
        out.append(weight * total)
    return out
#< missed

worst = mpf(0)
for s, theta, p, grade in ((2, 0.3, 1, 1), (2, 0.8, 1.4, 2), (3, 0.5, 1, 2), (3, 0.4, 1.4, 3), (4, 0.2, 2, 3), (4, 0.6, 1.6, 4)):
    theta, p, count = mpf(theta), mpf(p), 6
    ends = [mpf(2) * (mpf(k) / count)**grade for k in range(count + 1)]
    steps = [(right - left) * draw(0.6, 1.6) for left, right in zip(ends, ends[1:])]
    top, A, slope = sum(steps), [], mpf(p)                       # u = t^p, phi = p t^(p-1)
    for i in range(s + 1):
        A.append(abs(slope) * top**(p - 1))
        slope *= p - 1 - i
    t = stage_times(s, steps)
    got = matrix_of(s, steps, -theta) * mpmath.matrix([v**p for v in t])
    exact = [mpmath.gamma(p + 1) / mpmath.gamma(p + 1 + theta) * v**(p + theta) for v in t]
    c, b, inverse = rule_of(s)
    A_ = inverse**-1
    constants = (*(largest(peano(s, [A_[i, l] for l in range(s)], c[i], o) for i in range(s)) for o in (1, s - 1)),
                 *(peano(s, [A_[s - 1, l] for l in range(s)], mpf(1), o) for o in (1, s)))
    for n, bound in enumerate(memory_misses(s, steps, theta, A, constants)):
        off = largest(abs(got[n * s + i] - exact[n * s + i]) for i in range(s))
        claim("(20.24) what the memory misses", off <= bound)
        worst = largest((worst, off / bound))
claim("(20.24) is not far from it", worst > mpf(1) / 30)



def bound_for_all_times(m, c, rho, alpha, x0, v0, s, h, eps):
    """Return (20.19) with equal steps h and no force: the bounds of x and of v. Doubles suffice, because four digits
    are wanted."""
    P, Q = ([float(v) for v in Poly(p, z).all_coeffs()] for p in pade(s))
    R = lambda w: complex(mpmath.fp.polyval(P, w) / mpmath.fp.polyval(Q, w))
    C = float(factorial(s) * factorial(s - 2)) / float(factorial(2 * s - 2) * factorial(2 * s - 1))
    q = Spring(alpha, s)
    q.m, q.c, q.rho, q.x0, q.v0, q.F = mpf(m), mpf(c), mpf(rho), mpf(x0), mpf(v0), []
    pole = complex(q.pole())
    turn = cmath.exp(2j * math.pi * alpha)
    J = lambda w: abs((m * v0 if alpha < 0.5 else -c * v0 / w**2) - c * x0 / w)
    slope = abs(2 * m * pole + 2 * alpha * rho * cmath.exp((2 * alpha - 1) * cmath.log(pole)))
    both = largest((abs(R(pole * h)), math.exp(pole.real * h)))
    misses = lambda w: C * abs(w)**(2 * s - 1) if abs(w) < 0.25 else abs(R(w) - cmath.exp(w))
    of_pole = 2 * J(pole) / slope * misses(pole * h) / (1 - both)
    modes = 2 * float(IMAGINARY) / slope * h / (1 - abs(R(pole * h)))
    x, v, modes_x, modes_v, most, L = 0.0, 0.0, 0.0, 0.0, 0.0, 1 / 400
    for k in range(round(-60 / L), round(60 / L)):
        sigma = math.exp(L * k)
        nu = sigma * h
        most = largest((most, (1 + nu) / nu * misses(-nu)))
        weight = L * sigma * rho * sigma**(2 * alpha) * abs(turn.imag) / (
            math.pi * abs(m * sigma**2 + rho * sigma**(2 * alpha) * turn + c)**2)
        x += weight * J(-sigma) * most
        v += weight * J(-sigma) * most * sigma
        modes_x += weight / sigma
        modes_v += weight
    return (of_pole + x + rho * eps * (modes + float(KAPPA) * modes_x),
            abs(pole) * of_pole + v + rho * eps * (abs(pole) * modes + float(KAPPA) * modes_v))


BOUNDS = [(m, c, rho, alpha, x0, v0, s, h, eps)
          for m, c, rho, alpha, x0, v0 in ((1.0, 1.0, 0.5, 0.25, 1.0, 0.0), (2.0, 0.5, 0.125, 0.75, 0.5, -1.0),
                                           (0.5, 3.0, 2.0, 0.375, 0.0, 1.0), (1.0, 8.0, 0.25, 0.875, -1.0, 0.25))
          for s, h, eps in ((2, 0.25, 0.0), (3, 0.125, 0.0), (5, 1.0, 0.0), (8, 0.5, 0.001))]

header("verify/convergence/convergence_stages.py")
print("\n/* C of (20.17); K_1, K_{s-1} of the stages and E_1, E_s of the end of a step (20.22), rounded up. */")
table("ref_stages", "size_t s; double C, K1, K, E1, E;", rows)
print("\n/* (20.19), to 1e-4. */")
table("ref_times", "double m, c, rho, alpha, x0, v0; size_t s; double h, eps, x, v;",
      [[hexd(v) if i != 6 else v for i, v in enumerate(row)]
       + [repr(float(f"{v:.6g}")) for v in bound_for_all_times(*row)] for row in BOUNDS])
