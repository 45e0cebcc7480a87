"""What ten dampers cost on one and two ranks.              petsc_cost.py BUILD     (make petsc COST=1)

A membrane of 316 by 316 unknowns. Ten dampers have ten matrices, each of a tenth of the rows; one damper
has their sum, so it remembers as many unknowns. All have the law power:1,0.3, 300 steps from x = 1.
Each run is made three times, in turns, and the least time counts. The times are those of the wall, and
the rounds of conjugate gradients are in them. Prints a row for each number of ranks."""
import os
import pathlib
import re
import subprocess
import sys

from petsc_runs import BUILD, fresh

SIDE, PARTS, FOLDER = 316, 10, {1: BUILD / "petsc_one", 10: BUILD / "petsc_ten"}
N = SIDE * SIDE


def membrane():
    M = {(n, n): 1 for n in range(1, N + 1)}
    K = {place: 4.0 for place in M}
    K |= {(n, n - 1): -1.0 for n in range(2, N + 1) if (n - 1) % SIDE > 0}
    K |= {(n, n - SIDE): -1.0 for n in range(SIDE + 1, N + 1)}
    return M, K


def part_of(n):
    return (n - 1) * PARTS // N


def nanoseconds(count, ranks):
    words = [word for j in range(1, count + 1) for word in (f"-damper_{j}", f"C{j}.mtx : power:1,0.3")]
    done = subprocess.run(["mpirun", "-n", str(ranks), BUILD / "fvi_petsc", "-system", FOLDER[count], "-h", "0.2", "-steps", "300",
                           "-x0", "1", *words], check=True, capture_output=True, text=True)
    return int(re.search(r"(\d+) ns an unknown and step", done.stdout)[1])


M, K = membrane()
inside = {place: entry / 100 for place, entry in K.items() if part_of(place[0]) == part_of(place[1])}
parts = [{place: entry for place, entry in inside.items() if part_of(place[0]) == j} for j in range(PARTS)]
fresh(FOLDER[1], {"M": M, "K": K, "C1": inside}, N)
fresh(FOLDER[10], {"M": M, "K": K, **{f"C{j}": part for j, part in enumerate(parts, 1)}}, N)
model = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
print(f"# machine: {model[1] if model else 'unknown'}; {os.cpu_count()} cores\n#> dampers")
print("# ranks\tns per unknown and step, one damper\tten dampers\ttimes as long")
for ranks in (1, 2):
    least = {1: sys.maxsize, 10: sys.maxsize}
    for turn in range(3):
        for count in least:
            least[count] = min(least[count], nanoseconds(count, ranks))
    print(ranks, least[1], least[10], f"{least[10] / least[1]:.2f}", sep="\t", flush=True)
print("#< dampers")
