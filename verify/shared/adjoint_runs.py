"""Runs of one Duffing oscillator by Algorithm 3 and (13.7), in integers. verify/adjoint/adjoint.py takes differences
of these runs.

A number of a run is an integer times 2^-178, so mpmath must be set to 60 digits or more."""
from operator import mul

import mpmath
from mpmath.libmp import MPZ

BITS = 178  # a number of a run is an integer times 2^-BITS
# The newest terms, up to a block, are summed one by one. No sum of products exceeds 2^(2 BITS + 20). With MIDDLE
# added no sum is negative or leaves its slot.
BLOCK, SLOT, MIDDLE = 64, 400, 1 << 398


def fixed(v):
    return int(mpmath.floor(mpmath.ldexp(mpmath.mpf(v), BITS)))


def times(a, b):
    return a * b >> BITS


def over(a, b):
    return (a << BITS) // b


def real(a):
    return mpmath.ldexp(mpmath.mpf(a), -BITS)


def weights(method, order, count):
    """Return w_n of the order 2 alpha, the coefficients of (1 - z)^order. BDF2: multiplied by those of ((3 -
    z)/2)^order; stable: multiplied by (1 + order)/2 + z (1 - order)/2."""
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
    """Return int (1 - s) (k + s)^e ds / Gamma(1 + e) and int s (k + s)^e ds / Gamma(1 + e) for each step k."""
    if e == -1:
        return [(mpmath.mpf(k == 0), mpmath.mpf(0)) for k in range(N)]
    power = [mpmath.mpf(0)] + [mpmath.mpf(k) ** e for k in range(1, N + 1)]
    unit, out = mpmath.rgamma(1 + e), []
    for k in range(N):
        whole = ((k + 1) * power[k + 1] - k * power[k]) / (e + 1)
        moment = ((k + 1) ** 2 * power[k + 1] - k**2 * power[k]) / (e + 2)
        out.append(((whole - moment + k * whole) * unit, (moment - k * whole) * unit))
    return out


def start_impulses_of(q, order, x0, p0, m):
    """Return rho A h^(1+e) times the impulses of the past (19.3), at both ends of each step."""
    past, N = q["past"], q["N"]
    A = 0 if past == "caputo" or q["side"] == 0 else p0 / m if q["side"] > 0 else (
        x0 if past == "rl" else 0)
    e = 1 - order if q["side"] > 0 else -order
    if q["method"] == "fvi" or A == 0:
        return [(0, 0)] * N
    unit = q["rho"] * A * q["h"] ** (1 + e)
    return [(fixed(unit * a), fixed(unit * b)) for a, b in impulses(e, N)]


def trajectory(q):
    """Generate a run of one Duffing oscillator by Algorithm 3 or (13.7) as a coroutine that returns x_0, ..., x_N and
    p_N. It yields z_k; send it the sum sum_{j<=k} w_{k+1-j} z_j and a guess of the change of dx."""
    N, printed, past = q["N"], q["method"] == "fvi", q["past"]
    order, one, half = 2 * q["alpha"], 1 << BITS, 1 << BITS - 1
    start_impulses = start_impulses_of(q, order, q["x0"], q["p0"], q["mass"])
    c = fixed(q["rho"] * q["h"] ** (1 - order))
    theta = fixed(dict(shifted=q["alpha"], stable=mpmath.mpf(1) / 2).get(q["method"], 0))
    h, kappa, x0, p, m, k1, g3 = (fixed(q[n]) for n in ("h", "kappa", "x0", "p0", "mass", "k", "g"))
    origin = 0 if printed and past == "rl" else x0
    drift = over(times(h, p), m) if q["side"] > 0 and (past == "caputo" or not printed) else 0
    w0, z, x, dx = weights(q["method"], fixed(order), 1)[0], x0 - origin, [x0], over(times(h, p), m)
    H, share, inertia = times(w0, z), times(kappa, h), over(m, h) + times(times(theta, c), w0)
    for k in range(N):
        if not printed:
            p += times(h, q["F"][k]) // 2 - times(half - theta, times(c, H)) - start_impulses[k][0]
        total, change = yield z
        ahead, dx = total >> BITS, dx + change
        ahead += times(w0, x[-1] - origin - (k + 1) * drift)  # the sum H of k + 1 for dx = 0
        r = p - times(theta, times(c, ahead))
        while True:  # Newton's method, until only the last few bits are uncertain
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
            times(h, q["F"][k + 1]) // 2 - times(half + theta, times(c, H)) - start_impulses[k][1])
        z = x[-1] - origin - (k + 1) * drift
    return x, p


def middles(count):
    return int.from_bytes(MIDDLE.to_bytes(SLOT // 8, "little") * count, "little")


def packed(numbers):
    """Return sum_n a_n 2^(SLOT n)."""
    slots = b"".join((v + MIDDLE).to_bytes(SLOT // 8, "little") for v in numbers)
    return MPZ(int.from_bytes(slots, "little") - middles(len(numbers)))


def spread(w, z, sums):
    """Add the contributions of the b newest z to the next b sums, sums[k] and so on, where b is the largest power of
    2 that divides their number k. One product of integers does it: its slots are the coefficients of a product of
    polynomials."""
    k, size = len(z), SLOT // 8
    b = k & -k
    product = packed(z[-b:]) * packed(w[:2 * b + 1]) + middles(3 * b)
    slots = int(product).to_bytes(3 * b * size, "little")
    for n in range(b):
        at = (b + 1 + n) * size
        sums[k + n] += int.from_bytes(slots[at:at + size], "little") - MIDDLE


def in_step(qs):
    """Return the trajectories of all runs, which proceed step by step together. The change of dx in the first run is
    the guess for the other runs."""
    runs, ends, w, N = [trajectory(q) for q in qs], [], {}, qs[0]["N"]
    orders = [fixed(2 * q["alpha"]) for q in qs]
    for order in orders:
        w[order] = w.get(order) or weights(qs[0]["method"], order, N + 1)
    z, sums = [[next(run)] for run in runs], [[0] * 2 * N for _ in runs]
    for k in range(N):
        block = k % BLOCK + 1
        for run, order, past, total in zip(runs, orders, z, sums):
            total[k] += sum(map(mul, w[order][block:0:-1], past[-block:]))
            if block == BLOCK:
                spread(w[order], past, total)
            change = z[0][-1] - 2 * z[0][-2] + z[0][-3] if k > 1 else 0
            try:
                past.append(run.send((total[k], change)))
            except StopIteration as end:
                ends.append(end.value)
    return ends
