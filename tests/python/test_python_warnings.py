"""The Python package: what the program says with `fvi: warning:`, Python says by warnings.warn."""
import os
import subprocess
import warnings

import fvi
import pytest

PROGRAM = os.environ.get("FVI", "build/fvi")


def said_by_the_program(*words):
    text = subprocess.run([PROGRAM, *words], check=True, capture_output=True, text=True).stderr
    return [line.removeprefix("fvi: warning: ") for line in text.splitlines() if line.startswith("fvi: warning: ")]


def said_by(call):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call()
    assert all(each.category is fvi.FviWarning and each.filename == __file__ for each in caught)
    return [str(each.message) for each in caught]


STIFF = ["--potential", "harmonic:100", "--h", "0.5", "--steps", "4", "--kappa", "1", "--method", "fvi"]
STIFFER = ["--potential", "pendulum:1", "--x0", "1.5", "--p0", "0", "--rho", "0.05", "--h", "2.5", "--steps", "20",
           "--kappa", "1", "--method", "fvi"]
NO_SOLUTION = ["--derivative", "rl", "--alpha", "0.7", "--h", "0.1", "--steps", "4", "--method", "fvi"]
PENDULUM = fvi.Problem("pendulum:1", x0=1.5, p0=0, rho=0.05, time=50)


@pytest.mark.parametrize("call, words", [
    (lambda: fvi.solve(fvi.Problem("harmonic:100", time=2), h=0.5, kappa=1), ["run", *STIFF]),
    (lambda: fvi.run("harmonic:100", h=0.5, steps=4, kappa=1), ["run", *STIFF]),
    (lambda: fvi.Stepper("harmonic:100", h=0.5, steps=4, kappa=1), ["run", *STIFF]),
    (lambda: fvi.control(fvi.Problem("harmonic:100", time=2), 0, 0, h=0.5, kappa=1, method="fvi"), ["run", *STIFF]),
    (lambda: fvi.solve(PENDULUM, h=2.5, kappa=1), ["run", *STIFFER]),
    (lambda: fvi.solve(PENDULUM, [7.5], h=2.5, kappa=1), ["run", *STIFFER]),
    (lambda: fvi.solve(fvi.Problem(past="rl", alpha=0.7, time=0.4), h=0.1), ["run", *NO_SOLUTION]),
    (lambda: fvi.control(fvi.Problem(past="rl", alpha=0.7, time=0.4), 0, 0, h=0.1, method="fvi"), ["run", *NO_SOLUTION]),
    (lambda: fvi.solve(fvi.Problem(time=2), h=0.1, method="lda", memory="exponentials"),
     ["run", "--steps", "20", "--method", "lda", "--memory", "exponentials"]),
    (lambda: fvi.solve(fvi.Problem(time=2), error=1e-3, tolerance=1e-6), ["run", "--error", "1e-3", "--tolerance", "1e-6"]),
    (lambda: fvi.run(memory="direct", tolerance=1e-6), ["run", "--memory", "direct", "--tolerance", "1e-6"]),
    (lambda: fvi.run(error=1e-3, tolerance=1e-6), ["run", "--error", "1e-3", "--tolerance", "1e-6"]),
    (lambda: fvi.Stepper(method="fvi-adaptive", tolerance=1e-6), ["run", "--method", "fvi-adaptive", "--tolerance", "1e-6"]),
    (lambda: fvi.poles(fvi.Problem("pendulum:1")), ["poles", "--potential", "pendulum:1", "--x0", "1"]),
    (lambda: fvi.response(fvi.Problem("pendulum:1"), 1), ["response", "--omega", "1", "--potential", "pendulum:1", "--x0", "1"]),
    (lambda: fvi.poles(fvi.Problem("chain:3,1,0", x0=0), 2), ["poles", "--potential", "chain:3,1,0", "--count", "2"]),
    (lambda: fvi.poles(fvi.Problem(rho=5)), ["poles", "--rho", "5"]),
])
def test_a_warning_of_the_program_is_one_of_python(call, words):
    said = said_by_the_program(*words)
    assert len(said) == 1 and said_by(call) == said


def test_a_fit_warns_of_a_memory_that_its_method_does_not_read():
    t, x = fvi.run(method="lda", steps=40)[:2]
    said = said_by_the_program("fit", "--design", "--fit", "rho", "--sigma", "0.1", "--method", "lda", "--memory", "exponentials")
    assert len(said) == 1
    assert said[0] in said_by(lambda: fvi.fit(t, x, which="rho", method="lda", memory="exponentials"))
    assert said[0] not in said_by(lambda: fvi.fit(t, x, which="rho", method="lda", memory="direct"))


def test_of_times_of_ones_own_only_these_are_looked_at():
    assert said_by(lambda: fvi.solve(PENDULUM, [5], h=2.5, kappa=1)) == []


def test_a_sweep_warns_once_of_the_callers_line():
    """The program counts the rows, too: "rows with an unstable step: 2 of 3, the first with rho = 0.2"."""
    q = fvi.Problem("harmonic:1", alpha=0.5, time=40)
    said = said_by(lambda: fvi.sweep(q, {"rho": [0.01, 8, 9]}, lambda s: 0, h=1, jobs=2))
    assert len(said) == 1 and said[0].startswith("2 of 3 motions, the first with rho = 8: this step is unstable")
    words = ["sweep", "--potential", "harmonic:1", "--time", "40", "--h", "1", "--method", "fvi", "--vary", "rho=0.01,8,9"]
    assert said_by_the_program(*words) == ["rows with an unstable step: 2 of 3, the first with rho = 8"]
    assert said_by(lambda: fvi.solve(q.replace(rho=8), h=1)) == [said[0].partition(": ")[2]]  # as ever behind a sweep
    past = fvi.Problem(past="rl", alpha=0.7, time=0.4)
    assert len(said_by(lambda: fvi.sweep(past, {"rho": [1, 2]}, lambda s: 0, h=0.1))) == 1
