"""Arrows between the rooms of src/ point down only.      layers.py ARCHIVE...

A room is a folder. A file may include headers of its own room and of those below, and
an object of an ARCHIVE may use symbols of its own room and of those below;
the public headers in src/fvi/ belong to the room that keeps what they declare, and
fvi/fvi.h, which hands on all the others, to none. The peers of the benchmark, build/peers.a,
are of no room; their names must not clash with the library's. The drawing in chapters/handbook/tour.md
must be the one that the sources give. Only the standard library is used."""
import pathlib
import re
import subprocess
import sys

SRC, MAP = pathlib.Path("src"), pathlib.Path("chapters/handbook/tour.md")
# From the roof to the ground; rooms of one floor know nothing of each other.
FLOORS = [
    {"course": "the program that the Course writes; it knows no other file", "program": "build/fvi: its main, which hands on to commands", "petsc": "build/fvi_petsc: a run on many machines"},
    {"command_run": "fvi run, and its checkpoints", "command_exact": "fvi exact", "command_sweep": "fvi sweep", "command_fit": "fvi fit",
     "command_gradient": "fvi gradient", "command_response": "fvi response, fvi poles"},
    {"command_shared": "rows of a run, warnings, options of one command alone"},
    {"output": "tables, pictures, complaints; files are whole or absent"},
    {"options": "from the command line to values"},
    {"input": "files that are compiled or loaded, and who reads which"},
    {"problem": "problems as they are typed, or stand in files"},
    {"estimation": "what is unknown, from what was measured"},
    {"control": "the least force that moves a body from here to there", "adjoint_forces": "derivatives of the forces of dampers",
     "tangent": "derivatives of a run, forwards beside it"},
    {"adjoint": "derivatives of a run, backwards"},
    {"adjoint_mechanism": "steps of a mechanism, backwards"},
    {"adjoint_variable": "steps of any length, backwards"},
    {"parameter_derivatives": "derivatives of laws and potentials by their numbers"},
    {"error_control": "the step that a wanted error needs", "paper": "what only the paper needs"},
    {"observer": "velocities, accelerations, forces and work along a run"},
    {"methods": "the integrators", "reference": "the exact solution of the linear problem"},
    {"stability": "the longest step, a bound of the error, warnings of both", "variable_step": "an integrator whose steps are its own"},
    {"mechanism": "steps of any Lagrangian, with dampers and constraints"},
    {"run": "a start, a step, a whole trajectory", "stages": "weights and memory of steps with stages",
     "frequency": "responses and poles of linear systems"},
    {"kernel": "damping kernels: symbols, weights, modes, impulses"},
    {"memory": "weights, and sums over the past", "matrices": "sparse matrices, their files and factors"},
    {"newton": "the one equation of a step", "expression": "texts as functions, with derivatives and bounds"},
    {"system": "potentials, forces, Lagrangians, errors"},
]
# They know the library by its public headers.
PROGRAM = {room for rooms in FLOORS for room in rooms if room.startswith("command_")} | {"program", "output", "options", "input"}
FLOOR = {room: -number for number, rooms in enumerate(FLOORS) for room in rooms}


def rooms_of_files():
    """Path below src/ -> room. A header of src/fvi/ lives where the source of its name does."""
    rooms = {}
    for path in SRC.rglob("*.[ch]"):
        room = path.parts[1]
        if room not in FLOOR:
            continue
        rooms[str(path.relative_to(SRC))] = room
        for place in ("fvi", "fvi/paper"):
            if path.suffix == ".c" and (SRC / place / f"{path.stem}.h").exists():
                rooms[f"{place}/{path.stem}.h"] = room
    rooms.pop("fvi/fvi.h", None)
    return rooms


def includes(rooms):
    """(file, its room, the room of what it includes, that header)"""
    for here in sorted(rooms):
        for word in re.findall(r'#include ["<]([\w/]+\.h)[">]', (SRC / here).read_text()):
            beside = str(pathlib.Path(here).parent / word)
            header = beside if (SRC / beside).exists() else word
            if header in rooms:
                yield here, rooms[here], rooms[header], header


def symbols(archives):
    """(object, its room, the room of a symbol it uses, that symbol)"""
    room = {path.stem: path.parts[1] for path in SRC.glob("*/*.c")}
    home, wants, vectors = {}, [], {}
    for line in subprocess.run(["nm", "-A", *archives], capture_output=True, text=True, check=True).stdout.splitlines():
        if line.count(":") < 2:
            continue
        archive, member = line.split(":")[:2]
        member = member.removesuffix(".o")
        kind, symbol = line.split()[-2:]
        if symbol.endswith(".resolver"):   # of a static function for several processors: clang makes it visible
            if vectors.setdefault(symbol, member) != member:
                sys.exit(f"clang links no two functions for vectors of one name: {symbol} in {vectors[symbol]}.c, {member}.c")
            if kind == "W":   # of a function that other files call: clang 14 gives it another name
                sys.exit(f"clang links no function for vectors that is not static: {symbol.split('.')[0]} in {member}.c")
        if archive.endswith("peers.a"):
            continue
        if kind == "U":
            wants.append((member, symbol))
        elif kind.isupper() and member != "fvi_solver_libraries":   # it has the names of CHOLMOD and UMFPACK, to open them late
            home[symbol] = member
    for member, symbol in wants:
        if symbol in home:
            yield member, room[member], room[home[symbol]], symbol


def drawing(arrows):
    """A line a room, and the rooms that it knows."""
    for rooms in FLOORS:
        for room, what in rooms.items():
            known = sorted((low for high, low in arrows if high == room), key=list(FLOOR).index)
            yield f"{room:>21}  {what:<58}{'-> ' + ', '.join(known) if known else ''}".rstrip()


def main():
    faults, arrows = [], set()
    for room in sorted({path.parts[1] for path in SRC.glob("*/*.c")} - set(FLOOR)):
        sys.exit(f"src/{room}/: on which floor is it? see {sys.argv[0]}")
    for who, high, low, what in [*includes(rooms_of_files()), *symbols(sys.argv[1:])]:
        if high in PROGRAM and low not in PROGRAM and what.endswith(".h") and not what.startswith("fvi/"):
            faults.append(f"{who} of the program includes {what}, which is not public")
        if high != low:
            arrows.add((high, low))
            if FLOOR[high] <= FLOOR[low]:
                faults.append(f"{high}/ must not know {low}/: {who} uses {what}")
    picture = "\n".join(drawing(arrows))
    if picture not in MAP.read_text():
        faults.append(f"{MAP}: the drawing of the rooms is to be\n{picture}")
    if faults:
        sys.exit("\n".join(sorted(set(faults))))
    print(f"layers: {len(FLOOR)} rooms, {len(arrows)} arrows, all down")


main()
