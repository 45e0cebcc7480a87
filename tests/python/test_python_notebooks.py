"""The notebooks of the twelve weeks: they have no outputs, and their code prints the numbers of the chapters."""
import contextlib
import io
import json
import pathlib
import re
import sys
import warnings
from unittest import mock

import fvi
import numpy  # noqa: F401  (before the notebooks do)
import pytest

FOLDER = pathlib.Path("chapters/notebooks")
BOOKS = sorted(FOLDER.glob("*.ipynb"))
SAYS = {  # what the chapters say, in the order in which it is printed
    "01": ["x(2.8) = -0.322346493690021", "0.417", "0.111", "x(2.8) = -0.322346493690021"],
    "02": ["-0.5000  -0.1250  -0.0625", "1.093750", "-0.034629", "-0.000034", "1. -1.  0.  0."],
    "03": ["2.1964e+08", "10877", "3.6942", "0.026", "0.026", "0.055", "0.0262", "0.0115", "0.0029"],
    "04": ["-1.73469391   -1.73466430", "-1.67178436   -1.67178436", "-1.66130427", "0.183400"],
    "05": ["largest residual is 1e+00"], "06": ["-0.09766", "-0.103182496877", "0.016974593838", "0.367694673518"],
    "07": ["0.13994  0.14407  0.14531  0.14564  0.14572", "-0.31562", "0.53100", "17.61106", "no solution"],
    "08": ["-0.04987531172070, difference -0.04987531172070", "0.054683", "0.021065", "0.002279", "0.000020"],
    "09": ["0.017005", "0.001266", "order 0.940", "0.984", "-0.423552", "-0.453763"],
    "10": ["2.000", "0.949 0.975 0.988 0.994", "load 0.9649", "load 1.0119", "unstable"],
    "11": ["lag    33: weight -1.50525384", "20000 steps, direct", "0.0568774160073", "0.0568774160073", "0.056855735875"],
    "12": ["0.05685529300399696", "error 3.3e-03", "error 1.7e-05", "error 2.1e-03", "error 3.2e-08", "by alpha"],
}


def test_there_is_one_for_each_chapter():
    chapters = {path.stem for path in pathlib.Path("chapters").glob("[01][0-9]-*.md")}
    assert {path.stem for path in BOOKS} == chapters and {stem[:2] for stem in chapters} == set(SAYS)


@pytest.mark.parametrize("path", BOOKS, ids=[path.stem for path in BOOKS])
def test_a_notebook_is_committed_without_outputs(path):
    book = json.loads(path.read_text())
    assert path.read_text() == json.dumps(book, indent=1, ensure_ascii=False) + "\n"
    code = [cell for cell in book["cells"] if cell["cell_type"] == "code"]
    assert book["nbformat"] == 4 and len(code) >= 2
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in code)
    text = "".join(line for cell in book["cells"] if cell["cell_type"] == "markdown" for line in cell["source"])
    for target in re.findall(r"\]\(([^)]+)\)", text):
        assert (FOLDER / target).exists(), target


@pytest.mark.parametrize("path", BOOKS, ids=[path.stem for path in BOOKS])
def test_a_notebook_prints_what_the_chapter_says(path):
    """Without Jupyter, and without pictures."""
    printed, space, plots = io.StringIO(), {"__name__": "__main__"}, mock.MagicMock()
    with mock.patch.dict(sys.modules, {"matplotlib": plots, "matplotlib.pyplot": plots.pyplot}), warnings.catch_warnings(), \
            contextlib.redirect_stdout(printed):
        warnings.simplefilter("ignore", fvi.FviWarning)
        for cell in json.loads(path.read_text())["cells"]:
            if cell["cell_type"] == "code":
                exec(compile("".join(cell["source"]), path.name, "exec"), space)
    rest = printed.getvalue()
    for want in SAYS[path.stem[:2]]:
        assert want in rest, (want, printed.getvalue())
        rest = rest.partition(want)[2]
