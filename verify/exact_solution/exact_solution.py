"""H 11. m x'' + c x + rho D^(2 alpha) x = F, solved exactly.

Proved here, all letters symbolic unless it says otherwise:
  (11.2)  the rule for the transform of a fractional derivative, on all powers;
  (11.3)  the step response is 1 minus the Caputo solution, over c;
  (11.4)  the modulus and the damping of an angle solve Q(s) = 0;
  (11.5)  d ln(rho) / d theta is the expression that (11.6) shows positive;
  (11.6)  that identity; and, counted by the argument principle for rational
          alpha and rho (numbers), Q has two zeros on the principal sheet;
  (11.8)  the kernel of the cut;
  (11.9)  the double series for large and for small times, j, k <= 4;
  (11.10) the hyperbola, its derivative, and phi >= theta - pi/2;
  (11.13) the closed forms solve their equations;
  (11.14) Bagley and Torvik's problem by four complex error functions (numbers);
  (11.16) the last node, for all times of a window; and, on 1/(s^(1 + b)), that the rule
          with so many nodes errs by no more than the tolerance (numbers);
  (11.18) the powers of a row that a block has; (11.19) the pulse, seen from its end.
Printed: x and x' by Talbot's rule, which does not split the solution. For long times this rule needs too many
terms, so the values come from the residues and the integral along the cut. The C code uses a hyperbola, so it
shares neither rule."""
import cmath
import math

import mpmath
from mpmath import mp, mpf
from sympy import (I, acosh, binomial, cos, cosh, diff, exp, expand, gamma, gammasimp, im,
                   log, pi, simplify, sin, sinh, symbols, tan, together)

from shared.exact_solution_routes import CAPUTO, HELD, Problem, by_cut, by_talbot, pole, size
from shared.refgen import claim, header, hexd, hexd_real, largest, prove, table

m, c, rho, s, r, t, theta = symbols("m c rho s r t theta", positive=True)
beta = symbols("beta", positive=True)
Q = m * s**2 + c + rho * s**beta


#> transform
def of_power(g):
    """Return the transform of t^g."""
    return gamma(g + 1) / s ** (g + 1)


def of_derivative(g, order):
    """Return the transform of D^order t^g, by the power rule of H 1."""
    return gamma(g + 1) / gamma(g + 1 - order) * of_power(g - order)


g = symbols("g", positive=True)
prove("(11.2) D^beta t^g has s^beta times the transform of t^g",
      gammasimp(of_derivative(g, beta) / (s**beta * of_power(g))) - 1)
prove("(11.2) Riemann-Liouville, x = 1 and x = t: nothing is subtracted",
      simplify(of_derivative(0, beta) - s**beta * of_power(0)),
      simplify(of_derivative(1, beta) - s**beta * of_power(1)))
prove("(11.2) Caputo, x = 1 and, beta > 1, x = t: the derivative is zero",
      s**beta * of_power(0) - s ** (beta - 1), s**beta * of_power(1) - s ** (beta - 2))
prove("(11.2) held, x = 1 and x = t: only the first is zero",
      s**beta * of_power(0) - s ** (beta - 1), of_derivative(1, beta) - s ** (beta - 2))
#< transform

prove("(11.3) c / (s Q) = 1/s - (m s + rho s^(beta-1)) / Q",
      simplify(c / (s * Q) - 1 / s + (m * s + rho * s ** (beta - 1)) / Q))

#> angle
a, b = symbols("a b", positive=True)  # beta theta, (2 - beta) theta
r2 = c / m * sin(a) / sin(b)  # (11.4), the square of the modulus
damping = -c * sin(a + b) / sin(b)  # (11.4), rho r^beta
zero = m * r2 * exp(I * (a + b)) + c + damping * exp(I * a)
prove("(11.4) Q(r e^(i theta)) = 0",
      expand(expand(zero * sin(b) / c, trig=True).rewrite(exp)))

log_rho = (log(-sin(2 * theta)) - beta / 2 * log(sin(beta * theta))
           - (1 - beta / 2) * log(sin((2 - beta) * theta)))
cot_ = [cos(x_) / sin(x_) for x_ in (2 * theta, beta * theta, (2 - beta) * theta)]
slope = (4 * theta**2 * cot_[0] - (beta * theta) ** 2 * cot_[1]
         - ((2 - beta) * theta) ** 2 * cot_[2]) / (2 * theta**2)
prove("(11.5) its derivative", expand(diff(log_rho, theta) - slope))
A, B = symbols("A B", real=True)  # cot a, cot b; cot(a + b) = (AB - 1)/(A + B)
prove("(11.6) (A + B) ((a+b)^2 cot(a+b) - a^2 A - b^2 B) is minus two squares",
      expand(((a + b) ** 2 * (A * B - 1) - (a**2 * A + b**2 * B) * (A + B))
             + (a * A - b * B) ** 2 + (a + b) ** 2))
#< angle


def windings(b_, rho_, inner=1e-8, outer=1e8, steps=400):
    """Return how often Q(s) = s^2 + 1 + rho s^b winds around 0 while s runs along a keyhole: the large circle, and
    back along both sides of the cut."""
    turn = [math.pi * (2 * k - steps) / steps for k in range(steps + 1)]
    side = [outer * (inner / outer) ** (k / steps) for k in range(steps + 1)]
    value = lambda r_, angle: cmath.rect(r_, angle) ** 2 + 1 + rho_ * cmath.rect(r_**b_, b_ * angle)
    points = [value(outer, angle) for angle in turn]
    points += [value(r_, math.pi) for r_ in side]
    points += [value(inner, angle) for angle in reversed(turn)]
    points += [value(r_, -math.pi) for r_ in reversed(side)]
    return round(sum(cmath.phase(q / p) for p, q in zip(points, points[1:])) / (2 * math.pi))


for b_ in (0.3, 0.9, 1.2, 1.9):
    for rho_ in (0.1, 3):
        claim(f"two zeros, beta = {b_}, rho = {rho_}", windings(b_, rho_) == 2)

#> kernel
x0, v0, k0, k1, y = symbols("x0 v0 kappa0 kappa1 y", real=True)
co, si = cos(pi * beta), sin(pi * beta)  # s^beta = y e^(i pi beta), y = r^beta
upper = y * (co + I * si)
numerator = ((-m * r - k0 * rho * upper / r) * x0 + (m + k1 * rho * upper / r**2) * v0)
q_re, q_im = m * r**2 + c + rho * y * co, rho * y * si
cut = -im(expand(numerator * (q_re - I * q_im))) / (q_re**2 + q_im**2) / pi
#< kernel
printed = (rho * y * si / pi * (m * v0 - m * r * x0
           + (k0 * x0 / r - k1 * v0 / r**2) * (m * r**2 + c)) / (q_re**2 + q_im**2))
prove("(11.8) the kernel", simplify(together(cut - printed)))

#> series
X, Y = symbols("X Y")  # small: rho s^beta and m s^2 over c, or powers of 1/s
terms = sum((-1) ** (j + k) * binomial(j + k, j) * X**j * Y**k
            for j in range(5) for k in range(5))
product = expand((1 + X + Y) * terms)
for j in range(5):
    for k in range(5):
        prove(f"(11.9) 1/(1 + X + Y), j = {j}, k = {k}",
              product.coeff(X, j).coeff(Y, k) - (1 if j == k == 0 else 0))
#< series

#> hyperbola
u, phi, mu = symbols("u phi mu", positive=True)
z = mu * (1 - sin(phi) * cosh(u) + I * cos(phi) * sinh(u))
prove("(11.10) z = mu (1 + sin(iu - phi))",
      expand((z - mu * (1 + sin(I * u - phi))).rewrite(exp)))
prove("(11.11) tan phi - tan(theta - pi/2) = (1 - sin(phi) e^-u) / (cos phi sinh u)",
      simplify((tan(phi) - (sin(phi) * cosh(u) - 1) / (cos(phi) * sinh(u))
                - (1 - sin(phi) * exp(-u)) / (cos(phi) * sinh(u))).rewrite(exp)))
across, along = symbols("x y", real=True)
prove("(11.11) |1 +- sin(x + iy)| = cosh y +- sin x, so that their sum is 2 cosh y",
      *(expand((1 + k * sin(across) * cosh(along)) ** 2 + (cos(across) * sinh(along)) ** 2
               - (cosh(along) + k * sin(across)) ** 2).subs(cosh(along) ** 2, 1 + sinh(along) ** 2)
        .subs(cos(across) ** 2, 1 - sin(across) ** 2).expand() for k in (1, -1)))
#< hyperbola

#> rows
lam, tau, folds = symbols("lambda tau Lambda", positive=True)  # Lambda: L times the logarithm of 1/tolerance
last = acosh((1 + folds / mu) / sin(phi))
prove("(11.16) at the last node Re z is -Lambda",
      simplify(mu * (1 - sin(phi) * cosh(last)) + folds))
prove("(11.19) a pulse, seen from its end",
      expand(exp(lam * z) - exp((lam - tau) * z) - exp((lam - tau) * z) * (exp(tau * z) - 1), power=True).rewrite(exp).simplify())


def steps_and_nodes(wanted, width, center, log_E, ratio, mu_=3.0):
    """Return the step and the number of nodes by (11.16); wanted = ln(1/tolerance)."""
    step = 2 * math.pi * width / (wanted + 5 + log_E)
    return step, math.ceil(math.acosh((1 + ratio * (wanted + 2) / mu_) / math.sin(center)) / step)


def rule_errs(b, tolerance, width, ratio=100, center=0.675, mu_=3.0):
    """Return the largest error of (11.15) at times down to 1/ratio for 1/s^(1 + b), the transform of t^b / Gamma(1 +
    b), divided by the largest value of this function, 1 / Gamma(1 + b)."""
    wanted = math.log(1 / tolerance)
    edge = mu_ * (1 - math.sin(center + width))
    step, nodes = steps_and_nodes(wanted, width, center, -b * math.log(edge), ratio)  # (11.17)
    worst = 0
    for part in (1, 0.7, 0.3, 0.1, 0.03, 1 / ratio):
        value = 0
        for k in range(nodes):
            u_ = (k + 0.5) * step
            z_ = mu_ * (1 - cmath.sin(center - 1j * u_).real
                        + 1j * math.cos(center) * math.sinh(u_))
            dz = mu_ * (-math.sin(center) * math.sinh(u_) + 1j * math.cos(center) * math.cosh(u_))
            value += (step / math.pi * cmath.exp(part * z_) * dz / z_ ** (1 + b)).imag
        worst = largest((worst, abs(value * math.gamma(1 + b) - part**b)))
    return worst


for b_ in (0, 0.5, 1, 1.5, 2):
    for tolerance in (1e-1, 1e-3, 1e-6, 1e-9, 1e-12):
        for width in (0.675, 0.3):
            claim(f"(11.16) errs by less than {tolerance} on t^{b_}, d = {width}",
                  rule_errs(b_, tolerance, width) < tolerance)

highest = math.log(8) - 2 * math.log(3 * (1 - math.sin(1.35)))  # the largest possible ln E
for poles, most in ((2, 350), (4, 620)):
    half = 1.35 / 2 / (poles + 1)  # the widest interval without a pole has at least twice this width
    claim(f"(11.16) at most {most} nodes with {poles} poles, for 1e-16 and times from 1 to 200",
          steps_and_nodes(16 * math.log(10), half, half, highest, 200)[1] <= most)
#< rows

#> closed
w, f, A_, gam = symbols("omega Omega A gamma", positive=True)
free = exp(-gam * t) * (x0 * cos(w * t) + (v0 + gam * x0) / w * sin(w * t))
prove("(11.13) the damped oscillator",
      simplify(diff(free, t, 2) + 2 * gam * diff(free, t) + (w**2 + gam**2) * free),
      free.subs(t, 0) - x0, diff(free, t).subs(t, 0) - v0)
#< closed
resonant = A_ * t * sin(w * t) / (2 * m * w)
prove("(11.13) resonance without damping",
      simplify(m * diff(resonant, t, 2) + m * w**2 * resonant - A_ * cos(w * t)))

# ---- reference values ----

def rows_of(p, times, route):
    rows = []
    for time in map(mpf, times):
        value = {}

        def both(digits, which):
            if digits not in value:
                value[digits] = route(p, time, digits)
            return mpmath.nstr(value[digits][which], digits)
        x = hexd_real(lambda n: both(n, 0), 20, 10)
        v = hexd_real(lambda n: both(n, 1), 20, 10)
        rows.append([*(hexd(q) for q in p.row[:4]), p.row[4], hexd(p.row[5]),
                     hexd(p.row[6]), p.row[7], *(hexd(q) for q in p.row[8:]),
                     hexd(float(time)), x, v,
                     *size(p, time, float.fromhex(x), float.fromhex(v))])
    return rows


SHORT = [
    (Problem(alpha=0.25, v0=1, rho=0.2), [1e-6, 0.01, 1, 10]),
    (Problem(alpha=0.75, v0=1, rho=0.2), [1e-6, 0.01, 1, 10]),
    (Problem(alpha=0.1, x0=1, v0=0.5, rho=0.2), [1e-4, 0.5, 8]),
    (Problem(alpha=2.0**-1060, x0=1, v0=0.5, rho=0.2), [8]),
    (Problem(alpha=0.45, x0=1, v0=0.5, rho=3), [1e-4, 0.5, 8]),
    (Problem(alpha=0.25, past=CAPUTO, x0=1, v0=0.5, rho=0.2), [1e-4, 3, 15]),
    (Problem(alpha=0.75, past=CAPUTO, x0=1, v0=0.5, rho=0.2), [1e-4, 3, 15]),
    (Problem(alpha=0.95, past=CAPUTO, x0=1, v0=-2, rho=7), [0.1, 5]),
    (Problem(alpha=0.02, past=CAPUTO, x0=1, v0=1, rho=40), [0.01, 0.6]),
    (Problem(alpha=0.5, x0=1, v0=0.5, rho=0.2), [1, 15]),
    (Problem(alpha=0.499, past=CAPUTO, x0=1, v0=0.5, rho=2), [0.01, 2, 9]),
    (Problem(alpha=0.501, x0=0, v0=0.5, rho=2.02), [0.01, 2, 9]),
    (Problem(alpha=0.51, v0=1, rho=50), [0.001, 1, 12]),
    (Problem(alpha=0.3, past=CAPUTO, x0=1, v0=0.1, rho=900), [1e-5, 0.01]),
    (Problem(m=1e-3, c=250, rho=1.5, alpha=0.6, past=CAPUTO, x0=0.1, v0=-3), [1e-5, 0.03]),
    (Problem(m=2e4, c=3e-2, rho=60, alpha=0.35, x0=1, v0=0.001), [1, 9000]),
    (Problem(alpha=0.25, c=0, v0=1, x0=1, rho=0.7), [1e-6, 1, 10]),
    (Problem(alpha=0.8, c=0, v0=1, x0=0, rho=0.7), [1e-6, 1, 1e4]),
    (Problem(alpha=0.3, rho=0.4, forcing=1, A=2, T=1), [0.5, 1, 1.25, 2, 7]),
    (Problem(alpha=0.9, past=CAPUTO, x0=1, v0=1, rho=0.4, forcing=1, A=2, T=3), [2, 3.5, 12]),
    (Problem(alpha=0.4, c=1e-6, rho=1e-3, forcing=1, A=1, T=0.5), [0.25, 0.75, 20]),
    (Problem(alpha=0.3, x0=1, v0=1, rho=0.4, forcing=2, A=2, w=1.5), [1e-3, 1, 9]),
    (Problem(alpha=0.7, rho=0.05, forcing=2, A=1, w=1), [1e-6, 0.1, 3, 14]),
    (Problem(alpha=0.25, rho=2.0**-20, forcing=2, A=1, w=1), [1, 14]),
    (Problem(alpha=0.65, c=0, v0=1, rho=0.3, forcing=2, A=1, w=0.5), [1, 20]),
    (Problem(alpha=0.25, past=HELD, x0=1, v0=0.5, rho=0.2), [3]),
    (Problem(alpha=0.501, past=HELD, x0=1, v0=0.5, rho=2), [1e-4, 2, 9]),
    (Problem(alpha=0.75, past=HELD, x0=1, v0=0.5, rho=0.2), [1e-4, 3, 15]),
    (Problem(alpha=0.97, past=HELD, x0=1, v0=-2, rho=7), [1e-6, 0.1, 5]),
    (Problem(m=2, alpha=0.6, past=HELD, x0=1, v0=1, rho=0.4, forcing=1, A=2, T=3), [2, 12]),
]
LONG = [
    (Problem(alpha=0.25, v0=1, rho=0.2), [100, 1e4]),
    (Problem(alpha=0.4, x0=1, v0=1, rho=2.0**-14), [1e4]),
    (Problem(alpha=0.75, past=CAPUTO, x0=1, v0=1, rho=0.01), [100, 1e4]),
    (Problem(alpha=0.97, v0=1, rho=0.3), [1e4]),
    (Problem(alpha=0.8, past=HELD, x0=1, v0=1, rho=0.02), [100, 1e4]),
    (Problem(alpha=0, x0=1, v0=1, rho=0.3), [1e4]),
    (Problem(alpha=1, v0=1, x0=1, past=CAPUTO, rho=0.3), [1e4]),
    (Problem(alpha=0.5, v0=1, x0=1, rho=2.0**-14), [1e4]),
    (Problem(alpha=0.5, v0=1, x0=1, rho=0, m=3), [1e4]),
    (Problem(alpha=0.5, v0=1, x0=1, rho=0, m=3, forcing=2, A=1, w=0.125), [1e4]),
    (Problem(alpha=0.25, rho=2.0**-20, forcing=2, A=1, w=1), [1e4]),
    (Problem(alpha=0.25, rho=2.0**-12, m=3, forcing=2, A=1, w=0.5773502691896257), [1e4]),
    (Problem(alpha=0.25, rho=2.0**-20, m=3, forcing=2, A=1, w=0.5773502691896257), [1e4]),
]

p = Problem(alpha=0.45, x0=1, v0=0.5, rho=3)  # both routes work for this problem
both = [route(p, mpf(8), 30) for route in (by_talbot, by_cut)]
claim("Talbot's rule and the integral along the cut give the same",
      all(abs(x_ - y_) < mpf(10) ** -28 for x_, y_ in zip(*both)))

header("verify/exact_solution/exact_solution.py")
fields = ("double m, c, rho, alpha; int past; double x0, v0; int forcing; "
          "double A, T, w, t, x, v, size_x, size_v;")
table("ref_solutions", fields,
      [row for p_, times in SHORT for row in rows_of(p_, times, by_talbot)]
      + [row for p_, times in LONG for row in rows_of(p_, times, by_cut)])


def part(p_, which):
    return hexd_real(lambda n: mpmath.nstr([pole(p_, n + 30).real, pole(p_, n + 30).imag][which], n), 25)


POLES = [Problem(alpha=a_, rho=d_, m=m_) for a_, d_, m_ in
         ((0.25, 0.2, 1), (0.75, 0.2, 1), (0.75, 1, 1), (0.1, 30, 0.5), (0.9, 30, 0.5),
          (0.4, 1e5, 1), (0.49, 1.5, 1), (0.51, 1.5, 1), (0.3, 1e-8, 7), (2.0**-30, 0.5, 1))]
table("ref_poles", "double m, rho, alpha, re, im;",
      [[hexd(p_.row[0]), hexd(p_.row[2]), hexd(p_.row[3]), part(p_, 0), part(p_, 1)]
       for p_ in POLES])

#> bagley-torvik
def bagley_torvik(time, digits):
    """Return x of x'' + x + D^(3/2) x = 8 on [0, 1] by (11.14), with complex error functions."""
    mp.dps = digits + 20
    roots = mpmath.polyroots([1, 1, 0, 0, 1], maxsteps=200, extraprec=200)

    def step(time):
        return 1 + sum(mpmath.exp(z * z * time) * mpmath.erfc(-z * mpmath.sqrt(time))
                       / (4 * z**4 + 3 * z**3) for z in roots).real
    time = mpf(time)
    return 8 * (step(time) - (step(time - 1) if time > 1 else 0))
#< bagley-torvik


BT = Problem(alpha=0.75, rho=1, forcing=1, A=8, T=1)
for time in map(mpf, (0.5, 2)):
    claim("(11.14) agrees with Talbot's rule",
          abs(bagley_torvik(time, 30) - by_talbot(BT, time, 30)[0]) < mpf(10) ** -28)
table("ref_bagley_torvik", "double t, x;",
      [[hexd(time), hexd_real(lambda n: mpmath.nstr(bagley_torvik(time, n), n), 25)]
       for time in (0.1, 0.5, 1, 1.5, 2, 3, 4, 5, 8, 10, 15, 20, 30, 100)])
