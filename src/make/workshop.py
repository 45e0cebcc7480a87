"""The workshop: a student's own integrator, in workshop/, checked equation by equation.

    workshop.py BUILD start          lay out workshop/body.c, check it   (make workshop)
    workshop.py BUILD hint [2]       a hint for the stage at hand   (make hint HINT=2)
    workshop.py BUILD chapter 04     the skeletons of a page         (make workshop-04)
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
import workshop_course as course
import workshop_exercises as exercises
import workshop_holes as holes
import workshop_run as runner
from workshop_build import BUILD, HERE, archive, compile_plain, linked_parts

BODY = pathlib.Path("workshop/body.c")
EMPTY = """/* workshop/body.c -- My body that remembers.
 *
 * Type the 18 lines of chapter 1 below this comment: chapters/01-springpot.md, "The program".
 * Then run `make workshop` again. A hint: `make hint`. */
"""
LIMIT = 10  # seconds of the processor for a test of body.c,
LONG = 20   # and for one of the course's own


def kept(stage):
    """Where body.c is kept, as it was when a stage first held."""
    return BODY.with_name(f"body_{stage:02d}.c")


def last_passed():
    return max([stage for stage in course.STAGES if kept(stage).exists()], default=0)


def page(stage):
    return next(pathlib.Path("chapters").glob(f"{stage:02d}-*.md"))


def title(stage):
    """A stage has the name of its chapter."""
    return page(stage).read_text().partition("\n")[0].partition(". ")[2]


def stage_at_hand():
    """The stage after the last that held; or a later one, if body.c has all its functions."""
    least = min(last_passed() + 1, course.STAGES[-1])
    return course.latest_complete(BODY, HERE / "body", least) if BODY.exists() else least


def start():
    BODY.parent.mkdir(exist_ok=True)
    if not BODY.exists():
        BODY.write_text(EMPTY)
        print(f"made {BODY}: type the 18 lines of {page(1)} into it")
        return
    course.prepare()
    try:
        stage = stage_at_hand()
        results = course.Student(BODY, stage, HERE / "body", 1).results(LIMIT, course.library())
    except runner.NotBuilt as error:
        print(f"{error}\nmake hint gives a hint")
        return
    holds = show(stage, results)
    if stage == 1 and not any(text.startswith(runner.ENDLESS) for *_, text in results):
        draw_run()
    if not holds:
        print(f"read {page(stage)}, \"The program\"; make hint gives a hint")
        return
    if not kept(stage).exists():
        shutil.copy(BODY, kept(stage))
        print(f"stage {stage} holds; {kept(stage)} keeps your program as it is now")
    if stage == course.STAGES[-1]:
        print("all twelve stages hold")
        return
    gone = course.no_longer_needed(stage + 1)
    print(f"next: stage {stage + 1}, {title(stage + 1)}, {page(stage + 1)}: write {', '.join(course.added(stage + 1))}"
          + (f"; you may remove {', '.join(gone)}" if gone else ""))


def show(stage, results):
    """A line for each equation of this stage; of earlier ones only what does not hold."""
    before = [(f"stage {number} does not hold: {runner.title(name)[1]}", text) for number, name, passed, text in results
              if number < stage and not passed]
    print(f"stage {stage}, {title(stage)}")
    for what, text in before:
        print(f"  {what}: {text}")
    return runner.show([result for number, *result in results if number == stage]) and not before


def draw_run():
    if not (data := course.rows(BODY, HERE / "body", LIMIT)):
        print("the picture: not yet, the program prints no two rows of t and x")
        return
    plot(pathlib.Path("tests/workshop/exact.txt"), data, BODY.with_name("run.svg"), "place against time", "the exact motion")


def hint(which=None):
    """The next of three hints, and then the answer; HINT=1 to 3 asks for one, HINT=4 for the answer."""
    course.prepare()
    try:
        stage = stage_at_hand()
    except runner.NotBuilt as error:
        print(error)
        stage = min(last_passed() + 1, course.STAGES[-1])
    hints = course.hints(stage)
    given = HERE / f"hints_given_{stage}"
    if which and which not in ("1", "2", "3", "4"):
        sys.exit("HINT is 1, 2, 3, or 4 for the answer")
    number = int(which or (int(given.read_text()) if given.exists() else 0) + 1)
    given.write_text(str(min(number, 3)))
    if number <= 3:
        print(f"stage {stage}, hint {number} of 3: {hints[number - 1]}")
        return
    print(f"stage {stage}, the answer, from {course.answer(stage)}:\n")
    print("\n\n".join(course.added(stage).values()))


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
            *test, obj = linked_parts(source, file, folder, met[source], 1)
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
    plot(folder / "ours.dat", folder / "mine.dat", HERE / f"{number}.svg", holes.page(number).stem, "the course")


def plot(ours, mine, svg, what, name):
    """The curve of a student over another one."""
    if not shutil.which(os.environ["GNUPLOT"]):
        print("the picture: gnuplot is not there to draw it")
        return
    subprocess.run([os.environ["GNUPLOT"], "-e", f"ours='{ours}'; mine='{mine}'; out='{svg}'; what='{what}'; name='{name}'",
                    "src/make/workshop.gp"], check=True, env={**os.environ, "LC_ALL": "C.UTF-8"})
    print(f"the picture: {svg}, your curve over {name}")


def tests(number=None):
    print(*chapter_tests(holes.holes(number)))


COMMANDS = {"start": start, "hint": hint, "chapter": chapter, "tests": tests, "exercise": exercises.main,
            "exercises": exercises.write_table, "check": checks.check, "text": checks.text, "accidents": checks.accidents}
HERE.mkdir(parents=True, exist_ok=True)
COMMANDS[sys.argv[2]](*sys.argv[3:])
