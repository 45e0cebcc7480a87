"""H 25. The least force that brings a run to a given end.

Proved here:
  (25.2)  the conditions of Lagrange are the run, its adjoint with J = nu . (x_N, p_N), and
          u = -lambda (N = 4, a quartic U, all symbols);
  (25.6)  a body at rest stays at rest in the next step under the force c H_k / h (symbols, N = 4).
Printed: solutions of all conditions together, as one dense system of 3 N equations, by Newton's method with 40
digits. No adjoint run and no Gramian occurs in it."""
import mpmath
from mpmath import mp, mpf
from sympy import diff, expand, symbols

from shared.refgen import initial_history, claim, header, nearest, prove, table

#> lagrange
N, kappa, h, m, c, k0, g, p0, nux, nup = 4, *symbols("kappa h m c k0 g p0 nu_x nu_p")
x, u, lam, w = (symbols(f"{name}0:5") for name in ("x", "u", "lambda", "w"))
action = sum(m / 2 * (x[k + 1] - x[k]) ** 2 / h - h * (k0 * S**2 / 2 + g * S**4 / 4)
             for k in range(N) for S in [kappa * x[k] + (1 - kappa) * x[k + 1]])
H = [sum(w[n] * (x[k - n] - x[0]) for n in range(k + 1)) for k in range(N + 1)]
R = [diff(action, x[0]) + p0] + [diff(action, x[k]) - c * H[k] + h * u[k] for k in range(1, N)]
pN = diff(action, x[N]) - c * H[N] + h * u[N]
L = (h / 2 * sum(v**2 for v in u[1:]) + sum(lam[k] * R[k] for k in range(N))
     + nux * x[N] + nup * pN)
for k in range(1, N):
    prove("(25.2) by u_k", expand(diff(L, u[k]) - h * (u[k] + lam[k])))
prove("(25.2) by u_N", expand(diff(L, u[N]) - h * (u[N] + nup)))
adjoint = sum(lam[k] * R[k] for k in range(N)) + nup * pN  # lambda_N = J_p = nu_p
for k in range(1, N + 1):
    prove("(25.2) by x_k", expand(diff(L, x[k]) - diff(adjoint, x[k]) - (nux if k == N else 0)))
#< lagrange

#> hold
rest = {x[j]: 0 for j in range(2, N + 1)}  # the body is at rest at 0 from step 2 on
p2 = diff(action, x[2]) - diff(m / 2 * (x[3] - x[2]) ** 2 / h
                               - h * (k0 * (kappa * x[2] + (1 - kappa) * x[3]) ** 2 / 2
                                      + g * (kappa * x[2] + (1 - kappa) * x[3]) ** 4 / 4), x[2])
step = R[3].subs(u[3], c * H[3] / h).subs({x[j]: 0 for j in range(3, N + 1)})
prove("(25.6) x_4 = 0 solves the step from rest, x_2 = x_3 = 0", expand(step.subs(rest)))
#< hold

mp.dps = 40
UNIT = 1 << 200


def dense(A, right):
    """Return A^(-1) right by Gauss's elimination with the largest pivot, in units of 2^-200."""
    n = len(right)
    fixed = lambda v: int(mpmath.nint(v * UNIT))
    A = [[fixed(v) if v else 0 for v in row] + [fixed(b)] for row, b in zip(A, right)]
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(A[i][k]))
        A[k], A[p] = A[p], A[k]
        top, used = A[k], [j for j in range(k + 1, n + 1) if A[k][j]]
        for row in A[k + 1:]:
            if row[k]:
                q = row[k] * UNIT // top[k]
                for j in used:
                    row[j] -= q * top[j] >> 200
    x = [0] * n
    for k in reversed(range(n)):
        x[k] = (A[k][n] * UNIT - sum(a * b for a, b in zip(A[k][k + 1:n], x[k + 1:]))) // A[k][k]
    return [mpf(v) / UNIT for v in x]


def solve(case):
    """Solve all conditions at once. Return u_1, ..., u_N and the cost."""
    N, h, kappa, rho, alpha, past, k0, g, x0, p0, xT, pT = case
    h, kappa, rho, alpha, k0, g, x0, p0, xT, pT = map(mpf, (h, kappa, rho, alpha, k0, g, x0, p0, xT, pT))
    c, w = rho * h ** (1 - 2 * alpha), [mpf(1)]
    for n in range(1, N + 1):
        w.append(w[-1] * (n - 1 - 2 * alpha) / n)
    origin = 0 if past == "rl" else x0
    drift = h * p0 if past == "caputo" and 2 * alpha > 1 else 0
    s = (kappa, 1 - kappa)
    xs = [x0] + [x0 + (xT - x0) * k / N for k in range(1, N + 1)]
    us, la = [mpf(0)] * (N + 1), [mpf(0)] * (N + 1)
    ix = {k: k - 1 for k in range(1, N)}
    iu = {k: N - 2 + k for k in range(1, N + 1)}
    il = {k: 2 * N - 1 + k for k in range(N + 1)}
    for _ in range(30):
        f, A = [mpf(0)] * (3 * N), [[0] * (3 * N) for _ in range(3 * N)]

        def put(row, col, v):
            A[row][col] += v

        R = [mpf(0)] * (N + 1)
        R[0] += p0
        R[N] -= pT
        for k in range(N):
            S = kappa * xs[k] + (1 - kappa) * xs[k + 1]
            grad, hess, third = (k0 + g * S * S) * S, k0 + 3 * g * S * S, 6 * g * S
            M = kappa * la[k] + (1 - kappa) * la[k + 1]
            for a in (0, 1):  # slopes of L_d at its two ends
                sign = (-1, 1)[a]
                R[k + a] += sign * m1 * (xs[k + 1] - xs[k]) / h - h * s[a] * grad
                for b in (0, 1):
                    slope = sign * (-1, 1)[b] * m1 / h - h * s[a] * s[b] * hess
                    if k + b in ix:
                        put(il[k + a], ix[k + b], slope)
                        put(ix[k + b], il[k + a], slope)
                        f[ix[k + b]] += la[k + a] * slope
                        if k + a in ix:
                            put(ix[k + a], ix[k + b], -h * third * M * s[a] * s[b])
        for k in range(1, N + 1):
            H = sum(w[n] * (xs[k - n] - origin - (k - n) * drift) for n in range(k + 1))
            R[k] += -c * H + h * us[k]
            for j in range(1, min(k, N - 1) + 1):
                put(il[k], ix[j], -c * w[k - j])
                put(ix[j], il[k], -c * w[k - j])
                f[ix[j]] -= c * w[k - j] * la[k]
            f[iu[k]] = h * (us[k] + la[k])
            put(iu[k], iu[k], h)
            put(iu[k], il[k], h)
            put(il[k], iu[k], h)
        for k in range(N + 1):
            f[il[k]] = R[k]
        d = dense(A, [-v for v in f])
        for k, i in ix.items():
            xs[k] += d[i]
        xs[N] = xT
        for k, i in iu.items():
            us[k] += d[i]
        for k, i in il.items():
            la[k] += d[i]
        if max(map(abs, d)) < mpf(10) ** -28:
            return us, h / 2 * sum(v * v for v in us)
    raise SystemExit("NOT TRUE: Newton's method converged")


m1 = mpf(1)
cases = [  # N, h, kappa, rho, alpha, past, c, g, x0, p0, x_T, p_T
    (32, 0.3125, 0.5, 0.375, 0.3125, "held", 1, 0.0, 1.0, 0.25, 0.0, 0.0),
    (32, 0.25, 0.25, 0.375, 0.75, "caputo", 1, 0.0, 1.0, 0.25, 0.5, -1.0),
    (24, 0.25, 0.5, 0.375, 0.3, "rl", 1, 0.0, 1.0, 0.25, 0.0, 0.0),
    (32, 0.3125, 0.5, 0.375, 0.3125, "held", 1, 0.5, 1.0, 0.25, 0.0, 0.0),
    (24, 0.25, 0.25, 0.375, 0.75, "caputo", 1, 0.5, 1.0, 0.25, 0.5, -1.0),
    (24, 0.25, 0.5, 0.375, 0.75, "held", 1, 0.5, 1.0, 0.25, 0.25, 0.0),
]


header("verify/control/control.py")
rows, values = [], []
for case in cases:
    us, cost = solve(case)
    claim("a cost is positive", cost > 0)
    past = initial_history(case[5])
    rows.append([repr(v) for v in case[:5]] + [past] + [repr(v) for v in case[6:]]
                + [len(values), nearest(cost)])
    values += us
print("\n/* m = 1, U = c x^2/2 + g x^4/4; where u_0 stands in ref_u, and the cost */")
table("ref_controls", "size_t N; double h, kappa, rho, alpha; fvi_initial_history past; double c, g, x0, p0, x, p; "
      "size_t at; double cost;", rows)
print("\nstatic const double ref_u[] = {")
for v in values:
    print(f"    {nearest(v)},")
print("};")
