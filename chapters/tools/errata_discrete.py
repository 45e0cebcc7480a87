"""Rows of H 16 about sums on a grid, momenta and runs. Fractions are exact."""
import math
from fractions import Fraction as Q

from errata_continuous import claim, say, near, row, run, weights, minus, plus


# ---- sums (H 5, 6, 7) ----

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


# ---- momenta and runs (H 8, 9, 10, 14) ----

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
    say("the list of what the captions leave open, and of our choices, is H 10, What is not said")


@row(34)
def bound():
    for R in (1.98, 2.02):                          # kappa = alpha = 1/2: 4^(1/2) R < 4
        _, x = run("run", "--alpha", "0.5", "--kappa", "0.5", "--rho", str(R), "--h", "1", "--steps", "2000", "--columns", "t,x")
        claim(f"kappa = alpha = 1/2, h = m = c = 1, rho = {R}: |x| at step 2000 is {abs(x[-1]):.1e}",
              (abs(x[-1]) < 1e-3) == (R < 2))
