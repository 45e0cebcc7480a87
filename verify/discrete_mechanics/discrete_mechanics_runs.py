"""H 2. Exact trajectories: positions from the three-term equations (2.7), (2.8), in rationals, or with 60 and with 90
digits where a step is not rational; momenta from the slopes (2.6); Euler's methods from (2.13).

Each value has a bound of the rounding errors of the C code. For this purpose the operations of the C code are
repeated on numbers that carry their worst error. The repetition also proves that the momentum form (2.9), which the C
code uses, gives the same trajectories; the script stops if it does not."""
from fractions import Fraction as Q

import mpmath

from shared.refgen import claim, header, hexd, rows_of, table


class Exactly:
    """Numbers as fractions of Python."""
    number = staticmethod(Q)


class Digits:
    """Numbers as mpmath numbers with many digits."""
    number = staticmethod(lambda q: q if isinstance(q, mpmath.mpf) else
                          mpmath.mpf(Q(q).numerator) / Q(q).denominator)


class Case:
    """A run. Its data are doubles, so they are rational numbers."""
    def __init__(self, name, method, kind, K=0, step=Q(1, 4), steps=10, x0=(1,), p0=(Q(1, 2),),
                 mass=(1,), rho=(0, 0), cg=(1, 0), ramp=(0, 0), exact=True):
        self.name, self.method, self.kind, self.steps, self.exact = name, method, kind, steps, exact
        self.d, self.kappa, self.h = len(x0), Q(K), Q(step)
        self.x0, self.p0, self.mass, self.rho, self.cg, self.ramp = (
            [Q(w) for w in v] for v in (x0, p0, mass, rho, cg, ramp))

    def force(self, z, one):
        """Return grad U(z); `one` converts a number to the kind of z."""
        C, G = map(one, self.cg)
        if self.kind == "PENDULUM":
            return [C * (v.sin() if isinstance(v, Rounded) else mpmath.sin(v)) for v in z]
        spring_force = lambda r: (C + G * r * r) * r
        if self.kind == "CUBIC":                # U = c z^2 / 2 + g z^3 / 3
            spring_force = lambda r: (C + G * r) * r
        if self.kind != "CHAIN":
            return [spring_force(v) for v in z]
        wall = [one(0), *z, one(0)]
        left = [spring_force(wall[i + 1] - wall[i]) for i in range(self.d + 1)]
        return [left[i] - left[i + 1] for i in range(self.d)]

    def hessian(self, z):
        C, G = self.cg
        if self.kind == "CHAIN":
            stiff = [C + 3 * G * r * r for r in [q - p for p, q in zip([0, *z], [*z, 0])]]
            return [[stiff[i] + stiff[i + 1] if i == j else
                     -stiff[max(i, j)] if abs(i - j) == 1 else 0 * stiff[0]
                     for j in range(self.d)] for i in range(self.d)]
        bend = {"HARMONIC": lambda v: C + 0 * v, "DUFFING": lambda v: C + 3 * G * v * v,
                "CUBIC": lambda v: C + 2 * G * v, "PENDULUM": lambda v: C * mpmath.cos(v)}
        return [[bend[self.kind](v) if i == j else 0 for j in range(self.d)]
                for i, v in enumerate(z)]

    def linear(self, s, theta):
        return s * theta == 0 or (self.cg[1] == 0 and self.kind != "PENDULUM")


def inverse(J):
    if len(J) == 1:
        return [[1 / J[0][0]]]
    det = J[0][0] * J[1][1] - J[0][1] * J[1][0]
    return [[J[1][1] / det, -J[0][1] / det], [-J[1][0] / det, J[0][0] / det]]


def jacobian(case, A, s, theta, z):
    H = case.hessian(z) if s * theta else [[Q(0)] * case.d for _ in z]
    return [[(A[i] if i == j else 0) + s * theta * H[i][j] for j in range(case.d)]
            for i in range(case.d)]


def solve_step(case, A, s, theta, r, z, kind):
    """Solve (2.10): exactly if it is linear, else by Newton's method in many digits."""
    n, dim = kind.number, range(case.d)
    A, s, theta = [n(v) for v in A], n(s), n(theta)
    d = [n(0) for _ in dim]
    for _ in range(1 if case.linear(s, theta) else 12):
        S = [z[i] + theta * d[i] for i in dim]
        g = case.force(S, n)
        residual = [r[i] - A[i] * d[i] - s * g[i] for i in dim]
        inv = inverse(jacobian(case, A, s, theta, S))
        d = [d[i] + sum(inv[i][j] * residual[j] for j in dim) for i in dim]
    return d


#> definition
def by_definition(case, kind):
    """Return positions from the three-term equations (2.7), (2.8) and momenta from (2.6). Euler's methods use (2.13).
    """
    n, dim, K, step = kind.number, range(case.d), case.kappa, case.h
    one, stiff = n(1), lambda z: case.force(z, n)
    drive = lambda k: [n(f * k * step) for f in case.ramp]                  # F(t) = ramp t
    A = [w / step for w in case.mass]
    X, P = [[n(v) for v in case.x0]], [[n(v) for v in case.p0]]

    def D(j, y, z):     # D_j L_d(y, z), j = 1 or 2
        share = K if j == 1 else 1 - K
        g = stiff([n(K) * y[i] + n(1 - K) * z[i] for i in dim])
        return [(-one if j == 1 else one) * n(A[i]) * (z[i] - y[i]) - n(share * step) * g[i]
                for i in dim]

    for k in range(case.steps):
        if case.method == "explicit":
            g, f = stiff(X[k]), drive(k)
            X.append([X[k][i] + n(step / case.mass[i]) * P[k][i] for i in dim])
            P.append([P[k][i] + n(step) * (f[i] - g[i] - n(case.rho[i] / case.mass[i]) * P[k][i])
                      for i in dim])
        elif case.method == "implicit":
            r = [P[k][i] + n(step) * drive(k + 1)[i] for i in dim]
            d = solve_step(case, [A[i] + case.rho[i] for i in dim], step, 1, r, X[k], kind)
            X.append([X[k][i] + d[i] for i in dim])
            P.append([n(A[i]) * d[i] for i in dim])
        else:           # the variational methods, also with forces: solve D1 L_d(x_k, x_{k+1}) + rest = 0
            rest = P[0] if k == 0 else [D(2, X[k - 1], X[k])[i]
                                        - n(case.rho[i]) * (X[k][i] - X[k - 1][i])
                                        + n(step) * drive(k)[i] for i in dim]
            d = solve_step(case, A, K * step, 1 - K, rest, X[k], kind)
            X.append([X[k][i] + d[i] for i in dim])
            P.append([D(2, X[k], X[k + 1])[i] - n(case.rho[i]) * d[i] + n(step) * drive(k + 1)[i]
                      for i in dim])
    return X, P
#< definition


class Rounded:
    """A number, and a bound of the error of the double that stands for it after the operations so far. The bound is
    in units of u = 2^-53 and of first order in u."""
    def __init__(self, value, error=0.0):
        self.v, self.e = value, error

    def rounded(self):
        return Rounded(self.v, self.e + abs(float(self.v)))

    def __neg__(self):
        return Rounded(-self.v, self.e)

    def __add__(self, o):
        return Rounded(self.v + o.v, self.e + o.e).rounded()

    def __sub__(self, o):
        return self + -o

    def __mul__(self, o):
        error = abs(float(self.v)) * o.e + abs(float(o.v)) * self.e
        return Rounded(self.v * o.v, error).rounded()

    def __truediv__(self, o):
        q = self.v / o.v
        return Rounded(q, (self.e + abs(float(q)) * o.e) / abs(float(o.v))).rounded()

    def sin(self):      # the C library is within 1 ulp, which is at most 2 u
        value = mpmath.sin(self.v)
        return Rounded(value, self.e + 2 * abs(float(value)))


def rounded_solve(case, A, s, theta, r, z, kind):
    """Return dx and the gradient at the midpoint, with the error bounds of newton.c. When rounding no longer lets a
    solution improve, its residual has the size of its rounding errors. An LU solution in two dimensions adds at most
    4 u |J| |d|."""
    n, dim = kind.number, range(case.d)
    exact = lambda q: Rounded(n(q))
    values = lambda w: [v.v for v in w]
    d = solve_step(case, [v.v for v in A], s.v, theta.v, values(r), values(z), kind)
    at = lambda w: case.force([z[i] + theta * w[i] for i in dim], exact)
    J = jacobian(case, values(A), s.v, theta.v, [z[i].v + theta.v * d[i] for i in dim])
    if case.linear(s.v, theta.v):
        g = case.force(z, exact)
        residual = [r[i] - s * g[i] if s.v else r[i] for i in dim]
    else:
        g = at([Rounded(w) for w in d])
        residual = [r[i] - A[i] * Rounded(d[i]) - s * g[i] for i in dim]
    explicit = s.v * theta.v == 0
    size = [residual[i].e + (0 if explicit else 4 * sum(abs(float(J[i][j] * d[j])) for j in dim))
            for i in dim]
    inv = inverse(J)
    dx = [Rounded(d[i], sum(abs(float(inv[i][j])) * size[j] for j in dim)).rounded() for i in dim]
    return dx, at(dx)


def by_program(case, kind):
    """Repeat the operations of discrete_mechanics.c one by one."""
    n, dim = kind.number, range(case.d)
    exact = lambda q: Rounded(n(q))
    step, K, one = exact(case.h), exact(case.kappa), exact(1)
    mass, rho_ = [exact(v) for v in case.mass], [exact(v) for v in case.rho]
    X, P = [[exact(v) for v in case.x0]], [[exact(v) for v in case.p0]]
    for k in range(case.steps):
        f = [exact(v) * (exact(k + (case.method != "explicit")) * step) for v in case.ramp]
        if case.method == "explicit":
            g, v = case.force(X[k], exact), [P[k][i] / mass[i] for i in dim]
            X.append([X[k][i] + step * v[i] for i in dim])
            P.append([P[k][i] + step * (-g[i] - rho_[i] * v[i] + f[i]) for i in dim])
        elif case.method == "implicit":
            r = [P[k][i] + step * f[i] for i in dim]
            A = [mass[i] / step + rho_[i] for i in dim]
            dx, _ = rounded_solve(case, A, step, one, r, X[k], kind)
            X.append([X[k][i] + dx[i] for i in dim])
            P.append([mass[i] * dx[i] / step for i in dim])
        else:
            A = [w / step for w in mass]
            dx, g = rounded_solve(case, A, K * step, one - K, P[k], X[k], kind)
            X.append([X[k][i] + dx[i] for i in dim])
            end = [mass[i] * dx[i] / step - (one - K) * step * g[i] for i in dim]
            if case.method == "forced":
                end = [end[i] + (-rho_[i] * dx[i] + step * f[i]) for i in dim]
            P.append(end)
    return X, P


two = dict(x0=(1, Q(-1, 2)), p0=(0, Q(3, 4)), mass=(1, 2))
forced = dict(rho=(Q(1, 2), 0), ramp=(1, -2))
CASES = [Case(f"harmonic, kappa = {K}", "variational", "HARMONIC", K, cg=(3, 0), mass=(2,))
         for K in (0, Q(1, 4), Q(1, 2), 1)]
CASES += [Case(f"cubic, kappa = {K}", "variational", "CUBIC", K, steps=6, cg=(1, 1),
               exact=K in (0, 1)) for K in (0, Q(1, 4), Q(3, 4), 1)]
CASES += [
    Case("Duffing", "variational", "DUFFING", Q(1, 2), cg=(1, Q(1, 2)), exact=False),
    Case("pendulum", "variational", "PENDULUM", Q(1, 4), x0=(2,), cg=(2, 0), exact=False),
    Case("chain", "variational", "CHAIN", Q(1, 4), **two),
    Case("quartic chain, kappa = 1/4", "variational", "CHAIN", Q(1, 4), cg=(1, 2), steps=8,
         exact=False, **two),
    Case("quartic chain, kappa = 1", "variational", "CHAIN", 1, cg=(1, 2), steps=5, **two)]
CASES += [Case(f"harmonic, forced, kappa = {K}", "forced", "HARMONIC", K, mass=(2,),
               rho=(Q(1, 2), 0), ramp=(1, 0)) for K in (0, Q(1, 4), Q(1, 2), 1)]
CASES += [
    Case("chain, forced", "forced", "CHAIN", Q(1, 4), **two, **forced),
    Case("quartic chain, forced", "forced", "CHAIN", Q(3, 4), cg=(1, 2), steps=8, exact=False,
         **two, **forced),
    Case("pendulum, forced", "forced", "PENDULUM", Q(1, 2), x0=(2,), rho=(Q(1, 2), 0),
         ramp=(1, 0), exact=False),
    Case("harmonic", "explicit", "HARMONIC", mass=(2,), rho=(Q(1, 2), 0), ramp=(1, 0)),
    Case("quartic chain", "explicit", "CHAIN", cg=(1, 2), steps=5, **two, **forced),
    Case("harmonic", "implicit", "HARMONIC", mass=(2,), rho=(Q(1, 2), 0), ramp=(1, 0)),
    Case("Duffing", "implicit", "DUFFING", cg=(1, Q(1, 2)), rho=(Q(1, 2), 0), exact=False),
    Case("quartic chain", "implicit", "CHAIN", cg=(1, 2), steps=8, exact=False, **two, **forced)]


def values(case):
    """Return x and p as C literals, and the bounds of their rounding errors."""
    with mpmath.workdps(60):
        kind = Exactly if case.exact else Digits
        want, got = by_definition(case, kind), by_program(case, kind)
        for v, r_ in zip(sum(sum(want, []), []), sum(sum(got, []), [])):
            claim(f"{case.name}: the momentum form gives what the definition gives",
                  abs(v - r_.v) <= (0 if case.exact else mpmath.mpf(10) ** -50))
    return rows_of(case, want, got, lambda: by_definition(case, Digits))


methods = {"variational": "&fvi_midpoint_variational", "forced": "&fvi_lagrange_dalembert",
           "explicit": "&fvi_euler_explicit", "implicit": "&fvi_euler_implicit"}
header("verify/discrete_mechanics/discrete_mechanics_runs.py")
runs, rows = [], []
for case in CASES:
    pair = lambda v: "{ " + ", ".join(map(hexd, v)) + " }"
    runs.append([f'"{case.name}"', methods[case.method], case.kind, case.d, hexd(case.kappa),
                 hexd(case.h), case.steps, pair(case.cg), pair(case.mass), pair(case.rho),
                 pair(case.ramp), pair(case.x0), pair(case.p0), len(rows)])
    rows += values(case)
print("\n/* Runs; F(t) = ramp t. The first row of each is that of its k = 0. */")
table("ref_runs", "const char *name; const fvi_method *method; int kind; size_t d; "
      "double kappa, h; size_t steps; double cg[2], mass[2], rho[2], ramp[2], x0[2], p0[2]; "
      "size_t first;", runs)
print("\n/* x_k and p_k, component after component, step after step, and how many units")
print(" * of 2^-53 the results of the C code may be away from them. */")
table("ref_rows", "double x, p, x_units, p_units;", rows)
