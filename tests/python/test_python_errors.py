"""The Python package: bad input, and what functions of one's own raise."""
import fvi
import numpy as np
import pytest

LAW = ["zener:1,0.3,2", "maxwell:0.5,3", "distributed:0.2,0.1,0.5"]


@pytest.mark.parametrize("potential, let, why", [
    ("harmonic:1", {"k": 2}, "'k' is in no expression"), ("kk*x^2", {"kk": 2, "k": 1}, "'k' is in no expression"),
    ("1e3*x^2", {"e3": 2}, "'e3' is in no expression"), ("x^2", {"x": 2}, "'x' is not a name"),
    ("pi*x^2", {"pi": 3}, "'pi' is not a name"),
])
def test_a_parameter_that_would_be_ignored_is_refused(potential, let, why):
    with pytest.raises(ValueError, match=why):
        fvi.run(potential, let=let)
    assert fvi.run("x^2/2", force="k*t", let={"k": 2}, steps=9).x[9] > fvi.run("x^2/2", steps=9).x[9]


@pytest.mark.parametrize("options, what", [
    (dict(potential="harmonics:1"), ValueError), (dict(potential="harmonic:"), ValueError),
    (dict(potential="duffing:1"), ValueError), (dict(potential="chain:2.5,1,0"), ValueError),
    (dict(potential="chain:3,1,0", x0=[1, 2]), ValueError),
    (dict(potential="harmonic:nan"), ValueError), (dict(potential="harmonic:1_0"), ValueError),
    (dict(potential="harmonic: 1"), ValueError), (dict(potential="duffing:1,1e999"), ValueError),
    (dict(force="cosine:inf,1"), ValueError), (dict(damping="power:1_0,0.3"), ValueError),
    (dict(force="push"), ValueError), (dict(method="rk4"), ValueError),
    (dict(memory="none"), ValueError), (dict(derivative="weyl"), ValueError),
    (dict(columns="t,y"), ValueError), (dict(steps=2.5), ValueError), (dict(steps=0), ValueError),
    (dict(h=0.1, time=20), ValueError), (dict(x0=[1, 2], p0=[1, 2, 3]), ValueError), (dict(x0=[[1, 2]]), ValueError),
    (dict(alpha=1.5), fvi.Error), (dict(alpha=float("nan")), fvi.Error), (dict(h=-1), fvi.Error),
    (dict(mass=0), fvi.Error), (dict(rho=-1), fvi.Error), (dict(x0=float("inf")), fvi.Error),
    (dict(kappa=0.3, method="fvi-lobatto3"), ValueError),
    (dict(derivative="rl", alpha=0.8, method="fvi-shifted"), fvi.Error),
    (dict(alfa=0.3), TypeError), (dict(damping="power:1"), ValueError), (dict(damping="zenr:1,2,3"), ValueError),
    (dict(damping=LAW, alpha=0.3), ValueError), (dict(damping=LAW, rho=0.3), ValueError),
    (dict(damping="power:1,2"), fvi.Error), (dict(damping=[]), fvi.Error), (dict(error=1e-6, h=0.1), ValueError),
    (dict(error=-1), fvi.Error), (dict(steps=float("inf")), ValueError), (dict(steps=float("nan")), ValueError),
])
def test_bad_input_is_named(options, what):
    with pytest.raises(what):
        fvi.run(**options)


@pytest.mark.parametrize("bad", [0, -1, np.nan, np.inf])
@pytest.mark.parametrize("name", ["h", "time"])
@pytest.mark.parametrize("options", [{}, {"method": "fvi-adaptive"}, {"force": "impulse:1,1"}])
def test_a_bad_step_or_time_is_named_as_it_was_given(name, bad, options):
    for call in (fvi.run, fvi.Stepper):
        if call is fvi.Stepper and name == "h" and "method" in options:
            continue  # it takes none
        with pytest.raises(fvi.Error, match=f"^{name} is {bad:g}; ") as caught:
            call(**{name: bad}, **options, **({} if call is fvi.Stepper and "method" in options else {"steps": 3}))
        assert caught.value.field == name and caught.value.code == 1
    if name == "time":
        with pytest.raises(fvi.Error, match=f"^time is {bad:g}; "):
            fvi.run(time=bad, error=1e-6)


def test_what_a_function_raises_comes_out():
    def fails(x):
        raise KeyError("no such spring")

    with pytest.raises(KeyError, match="no such spring"):
        fvi.run(fvi.potential(fails, fails, fails))
    with pytest.raises(ValueError, match="gave 2 numbers"):
        fvi.run(fvi.potential(lambda x: 0, lambda x: [1, 2], lambda x: 1), x0=[1, 2, 3])
    with pytest.raises(ValueError, match="gave 1 numbers, not 4"):  # no matrix is a number
        fvi.run(fvi.potential(lambda x: x @ x / 2, lambda x: x, lambda x: 1.0, quadratic=True), x0=[1, 2])
    band = fvi.potential(lambda x: x @ x / 2, lambda x: x, lambda x: np.eye(2, 3), diagonals=2)
    with pytest.raises(ValueError, match=r"an array \(2, 3\), not \(3, 2\)"):
        fvi.run(band, x0=[1, 2, 3])
    with pytest.raises(TypeError):
        fvi.run(fvi.potential(lambda x: 0, lambda x: [1, 2], lambda x: 1))
    with pytest.raises(ZeroDivisionError):
        fvi.run(force=lambda t: 1 / 0)
    with pytest.raises(KeyboardInterrupt):
        fvi.run(force=lambda t: (_ for _ in ()).throw(KeyboardInterrupt()))
    with pytest.raises(TypeError):
        fvi.potential(1, 2, lambda x: x)
    assert fvi.run(steps=1).x[0] == 1  # and nothing is left of all that


def test_what_a_function_raises_comes_out_of_a_fit():
    """From whichever motion; an interrupt at once. And the next error has its own words."""
    t = np.arange(1, 41) * 0.1
    asked = []

    def beyond(edge, what):
        def gradient(x):
            asked.append(x)
            if abs(x) > edge:
                raise what
            return x
        return fvi.potential(lambda x: x * x / 2, gradient, lambda x: 1.0)

    with pytest.raises(ValueError, match="starts: -1 is no whole number >= 2"):
        fvi.fit(t, np.cos(t), starts=-1)
    for edge in (0.3, 1.2):  # the first of the starts, or one far away
        with pytest.raises(KeyError, match="far"):
            fvi.fit(t, np.cos(t), beyond(edge, KeyError("far")), p0=0, rho=0.1, which="rho,x0,p0", starts=8)
    with pytest.raises(fvi.Error, match="did not converge|no longer finite|stopped being finite"):
        fvi.run("x^2", h=1e200, alpha=0.3, method="fvi-lobatto4")

    def interrupted(x):
        asked.append(x)
        if len(asked) == 500:
            raise KeyboardInterrupt
        return x
    asked.clear()
    with pytest.raises(KeyboardInterrupt):
        fvi.fit(t, np.cos(t), fvi.potential(lambda x: x * x / 2, interrupted, lambda x: 1.0), p0=0, which="rho")
    assert len(asked) == 500


def test_a_start_that_is_refused_says_why():
    with pytest.raises(fvi.Error) as caught:
        fvi.run(alpha=1.5)
    assert caught.value.code == 1 and "alpha" in str(caught.value)


def test_what_is_refused_says_what_to_do():
    """Each of these said less: what was reached and until when, what has no solution, which method takes the law and which not."""
    rl = fvi.Problem(alpha=0.7, past="rl", x0=1, time=5)
    with pytest.raises(fvi.Error, match="no solution for alpha > 1/2, to which no run can be near; fvi runs as printed with h") as caught:
        fvi.solve(rl, error=1e-4, method="fvi")
    assert caught.value.field == "past" and caught.value.code == 1
    law = fvi.Problem(damping="zener:1,0.6,0.5", time=5)
    for q in (law, fvi.Problem(dampers="x : zener:1,0.6,0.5", time=5)):
        with pytest.raises(fvi.Error, match="too near to its cut, .*; without events .*fvi-stable take"):
            fvi.solve(q, events="x : mark")
        with pytest.raises(fvi.Error, match="too near to its cut, or off it, for .*; (fvi-bdf2 and )?fvi-stable take"):
            fvi.solve(q, method="fvi-adaptive")
    L = "v1^2 + v2^2/2 + v1*v2*cos(x1 - x2) + 9.81*(2*cos(x1) + cos(x2))"
    chaotic = fvi.Problem(lagrangian=L, x0=[2, 2.5], v0=[0, 0], time=40)
    for events in ((), "sin(x1) : mark"):
        with pytest.raises(fvi.Error, match="^error: 1e-06 is out of reach") as caught:
            fvi.solve(chaotic, error=1e-6, events=events)
        until = float(str(caught.value).split("until t = ")[1].split(" ")[0].rstrip(",:"))
        assert 5 < until < 40
    assert fvi.solve(chaotic.replace(time=10), error=1e-6).estimate <= 1e-6


def test_a_lagrangian_without_inertia_is_fitted_and_a_method_that_cannot_is_told():
    q = fvi.Problem(lagrangian="v1^2/2-k*(x1-x2)^2/2-x2^2/2", let={"k": 1.5}, dampers="x2 : power:0.5,0.4", x0=[1, 0.5],
                    v0=[0, 0], time=5)
    s = fvi.solve(q, h=0.05, method="fvi-lobatto4d")
    x = s.x[1:41] + np.random.default_rng(1).normal(0, 0.01, (40, 2))
    found = fvi.fit(s.t[1:41], x, q.replace(let={"k": 1.0}), shows=["x1", "x2"], which="k", sigma=0.01)
    low, high = found.interval["k"]
    assert low < 1.5 < high < low + 0.1
    with pytest.raises(fvi.Error, match="^no start gives a motion .*: coordinate 2 has no inertia, .* fvi-lobatto2d to 8d take it"):
        fvi.fit(s.t[1:41], x, q, shows=["x1", "x2"], which="k", sigma=0.01, method="fvi-lobatto4")
