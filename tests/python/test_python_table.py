"""The Python package: columns, reductions, checkpoints, and the report that is made of them."""
import os
import pathlib
import re
import subprocess
import sys

import fvi
import numpy as np
import pytest
from fvi import _checkpoint

PROGRAM = str(pathlib.Path(os.environ.get("FVI", "build/fvi")).resolve())
FRAME = fvi.Problem("k*x1^2/2 + k*(x2-x1)^2/2", let={"k": 100}, rho=[5, 0], order=0.6, ground="sin(8*t)", x0=0, p0=0, time=10)
OF_FRAME = ["--potential", "k*x1^2/2 + k*(x2-x1)^2/2", "--let", "k=100", "--rho", "5,0", "--order", "0.6", "--x0", "0",
            "--p0", "0", "--time", "10", "--h", "0.02", "--method", "fvi-lobatto4", "--ground", "sin(8*t)"]
HOW = {"h": 0.02, "method": "fvi-lobatto4"}


def program(*words):
    text = subprocess.run([PROGRAM, "run", *words, "--format", "csv"], check=True, capture_output=True, text=True).stdout
    return text.splitlines()


# ---- columns ----

def test_columns_are_the_programs():
    columns = "t,drift=x2-x1,floor=a2+ag,d1.force1,work,balance,F1,energy,p2,d1.impulse1"
    names, *rows = program(*OF_FRAME, "--columns", columns)
    table = fvi.solve(FRAME, **HOW).table(columns)
    assert list(table) == names.split(",") and np.array_equal(np.column_stack(list(table.values())), np.loadtxt(rows, delimiter=","))
    few = fvi.solve(FRAME, [0.5, 2.0], **HOW).table("t,drift=x2-x1")
    assert np.array_equal(few["t"], [0.5, 2.0]) and np.array_equal(few["drift"], table["drift"][[25, 100]])


def test_reductions_are_the_programs():
    reductions = "peak(x2-x1),at(peak(x2-x1)),rms(a2+ag),last(work),when=at(max(x1)),mean(v2),min(x2),absmax(d1.force1)"
    names, row = program(*OF_FRAME, "--reduce", reductions)
    found = fvi.solve(FRAME, **HOW).reduce(reductions)
    assert ",".join(found) == names and list(found.values()) == [float(v) for v in row.split(",")]
    again = fvi.solve(FRAME, **HOW).reduce("peak(drift)", "drift=x2-x1")
    assert again == {"peak(drift)": found["peak(x2-x1)"]}


def test_columns_of_other_problems():
    arm = fvi.Problem(lagrangian="v1^2 + v2^2/2 + v1*v2*cos(x1 - x2) + 9.81*(2*cos(x1) + cos(x2))", x0=[2, 2.5], v0=[0, 0],
                      dampers=["elbow=x2 - x1 : power:0.5,0.25"], time=2)
    s = fvi.solve(arm, h=0.01, method="fvi-lobatto4")
    table = s.table("x1,elbow.force,elbow.work,v2")
    assert np.array_equal(table["elbow.force"], s.forces["elbow"][:, 0]) and np.array_equal(table["v2"], s.v[:, 1])
    frame = fvi.Problem(M=np.eye(2), K=[[200, -100], [-100, 100]], C=np.diag([5.0, 0]), order=0.6, ground="sin(8*t)", time=5)
    s = fvi.solve(frame, h=0.01)
    assert np.array_equal(s.table("d1.force1")["d1.force1"], s.forces["d1"][:, 0])
    assert np.array_equal(s.table("a2+ag")["a2+ag"], s.a[:, 1] + s.ag)
    one = fvi.solve(fvi.Problem(time=5), h=0.1)
    assert list(one.table("x,v")) == ["x", "v"] and one.reduce("first(x)") == {"first(x)": 1.0}


@pytest.mark.parametrize("call, what, why", [
    (lambda s: s.table("x3"), ValueError, "^columns: 'x3' is none of"), (lambda s: s.table(3), TypeError, "^columns: 3"),
    (lambda s: s.reduce("pek(x1)"), ValueError, "did you mean peak"), (lambda s: s.reduce(None), TypeError, "^reduce: None"),
    (lambda s: s.table("q=x1,q=x2"), ValueError, "given to two columns"),
])
def test_a_wrong_column_is_named(call, what, why):
    with pytest.raises(what, match=why):
        call(fvi.solve(FRAME, **HOW))


# ---- checkpoints ----

class Stopped(Exception):
    pass


DUFFING = fvi.Problem("duffing:1,0.5", alpha=0.3, rho=0.4, force="cosine:1,2", time=100)


@pytest.mark.parametrize("problem, options", [
    (FRAME, HOW), (DUFFING, dict(h=0.01)), (DUFFING, dict(h=0.01, method="fvi-bdf2")), (DUFFING, dict(steps=3000)),
    (DUFFING.replace(force=(np.array([0.0, 50, 100]), np.array([0.0, 1, 0]))), dict(t_eval=np.arange(0, 100, 0.25), h=0.01)),
    (fvi.Problem(lagrangian="v^2/2 - x^4/4", x0=1, v0=0, time=20), dict(h=0.01)),
    (fvi.Problem("9.81*x", rho=0.05, alpha=0.3, x0=1, p0=0, time=3), dict(events=["x : impact:0.8", "v : mark"])),
    (fvi.Problem("9.81*x", rho=0.05, alpha=0.3, x0=1, p0=0, time=9), dict(events="x : impact:0.8", steps=3000)),  # at rest
    (fvi.Problem(lagrangian="v^2/2 - x^4/4", x0=1, v0=0, time=20), dict(events=[fvi.Event("x - 0.5"), "v : mark", "x + t - 14 : stop"])),
    (fvi.Problem(M=np.eye(2), K=[[2, -1], [-1, 1]], C=np.eye(2), force="cosine:1,2", time=20), dict(h=0.01)),
])
def test_a_motion_that_was_stopped_goes_on(problem, options, tmp_path, monkeypatch):
    """To the bit, wherever it was stopped; and what is done is not done again."""
    whole, path, save = fvi.solve(problem, **options), tmp_path / "state", _checkpoint.Checkpoint.save
    monkeypatch.setattr(_checkpoint, "SECONDS", 0.0)  # it is written at every 64th step
    written = []

    def save_and_stop(self, stepper, x, p, happened):
        save(self, stepper, x, p, happened)
        written.append(len(x))
        if len(written) in (1, 3, 4):
            raise Stopped
    monkeypatch.setattr(_checkpoint.Checkpoint, "save", save_and_stop)
    for n in range(3):
        with pytest.raises(Stopped):
            fvi.solve(problem, **options, checkpoint=path)
    assert len(written) == 4 and written == sorted(written) and written[-1] < len(whole.t)
    s = fvi.solve(problem, **options, checkpoint=path)
    assert np.array_equal(s.x, whole.x) and np.array_equal(s.p, whole.p) and s.steps == whole.steps and s.message == whole.message
    for name in ("t_events", "x_events", "p_events"):
        assert all(map(np.array_equal, getattr(s, name), getattr(whole, name)))
    monkeypatch.setattr(_checkpoint.Checkpoint, "save", None)  # nothing is left to do
    again = fvi.solve(problem, **options, checkpoint=str(path))
    assert np.array_equal(again.x, whole.x) and all(map(np.array_equal, again.x_events, whole.x_events)) and again.message == whole.message
    assert [each.name for each in tmp_path.iterdir()] == ["state"]


def test_a_checkpoint_of_another_motion_is_refused(tmp_path):
    path = tmp_path / "state"
    fvi.solve(DUFFING, h=0.1, checkpoint=path)
    for problem, options in ((DUFFING.replace(rho=0.41), dict(h=0.1)), (DUFFING, dict(h=0.2)), (DUFFING, dict(h=0.1, method="fvi-bdf2"))):
        with pytest.raises(ValueError, match="^checkpoint: .* is of another motion"):
            fvi.solve(problem, **options, checkpoint=path)
    own = fvi.potential(lambda x: x * x / 2, lambda x: x, lambda x: 1)
    other = fvi.potential(lambda x: x * x / 2, lambda x: x + 0, lambda x: 1)
    path.unlink()
    fvi.solve(fvi.Problem(own), h=0.1, checkpoint=path)
    with pytest.raises(ValueError, match="is of another motion"):
        fvi.solve(fvi.Problem(other), h=0.1, checkpoint=path)
    path.write_text("no zip")
    with pytest.raises(ValueError, match="^checkpoint: .* is no checkpoint"):
        fvi.solve(DUFFING, h=0.1, checkpoint=path)
    with pytest.raises(ValueError, match="^checkpoint: not together with error"):
        fvi.solve(DUFFING, checkpoint=path, error=1e-3)
    with pytest.raises(ValueError, match="^checkpoint: of one motion"):
        fvi.sweep(DUFFING, {"rho": [1, 2]}, h=0.1, checkpoint=path)
    with pytest.raises(TypeError, match="fvi.solve takes it"):
        fvi.Problem(checkpoint=path)


@pytest.mark.parametrize("t, why", [([0.25], "multiples of h"), ([2, 1], "must increase"), ([1, 101], "must be in .0, "),
                                    ([float("nan")], "must be in .0, ")])
def test_times_of_a_checkpoint_are_those_of_the_method(t, why, tmp_path):
    with pytest.raises(ValueError, match="^t_eval: t.* " + why):
        fvi.solve(DUFFING, t, h=0.1, checkpoint=tmp_path / "state")
    with pytest.raises(fvi.Error, match=why):  # without a checkpoint the library says it
        fvi.solve(DUFFING, t, h=0.1)


def test_a_checkpoint_that_cannot_be_written_says_so(tmp_path):
    with pytest.raises(OSError):
        fvi.solve(DUFFING, h=0.1, checkpoint=tmp_path / "none" / "state")


# ---- the report ----

def test_the_report_has_the_numbers_of_the_shell(tmp_path):
    """tests/example/report.py beside the commands of the page on reports."""
    page = pathlib.Path("chapters/handbook/reports.md").read_text().partition("## The whole report")[2]
    want = np.loadtxt(re.search(r"```text\n(order,.*?)```", page, re.S)[1].splitlines()[1:], delimiter=",")
    (tmp_path / "build").mkdir()
    quake = re.search(r"printf '(.*?)' > build/quake.csv", pathlib.Path("chapters/handbook/reports.md").read_text())[1]
    (tmp_path / "build" / "quake.csv").write_text(quake.replace("\\n", "\n"))
    script = pathlib.Path("tests/example/report.py").resolve()
    lines = re.search("#> example\n(.*)#< example", script.read_text(), re.S)[1].splitlines()
    assert len(lines) <= 25
    for _ in range(2):  # the second time it goes on with the first one's rows
        run = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, cwd=tmp_path,
                             env={**os.environ, "PYTHONPATH": str(pathlib.Path(fvi.__file__).parents[1]), "MPLBACKEND": "svg"})
        assert run.returncode == 0, run.stderr
        got = np.loadtxt(run.stdout.splitlines()[1:5], delimiter=",")
        assert got.shape == want.shape and abs(got - want).max() < 1e-9  # the page's numbers are compared with the program's elsewhere
    spectrum = subprocess.run([PROGRAM, "sweep", "--vary", "T=0.05:2:40:log", "--potential", "(2*pi/T)^2*x^2/2", "--order", "0.6",
                               "--rho", "0.5", "--x0", "0", "--p0", "0", "--ground", "9.81*file:build/quake.csv:time,acc", "--method",
                               "fvi-stable", "--h", "0.005", "--time", "10", "--reduce", "absmax(a+ag),absmax(x)"],
                              capture_output=True, text=True, check=True, cwd=tmp_path).stdout
    want = np.array([line.split("\t") for line in spectrum.splitlines() if line[0] != "#"], dtype=float)
    got = np.loadtxt(tmp_path / "build" / "spectrum.csv", delimiter=",", skiprows=1)
    assert got.shape == want.shape and (abs(got - want) <= 1e-9 * abs(want)).all()
    floors = program("--potential", "k*x1^2/2 + k*(x2-x1)^2/2", "--let", "k=100", "--rho", "5,0", "--order", "0.6", "--x0", "0", "--p0", "0",
                     "--time", "10", "--h", "0.02", "--method", "fvi-lobatto4", "--ground", f"9.81*file:{tmp_path}/build/quake.csv:time,acc",
                     "--columns", "t,drift=x2-x1,floor=a2+ag,force=d1.force1,work,balance")
    made = (tmp_path / "build" / "floors.csv").read_text().splitlines()
    assert made[0] == floors[0] and np.array_equal(np.loadtxt(made[1:], delimiter=","), np.loadtxt(floors[1:], delimiter=","))
    assert (tmp_path / "build" / "hysteresis.svg").stat().st_size > 1000
