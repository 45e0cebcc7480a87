"""python -m fvi: the program, which the package brings along; `python -m fvi help` says what it does."""
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
program = HERE / "program"
if not os.access(program, os.X_OK):  # an archive that was unpacked by hand
    program.chmod(0o755)
others = os.environ.get("LD_LIBRARY_PATH")
os.environ["LD_LIBRARY_PATH"] = str(HERE) + (":" + others if others else "")
os.execv(program, ["fvi", *sys.argv[1:]])
