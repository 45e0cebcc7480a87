"""Execute the notebooks of chapters/notebooks with Jupyter: notebooks.py OUT [NAME ...]   (make notebook)

What is written into the folder OUT has the outputs and the pictures. A cell that raises ends all with its words. The notebooks that are committed have
no outputs: tests/python/test_python_notebooks.py sees to it, and runs their code without Jupyter."""
import os
import pathlib
import sys

import nbclient
import nbformat

FOLDER = pathlib.Path("chapters/notebooks")

if __name__ == "__main__":
    os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # of the debugger of ipykernel, which warns of Debian's Python
    out, names = pathlib.Path(sys.argv[1]), sys.argv[2:]
    out.mkdir(parents=True, exist_ok=True)
    for path in sorted(FOLDER.glob("*.ipynb")):
        if names and path.stem not in names:
            continue
        book = nbformat.read(path, as_version=4)
        nbclient.NotebookClient(book, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(out)}}).execute()
        nbformat.write(book, out / path.name)
        print(out / path.name, flush=True)
