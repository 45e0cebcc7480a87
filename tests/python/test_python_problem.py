"""The Python package: problems as data, their solutions, sweeps."""
import io
import os
import pickle
import pydoc
import re
import subprocess
import sys
import textwrap
import threading
import warnings

import fvi
import numpy as np
import pytest

PROGRAM = os.environ.get("FVI", "build/fvi")
DUFFING = fvi.Problem("duffing:1,0.5", alpha=0.3, rho=0.4, x0=1, p0=0.5, time=20)


def program(*options):
    text = subprocess.run([PROGRAM, "run", *options], check=True, capture_output=True, text=True).stdout
    return np.array([line.split("\t") for line in text.splitlines() if line[0] != "#"], dtype=float)


def table(solution):
    return np.column_stack([solution.t, solution.x, solution.p, solution.energy])


WORDS = ["--potential", "duffing:1,0.5", "--alpha", "0.3", "--rho", "0.4", "--time", "20"]


# ---- digits ----

@pytest.mark.parametrize("options, words", [
    (dict(h=0.1), []), (dict(h=0.1, kappa=1), ["--kappa", "1"]), (dict(steps=300, method="fvi-lobatto4"),
                                                               ["--method", "fvi-lobatto4", "--steps", "300"]),
    (dict(error=1e-6), ["--error", "1e-6"]), (dict(), ["--method", "fvi-adaptive"]),
    (dict(error=1e-4, method="fvi-bdf2", steps=20), ["--error", "1e-4", "--method", "fvi-bdf2", "--steps", "20"]),
    (dict(h=0.1, memory="direct"), ["--memory", "direct"]),
])
def test_a_solution_has_the_programs_digits(options, words):
    assert np.array_equal(table(fvi.solve(DUFFING, **options)), program(*WORDS, *words))


def test_a_step_has_a_tolerance():
    run = fvi.run("duffing:1,0.5", alpha=0.3, rho=0.4, time=20, step_error=1e-5, steps=7, columns="t,x,p,energy")
    assert np.array_equal(table(fvi.solve(DUFFING, step_error=1e-5, steps=7)), np.column_stack(run[:4]))


def test_the_defaults_are_the_programs():
    assert np.array_equal(table(fvi.solve(fvi.Problem(), h=0.1)), program())


def test_the_rest_of_a_problem_is_the_programs_too():
    q = fvi.Problem("chain:3,1,0.2", order=0.8, mass=[1, 2, 3], rho=[0.1, 0, 0.2], x0=[1, 0, 0], p0=0, time=5,
                    past="caputo", force="cosine:0.3,1.2")
    assert np.array_equal(table(fvi.solve(q, h=0.1)), program(
        "--potential", "chain:3,1,0.2", "--alpha", "0.4", "--mass", "1,2,3", "--rho", "0.1,0,0.2", "--x0", "1,0,0",
        "--p0", "0", "--steps", "50", "--derivative", "caputo", "--force", "cosine:0.3,1.2"))
    law = fvi.Problem("k*x^2/2", let={"k": 2}, damping=["zener:1,0.3,2", "maxwell:0.5,3"], v0=0.25, mass=2, time=5)
    assert np.array_equal(table(fvi.solve(law, h=0.1)), program(
        "--potential", "k*x^2/2", "--let", "k=2", "--damping", "zener:1,0.3,2", "--damping", "maxwell:0.5,3",
        "--p0", "0.5", "--mass", "2", "--steps", "50"))


def test_times_of_ones_own():
    t = np.array([0.0, 1 / 3, np.pi, 20.0])
    s = fvi.solve(DUFFING, t, error=1e-8)
    assert np.array_equal(s.t, t) and s.x.shape == (4, 1) and s.estimate <= 1e-8
    assert abs(fvi.solve(DUFFING, error=1e-10)(t) - s.x).max() <= 1e-8
    fixed = fvi.solve(DUFFING, [0.5, 2, 19], h=0.1, method="fvi-lobatto4")
    assert np.array_equal(fixed.x, fvi.solve(DUFFING, h=0.1, method="fvi-lobatto4").x[[5, 20, 190]])
    with pytest.raises(fvi.Error, match="^t_eval: .*fvi-adaptive give out any time") as caught:
        fvi.solve(DUFFING, [0.25], h=0.1)
    assert caught.value.field == "t_eval" and caught.value.value == 0.25


def test_a_solution_gives_out_any_time():
    """By the polynomials of its own steps: a cubic through these rows is off by 1e-3."""
    s = fvi.solve(fvi.Problem(alpha=0.3, time=20), steps=20)
    t = np.random.default_rng(1).uniform(0, 20, (3, 7))
    exact = fvi.exact(t, alpha=0.3)[0]
    assert s(t).shape == (3, 7, 1) and abs(s(t)[..., 0] - exact).max() < 1e-8  # seen: 2e-10
    assert np.array_equal(s(s.t), s.x) and s(3.0).shape == (1,) and s(3.0)[0] == s.x[3, 0]
    with pytest.raises(fvi.Error, match="multiples of h"):
        fvi.solve(DUFFING, h=0.1)(0.25)
    with pytest.raises(ValueError, match="^t: 21 is not within the motion, 0 ... 20"):
        fvi.solve(DUFFING, h=0.1, method="fvi-lobatto4")([3, 21])
    with pytest.raises(fvi.Error) as caught:
        s(21.0)
    assert caught.value.field == "t"


# ---- data ----

def test_a_problem_is_data():
    q = fvi.Problem("k*x^4/4", let={"k": 2}, force=([0, 20], [[0], [1]]), x0=[1, 2], damping=["power:1,0.3"])
    again = pickle.loads(pickle.dumps(q))
    assert again == q and hash(again) == hash(q) and again != q.replace(time=10) and q != 3
    with pytest.raises(AttributeError):
        q.time = 3
    for a in (again.x0, *again.force):
        with pytest.raises(ValueError):
            a[0] = 7
    x0 = np.array([1.0, 2.0])
    kept = fvi.Problem(x0=x0)
    x0[0] = 9
    assert kept.x0[0] == 1
    assert DUFFING.replace(order=0.5).alpha is None and DUFFING.replace(v0=1).p0 is None
    assert DUFFING.replace(damping="zener:1,0.3,2").rho is None
    assert repr(DUFFING) == "Problem(potential='duffing:1,0.5', time=20.0, rho=0.4, alpha=0.3, x0=1.0, p0=0.5)"
    assert repr(fvi.Problem()) == "Problem(potential='harmonic:1', time=20.0, rho=0.2, alpha=0.5, x0=1.0, p0=0.5)"
    assert repr(fvi.Problem("free", v0=1, order=1)) == "Problem(potential='free', time=20.0, rho=0.2, order=1.0, x0=1.0, v0=1.0)"
    assert repr(fvi.Problem(M=[[1]], K=[[1]])) == "Problem(time=20.0, x0=0.0, p0=0.0, M=a Matrix, K=a Matrix)"


def test_a_solution_pickles():
    s = fvi.solve(DUFFING, error=1e-6)
    again = pickle.loads(pickle.dumps(s))
    assert again.problem == s.problem and np.array_equal(again.x, s.x) and again.message == s.message
    assert again(0.3) == s(0.3) and np.array_equal(again.energy, s.energy)


@pytest.mark.parametrize("call, what, why", [
    (lambda: fvi.Problem(alhpa=0.3), TypeError, "^Problem: there is no argument 'alhpa'; did you mean 'alpha'"),
    (lambda: fvi.Problem(derivative="rl"), TypeError, "did you mean 'past'"),
    (lambda: fvi.Problem(m=2), TypeError, "did you mean 'mass'"),
    (lambda: fvi.Problem(h=0.1), TypeError, "fvi.solve takes it"),
    (lambda: DUFFING.replace(mas=1), TypeError, "did you mean 'mass'"),
    (lambda: fvi.solve(DUFFING, eror=1), TypeError, "^solve: .* did you mean 'error'"),
    (lambda: fvi.sweep(DUFFING, {}, metod="fvi"), TypeError, "^sweep: .* did you mean 'method'"),
    (lambda: fvi.sweep(DUFFING, {"alfa": [1]}), ValueError, "^vary: 'alfa'"),
    (lambda: fvi.Problem(alpha=0.3, order=0.6), ValueError, "^alpha: not together with order"),
    (lambda: fvi.Problem(p0=1, v0=1), ValueError, "^p0: not together with v0"),
    (lambda: fvi.Problem(damping="zener:1,0.3,2", rho=1), ValueError, "^damping: not together with rho"),
    (lambda: fvi.Problem(time="9"), TypeError, "^time: '9'"), (lambda: fvi.Problem(x0="a"), TypeError, "^x0: 'a'"),
    (lambda: fvi.Problem(let=3), TypeError, "^let: 3"), (lambda: fvi.Problem(force=(1, 2, 3)), TypeError, "^force"),
    (lambda: fvi.solve(fvi.Problem(time=-1)), ValueError, "^time: -1"), (lambda: fvi.solve(3), TypeError, "^problem"),
    (lambda: fvi.solve(fvi.Problem("duffing:1")), ValueError, "^potential"),
    (lambda: fvi.solve(fvi.Problem("k*x", let={"k": 1, "c": 2})), ValueError, "'c' is in no expression"),
    (lambda: fvi.solve(fvi.Problem(past="rl ")), ValueError, "^past: 'rl '"),
    (lambda: fvi.solve(fvi.Problem(M=[[1]], K=[[1]], dampers=[([1], "viscous:1", "rl ")])), ValueError,
     "^dampers: past: 'rl ' is none of held, caputo, rl"),
    (lambda: fvi.Problem(dampers=["x1 : power:1,0.7"], past="caputo"), ValueError, "^dampers: not together with past"),
    (lambda: fvi.moduli("power:1,0.3", 1, let={"k": 2}), ValueError, "'k' is in no expression"),
    (lambda: fvi.moduli("power:1,0.3", -1), fvi.Error, "^omega: must be finite and above 0"),
    (lambda: fvi.creep("power:1,0.3", 0), fvi.Error, "^t: must be finite and above 0"),
    (lambda: fvi.fit_creep([0, 1, 2, 3, 4], [1, 2, 3, 4, 5]), fvi.Error, "^t: must be finite and above 0"),
    (lambda: fvi.fit([], []), ValueError, "^t and x are two arrays of one length >= 1"),
    (lambda: fvi.solve(DUFFING, error=1e-6, h=0.1), ValueError, "^h: not together with error"),
    (lambda: fvi.solve(DUFFING, h=0.1, steps=9), ValueError, "^steps: not together with h"),
    (lambda: fvi.solve(DUFFING, h=0.3), ValueError, "^h: 20 is not a whole number of steps of 0.3"),
    (lambda: fvi.solve(DUFFING, h=0), ValueError, "^h: 0"), (lambda: fvi.solve(DUFFING, error=0), ValueError, "^error"),
    (lambda: fvi.solve(DUFFING, method="rk4"), ValueError, "^method: 'rk4'"),
    (lambda: fvi.solve(DUFFING, kappa=1), ValueError, "^kappa: fvi-adaptive has none"),
    (lambda: fvi.solve(DUFFING, memory="fft", h=0.1), ValueError, "^memory"),
    (lambda: fvi.solve(DUFFING, step_error=1e-3, method="fvi"), ValueError, "^step_error: not for fvi"),
    (lambda: fvi.solve(DUFFING, most_steps=3, h=0.1), ValueError, "^most_steps: not for fvi"),
    (lambda: fvi.solve(DUFFING, []), ValueError, "^t_eval: the shape"),
    (lambda: fvi.solve(fvi.Problem(force=([0, 1], [1, 2]))), ValueError, "force: it is known from 0 to 1"),
    (lambda: fvi.solve(fvi.Problem(force=([0, 0], [1, 2]))), ValueError, "force: t must increase"),
    (lambda: fvi.solve(fvi.Problem(force=([0, 20], [1, 2, 3]))), ValueError, "force: t and F have the shapes"),
    (lambda: fvi.solve(DUFFING, [2, 1]), fvi.Error, "must increase"),
])
def test_a_wrong_argument_is_named(call, what, why):
    with pytest.raises(what, match=why):
        call()


# ---- what goes wrong ----

def test_an_error_carries_what_is_known():
    with pytest.raises(fvi.Error) as caught:
        fvi.solve(fvi.Problem("log(x) + 8*x"), h=0.1)
    again = pickle.loads(pickle.dumps(caught.value))
    for e in (caught.value, again):
        assert (e.code, e.step, e.time) == (16, 7, pytest.approx(0.6)) and "step 7" in str(e)
        assert e.rows.x.shape == (7, 1) and np.isfinite(e.rows.x).all() and e.rows.status == 16
    assert np.array_equal(again.rows.x, caught.value.rows.x)
    with pytest.raises(fvi.Error) as caught:
        fvi.solve(fvi.Problem(alpha=1.5))
    e = pickle.loads(pickle.dumps(caught.value))
    assert (e.code, e.field, e.value, e.step, e.rows) == (1, "alpha", 1.5, None, None)
    with pytest.raises(fvi.Error) as caught:
        fvi.solve(DUFFING, error=1e-17)
    assert caught.value.code == 14 and (caught.value.field, caught.value.value) == ("error", 1e-17)
    with pytest.raises(ZeroDivisionError):
        fvi.solve(fvi.Problem(force=lambda t: 1 / 0))


def test_a_warning_is_an_fvi_warning():
    with pytest.warns(fvi.FviWarning, match="grows|stable|step"):
        fvi.solve(fvi.Problem("harmonic:1e4", alpha=0.3, time=6), h=0.1, method="fvi-bdf2", kappa=1)
    assert fvi.Warning is fvi.FviWarning
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        fvi.solve(DUFFING, h=0.1)


def test_a_function_may_keep_what_it_is_given():
    kept = []

    def gradient(x):
        kept.append(x)
        return x
    s = fvi.solve(fvi.Problem(fvi.potential(lambda x: x @ x / 2, gradient, lambda x: np.eye(2)), x0=[1, 2], p0=0),
                  method="euler-explicit", h=0.1)
    assert any(np.array_equal(x, s.x[50]) for x in kept) and all(x.base is None for x in kept)


def test_measured_forces_are_linear_in_between(tmp_path):
    t = np.linspace(0, 20, 41)
    F = np.cos(t)
    path = tmp_path / "f.tsv"
    path.write_text("".join(f"{a!r}\t{b!r}\n" for a, b in zip(t.tolist(), F.tolist())))
    for options, words in ((dict(error=1e-6), ["--error", "1e-6"]), (dict(h=0.1), [])):
        assert np.array_equal(table(fvi.solve(DUFFING.replace(force=(t, F)), **options)),
                              program(*WORDS, *words, "--force", f"file:{path}"))
    both = DUFFING.replace(force=(t, F), x0=[1, 1])
    two = DUFFING.replace(force=(t, np.column_stack([F, 0 * F])), x0=[1, 1])
    a, b = fvi.solve(both, error=1e-8), fvi.solve(two, error=1e-8)
    assert abs(a.x[:, 0] - b.x[:, 0]).max() <= 2e-8 and abs(a.x[:, 1] - b.x[:, 1]).max() > 0.1
    assert abs(b.x[:, 1] - fvi.solve(DUFFING, error=1e-8).x[:, 0]).max() <= 2e-8


# ---- sweeps, progress, an interrupt ----

def test_a_sweep_is_what_a_loop_gives():
    alphas, ks = [0.1, 0.3, 0.5], [1, 2]
    q = fvi.Problem("k*x^4/4", let={"k": 1}, time=5)
    found = fvi.sweep(q, {"alpha": alphas, "k": ks}, lambda s: s.x[-1], h=0.05)
    assert found.shape == (3, 2, 1)
    for i, alpha in enumerate(alphas):
        for j, k in enumerate(ks):
            assert found[i, j] == fvi.solve(q.replace(alpha=alpha, let={"k": k}), h=0.05).x[-1]
    whole = fvi.sweep(q, {"alpha": alphas}, h=0.05, jobs=1)
    assert whole.shape == (3,) and whole[1].problem.alpha == 0.3
    with pytest.raises(fvi.Error):
        fvi.sweep(q, {"alpha": [0.3, 3]})
    seen = []
    fvi.sweep(q, {"alpha": alphas}, progress=lambda n, all: seen.append((n, all)))
    assert seen == [(1, 3), (2, 3), (3, 3)]


def same(a, b):
    """Two Solutions, to the bit, with what is said of them."""
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in "txpv") and a.message == b.message \
        and a.problem.let == b.problem.let


@pytest.mark.parametrize("vary, options", [
    ({"x0": np.linspace(-1, 1, 5), "k": [1, 2, 3]}, {"h": 0.05, "method": "fvi-stable"}),
    ({"x0": np.linspace(-1, 1, 5), "alpha": [0, 0.3, 0.5]}, {"steps": 60, "method": "fvi-bdf2"}),
    ({"k": np.linspace(1, 2, 17)}, {"h": 0.05, "t_eval": [0, 0.05, 1, 2.5]}), ({"k": [1, 2]}, {"h": 0.001, "t_eval": [1, 3.5]}),
    ({"v0": np.linspace(-1, 1, 9), "rho": [0, 0.1]}, {"h": 0.05, "method": "fvi-lobatto3"}),
    ({"force": ["cos(t)", "step:1,2 + t", None, "0"] * 2}, {"h": 0.1}),
    ({"x0": [[1, 2], [3, 4]]}, {"h": 0.1}), ({"k": [1, 2, 3]}, {"error": 1e-6}), ({"k": [1, 2, 3]}, {})])
def test_motions_together_are_those_of_a_loop(vary, options):
    q = fvi.Problem("k*x^4/4 - x^2/2" if "x0" not in vary or not isinstance(vary["x0"][0], list) else "k*x1^4/4 - x2^2/2",
                    let={"k": 1.0}, time=5, force=None if "force" in vary else "0.3*cos(1.2*t)", alpha=None, p0=None if "v0" in vary else 0.5)
    found = fvi.sweep(q, vary, jobs=1, **options)
    for place in np.ndindex(found.shape):
        values = {name: v[i] for (name, v), i in zip(vary.items(), place)}
        let = {"k": values.pop("k", 1.0)}
        assert same(found[place], fvi.solve(q.replace(let=let, **values), **options))


def test_motions_together_with_functions_failures_and_warnings():
    q = fvi.Problem(fvi.potential(lambda x: x[0]**4 / 4, lambda x: x**3, lambda x: 3 * x**2), force=lambda t: np.sin(t), time=2, alpha=0.3)
    starts = list(np.linspace(0.5, 1, 8))
    found = fvi.sweep(q, {"x0": starts}, jobs=1, h=0.1, method="fvi-stable")
    assert all(same(s, fvi.solve(q.replace(x0=x0), h=0.1, method="fvi-stable")) for s, x0 in zip(found, starts))
    q = fvi.Problem("x^4/4", time=5)
    with pytest.raises(fvi.Error) as alone:
        fvi.solve(q.replace(x0=1e100), h=0.1)
    with pytest.raises(fvi.Error) as raised:
        fvi.sweep(q, {"x0": [1, 2, 1e100, 3]}, jobs=1, h=0.1)
    assert str(raised.value) == str(alone.value) and raised.value.rows.t.size == alone.value.rows.t.size
    with pytest.warns(fvi.FviWarning, match=r"^1 of 3 motions, the first with x0 = 1"), warnings.catch_warnings():
        fvi.sweep(fvi.Problem("x^2/2", past="rl", alpha=0.7, time=5), {"x0": [0, 0, 1]}, jobs=1, h=0.1)

    def fails(s):
        raise KeyError(s.x[-1, 0])
    with pytest.raises(KeyError):
        fvi.sweep(q, {"x0": [1, 2, 3]}, fails, jobs=1, h=0.1)
    seen = []
    fvi.sweep(q, {"x0": [1, 2, 3], "alpha": [0.1, 0.2]}, jobs=1, h=0.1, progress=lambda n, all: seen.append((n, all)))
    assert seen == [(n, 6) for n in range(1, 7)]


def test_a_run_goes_on_beside_python():
    """The lock is not held: this loop counts while two runs go on."""
    counted, end = 0, threading.Event()

    def work():
        fvi.sweep(DUFFING, {"rho": [0.1, 0.2]}, h=2e-5, memory="exponentials")
        end.set()
    thread = threading.Thread(target=work)
    thread.start()
    while not end.wait(0.001):
        counted += 1
    thread.join()
    assert counted > 10


def test_progress_is_told(capsys):
    seen = []
    fvi.solve(DUFFING, h=1e-4, progress=lambda rows, all: seen.append((rows, all)))
    assert seen[-1] == (200001, 200001) and seen == sorted(seen)
    fvi.solve(DUFFING, h=1e-3, progress=True)
    assert "100 %" in capsys.readouterr().err
    with pytest.raises(KeyError):
        fvi.solve(DUFFING, h=0.1, progress=lambda rows, all: {}[rows])


@pytest.mark.parametrize("call", ["fvi.solve(q, [200], h=1e-6)", "fvi.solve(q, error=1e-13, method='fvi')",
                                  "fvi.sweep(q, {'rho': [0.1, 0.2, 0.3]}, t_eval=[200], h=1e-6)",
                                  "[fvi.vjp(s, x=1) for _ in range(99)]"])
def test_an_interrupt_ends_what_lasts(call):
    """Within 50 ms on a machine that is idle; the library is asked each 25 ms. Two seconds are allowed here.

    After 0.2 s each call is inside the library. The solution s of a gradient is computed before the clock starts.
    """
    script = textwrap.dedent(f"""
        import os, signal, threading, time
        import fvi
        signal.signal(signal.SIGINT, signal.default_int_handler)
        q = fvi.Problem("duffing:1,0.5", alpha=0.3, time=200)
        s = {"fvi.solve(q, h=1e-4)" if "(s," in call else None}
        at = []
        threading.Timer(0.2, lambda: (at.append(time.monotonic()), os.kill(os.getpid(), signal.SIGINT))).start()
        try:
            {call}
            print("over")
        except KeyboardInterrupt:
            print(time.monotonic() - at[0])
        assert fvi.solve(q, h=0.1).x.shape == (2001, 1)
    """)
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert run.returncode == 0, run.stderr
    assert float(run.stdout) < 2


# ---- for others ----

def test_a_solution_becomes_a_table():
    pandas = pytest.importorskip("pandas")
    s = fvi.solve(DUFFING.replace(x0=[1, 2]), steps=10)
    frame = s.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame) == ["x1", "x2", "p1", "p2", "v1", "v2"]
    assert np.array_equal(frame["x2"], s.x[:, 1]) and np.array_equal(frame.index, s.t)
    assert list(fvi.solve(DUFFING).to_pandas()) == ["x", "p", "v"]


def test_a_solution_becomes_a_dataset():
    pytest.importorskip("xarray")
    s = fvi.solve(DUFFING.replace(x0=[1, 2]), steps=10)
    assert np.array_equal(s.to_xarray().x.sel(i=2), s.x[:, 1])


def test_a_solution_is_drawn():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    s = fvi.solve(DUFFING.replace(x0=[1, 2]), steps=10)
    axes = s.plot()
    assert [line.get_label() for line in axes.lines] == ["x1", "x2"]
    assert s.plot(axes, color="k") is axes and len(axes.lines) == 4


def test_help_fits_on_two_screens():
    out = io.StringIO()
    pydoc.Helper(output=out)(fvi)
    text = re.sub(".\b", "", out.getvalue())
    assert len(text.splitlines()) <= 100 and "Problem" in text
    for name in ("Problem", "solve", "sweep", "fit", "run", "Error"):
        assert f"    {name} " in fvi.__doc__ and getattr(fvi, name).__doc__


def test_help_has_the_formulas_of_the_program():
    """Word for word, from one place; and each formula is what the library computes with."""
    told = subprocess.run([PROGRAM, "help", "run"], check=True, capture_output=True, text=True).stdout
    text = fvi.formulas()
    assert text in told and text in fvi.formulas.__doc__ and text in textwrap.dedent(fvi.Problem.__doc__.partition("for:\n\n")[2])
    lines = [line[2:].split(None, 1) for line in text.splitlines() if re.match("  [a-z]", line)]
    known = {form: formula.partition(",")[0] for form, formula in lines}
    numbers, s = {"R": 0.7, "R1": 0.7, "R2": 1.3, "A": 0.4, "B": 0.3, "T": 2.1, "K": 0.6, "C": 1.2, "G": 0.8}, 1.7j
    for form, formula in known.items():
        word, _, names = form.partition(":")
        if word in ("viscous", "power", "zener", "maxwell", "maxwell2", "davidson", "spring", "havriliak"):
            python = re.sub(r"(?<=[\w)]) (?=[\w(])", "*", formula.replace("{", "(").replace("}", ")").replace("^", "**"))
            python = re.sub(r"\b2([AB])", r"2*\1", python)
            value = ",".join(str(numbers[name]) for name in names.split(","))
            assert abs(fvi.moduli(f"{word}:{value}", [1.7])[0] - eval(python, {**numbers, "s": s})) < 1e-15 * 10
    x = 0.9
    for form, U in (("harmonic:C", 1.2 * x**2 / 2), ("duffing:C,G", 1.2 * x**2 / 2 + 0.8 * x**4 / 4),
                    ("pendulum:G", 0.8 * (1 - np.cos(x))), ("free", 0.0)):
        word, _, names = form.partition(":")
        text = word + ":" * bool(names) + ",".join(str(numbers[name]) for name in names.split(",") if name)
        assert form in known and abs(fvi.solve(fvi.Problem(text, x0=x, p0=0), h=1).energy[0] - U) < 1e-15
    assert known["pendulum:G"] == "G (1 - cos x)" and known["duffing:C,G"] == "C x^2/2 + G x^4/4"


def test_help_of_torch_needs_no_torch():
    """It is a page, and quiet; what needs torch says so."""
    run = subprocess.run([sys.executable, "-c", "import fvi; help(fvi.torch)"], capture_output=True, text=True)
    text = re.sub(".\b", "", run.stdout)
    assert run.stderr == "" and "backward()" in text and "solve(problem" in text and len(text.splitlines()) < 60
    hidden = "import sys; sys.modules['torch'] = None\nimport fvi\nfvi.torch.solve(fvi.Problem(), {'alpha': 1})"
    run = subprocess.run([sys.executable, "-c", hidden], capture_output=True, text=True)
    assert run.returncode == 1 and "\nModuleNotFoundError: fvi.torch needs torch, " in run.stderr


@pytest.mark.parametrize("module, package", [("numpy", "numpy"), ("_cffi_backend", "cffi")])
def test_a_package_that_is_missing_is_named(module, package):
    run = subprocess.run([sys.executable, "-c", f"import sys; sys.modules['{module}'] = None\nimport fvi"], capture_output=True, text=True)
    assert f"\nModuleNotFoundError: fvi needs {package}, which this Python does not find: python -m pip install {package}" in run.stderr


def test_each_field_is_explained():
    import dataclasses
    import inspect
    words = set(re.findall(r"\w+", fvi.Problem.__doc__))
    assert not [f.name for f in dataclasses.fields(fvi.Problem) if f.name not in words]
    for function in (fvi.solve, fvi.sweep):
        words = set(re.findall(r"\w+", function.__doc__))
        names = [n for n, p in inspect.signature(function).parameters.items() if p.kind != p.VAR_KEYWORD]
        assert not [n for n in names if n not in words]


# ---- what an observer says ----

@pytest.mark.parametrize("options, words", [
    (dict(h=0.1, method="fvi-lobatto4"), ["--method", "fvi-lobatto4"]), (dict(h=0.1, method="fvi-stable"), ["--method", "fvi-stable"]),
    (dict(), ["--method", "fvi-adaptive"])])
def test_accelerations_forces_and_work_are_the_programs(options, words):
    q = DUFFING.replace(force="cosine:0.3,1.2")
    s = fvi.solve(q, **options)
    rows = program(*WORDS, *words, "--force", "cosine:0.3,1.2", "--columns",
                   "t,v,a,d1.force,d1.impulse,d1.work,work,balance")
    got = np.column_stack([s.t, s.v, s.a, s.forces["d1"], s.impulses["d1"], s.work["d1"], s.work["d1"], s.balance])
    assert np.array_equal(got, rows)
    again = pickle.loads(pickle.dumps(s))
    assert np.array_equal(again.a, s.a)
    bare = fvi.solve(q, [1, 5, 20], **options)
    at = [10, 50, 200]
    assert abs(bare.forces["d1"] - s.forces["d1"][at]).max() <= 1e-12 and abs(bare.work["d1"] - s.work["d1"][at]).max() <= 1e-12


def test_the_equation_of_motion_holds():
    """a = F - U' - force, as it is made: two roundings."""
    s = fvi.solve(DUFFING.replace(force="cosine:0.3,1.2"), error=1e-4, method="fvi-bdf2")
    left = 0.3 * np.cos(1.2 * s.t) - s.x[:, 0] - 0.5 * s.x[:, 0]**3 - s.forces["d1"][:, 0] - s.a[:, 0]
    assert abs(left[1:]).max() < 1e-14
    assert abs(s.balance - s.energy[0]).max() < 1e-4
