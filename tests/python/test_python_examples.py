"""The gallery: each example is at most twenty lines, runs, and says what it should."""
import os
import pathlib
import re
import subprocess
import sys

import pytest

EXAMPLES = pathlib.Path("tests/example")
SAYS = {  # numbers in the order in which they are printed, and how far each may be off
    "first": [(-0.006354, 2e-6)],
    "gradient": [(-0.2385, 1e-4), (0.4668, 1e-4), (0.0220, 1e-4)],
    "motion_for_jax": [(0.0938, 1e-4)],
    "duffing_spectrum": [(0.6, 0), (0.464, 0.002), (1.8, 0), (0.229, 0.002), (3, 0), (0.034, 0.002)],
    "building": [(0.46, 0.01), (0.019, 0.002), (0.189, 0.002), (120.4, 0.5), (57.4, 0.5), (217.8, 0.5)],
    "moduli": [(2, 0.03), (95, 0), (2, 0.05), (2, 0.05), (1.5, 0.03), (95, 0), (1.5, 0.05), (1.5, 0.05), (0.3, 0.004),
               (95, 0), (0.3, 0.01), (0.3, 0.01), (0.435, 0.01)],
    "fit_motion": [(0.3, 0.01), (95, 0), (0.3, 0.02), (0.3, 0.02), (0.4, 0.01), (95, 0), (0.4, 0.02), (0.4, 0.02),
                   (1, 0.02), (95, 0), (1, 0.02), (1, 0.02)],
    "fit_torch": [(0.3, 0.02), (0.4, 0.02), (1, 0.02)],
    "sweep": [(0.3, 0), (1.13, 0.01), (1.15, 0.04), (0.7, 0), (1.15, 0.01), (1.04, 0.04)],
    "impact": [(0.4523, 1e-4), (3.5298, 1e-4), (1.1723, 1e-4), (2.8158, 1e-4), (1.7469, 1e-4), (2.2480, 1e-4), (0.8119, 1e-4),
               (0.6353, 1e-4), (0.319594, 1e-6), (32, 0)],
    "double_pendulum": [(16.024, 0.001), (-11.65, 0.01), (27.674, 0.01), (2.712, 0.01)],
}


@pytest.mark.parametrize("name", SAYS)
def test_an_example_says_what_it_should(name):
    for package in ("torch", "jax"):
        if name.endswith(package):
            pytest.importorskip(package)
    path = EXAMPLES / f"{name}.py"
    lines = re.search("#> example\n(.*)#< example", path.read_text(), re.S)[1].splitlines()
    assert len([line for line in lines if line and not line.startswith("import")]) <= 20
    run = subprocess.run([sys.executable, "-W", "ignore", str(path)], capture_output=True, text=True,
                         env={**os.environ, "PYTHONWARNINGS": "ignore"})
    assert run.returncode == 0, run.stderr
    numbers = [float(n) for n in re.findall(r"(?<![\w.(])-?\d+(?:\.\d+)?(?![\w)])", run.stdout)]
    assert len(numbers) >= len(SAYS[name])
    for got, (want, off) in zip(numbers, SAYS[name]):
        assert abs(got - want) <= off + 1e-9, (got, want, run.stdout)


def test_the_gallery_is_complete():
    assert {path.stem for path in EXAMPLES.glob("*.py")} == {*SAYS, "duffing", "report"}
