"""Prove with sympy, and compare the reference values.

    prove.py BUILD [--accept] STEM...     (make verify, verify-STEM, refs-STEM)

A script verify/ROOM/STEM.py proves, and prints BUILD/verify/STEM_ref.h, which must be the
committed header to the byte, or with --accept becomes it. BUILD/verify/STEM.ok names the
modules of verify/ that the script read: while nothing of them or of the header is newer,
the proof stands. sympy takes half a second to load, so it is loaded once, and each proof
is a child of that process."""
import gc
import importlib
import multiprocessing
import os
import pathlib
import runpy
import shutil
import sys
from multiprocessing.connection import wait

os.environ["SYMPY_CACHE_SIZE"] = "None"   # a proof is short: what sympy once found out it may keep
import mpmath                   # all three are here for the children, who find them loaded:
import sympy.physics.units      # simplify() would load this,
import sympy.tensor.tensor      # and a sum of expressions that

# To decide whether something is positive, say, sympy asks for other facts, in random order;
# where they stand in one order, what is mostly formulas takes a tenth less time. Whether it
# is 0 is asked of each product and slope: its parts decide, not 28 other facts, a tenth more.
facts = importlib.import_module("sympy.core.assumptions")
facts.shuffle = list.sort
facts._assume_rules.prereq["zero"] = set()

BUILD = pathlib.Path(sys.argv[1], "verify")
ACCEPT = "--accept" in sys.argv
STEMS = [word for word in sys.argv[2:] if word != "--accept"]


def script(stem):
    return next(pathlib.Path("verify").glob(f"*/{stem}.py"))


def committed(stem):
    """The header stands beside the tests, or the module, that read it."""
    found = [path for room in ("tests", "src") for path in pathlib.Path(room).glob(f"*/{stem}_ref.h")]
    return found[0] if found else pathlib.Path("tests", stem, f"{stem}_ref.h")


def stands(stem):
    """Has the proof been run on what there is?"""
    ok = BUILD / f"{stem}.ok"
    read = [pathlib.Path(line) for line in ok.read_text().split()] if ok.exists() else []
    needed = [*read, committed(stem)]
    return bool(read) and all(p.exists() and p.stat().st_mtime <= ok.stat().st_mtime for p in needed)


def prove(stem):
    """In a child: the script, its output, the verdict."""
    fresh, header = BUILD / f"{stem}_ref.h", committed(stem)
    with open(fresh, "w") as out:
        os.dup2(out.fileno(), sys.stdout.fileno())
    runpy.run_path(str(script(stem)), run_name="__main__")
    sys.stdout.flush()
    home = os.path.join(os.getcwd(), "verify", "")
    read = [m.__file__ for m in sys.modules.values() if (getattr(m, "__file__", None) or "").startswith(home)]
    if ACCEPT:
        shutil.copy(fresh, header)
    elif not header.exists() or fresh.read_bytes() != header.read_bytes():
        sys.exit(f"{script(stem)} no longer gives {header}; to accept: make refs-{stem}")
    names = sorted({str(script(stem)), *(os.path.relpath(path) for path in read)})
    (BUILD / f"{stem}.ok").write_text("\n".join(names) + "\n")
    print(f"proved: {script(stem)}, and {header} is what it gives", file=sys.stderr)


def main():
    BUILD.mkdir(parents=True, exist_ok=True)
    sys.path.insert(0, os.path.abspath("verify"))
    gc.disable()  # a proof is short: nothing is looked through for what is no longer used
    context, running, failed = multiprocessing.get_context("fork"), {}, []
    todo = [stem for stem in STEMS if ACCEPT or not stands(stem)]
    while todo or running:
        while todo and len(running) < (os.cpu_count() or 2):
            stem = todo.pop(0)
            child = context.Process(target=prove, args=(stem,))
            child.start()
            running[child.sentinel] = child, stem
        for sentinel in wait(running):
            child, stem = running.pop(sentinel)
            child.join()
            if child.exitcode:
                (BUILD / f"{stem}.ok").unlink(missing_ok=True)
                failed.append(stem)
    sys.exit(f"failed: {', '.join(failed)}" if failed else 0)


main()
