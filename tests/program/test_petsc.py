"""Ranks against one machine: build/fvi_petsc on 1, 2 and 4 ranks, build/fvi alone.

    test_petsc.py BUILD                                       (make petsc)

A membrane of 24 by 17 unknowns: masses that differ, the second difference as K, C = K/20
and a damper more, forces on two unknowns, so that no symmetry hides a row in a wrong place.
300 steps, so that the memory is the compressed one, by blocks. Then a grid of 17 by 24 that
PETSc's DMDA cuts, against its matrices in files. x and p at the end agree to 1e-13 of the
largest: conjugate gradients end at a residual of 1e-15 of the first, the condition of a
step's matrix is below 10, and fvi-stable lets no error of a step grow. Seen: 4e-15.

A run that was stopped and goes on gives the same bytes; a state that is not of such a run is
refused. A state takes the place of no other file, and a link to one stays a link."""
import math
import pathlib
import sys

from petsc_runs import BUILD, NX, NY, STEPS, fresh, grid_matrices, matrices, one_machine, petsc_vectors, ranks, refused, start

FOLDER, GRID = BUILD / "petsc", BUILD / "petsc_grid"
WORDS = {"alpha": "0.3", "h": "0.2", "steps": str(STEPS), "x0": "1", "p0": "0.25"}
OF_GRID = {**WORDS, "h": "0.01"}


def compare(what, want, count, end):
    got = petsc_vectors.read(end)
    if [len(vector) for vector in got] != [NX * NY, NX * NY]:
        sys.exit(f"petsc: {what}: not x and p")
    parts = [abs(a - b) / max(map(abs, whole)) for vector, whole in zip(got, want) for a, b in zip(vector, whole)]
    apart = max(parts) if all(map(math.isfinite, parts)) else math.inf
    print(f"petsc: {what}, {count} ranks and one machine are {apart:.1e} apart")
    if not apart <= 1e-13:
        sys.exit("petsc: too far")


fresh(FOLDER, matrices())
fresh(GRID, grid_matrices())
(FOLDER / "f.tsv").write_text("t f5 f200\n0 0 1\n20 2 -1\n60 -1 0.5\n")
want, of_grid = one_machine(FOLDER, WORDS), one_machine(GRID, OF_GRID)
state = FOLDER / "state"
for count in (1, 2, 4):
    whole = ranks(FOLDER / f"end_{count}.bin", count, "-system", FOLDER, **WORDS)
    compare("a folder", want, count, whole)
    bytes_of_whole = whole.read_bytes()
    ranks(FOLDER / f"end_{count}.bin", count, "-system", FOLDER, "-checkpoint", state, "-stop", "123", **WORDS)
    if ranks(FOLDER / f"end_{count}.bin", count, "-system", FOLDER, "-checkpoint", state, "-resume", **WORDS).read_bytes() != bytes_of_whole:
        sys.exit(f"petsc: a run that went on is another one, {count} ranks")
    compare("a grid", of_grid, count, ranks(FOLDER / f"end_{count}.bin", count, "-grid", f"{NY},{NX}", "-damping", "0.05", **OF_GRID))

# A user's file of a similar name is not touched, and the name may be a link.
mine, behind = pathlib.Path(f"{state}.0.new"), FOLDER / "behind"
mine.write_text("mine")
pathlib.Path(f"{state}.0").rename(behind)
pathlib.Path(f"{state}.0").symlink_to("behind")
before = behind.read_bytes()
ranks(FOLDER / "end_4.bin", 4, "-system", FOLDER, "-checkpoint", state, **WORDS)
if mine.read_text() != "mine" or not pathlib.Path(f"{state}.0").is_symlink() or behind.read_bytes() != before:
    sys.exit("petsc: a state took the place of another file")
mine.unlink()

# What stands is the state of step 300, on 4 ranks.
refused("the end", "has been reached before", start(4, "-system", FOLDER, "-checkpoint", state, "-resume", **WORDS))
refused("fewer ranks", "is not the state of such a run", start(2, "-system", FOLDER, "-checkpoint", state, "-resume", **WORDS))
refused("another alpha", "is not the state of such a run: it is of other matrices, numbers or ranks", start(4, "-system", FOLDER, "-checkpoint", state, "-resume", **{**WORDS, "alpha": "0.4"}))
part = pathlib.Path(f"{state}.2")
bent = bytearray(part.read_bytes())
bent[len(bent) // 2] ^= 1
part.write_bytes(bent)
refused("a bit that fell over", "state.2 is not the state of such a run: it is not whole", start(4, "-system", FOLDER, "-checkpoint", state, "-resume", **WORDS))

# No option is ignored in silence.
for words, said in (("-system", FOLDER, "-stpes", "-3"), "name:-stpes"), (("-system", FOLDER, "-steps", "-3"), "-steps is less than 1"), \
        (("-grid", "3", "-system", FOLDER), "one of -system DIR"), (("-grid", "3", "-stop", "3"), "want -checkpoint"), \
        (("-grid", "0"), "a length below 1"), (("-system", FOLDER, "-damping", "1"), "is that of a grid"):
    refused("left over" if "-stpes" in words else str(words), said, start(1, *words, alpha="0.3", steps="9") if "-steps" not in words else start(1, *words))
# What cannot be run is refused, with file and line.
for name, text, said in (("f.tsv", "t f5\n0 1\n1 nan\n", "f.tsv:3"), ("M.mtx", "%%MatrixMarket matrix coordinate real symmetric\n408 408 1\n1 1 1\n", "M.mtx"),
                         ("K.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 1\n1 1 nan\n", "K.mtx:3")):
    (FOLDER / name).write_text(text)
    (FOLDER / "end_2.bin").unlink(missing_ok=True)
    refused(name, said, start(2, "-system", FOLDER, "-o", FOLDER / "end_2.bin"))
    if (FOLDER / "end_2.bin").exists():
        sys.exit(f"petsc: {name} was refused, and something written")
