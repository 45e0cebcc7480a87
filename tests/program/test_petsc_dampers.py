"""Several dampers: build/fvi_petsc on 1, 2 and 3 ranks, build/fvi alone.

    test_petsc_dampers.py BUILD                               (make petsc)

The membrane of test_petsc.py with three dampers: a dashpot by a matrix that touches all unknowns, a
springpot between two unknowns, and a Zener's law by a matrix that touches four unknowns. On 3 ranks
the second has no row of the Zener's law and the others have none of the springpot, and all ranks must
take part in every product with their matrices. On 2 ranks the springpot stands across the cut. A second set has orders
above 1 and another past, which act by impulses.

How far apart may two runs be? The conjugate gradients solve A d = b, where A is the matrix of the step
and D its diagonal, up to a residual r with |D^-1 r| <= 1e-15 |D^-1 b|. All matrices here are dominated
by their diagonals, so |A| <= 2 max D, and

    |r| <= 2e-15 (max D)^2 / min D |d|.

Such a residual acts as an impulse r before the step and -r after it. The difference of two runs
starts at rest, so no energy of it grows afterwards, by (27.12) and (29.11). So its energy e at the
end has

    sqrt(2 e) <= 2 * 2 * 2e-15 (max D)^2 / min D / sqrt(min M) * sum_k |d_k|,

where one 2 is for the two impulses and one for the roundings of both programs. The d_k are the
increments of the run by build/fvi. Seen: 1.4e-3 of the bound.

A run that was stopped and goes on gives the same bytes. A state with another matrix, law, past or
order of the dampers is refused, and so are bad words, by every number of ranks and in a finite time."""
import math
import sys

from petsc_runs import BUILD, NX, NY, STEPS, fresh, grid_matrices, matrices, one_machine, petsc_vectors, positions, ranks, refused, start, write

FOLDER, GRID = BUILD / "petsc_dampers", BUILD / "petsc_dampers_grid"
WORDS = {"h": "0.2", "steps": str(STEPS), "x0": "1", "p0": "0.25"}
OF_GRID = {**WORDS, "h": "0.01"}
HELD = ("C1.mtx : viscous:0.7", "x205-x204 : power:1,0.3", "C2.mtx : zener:1,0.3,2")
IMPULSES = ("C1.mtx : power:0.2,0.8", "x205-x204 : power:1,0.3 : rl", "C2.mtx : zener:1,0.3,2 + viscous:0.1")
state = FOLDER / "state"


def numbered(texts):
    return [word for number, text in enumerate(texts, 1) for word in (f"-damper_{number}", text)]


def times(named, x):
    """A x of a lower triangle."""
    y = [0.0] * len(x)
    for (i, j), entry in named.items():
        y[i - 1] += entry * x[j - 1]
        if i != j:
            y[j - 1] += entry * x[i - 1]
    return y


def bound(named, h, path):
    """That of sqrt(2 e), with at most 1 before each C_j and 2 C_j of a row."""
    M, D = [named["M"][i, i] for i in range(1, NX * NY + 1)], []
    for i, mass in enumerate(M, 1):
        D.append(mass / h + h / 4 * named["K"][i, i] + sum(named[C].get((i, i), 0) for C in ("C1", "C2")) + (i in (204, 205)))
    way = sum(math.dist(a, b) for a, b in zip(path, path[1:]))
    least = min(mass / h for mass in M)
    return 8e-15 * max(D) ** 2 / least / math.sqrt(min(M)) * way


def compare(what, named, most, want, count, end):
    got = petsc_vectors.read(end)
    if [len(vector) for vector in got] != [NX * NY, NX * NY]:
        sys.exit(f"petsc: {what}: not x and p")
    dx, dp = ([a - b for a, b in zip(*pair)] for pair in zip(got, want))
    twice = sum(a * b for a, b in zip(dx, times(named["K"], dx))) + sum(b * b / named["M"][i, i] for i, b in enumerate(dp, 1))
    part = math.sqrt(twice) / most if math.isfinite(twice) else math.inf
    print(f"petsc: {what}, {count} ranks and one machine are {part:.1e} of the bound apart")
    if not part <= 1:
        sys.exit("petsc: too far")


def same_bytes(what, one, other):
    if one != other.read_bytes():
        sys.exit(f"petsc: {what}: not the same bytes")


named = matrices()
named["C1"] = {place: entry / 20 for place, entry in named["K"].items()}
named["C2"] = {(5, 5): 2, (6, 5): -1, (6, 6): 3, (300, 300): 1.5, (301, 300): -0.5, (301, 301): 1}
del named["C"]
fresh(FOLDER, named)

for what, texts in (("dampers", HELD), ("dampers with impulses", IMPULSES)):
    want, most = one_machine(FOLDER, WORDS, *texts), bound(named, 0.2, positions(FOLDER, WORDS, *texts))
    for count in (1, 2, 3):
        end = FOLDER / f"end_{count}.bin"
        words = ("-system", FOLDER, *numbered(texts))
        whole = ranks(end, count, *words, **WORDS)
        compare(what, named, most, want, count, whole)
        bytes_of_whole = whole.read_bytes()
        ranks(end, count, *words, "-checkpoint", state, "-stop", "123", **WORDS)
        same_bytes("a run that went on", bytes_of_whole, ranks(end, count, *words, "-checkpoint", state, "-resume", **WORDS))

# The matrices of a grid have names of one letter.
of_grid = grid_matrices()
del of_grid["C"]
fresh(GRID, of_grid)
LAWS = ("viscous:0.001", "zener:1,0.3,2", "power:0.01,0.3")
want = one_machine(GRID, OF_GRID, *(f"{name}.mtx : {law}" for name, law in zip("KMK", LAWS)))
for count in (1, 2, 3):
    end = ranks(GRID / "end.bin", count, "-grid", f"{NY},{NX}", *numbered(f"{name} : {law}" for name, law in zip("KMK", LAWS)), **OF_GRID)
    path = positions(GRID, OF_GRID, *(f"{name}.mtx : {law}" for name, law in zip("KMK", LAWS)))
    # D is constant, and |A| at most twice that: (max D)^2 / min D is max D
    D = 1 / 0.01 + of_grid["K"][1, 1] * (0.01 / 4 + 0.001 + 0.01) + 1
    compare("dampers of a grid", of_grid, 8e-15 * D * sum(math.dist(a, b) for a, b in zip(path, path[1:])), want, count, end)

# Bodies that start alike stretch no damper between them, though C_j x_0 has roundings: on all ranks.
assert 0.7 - 0.3 * 0.7 - 0.7 * 0.7 != 0
for count in (1, 2, 3):
    ranks(FOLDER / f"end_{count}.bin", count, "-system", FOLDER, *numbered((*HELD[::2], "x205-0.3*x204-0.7*x203 : power:1,0.8 : rl")),
          **{**WORDS, "x0": "0.7"})

# One damper in a list is C with -alpha, up to the roundings of two ways to the same sums; on 3 ranks to
# the last bit, as all rows are touched.
write(GRID, {"C": {place: 0.05 * entry for place, entry in of_grid["K"].items()}})
alone = ranks(GRID / "end.bin", 3, "-system", GRID, "-alpha", "0.3", **OF_GRID).read_bytes()
same_bytes("one damper", alone, ranks(GRID / "end.bin", 3, "-system", GRID, "-damper_1", "C.mtx : power:1,0.3", **OF_GRID))

# A state is of the same dampers, and says which is another one.
def saved(texts):
    ranks(FOLDER / "end_3.bin", 3, "-system", FOLDER, "-checkpoint", state, "-stop", "123", *numbered(texts), **WORDS)


def not_of_it(said, texts):
    refused(said, f"is not the state of such a run: it is of {said}",
            start(3, "-system", FOLDER, "-checkpoint", state, "-resume", *numbered(texts), **WORDS))


C1, ROW, C2 = HELD
saved((C1, C2, ROW))
not_of_it("another damper 1", (C1.replace("0.7", "0.71"), C2, ROW))
not_of_it("another damper 2", (C1, C2.replace("0.3", "0.31"), ROW))
not_of_it("another damper 2", (C1, C2.replace("zener:1,0.3,2", "zener:1,0.3,2 + viscous:1"), ROW))
not_of_it("another damper 3", (C1, C2, ROW + " : rl"))
not_of_it("another damper 2", (C1, ROW, C2))
not_of_it("another damper 1", (C1, C2))
write(FOLDER, {"C2": {**named["C2"], (300, 300): 1.25}})
not_of_it("another damper 2", (C1, C2, ROW))
write(FOLDER, {"C2": named["C2"]})
symbol = "C2.mtx : symbol:s^0.6/(1+2*s^0.6)"
saved((C1, ROW, symbol))
not_of_it("another damper 3", (C1, ROW, symbol.replace("2*", "2.01*")))

# Words that cannot be read end all ranks, with the name of the option.
DIR, ONE = ("-system", FOLDER), ("-damper_1", C1)
for words, said in (((*DIR, "-damper_1", "C1.mtx: viscous:1"), "-damper_1: 'C1.mtx: viscous:1' is not '[NAME=] G : LAW [: PAST]'"),
                    ((*DIR, *ONE, "-damper_2", "C2.mtx : zner:1"), "-damper_2: 'zner:1' is none of"),
                    ((*DIR, *ONE, "-damper_2", "C2.mtx : zener:1,2,3"), "-damper_2: 'zener:1,2,3'"),
                    ((*DIR, *ONE, "-damper_2", "x1*x2 : viscous:1"), "-damper_2: 'x1*x2' is not linear"),
                    ((*DIR, *ONE, "-damper_2", "C9.mtx : viscous:1"), f"-system: {FOLDER}/C9.mtx: cannot be read"),
                    ((*DIR, *ONE), f"-system: {FOLDER}/C2.mtx would not be read"),
                    ((*DIR, *ONE, "-damper_2", "C2.mtx : power:1,0.8 : rl", "-x0", "1"), "-damper_2: the past rl wants"),
                    ((*DIR, *ONE, "-damper_3", C2), "-damper_3: dampers are numbered without a gap, and the next is -damper_2"),
                    ((*DIR, *ONE, "-damper", C2), "-damper: dampers are numbered without a gap"),
                    ((*DIR, *ONE, "-damper_1", C2), "-damper_1 is given twice"),
                    ((*DIR, *ONE, "-damper_2"), "-damper_2 wants 'G : LAW [: PAST]'"),
                    ((*DIR, *ONE, "-damper_2", C2, "-alpha", "0.3"), "-alpha is not read with -damper_1"),
                    (("-grid", "9", "-damper_1", "K : viscous:1", "-damping", "1"), "-damping is not read with -damper_1"),
                    (("-grid", "9", "-damper_1", "K : viscous:1", "-damper_2", "C : viscous:1"), "-damper_2: 'C' is neither M nor K"),
                    (("-grid", "9", "-damper_1", "K : viscous:1", "-damper_2", "M : viscous:-1"), "-damper_2: 'viscous:-1'")):
    for count in (1, 3):
        refused(" ".join(map(str, words)), said, start(count, *words, steps="9"))
write(FOLDER, {"C2": {(5, 5): 1, (6, 5): 2, (6, 6): 1}})
refused("a negative matrix", f"-system: {FOLDER}/C2.mtx", start(3, *DIR, *ONE, "-damper_2", C2, steps="9"))

# A rank without an unknown has nothing to do, and its functions would not be called.
TWO = BUILD / "petsc_two"
TWO.mkdir(exist_ok=True)
for name in ("M", "K"):
    (TWO / f"{name}.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 1\n2 2 1\n")
refused("two unknowns", "3 ranks are more than the 2 unknowns", start(3, "-system", TWO, "-damper_1", "x1 : viscous:1", steps="9"))
if start(2, "-system", TWO, "-damper_1", "x1 : viscous:1", steps="9").returncode:
    sys.exit("petsc: two unknowns on two ranks: no run")
