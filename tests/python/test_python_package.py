"""The Python package: its wheel, and its types."""
import os
import pathlib
import re
import subprocess
import sys
import textwrap
import zipfile

import fvi
import pytest

HERE = pathlib.Path(fvi.__file__).resolve().parent


def wheel():
    found = list(HERE.parent.parent.glob("fvi-*.whl"))
    if len(found) != 1:
        pytest.skip("the wheel is not beside the package")
    return zipfile.ZipFile(found[0])


def test_the_wheel_says_what_it_is():
    names = wheel().namelist()
    meta = wheel().read(next(n for n in names if n.endswith("METADATA"))).decode()
    assert re.search(r"^Version: " + re.escape(fvi.version()) + "$", meta, re.M)
    assert set(re.findall(r"^Requires-Dist: (\w+)(?!.*extra)", meta, re.M)) == {"cffi", "numpy"}
    assert re.search(r"^Requires-Python: >=3.10$", meta, re.M) and "Typing :: Typed" in meta
    assert "fvi.Problem" in meta.partition("\n\n")[2]  # the page
    assert "-cp310-abi3-" in wheel().filename
    assert {"fvi/py.typed", "fvi/_fvi.pyi", "fvi/program", "fvi/torch.py"} <= set(names)


def test_what_is_loaded_travels_in_the_wheel():
    """No shared object that is loaded for fvi alone comes from the system, but for C's own."""
    script = "import numpy; a = open('/proc/self/maps').read(); import fvi; print(a, '=====', open('/proc/self/maps').read())"
    text = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout
    before, after = ({line.split()[-1] for line in part.splitlines() if ".so" in line} for part in text.split("====="))
    foreign = {path for path in after - before if not path.startswith(str(HERE))}
    assert not [path for path in foreign if re.search(r"gsl|cholmod|umfpack|amd|metis|lapack", path)]


def test_the_package_has_types(tmp_path):
    pytest.importorskip("mypy")
    own = tmp_path / "own.py"
    own.write_text(textwrap.dedent("""
        import fvi
        problem = fvi.Problem("duffing:1,0.5", alpha=0.3)
        s = fvi.solve(problem, error=1e-6)
        reveal_type(s)
        reveal_type(s.x)
        fvi.solve(problem, h="0.1")
        fvi.Problem(alpha=[1])
    """))
    run = subprocess.run([sys.executable, "-m", "mypy", "--python-version", "3.11", "--cache-dir", str(HERE.parent.parent / "mypy"), str(own)],
                         capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(HERE.parent)}, cwd=tmp_path)
    assert 'Revealed type is "fvi._solution.Solution"' in run.stdout and "numpy.ndarray" in run.stdout
    wrong = [line for line in run.stdout.splitlines() if "error:" in line]
    assert len(wrong) == 2 and 'Argument "h"' in wrong[0] and 'Argument "alpha"' in wrong[1], run.stdout


def test_the_sources_agree_with_their_types():
    pytest.importorskip("mypy")
    run = subprocess.run([sys.executable, "-m", "mypy", "--python-version", "3.11", "--cache-dir",
                          str(HERE.parent.parent / "mypy"), "src/python/fvi"],
                         capture_output=True, text=True)
    assert run.returncode == 0, run.stdout
