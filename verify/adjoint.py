"""Chapter 23. The discrete adjoint of a fractional variational integrator.

Proved here:
  (23.9)  the derivatives of the weights by their order: the recurrence, for symbolic
          order, and the generating function ln(1 - z) (1 - z)^beta, n <= 12;
  (23.11) the derivative of the density of (12.5) by nu.
Compared: (23.11) itself, in 40-digit arithmetic: the sum over the nodes of (12.7).
Printed: the rates of the weights, from the definition: the product, differentiated."""
import mpmath
from mpmath import mp
import sys

from sympy import (Rational, binomial, diff, exp, expand, expand_func, log, pi, series,
                   simplify, sin, cos, symbols)

from refgen import claim, header, hexd, hexd_real, prove, short, table

b, z, s, nu = symbols("beta z s nu", positive=True)

DEBUG = False

# ---- the rates of the weights ----


def weight(n):
    """w_n(beta) as a polynomial in beta, by its definition."""
    return expand((-1) ** n * expand_func(binomial(b, n)))


#> rates
w = [weight(n) for n in range(13)]
rate = [diff(v, b) for v in w]
for n in range(1, 13):
    prove(f"(23.9) the recurrence, n = {n}",
          expand(rate[n] - rate[n - 1] * (n - 1 - b) / n + w[n - 1] / n))
    prove(f"(23.9) rate_n = - sum_j w_(n-j) / j, n = {n}",
          expand(rate[n] + sum(w[n - j] / j for j in range(1, n + 1))))
prove("(23.9) ln(1-z) = - sum z^j / j",
      series(log(1 - z), z, 0, 9).removeO() + sum(z**j / Rational(j) for j in range(1, 9)))
#< rates

#> density
density = -sin(pi * nu) / pi * (exp(s) - 1) ** nu
prove("(23.11) its derivative by nu",
      simplify((diff(density, nu) + (exp(s) - 1) ** nu
                * (cos(pi * nu) + sin(pi * nu) / pi * log(exp(s) - 1))).rewrite(exp)))
#< density


def exact_rate(beta, n):
    """d w_n / d beta: the product (j - beta) / (j + 1), differentiated, exactly."""
    beta, value, slope = Rational(beta), Rational(1), Rational(0)
    for j in range(n):
        value, slope = value * (j - beta) / (j + 1), (slope * (j - beta) - value) / (j + 1)
    return slope


def far_rate(beta, n):
    """The same by the digamma function: w_n (psi(-beta) - psi(n - beta))."""
    def at(digits):
        with mp.workdps(digits):
            x = mpmath.mpf(Rational(beta).p) / Rational(beta).q
            value = (mpmath.gammaprod([n - x], [-x, n + 1])
                     * (mpmath.digamma(-x) - mpmath.digamma(n - x)))
            return mpmath.nstr(value, digits - 15, min_fixed=0, max_fixed=0)
    return at


orders = [0.0, 1e-3, 0.3, 0.5, 0.9, 1.0, 1.25, 1.7, 2.0]
rates = []
for beta in orders:
    for n in [0, 1, 2, 3, 7, 20, 32, 33, 100, 500]:
        value = exact_rate(beta, n)
        rates.append([repr(beta), n, hexd(value), short(value)])
    for n in [10**4, 10**6] if beta % 1 else []:
        rates.append([repr(beta), n, hexd_real(far_rate(beta, n), 60)])
claim("the two definitions agree",
      abs(float(far_rate(0.3, 100)(60)) - float(exact_rate(0.3, 100))) < 1e-15)

# ---- derivatives of runs, by the definition ----

mp.dps = 70
BITS = 220  # a number of a run is an integer times 2^-BITS


def fixed(v):
    return int(mpmath.floor(mpmath.ldexp(mpmath.mpf(v), BITS)))


def times(a, b):
    return a * b >> BITS


def over(a, b):
    return (a << BITS) // b


def real(a):
    return mpmath.ldexp(mpmath.mpf(a), -BITS)


def weights(method, order, count):
    """w_n of the order 2 alpha, the coefficients of (1 - z)^order; BDF2: times those of
    ((3 - z)/2)^order."""
    w = [1 << BITS]
    for n in range(1, count):
        w.append(times(w[-1], (n - 1 << BITS) - order) // n)
    if method != "bdf2":
        return w
    g = [fixed(mpmath.mpf(1.5) ** real(order))]
    for n in range(1, count):
        g.append(times(g[-1], (n - 1 << BITS) - order) // (3 * n))
    return [sum(g[j] * w[n - j] for j in range(n + 1)) >> BITS for n in range(count)]


def impulses(e, N):
    """int (1 - s) (k + s)^e ds / Gamma(1 + e) and int s (k + s)^e ds / Gamma(1 + e)."""
    if e == -1:
        return [(mpmath.mpf(k == 0), mpmath.mpf(0)) for k in range(N)]
    power = [mpmath.mpf(0)] + [mpmath.mpf(k) ** e for k in range(1, N + 1)]
    unit, out = mpmath.rgamma(1 + e), []
    for k in range(N):
        whole = ((k + 1) * power[k + 1] - k * power[k]) / (e + 1)
        moment = ((k + 1) ** 2 * power[k + 1] - k**2 * power[k]) / (e + 2)
        out.append(((whole - moment + k * whole) * unit, (moment - k * whole) * unit))
    return out


def pull_of(q, order, x0, p0, m):
    """rho A h^(1+e) times the impulses of the past (19.3), at both ends of each step."""
    past, N = q["past"], q["N"]
    A = 0 if past == "caputo" or q["side"] == 0 else p0 / m if q["side"] > 0 else (
        x0 if past == "rl" else 0)
    e = 1 - order if q["side"] > 0 else -order
    if q["method"] == "fvi" or A == 0:
        return [(0, 0)] * N
    unit = q["rho"] * A * q["h"] ** (1 + e)
    return [(fixed(unit * a), fixed(unit * b)) for a, b in impulses(e, N)]


def trajectory(q):
    """x_0, ..., x_N and p_N of Algorithm 3 or (13.7), one Duffing oscillator."""
    N, printed, past = q["N"], q["method"] == "fvi", q["past"]
    order, one, half = 2 * q["alpha"], 1 << BITS, 1 << BITS - 1
    pull = pull_of(q, order, q["x0"], q["p0"], q["mass"])
    c = fixed(q["rho"] * q["h"] ** (1 - order))
    theta = fixed(q["alpha"]) if q["method"] == "shifted" else 0
    h, kappa, x0, p, m, k1, g3 = (fixed(q[n]) for n in ("h", "kappa", "x0", "p0", "mass", "k", "g"))
    origin = 0 if printed and past == "rl" else x0
    drift = over(times(h, p), m) if q["side"] > 0 and (past == "caputo" or not printed) else 0
    reverse = weights(q["method"], fixed(order), N + 1)[::-1]
    w0, z, x, dx = reverse[-1], [x0 - origin], [x0], over(times(h, p), m)
    H, share, inertia = times(w0, z[0]), times(kappa, h), over(m, h) + times(times(theta, c), w0)
    for k in range(N):
        if not printed:
            p += times(h, q["F"][k]) // 2 - times(half - theta, times(c, H)) - pull[k][0]
        ahead = sum(map(int.__mul__, reverse[-len(z) - 1:-1], z)) >> BITS
        ahead += times(w0, x[-1] - origin - (k + 1) * drift)  # H of k + 1 if dx is zero
        r = p - times(theta, times(c, ahead))
        while True:  # Newton's method, to the last bit but some
            S = x[-1] + times(one - kappa, dx)
            SS = times(S, S)
            step = over(times(inertia, dx) + times(share, times(k1 + times(g3, SS), S)) - r,
                        inertia + times(times(share, one - kappa), k1 + 3 * times(g3, SS)))
            dx -= step
            if abs(step) < 1 << BITS // 2:
                break
        S = x[-1] + times(one - kappa, dx)
        p -= times(h, times(k1 + times(g3, times(S, S)), S))
        H = ahead + times(w0, dx)
        x.append(x[-1] + dx)
        p += times(h, q["F"][k + 1]) - times(c, H) if printed else (
            times(h, q["F"][k + 1]) // 2 - times(half + theta, times(c, H)) - pull[k][1])
        z.append(x[-1] - origin - (k + 1) * drift)
    return x, p


def objective(q):
    """J = (h/2) sum_{k>=1} (x_k - sin t_k)^2 + x_N/2 + x_N p_N^2/4"""
    x, p = trajectory(q)
    squares = sum((v - s) ** 2 for v, s in zip(x[1:], q["sine"][1:])) >> BITS
    J = real(squares) * q["h"] / 2 + real(x[-1]) / 2 + real(x[-1]) * real(p) ** 2 / 4
    return J, real(x[-1]), real(p)


def derivatives(q, names, force):
    """Central differences, 2^-65 wide with 220 bits: right to 35 digits."""
    eps, out = mpmath.mpf(2) ** -66, []
    for name in names + [force]:
        ends = []
        for sign in (1, -1):
            r = dict(q)
            if name == force:
                r["F"] = list(q["F"])
                r["F"][force] += sign * fixed(eps)
            else:
                r[name] = q[name] + sign * eps
            ends.append(objective(r)[0])
        out.append((ends[0] - ends[1]) / (2 * eps))
    return out


NAMES = ["x0", "p0", "mass", "rho", "alpha", "k", "g"]


def nearest(v):
    return hexd(Rational(mpmath.nstr(v, 30, min_fixed=0, max_fixed=0)))


def row(method, past, alpha, kappa, N, h, x0, force):
    q = dict(method=method, past=past, alpha=mpmath.mpf(alpha), kappa=mpmath.mpf(kappa), N=N,
             h=mpmath.mpf(h), mass=mpmath.mpf(1), rho=mpmath.mpf(3) / 8, x0=mpmath.mpf(x0),
             p0=mpmath.mpf(1) / 2, k=mpmath.mpf(1), g=mpmath.mpf(1) / 2)
    q["side"] = (alpha > 0.5) - (alpha < 0.5)  # at 1/2: the derivative from below
    q["F"] = [fixed(mpmath.cos(k * q["h"]) / 4) for k in range(N + 1)]
    q["sine"] = [fixed(mpmath.sin(k * q["h"])) for k in range(N + 1)]
    names = [n for n in NAMES if not (n == "x0" and method != "fvi" and past == "rl" and alpha > 0.5)]
    slopes = derivatives(q, names, force)
    if "x0" not in names:
        slopes.insert(0, None)
    J, x, p = objective(q)
    print(f"{method} {past} {alpha}: J {mpmath.nstr(J, 20)} x {mpmath.nstr(x, 20)} p {mpmath.nstr(p, 20)} "
          + " ".join(mpmath.nstr(v, 18) if v is not None else "-" for v in slopes), file=sys.stderr) if DEBUG else None
    return ([f"&fvi_{dict(fvi='fractional').get(method, method)}",
             f"FVI_PAST_{dict(rl='RIEMANN_LIOUVILLE').get(past, past.upper())}", repr(alpha),
             repr(kappa), N, repr(h), repr(x0), force]
            + [nearest(v) for v in (x, p)]
            + ["NAN" if v is None else nearest(v) for v in slopes])


runs = [row("fvi", past, alpha, kappa, 2000, 1 / 128, 1.0, 777) for past, alpha, kappa in
        [("caputo", 0.3125, 0.5), ("caputo", 0.75, 0.25), ("rl", 0.75, 0.25), ("held", 0.75, 0.25)]]
for method in ("fvi", "shifted", "bdf2"):
    for past in ("held", "caputo", "rl"):
        for alpha, kappa in ((0.0, 0.5), (0.3, 0.25), (0.5, 0.5), (0.8, 0.3), (0.9 if method == "bdf2" else 1.0, 0.5)):
            if (method, past) != ("fvi", "caputo") or alpha > 0.5:
                x0 = 0.0 if past == "rl" and alpha > 0.5 and method != "fvi" else 0.875
                runs.append(row(method, past, alpha, kappa, 60, 1 / 16, x0, 23))

header("verify/adjoint.py")
print("\n/* beta, n, d w_n / d beta; the exact rational where it is short */")
table("ref_rates", "double beta; size_t n; double want;", rates)

print("""
/* A Duffing oscillator, c = 1, g = 1/2, m = 1, rho = 3/8, p0 = 1/2, F = cos(t)/4; x_N, p_N;
   J = (h/2) sum_{k=1}^N (x_k - sin t_k)^2 + x_N/2 + x_N p_N^2/4, by all that there is */""")
table("ref_slopes", "const fvi_method *method; fvi_past past; double alpha, kappa; size_t N; "
      "double h, x0; size_t force; double x, p, by_x0, by_p0, by_mass, by_rho, by_alpha, "
      "by_c, by_g, by_F;", runs)
