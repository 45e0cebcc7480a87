"""The Python package: what it says beside its numbers, and what could have ended a process."""
import concurrent.futures
import ctypes
import doctest
import inspect
import os
import pickle
import re
import signal
import subprocess
import sys
import textwrap
import threading
import time
import traceback
import warnings

import fvi
import numpy as np
import pytest

PROGRAM = os.environ.get("FVI", "build/fvi")


def said(function, *arguments, **options):
    """The texts of fvi.Warning, each of which names this file."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            function(*arguments, **options)
        except fvi.Error:
            pass
    assert all(each.category is fvi.Warning and each.filename == __file__ for each in caught)
    return [str(each.message) for each in caught]


def program_said(*words):
    text = subprocess.run([PROGRAM, *words], capture_output=True, text=True).stderr
    return [line[len("fvi: warning: "):] for line in text.splitlines() if line.startswith("fvi: warning: ")]


# ---- warnings ----

@pytest.mark.parametrize("options", [
    dict(potential="harmonic:1e4", alpha=0.3, method="fvi-bdf2", kappa=1, steps=60), dict(rho=2.02, h=1, steps=3),
    dict(rho=1.99, h=1, steps=3), dict(alpha=1, rho=1.5, h=1e-3, steps=3), dict(alpha=0.8, derivative="rl"),
    dict(alpha=0.7, derivative="rl", rho=9, h=9, steps=2), dict(alpha=0.3, derivative="rl"),
    dict(potential="duffing:1,0.5", method="euler-explicit", h=0.3, x0=0, p0=2, rho=1, steps=100),
    dict(potential="x^4/4", kappa=1, x0=0, p0=3, h=0.5, rho=0, steps=12), dict(method="fvi-lobatto4", h=9, steps=3),
])
def test_a_run_warns_as_the_program_does(options):
    words = [word for name, value in options.items() for word in ("--" + name, str(value))]
    expected = program_said("run", *words)
    assert said(fvi.run, **options) == expected
    assert said(fvi.run, columns="energy", **options) == expected

    def step_by_step():
        s = fvi.Stepper(**options)
        s.step(s.steps)
        s.reset()
        s.step(s.steps - 1)

    again = [text for text in expected if "where the run is" in text]
    assert said(step_by_step) == expected + again  # what is said of the start is said once
    if options.get("rho") == 1.99 or options.get("derivative") == "rl" and options["alpha"] < 0.5:
        assert expected == []
    else:
        assert expected


def test_a_fit_warns_as_the_program_does(tmp_path):
    t = 0.1 * np.arange(1, 41)
    path = tmp_path / "data.tsv"
    seen = ""
    for true, U, which, options in (("duffing:2,1.5", "duffing:2,1", "c,g", {"alpha": "0.7"}),
                                    ("harmonic:1", "harmonic:1", "alpha,rho", {"method": "fvi", "derivative": "rl"}),
                                    ("harmonic:1", "harmonic:1", "rho",
                                     {"method": "fvi", "derivative": "rl", "alpha": "0.8"})):
        data = fvi.run(true, steps=40, alpha=0.8).x[1:]
        path.write_text("".join(f"{a!r}\t{b!r}\n" for a, b in zip(t.tolist(), data.tolist())))
        words = [word for name, value in options.items() for word in ("--" + name, value)]
        expected = [text for text in program_said("fit", "--potential", U, "--fit", which, *words, str(path))
                    if "profile" not in text]  # the profiles are not made here
        options["alpha"] = float(options.get("alpha", 0.5))
        assert said(fvi.fit, t, data, U, which=which, **options) == expected
        seen += "\n".join(expected)
    for part in ("hardly tell", "neighbouring residuals", "half of it moved", "no solution"):
        assert part in seen


@pytest.mark.parametrize("which, options, words", [
    ("mass,rho,c,p0", {}, []), ("rho", {"sigma": 1e-3}, ["--sigma", "1e-3"]),
    ("c,g", {"starts": 2}, ["--starts", "2"])])
def test_a_fit_that_is_not_believed_says_why(which, options, words, tmp_path):
    """As the program does, but for the dashes of its options."""
    t = 0.1 * np.arange(1, 41)
    data = fvi.run("duffing:2,1.5", steps=40, alpha=0.3, h=0.1, method="fvi-lobatto4").x[1:]
    path = tmp_path / "data.tsv"
    path.write_text("".join(f"{a!r}\t{b!r}\n" for a, b in zip(t.tolist(), data.tolist())))
    U = "duffing:4e5,-9" if which == "c,g" else "harmonic:1"
    text = subprocess.run([PROGRAM, "fit", "--fit", which, "--potential", U, *words, str(path)],
                          capture_output=True, text=True).stderr.splitlines()[-1]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with pytest.raises(fvi.Error) as caught:
            fvi.fit(t, data, U, which=which, **options)
    assert "fvi: " + str(caught.value) == text.replace("--", "")
    assert caught.value.fit.chi2 > 0


def test_a_warning_is_no_error_of_a_function_of_ones_own():
    """Euler's explicit method never asks for the Hessian; what that raises is not the run's affair."""
    def hessian(x):
        raise NotImplementedError
    run = fvi.run(fvi.potential(lambda x: x * x / 2, lambda x: x, hessian), method="euler-explicit", steps=20)
    assert np.isfinite(run.x).all()
    with pytest.raises(fvi.Warning), warnings.catch_warnings():
        warnings.simplefilter("error")
        fvi.run(rho=2.02, h=1, steps=3)


# ---- errors ----

def fail(alpha):
    fvi.run(alpha=alpha)


def test_an_error_comes_out_of_another_process():
    error = fvi.Error("why", 14)
    error.fit = {"alpha": 0.3}
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again), again.code, again.fit) == (fvi.Error, "why", 14, {"alpha": 0.3})
    with concurrent.futures.ProcessPoolExecutor(1) as pool:
        with pytest.raises(fvi.Error, match="alpha") as caught:
            pool.submit(fail, 1.5).result(timeout=60)
    assert caught.value.code == 1


def test_an_exception_is_the_one_that_was_raised():
    cause, error = OSError("no file"), KeyError("no such spring")

    def gradient(x):
        if x < 0.9:
            raise error from cause
        return x

    for function in (fvi.run, lambda U: fvi.Stepper(U).step(200), lambda U: fvi.run(U, error=1e-3)):
        with pytest.raises(KeyError) as caught:
            function(fvi.potential(lambda x: x * x / 2, gradient, lambda x: 1.0))
        assert caught.value is error and error.__cause__ is cause
        assert "gradient" in [frame.name for frame in traceback.extract_tb(error.__traceback__)]


def test_an_alarm_ends_a_run_with_its_own_exception():
    def late(number, frame):
        raise TimeoutError("too late")
    before = signal.signal(signal.SIGALRM, late)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        with pytest.raises(TimeoutError, match="too late"):
            fvi.Stepper(steps=10**8, alpha=0.3).step(10**8)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_a_function_may_make_runs_of_its_own():
    """What an inner run raises, and what it gets over, stays inside."""
    def force(t):
        try:
            fvi.run(force=lambda t: 1 / 0, steps=3)
        except ZeroDivisionError:
            return fvi.run(steps=2).x[1]
    assert np.array_equal(fvi.run(force=force, steps=20).x, fvi.run(force=lambda t: fvi.run().x[1], steps=20).x)


def test_the_code_of_a_compiled_function_is_said():
    kind = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_size_t, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)
    functions = [kind(lambda d, x, params, out: -7)] * 3
    addresses = [ctypes.cast(f, ctypes.c_void_p).value for f in functions]
    with pytest.raises(fvi.Error, match="caller's own functions, code -7") as caught:
        fvi.run(fvi.potential(*addresses))
    assert caught.value.code == -7


@pytest.mark.parametrize("call, what, why", [
    (lambda: fvi.run(force=np.zeros(5)), TypeError, r"^force: array\(\[0., 0., 0., 0., 0.\]\) is no text, no fun"),
    (lambda: fvi.run(force=[1, 2]), TypeError, r"^force: \[1, 2\] is no text"),
    (lambda: fvi.run(force=fvi.potential(abs, abs, abs)), TypeError, "^force: a Potential is no text"),
    (lambda: fvi.run(["harmonic:1"]), TypeError, r"^potential: \['harmonic:1'\] is no text"),
    (lambda: fvi.run(lambda x: x * x), TypeError, "^potential: a function alone has no gradient"),
    (lambda: fvi.run(None), TypeError, "^potential: None"), (lambda: fvi.Stepper(3), TypeError, "^potential: 3"),
    (lambda: fvi.run(alfa=0.3), TypeError, "^run: there is no argument 'alfa'; did you mean 'alpha'?"),
    (lambda: fvi.run(Mass=2), TypeError, "^run: .* did you mean 'mass'"),
    (lambda: fvi.run(colums="t"), TypeError, "^run: .* did you mean 'columns'"),
    (lambda: fvi.run(qqq=1), TypeError, "^run: there is no argument 'qqq'; there are .*alpha, rho"),
    (lambda: fvi.sweep(qqq=1), TypeError, "^sweep: there is no argument 'qqq'; there are problem, (?!.*problem).*t_eval"),
    (lambda: fvi.Stepper(stepps=3), TypeError, "^Stepper: .* did you mean 'steps'"),
    (lambda: fvi.Stepper(columns="t"), TypeError, "^Stepper: there is no argument 'columns'"),
    (lambda: fvi.fit([1], [1], sigme=3), TypeError, "^fit: .* did you mean 'sigma'"),
    (lambda: fvi.exact(1, dampng="x"), TypeError, "^exact: .* did you mean 'damping'"),
    (lambda: fvi.weights(0.5, cuont=3), TypeError, "^weights: .* did you mean 'count'"),
    (lambda: fvi.potential(abs, abs, abs, diagonal=1), TypeError, "^potential: .* did you mean 'diagonals'"),
    (lambda: fvi.run(damping=3), TypeError, "^damping: 3"), (lambda: fvi.run(damping=[3]), TypeError, "^damping: "),
    (lambda: fvi.run(damping="zener:1,x,2"), ValueError, "^damping: 'zener:1,x,2'"),
    (lambda: fvi.run(alpha="0.3"), TypeError, "^alpha: '0.3' is no number"),
    (lambda: fvi.run(h=[0.1, 0.2]), TypeError, "^h: "), (lambda: fvi.run(steps="9"), TypeError, "^steps: "),
    (lambda: fvi.run(kappa=None), TypeError, "^kappa: None"), (lambda: fvi.run(time="2"), TypeError, "^time: "),
    (lambda: fvi.run(mass="heavy"), TypeError, "^mass: 'heavy'"), (lambda: fvi.run(x0=None), TypeError, "^x0: None"),
    (lambda: fvi.run(x0=[1, None]), TypeError, "^x0: None"), (lambda: fvi.run(p0=[[1], [2, 3]]), ValueError, "^p0"),
    (lambda: fvi.run(rho=1j), TypeError, "^rho: "), (lambda: fvi.run(error="small"), TypeError, "^error: "),
    (lambda: fvi.run(tolerance=None), TypeError, "^tolerance: "), (lambda: fvi.run(method=3), TypeError, "^method: 3"),
    (lambda: fvi.run(derivative=None), TypeError, "^derivative: "), (lambda: fvi.run(memory=[]), TypeError, "^memory"),
    (lambda: fvi.run(memory="fft"), ValueError, "^memory: .*direct.*exponentials"),
    (lambda: fvi.run(columns=["t"]), TypeError, "^columns: "), (lambda: fvi.run("k*x", let=3), TypeError, "^let: 3"),
    (lambda: fvi.run("k*x", let={"k": "2"}), TypeError, "^let: k: '2'"),
    (lambda: fvi.run("k*x", let={1: 2}), TypeError, "^let: "), (lambda: fvi.run("duffing:1,g"), ValueError, "^poten"),
    (lambda: fvi.Stepper().step(-1), ValueError, "^count: "), (lambda: fvi.Stepper().step(1.5), ValueError, "^count"),
    (lambda: fvi.fit("t", [1]), TypeError, "^t: 't'"), (lambda: fvi.fit([1], [1], which=["rho"]), TypeError, "^which"),
    (lambda: fvi.fit([1, 2], [1, None]), TypeError, "^x: None"), (lambda: fvi.exact(None), TypeError, "^t: None"),
    (lambda: fvi.exact(1, force=[1]), TypeError, "^force: "), (lambda: fvi.exact(1, x0="a"), TypeError, "^x0: "),
    (lambda: fvi.weights("a", 3), TypeError, "^order: "), (lambda: fvi.weights(0.5, 2.5), ValueError, "^count: "),
    (lambda: fvi.potential(abs, abs, abs, diagonals="1"), TypeError, "^diagonals: "),
    (lambda: fvi.run(force=lambda t: None), TypeError, "^force gave None, not a number"),
    (lambda: fvi.run(force=lambda t: None, x0=[1, 2]), TypeError, "^force gave None"),
])
def test_a_wrong_argument_is_named(call, what, why):
    with pytest.raises(what, match=why):
        call()


# ---- what could have ended a process ----

LONG = {
    "run": "fvi.run(alpha=0.3, steps=2 * 10**7, columns='x')",
    "direct": "fvi.run(alpha=0.3, memory='direct', steps=10**6, columns='x')",
    "stages": "fvi.run(alpha=0.3, method='fvi-lobatto4', steps=10**7, columns='x')",
    "masses": "fvi.run('chain:2000,1,0.1', x0=1, p0=0, alpha=0.3, method='fvi', steps=10**5, columns='t')",
    "adaptive": "fvi.run(alpha=0.3, method='fvi-adaptive', force='sin(1e5*t)', time=1e6, steps=3)",
    "stepper": "s = fvi.Stepper(steps=10**9); print('.', flush=True); s.step(10**9)",
    "search": "fvi.run(alpha=0.3, error=1e-13, method='fvi', steps=1000)",
    "fit": "t = np.arange(1, 20001) * 0.01; fvi.fit(t, np.cos(t) + 0.1 * np.sin(99 * t), 'x^4/4 + x^2/2', starts=2000)",
    "exact": "fvi.exact(np.random.default_rng(1).uniform(0, 9, 10**6), alpha=0.3)",
    "grid": "fvi.exact(grid, alpha=0.3)",
    "own": "fvi.run(force=lambda t: 0.0, steps=10**7, columns='t')",
}


@pytest.mark.parametrize("name", LONG)
def test_an_interrupt_ends_what_lasts(name):
    """Seen: less than 0.1 s. Allowed is what a machine with other work takes as well.

    After 0.2 s each call is at its long work. Only "run" still fills its array of 160 MB then, so it gets 0.4 s.
    """
    script = textwrap.dedent(f"""
        import time
        import fvi
        import numpy as np
        grid = {"1e-4 * np.arange(2 * 10**7)" if name == "grid" else None}
        print("begun", flush=True)
        try:
            {LONG[name]}
            print("over", flush=True)
        except KeyboardInterrupt:
            print("interrupted", flush=True)
        assert fvi.run(steps=10).x.shape == (11,)  # and nothing is left of it
        print("well", flush=True)
    """)
    # A shell lets what it starts with & ignore the signal; Python would then take it for nothing.
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    try:
        assert process.stdout.readline() == "begun\n"
        time.sleep(0.4 if name == "run" else 0.2)
        sent = time.monotonic()
        process.send_signal(signal.SIGINT)
        rest, _ = process.communicate(timeout=60)
        assert rest.replace(".\n", "") == "interrupted\nwell\n"
        assert time.monotonic() - sent < 2
        assert process.wait() == 0
    finally:
        process.kill()
        process.wait()


def test_an_array_that_a_function_keeps_stays():
    kept = []

    def gradient(x):
        kept.append(x)
        return x.copy()

    run = fvi.run(fvi.potential(lambda x: x @ x / 2, gradient, lambda x: np.eye(2)), x0=[1, 2], p0=[0, 0],
                  method="euler-explicit", steps=50)
    fvi.run(x0=np.full(2, 7.0), p0=[0, 0])  # where the arrays of the first run were
    assert all(x.base is None for x in kept)
    assert all(any(np.array_equal(x, row) for x in kept) for row in run.x[:50])


def test_threads_may_share_a_stepper():
    """They step it, reset it, fork it and look at it: seconds of that have to leave a run that is right."""
    script = textwrap.dedent("""
        import threading
        import time
        import fvi
        s = fvi.Stepper("chain:30,1,0.1", x0=1, p0=0, alpha=0.3, steps=10**9)
        end = time.monotonic() + 1.5
        wrong = []

        def work(what):
            while time.monotonic() < end:
                try:
                    what()
                except Exception as error:
                    wrong.append(repr(error))

        def fork():
            c = s.copy()
            c.step(2)

        jobs = [lambda: s.step(5), s.reset, lambda: (s.x, s.p), fork, lambda: s.step(3), s.reset]
        threads = [threading.Thread(target=work, args=(job,)) for job in jobs]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert not wrong, wrong[0]
        s.reset()
        s.step(20)
        assert (s.x == fvi.run("chain:30,1,0.1", x0=1, p0=0, alpha=0.3, steps=20).x[20]).all()
    """)
    assert subprocess.run([sys.executable, "-c", script], timeout=60).returncode == 0


@pytest.mark.parametrize("act", ["s.step()", "s.reset()", "s.copy()"])
def test_a_stepper_is_not_touched_by_what_it_asks(act):
    s = None
    with pytest.raises(RuntimeError, match="under way"):
        s = fvi.Stepper(force=lambda t: eval(act, {"s": s}) or 0.0 if s else 0.0)
        s.step()
    assert s.x is not None


def test_threads_run_while_the_main_thread_runs():
    """A run in another thread is not ended by what ends one here, and its exceptions are its own."""
    raised = []

    def work():
        try:
            fvi.run(force=lambda t: 1 / 0)
        except ZeroDivisionError as error:
            raised.append(error)
    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    assert np.isfinite(fvi.run(force=lambda t: 0.0, steps=2000).x).all()
    for thread in threads:
        thread.join()
    assert len(raised) == 4


def test_the_examples_in_the_package_are_true():
    found = doctest.testmod(fvi)
    assert found.attempted >= 4 and found.failed == 0


def test_each_keyword_is_explained():
    for function in (fvi.run, fvi.exact, fvi.fit, fvi.weights, fvi.potential):
        words = set(re.findall(r"\w+", function.__doc__))
        names = [name for name, p in inspect.signature(function).parameters.items() if p.kind != p.VAR_KEYWORD]
        assert not [name for name in names if name not in words]
    with pytest.raises(TypeError, match="there are (.*)$") as caught:
        fvi.run(qqqqq=1)
    names = str(caught.value).partition("there are ")[2].split(", ")
    words = set(re.findall(r"\w+", fvi.run.__doc__))
    assert len(names) > 15 and not [name for name in names if name not in words]
