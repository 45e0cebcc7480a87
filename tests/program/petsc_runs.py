"""Runs of build/fvi_petsc, and of build/fvi on the same files, for the tests of make petsc.

BUILD is the first word of the test's command line."""
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, "src/petsc")
import petsc_vectors  # noqa: E402,F401

BUILD = pathlib.Path(sys.argv[1])
NX, NY, STEPS = 24, 17, 300


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


def grid_matrices():
    """Those of -grid NY,NX -damping 0.05: NY points in a row, the first index fastest."""
    a, b = (NY + 1) ** 2, (NX + 1) ** 2
    M = {(n, n): 1 for n in range(1, NX * NY + 1)}
    K = {place: 2 * a + 2 * b for place in M}
    K |= {(n, n - 1): -a for n, _ in M if (n - 1) % NY > 0}
    K |= {(n, n - NY): -b for n, _ in M if n > NY}
    return {"M": M, "K": K, "C": {place: 0.05 * entry for place, entry in K.items()}}


def fresh(folder, named, n=NX * NY):
    """A folder with these matrices of n rows, and nothing that an earlier test has left."""
    shutil.rmtree(folder, ignore_errors=True)
    write(folder, named, n)


def write(folder, named, n=NX * NY):
    folder.mkdir(parents=True, exist_ok=True)
    for name, entries in named.items():
        lines = [f"{i} {j} {entry!r}" for (i, j), entry in sorted(entries.items())]
        head = f"%%MatrixMarket matrix coordinate real symmetric\n{n} {n} {len(lines)}\n"
        (folder / f"{name}.mtx").write_text(head + "\n".join(lines) + "\n")


def one_machine(folder, words, *dampers):
    """x and p at the end by build/fvi; dampers are the texts of --damper."""
    end = folder / "end.tsv"
    subprocess.run([BUILD / "fvi", "run", "--system", folder, "--method", "fvi-stable", "--every", str(STEPS), "--unknowns", "1",
                    "--snapshot", end, *(word for name, value in words.items() for word in (f"--{name}", value)),
                    *(word for text in dampers for word in ("--damper", text))], check=True, stdout=subprocess.DEVNULL)
    rows = [line.split("\t") for line in end.read_text().splitlines() if not line.startswith("#")]
    return [float(row[1]) for row in rows], [float(row[2]) for row in rows]


def positions(folder, words, *dampers):
    """x of all unknowns in every row of that run."""
    done = subprocess.run([BUILD / "fvi", "run", "--system", folder, "--method", "fvi-stable", "--columns", "x",
                           *(word for name, value in words.items() for word in (f"--{name}", value)),
                           *(word for text in dampers for word in ("--damper", text))], check=True, capture_output=True, text=True)
    return [[float(x) for x in line.split("\t")] for line in done.stdout.splitlines() if not line.startswith("#")]


def start(ranks, *words, **named):
    """The process, when it has ended. A rank that waits for another for ever is seen by its time: the
    longest of these runs takes ten seconds."""
    return subprocess.run(["mpirun", "-n", str(ranks), BUILD / "fvi_petsc", *words,
                           *(word for name, value in named.items() for word in (f"-{name}", value))],
                          capture_output=True, text=True, timeout=120)


def ranks(end, count, *words, **named):
    """The file `end` with x and p at the end, which such a run has written."""
    end.unlink(missing_ok=True)
    done = start(count, *words, "-o", end, **named)
    if done.returncode:
        sys.exit(done.stdout + done.stderr)
    print(f"petsc: {done.stdout.strip()}")
    return end


def refused(what, said, done):
    """It ended with an error that has these words, or, if something is left over, said so."""
    if done.returncode == 0 and "left" not in what or said not in done.stdout + done.stderr:
        sys.exit(f"petsc: {what}: '{said}' was not said\n{done.stdout}{done.stderr}")
