"""A notebook from a script with cells, executed: build.py SCRIPT.py OUT.ipynb

In the script "# %%" begins a cell of code, "# %% [markdown]" one of text. Each cell is run, in one
namespace; what it prints, and what its last expression is, stands below it in the notebook: as a
picture, if it can draw itself. A cell that raises ends all, and nothing is written."""
import ast
import contextlib
import io
import json
import pathlib
import re
import sys


def run(code, space):
    """The outputs of a cell."""
    tree = ast.parse(code)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed, value = io.StringIO(), None
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "cell", "exec"), space)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), space)
    outputs = []
    if printed.getvalue():
        outputs.append({"output_type": "stream", "name": "stdout", "text": printed.getvalue().splitlines(True)})
    if value is not None:
        data = {"text/plain": [object.__repr__(value).split(" at ")[0] + ">" if hasattr(value, "_repr_svg_") else repr(value)]}
        if hasattr(value, "_repr_svg_"):
            data["image/svg+xml"] = value._repr_svg_().splitlines(True)
        outputs.append({"output_type": "execute_result", "data": data, "metadata": {}})
    return outputs


def build(text):
    space, cells = {"__name__": "__main__"}, []
    for n, piece in enumerate(re.split(r"^# %%", text, flags=re.M)[1:]):
        kind, _, body = piece.partition("\n")
        body = body.strip("\n")
        if "markdown" in kind:
            cell = {"cell_type": "markdown", "source": re.sub(r"^# ?", "", body, flags=re.M).splitlines(True)}
        else:
            count = 1 + sum(c["cell_type"] == "code" for c in cells)
            outputs = run(body, space)
            for output in outputs:
                if output["output_type"] == "execute_result":
                    output["execution_count"] = count
            cell = {"cell_type": "code", "execution_count": count, "outputs": outputs, "source": body.splitlines(True)}
        cells.append({"id": f"cell-{n}", "metadata": {}, **cell})
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return {"cells": cells, "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
            "nbformat": 4, "nbformat_minor": 5}


if __name__ == "__main__":
    script, out = map(pathlib.Path, sys.argv[1:])
    out.write_text(json.dumps(build(script.read_text()), indent=1, ensure_ascii=False) + "\n")
