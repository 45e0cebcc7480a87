"""The Python package: mechanisms, structures, responses, poles, control."""
import math
import os
import pickle
import subprocess
import sys
import warnings

import fvi
import numpy as np
import pytest

PROGRAM = os.environ.get("FVI", "build/fvi")


def program(*words):
    text = subprocess.run([PROGRAM, *words], check=True, capture_output=True, text=True).stdout
    return np.array([line.split("\t") for line in text.splitlines() if line[0] != "#"], dtype=float)


def table(s):
    return np.column_stack([s.t, s.x, s.p, s.energy])


DOUBLE = "v1^2 + v2^2/2 + v1*v2*cos(x1-x2) + 9.81*(2*cos(x1) + cos(x2))"


@pytest.mark.parametrize("problem, options, words", [
    (dict(lagrangian=DOUBLE, x0=[2, 2], v0=[0, 0.5]), {}, ["--lagrangian", DOUBLE, "--x0", "2,2", "--v0", "0,0.5"]),
    (dict(lagrangian=DOUBLE, x0=[2, 2], p0=0, dampers=["elbow=x2-x1 : zener:0.1,0.3,0.5", "x1 : viscous:0.2 : held"]),
     dict(method="fvi-lobatto3"),
     ["--lagrangian", DOUBLE, "--x0", "2,2", "--p0", "0", "--damper", "elbow=x2-x1 : zener:0.1,0.3,0.5", "--damper",
      "x1 : viscous:0.2 : held", "--method", "fvi-lobatto3"]),
    (dict(potential="k*(x2-x1)^2/2 + x1^4/4", let={"k": 2}, dampers="x2 - x1 : power:0.3,0.3", x0=[1, 0], p0=0),
     dict(method="fvi"), ["--potential", "k*(x2-x1)^2/2 + x1^4/4", "--let", "k=2", "--damper", "x2 - x1 : power:0.3,0.3",
                          "--x0", "1,0", "--p0", "0", "--method", "fvi"]),
    (dict(lagrangian="(v1^2+v2^2)/2 - x2", constraints=["x1^2+x2^2-1"], x0=[1, 0], v0=[0, 0],
          dampers=["x1 : power:0.3,0.25"]), {},
     ["--lagrangian", "(v1^2+v2^2)/2 - x2", "--constraint", "x1^2+x2^2-1", "--damper", "x1 : power:0.3,0.25", "--x0",
      "1,0", "--v0", "0,0"]),
    (dict(potential="(x1-x2)^2/2", impose=["x1=0.3*sin(2*t)"], force_on=["2=-0.1*v2^3"], alpha=0.3, x0=[0, 1],
          p0=[0.6, 0], rho=[0, 0.3]), {},
     ["--potential", "(x1-x2)^2/2", "--impose", "x1=0.3*sin(2*t)", "--force-on", "2=-0.1*v2^3", "--alpha", "0.3",
      "--rho", "0,0.3", "--x0", "0,1", "--p0", "0.6,0"]),
    (dict(potential="(x1-x2)^2/2 + x1^2", mass=[1, 0], rho=[0, 1], alpha=0.25, x0=[1, 1], p0=0), {},
     ["--potential", "(x1-x2)^2/2 + x1^2", "--mass", "1,0", "--rho", "0,1", "--alpha", "0.25", "--x0", "1,1", "--p0",
      "0"]),
])
def test_a_mechanism_has_the_programs_digits(problem, options, words):
    q = fvi.Problem(time=3, **problem)
    assert pickle.loads(pickle.dumps(q)) == q and q.kind == "mechanism"
    s, rows = fvi.solve(q, h=0.05, **options), program("run", "--h", "0.05", "--steps", "60", *words)
    n = 1 + 2 * s.x.shape[1]
    assert np.array_equal(table(s)[:, :n], rows[:, :n])
    assert abs(s.energy - rows[:, n]).max() <= 1e-13 * abs(s.energy).max() or np.isnan(s.energy).any()


def test_an_error_chooses_the_steps_of_a_mechanism():
    """By fvi-adaptive, and the rows, energies and forces of dampers are the program's."""
    q = fvi.Problem(lagrangian=DOUBLE, x0=[2, 2], v0=[0, 0.5], time=2, dampers=["elbow=x2-x1 : power:0.3,0.25"])
    words = ["--lagrangian", DOUBLE, "--x0", "2,2", "--v0", "0,0.5", "--damper", "elbow=x2-x1 : power:0.3,0.25", "--time",
             "2", "--steps", "20"]
    s, rows = fvi.solve(q, error=1e-9, steps=20), program("run", *words, "--error", "1e-9")
    assert np.array_equal(table(s)[:, :5], rows[:, :5]) and s.estimate <= 1e-9
    fine = fvi.solve(q, h=0.001, method="fvi-lobatto4d")
    assert abs(s.x - fine.x[::100]).max() <= 2e-9
    own = fvi.solve(q, steps=20, step_error=1e-9)
    assert "fvi-adaptive" in own.message
    rows = program("run", *words, "--step-error", "1e-9", "--columns", "x,v,elbow.force,elbow.work,balance")
    assert abs(own.v - rows[:, 2:4]).max() <= 1e-12
    assert abs(rows[:, -1] - rows[0, -1]).max() <= 1e-8
    rod = fvi.solve(fvi.Problem(lagrangian="(v1^2+v2^2)/2 - x2", constraints=["x1^2+x2^2-1"], x0=[1, 0], v0=[0, 0],
                                time=1), error=1e-9, steps=4)
    assert "fvi-adaptive" in rod.message and abs((rod.x ** 2).sum(1) - 1).max() < 1e-9


def test_an_inertia_that_vanishes_is_warned_of():
    q = fvi.Problem(lagrangian="v^4/12 - x^2/2", x0=1, v0=1, time=0.6)
    for options in (dict(h=0.01), dict(error=1e-2, steps=60)):
        with pytest.warns(fvi.FviWarning, match="is nearly singular at t = 0.2"):
            fvi.solve(q, **options)


def test_velocities_of_a_lagrangian():
    """p = L_v: of the double pendulum (2 v1 + v2 cos, v2 + v1 cos), solved to 1e-13."""
    s = fvi.solve(fvi.Problem(lagrangian=DOUBLE, x0=[2, 2], v0=[0, 0.5], time=3), h=0.01)
    c = np.cos(s.x[:, 0] - s.x[:, 1])
    assert abs(2 * s.v[:, 0] + s.v[:, 1] * c - s.p[:, 0]).max() < 1e-12
    assert abs(s.v[:, 1] + s.v[:, 0] * c - s.p[:, 1]).max() < 1e-12
    assert s.v[0].tolist() == pytest.approx([0, 0.5])


N = 5
K = 100 * (2 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1))
K[-1, -1] = 100
C = np.diag([5.0, 5, 5, 0, 0])
C[1, 2] = C[2, 1] = -5


def folder(path, **matrices):
    for name, A in matrices.items():
        i, j = np.nonzero(np.tril(A))
        (path / f"{name}.mtx").write_text(
            f"%%MatrixMarket matrix coordinate real symmetric\n{len(A)} {len(A)} {len(i)}\n" + "".join(
                f"{a + 1} {b + 1} {A[a, b]!r}\n" for a, b in zip(i.tolist(), j.tolist())))
    return ["--system", str(path)]


def test_a_structure_has_the_programs_digits(tmp_path):
    q = fvi.Problem(M=np.eye(N), K=K, C=C, alpha=0.3, force="sin(8*t)", time=2)
    words = folder(tmp_path, M=np.eye(N), K=K, C=C)
    s = fvi.solve(q, h=0.01)
    assert np.array_equal(table(s), program("run", *words, "--alpha", "0.3", "--force", "sin(8*t)", "--h", "0.01",
                                            "--steps", "200", "--method", "fvi-stable"))
    again = pickle.loads(pickle.dumps(q))
    assert again == q and np.array_equal(fvi.solve(again, h=0.01).x, s.x)
    assert np.array_equal(s.v, s.p)  # M is the unit matrix
    pushed = fvi.solve(q.replace(force=lambda t: [0, 0, 0, 0, np.sin(8 * t)]), h=0.01)
    assert abs(pushed.x[-1] - s.x[-1]).max() > 1e-4
    loose = fvi.solve(q.replace(dampers=[(C, "power:1,0.3")]), h=0.01)
    assert abs(loose.x - s.x).max() < 1e-12  # the same by a damper: other sums
    row = fvi.solve(q.replace(dampers=[([0, -1, 1, 0, 0], "zener:2,0.3,0.1"), (np.eye(N), "viscous:0.1")]), h=0.01)
    one = np.array([[0, -1.0, 1, 0, 0]])
    same = fvi.solve(q.replace(dampers=[(one.T @ one, "zener:2,0.3,0.1"), (np.eye(N), "viscous:0.1")]), h=0.01)
    assert abs(row.x - same.x).max() < 1e-12


def test_a_structure_takes_high_order(tmp_path):
    """Eight stages have the program's digits, and steps of any length agree with them; what is refused names the matrices."""
    q = fvi.Problem(M=np.eye(N), K=K, dampers=[(C, "power:1,0.3"), ([0, -1, 1, 0, 0], "zener:2,0.3,0.1")],
                    x0=[1, 0, 0, 0, 0], time=2)
    s = fvi.solve(q, h=0.02, method="fvi-lobatto8d")
    words = folder(tmp_path, M=np.eye(N), K=K, C2=C)
    assert np.array_equal(table(s), program("run", *words, "--damper", "C2.mtx : power:1,0.3", "--damper",
                                            "x3-x2 : zener:2,0.3,0.1", "--x0", "1,0,0,0,0", "--h", "0.02", "--steps", "100",
                                            "--method", "fvi-lobatto8d"))
    found = fvi.solve(q, error=1e-9, steps=100)
    assert "fvi-adaptive" in repr(found)
    heavy = q.replace(dampers=[(C, "power:1,1")])  # a damping of order 2 is a mass
    assert "fvi-stable" in repr(fvi.solve(heavy, error=1e-2, steps=100))
    assert abs(found.x - s.x).max() < 1e-9
    fine = fvi.solve(q, steps=100, method="fvi-adaptive")
    assert abs(fine.x - s.x).max() < 1e-8  # each step right to 1e-10
    assert fvi.vjp(s, x=1.0, wrt="K")["K"] == pytest.approx(fvi.jacobian(s, "K")["K"].sum(), rel=1e-12)
    a, b = fvi.vjp(fine, x=1.0), fvi.vjp(s, x=1.0)
    assert set(a) == {"x0", "p0", "M", "K", "dampers"} and set(b) == {*a, "laws"}
    assert all(np.allclose(a[name], b[name], rtol=1e-7, atol=1e-7) for name in a)


def test_matrices_of_scipy_are_taken():
    sparse = pytest.importorskip("scipy.sparse")
    dense = fvi.Problem(M=np.eye(N), K=K, C=C, alpha=0.3, x0=[1, 0, 0, 0, 0], time=2)
    for kind in (sparse.csc_matrix, sparse.csr_matrix, sparse.coo_matrix, sparse.lil_matrix):
        q = dense.replace(M=kind(np.eye(N)), K=kind(K), C=kind(C))
        assert np.array_equal(fvi.solve(q, h=0.01).x, fvi.solve(dense, h=0.01).x) and q == dense
    big = sparse.diags([-np.ones(1999), 2 * np.ones(2000), -np.ones(1999)], [-1, 0, 1])
    frame = sparse.kron(sparse.identity(20), big) + sparse.kron(sparse.diags([1.0] * 19, 1) + sparse.diags([1.0] * 19, -1),
                                                                 -0.1 * sparse.identity(2000))
    s = fvi.solve(fvi.Problem(M=sparse.identity(40000), K=frame, C=0.1 * sparse.identity(40000),
                              alpha=0.3, x0=1, time=1), h=0.1)
    assert np.isfinite(s.x).all()  # factors of CHOLMOD


def test_a_structure_has_a_gradient():
    wx, wp, we = (np.random.default_rng(i).standard_normal((41, N)[:2 if i < 2 else 1]) for i in range(3))
    q = fvi.Problem(M=np.diag([1.0, 2, 1, 1, 1]), K=K, C=C, alpha=0.3, x0=[1, 0, 0, 0, 1], p0=[0, 1, 0, 0, 0], time=2)

    def loss(s):
        return ((wx * s.x).sum() + (wp * s.p).sum() + we @ s.energy, {"x": wx, "p": wp, "energy": we})
    g = fvi.gradient(q, loss, h=0.05)[1]
    for name, A in (("M", np.diag([1.0, 2, 1, 1, 1])), ("K", K), ("C", C)):
        far = [loss(fvi.solve(q.replace(**{name: (1 + k * 1e-3) * A}), h=0.05))[0] for k in (-2, -1, 1, 2)]
        want = (8 * (far[2] - far[1]) - far[3] + far[0]) / 12e-3
        assert abs(g[name] - want) < 1e-7 * max(1, abs(want))
    far = [loss(fvi.solve(q.replace(alpha=0.3 + k * 1e-3), h=0.05))[0] for k in (-2, -1, 1, 2)]
    assert abs(g["alpha"] - (8 * (far[2] - far[1]) - far[3] + far[0]) / 12e-3) < 1e-7 * abs(g["alpha"])
    C2 = np.diag([1.0, 0, 0, 0, 2])
    two = q.replace(dampers=[(C, "power:1,0.3"), (C2, "zener:2,0.3,0.1")])
    g = fvi.vjp(fvi.solve(two, h=0.05), x=wx)
    for i, pair in enumerate((lambda f: [(f * C, "power:1,0.3"), (C2, "zener:2,0.3,0.1")],
                              lambda f: [(C, "power:1,0.3"), (f * C2, "zener:2,0.3,0.1")])):
        far = [(wx * fvi.solve(two.replace(dampers=pair(1 + k * 1e-3)), h=0.05).x).sum() for k in (-2, -1, 1, 2)]
        assert abs(g["dampers"][i] - (8 * (far[2] - far[1]) - far[3] + far[0]) / 12e-3) < 1e-7 * max(1, abs(g["dampers"][i]))
    numbers = [0.3, 0.3, 2, 0.3, 0.1, 1, 0.4, 2, 0.1]  # of three laws

    def laws(v):
        return two.replace(dampers=[(C, "power:1,%.17g" % v[1]), (C2, "zener:%.17g,%.17g,%.17g" % tuple(v[2:5])),
                                    ([1, 0, 0, 0, -1], "maxwell2:%.17g,%.17g,%.17g,%.17g + viscous:0.1" % tuple(v[5:]))])
    g = fvi.vjp(fvi.solve(laws(numbers), h=0.05), x=wx, wrt="laws")["laws"]
    found = [None, g[0][0]["alpha"], *g[1][0].values(), *(g[2][0][name] for name in ("rho1", "alpha1", "rho2", "alpha2"))]
    assert list(g[2][1]) == ["rho", "alpha"] and list(g[1][0]) == ["rho", "alpha", "time"]
    for i in range(1, len(numbers)):
        far = [(wx * fvi.solve(laws([v + k * 1e-3 * (j == i) for j, v in enumerate(numbers)]), h=0.05).x).sum()
               for k in (-2, -1, 1, 2)]
        assert abs(found[i] - (8 * (far[2] - far[1]) - far[3] + far[0]) / 12e-3) < 1e-6 * max(1, abs(found[i]))
    rows = fvi.jacobian(fvi.solve(laws(numbers).replace(time=1.0), h=0.5), ["laws"])["laws"]
    assert rows.shape == (3, 5, 2 + 3 + 4 + 2)
    exchanged = fvi.solve(two.replace(dampers=[([1, 0, 0, 0, -1], "maxwell2:0.4,0.2,0.7,0.4")]), h=0.05)
    sorted_ = fvi.solve(two.replace(dampers=[([1, 0, 0, 0, -1], "maxwell2:0.7,0.4,0.4,0.2")]), h=0.05)
    given, other = (fvi.vjp(s, x=wx, wrt="laws")["laws"][0][0] for s in (exchanged, sorted_))
    for a, b in (("rho1", "rho2"), ("alpha1", "alpha2"), ("rho2", "rho1"), ("alpha2", "alpha1")):
        assert given[a] == other[b] != 0
    assert list(given) == ["rho1", "alpha1", "rho2", "alpha2"]
    assert np.isfinite(fvi.vjp(exchanged, x=wx, wrt="x0")["x0"]).all()


# ---- fits ----

FITTED = [
    (dict(lagrangian="(1.5+x^2)*v^2/2 - c*x^2/2", x0=1, p0=0.5), dict(let={"c": 2}, dampers=["d = x : power:0.4,0.3"]),
     dict(let={"c": 1.5}, dampers=["d = x : power:0.3,0.3"]), {"c": 2, "d.rho": 0.4}),
    (dict(potential="x^2/2", ground="0.5*sin(2*t)", x0=0, p0=0), dict(alpha=0.3, rho=0.4), dict(alpha=0.4, rho=0.3), {"alpha": 0.3, "rho": 0.4}),
    (dict(potential="k*x^2/2", force_on=["1=-0.3*v*abs(v)"], x0=1, p0=0.5), dict(let={"k": 2}, dampers=["d = x : power:0.4,0.3"]),
     dict(let={"k": 1.5}, dampers=["d = x : power:0.3,0.3"]), {"k": 2, "d.rho": 0.4}),
    (dict(potential="k*(x2-x1)^2/2", impose=["x1=0.3*sin(2*t)"], x0=[0, 0.25], p0=[0.6, 0]),
     dict(let={"k": 2}, dampers=["s = x2-x1 : power:0.4,0.3"]), dict(let={"k": 1.5}, dampers=["s = x2-x1 : power:0.3,0.3"]),
     {"k": 2, "s.rho": 0.4}),
    (dict(lagrangian="(v1^2+v2^2)/2 - g*x2", constraints=["(x1^2+x2^2-1)/2"], x0=[1, 0], p0=[0, 0.5]),
     dict(let={"g": 1}, dampers=["s = x1-x2 : power:0.4,0.3"]), dict(let={"g": 1.2}, dampers=["s = x1-x2 : power:0.3,0.3"]),
     {"g": 1, "s.rho": 0.4}),
]


@pytest.mark.parametrize("problem, truth, guess, want", FITTED)
def test_a_fit_takes_what_a_motion_takes(problem, truth, guess, want):
    s = fvi.solve(fvi.Problem(**problem, **truth, time=8), method="fvi-lobatto4", steps=160)
    shows = ["x1", "x2"] if s.x.shape[1] == 2 else None
    data = (s.x if shows else s.x[:, 0]) + 1e-8 * np.random.default_rng(5).normal(size=s.x.shape if shows else len(s.t))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # an offset that would not be seen
        found = fvi.fit(s.t, data, fvi.Problem(**problem, **guess), shows=shows, which=",".join(want), starts=4,
                        method="fvi-lobatto4", h=0.05)
    assert found.estimate == pytest.approx(want, abs=1e-6)


def test_a_parameter_that_begins_like_the_mass_is_fitted():
    problem = dict(potential="mass_k*x^2/2", ground="0.5*sin(t)", x0=1, p0=0)
    s = fvi.solve(fvi.Problem(**problem, let={"mass_k": 2}, time=8), method="fvi-lobatto4", steps=160)
    data = s.x[:, 0] + 1e-8 * np.random.default_rng(5).normal(size=len(s.t))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # an offset that would not be seen
        found = fvi.fit(s.t, data, fvi.Problem(**problem, let={"mass_k": 1.5}), which="mass_k", starts=4, method="fvi-lobatto4", h=0.05)
    assert found.estimate == pytest.approx({"mass_k": 2}, abs=1e-6)


@pytest.mark.parametrize("problem, which, why", [
    (dict(ground="t", x0=0, p0=0), "mass", "the ground pulls"), (dict(ground="t", x0=0, p0=0), "Mass", "the ground pulls"),
    (dict(lagrangian="v^2/2-x^2", x0=1, p0=0), "mass", "of the Lagrangian"),
    (dict(potential="(x2-x1)^2", impose=["x1=sin(t)"], x0=0, p0=[1, 0]), "p0_2", "breaks a constraint"),
    (dict(lagrangian="(v1^2+v2^2)/2", let={"l": 1}, constraints=["x1^2+x2^2-l"], x0=[1, 0], p0=[0, 1]), "l", "breaks a constraint")])
def test_what_would_break_the_start_is_not_fitted(problem, which, why):
    shows = ["x1", "x2"] if "x2" in str(problem) else None
    with pytest.raises(ValueError, match=why):
        fvi.fit([0, 1, 2], np.zeros((3, 2)) if shows else [0, 1, 2], fvi.Problem(**problem), shows=shows, which=which)


# ---- by frequency ----

def test_responses_are_the_programs(tmp_path):
    q = fvi.Problem(M=np.eye(N), K=K, C=C, alpha=0.3)
    words = folder(tmp_path, M=np.eye(N), K=K, C=C) + ["--alpha", "0.3"]
    omega = [1, 7.3, 20]
    for of in ("receptance", "mobility", "accelerance", "ground"):
        H = fvi.response(q, omega, of, at=5, by=4)
        by = [] if of == "ground" else ["--by", "4"]
        rows = program("response", *words, "--omega", "1,7.3,20", "--of", of, "--at", "5", *by)
        assert abs(H - rows[:, 1] - 1j * rows[:, 2]).max() <= 1e-12 * abs(H).max()
    assert abs(fvi.response(q, 7.3, at=5, by=5) - (0.0105922000152764 - 0.002537954736649039j)) < 1e-14
    along = fvi.response(q, omega, "ground", at=2, along=[0, 0, 2, 1, 0])
    rows = program("response", *words, "--omega", "1,7.3,20", "--of", "ground", "--at", "2", "--along", "0,0,2,1,0")
    assert abs(along - rows[:, 1] - 1j * rows[:, 2]).max() <= 1e-12 * abs(along).max()
    assert fvi.response(q, [[1, 2]], hertz=True).shape == (1, 2)
    assert fvi.response(q, 1 / (2 * np.pi), hertz=True) == pytest.approx(fvi.response(q, 1))
    found, rows = fvi.poles(q), program("poles", *words)
    assert found.expected == 5 and abs(found.pole - rows[:, 0] - 1j * rows[:, 1]).max() < 1e-12
    assert abs(found.frequency - rows[:, 2]).max() < 1e-12 and abs(found.damping - rows[:, 3]).max() < 1e-12
    assert found.shape.shape == (5, 5) and found.residual.max() < 1e-14
    assert fvi.poles(q, 2).pole.tolist() == pytest.approx(found.pole[:2].tolist())


def test_exact_motions_are_the_programs(tmp_path):
    q = fvi.Problem("x1^2+(x2-x1)^2", x0=[1, 0], p0=[0, 0.5], force="step:1,1.2",
                    dampers=["a = x2-x1 : power:1,0.5 + zener:2,0.3,1", "x1 : maxwell:1,2"])
    words = ["--potential", "x1^2+(x2-x1)^2", "--x0", "1,0", "--p0", "0,0.5", "--force", "step:1,1.2",
             "--damper", "a = x2-x1 : power:1,0.5 + zener:2,0.3,1", "--damper", "b = x1 : maxwell:1,2", "--h", "0.5", "--steps", "4"]
    rows = program("exact", *words, "--columns", "t,x,v,a,a.force,b.force,a.impulse,b.impulse")
    found = fvi.exact_motion(q, rows[:, 0], 0.5)
    assert abs(np.column_stack(found) - rows[:, 1:]).max() == 0
    structure = fvi.exact_motion(fvi.Problem(M=np.eye(N), K=K, C=C, alpha=0.3, x0=[1, 0, 0, 0, 0], p0=0), [0.25, 2])
    rows = program("exact", *folder(tmp_path, M=np.eye(N), K=K, C=C), "--alpha", "0.3", "--x0", "1,0,0,0,0", "--p0", "0",
                   "--h", "0.25", "--steps", "8", "--columns", "x,a,d1.force")
    assert abs(np.column_stack([structure.x, structure.a, structure.force]) - rows[[1, 8]]).max() < 1e-12
    one = fvi.exact_motion(fvi.Problem(alpha=0.3, force="cosine:0.5,2"), 3)
    x, v = fvi.exact(3, alpha=0.3, force="cosine:0.5,2")
    assert abs(one.x[0, 0] - x) < 1e-12 and abs(one.a + one.x + one.force - 0.5 * np.cos(6)).max() < 1e-14
    for wrong in (dict(force="t"), dict(past="rl", x0=0), dict(ground="t")):
        with pytest.raises(ValueError):
            fvi.exact_motion(fvi.Problem(**wrong), 1)
    like = [fvi.exact_motion(fvi.Problem(damping="zener:1,0.3,2", past=past), 1) for past in ("held", "caputo")]
    assert like[0].x == like[1].x  # no order is above 1
    with pytest.raises(fvi.Error, match="not quadratic"):
        fvi.exact_motion(fvi.Problem("duffing:1,1"), 1)


def test_an_exact_motion_takes_no_steps_and_warns_of_none():
    """Stiff bodies, long times, structures and several dampers, of which a run without a step would warn."""
    bodies = [dict(potential="harmonic:1e6", mass=1e-6), dict(potential="chain:2,400,0", rho=0.1, alpha=0.7),
              dict(dampers=["x : power:1,0.3", "x : viscous:2"]), dict(M=np.eye(N), K=K, C=C, alpha=0.8),
              dict(M=np.eye(N), K=K, dampers=[(C, "power:1,0.3", "held"), (np.eye(N), "viscous:1", "held")])]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for body in bodies:
            fvi.exact_motion(fvi.Problem(**{"p0": 1, "force": "cosine:1,50", "time": 2000, **body}), [0, 1])


def test_a_pendulum_swings_about_a_place():
    """omega^2 = g cos(0) and g cos(1): undamped, to 1e-14."""
    q = fvi.Problem("pendulum:4", rho=0, x0=1)
    assert fvi.poles(q, about=0).pole[0] == pytest.approx(2j, abs=1e-14)
    assert fvi.poles(q).pole[0] == pytest.approx(2j * np.sqrt(np.cos(1)), abs=1e-14)
    assert fvi.response(q, 1, about=0) == pytest.approx(1 / 3)


def test_moduli_are_those_of_the_law():
    """R (i w)^(2a) / (1 + T (i w)^(2a)), the definition."""
    w = np.array([0.01, 1, 100])
    s = (1j * w)**0.5
    assert abs(fvi.moduli("zener:3,0.25,1.5", w) - 3 * s / (1 + 1.5 * s)).max() < 1e-14
    assert abs(fvi.moduli("symbol:k*s^0.5", 4.0, {"k": 2}) - 2 * np.sqrt(4j)) < 1e-14


def test_stability_is_that_of_the_chapter():
    """W/4 = h^2 c/(4 m) of kappa = 1 without damping: 1 at h = 2."""
    q = fvi.Problem(rho=0)
    found = fvi.stability(q, 1.0, "fvi", kappa=1)
    assert found.number == pytest.approx(0.25) and found.longest == pytest.approx(2, rel=1e-12)
    assert fvi.stability(q, 1.0, "fvi-stable").number == 0
    with pytest.raises(fvi.Error):
        fvi.stability(q, 1.0, "fvi-adaptive")
    with pytest.raises(ValueError, match="^h: 0"):
        fvi.stability(q, 0)


def test_the_least_force_ends_there():
    q = fvi.Problem(alpha=0.3, time=5)
    found = fvi.control(q, 0.5, -0.2, steps=100)
    assert found.miss < 1e-12 and found.force.shape == (101, 1) and found.iterations <= 2
    s = fvi.solve(q.replace(force=(found.t, found.force)), steps=100, method="fvi-bdf2")
    assert abs(s.x[-1, 0] - 0.5) < 1e-12 and abs(s.p[-1, 0] + 0.2) < 1e-12
    assert found.cost == pytest.approx(0.025 * (found.force**2).sum())


def test_the_bound_of_the_theorem_holds():
    """x'' + x + 0.2 D^0.6 x = 0 from rest at 1: |x|, |x'|, |x''| <= 1.3 on [0, 5]. It grows with the Lipschitz constant."""
    known = dict(alpha=0.3, time=5, damping=0.2, gradient=1.3, variation=0, start=0, speed=1.3, acceleration=1.6)
    bound = fvi.error_bound(lipschitz=1, **known)
    h = 1 / 512
    assert h < bound.h
    s = fvi.solve(fvi.Problem(alpha=0.3, p0=0, time=5), h=h)
    off = abs(s.x[:, 0] - fvi.exact(s.t, alpha=0.3, v0=0)[0])
    assert (off <= 2 * bound.C * h * np.expm1(bound.rate * s.t) / bound.rate + 1e-12).all() and off.max() > 0
    assert fvi.error_bound(lipschitz=2, **known).rate > bound.rate
    with pytest.raises(fvi.Error):
        fvi.error_bound(lipschitz=-1, **known)


def test_the_bound_of_a_spring_holds_at_all_times():
    """x'' + x + 0.5 D^0.5 x = 0 from rest at 1: three stages with h = 0.1 are never off by 2.35e-6, and are by a fourth of it.
    A force that ends at a node has a bound too, and so have the steps of fvi-adaptive."""
    spring = dict(rho=0.5, alpha=0.25, x0=1, v0=0)
    bound = fvi.spring_bound(0.1, 3, **spring)
    assert bound == fvi.spring_bound([0.1, 0.05], 3, **spring) and 2.33e-6 < bound.x < 2.36e-6
    s = fvi.solve(fvi.Problem(rho=0.5, alpha=0.25, p0=0, time=200), h=0.1, method="fvi-lobatto3d")
    x, v = fvi.exact(s.t, **spring)
    assert bound.x / 4 < abs(s.x[:, 0] - x).max() < bound.x and bound.v / 5 < abs(s.p[:, 0] - v).max() < bound.v
    pushed = fvi.solve(fvi.Problem(rho=0.5, alpha=0.25, p0=0, time=200, force="step:1,8"), h=0.1, method="fvi-lobatto3d")
    off = abs(pushed.x[:, 0] - fvi.exact(pushed.t, force="step:1,8", **spring)[0]).max()
    assert off < fvi.spring_bound(0.1, 3, force="step:1,8", **spring).x < 3 * off + 3e-6
    assert fvi.spring_bound(0.1, 3, memory_error=1e-3, **spring).x == pytest.approx(bound.x + 3.07e-3, rel=0.01)
    for wrong in (dict(stages=9), dict(h=0), dict(h=[]), dict(c=0), dict(alpha=1), dict(derivative="rl"), dict(force="cosine:1,1"),
                  dict(memory_error=-1), dict(alpha=0.75, v0=1), dict(alpha=0.4999, rho=3)):
        with pytest.raises(fvi.Error):
            fvi.spring_bound(**{**dict(h=0.1, stages=3), **spring, **wrong})


def test_the_bound_holds_for_a_held_body_that_starts_fast():
    """x'' + x + 0.5 D^1.5 x = 0 held at 1 with v0 = 1: x'' is infinite at first, x' falls from 1 to -0.28 on [0, 1]."""
    known = dict(alpha=0.75, time=1, damping=0.5, lipschitz=1, gradient=1.4, variation=0, start=1, speed=1)
    bound = fvi.error_bound(velocity_variation=1.28, **known)
    s = fvi.solve(fvi.Problem(alpha=0.75, rho=0.5, x0=1, p0=1, time=1), h=1 / 512)
    off = abs(s.x[:, 0] - fvi.exact(s.t, alpha=0.75, rho=0.5, x0=1, v0=1)[0])
    assert (off <= 2 * bound.C / 512 * np.exp(bound.rate * s.t)).all() and off.max() > 0
    with pytest.raises(ValueError):
        fvi.error_bound(**known)
    with pytest.raises(ValueError):
        fvi.error_bound(acceleration=1, velocity_variation=1, **known)


# ---- wrong ----

@pytest.mark.parametrize("call, what, why", [
    (lambda: fvi.Problem(lagrangian="v^2/2", x0=1), ValueError, "^lagrangian: a start is missing"),
    (lambda: fvi.Problem(lagrangian="v^2/2", x0=1, v0=0, mass=2), ValueError, "^lagrangian: not together with mass"),
    (lambda: fvi.Problem(lagrangian=3, x0=1, v0=0), TypeError, "^lagrangian: 3"),
    (lambda: fvi.Problem(dampers=["x : viscous:1"], rho=1), ValueError, "^dampers: not together with rho"),
    (lambda: fvi.Problem(dampers=[3]), TypeError, "^dampers: 3"), (lambda: fvi.Problem(M=np.eye(2)), ValueError, "^M: M and K"),
    (lambda: fvi.Problem(M=np.eye(2), K=np.eye(2), C=np.eye(2), dampers=[(np.eye(2), "viscous:1")]), ValueError, "^M: "),
    (lambda: fvi.Problem(M=np.eye(2), K=np.ones(3)), ValueError, r"^K: the shape \(3,\)"),
    (lambda: fvi.Problem(M=np.eye(2), K=np.eye(2), dampers=["viscous:1"]), TypeError, "^dampers: 'viscous:1'"),
    (lambda: fvi.solve(fvi.Problem(M=np.eye(2), K=np.eye(3)), h=0.1), fvi.Error, "size"),
    (lambda: fvi.solve(fvi.Problem(M=np.eye(2), K=np.array([[1, 2], [0, 1.0]])), h=0.1), fvi.Error, "^K: .*symmetric"),
    (lambda: fvi.solve(fvi.Problem(M=-np.eye(2), K=np.eye(2)), h=0.1), fvi.Error, "^M: "),
    (lambda: fvi.solve(fvi.Problem(dampers=["x : viscos:1"]), h=0.1), ValueError, "^dampers: .*did you mean viscous"),
    (lambda: fvi.solve(fvi.Problem(dampers=["x : power:1,1"]), method="fvi-adaptive"), fvi.Error, "order 2, which is a mass"),
    (lambda: fvi.response(fvi.Problem(), 0.0), fvi.Error, ""), (lambda: fvi.response(fvi.Problem(), 1, at=2), ValueError, "^at: 2"),
    (lambda: fvi.response(fvi.Problem(), 1, "recptance"), ValueError, "^of: 'recptance'"),
    (lambda: fvi.poles(fvi.Problem(), 2), fvi.Error, ""), (lambda: fvi.moduli("zener:1", 1), ValueError, "^damping"),
])
def test_a_wrong_argument_is_named(call, what, why):
    with pytest.raises(what, match=why):
        call()


def test_the_program_comes_along():
    own = subprocess.run([sys.executable, "-m", "fvi", "run", "--steps", "3"], check=True, capture_output=True, text=True)
    assert own.stdout == subprocess.run([PROGRAM, "run", "--steps", "3"], capture_output=True, text=True).stdout
    bad = subprocess.run([sys.executable, "-m", "fvi", "run", "--alhpa", "1"], capture_output=True, text=True)
    assert bad.returncode == 2 and "alpha" in bad.stderr


def test_the_libraries_of_the_wheel_are_its_own():
    with open("/proc/self/maps") as maps:
        loaded = {line.split()[-1] for line in maps if "/libcholmod" in line or "/libumfpack" in line}
    here = os.path.dirname(os.path.realpath(fvi.__file__))
    assert {os.path.dirname(path) for path in loaded} == {here}


# ---- materials ----

def test_curves_of_a_law_are_their_formulas():
    """Creep of Maxwell's element is F (t + T)/R; relaxation of a spring beside a springpot z (k + rho t^(-2a)/Gamma(1 - 2a))."""
    import math
    t = np.array([0.01, 1, 30])
    assert abs(fvi.creep("maxwell:2,0.5", t, load=3) / (3 * (t + 0.5) / 2) - 1).max() < 1e-11
    want = 0.7 * (2 + 1.5 * t**-0.6 / math.gamma(0.4))
    assert abs(fvi.relaxation("spring:2 + power:1.5,0.3", t, load=0.7) / want - 1).max() < 1e-11
    assert fvi.creep("viscous:2", 3.0) == pytest.approx(1.5)
    with pytest.raises(fvi.Error):
        fvi.creep("viscous:2", -1.0)


@pytest.mark.parametrize("test, law", [("moduli", "spring+zener"), ("creep", "spring+power"), ("relaxation", "spring+zener")])
def test_a_fit_of_a_law_is_the_programs(test, law, tmp_path):
    rng = np.random.default_rng(1)
    true = "spring:1 + zener:3,0.25,1.5" if law == "spring+zener" else "spring:1 + power:2,0.3"
    at = np.geomspace(0.01, 100, 41)
    if test == "moduli":
        G = fvi.moduli(true, at)
        columns = [at, *(part * (1 + 0.01 * rng.standard_normal(41)) for part in (G.real, G.imag))]
        head = "omega\tstorage\tloss"
    else:
        columns = [at, getattr(fvi, test)(true, at) * (1 + 0.01 * rng.standard_normal(41))]
        head = "t\tx" if test == "creep" else "t\tf"
    path = tmp_path / "data.tsv"
    path.write_text(head + "\n" + "".join("\t".join(map(repr, row)) + "\n" for row in np.transpose(columns).tolist()))
    found = getattr(fvi, "fit_" + test)(*columns, law)
    run = subprocess.run([PROGRAM, "fit", "--" + test, "--law", law, str(path)], capture_output=True, text=True)
    rows = {line.split("\t")[0]: [float(w) for w in line.split("\t")[1:]] for line in run.stdout.splitlines() if line[0] != "#"}
    assert list(rows) == list(found.estimate) and not found.grave
    for name in rows:
        assert rows[name] == [found.estimate[name], found.sd[name], *found.interval[name]]
        low, high = found.interval[name]
        assert low - 2 * found.sd[name] < {"k": 1, "time": 1.5, "alpha": 0.25 if "zener" in name else 0.3}.get(
            name.partition(".")[2], 3 if "zener" in name else 2) < high + 2 * found.sd[name]
    assert abs(found.curve / (columns[1] + (1j * columns[2] if test == "moduli" else 0)) - 1).max() < 0.05
    again = fvi.solve(fvi.Problem("free", damping=found.law, x0=0, p0=1, time=1), h=0.1, method="fvi-lobatto3")
    assert np.isfinite(again.x).all()
    for bad, why in ((dict(law="spring+zenr"), "^law: 'zenr'"), (dict(weights="both"), "^weights"), (dict(starts=1), "^starts")):
        with pytest.raises(ValueError, match=why):
            getattr(fvi, "fit_" + test)(*columns, **bad)


def test_what_is_solved_without_a_step_is_right_or_warns():
    """Eigenvalue 2 of both masses, no damping: x = cos(sqrt(2) t)."""
    two = dict(M=np.eye(2), K=2 * np.eye(2), x0=1, p0=0, time=20)
    s = fvi.solve(fvi.Problem(C=np.zeros((2, 2)), **two))
    assert np.abs(s.x - np.cos(math.sqrt(2) * s.t)[:, None]).max() < 1e-8
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        several = fvi.solve(fvi.Problem(dampers=[([1, 0], "power:0,0.3"), ([0, 1], "viscous:1")], **two))
    assert np.abs(several.x[:, 0] - np.cos(math.sqrt(2) * several.t)).max() < 1e-8
    assert np.abs(several.forces["d2"][:, 0] - several.v[:, 1]).max() < 1e-7
    assert np.abs(several.balance - several.energy[0]).max() < 1e-8
    with pytest.warns(fvi.FviWarning, match="200 steps of fvi-stable"):
        fvi.solve(fvi.Problem(dampers=[([1, 0], "power:0,1"), ([0, 1], "power:1,1")], **two))
