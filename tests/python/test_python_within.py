"""The Python package: where is the body between two steps?"""
import fvi
import numpy as np
import pytest

DUFFING = fvi.Problem("duffing:1,0.5", alpha=0.3, rho=0.4, x0=1, p0=0.5, time=20)


@pytest.mark.parametrize("name, order, most", [("fvi-lobatto2", 2, 4e-4), ("fvi-lobatto3", 3, 2.5e-6), ("fvi-lobatto4", 4, 9e-9),
                                               ("fvi-lobatto2d", 2, 2.5e-3), ("fvi-lobatto3d", 3, 9e-6), ("fvi-lobatto4d", 4, 5e-8)])
def test_the_path_between_two_steps_has_the_order_of_the_stages(name, order, most):
    """A polynomial of degree s - 1 through the stages: at a fixed t > 0 it is off by h^s. Seen: 1.89 to 4.13."""
    q = fvi.Problem(alpha=0.3, rho=0.4, time=10)
    t = np.random.default_rng(3).uniform(1, 10, 400)
    exact = fvi.exact(t, alpha=0.3, rho=0.4)[0]
    errors = [abs(fvi.solve(q, steps=n, method=name)(t)[:, 0] - exact).max() for n in (40, 80, 160)]
    assert errors[2] < most  # seen: at least a tenth less
    assert np.log2(errors[0] / errors[2]) / 2 == pytest.approx(order, abs=0.15)


def test_between_its_steps_fvi_adaptive_is_as_right_as_at_them():
    """The error over all t falls with the tolerance of a step as that of the rows does."""
    q = fvi.Problem(alpha=0.3, rho=0.4, time=10)
    t = np.random.default_rng(3).uniform(0, 10, 2000)
    exact = fvi.exact(t, alpha=0.3, rho=0.4)[0]
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
        s = fvi.solve(q, step_error=tolerance)
        at_rows = abs(s.x[:, 0] - fvi.exact(s.t, alpha=0.3, rho=0.4)[0]).max()
        assert abs(s(t)[:, 0] - exact).max() < 1.2 * at_rows < 2 * tolerance  # seen: 1.03 of the rows


def test_the_path_goes_through_the_rows():
    arm = fvi.Problem(lagrangian="v1^2 + v2^2/2 + v1*v2*cos(x1 - x2) + 9.81*(2*cos(x1) + cos(x2))", x0=[2, 2.5], v0=[0, 0],
                      dampers=["elbow=x2 - x1 : power:0.5,0.25"], time=2)
    fine = fvi.solve(arm, h=0.001, method="fvi-lobatto4")
    for s in (fvi.solve(arm, h=0.02, method="fvi-lobatto4"), fvi.solve(DUFFING, error=1e-6, method="fvi-lobatto3")):
        assert np.array_equal(s(s.t), s.x) and np.array_equal(s(s.t[::-1]), s.x[::-1])
    assert abs(fvi.solve(arm, h=0.02, method="fvi-lobatto4")(fine.t) - fine.x).max() < 1e-5  # seen: 3e-6


def test_a_structure_has_a_path_between_the_steps():
    """Two unknowns that are one oscillator each, as masses and as matrices."""
    t = np.random.default_rng(5).uniform(0, 5, 200)
    M, K = np.diag([1.0, 2.0]), np.diag([1.0, 3.0])
    masses = fvi.Problem("x1^2/2 + 3*x2^2/2", mass=[1, 2], rho=0, x0=[1, 0.5], p0=[0, 1], time=5)
    structure = fvi.Problem(M=M, K=K, x0=[1, 0.5], p0=[0, 1], time=5)
    one, other = (fvi.solve(q, h=0.1, method="fvi-lobatto4d")(t) for q in (masses, structure))
    assert abs(one - other).max() < 1e-13  # seen: 2e-15


def test_momenta_are_known_where_the_method_knows_them():
    """By fvi-adaptive at any time, as a run with rows there gives them; else at the ends of steps; all to the bit."""
    t = np.array([[0.3, 17.25], [3.21, 0.3]])
    adaptive = fvi.solve(DUFFING, step_error=1e-8)
    x, p = adaptive.state(t)
    rows = fvi.solve(DUFFING, [0.3, 3.21, 17.25], step_error=1e-8)
    assert x.shape == p.shape == (2, 2, 1) and np.array_equal(x, adaptive(t))
    assert np.array_equal(x[..., 0].ravel()[[0, 2, 1]], rows.x[:, 0]) and np.array_equal(p[..., 0].ravel()[[0, 2, 1]], rows.p[:, 0])
    for options in (dict(h=0.1), dict(h=0.1, method="fvi-lobatto4"), dict(error=1e-6), dict(error=1e-6, method="fvi-lobatto3")):
        s = fvi.solve(DUFFING, **options)
        x, p = s.state(s.t[::-7])
        assert np.array_equal(x, s.x[::-7]) and np.array_equal(p, s.p[::-7])
    ball = fvi.solve(fvi.Problem("9.81*x", rho=0.05, x0=1, p0=0, time=2), events="x : impact:0.8")
    assert np.array_equal(ball.state(ball.t)[1], ball.p)
    for method in ("fvi-bdf2", "fvi-stable"):
        with pytest.raises(fvi.Error, match="^t_eval: .*this method gives out multiples of h, because .*; fvi-lobatto2d to 8d and fvi-adaptive"):
            fvi.solve(DUFFING, [0.25], h=0.1, method=method)
    assert fvi.solve(DUFFING, h=0.1, method="fvi-lobatto4").state(0.25, momenta=False)[1] is None


@pytest.mark.parametrize("name, stages", [("fvi-lobatto2", 2), ("fvi-lobatto3", 3), ("fvi-lobatto4", 4), ("fvi-lobatto3d", 3),
                                          ("fvi-lobatto4d", 4), ("fvi-lobatto6d", 6)])
def test_rows_may_stand_between_two_steps_of_stages(name, stages):
    """x is off by h^s there, and p, by the slope of the same path, by h^(s-1); of six stages x has what the ends of the steps have.
    Seen: orders of p within 0.1 up to four stages."""
    q = fvi.Problem(alpha=0.3, rho=0.4, time=10)
    t = np.sort(np.random.default_rng(3).uniform(1, 10, 400))
    x, v = fvi.exact(t, alpha=0.3, rho=0.4)[:2]
    errors = []
    for n in (40, 80, 160):
        s = fvi.solve(q, t, steps=n, method=name)
        assert np.array_equal(s.x, s(t)) and np.array_equal(s.p, s.state(t)[1])
        errors.append((abs(s.x[:, 0] - x).max(), abs(s.p[:, 0] - v).max()))
    of_x, of_p = np.log2(np.array(errors[0]) / errors[2]) / 2
    assert of_p > min(stages, 5.5) - 1.2 and of_x > min(stages, 4.5) - 0.2
    if stages <= 4:
        assert of_x == pytest.approx(stages, abs=0.15) and of_p == pytest.approx(stages - 1, abs=0.15)


def test_rows_between_two_steps_are_of_every_problem():
    t = np.array([0, 0.1, 0.123456789, 0.777, 1.23, 2])
    arm = fvi.Problem(lagrangian="v1^2 + v2^2/2 + v1*v2*cos(x1 - x2) + 9.81*(2*cos(x1) + cos(x2))", x0=[2, 2.5], v0=[0, 0],
                      dampers=["elbow=x2 - x1 : power:0.5,0.25"], time=2)
    structure = fvi.Problem(M=np.diag([1.0, 2.0]), K=[[2, -1], [-1, 3]], C=0.1 * np.eye(2), alpha=0.3, x0=[1, 0.5], p0=[0, 1], time=2)
    for q, method, most in ((arm, "fvi-lobatto4", 2e-4), (structure, "fvi-lobatto4d", 1e-4)):
        s, exact = fvi.solve(q, t, h=0.02, method=method), fvi.solve(q, t)
        # at the ends of steps, t = 0.1, 1.23 not: its own digits; seen: 3e-5
        assert abs(s.x - exact.x).max() < most and abs(s.p - exact.p).max() < 50 * most
        assert np.array_equal(s.x[[0, 1, 5]], fvi.solve(q, h=0.02, method=method).x[[0, 5, 100]])
        assert s.energy.shape == (6,)
    with pytest.raises(fvi.Error, match="^t_eval: .* needs times with a common step, because .*; fvi-lobatto2d to 8d and fvi-adaptive"):
        fvi.solve(DUFFING, t * np.pi / 4, error=1e-7, method="fvi-bdf2")
    s = fvi.solve(DUFFING, t, h=0.1, method="fvi-lobatto4")
    for call, what in ((lambda: s.a, "acceleration"), (lambda: s.forces, "acceleration"), (lambda: fvi.vjp(s, x=1), "gradient"),
                       (lambda: s.table("t,a"), "acceleration")):
        with pytest.raises(ValueError, match=rf"^t_eval: t\[2\] is 0.123456789, within a step of fvi-lobatto4, .* no {what}"):
            call()


def test_an_error_is_held_at_any_times():
    """By stages, and of a law that fvi-adaptive does not take."""
    t = np.array([0, 0.01, np.sqrt(2), np.pi, 7.77])
    q = DUFFING.replace(time=8)
    exact = fvi.solve(q, t, error=1e-10)
    for method in ("fvi-lobatto2", "fvi-lobatto4", "fvi-lobatto3d"):
        for error in (1e-3, 1e-6):
            s = fvi.solve(q, t, error=error, method=method)
            assert s.estimate <= error and abs(s.x - exact.x).max() <= s.estimate + 1e-9
            assert np.array_equal(s.t, t) and s(t) == pytest.approx(s.x, abs=1e-12)
    law = fvi.Problem("duffing:1,0.5", damping="zener:1,0.6,0.5", time=8)
    s = fvi.solve(law, t, error=1e-4)
    fine = fvi.solve(law, t, h=1 / 512, method="fvi-lobatto4")
    assert "fvi-lobatto4" in s.message and s.estimate <= 1e-4 and abs(s.x - fine.x).max() <= 1e-4
    assert "fvi-bdf2" in fvi.solve(law, [1, 2, 8], error=1e-2).message
