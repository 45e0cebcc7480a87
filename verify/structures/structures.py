"""H 27: element matrices from their polynomials, the eigenvalues of a clamped beam,
what elements add to them, and a structure's mode as one oscillator."""
from mpmath import cos, cosh, findroot, mp, pi
from sympy import Matrix, Rational, cos as c_, diff, eye, integrate, series, sin as s_, symbols

from shared.refgen import claim, header, hexd_real, prove, table

# ---- (27.6): four cubics, each 1 in one of w(0), l w'(0), w(l), l w'(l), and 0 in the others
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

# The element's energy is a sum of squares of differences, which is how it is multiplied.
w1, s1, w2, s2 = symbols("w1 s1 w2 s2")
k = Matrix([w1, s1, w2, s2])
shear, bend = w1 - w2 + (s1 + s2) / 2, s1 - s2
prove("12 shear^2 + bend^2", (k.T * bending * k)[0] - 12 * shear**2 - bend**2)
prove("the product by differences", *(bending * k - Matrix([12 * shear, 6 * shear + bend, -12 * shear, 6 * shear - bend])))

# ---- (27.7): a wave e^{i q n} of an endless row of elements: mu = l^4 lambda against q^4
q, m1, m2, m3 = symbols("q m1 m2 m3")


def bloch(A):
    """The row of node n: right ends of the element before, left ends of the one behind. The
    phase of the slope is taken out, so that the matrix is real."""
    same = A[2:4, 2:4] + A[0:2, 0:2]
    right = A[0:2, 2:4]  # what node n + 1 does to node n
    # a[0,1] and a[1,0] come with +-i sin q; deflections even, slopes odd in n
    return Matrix([[same[0, 0] + 2 * right[0, 0] * c_(q), same[0, 1] + (right[0, 1] - right[1, 0]) * s_(q)],
                   [same[1, 0] + (right[0, 1] - right[1, 0]) * s_(q), same[1, 1] + 2 * right[1, 1] * c_(q)]])


mu = q**4 * (1 + m1 * q**2 + m2 * q**4)
det = series((bloch(bending) - mu / 420 * bloch(inertia)).det(), q, 0, 11).removeO()
prove("an element's wave: order 4, no q^2", det.coeff(q, 4), det.coeff(q, 6).subs({m1: 0}),
      det.coeff(q, 8).subs({m1: 0, m2: Rational(1, 720)}))
claim("and the coefficient is determined", det.coeff(q, 8).diff(m2) != 0 and det.coeff(q, 6).diff(m1) != 0)

# ---- (27.5): a mode of three masses, M and K any, C = rho K + sigma M
rho, sigma, lam = symbols("rho sigma lam")
M, K = Matrix([[2, 1, 0], [1, 2, 1], [0, 1, 2]]), Matrix([[2, -1, 0], [-1, 2, -1], [0, -1, 2]])
v = Matrix([1, 0, -1])  # M v = 2 v, K v = 2 v
prove("K v = lambda M v", *(K * v - M * v))
prove("C v is a number times M v", *((rho * K + sigma * M) * v - (rho + sigma) * M * v))

header("verify/structures/structures.py")


def root(n):
    """(beta_n)^4, cos beta cosh beta = -1."""
    def at(digits):
        mp.dps = digits + 20
        return findroot(lambda b: cos(b) * cosh(b) + 1, (n - Rational(1, 2)) * pi + (Rational(3, 10) if n == 1 else 0))**4
    return at


table("ref_clamped", "double lambda;", [[hexd_real(root(n))] for n in range(1, 4)])
