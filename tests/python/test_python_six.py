"""The commands of the manual's pages "Any Lagrangian" and "Impacts, stops and marks": they print what the manual shows,
and Python has the same digits."""
import os
import pathlib
import re
import shlex
import subprocess

import fvi
import numpy as np
import pytest

PROGRAM = os.environ.get("FVI", "build/fvi")
MANUAL = pathlib.Path("chapters/handbook/manual.md").read_text()
LISTS = {"damper": "dampers", "constraint": "constraints", "impose": "impose", "force-on": "force_on", "event": "events"}


def commands():
    """Of each command its words, and the lines that the manual shows below it."""
    pages = [MANUAL.split(f"\n## {name}\n")[1].split("\n## ")[0] for name in ("Any Lagrangian", "Impacts, stops and marks")]
    found = re.findall(r"```sh\nbuild/fvi run (.*?)```\n\n```text\n(.*?)```", "\n".join(pages), re.S)
    return [(shlex.split(words.split(" | ")[0].replace("\\\n", " ")), shown.splitlines()) for words, shown in found]


def options(words):
    """--name value ...; those that may be repeated are lists."""
    given = {}
    for name, value in zip(words[::2], words[1::2]):
        name = name.removeprefix("--")
        if name in LISTS:
            given.setdefault(name, []).append(value)
        else:
            given[name] = value
    return given


def numbers(text):
    return [float(v) for v in text.split(",")]


@pytest.mark.parametrize("words, shown", commands(), ids=lambda v: v[1][:24] if isinstance(v[0], str) else "")
def test_a_command_of_the_manual_is_python_too(words, shown):
    o = options(words)
    o.pop("plot", None)
    run = [word for name, value in o.items() for one in (value if isinstance(value, list) else [value])
           for word in (f"--{name}", one)]
    printed = subprocess.run([PROGRAM, "run", *run], check=True, capture_output=True, text=True).stdout.splitlines()
    assert [line for line in printed if not re.match("# [a-z0-9]* =", line)] == shown
    steps, every = int(o["steps"]), int(o.get("every", 1))
    h = float(o["h"]) if "h" in o else float(o["time"]) / steps
    fields = {LISTS[n]: o[n] for n in LISTS if n in o and n != "event"}
    fields |= {n: o[n] for n in ("lagrangian", "potential") if n in o}
    fields |= {n: numbers(o[n]) for n in ("x0", "v0", "p0") if n in o} | {n: float(o[n]) for n in ("alpha", "rho") if n in o}
    if "potential" in o:
        fields["x0"] = 1
        fields["p0"] = float(o["p0"])
    q = fvi.Problem(time=steps * h, **fields)
    how = {"events": o["event"], "steps": steps} if "event" in o else {"h": h, "method": o.get("method", "fvi-stable")}
    s = fvi.solve(q, **how)
    fvi_run = subprocess.run([PROGRAM, "run", *changed(run)], check=True, capture_output=True, text=True)
    rows = np.array([line.split("\t") for line in fvi_run.stdout.splitlines() if line[0] != "#"], dtype=float)
    assert np.array_equal(np.column_stack([s.x, s.p]), rows[:, 1:])
    if "event" in o:
        assert [line for line in shown if "event" in line] == [f"# event at t = {t!r} : x" for t in s.t_events[0]]


def changed(run):
    """All rows of x and p, with tabs between."""
    kept = [(a, b) for a, b in zip(run[::2], run[1::2]) if a not in ("--columns", "--every", "--format")]
    return [w for pair in kept for w in pair] + ["--columns", "t,x,p"]


def test_there_are_six_and_the_driven_cart():
    assert len(commands()) == 7
