"""The Python package: gradients of Lagrangians, dampers between points, constraints, and of a ground that moves."""
import fvi
import numpy as np
import pytest

ARM = fvi.Problem(lagrangian="m*v1^2/2 + v2^2/2 + 0.3*v1*v2*cos(x1 - x2) - k*x1^2/2 - x2^4/4", let={"m": 1.5, "k": 2},
                  dampers=["elbow=x2 - x1 : power:0.5,0.25", "x1*x2 : zener:0.4,0.3,0.5"], x0=[1, 0.5], v0=[0.2, -0.3], time=2)
OWN = fvi.Problem("k*x1^2/2 + (x2 - x1)^4/4", let={"k": 2}, rho=[0.4, 0.7], alpha=0.3, mass=[1, 2], x0=[1, 0.5], p0=[0.3, 0],
                  force_on=["1=-0.1*v1^3"], time=2)
LINK = fvi.Problem("k*(x2 - x1)^2/2", let={"k": 2}, mass=[1, 2, 1.5], rho=0.5, alpha=0.3, constraints="x3 - x2^2", time=2,
                   x0=[0.2, 0.5, 0.25], v0=[0.1, 0.2, 0.2], force=(np.linspace(0, 2, 6), np.array([0, 1, -1, 2, 0, 1.0])))


def differences(of, at, step=1e-3):
    far = [of(at + k * step) for k in (-2, -1, 1, 2)]
    return (8 * (far[2] - far[1]) - far[3] + far[0]) / (12 * step)


def loss(s):
    """Of every position, momentum and energy."""
    wx, wp = np.sin(np.arange(s.x.size)).reshape(s.x.shape), np.cos(np.arange(s.x.size)).reshape(s.x.shape) / 3
    we = np.sin(np.arange(len(s.t))) / 2
    return (wx * s.x).sum() + (wp * s.p).sum() + we @ s.energy, {"x": wx, "p": wp, "energy": we}


def close(got, want):
    return abs(got - want) < 2e-7 * max(1, abs(want))


def each(value, i, v):
    """The array with v at place i."""
    a = np.array(value, dtype=float)
    a[i] = v
    return a


@pytest.mark.parametrize("options", [dict(h=0.05), dict(h=0.05, method="fvi-lobatto3"), dict(h=0.05, method="fvi")])
def test_a_lagrangian_has_a_gradient(options):
    g = fvi.gradient(ARM, loss, **options)[1]
    assert set(g) == {"x0", "v0", "let", "dampers", "laws"}

    def of(**fields):
        return loss(fvi.solve(ARM.replace(**fields), **options))[0]
    for name in ("x0", "v0"):
        for i in range(2):
            start = getattr(ARM, name)
            assert close(g[name][i], differences(lambda v: of(**{name: each(start, i, v)}), start[i]))
    for name, value in ARM.let.items():
        assert close(g["let"][name], differences(lambda v: of(let={**ARM.let, name: v}), value))

    def dampers(a=0.25, r=0.4, f=1.0):
        return [f"elbow=x2 - x1 : power:{0.5 * f!r},{a!r}", f"x1*x2 : zener:{r!r},0.3,0.5"]
    assert close(g["dampers"][0], differences(lambda f: of(dampers=dampers(f=f)), 1))
    assert close(g["laws"][0][0]["alpha"], differences(lambda a: of(dampers=dampers(a=a)), 0.25))
    assert close(g["laws"][1][0]["rho"], differences(lambda r: of(dampers=dampers(r=r)), 0.4))


@pytest.mark.parametrize("q, names", [(ARM, {"x0", "v0", "let", "dampers"}), (OWN.replace(let={"k": 2}), {"x0", "p0", "mass", "rho", "let"})])
def test_steps_of_any_length_have_the_gradient_of_short_ones(q, names):
    """Of the places of all rows, by fvi-adaptive and by form D."""
    s, r = fvi.solve(q, step_error=1e-11, steps=40), fvi.solve(q, h=0.05, method="fvi-lobatto8d")
    wx = np.sin(np.arange(s.x.size)).reshape(s.x.shape)
    g, want = fvi.vjp(s, x=wx), fvi.vjp(r, x=wx, wrt=sorted(names))
    assert set(g) == names
    for name in names - {"let"}:
        assert abs(np.asarray(g[name]) - np.asarray(want[name])).max() < 1e-8
    for name in q.let:
        assert abs(g["let"][name] - want["let"][name]) < 1e-8


def test_a_start_by_momentum_is_not_one_by_velocity():
    q = ARM.replace(p0=[0.3, -0.1])
    g = fvi.vjp(fvi.solve(q, h=0.05), x=1, wrt=["x0", "p0"])
    for name in ("x0", "p0"):
        for i in range(2):
            start = getattr(q, name)
            assert close(g[name][i], differences(lambda v: fvi.solve(q.replace(**{name: each(start, i, v)}), h=0.05).x.sum(), start[i]))


@pytest.mark.parametrize("options", [dict(h=0.05), dict(h=0.05, method="fvi-lobatto4")])
def test_masses_with_forces_of_velocity_have_a_gradient(options):
    g = fvi.gradient(OWN, loss, **options)[1]
    assert set(g) == {"x0", "p0", "mass", "rho", "alpha", "let"}

    def of(**fields):
        return loss(fvi.solve(OWN.replace(**fields), **options))[0]
    for name in ("x0", "p0", "mass", "rho"):
        for i in range(2):
            start = getattr(OWN, name)
            assert close(g[name][i], differences(lambda v: of(**{name: each(start, i, v)}), start[i]))
    assert close(g["alpha"], differences(lambda v: of(alpha=v), 0.3))
    assert close(g["let"]["k"], differences(lambda v: of(let={"k": v}), 2))


def test_constraints_have_a_gradient():
    s = fvi.solve(LINK, h=0.05)
    g = fvi.vjp(s, x=np.sin(np.arange(s.x.size)).reshape(s.x.shape))

    def of(**fields):
        s = fvi.solve(LINK.replace(**fields), h=0.05)
        return (np.sin(np.arange(s.x.size)).reshape(s.x.shape) * s.x).sum()
    assert close(g["rho"], differences(lambda v: of(rho=v), 0.5))
    assert close(g["alpha"], differences(lambda v: of(alpha=v), 0.3))
    assert close(g["let"]["k"], differences(lambda v: of(let={"k": v}), 2))
    t, F = LINK.force
    for j in range(6):
        assert close(g["force"][j], differences(lambda v: of(force=(t, each(F, j, v))), F[j]))


@pytest.mark.parametrize("options", [dict(h=0.05), dict(h=0.05, method="fvi-lobatto4")])
def test_a_ground_has_a_gradient(options):
    q = fvi.Problem("k*x1^2/2 + k*(x2-x1)^2/2", let={"k": 10, "A": 1.3}, rho=[0.5, 0.2], mass=[1, 2], order=0.6, x0=0, p0=0,
                    time=2, ground="A*sin(8*t)", along=[1, 0.5], force="A*t")
    g = fvi.gradient(q, loss, **options)[1]

    def of(**fields):
        return loss(fvi.solve(q.replace(**fields), **options))[0]
    for i in range(2):
        assert close(g["mass"][i], differences(lambda v: of(mass=each(q.mass, i, v)), q.mass[i]))
    for name, value in q.let.items():
        assert close(g["let"][name], differences(lambda v: of(let={**q.let, name: v}), value))


def test_the_matrix_of_masses_on_a_ground_has_a_factor():
    M, K = np.array([[2.0, 0.5], [0.5, 1.0]]), np.array([[20.0, -10], [-10, 10]])
    q = fvi.Problem(M=M, K=K, C=K / 50, order=0.6, time=2, ground="sin(3*t)", along=[1, 0.5])
    g = fvi.vjp(fvi.solve(q, h=0.05), x=1, wrt=["M"])
    assert close(g["M"], differences(lambda f: fvi.solve(q.replace(M=f * M), h=0.05).x.sum(), 1))


@pytest.mark.parametrize("method", ["fvi", "fvi-stable", "fvi-lobatto3", "fvi-lobatto4d"])
def test_several_powers_of_the_past_rl_are_as_many_dampers(method):
    """A sum of powers is stretched at once, and each of them pulls. As dampers of their own they give the same numbers, to
    rounding (seen: 2e-14), and differences agree."""
    def of(dampers, x0=(0.6, -0.3)):
        return fvi.Problem("x1^2/2 + (x2-x1)^2 + x2^4/4", dampers=dampers, x0=x0, p0=[0.2, 0.1], time=2)
    options, each = dict(h=0.05, method=method), ["power:0.5,0.2", "viscous:0.4", "power:0.3,0.1"]
    one, many = [f"x2 - 0.5*x1^2 : {' + '.join(each)} : rl"], [f"x2 - 0.5*x1^2 : {law} : rl" for law in each]
    a, b = (fvi.gradient(of(dampers), loss, **options)[1] for dampers in (one, many))
    for name in ("x0", "p0", "mass"):
        assert np.allclose(a[name], b[name], rtol=1e-12, atol=1e-12)
    for i in range(3):
        assert a["laws"][0][i] == pytest.approx(b["laws"][i][0], rel=1e-11, abs=1e-12)
    assert close(a["x0"][1], differences(lambda v: loss(fvi.solve(of(one, (0.6, v)), **options))[0], -0.3))
    law = "x2 - 0.5*x1^2 : power:0.5,{!r} + viscous:0.4 + power:0.3,0.1 : rl"
    assert close(a["laws"][0][0]["alpha"], differences(lambda v: loss(fvi.solve(of([law.format(v)]), **options))[0], 0.2))


@pytest.mark.parametrize("method", ["fvi", "fvi-bdf2", "fvi-stable", "fvi-lobatto2d", "fvi-lobatto3d", "fvi-lobatto8d"])
def test_every_momentum_of_a_structure_with_several_dampers_is_in_the_loss(method):
    """x, p and E of every row. Seen: 3e-11 of the differences."""
    M, K = np.array([[2.0, 0.5], [0.5, 1.0]]), np.array([[20.0, -10], [-10, 10]])

    def of(x0=(1.0, 0.3), p0=(0.2, -0.1), r=0.6, a=0.35, f=1.0):
        return fvi.Problem(M=M, K=f * K, dampers=[(K / 50, f"power:{r!r},0.2"), ([-1.0, 1.0], f"zener:0.4,{a!r},0.5")],
                           x0=x0, p0=p0, time=2)
    options = dict(h=0.05, method=method)
    g = fvi.gradient(of(), loss, **options)[1]
    for i in range(2):
        assert close(g["x0"][i], differences(lambda v: loss(fvi.solve(of(x0=each([1, 0.3], i, v)), **options))[0], [1, 0.3][i]))
        assert close(g["p0"][i], differences(lambda v: loss(fvi.solve(of(p0=each([0.2, -0.1], i, v)), **options))[0], [0.2, -0.1][i]))
    assert close(g["laws"][0][0]["rho"], differences(lambda r: loss(fvi.solve(of(r=r), **options))[0], 0.6))
    assert close(g["laws"][1][0]["alpha"], differences(lambda a: loss(fvi.solve(of(a=a), **options))[0], 0.35))
    assert close(g["K"], differences(lambda f: loss(fvi.solve(of(f=f), **options))[0], 1.0))


@pytest.mark.parametrize("call, what, why", [
    (lambda: fvi.vjp(fvi.solve(ARM, h=0.1), x=1, wrt=["mass"]), ValueError, "^wrt: this problem has no mass"),
    (lambda: fvi.vjp(fvi.solve(ARM.replace(dampers=["x1 : symbol:k*s^0.5"]), h=0.1), x=1), ValueError, "^let: a law that is an expression"),
    (lambda: fvi.vjp(fvi.solve(ARM, step_error=1e-6), x=1, wrt=["laws"]), ValueError, "^wrt: this problem has no laws"),
    (lambda: fvi.vjp(fvi.solve(ARM, step_error=1e-6), x=1, p=1), fvi.Error, "."),
    (lambda: fvi.vjp(fvi.solve(fvi.Problem(ground="sin(t)"), step_error=1e-6), x=1, wrt=["mass"]), ValueError, "no mass"),
])
def test_what_has_no_gradient_says_so(call, what, why):
    with pytest.raises(what, match=why):
        call()


NAMED = fvi.Problem("k*x1^2/2 + (x2 - x1)^2/2", let={"k": 1.1, "a": 0.7, "b": 0.3, "w": 1.3, "c": 0.5}, mass=[1, 2, 1.5],
                    dampers=["x2 - a*x1^2 : power:0.5,0.3"], force_on="2=-b*v2^3", constraints="x3 - c*x2^2", impose="x1=sin(w*t)/w",
                    x0=[0, 0, 0], v0=[1, 0, 0], time=2)


@pytest.mark.parametrize("options", [dict(h=0.05), dict(h=0.05, method="fvi-lobatto3")])
def test_names_within_a_mechanism_have_derivatives(options):
    """In an elongation, a force of velocity, a constraint and an imposed motion, of all rows, momenta and energies."""
    g = fvi.gradient(NAMED, loss, wrt="let", **options)[1]["let"]
    for name, value in NAMED.let.items():
        want = differences(lambda v: loss(fvi.solve(NAMED.replace(let={**NAMED.let, name: v}), **options))[0], value)
        assert close(g[name], want), name
    assert list(g) == list(NAMED.let)


def test_a_name_to_which_the_start_is_tied_has_none():
    """The others have; and it is said."""
    tied = NAMED.replace(x0=[0, 1, 0.5], impose=(), v0=[0, 0, 0], let={"k": 1.1, "a": 0.7, "b": 0.3, "c": 0.5})
    s = fvi.solve(tied, h=0.05)
    with pytest.warns(fvi.FviWarning, match="^let: no derivative by c: it stands in a constraint"):
        g = fvi.vjp(s, x=1.0, wrt="let")["let"]
    assert np.isnan(g["c"]) and all(np.isfinite(g[name]) for name in "kab")
    assert close(g["a"], differences(lambda v: fvi.solve(tied.replace(let={**tied.let, "a": v}), h=0.05).x.sum(), 0.7))
