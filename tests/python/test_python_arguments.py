"""The Python package: what cannot be meant is refused by the name of its argument, and nothing is ignored."""
import fvi
import numpy as np
import pytest

Q = fvi.Problem("duffing:1,0.5", alpha=0.3, rho=0.4, x0=1, p0=0.5, time=2)
S = fvi.solve(Q, h=0.1)
BALL = fvi.Problem("9.81*x", rho=0.05, alpha=0.3, x0=1, p0=0, time=1)
T = np.linspace(0.1, 2, 20)
nan = float("nan")


def raises(call, what, why):
    with pytest.raises(what, match=why):
        call()


# A value that no argument of its kind can take, for every function that has such an argument.
NUMBERS = {"None": None, "a text": "0.1", "True": True, "a dict": {}, "an object": object(), "a complex": 1j, "bytes": b"1"}
OF_NUMBERS = {
    "h": lambda v: fvi.solve(Q, h=v), "steps": lambda v: fvi.solve(Q, steps=v), "error": lambda v: fvi.solve(Q, error=v),
    "step_error": lambda v: fvi.solve(Q, step_error=v), "longest": lambda v: fvi.solve(Q, longest=v),
    "most_steps": lambda v: fvi.solve(Q, most_steps=v), "kappa": lambda v: fvi.solve(Q, h=0.1, kappa=v),
    "tolerance": lambda v: fvi.solve(Q, tolerance=v), "t_eval": lambda v: fvi.solve(Q, t_eval=v),
    "time": lambda v: fvi.Problem(time=v), "alpha": lambda v: fvi.Problem(alpha=v), "order": lambda v: fvi.Problem(order=v),
    "mass": lambda v: fvi.Problem(mass=v), "rho": lambda v: fvi.Problem(rho=v), "x0": lambda v: fvi.Problem(x0=v),
    "p0": lambda v: fvi.Problem(p0=v), "v0": lambda v: fvi.Problem(v0=v), "jobs": lambda v: fvi.sweep(Q, {"alpha": [0.1]}, jobs=v),
    "omega": lambda v: fvi.moduli("viscous:1", v), "t": lambda v: S(v), "count": lambda v: fvi.weights(0.5, v),
}


@pytest.mark.parametrize("name", OF_NUMBERS)
@pytest.mark.parametrize("kind", NUMBERS)
def test_what_is_no_number_is_refused(name, kind):
    if NUMBERS[kind] is None and name not in ("time", "tolerance", "mass", "omega", "t", "count"):
        return  # what is not given
    with pytest.raises(TypeError, match=f"^{name}: "):
        OF_NUMBERS[name](NUMBERS[kind])


@pytest.mark.parametrize("name", ["h", "steps", "error", "step_error", "longest", "most_steps", "time", "jobs"])
@pytest.mark.parametrize("value", [0, -1, nan, float("inf")])
def test_what_is_not_above_0_is_refused(name, value):
    with pytest.raises((ValueError, fvi.Error), match=f"^{name}: "):
        found = OF_NUMBERS[name](value)
        fvi.solve(found)  # of a Problem


@pytest.mark.parametrize("call, what, why", [
    # steps that are not taken
    (lambda: fvi.Stepper(method="fvi-adaptive", h=0.1), ValueError, "^h: fvi-adaptive chooses its steps itself"),
    (lambda: fvi.Stepper(method="fvi-adaptive", steps=9), ValueError, "^steps: fvi-adaptive chooses its steps itself"),
    (lambda: fvi.solve(Q, [1, 2], steps=50), ValueError, "^steps: not together with t_eval"),
    (lambda: fvi.solve(Q, [1, 2], steps=50, error=1e-6, method="fvi-bdf2"), ValueError, "^steps: not together with t_eval"),
    (lambda: fvi.solve(Q, nan), fvi.Error, r"^t_eval: t\[0\] is nan"), (lambda: fvi.solve(Q, [1, 3]), fvi.Error, r"^t_eval: t\[1\] is 3"),
    # numbers out of their range, by their own name
    (lambda: fvi.solve(Q.replace(order=3)), fvi.Error, r"^order is 3; it must be in \[0, 2\]"),
    (lambda: fvi.solve(Q.replace(order=nan)), fvi.Error, "^order is nan"), (lambda: fvi.solve(Q.replace(v0=nan)), fvi.Error, "^v0 is nan"),
    (lambda: fvi.solve(Q.replace(x0=[1, 2, 3], v0=[1, 2])), ValueError, r"^v0 has the shape \(2,\), not \(3,\)"),
    # laws and starts that the default method does not take
    *[(lambda how=how: fvi.solve(fvi.Problem(damping="zener:1,0.6,2", time=1), **how), fvi.Error, "^a pole of this law is too near")
      for how in ({}, dict(events="x : mark"), dict(error=1e-3, method="fvi-adaptive"))],
    (lambda: fvi.solve(fvi.Problem(damping="power:1,0.7 + viscous:1")), fvi.Error, "^fvi-adaptive takes no velocity that jumps"),
    (lambda: fvi.solve(fvi.Problem(alpha=1 - 1e-9, force="impulse:1,2")), fvi.Error, "^no step is short enough for a velocity that jumps"),
    # bounds, and pasts of an exact motion
    *[(lambda name=name, v=v: fvi.error_bound(alpha=0.3, time=1, damping=1, lipschitz=1, gradient=1, variation=0, start=0, speed=1,
                                              **{name: v}), TypeError, f"^{name}: .* is no number")
      for name in ("acceleration", "velocity_variation") for v in ("", False, [])],
    (lambda: fvi.exact_motion(fvi.Problem(damping="power:1,0.7", past="caputo"), 1), ValueError, "^past: "),
    (lambda: fvi.exact_motion(fvi.Problem(alpha=0.7, past="caputo"), 1), ValueError, "^past: "),
    # what should be a list, a dict, a function, a file
    *[(lambda name=name, v=v: fvi.Problem(**{name: v}), TypeError, f"^{name}: .* is no text and no list")
      for name in ("dampers", "constraints", "impose", "force_on") for v in (3, nan, {1}, {}) if (name, v) != ("impose", {})],
    (lambda: fvi.solve(fvi.Problem(force_on="abc")), ValueError, "^force_on: 'abc' is not I=F"),
    (lambda: fvi.solve(fvi.Problem(constraints="abc")), ValueError, "^constraints: 'abc'"),
    (lambda: fvi.solve(Q, progress=3), TypeError, "^progress: 3 is no function"), (lambda: fvi.solve(Q, progress="yes"), TypeError, "^progress: "),
    (lambda: fvi.solve(Q, checkpoint=3), TypeError, "^checkpoint: 3 is no name of a file"),
    (lambda: fvi.sweep(3, {"alpha": [0.1]}), TypeError, "^problem: 3"), (lambda: fvi.sweep(Q, 3), TypeError, "^vary: 3"),
    (lambda: fvi.sweep(Q, {}), TypeError, "^vary: {}"), (lambda: fvi.sweep(Q, {"alpha": 0.1}), TypeError, "^vary: alpha: 0.1 is no list"),
    (lambda: fvi.sweep(Q, {"alpha": []}), ValueError, "^vary: alpha: there is no value"),
    (lambda: fvi.sweep(Q, {"potential": "free"}), TypeError, "^vary: potential: 'free' is no list"),
    (lambda: fvi.sweep(Q, {3: [1]}), ValueError, "^vary: 3 is no field"), (lambda: fvi.sweep(Q, {"alpha": [None]}, 3), TypeError, "^of: 3"),
    (lambda: fvi.sweep(Q, {"alpha": [0.1]}, progress=3), TypeError, "^progress: 3"),
    # gradients
    (lambda: fvi.vjp(S), TypeError, "^x: missing"), (lambda: fvi.vjp(S, x=nan), ValueError, "^x: row 0 is not finite"),
    (lambda: fvi.vjp(S, energy=np.append(np.zeros(20), np.inf)), ValueError, "^energy: row 20 is not finite"),
    (lambda: fvi.vjp(S, x=1, wrt=[]), ValueError, "^wrt: there is no name"), (lambda: fvi.vjp(S, x=1, wrt=3), TypeError, "^wrt: 3"),
    (lambda: fvi.vjp(S, x=1, wrt=[["x0"]]), TypeError, "^wrt: "), (lambda: fvi.jacobian(S, 3), TypeError, "^wrt: 3"),
    (lambda: fvi.jacobian(S, []), ValueError, "^wrt: "), (lambda: fvi.jacobian(3, "x0"), TypeError, "^solution: 3"),
    (lambda: fvi.gradient(Q, 3, h=0.1), TypeError, "^loss: 3 is no function"),
    *[(lambda v=v: fvi.gradient(Q, lambda s: v, h=0.1), TypeError, "^loss gave ")
      for v in (None, 1.0, (1, 2), (1, {}), (1, {"y": 1}), (1, {"x": 1}, 2))],
    (lambda: fvi.gradient(Q, lambda s: ("a", {"x": 1}), h=0.1), TypeError, "^loss: 'a' is no number"),
    # what functions of the caller's give
    (lambda: fvi.solve(BALL, events=fvi.Event(lambda t, x, p: [1])), TypeError, "^events: <lambda> gave .1., not a number"),
    (lambda: fvi.solve(BALL, events=fvi.Event(lambda t, x, p: 10**400)), TypeError, "^events: <lambda> gave"),
    (lambda: fvi.solve(BALL.replace(force=lambda t: 10**400), h=0.1), TypeError, "^force gave"),
    (lambda: fvi.solve(fvi.Problem(damping=lambda s: None), h=0.1), TypeError, "^damping gave None, not a number"),
    (lambda: fvi.Event("x", direction=True), ValueError, "^events: direction: True"),
    (lambda: fvi.Event(abs, "impact:1", gradient=3), TypeError, "^events: gradient: 3 is no function"),
    (lambda: fvi.Event("x", acton="stop"), TypeError, "^Event: there is no argument 'acton'; did you mean 'action'"),
    (lambda: fvi.potential(abs, abs, abs, quadratic=3), TypeError, "^quadratic: 3 is neither"),
])
def test_what_cannot_be_meant_is_refused(call, what, why):
    raises(call, what, why)


def test_a_sweep_takes_any_list_once():
    """Also one that can be read once only."""
    assert fvi.sweep(Q, {"alpha": (a for a in (0.1, 0.2)), "x0": np.array([1, 2, 3])}, lambda s: s.x[-1, 0], h=0.1).shape == (2, 3)
