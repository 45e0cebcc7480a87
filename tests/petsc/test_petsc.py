"""Ranks against one machine: build/fvi_petsc on 1 and 2 ranks, build/fvi alone.

    test_petsc.py BUILD                                       (make petsc)

A membrane of 24 by 17 unknowns: masses that differ, the second difference as K, and
C = K/20 and a damper more, so that no symmetry hides a row in a wrong place. 300 steps, so
that the memory is the compressed one, by blocks. x and p at the end agree to 1e-13 of the
largest: conjugate gradients end at a residual of 1e-15 of the first, the condition of a
step's matrix is below 10, and fvi-stable lets no error of a step grow. Seen: 4e-15."""
import pathlib
import struct
import subprocess
import sys

BUILD = pathlib.Path(sys.argv[1])
FOLDER = BUILD / "petsc"
NX, NY, STEPS = 24, 17, 300
ARGUMENTS = {"alpha": "0.3", "h": "0.2", "steps": str(STEPS), "x0": "1", "p0": "0.25"}


def matrices():
    """Name -> {(row, column): entry}, the lower triangles, from 1."""
    M, K = {}, {}
    for i in range(NX):
        for j in range(NY):
            here = 1 + i * NY + j
            M[here, here] = 1 + (7 * here % 5) / 8
            K[here, here] = 4
            if i > 0:
                K[here, here - NY] = -1
            if j > 0:
                K[here, here - 1] = -1
    C = {place: entry / 20 for place, entry in K.items()}
    C[100, 100] += 3
    return {"M": M, "K": K, "C": C}


def write():
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, entries in matrices().items():
        lines = [f"{i} {j} {entry!r}" for (i, j), entry in sorted(entries.items())]
        head = f"%%MatrixMarket matrix coordinate real symmetric\n{NX * NY} {NX * NY} {len(lines)}\n"
        (FOLDER / f"{name}.mtx").write_text(head + "\n".join(lines) + "\n")


def one_machine():
    end = FOLDER / "end.tsv"
    subprocess.run([BUILD / "fvi", "run", "--system", FOLDER, "--method", "fvi-stable", "--every", str(STEPS), "--unknowns", "1",
                    "--snapshot", end, *(word for name, value in ARGUMENTS.items() for word in (f"--{name}", value))],
                   check=True, stdout=subprocess.DEVNULL)
    rows = [line.split("\t") for line in end.read_text().splitlines() if not line.startswith("#")]
    return [float(row[1]) for row in rows], [float(row[2]) for row in rows]


def ranks(count):
    """PETSc's binary vectors: big-endian, a mark, the length, the numbers."""
    end = FOLDER / f"end_{count}.bin"
    end.unlink(missing_ok=True)
    done = subprocess.run(["mpirun", "-n", str(count), BUILD / "fvi_petsc", "-system", FOLDER, "-o", end,
                           *(word for name, value in ARGUMENTS.items() for word in (f"-{name}", value))],
                          check=True, capture_output=True, text=True)
    print(f"petsc: {done.stdout.strip()}")
    data, vectors = end.read_bytes(), []
    while data:
        mark, n = struct.unpack(">ii", data[:8])
        assert mark == 1211214 and n == NX * NY
        vectors.append(struct.unpack(f">{n}d", data[8:8 + 8 * n]))
        data = data[8 + 8 * n:]
    assert len(vectors) == 2
    return vectors


write()
want = one_machine()
for count in (1, 2):
    apart = max(abs(a - b) / max(map(abs, all)) for got, all in zip(ranks(count), want) for a, b in zip(got, all))
    print(f"petsc: {count} ranks and one machine are {apart:.1e} apart")
    if not apart <= 1e-13:
        sys.exit("petsc: too far")
# No option is ignored in silence.
for word, said in (("-stpes", "name:-stpes"), ("-steps", "-steps is less than 1")):
    done = subprocess.run(["mpirun", "-n", "1", BUILD / "fvi_petsc", "-system", FOLDER, word, "-3"], capture_output=True, text=True)
    if said not in done.stdout + done.stderr:
        sys.exit(f"petsc: {word} -3 was taken without a word")
# What cannot be run is refused by all ranks.
(FOLDER / "K.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n2 2 1\n1 1 nan\n")
bad = subprocess.run(["mpirun", "-n", "2", BUILD / "fvi_petsc", "-system", FOLDER], capture_output=True, text=True)
if bad.returncode == 0 or "K.mtx, line 3" not in bad.stdout + bad.stderr:
    sys.exit("petsc: a matrix with nan was not refused")
