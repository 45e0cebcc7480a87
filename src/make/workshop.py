"""The workshop: a student's own integrator, in workshop/, checked equation by equation.

    workshop.py BUILD start          lay out workshop/, check my.c       (make workshop)
    workshop.py BUILD chapter 04     the skeletons of a chapter      (make workshop-04)
    workshop.py BUILD figure         the first figure, out of my.c (make workshop-figure)
    workshop.py BUILD check          skeletons, holes, stages     (part of make check)
    workshop.py BUILD text           that each hole can be cut       (part of make text)
    workshop.py BUILD accidents      the sentences of tests/workshop/accidents.txt (the same)
    workshop.py BUILD exercise 13-2 [ANSWER]           (make exercise-13-2 ANSWER=...)
    workshop.py BUILD exercises      the table of all of them         (make exercises)
    workshop.py BUILD tests [04]     the programs of the tests that name the holes

workshop/ is the student's: what is there is never written over. BUILD holds libfvi.a,
the tests' objects and what is made here, in BUILD/workshop."""
import os
import pathlib
import shutil
import subprocess
import sys

import workshop_check as checks
import workshop_exercises as exercises
import workshop_holes as holes
import workshop_run as runner
from workshop_build import BUILD, FIGURE, HERE, archive, compile_plain, figure_fails, harness, meeting, thread

MINE = pathlib.Path("workshop/my.c")
STAGES = {1: "02", 2: "04", 3: "05", 4: "07", 5: "08", 6: "09", 7: "10", 8: "12", 9: "13"}
LIMIT = 10  # seconds of the processor for a test of my.c,
LONG = 20   # and for one of the course's own


def start():
    MINE.parent.mkdir(exist_ok=True)
    if not MINE.exists():
        MINE.write_text("/* workshop/my.c -- My fractional variational integrator. "
                        "The way: chapters/workshop/README.md */\n")
        print(f"made {MINE}")
    for chapter in STAGES.values():
        holes.lay_out(chapter)
    try:
        binary = thread(MINE, HERE, harness(), 1)
        for number, chapter in STAGES.items():
            page = f"chapters/workshop/README.md#stage-{number}"
            print(f"stage {number}, chapter {chapter}")
            if number == 7:
                fails = figure_fails(MINE, HERE)
                print(f"  the first figure: {'not yet: ' + fails if fails else 'yes'}")
                green = not fails
            else:
                green = runner.show(runner.run(binary, ["my.c"], LIMIT, str(number)))
            if not green:
                print(f"next: stage {number}, {page}, with {holes.page(chapter)}")
                return
    except runner.NotBuilt as error:
        print(f"{error}")
        return
    print("all nine stages hold. make workshop-figure draws your picture")


def figure():
    fails = figure_fails(MINE, HERE) if MINE.exists() else "there is no workshop/my.c: make workshop"
    if fails:
        print(f"the first figure: not yet: {fails}")
        return
    drawn = []
    for data in (FIGURE, HERE / "figure.dat"):
        drawn.append(pathlib.Path(HERE, "ours.svg" if "experiments" in data.name else "figure.svg"))
        subprocess.run([os.environ["GNUPLOT"], "-e", f"dat='{data}'; out='{drawn[-1]}'; stem='experiments_alphas'",
                        "figures/experiments/experiments_alphas.gp"],
                       check=True, env={**os.environ, "LC_ALL": "C.UTF-8"})
    same = drawn[0].read_bytes() == drawn[1].read_bytes()
    print(f"drew {drawn[1]}: " + ("byte for byte the course's figure. Well done." if same
                                  else "to 1e-12 the numbers of the course's figure."))


def chapter_tests(cuts):
    """The programs of the tests that name the holes."""
    where = holes.tests()
    return list(dict.fromkeys(where[hole.named][0] for hole in cuts))


def by_cases(binary, test, names):
    """The results of a program of tests, up to the first case in which something does not end."""
    results = []
    for case in dict.fromkeys(case for program, case in holes.tests().values() if program == test):
        results += runner.run(binary, names, LONG, case)
        if any(not passed and text.startswith(runner.ENDLESS) for _, passed, text in results):
            break
    return results


def curve(binary, number):
    try:
        return subprocess.run([binary, number], capture_output=True, text=True, timeout=20).stdout
    except subprocess.TimeoutExpired:
        return ""


def chapter(number):
    cuts = holes.holes(number)
    if not cuts:
        sys.exit(f"chapter {number} has no hole; those that have: "
                 + ", ".join(sorted({hole.chapter for hole in holes.holes()})))
    files = holes.lay_out(number)
    folder = HERE / number
    folder.mkdir(parents=True, exist_ok=True)
    met = {hole.source: holes.tests()[hole.named][0] for hole in cuts}
    try:
        library, anew = [], {}
        for source, file in files.items():
            *test, obj = meeting(source, file, folder, met[source], 1)
            if test:
                runner.each_has_one_place(file, obj, BUILD / "libfvi.a")
                library.append(obj)
            else:
                anew[met[source]] = obj
        library += [compile_plain("tests/workshop/exit.c"), archive(folder, files)]
        for test in chapter_tests(cuts):
            binary = runner.link(folder / test, list(files.values()), [anew.get(test, BUILD / f"tests/{test}.o"), *library])
            runner.show(by_cases(binary, test, [f.name for f in files.values()]))
        binary = runner.link(folder / "curve", list(files.values()),
                             [compile_plain("tests/workshop/curves.c", "-Isrc"), *library])
    except runner.NotBuilt as error:
        print(error)
        return
    draw(number, folder, binary)


def draw(number, folder, binary):
    ours = runner.link(folder / "ours", [], [HERE / "curves.o", BUILD / "libfvi.a"])
    if not (wanted := curve(ours, number)):
        return
    got = curve(binary, number)
    if not any(line.strip() and "nan" not in line for line in got.splitlines()):
        print("the picture: not yet, there is no curve to draw")
        return
    (folder / "mine.dat").write_text(got)
    (folder / "ours.dat").write_text(wanted)
    if not shutil.which(os.environ["GNUPLOT"]):
        print("the picture: gnuplot is not there to draw it")
        return
    svg = HERE / f"{number}.svg"
    subprocess.run([os.environ["GNUPLOT"], "-e", f"ours='{folder}/ours.dat'; mine='{folder}/mine.dat'; out='{svg}'; "
                    f"what='{holes.page(number).stem}'", "src/make/workshop.gp"],
                   check=True, env={**os.environ, "LC_ALL": "C.UTF-8"})
    print(f"the picture: {svg}, your curve over ours")


def tests(number=None):
    print(*chapter_tests(holes.holes(number)))


COMMANDS = {"start": start, "chapter": chapter, "figure": figure, "tests": tests, "exercise": exercises.main,
            "exercises": exercises.write_table, "check": checks.check, "text": checks.text, "accidents": checks.accidents}
HERE.mkdir(parents=True, exist_ok=True)
COMMANDS[sys.argv[2]](*sys.argv[3:])
