"""The Python package: gradients against differences of order 4, and torch."""
import os
import subprocess

import fvi
import numpy as np
import pytest

PROGRAM = os.environ.get("FVI", "build/fvi")
RNG = np.random.default_rng(0)
T_F, F = np.linspace(0, 2, 11), RNG.standard_normal((11, 2))
TWO = fvi.Problem("k1*x1^2/2 + k2*(x2-x1)^2/2 + b*(x2-x1)^4", let={"k1": 1.3, "k2": 0.7, "b": 0.2}, mass=[1, 2],
                  rho=[0.3, 0.5], alpha=0.3, x0=[1, -0.5], p0=[0.2, 0.1], force=(T_F, F), time=2)
WX, WP, WE = RNG.standard_normal((41, 2)), RNG.standard_normal((41, 2)), RNG.standard_normal(41)


def loss(s):
    """A number that knows every row, and its derivatives."""
    wx, wp, we = WX[:len(s.t), :s.x.shape[1]], WP[:len(s.t), :s.x.shape[1]], WE[:len(s.t)]
    return ((wx * np.sin(s.x)).sum() + (wp * s.p**2).sum() + we @ s.energy,
            {"x": wx * np.cos(s.x), "p": 2 * wp * s.p, "energy": we})


def difference(value, at, step):
    """Central, of order 4; an error of 1e-13 |loss| / step is what is left."""
    at = np.asarray(at, float)
    found = np.zeros(at.shape)
    for i in np.ndindex(at.shape):
        e = np.zeros(at.shape)
        e[i] = step
        found[i] = (8 * (value(at + e) - value(at - e)) - value(at + 2 * e) + value(at - 2 * e)) / (12 * step)
    return found


def compare(problem, options, fields, within, step=1e-3):
    def value(**changes):
        return loss(fvi.solve(problem.replace(**changes), **options))[0]
    L, g = fvi.gradient(problem, loss, **options)
    assert L == value()
    for name, given in fields.items():
        if name == "let":
            want = difference(lambda v: value(let=dict(zip(given, v))), list(given.values()), step)
            got = np.array([g["let"][k] for k in given])
        else:
            as_given = (lambda v: float(v)) if np.ndim(given) == 0 else (lambda v: v)
            want = difference((lambda v: value(force=(T_F, v))) if name == "force" else
                              lambda v: value(**{name: as_given(v)}), given, step)
            got = g[name]
        assert np.shape(got) == np.shape(want)
        assert abs(got - want).max() <= within * max(abs(want).max(), 1), (name, got, want)
    return g


FIELDS = {"x0": TWO.x0, "p0": TWO.p0, "mass": TWO.mass, "rho": TWO.rho, "alpha": 0.3, "let": TWO.let, "force": F}


@pytest.mark.parametrize("method", ["fvi", "fvi-shifted", "fvi-bdf2", "fvi-stable", "fvi-lobatto2", "fvi-lobatto3",
                                    "fvi-lobatto4", "fvi-lobatto3d", "fvi-lobatto4d"])
def test_every_derivative_by_differences(method):
    """Of every x_k, p_k and E_k. Seen: 3e-9 of the largest, of the differences."""
    compare(TWO, dict(h=0.05, method=method), FIELDS, 1e-7)


def test_a_derivative_by_a_start_beside_which_there_is_no_motion_is_warned_of():
    """With the past rl above the order 1 x0 is 0; with such a law fvi-adaptive begins at rest. The mass has its derivative."""
    rl = fvi.solve(fvi.Problem(past="rl", x0=0, alpha=0.7, time=2), h=0.1, method="fvi-stable")
    with pytest.warns(fvi.FviWarning, match="^x0: no derivative by it: other starts have no solution"):
        assert np.isnan(fvi.vjp(rl, x=1.0, wrt="x0")["x0"])
    damper = fvi.solve(fvi.Problem(dampers="x : power:1,0.7 : rl", x0=0, time=2), h=0.1, method="fvi-stable")
    with pytest.warns(fvi.FviWarning, match="^x0: no derivative by it: other starts have no solution"):
        by = fvi.vjp(damper, x=1.0)
    assert np.isnan(by["x0"]) and np.isfinite(by["p0"])
    for start in ("p0", "v0"):
        s = fvi.solve(fvi.Problem(damping="power:1,0.7 + viscous:1", time=2, **{start: 0}))
        with pytest.warns(fvi.FviWarning) as said:
            by = fvi.vjp(s, x=1.0)
        assert [str(each.message).split(": ")[0] for each in said] == ["damping", start]
        assert by["damping"] is None and np.isnan(by[start]) and np.isfinite(by["mass"]) and np.isfinite(by["x0"])
        for call in (lambda: fvi.vjp(s, x=1.0, wrt="damping"), lambda: fvi.jacobian(s, "damping")):
            with pytest.raises(ValueError, match="^damping: no derivative by it: fvi-adaptive has only that by the factor"):
                call()
    pair = fvi.solve(fvi.Problem(damping="maxwell2:1,0.4,2,0.3", time=2))
    with pytest.warns(fvi.FviWarning, match="^damping: no derivative by it"):
        assert fvi.vjp(pair, x=1.0)["damping"] is None


@pytest.mark.parametrize("past, alpha", [("caputo", 0.7), ("rl", 0.3), ("held", 0.7), ("held", 0.5)])
def test_the_pasts_have_derivatives(past, alpha):
    for method in ("fvi", "fvi-stable", "fvi-lobatto3"):
        fields = {**FIELDS, "alpha": alpha}
        del fields["let"], fields["force"]
        if alpha == 0.5:
            del fields["alpha"]
        compare(TWO.replace(past=past, alpha=alpha), dict(h=0.05, method=method), fields, 1e-7)


def test_steps_of_any_length_have_derivatives():
    """On its own steps a run errs by 1e-12, which is 1e-9 of a quotient; p by more. Seen: 2e-8."""
    g = compare(TWO, dict(steps=40, step_error=1e-13), {**FIELDS, "let": TWO.let}, 1e-6)
    other = fvi.gradient(TWO, loss, h=0.05, method="fvi-lobatto8")[1]
    assert abs(g["alpha"] - other["alpha"]) < 1e-6


def test_an_error_has_a_gradient_as_fine():
    exact = fvi.gradient(TWO, loss, h=0.05, method="fvi-lobatto8")[1]
    for options, within in ((dict(error=1e-8, steps=40), 1e-5), (dict(error=1e-4, steps=40, method="fvi-bdf2"), 1e-2)):
        g = fvi.gradient(TWO, loss, **options)[1]
        assert abs(g["alpha"] - exact["alpha"]) < within * abs(exact["alpha"])
        assert abs(g["x0"] - exact["x0"]).max() < within * abs(exact["x0"]).max()


def test_rows_of_ones_own_have_a_gradient():
    for options in (dict(h=0.05, method="fvi-lobatto4"), dict(step_error=1e-13)):
        options["t_eval"] = [0.1, 0.25, 1.5, 2]
        fields = {k: FIELDS[k] for k in ("x0", "alpha", "let")}
        compare(TWO, options, fields, 1e-6)
    with pytest.raises(ValueError, match="no common step"):
        fvi.vjp(fvi.solve(TWO, [0.1, np.sqrt(2)]), x=1)


def test_the_other_names_of_a_start_and_of_an_order():
    q = fvi.Problem("duffing:1,0.5", order=0.6, v0=0.4, mass=2, rho=0.3, time=2)
    g = compare(q, dict(h=0.05, method="fvi-lobatto3"), {"v0": 0.4, "mass": 2.0, "order": 0.6, "rho": 0.3, "x0": 1.0}, 1e-7)
    assert set(g) == {"v0", "mass", "order", "rho", "x0", "potential"}
    want = [difference(lambda v: loss(fvi.solve(q.replace(potential=f"duffing:{float(v[0])!r},{float(v[1])!r}"), h=0.05,
                                                method="fvi-lobatto3"))[0], [1, 0.5], 1e-3)]
    assert abs(g["potential"] - want).max() < 1e-7


def test_one_number_for_all_has_one_derivative():
    q = fvi.Problem("chain:3,1,0.2", x0=[1, 0, 0], p0=0, mass=2, rho=[0.3], alpha=0.3, time=2)
    each = q.replace(mass=[2, 2, 2], rho=[0.3] * 3, p0=[0, 0, 0])
    a, b = (fvi.vjp(fvi.solve(p, h=0.1), x=1) for p in (q, each))
    assert a["mass"] == b["mass"].sum() and a["p0"] == b["p0"].sum() and a["rho"].shape == (1,)


def test_a_law_has_derivatives_by_its_numbers():
    terms = "zener:{},{},{} + power:{},{} + maxwell:{},{} + distributed:{},{},{} + havriliak:{},{},{},{}"
    at = [0.4, 0.3, 1.5, 0.2, 0.15, 0.1, 0.7, 0.2, 0.1, 0.4, 0.3, 0.3, 1.2, 0.7]
    q = TWO.replace(damping=terms.format(*at))
    for method in ("fvi", "fvi-bdf2", "fvi-lobatto4"):
        options = dict(h=0.05, method=method)
        g = fvi.gradient(q, loss, **options)[1]["damping"]
        got = np.array([v for term in g for v in term.values()])
        want = difference(lambda v: loss(fvi.solve(q.replace(damping=terms.format(*map(repr, v.tolist()))), **options))[0],
                          at, 5e-4)
        assert abs(got - want).max() <= 1e-7 * abs(want).max()
        assert list(g[0]) == ["rho", "alpha", "time"] and list(g[3]) == ["rho", "alpha", "end"]
        assert list(g[4]) == ["rho", "alpha", "time", "beta"]
    one = fvi.vjp(fvi.solve(TWO.replace(damping="zener:0.4,0.3,1.5"), steps=20), x=1, wrt=["damping"])
    assert list(one["damping"][0]) == ["rho"]


def test_a_name_in_the_force_has_a_derivative():
    q = fvi.Problem("k*x^2/2", let={"k": 1.3, "a": 0.4}, force="a*k*cos(t)", alpha=0.3, time=2)
    for method in ("fvi", "fvi-lobatto4"):
        compare(q, dict(h=0.05, method=method), {"let": q.let}, 1e-7)
    with pytest.raises(ValueError, match="between the rows"):
        fvi.vjp(fvi.solve(q), x=1)


def test_the_program_has_the_same_gradient():
    s = fvi.solve(fvi.Problem("duffing:1,0.5", alpha=0.3, rho=0.4), h=0.1, method="fvi-bdf2")
    g = fvi.vjp(s, energy=np.append(np.zeros(200), 1))
    text = subprocess.run([PROGRAM, "gradient", "--of", "energy", "--potential", "duffing:1,0.5", "--alpha", "0.3",
                           "--rho", "0.4", "--method", "fvi-bdf2"], check=True, capture_output=True, text=True).stdout
    rows = {line.split("\t")[0]: float(line.split("\t")[1]) for line in text.splitlines() if line[0] != "#"}
    for name, got in (("x0", g["x0"]), ("p0", g["p0"]), ("mass", g["mass"]), ("rho", g["rho"]), ("alpha", g["alpha"]),
                      ("c", g["potential"][0]), ("g", g["potential"][1])):
        assert abs(got - rows[name]) <= 1e-13 * max(abs(rows[name]), 1)  # the order of a few sums


def rows_of(s, name):
    """The derivatives of every x by adjoint runs, one for each."""
    found = []
    for one in np.eye(s.x.size):
        g = fvi.vjp(s, x=one.reshape(s.x.shape), wrt=[name])[name]
        found.append(list(g.values()) if isinstance(g, dict) else [v for term in g for v in term.values()]
                     if isinstance(g, list) else g)
    return np.array(found).reshape(*s.x.shape, -1)


M, K = np.array([[2.0, 0.5], [0.5, 1.0]]), np.array([[20.0, -10], [-10, 10]])


@pytest.mark.parametrize("method", ["fvi", "fvi-shifted", "fvi-bdf2", "fvi-stable", "fvi-lobatto3", "fvi-lobatto4d"])
def test_the_jacobian_goes_beside_the_run(method):
    """Of chains with a law, and of structures, as adjoint runs have it: to rounding of some 100 steps. Seen: 3e-14."""
    options = dict(h=0.1, method=method)
    problems = [(TWO, ["x0", "p0", "mass", "rho", "alpha", "let"])]
    if method != "fvi-shifted":
        problems.append((TWO.replace(damping="zener:0.4,0.3,1.5 + power:0.2,0.4"), ["x0", "mass", "damping"]))
    if method != "fvi-lobatto3":  # form M takes no matrices
        problems.append((fvi.Problem(M=M, K=K, C=K / 50, order=0.6, x0=[1, 0.3], time=2), ["x0", "order", "M", "K", "C"]))
    for q, names in problems:
        s = fvi.solve(q, **options)
        J = fvi.jacobian(s, names)
        for name in names:
            want = rows_of(s, name)
            assert abs(J[name].reshape(want.shape) - want).max() <= 1e-12 * abs(want).max(), name


@pytest.mark.parametrize("method", ["fvi-stable", "fvi-lobatto3d", "fvi-lobatto4d"])
def test_the_jacobian_of_several_dampers(method):
    """Against differences of order 4. Seen: 6e-10."""
    def of(x0=(1.0, 0.3), r=0.6, a=0.35, T=0.5, m=1.0, k=1.0):
        return fvi.solve(fvi.Problem(M=m * M, K=k * K, dampers=[(K / 50, f"power:{r!r},0.7"), ([-1.0, 1.0], f"zener:0.4,{a!r},{T!r}")],
                                     x0=x0, p0=[0.2, -0.1], time=2), h=0.1, method=method)
    J = fvi.jacobian(of(), ["x0", "laws", "M", "K", "dampers"])
    for got, name, at in ((J["laws"][..., 0], "r", 0.6), (J["laws"][..., 3], "a", 0.35), (J["laws"][..., 4], "T", 0.5),
                          (J["M"], "m", 1.0), (J["K"], "k", 1.0), (J["dampers"][..., 0] / 0.6, "r", 0.6)):
        far = [of(**{name: at + i * 1e-3}).x for i in (-2, -1, 1, 2)]
        assert abs(got - (8 * (far[2] - far[1]) - far[3] + far[0]) / 12e-3).max() < 1e-8, name
    assert abs(J["x0"][..., 0] - (of(x0=(2.0, 0.3)).x - of().x)).max() < 1e-12


def test_the_jacobian_is_that_of_each_row():
    q = fvi.Problem("duffing:1,0.5", alpha=0.3, rho=0.4, time=2)
    names = ["alpha", "rho", "x0", "p0", "mass"]
    for options in (dict(h=0.1), dict(h=0.1, method="fvi-lobatto3"), dict(h=0.1, t_eval=[0.5, 2])):
        s = fvi.solve(q, **options)
        J = fvi.jacobian(s, names)
        for name in names:
            at = {"x0": 1.0, "mass": 1.0, "p0": 0.5}.get(name) or getattr(q, name)
            e = 1e-4
            far = [fvi.solve(q.replace(**{name: at + k * e}), **options).x for k in (-2, -1, 1, 2)]
            assert J[name].shape == s.x.shape
            assert abs(J[name] - (8 * (far[2] - far[1]) - far[3] + far[0]) / (12 * e)).max() < 1e-8
    J = fvi.jacobian(fvi.solve(TWO, [1, 2], h=0.05), ["mass", "let"])
    assert np.allclose(J["let"], rows_of(fvi.solve(TWO, [1, 2], h=0.05), "let"), rtol=1e-12, atol=1e-12)
    assert J["mass"].shape == (2, 2, 2) and J["let"].shape == (2, 2, 3)
    free = fvi.solve(fvi.Problem("free", alpha=0.3, time=1), steps=4, method="fvi-stable")
    assert fvi.jacobian(free, ["potential"])["potential"].shape == (5, 1, 0)  # it has no constants


@pytest.mark.parametrize("call, what, why", [
    (lambda s: fvi.vjp(3), TypeError, "^solution: 3"), (lambda s: fvi.vjp(s, y=1), TypeError, "^vjp: .*'y'"),
    (lambda s: fvi.vjp(s, x=np.zeros(7)), ValueError, r"^x: the shape \(7,\) is not \(41, 2\)"),
    (lambda s: fvi.vjp(s, energy="a"), TypeError, "^energy"), (lambda s: fvi.vjp(s, wrt=["gamma"]), ValueError, "^wrt: 'gamma'"),
    (lambda s: fvi.vjp(s, wrt=["order"]), ValueError, "^wrt: this problem has no order"),
    (lambda s: fvi.gradient(TWO, lambda s: (1, 2), h=0.1), TypeError, "^loss"),
    (lambda s: fvi.vjp(fvi.solve(TWO.replace(alpha=0.5), h=0.02, method="euler-explicit"), x=1), fvi.Error, "no adjoint"),
    (lambda s: fvi.vjp(fvi.solve(TWO.replace(alpha=1), h=0.05, method="fvi-lobatto3"), x=1), fvi.Error, "alpha = 1"),
    (lambda s: fvi.vjp(fvi.solve(fvi.Problem(damping="symbol:k*s", let={"k": 1}), h=0.1), x=1), ValueError, "^let: a law"),
])
def test_what_has_no_gradient_says_so(call, what, why):
    with pytest.raises(what, match=why):
        call(fvi.solve(TWO, h=0.05))


def test_functions_of_ones_own_have_a_gradient():
    own = fvi.potential(lambda x: x**4 / 4, lambda x: x**3, lambda x: 3 * x * x)
    q, text = (fvi.Problem(U, alpha=0.3, time=2) for U in (own, "x^4/4"))
    a, b = (fvi.vjp(fvi.solve(p, h=0.1), x=1, p=1) for p in (q, text))
    assert abs(a["alpha"] - b["alpha"]) < 1e-13 and set(a) == {"x0", "p0", "mass", "rho", "alpha"}


def test_a_motion_is_fitted_with_gradients():
    """Truth 0.3, 0.4, 1 and noise of 0.02: the estimates are within four of fit's deviations."""
    optimize = pytest.importorskip("scipy.optimize")
    q = fvi.Problem("k*x^2/2", let={"k": 1}, alpha=0.3, rho=0.4, p0=0.25)
    data = fvi.solve(q, h=0.1, method="fvi-lobatto4").x + 0.02 * np.random.default_rng(2).standard_normal((201, 1))

    def value(u):
        def misfit(s):
            return ((s.x - data)**2).sum(), {"x": 2 * (s.x - data)}
        L, g = fvi.gradient(q.replace(alpha=u[0], rho=u[1], let={"k": u[2]}), misfit, h=0.1, method="fvi-lobatto4")
        return L, [g["alpha"], g["rho"], g["let"]["k"]]
    found = optimize.minimize(value, [0.5, 0.2, 2], jac=True, method="L-BFGS-B", bounds=[(0.01, 0.99), (0, 9), (0, 9)])
    assert abs(found.x - [0.3, 0.4, 1]).max() < 0.02


def test_torch_agrees_with_differences():
    torch = pytest.importorskip("torch")
    import importlib
    motions = importlib.import_module("fvi.torch")

    def D(value):
        return torch.tensor(value, dtype=torch.float64, requires_grad=True)
    q = TWO.replace(force=(np.linspace(0, 1, 6), np.zeros((6, 2))), time=1)
    at = {"x0": D([1.0, -0.5]), "p0": D([0.2, 0.1]), "mass": D([1.0, 2.0]), "rho": D([0.3, 0.5]), "alpha": D(0.3),
          "k1": D(1.3), "b": D(0.2), "force": D(RNG.standard_normal((6, 2)))}
    for method in ("fvi", "fvi-stable", "fvi-lobatto4", "fvi-lobatto3d"):
        assert torch.autograd.gradcheck(lambda *a: motions.solve(q, dict(zip(at, a)), h=0.1, method=method),
                                        tuple(at.values()), eps=1e-6, atol=1e-7)
    assert torch.autograd.gradcheck(lambda *a: motions.solve(q, dict(zip(at, a)), forces=["d1"], h=0.1, method="fvi-stable")[2]["d1"],
                                    tuple(at.values()), eps=1e-6, atol=1e-6)
    x, p = motions.solve(q, {"rho": torch.tensor(0.3, requires_grad=True)}, h=0.1)
    (x.sum() + p[0].sum()).backward()
    assert x.dtype == torch.float64
    single = torch.tensor(0.3, requires_grad=True)  # in float32
    motions.solve(q, {"alpha": single}, h=0.1)[0].sum().backward()
    assert single.grad.dtype == torch.float32 and single.grad != 0
    with pytest.raises(ValueError, match="^tensors: 'gamma'"):
        motions.solve(q, {"gamma": D(1.0)})


def test_torch_trains_a_network_as_a_force():
    torch = pytest.importorskip("torch")
    import importlib
    motions = importlib.import_module("fvi.torch")
    torch.manual_seed(0)
    t = np.linspace(0, 20, 101)
    q = fvi.Problem(alpha=0.3, rho=0.4, force=(t, 0.5 * np.sin(1.7 * t)))
    target = torch.from_numpy(fvi.solve(q, h=0.2, method="fvi-lobatto3").x)
    net = torch.nn.Sequential(torch.nn.Linear(1, 16), torch.nn.Tanh(), torch.nn.Linear(16, 1)).double()
    optimiser, losses = torch.optim.Adam(net.parameters(), lr=0.02), []
    for _ in range(100):
        optimiser.zero_grad()
        x, _p = motions.solve(q, {"force": net(torch.from_numpy(t)[:, None])[:, 0]}, h=0.2, method="fvi-lobatto3")
        loss_now = ((x - target)**2).mean()
        loss_now.backward()
        optimiser.step()
        losses.append(loss_now.item())
    assert losses[-1] < losses[0] / 2


def test_an_energy_without_inertia_has_no_derivative_by_that_mass():
    light = fvi.Problem("x1^2/2 + (x2-x1)^2", mass=[1, 0], dampers=["x2 : power:0.5,0.3"], x0=[1, 0.5], p0=0, time=2)

    def energy(x1):
        return fvi.solve(light.replace(x0=[x1, 0.5]), method="fvi-lobatto4d", steps=40).energy[-1]
    with pytest.warns(fvi.FviWarning, match="^mass: no derivative of an energy by a mass of 0"):
        g = fvi.vjp(fvi.solve(light, method="fvi-lobatto4d", steps=40), energy=np.append(np.zeros(40), 1))
    assert abs(g["x0"][0] - (energy(1.001) - energy(0.999)) / 0.002) < 1e-8  # E is quadratic in the start
    assert np.isfinite(g["mass"][0]) and np.isnan(g["mass"][1])
