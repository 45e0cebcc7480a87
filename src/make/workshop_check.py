"""What `make check` and `make mutants` hold of the workshop.

Every skeleton compiles; every hole makes the test red that names its equation, and filled
again the file is the source; every stage passes the checks up to itself; every exercise
has its head, and its answers are judged rightly; and every accident gets its sentence."""
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

import workshop_course as course
import workshop_exercises as exercises
import workshop_holes as holes
import workshop_run as runner
from workshop_build import BUILD, HERE, linked_parts, module

ACCIDENTS = "tests/workshop/accidents.txt"
EXACT = "tests/workshop/exact.txt"
PAGE = pathlib.Path("chapters/workshop/README.md")
LIMIT = 10  # seconds of the processor for a test


def text_fails(hole):
    """None if the hole can be cut, if the lines fill it, and if its test is there."""
    where = f"{hole.source}#{hole.region}"
    if hole.named not in holes.tests() or hole.shows not in runner.title(hole.named)[0]:
        return f"{where}: no test {hole.named} that names ({hole.shows})"
    text = holes.skeleton(hole.source, [hole])
    if holes.without_comments(holes.filled(text, [hole])) != holes.without_comments(pathlib.Path(hole.source).read_text()):
        return f"{where}: filled, it is not the source"
    return None


def hole_fails(hole):
    """None if the skeleton with this hole is right as a text and compiles, and its test sees it."""
    if fault := text_fails(hole):
        return fault
    folder = HERE / f"{hole.chapter}-{hole.region}-{pathlib.Path(hole.source).stem}"
    folder.mkdir(parents=True, exist_ok=True)
    where = f"{hole.source}#{hole.region}"
    file = folder / pathlib.Path(hole.source).name
    file.write_text(holes.skeleton(hole.source, [hole]))
    test, case = holes.tests()[hole.named]
    try:
        inputs = [*linked_parts(hole.source, file, folder, test), HERE / "exit.o",
                  BUILD / "libfvi.a"]  # of which the linker takes what is not there yet
        results = runner.run(runner.link(folder / test, [file], inputs), [file.name], LIMIT, case)
    except runner.NotBuilt as error:
        return f"{where}: {error}"
    if [passed for name, passed, _ in results if name == hole.named] != [False]:
        return f"{where}: {hole.named} does not notice that it is empty"
    return None


def skeletons_fail(where, cuts):
    """None if the file that a student gets, with all its holes, compiles."""
    chapter, source = where
    folder = HERE / "skeletons" / chapter
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / pathlib.Path(source).name
    file.write_text(holes.skeleton(source, cuts))
    try:
        linked_parts(source, file, folder, holes.tests()[cuts[0].named][0])
    except runner.NotBuilt as error:
        return str(error)
    return None


def stage_fails(number):
    """None if the Course's program of a stage is known as one of this stage, and passes all checks up to its own."""
    source, folder = course.answer(number), HERE / f"stage_{number}"
    try:
        if (found := course.latest_complete(source, folder, 1)) != number:
            return f"{source}: is taken for stage {found}"
        if number == 1 and not course.rows(source, folder, LIMIT):
            return f"{source}: there are no rows to draw"
        student = course.Student(source, number, folder)
        failed = [f"{source}: stage {stage}, {name}: {said}" for stage, name, passed, said
                  in student.results(LIMIT, course.library()) if not passed]
    except runner.NotBuilt as error:
        failed = [f"{source}: {error}"]
    if len(course.hints(number)) != 3:
        failed.append(f"{course.HINTS}: three hints are wanted for stage {number}")
    return "\n".join(failed) or None


def exact_fails():
    """None if the motion that the first picture shows is the one that the library computes."""
    said = runner.say([BUILD / "fvi", "exact", *"--alpha 0.25 --rho 0.5 --p0 0 --h 0.1 --steps 140 --columns t,x".split()]).stdout
    want = [list(map(float, line.split())) for line in said.splitlines() if not line.startswith("#")]
    got = [list(map(float, line.split())) for line in pathlib.Path(EXACT).read_text().splitlines() if not line.startswith("#")]
    same = len(want) == len(got) and all(abs(a - b) < 1e-6 for x, y in zip(got, want) for a, b in zip(x, y))
    return None if same else f"{EXACT} is not the exact motion of the body of Chapter 1"


def session_fails():
    """None if `make workshop` and `make hint`, in a folder of their own, say what the workshop's page prints."""
    place = HERE / "session"
    shutil.rmtree(place, ignore_errors=True)
    (place / "workshop").mkdir(parents=True)
    for name in ("src", "tests", "chapters", "figures"):
        (place / name).symlink_to(pathlib.Path(name).resolve())

    def says(body, command="start"):
        (place / "workshop/body.c").write_text(body)
        done = subprocess.run([sys.executable, "src/make/workshop.py", "build", command], cwd=place, capture_output=True, text=True)
        return re.sub(r"^the picture: .*\n", "", done.stdout + done.stderr, flags=re.M)  # gnuplot may be missing

    right, sixth = (course.answer(number).read_text() for number in (1, 6))
    slip = right.replace("(x[k + 1 - n] - x[0])", "x[k + 1 - n]")
    got = says(slip) + says(slip, "hint") + says(right)
    want = re.sub(r"^(the picture: |\$ ).*\n", "", "".join(re.findall(r"```text\n(.*?)```", PAGE.read_text(), re.S)), flags=re.M)
    if got != want:
        return f"{PAGE}: the session says:\n{got}"
    if "next: stage 7," not in (got := says(sixth)):
        return f"{course.answer(6)} is not taken for stage 6:\n{got}"
    if "stage 2 does not hold: (2b)" not in (got := says(sixth.replace("(n - 1 - b) / n", "(n - b) / n"))):
        return f"stage 2 is broken after stage 6, and nothing says so:\n{got}"
    return None


def unfolded():
    """Code of the Course that a reader sees before he has asked for it: of a stage only its head and main may stand
    open, and the first program, which is typed; the library's lines give away those of a stage."""
    for page in sorted(pathlib.Path("chapters").glob("[0-9][0-9]-*.md")):
        shown = re.sub(r"<details>.*?</details>", "", page.read_text(), flags=re.S)
        for quote in re.findall(r"<!-- excerpt: (\S+) -->", shown):
            if not re.fullmatch(r"src/course/body_(01\.c|\d\d\.c#(head|main\(\)))", quote):
                yield f"{page}: {quote} stands open, and a stage asks for such lines: it belongs into <details>"


def text():
    """What needs no compiler: the part of `make text`."""
    if failed := [*filter(None, map(text_fails, holes.holes())), *unfolded()]:
        sys.exit("\n".join(failed))


def check():
    course.prepare()
    cuts = holes.holes()
    files = {(hole.chapter, hole.source): [h for h in cuts if (h.chapter, h.source) == (hole.chapter, hole.source)]
             for hole in cuts}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = pool.submit(lambda: list(exercises.faults()))  # the longest come first
        jobs = [pool.submit(stage_fails, number) for number in reversed(course.STAGES)]
        jobs += [pool.submit(exact_fails), pool.submit(session_fails)]
        jobs += [pool.submit(skeletons_fail, *item) for item in files.items() if len(item[1]) > 1]
        jobs += [pool.submit(hole_fails, hole) for hole in cuts]
        jobs += [pool.submit(module_accident_fails, entry, i) for i, entry in enumerate(holes.paragraphs(ACCIDENTS))
                 if "module" in entry]
        failed = [job.result() for job in jobs if job.result()] + faults.result()
    if failed:
        sys.exit("\n".join(failed))
    print(f"workshop: {len(exercises.exercises())} exercises, {len(files)} skeletons compile, {len(cuts)} holes are noticed and filled, "
          f"{len(course.STAGES)} stages pass their checks")


def wrong_version(entry, source, file):
    """A source with an accident in it."""
    text = pathlib.Path(source).read_text()
    if text.count(entry["right"]) != 1:
        sys.exit(f"{ACCIDENTS}: '{entry['right']}' stands {text.count(entry['right'])} times in {source}")
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text.replace(entry["right"], entry["wrong"]))
    return file


def module_accident_fails(entry, place):
    """None if a module that lacks a function, or has another's, is told so."""
    source = entry["module"]
    folder = HERE / f"accident_{place}"
    file = wrong_version(entry, source, folder / pathlib.Path(source).name)
    try:
        runner.each_has_one_place(file.name, module(source, file, folder), BUILD / "libfvi.a")
        said = "all is well"
    except runner.NotBuilt as error:
        said = str(error)
    return None if said.startswith(entry["says"]) else f"{source}: '{entry['wrong']}': says '{said}'"


def accident_fails(entry, place):
    """None if a wrong version of a stage gets the sentence that it deserves."""
    stage, limit = int(entry["stage"]), 1 if entry["says"].startswith("takes longer") else LIMIT
    folder = HERE / f"accident_{place}"
    file = wrong_version(entry, course.answer(stage), folder / "body.c")
    try:
        said = [text for _, _, passed, text in course.Student(file, stage, folder).results(limit) if not passed] or ["all is well"]
    except runner.NotBuilt as error:
        said = [str(error)]
    said = [text.replace(str(file), "body.c") for text in said]
    return None if any(s.startswith(entry["says"]) for s in said) else f"stage {stage}: '{entry['wrong']}': says '{said[0]}'"


def accidents():
    course.prepare()
    entries = [entry for entry in holes.paragraphs(ACCIDENTS) if "stage" in entry]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failed = list(filter(None, pool.map(lambda i: accident_fails(entries[i], i), range(len(entries)))))
    if failed:
        sys.exit("\n".join(failed))
    print(f"workshop: {len(entries)} accidents are told in their sentences")
