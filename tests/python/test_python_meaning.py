"""The Python package: one meaning for each argument, whatever the problem; starts of imposed motion; what is said of them."""
import warnings

import fvi
import numpy as np
import pytest

MASSES = fvi.Problem("x1^2 + x2^2 - x1*x2", rho=0.1, alpha=0.3, x0=[1, 0], p0=[0, 0], time=4)
MATRICES = fvi.Problem(M=np.eye(2), K=[[2, -1], [-1, 2]], C=0.1 * np.eye(2), alpha=0.3, x0=[1, 0], time=4)
POINTS = fvi.Problem("x1^2 + x2^2 - x1*x2", dampers=["x1 : power:0.1,0.3", "x2 : power:0.1,0.3"], x0=[1, 0], p0=[0, 0], time=4)
ROD = fvi.Problem(lagrangian="(v1^2+v2^2)/2 - x2", constraints=["x1^2+x2^2-1"], x0=[1, 0], v0=[0, 0], time=4)
T = np.linspace(0, 5, 51)
MOVED = fvi.Problem("(x1-x2)^2 + x2^2/2", impose={"x1": (T, 0.3 * np.sin(2 * T))}, rho=0.1, alpha=0.3, x0=[0, 0],
                    v0=[0.6, 0], time=5)


@pytest.mark.parametrize("problem", [MASSES, MATRICES, POINTS, ROD], ids=["masses", "matrices", "points", "rod"])
def test_steps_are_rows_of_every_problem(problem):
    """Without a method its steps are found, and `steps` says how many rows there are; of a method that is named it says how many
    steps are taken. The steps are right to 1e-10 each: two numbers of rows differ by no more than 1e-8 (seen: 2e-10)."""
    few, many = fvi.solve(problem, steps=8), fvi.solve(problem, steps=40)
    assert len(few.t) == 9 and len(many.t) == 41 and "fvi-adaptive" in few.message and "fvi-adaptive" in many.message
    assert abs(few.x - many.x[::5]).max() < 1e-8
    named = fvi.solve(problem, steps=40, method="fvi-stable")
    assert named.steps == 40 and len(named.t) == 41 and np.array_equal(named.x, fvi.solve(problem, h=0.1, method="fvi-stable").x)


def test_what_cannot_choose_its_steps_says_so():
    with pytest.warns(fvi.FviWarning, match="^40 steps of fvi-stable, as neither h nor error is given"):
        s = fvi.solve(MATRICES.replace(alpha=1), steps=40)
    assert s.steps == 40
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        fvi.solve(MATRICES.replace(alpha=1), h=0.1)


@pytest.mark.parametrize("problem", [MASSES, MATRICES, POINTS, ROD], ids=["masses", "matrices", "points", "rod"])
def test_a_stepper_takes_a_problem(problem):
    s, rows = fvi.Stepper(problem, h=0.1, method="fvi-stable"), fvi.solve(problem, h=0.1, method="fvi-stable")
    s.step(25)
    other = s.copy()
    s.step(15)
    assert s.k == 40 == s.steps and np.array_equal(s.x, rows.x[-1]) and np.array_equal(s.p, rows.p[-1])
    other.step(15)
    assert np.array_equal(other.x, s.x)
    s.reset()
    assert s.k == 0 and np.array_equal(s.x, rows.x[0])
    free = fvi.Stepper(problem)
    while free.k < free.steps:
        free.step()
    assert free.t == 4 and abs(free.x - fvi.solve(problem).x[-1]).max() < 1e-12


@pytest.mark.parametrize("call, what, why", [
    (lambda: fvi.Stepper(ROD, alpha=0.3), ValueError, r"^alpha: the problem says it; problem.replace\(alpha=...\)"),
    (lambda: fvi.Stepper(ROD, derivative="rl"), ValueError, "^derivative: not for a Problem; there are method, h, "),
    (lambda: fvi.Stepper(ROD, h=0.3), ValueError, "^h: 4 is not a whole number of steps of 0.3"),
    (lambda: fvi.Stepper(ROD, metod="fvi"), TypeError, "did you mean 'method'"),
    (lambda: fvi.solve(ROD, method="fvi-lobato4"), ValueError, "^method: 'fvi-lobato4' is none of .* did you mean 'fvi-lobatto4'"),
    (lambda: fvi.Stepper(method="stable"), ValueError, "^method: 'stable' is none of .* did you mean 'fvi-stable'"),
    (lambda: fvi.solve(fvi.Problem(past="hold")), ValueError, "^past: 'hold' is none of .* did you mean 'held'"),
    (lambda: fvi.solve(MOVED.replace(v0=[0.5, 0]), h=0.05), fvi.Error, r"which need v1 = 0.6001\d*, p1 = 0.6001"),
    (lambda: fvi.solve(MOVED.replace(impose="x1=0.3*sin(2*t)", v0=[0.5, 0]), h=0.05), fvi.Error, "p1 is off by -0.1: .* v1 = 0.6, "),
    (lambda: fvi.solve(MOVED.replace(impose={"x1": lambda t: (0.3 * np.sin(2 * t), 0.3 * np.cos(2 * t))}), h=0.05), ValueError,
     "^impose: x1: at t = 0.25.* the function gives the velocity 0.2632.*, and its places change with 0.5265"),
])
def test_what_is_wrong_is_said(call, what, why):
    with pytest.raises(what, match=why):
        call()


def test_rows_that_are_imposed_need_no_more_of_v0_than_they_tell():
    """The cubics begin with 0.60017, and the parabola through three rows with 0.608: 0.6 is as good, and begins the same motion."""
    near = fvi.solve(MOVED, h=0.05)
    same = fvi.solve(MOVED.replace(v0=[0.604, 0]), h=0.05)
    assert np.array_equal(near.x, same.x) and abs(near.x[:, 0] - 0.3 * np.sin(2 * near.t)).max() < 1e-4
    with pytest.raises(fvi.Error) as caught:
        fvi.solve(MOVED.replace(v0=[0.65, 0]), h=0.05)
    assert caught.value.field == "v0"
    with pytest.raises(fvi.Error) as of_stepper:
        fvi.Stepper(MOVED.replace(v0=[0.65, 0]), h=0.05)
    assert of_stepper.value.field == "v0" and str(of_stepper.value) == str(caught.value)
    exact = float(str(caught.value).partition("v1 = ")[2].partition(",")[0])
    assert np.allclose(fvi.solve(MOVED.replace(v0=[exact, 0]), h=0.05).x, near.x, atol=1e-9)


@pytest.mark.parametrize("function", [
    lambda t: (0.3 * np.sin(2 * t), 0.6 * np.cos(2 * t)), lambda t: (abs(t - 2), 1.0 if t > 2 else -1.0),
    lambda t: (1e6 + np.sin(300 * t), 300 * np.cos(300 * t)), lambda t: (0.0, 0.0), lambda t: (np.float64(2), 0)])
def test_a_right_velocity_is_never_refused(function):
    u, rate = function(0.0)
    q = fvi.Problem("(x1-x2)^2", impose={"x1": function}, rho=0.1, alpha=0.3, x0=[u, 0], v0=[rate, 0], time=5)
    assert np.isfinite(fvi.solve(q, h=0.05).x).all()


def test_the_field_of_an_error_is_an_argument_of_the_problem():
    """Without dampers of its own a mechanism is damped by alpha, order or a law."""
    steep = fvi.Problem(constraints=["x1-x2"], x0=[1, 1], p0=[0.5, 0.5], rho=0.2)
    for given, field in (({"alpha": 0.999999}, "alpha"), ({"order": 1.999998}, "order"),
                         ({"rho": None, "damping": "power:0.2,0.999999"}, "damping")):
        with pytest.raises(fvi.Error) as caught:
            fvi.solve(steep.replace(**given), error=1e-9)
        assert caught.value.field == field
    with pytest.raises(fvi.Error) as caught:
        fvi.solve(steep.replace(dampers=["x1 : power:0.2,0.999999"]), error=1e-9)
    assert caught.value.field == "dampers"


def test_what_was_found_is_printed_to_be_read():
    """A line for each name, and no arrays."""
    t, noise = 0.1 * np.arange(1, 201), 0.02 * np.random.default_rng(2).standard_normal(200)
    x = fvi.solve(fvi.Problem(alpha=0.3, rho=0.4, p0=0.25), error=1e-6)(t)[:, 0] + noise
    found = fvi.fit(t, x, "harmonic:1", which="alpha,rho,c", p0=0.25, sigma=0.02)
    lines = repr(found).splitlines()
    low, high = found.interval["alpha"]
    assert lines[0] == f"alpha = {found.estimate['alpha']:.6g}, with 95 % between {low:.6g} and {high:.6g}"
    assert len(lines) == 4 and lines[3].startswith("chi2 = ") and f"{found.agree} starts agree" in lines[3]
    omega = np.geomspace(0.1, 100, 31)
    G = fvi.moduli("spring:2 + power:1.5,0.3", omega) * (1 + 0.01 * np.random.default_rng(1).standard_normal(31))
    material = fvi.fit_moduli(omega, G.real, G.imag, "spring+power")
    lines = str(material).splitlines()
    assert [line.split(" = ")[0].strip() for line in lines[:3]] == list(material.estimate)
    assert lines[3] == f"law {material.law!r}" and lines[4].endswith(f"{material.agree} starts agree")


def test_what_would_be_ignored_or_huge_at_the_start_is_refused():
    """As the program does: a velocity of a coordinate without mass, and a force or a ground that is infinite at t = 0."""
    massless = fvi.Problem("x1^2/2 + (x1-x2)^2/2", mass=[1, 0], rho=0.1, alpha=0.3, x0=[1, 1], v0=[0, 5], time=2)
    with pytest.raises(ValueError, match="v0: v2 is 5: this coordinate has no inertia"):
        fvi.solve(massless, h=0.1, method="fvi-stable")
    assert np.all(np.isfinite(fvi.solve(massless.replace(v0=[1, 0]), h=0.1, method="fvi-stable").x))
    for field, text in (("force", "1/sqrt(t)"), ("ground", "log(t)")):
        problem = fvi.Problem(alpha=0.3, rho=0.2, time=2, **{field: text})
        for how in ({"h": 0.1, "method": "fvi-lobatto4"}, {"error": 1e-6}):
            with pytest.raises(ValueError, match=rf"{field}: .* is infinite at t = 0: fvi-"):
                fvi.solve(problem, **how)
    with pytest.raises(ValueError, match="force: .* is infinite at t = 0"):
        fvi.run(force="1/t", method="fvi-bdf2")
    assert np.all(np.isfinite(fvi.run(force="sin(t)/t", method="fvi-lobatto4").x))


def test_a_force_that_is_not_finite_is_named_with_its_time():
    """As the program and the library do: a text before the run, and a function of the caller's in the step."""
    where = r"force: '1/\(t-1\)' is infinite at t = 1, where fvi.* asks for it"
    problem = fvi.Problem(force="1/(t-1)", time=2)
    for method in ("fvi", "fvi-stable", "fvi-lobatto4"):
        with pytest.raises(ValueError, match=where):
            fvi.run(force="1/(t-1)", method=method)
        with pytest.raises(ValueError, match=where):
            fvi.solve(problem, h=0.1, method=method)
        with pytest.raises(ValueError, match=where):
            fvi.Stepper(problem, h=0.1, method=method)
    with pytest.raises(ValueError, match=where):
        fvi.fit(np.arange(9) / 4, np.cos(np.arange(9) / 4), force="1/(t-1)")
    assert np.all(np.isfinite(fvi.run(force="1/(t-1.05)").x))
    assert np.all(np.isfinite(fvi.solve(problem.replace(time=1.9), h=0.19, method="fvi").x))
    with pytest.raises(fvi.Error, match="the force is infinite at t = 1") as adaptive:
        fvi.solve(problem)
    own = dict(potential="(x1^2+x2^2)/2", x0=[1, 1], p0=[0, 0], force=lambda t: [0, np.nan if t > 0.95 else 0])
    with pytest.raises(fvi.Error, match="the force on coordinate 2 is not a number at t = 1") as by_solve:
        fvi.solve(fvi.Problem(time=2, **own), h=0.1)
    with pytest.raises(fvi.Error, match="the force on coordinate 2 is not a number at t = 1") as by_run:
        fvi.run(**own)
    stepper = fvi.Stepper(fvi.Problem(time=2, **own), h=0.1)
    with pytest.raises(fvi.Error, match="the force on coordinate 2 is not a number at t = 1") as by_step:
        stepper.step(20)
    assert by_solve.value.step == by_run.value.step == by_step.value.step == 10
    assert adaptive.value.code == by_solve.value.code == by_run.value.code == by_step.value.code == 9
    on = fvi.Problem("x1^2/2", force_on="1=1/(t-1)", x0=1, p0=0, time=2)
    with pytest.raises(fvi.Error, match="the force is infinite at t = 1"):
        fvi.solve(on, h=0.1, method="fvi")
