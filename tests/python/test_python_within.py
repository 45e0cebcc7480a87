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
    with pytest.raises(ValueError, match="^t: 0.25 is within a step, where fvi-lobatto4 knows no momentum"):
        fvi.solve(DUFFING, h=0.1, method="fvi-lobatto4").state(0.25)
    with pytest.raises(fvi.Error, match="^t_eval: .*solution.t. has the places between the steps"):
        fvi.solve(DUFFING, [0.25], h=0.1, method="fvi-lobatto4")
    assert fvi.solve(DUFFING, h=0.1, method="fvi-lobatto4").state(0.25, momenta=False)[1] is None
