"""H 30: responses and poles of linear systems. Prints tests/response/response_ref.h.

  (30.1)  a damper between two points, linear around a place, is grad g grad g^T times its symbol;
  (30.3)  moving ground: both sides of the equation in coordinates relative to it;
  (30.4)  the residue of Z^-1 at a simple pole is v v^T / v^T Z' v;
  (30.6)  Z^-1 is the sum of its residues and an integral along the cut, to 30 digits;
  (30.7)  on which side of the line each symbol is on the cut, and that poles have Re s <= 0;
  (30.8)  three masses, of which one zero of det Z lies beside the pole of a damper, have four zeros with arg s < 3.14;
  (30.9)  v^T Z v is stationary at a shape, so an error of v enters s squared;
  and responses, poles and residues of three systems, from determinants in 40 digits.

All inputs are exact doubles."""
import mpmath
from mpmath import mp, mpc, mpf, matrix
from sympy import I, Matrix, cos, diff, eye, im, re, simplify, sin, symbols

from shared.refgen import claim, header, nearest, prove, table

mp.dps = 40

# ---- (30.1): z = g(x); the force is C(D)(g(x) - g(a)) grad g(x); its linear part in e
e, c, x1, x2, a1, a2, u1, u2 = symbols("e c x1 x2 a1 a2 u1 u2")
g = (x1**2 + x1 * x2) + x2**3
gradient = Matrix([diff(g, x1), diff(g, x2)])
at_a = lambda f: f.subs({x1: a1, x2: a2})
moved = lambda f: f.subs({x1: a1 + e * u1, x2: a2 + e * u2})
force = c * (moved(g) - at_a(g)) * moved(gradient)
linear = force.applyfunc(lambda f: diff(f, e).subs(e, 0))
prove("(30.1)", *(linear - c * at_a(gradient) * at_a(gradient).T * Matrix([u1, u2])))

# ---- (30.3): x = y + g r, and the springs depend on y alone
s, m1, m2, k1, k2, a = symbols("s m1 m2 k1 k2 a")
M, K = Matrix([[m1, 0], [0, m2]]), Matrix([[k1 + k2, -k2], [-k2, k2]])
along = Matrix(symbols("r1 r2"))
Z = s**2 * M + K
y = -Z.inv() * M * along * a                # relative to the ground, whose acceleration is a
absolute = s**2 * y + along * a
whole = s**2 * M * (y + along * a / s**2) + K * y    # M x'' + K (x - g r) = 0
prove("(30.3): the equation", *whole.applyfunc(simplify))
prove("(30.3): r - s^2 H M r", *(absolute - (eye(2) - s**2 * Z.inv() * M) * along * a).applyfunc(simplify))
prove("(30.3): H (Z - s^2 M) r", *(absolute - Z.inv() * (Z - s**2 * M) * along * a).applyfunc(simplify))

# ---- (30.4): Z = (s - p) near a simple zero of a 2 by 2 symmetric matrix
p, z1, z2, z3 = symbols("p z1 z2 z3")
near = Matrix([[1, 2], [2, 4]]) + (s - p) * Matrix([[z1, z2], [z2, z3]])   # v = (2, -1)
v = Matrix([2, -1])
residue = ((s - p) * near.inv()).applyfunc(lambda f: simplify(f).subs(s, p))
prove("(30.4)", *(residue - v * v.T / (v.T * near.diff(s) * v)[0]).applyfunc(simplify))

# ---- (30.9): d(v^T Z v) = 2 dv^T Z v = 0 where Z v = 0
d1, d2 = symbols("d1 d2")
w = v + e * Matrix([d1, d2])
prove("(30.9)", diff((w.T * near.subs(s, p) * w)[0], e).subs(e, 0))

# ---- (30.7): at s = -r + i0 a power of order b has the angle pi b
r, T, phi, theta = symbols("r T phi theta", positive=True)
q = r * (cos(phi) + I * sin(phi))          # s^b, phi = pi b in (0, pi)
prove("(30.7): a fraction q / (1 + T q) is above", im((q * (1 + T * q.conjugate())).expand()).expand() - r * sin(phi))
q2 = theta * (cos(phi / 2) + I * sin(phi / 2))  # two in series: 1 / (1/q + 1/q2)
prove("1/z of what is above is below", im((1 / q).rewrite(cos)).simplify() + sin(phi) / r)
# s / (1 + T s) maps the upper half plane into itself: Im = Im s / |1 + T s|^2
x, h = symbols("x h", positive=True)
z = -x + I * h
prove("Davidson's s / (1 + T s)", im((z * (1 + T * z.conjugate())).expand()).expand() - h)
# s C(s)'s real part: Re(s* (m s^2 + k + C)) = (m |s|^2 + k) Re s + Re(s* C)
sigma, omega, m, k = symbols("sigma omega m k", real=True)
z = sigma + I * omega
prove("no pole with Re s > 0", re((z.conjugate() * (m * z**2 + k)).expand()).expand() - ((m * (sigma**2 + omega**2) + k) * sigma).expand())


# ---- (30.8): on each piece ln det Z, and not its phase alone, changes by less than 0.5, so no turn is lost

def beside_the_pole_of_a_damper(s):
    """Return det Z of a chain x1 - x2 - x3: a power on x1, two Maxwell elements between, a spring of 1.71 on x3."""
    a, b = (1 + mpf(rho) * s / (1 + mpf(time) * s) for rho, time in (("0.0357", "0.797"), ("0.156", "88.2")))
    first, last = s * s + a + mpf("0.813") * s**mpf("1.4"), s * s + b + mpf("1.71")
    return first * (s * s + a + b) * last - first * b * b - last * a * a


def turn(f, p, q, at_p, at_q):
    """Return by how much arg f(exp(u)) changes from u = p to u = q."""
    change = mpmath.log(at_q / at_p)
    if abs(q - p) < 0.02 and abs(change) < 0.5:
        return change.imag
    middle = (p + q) / 2
    between = f(mpmath.exp(middle))
    return turn(f, p, middle, at_p, between) + turn(f, middle, q, between, at_q)


with mpmath.workdps(20):
    corners = [mpc(u, v) for u, v in ((-13, 1.5), (13, 1.5), (13, 3.14), (-13, 3.14), (-13, 1.5))]
    ends = [beside_the_pole_of_a_damper(mpmath.exp(corner)) for corner in corners]
    turns = sum(turn(beside_the_pole_of_a_damper, *ends_of_side)
                for ends_of_side in zip(corners, corners[1:], ends, ends[1:])) / (2 * mpmath.pi)
    claim("(30.8): there are four zeros", abs(turns - 4) < 1e-12)


# ---- systems: (M, K, [(terms, B), ...]); kinds as in damping_laws.h

POWER, ZENER, MAXWELL, DISTRIBUTED, MAXWELL2, DAVIDSON = range(6)


def term(kind, s, rho, alpha, time, end):
    """Return the symbol."""
    L = mpmath.log(s)
    q = mpmath.exp(2 * alpha * L)
    if kind == POWER:
        return rho * q
    if kind == ZENER:
        return rho * q / (1 + time * q)
    if kind == MAXWELL:
        return rho * s / (1 + time * s)
    if kind == DISTRIBUTED:
        return rho * (mpmath.exp(2 * end * L) - q) / (2 * L)
    if kind == MAXWELL2:
        return rho * q / (1 + time * mpmath.exp(2 * (alpha - end) * L))
    return rho * (s / (1 + time * s))**(2 * alpha)


def slope_of_term(kind, s, rho, alpha, time, end):
    """Return the derivative of the symbol with respect to s."""
    if kind in (POWER, ZENER):
        q = s**(2 * alpha)
        return rho * 2 * alpha * q / s / (1 + time * q if kind == ZENER else 1)**2
    if kind == MAXWELL:
        return rho / (1 + time * s)**2
    return mpmath.diff(lambda z: term(kind, z, rho, alpha, time, end), s)


def dynamic_stiffness(system, s):
    """Return Z(s)."""
    M, K, dampers = system
    Z = M * s**2 + K
    for terms, B in dampers:
        Z += B * sum(term(kind, s, *map(mpf, numbers)) for kind, *numbers in terms)
    return Z


def slope_of_stiffness(system, s):
    """Return Z'(s)."""
    M, _, dampers = system
    slope = M * (2 * s)
    for terms, B in dampers:
        slope += B * sum(slope_of_term(kind, s, *map(mpf, numbers)) for kind, *numbers in terms)
    return slope


def inverse(Z):
    """Return Z^-1, by elimination without pivoting: the inertia keeps all pivots away from 0."""
    n = Z.rows
    rows = [row + [mpf(i == j) for j in range(n)] for i, row in enumerate(Z.tolist())]
    for k, top in enumerate(rows):
        top[k:] = [v / top[k] for v in top[k:]]
        for i, row in enumerate(rows):
            if i != k and row[k] != 0:
                row[k:] = [v if w == 0 else v - row[k] * w for v, w in zip(row[k:], top[k:])]
    return matrix([row[n:] for row in rows])


def diagonal(values):
    return mpmath.diag([mpf(v) for v in values])


def shear(values):
    """Return the matrix of springs between storeys, the first one to the ground."""
    n = len(values)
    K = mpmath.zeros(n)
    for i, v in enumerate(values):
        K[i, i] += mpf(v)
        if i:
            K[i - 1, i - 1] += mpf(v)
            K[i, i - 1] -= mpf(v)
            K[i - 1, i] -= mpf(v)
    return K


def row(*values):
    v = matrix([mpf(x) for x in values])
    return v * v.T


half = ("0.3125", 0, 0)
SYSTEMS = {
    # five storeys: springpots of order 5/8 in the first and the third, a dashpot in the fifth
    "storeys": (diagonal([1] * 5), shear([100] * 5),
                [([(POWER, 5, *half)], row(1, 0, 0, 0, 0)), ([(POWER, 5, *half)], row(0, -1, 1, 0, 0)),
                 ([(POWER, "0.5", "0.5", 0, 0)], row(0, 0, 0, -1, 1))]),
    # three masses, every kind of law with orders below 1
    "three": (diagonal([1, 2, "0.5"]), shear([4, 3, 2]),
              [([(ZENER, 1, "0.375", "0.5", 0), (DAVIDSON, "0.5", "0.3125", "0.75", 0)], row(-1, 1, 0)),
               ([(MAXWELL2, "0.75", "0.4375", "0.5", "0.125"), (DISTRIBUTED, "0.5", "0.0625", 0, "0.375")], row(0, -1, 1))]),
    # two masses with orders above 1
    "inertial": (diagonal([1, 1]), shear([2, 3]), [([(POWER, "0.5", "0.8125", 0, 0)], row(1, 0)), ([(POWER, "0.25", "0.625", 0, 0)], row(-1, 1))]),
}


def undamped(system):
    M, K, _ = system
    E, _ = mpmath.eigsy(mpmath.diag([1 / mpmath.sqrt(M[i, i]) for i in range(M.rows)]) * K
                        * mpmath.diag([1 / mpmath.sqrt(M[i, i]) for i in range(M.rows)]))
    return [mpmath.sqrt(v) for v in E]


def poles(system):
    """Return the poles. Each starts from an undamped frequency and follows the damping, multiplied by e = 0.05, 0.1,
    ..., 1, by Newton's method for det Z."""
    M, K, dampers = system
    found = []
    for omega in undamped(system):
        s = mpc(0, omega)
        for step in range(1, 21):
            part = (M, K, [(terms, B * step / mpf(20)) for terms, B in dampers])
            enough = mpf(10)**(-36 if step == 20 else -6)  # on the way a few digits show where to go on
            for _ in range(40):
                H, slope = inverse(dynamic_stiffness(part, s)).tolist(), slope_of_stiffness(part, s).T.tolist()
                ds = 1 / sum(mpmath.fdot(row, column) for row, column in zip(H, slope))
                s -= ds
                if abs(ds) < enough * abs(s):
                    break
            else:
                claim("Newton's method converges", False)
        found.append(s)
    found.sort(key=abs)
    claim("poles are different", all(abs(a - b) > 1e-3 for a, b in zip(found, found[1:])))
    claim("and decay", all(s.real < 0 < s.imag for s in found))
    return found


def residue_at(system, s):
    """Return v v^T with v^T Z' v = 1. v is 1 in one place, and all equations but that one are solved."""
    Z, slope = dynamic_stiffness(system, s), slope_of_stiffness(system, s)
    n = Z.rows
    v = mpmath.lu_solve(dynamic_stiffness(system, s * (1 + mpf(10)**-9)), matrix([mpc(1)] * n))
    one = max(range(n), key=lambda i: abs(v[i]))
    rest = [i for i in range(n) if i != one]
    others = mpmath.lu_solve(matrix([[Z[i, j] for j in rest] for i in rest]), matrix([-Z[i, one] for i in rest]))
    v[one] = mpc(1)
    for i, value in zip(rest, others):
        v[i] = value
    claim("it is a shape", mpmath.norm(Z * v) < mpf(10)**-33 * mpmath.mnorm(Z, 1))
    return v * v.T / (v.T * slope * v)[0]


def cut(system, s, i, j):
    """Return (1/pi) int_0^inf Im Z(-r)^-1 dr / (s + r), by ln r. Davidson's symbol is infinite at r = 1/T = 4/3, so
    the interval is divided there."""
    def integrand(u):
        r = mpmath.exp(u)
        return inverse(dynamic_stiffness(system, mpc(-r, 0)))[i, j].imag * r / (s + r)
    with mpmath.workdps(20):
        ends = [-60, -20, -8, -4, -2, -1, 0, mpmath.log(mpf(4) / 3), 1, 2, 3, 4, 5, 8, 20, 60]
        return mpmath.quad(integrand, ends, maxdegree=6) / mp.pi


header("verify/response/response.py")
responses, grounds, roots, residues = [], [], [], []
for number, (name, system) in enumerate(SYSTEMS.items()):
    n = system[0].rows
    for omega in ("0.25", "1.5", "7.3125"):
        H = inverse(dynamic_stiffness(system, mpc(0, mpf(omega))))
        ground = 1 + mpf(omega)**2 * (H * system[0] * matrix([1] * n))[n - 1]
        for what, value in ((0, H[n - 1, 0]), (1, mpc(0, mpf(omega)) * H[n - 1, 0]),
                            (2, -mpf(omega)**2 * H[n - 1, 0]), (3, ground)):
            responses.append([number, what, omega, nearest(value.real), nearest(value.imag)])
    for omega in ("0.0078125", "65536"):  # exact binary numbers
        T = inverse(dynamic_stiffness(system, mpc(0, mpf(omega)))) * system[0] * matrix([1] * n) * mpf(omega)**2
        grounds.append([number, omega, nearest(1 + T[0].real), nearest(T[0].imag)])
    found = poles(system)
    claim("as many as unknowns", len(found) == n)
    for s in found:
        R = residue_at(system, s)
        roots.append([number, nearest(s.real), nearest(s.imag), nearest(R[n - 1, 0].real), nearest(R[n - 1, 0].imag)])
    s = mpc(0, mpf("7.3125"))
    modes = sum(R / (s - p) + mpmath.conj(R) / (s - mpmath.conj(p))
                for p in found for R in [residue_at(system, p)[n - 1, n - 1]])
    H = inverse(dynamic_stiffness(system, s))[n - 1, n - 1]
    branch = cut(system, s, n - 1, n - 1)
    claim(f"(30.6) of {name}: {mpmath.nstr(abs(modes - branch - H) / abs(H), 3)}", abs(modes - branch - H) < mpf(10)**-14 * abs(H))
    residues.append([number, nearest(modes.real), nearest(modes.imag), nearest(H.real), nearest(H.imag),
                     f"modes alone are off by {mpmath.nstr(abs(branch) / abs(H), 3)}"])

print("\n/* unknown d by unknown 1: system, kind (receptance, mobility, accelerance, ground), omega, value */", end="")
table("responses", "int system, kind; double omega, re, im;", responses)
print("\n/* unknown 1 by the ground: system, omega, value */", end="")
table("grounds", "int system; double omega, re, im;", grounds)
print("\n/* poles, and their residues between unknowns d and 1 */", end="")
table("roots", "int system; double re, im, residue_re, residue_im;", roots)
print("\n/* (30.6) at s = 7.3125 i between d and d: the poles' part, and all */", end="")
table("parts", "int system; double modes_re, modes_im, re, im;", residues)
