"""The Python package: gradients of the forces and impulses of dampers, against differences."""
import fvi
import numpy as np
import pytest
from test_python_gradient import F, T_F, TWO, difference


def loss_of(forces=True):
    """A number that knows every position, every impulse and, if asked for, every force."""
    def weights(a, of):
        k, i = np.indices(a.shape)
        return ((3 * k + 5 * i + 4 * of) % 7 - 3) / 8

    def loss(s):
        L, by = (weights(s.x, 2) * np.sin(s.x)).sum(), {"x": weights(s.x, 2) * np.cos(s.x), "impulses": {}}
        for n, (name, I) in enumerate(s.impulses.items()):
            L += (weights(I, n) * I**2).sum() / 2
            by["impulses"][name] = weights(I, n) * I
        if forces:
            by["forces"] = {name: weights(f, 3 + n) for n, (name, f) in enumerate(s.forces.items())}
            L += sum((by["forces"][name] * f).sum() for name, f in s.forces.items())
        return L, by
    return loss


def compare(problem, changes, forces=True, **options):
    """Differences of order 4 of the printed numbers; changes: of each name its value, and the problem of another one."""
    loss = loss_of(forces)
    L, g = fvi.gradient(problem, loss, **options)
    assert L == loss(fvi.solve(problem, **options))[0]
    for name, (at, other, got) in changes.items():
        want = difference(lambda v: loss(fvi.solve(other(v), **options))[0], at, 1e-3)
        assert abs(np.asarray(got(g)) - want).max() <= 1e-7 * max(abs(want).max(), 1), name
    return g


@pytest.mark.parametrize("method", ["fvi", "fvi-shifted", "fvi-bdf2", "fvi-stable", "fvi-lobatto3", "fvi-lobatto4d"])
def test_every_derivative_of_forces_by_differences(method):
    changes = {name: (at, lambda v, name=name: TWO.replace(**{name: v if np.ndim(v) else float(v)}),
                      lambda g, name=name: g[name])
               for name, at in (("x0", TWO.x0), ("p0", TWO.p0), ("mass", TWO.mass), ("rho", TWO.rho), ("alpha", 0.3))}
    changes["force"] = (F, lambda v: TWO.replace(force=(T_F, v)), lambda g: g["force"])
    changes["let"] = ([1.3, 0.7, 0.2], lambda v: TWO.replace(let=dict(zip(TWO.let, v))), lambda g: list(g["let"].values()))
    compare(TWO, changes, h=0.05, method=method)


def test_a_building_has_derivatives_of_the_forces_of_its_dampers():
    K = np.array([[8.0, -4, 0], [-4, 8, -4], [0, -4, 4]])
    laws = [(np.eye(3)[0], "power:{},{}"), (np.eye(3)[2] - np.eye(3)[1], "zener:{},{},{}"), (K / 8, "power:{},{}")]

    def dampers(v):
        v = [repr(float(number)) for number in v]
        return [(of, law.format(*(v.pop(0) for _ in range(law.count("{}"))))) for of, law in laws]
    at = [0.5, 0.3, 0.6, 0.25, 0.4, 0.3, 0.4]
    building = fvi.Problem(M=np.diag([1.0, 1.5, 1]), K=K, dampers=dampers(at), x0=[0.1, -0.2, 0.3], p0=[1, 0, -1], time=1)
    for method in ("fvi", "fvi-stable", "fvi-lobatto3d"):
        compare(building, {"x0": (building.x0, lambda v: building.replace(x0=v), lambda g: g["x0"]),
                           "p0": (building.p0, lambda v: building.replace(p0=v), lambda g: g["p0"]),
                           "M": (1.0, lambda v: building.replace(M=float(v) * np.diag([1.0, 1.5, 1])), lambda g: g["M"]),
                           "laws": (at, lambda v: building.replace(dampers=dampers(v)), lambda g: [
                               number for law in g["laws"] for term in law for number in term.values()])},
                h=0.05, method=method)


def test_a_double_pendulum_has_derivatives_of_the_forces_of_its_dampers():
    L = "m*v1^2 + v2^2/2 + v1*v2*cos(x1 - x2) + g*(2*cos(x1) + cos(x2))"
    dampers = ["elbow=x2 - x1 : power:0.5,0.25", "strut=sqrt(l + x1^2 + x2^2) : zener:0.4,0.3,0.6"]
    arm = fvi.Problem(lagrangian=L, let={"m": 1.0, "g": 9.81, "l": 1.2}, dampers=dampers, x0=[0.8, -0.5], v0=[0.3, -0.2], time=1)
    for method in ("fvi", "fvi-stable", "fvi-lobatto3", "fvi-lobatto2d"):
        compare(arm, {"x0": (arm.x0, lambda v: arm.replace(x0=v), lambda g: g["x0"]),
                      "v0": (arm.v0, lambda v: arm.replace(v0=v), lambda g: g["v0"]),
                      "let": ([1, 9.81, 1.2], lambda v: arm.replace(let=dict(zip(arm.let, v))), lambda g: list(g["let"].values()))},
                h=0.05, method=method)


def test_rows_that_are_chosen_have_derivatives_of_their_forces():
    options = dict(t_eval=[0.1, 0.25, 1.5, 2], h=0.05, method="fvi-lobatto4")
    compare(TWO, {"x0": (TWO.x0, lambda v: TWO.replace(x0=v), lambda g: g["x0"])}, **options)


def test_one_damper_of_two_may_be_named():
    arm = fvi.Problem("chain:2,3,0", dampers=["a=x1 : power:0.5,0.4", "b=x2-x1 : power:0.3,0.2"], x0=[1, 0], p0=0, time=1)
    s = fvi.solve(arm, h=0.1, method="fvi-lobatto4")
    by_b = np.arange(11.0)
    one, two = (fvi.vjp(s, forces=f) for f in ({"b": by_b}, {"b": by_b[:, None], "a": 0.0}))
    assert (one["x0"] == two["x0"]).all()


def test_what_has_no_derivatives_of_forces_is_refused_by_name():
    s = fvi.solve(TWO, error=1e-6)
    with pytest.raises(ValueError, match='^forces: fvi-adaptive has no derivatives .*; solve with h=..., method="fvi-lobatto4"'):
        fvi.vjp(s, forces={"d1": 1.0})
    t = fvi.solve(TWO, h=0.1)
    with pytest.raises(ValueError, match="^impulses: 'd2' is none of the dampers d1"):
        fvi.vjp(t, impulses={"d2": 1.0})
    with pytest.raises(TypeError, match="^forces: 1.0 is no dict of names of dampers"):
        fvi.vjp(t, forces=1.0)
    with pytest.raises(ValueError, match=r"^forces: d1: the shape \(3,\) is not \(21, 2\)"):
        fvi.vjp(t, forces={"d1": [1.0, 2, 3]})
    fast = fvi.solve(fvi.Problem(order=1.4, p0=1, time=5), h=0.1, method="fvi-stable")
    with pytest.raises(ValueError, match="^forces: the forces of rows 1 to 30 come from steps shorter than those of the run"):
        fvi.vjp(fast, forces={"d1": 1.0})
    later = np.r_[np.zeros(31), np.ones(20)]
    fvi.vjp(fast, forces={"d1": later[:, None]})
    mass = fvi.solve(fvi.Problem(alpha=1, time=1), h=0.1)
    with pytest.raises(fvi.Error, match="at alpha = 1 the damping is a mass"):
        fvi.vjp(mass, forces={"d1": 1.0})


def test_the_jacobian_of_forces_is_that_of_each_row():
    """Against differences of order 4 of each force; with several coordinates, rows that are chosen, and a named damper. Seen: 2e-9."""
    arm = fvi.Problem("chain:2,3,0", dampers=["a=x1 : power:0.5,0.4", "b=x2-x1 : zener:0.3,0.2,0.5"], mass=[1.0, 1.5],
                      x0=[1, 0], p0=[0.3, -0.2], time=1)
    for q, damper, options in ((TWO.replace(time=1), "d1", dict(h=0.1, method="fvi-stable")),
                               (TWO.replace(time=1), "d1", dict(t_eval=[0.1, 0.5, 1], h=0.05, method="fvi-lobatto4")),
                               (arm, "b", dict(h=0.1, method="fvi-lobatto3"))):
        s = fvi.solve(q, **options)
        J = fvi.jacobian(s, ["x0", "mass"], forces=damper)
        for name, at in (("x0", q.x0), ("mass", q.mass)):
            for i in range(2):
                far = [fvi.solve(q.replace(**{name: np.asarray(at) + 1e-3 * k * np.eye(2)[i]}), **options).forces[damper] for k in (-2, -1, 1, 2)]
                want = (8 * (far[2] - far[1]) - far[3] + far[0]) / 12e-3
                assert J[name].shape == want.shape + (2,)
                assert abs(J[name][..., i] - want).max() < 1e-8, (damper, name, i)


def test_the_jacobian_of_forces_has_no_first_rows_by_shorter_steps():
    s = fvi.solve(fvi.Problem(order=1.4, p0=1, time=4), h=0.1, method="fvi-stable")
    with pytest.warns(fvi.FviWarning, match="^forces: the derivatives of rows 1 to 30 are NaN"):
        J = fvi.jacobian(s, ["rho", "order"], forces="d1")
    assert np.isnan(J["rho"][1:31]).all() and np.isfinite(J["rho"][31:]).all() and J["order"].shape == (41, 1)
    row = np.zeros((41, 1))
    row[40] = 1
    assert J["rho"][40, 0] == fvi.vjp(s, forces={"d1": row}, wrt="rho")["rho"]
    with pytest.raises(ValueError, match="^forces: 'd2' is none of the dampers d1"):
        fvi.jacobian(s, "rho", forces="d2")
    with pytest.raises(TypeError, match="^forces: .* is no name of a damper"):
        fvi.jacobian(s, "rho", forces=["d1"])
    with pytest.raises(ValueError, match="^forces: fvi-adaptive has no derivatives"):
        fvi.jacobian(fvi.solve(TWO, error=1e-6), "rho", forces="d1")


def test_a_massless_point_has_no_derivative_of_its_force_at_the_start():
    q = fvi.Problem("(x1-x2)^2/2", mass=[1, 0], dampers=["x2 : viscous:0.5"], x0=[1, 0], p0=0, time=2)
    s = fvi.solve(q, h=0.05, method="fvi-lobatto4d")
    assert s.v[0, 1] == pytest.approx(2) and s.forces["d1"][0, 0] == pytest.approx(1)
    first = np.zeros((41, 1))
    first[0] = 1
    with pytest.raises(ValueError, match="^forces: the forces of rows 0 to 21 come from steps shorter"):
        fvi.vjp(s, forces={"d1": first})


def test_first_rows_have_no_derivative_by_a_start_at_0_of_the_past_rl():
    problem = fvi.Problem("harmonic:1", x0=0, rho=0.3, alpha=0.3, past="rl", time=6)
    s = fvi.solve(problem, h=0.1, method="fvi-stable")
    for row, is_known in ((0, False), (1, False), (30, False), (31, True), (60, True)):
        by = np.zeros(s.forces["d1"].shape)
        by[row] = 1
        if is_known:
            other = fvi.solve(problem.replace(x0=1), h=0.1, method="fvi-stable").forces["d1"]
            g = fvi.vjp(s, forces={"d1": by}, wrt=["x0"])
            assert abs(np.sum(g["x0"]) - (other - s.forces["d1"])[row].sum()) < 1e-11
            continue
        with pytest.warns(fvi.FviWarning, match="^x0: no derivative by it: from other starts these forces jump"):
            g = fvi.vjp(s, forces={"d1": by}, wrt=["x0", "p0"])
        assert np.isnan(g["x0"]).all() and np.isfinite(g["p0"]).all()
