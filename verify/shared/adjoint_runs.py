"""Runs of one Duffing oscillator by Algorithm 3 and (13.7), in integers: what the
derivatives of verify/adjoint/adjoint.py are differences of.

A number of a run is an integer times 2^-178, so mpmath must be set to 60 digits or more."""
from operator import mul

import mpmath

BITS = 178  # a number of a run is an integer times 2^-BITS
# z differ by less than 2^-60, so that weights without their last LESS bits serve what they differ by, to
# 2^-178 each, and no sum of products is larger than a slot.
LESS, SLOT, HALF_SLOT = 60, 256, 1 << 255


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
    ((3 - z)/2)^order; stable: times (1 + order)/2 + z (1 - order)/2."""
    w = [1 << BITS]
    for n in range(1, count):
        w.append(times(w[-1], (n - 1 << BITS) - order) // n)
    if method == "stable":  # (13.16)
        return [times((1 << BITS) + order, v) + times((1 << BITS) - order, u) >> 1
                for v, u in zip(w, [0] + w)]
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
    """x_0, ..., x_N and p_N of Algorithm 3 or (13.7), one Duffing oscillator. It hands out z_k
    and is handed sum_{j<=k} w_{k+1-j} z_j."""
    N, printed, past = q["N"], q["method"] == "fvi", q["past"]
    order, one, half = 2 * q["alpha"], 1 << BITS, 1 << BITS - 1
    pull = pull_of(q, order, q["x0"], q["p0"], q["mass"])
    c = fixed(q["rho"] * q["h"] ** (1 - order))
    theta = fixed(dict(shifted=q["alpha"], stable=mpmath.mpf(1) / 2).get(q["method"], 0))
    h, kappa, x0, p, m, k1, g3 = (fixed(q[n]) for n in ("h", "kappa", "x0", "p0", "mass", "k", "g"))
    origin = 0 if printed and past == "rl" else x0
    drift = over(times(h, p), m) if q["side"] > 0 and (past == "caputo" or not printed) else 0
    w0, z, x, dx = weights(q["method"], fixed(order), 1)[0], x0 - origin, [x0], over(times(h, p), m)
    H, share, inertia = times(w0, z), times(kappa, h), over(m, h) + times(times(theta, c), w0)
    for k in range(N):
        if not printed:
            p += times(h, q["F"][k]) // 2 - times(half - theta, times(c, H)) - pull[k][0]
        ahead = (yield z) >> BITS
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
        z = x[-1] - origin - (k + 1) * drift
    return x, p


def in_step(qs):
    """Their trajectories, step by step together. Runs of one order share the weights: what z
    differs by from that of the first is packed into one integer, SLOT bits each, for one sum."""
    runs, ends, alike, N = [trajectory(q) for q in qs], [], {}, qs[0]["N"]
    for i, q in enumerate(qs):
        alike.setdefault(fixed(2 * q["alpha"]), []).append(i)
    groups = []
    for order, (first, *rest) in alike.items():
        reverse = weights(qs[0]["method"], order, N + 1)[::-1]
        groups.append((reverse, [w >> LESS for w in reverse], first, rest, [], []))
    newest, sums = [next(run) for run in runs], [0] * len(qs)
    for k in range(N):
        for reverse, short, first, rest, z, packed in groups:
            z.append(newest[first])
            packed.append(sum(newest[i] - z[-1] << SLOT * n for n, i in enumerate(rest)))
            sums[first] = sum(map(mul, reverse[-k - 2:-1], z))
            total = sum(map(mul, short[-k - 2:-1], packed)) if rest else 0
            for i in rest:
                part = (total + HALF_SLOT & (1 << SLOT) - 1) - HALF_SLOT
                sums[i], total = sums[first] + (part << LESS), total - part >> SLOT
        for i, run in enumerate(runs):
            try:
                newest[i] = run.send(sums[i])
            except StopIteration as end:
                ends.append(end.value)
    return ends
