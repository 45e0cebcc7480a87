"""H 27: element matrices from their polynomials, the eigenvalues of a clamped beam, the error of the elements, and a
structure's mode as a single oscillator."""
import functools

from mpmath import cos, cosh, cot, exp, findroot, mp, mpc, mpf, pi
from sympy import Matrix, Rational, cos as c_, diff, eye, integrate, series, sin as s_, symbols

from shared.refgen import claim, header, hexd_real, prove, table

# ---- (27.6): four cubic polynomials; in each, one of w(0), l w'(0), w(l), l w'(l) is 1 and the others are 0
x, l = symbols("x l", positive=True)
t = x / l
shapes = [1 - 3 * t**2 + 2 * t**3, t - 2 * t**2 + t**3, 3 * t**2 - 2 * t**3, t**3 - t**2]
for i, w in enumerate(shapes):
    ends = [w.subs(x, 0), l * diff(w, x).subs(x, 0), w.subs(x, l), l * diff(w, x).subs(x, l)]
    prove("the cubics belong to the ends", *(e - (i == j) for j, e in enumerate(ends)))

bending = Matrix(4, 4, lambda i, j: integrate(diff(shapes[i], x, 2) * diff(shapes[j], x, 2), (x, 0, l)) * l**3)
inertia = Matrix(4, 4, lambda i, j: integrate(shapes[i] * shapes[j], (x, 0, l)) * 420 / l)
prove("bending", *(bending - Matrix([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])))
prove("inertia", *(inertia - Matrix([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])))

# The element's energy is a sum of squares of differences. The code multiplies by the matrix in this form.
w1, s1, w2, s2 = symbols("w1 s1 w2 s2")
k = Matrix([w1, s1, w2, s2])
shear, bend = w1 - w2 + (s1 + s2) / 2, s1 - s2
prove("12 shear^2 + bend^2", (k.T * bending * k)[0] - 12 * shear**2 - bend**2)
prove("the product by differences", *(bending * k - Matrix([12 * shear, 6 * shear + bend, -12 * shear, 6 * shear - bend])))

# ---- (27.7): a wave e^{i q n} of an infinite row of elements: mu = l^4 lambda against q^4
q, m1, m2, m3 = symbols("q m1 m2 m3")


def bloch(A):
    """Return the row of node n: right ends of the element before it, left ends of the element after it. The phase of
    the slope is taken out, so the matrix is real."""
    same = A[2:4, 2:4] + A[0:2, 0:2]
    right = A[0:2, 2:4]  # the force of node n + 1 on node n
    # a[0,1] and a[1,0] have the factors +-i sin q; deflections are even in n, slopes are odd
    return Matrix([[same[0, 0] + 2 * right[0, 0] * c_(q), same[0, 1] + (right[0, 1] - right[1, 0]) * s_(q)],
                   [same[1, 0] + (right[0, 1] - right[1, 0]) * s_(q), same[1, 1] + 2 * right[1, 1] * c_(q)]])


mu = q**4 * (1 + m1 * q**2 + m2 * q**4)
det = series((bloch(bending) - mu / 420 * bloch(inertia)).det(), q, 0, 11).removeO()
prove("an element's wave: order 4, no q^2", det.coeff(q, 4), det.coeff(q, 6).subs({m1: 0}),
      det.coeff(q, 8).subs({m1: 0, m2: Rational(1, 720)}))
claim("and the coefficient is determined", det.coeff(q, 8).diff(m2) != 0 and det.coeff(q, 6).diff(m1) != 0)

# ---- (27.5): a mode of three masses, M and K any matrices, C = rho K + sigma M
rho, sigma, lam = symbols("rho sigma lam")
M, K = Matrix([[2, 1, 0], [1, 2, 1], [0, 1, 2]]), Matrix([[2, -1, 0], [-1, 2, -1], [0, -1, 2]])
v = Matrix([1, 0, -1])  # M v = 2 v, K v = 2 v
prove("K v = lambda M v", *(K * v - M * v))
prove("C v is a number times M v", *((rho * K + sigma * M) * v - (rho + sigma) * M * v))

header("verify/structures/structures.py")


def root(n):
    """Return (beta_n)^4 with cos beta cosh beta = -1."""
    def at(digits):
        mp.dps = digits + 20
        return findroot(lambda b: cos(b) * cosh(b) + 1, (n - Rational(1, 2)) * pi + (Rational(3, 10) if n == 1 else 0))**4
    return at


table("ref_clamped", "double lambda;", [[hexd_real(root(n))] for n in range(1, 4)])


# ---- (27.11): five storeys with three kinds of dampers, by Talbot's inversion of Laplace's transform
# T(s) y = M v0 - K x0 / s,  T = s^2 M + K + sum_j L_j(s) row_j^T row_j,  x = x0 + y
storeys, stiff = 5, 100
x_start = [mpf(i) / 16 for i in (1, 2, 2, 3, 4)]
v_start = [mpf(i) / 4 for i in (1, -2, 0, 1, 3)]
between = {1: lambda s: 5 * s**mpf("0.625"),                                        # x1
           3: lambda s: s**mpf("1.375"),                                            # x3 - x2
           5: lambda s: s / 2 + 3 * s**mpf("0.5") / (1 + 2 * s**mpf("0.5"))}  # x5 - x4


def stretch(n):
    """Return the row of storey n: x_n - x_{n-1}."""
    return [1 if i == n - 1 else -1 if i == n - 2 else 0 for i in range(storeys)]


def response(s, laws, load):
    """Return y of T(s) y = load. Only neighbouring storeys act on each other, so T has three diagonals."""
    k = [stiff + laws.get(n, 0) for n in range(1, storeys + 1)] + [0]
    pivots, y = [], []
    for n in range(storeys):
        ratio = k[n] / pivots[-1] if n else 0
        pivots.append(s * s + k[n] + k[n + 1] - k[n] * ratio)
        y.append(load[n] + (ratio * y[-1] if n else 0))
    for n in reversed(range(storeys)):
        y[n] = (y[n] + (k[n + 1] * y[n + 1] if n + 1 < storeys else 0)) / pivots[n]
    return y


def spring_force(i):
    """Return (K x0)_i."""
    return sum(stiff * row[i] * sum(r * x for r, x in zip(row, x_start)) for row in map(stretch, range(1, storeys + 1)))


@functools.cache
def building(t, digits):
    """Return x, x' and x'' of all storeys, the dampers' forces and their impulses. The contour encloses poles up to
    120 / t."""
    mp.dps = digits + 60
    nodes = 5 * digits + 150
    total, springs = [mpf(0)] * (3 * storeys + 2 * len(between)), [spring_force(i) for i in range(storeys)]
    for n in range(nodes):
        angle = pi * (n + mpf(1) / 2) / nodes
        radius = mpf(2) * nodes / 5 / t
        s = radius * angle * (cot(angle) + mpc(0, 1))
        slope = radius * (cot(angle) - angle / mp.sin(angle)**2 + mpc(0, 1))
        laws, weight = {n: law(s) for n, law in between.items()}, exp(s * t) * slope / nodes
        y = response(s, laws, [v_start[i] - springs[i] / s for i in range(storeys)])
        for i in range(storeys):
            total[i] += (weight * y[i]).imag
            total[storeys + i] += (weight * s * y[i]).imag
            total[2 * storeys + i] += (weight * s * s * y[i]).imag
        for j, (n, law) in enumerate(laws.items()):
            force = law * (y[n - 1] - (y[n - 2] if n > 1 else 0))
            total[3 * storeys + j] += (weight * force).imag
            total[3 * storeys + len(between) + j] += (weight * force / s).imag
    return [x_start[i] + total[i] for i in range(storeys)] + total[storeys:]


times, parts = (mpf(1) / 2, mpf(2), mpf(6)), (range(5), range(5, 10))


def row(t, parts):
    return [float(t).hex()] + ["{ %s }" % ", ".join(hexd_real(lambda d: building(t, d)[i], 25, 10) for i in part)
                               for part in parts]


table("ref_building", "double t, x[5], v[5];", [row(t, parts) for t in times])
table("ref_building_forces", "double t, a[5], force[3], impulse[3];",
      [row(t, (range(10, 15), range(15, 18), range(18, 21))) for t in (mpf(1) / 64, *times)])
