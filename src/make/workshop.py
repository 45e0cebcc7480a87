"""The workshop: a student's own integrator, in workshop/, checked equation by equation.

    workshop.py BUILD start          lay out workshop/, check my.c       (make workshop)
    workshop.py BUILD chapter 04     the skeletons of a chapter      (make workshop-04)
    workshop.py BUILD figure         the first figure, out of my.c (make workshop-figure)
    workshop.py BUILD check          skeletons, holes, stages     (part of make check)
    workshop.py BUILD accidents      the sentences of tests/workshop/accidents.txt (the same)
    workshop.py BUILD exercise 13-2 [ANSWER]           (make exercise-13-2 ANSWER=...)
    workshop.py BUILD exercises      the table of all of them         (make exercises)
    workshop.py BUILD tests [04]     the programs of the tests that name the holes

workshop/ is the student's: what is there is never written over. BUILD holds libfvi.a,
the tests' objects and what is made here, in BUILD/workshop."""
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys

import workshop_exercises as exercises
import workshop_holes as holes
import workshop_run as runner

BUILD = pathlib.Path(sys.argv[1])
HERE = BUILD / "workshop"
MINE = pathlib.Path("workshop/my.c")
STAGES = {1: "02", 2: "04", 3: "05", 4: "07", 5: "08", 6: "09", 7: "10", 8: "12", 9: "13"}
DIALECT = ["-std=gnu11", "-O1", "-g", "-include", "tests/workshop/my.h"]
LIMIT = 10  # seconds of the processor for a test
CASES = [n for n in STAGES if n != 7]  # the seventh is the figure


def compile_plain(source, *flags):
    target = HERE / (pathlib.Path(source).stem + ".o")
    subprocess.run([*runner.CC, *runner.FLAGS, *flags, "-c", source, "-o", target], check=True)
    return target


def harness():
    return [compile_plain("tests/workshop/checks.c", "-O0", "-Itests"),
            compile_plain("tests/workshop/exit.c")]


def thread(source, folder, objects, show_warning=0):
    """The program of all checks, with a my.c in it."""
    folder.mkdir(parents=True, exist_ok=True)
    sanitizers = [f for f in runner.FLAGS if "sanitize" in f]
    mine = runner.compile_student(source, folder / "my.o", *DIALECT, *sanitizers, show_warning=show_warning)
    return runner.link(folder / "checks", [source], [*objects, mine])


def program(source, folder):
    """my.c as it stands, to be run."""
    folder.mkdir(parents=True, exist_ok=True)
    done = runner.say([*runner.CC, *DIALECT, "-O2", source, "-lm", "-o", folder / "my"])
    if done.returncode:
        raise runner.NotBuilt(f"{source} does not become a program: {done.stderr.strip().splitlines()[-1]}")
    return folder / "my"


def rows(text):
    """Names and numbers of the blocks of a figure's data."""
    names, numbers = [], []
    for line in text.splitlines():
        if line.startswith("t "):
            names.append(line)
        elif line and not line.startswith("#"):
            numbers.append([float(word) for word in line.split()])
    return names, numbers


def figure_fails(source, folder):
    """None if my.c prints the data of the first figure, else what differs."""
    try:
        done = subprocess.run([program(source, folder), "figure"], capture_output=True, text=True, timeout=20)
        names, numbers = rows(done.stdout)
    except subprocess.TimeoutExpired:
        return "my figure takes longer than 20 s"
    except ValueError as error:
        return f"a line is not two numbers: {error}"
    if done.returncode:
        return f"the program ends with {done.returncode}"
    (folder / "figure.dat").write_text(done.stdout)
    ours = (BUILD / "figures/experiments/experiments_alphas.dat").read_text()
    want_names, want = rows(ours)
    if names != want_names:
        return f"its curves are named {', '.join(names) or 'nothing'}; wanted: {', '.join(want_names)}"
    if [len(row) for row in numbers] != [len(row) for row in want]:
        return f"it prints {len(numbers)} rows, and {len(want)} are wanted"
    for i, (got, row) in enumerate(zip(numbers, want), 1):
        for a, b in zip(got, row):
            if not abs(a - b) <= 1e-12:
                return "row {} of numbers: got {}, want {}".format(i, *runner.digits(a, b))
    return None


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
    for data in (BUILD / "figures/experiments/experiments_alphas.dat", HERE / "figure.dat"):
        drawn.append(pathlib.Path(HERE, "ours.svg" if "experiments" in data.name else "figure.svg"))
        subprocess.run([os.environ["GNUPLOT"], "-e", f"dat='{data}'; out='{drawn[-1]}'; stem='experiments_alphas'",
                        "figures/experiments/experiments_alphas.gp"],
                       check=True, env={**os.environ, "LC_ALL": "C.UTF-8"})
    same = drawn[0].read_bytes() == drawn[1].read_bytes()
    print(f"drew {drawn[1]}: " + ("byte for byte the course's figure. Well done." if same
                                  else "to 1e-12 the numbers of the course's figure."))


def archive(folder, sources):
    """The library without the modules that the student writes."""
    copy = folder / "libfvi.a"
    shutil.copy(BUILD / "libfvi.a", copy)
    subprocess.run(["ar", "d", copy, *(pathlib.Path(s).stem + ".o" for s in sources)], check=True)
    return copy


def module(source, file, folder, show_warning=0):
    """A student's version of a module, compiled as the library is."""
    return runner.compile_student(file, folder / (pathlib.Path(source).stem + ".o"), *runner.FLAGS, "-Isrc", "-include", "math.h",
                                  f"-I{pathlib.Path(source).parent}", show_warning=show_warning)


def chapter_tests(cuts):
    """The programs of the tests that name the holes."""
    where = holes.tests()
    return list(dict.fromkeys(where[hole.named][0] for hole in cuts))


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
    try:
        objects = [module(source, file, folder, 1) for source, file in files.items()]
        library = [*objects, compile_plain("tests/workshop/exit.c"), archive(folder, files)]
        for test in chapter_tests(cuts):
            binary = runner.link(folder / test, list(files.values()), [BUILD / f"tests/{test}.o", *library])
            runner.show(runner.run(binary, [f.name for f in files.values()], LIMIT))
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
    if not (got := curve(binary, number)).strip():
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


# ---- make check ----

def hole_fails(hole):
    """None if the skeleton with this hole compiles, its test sees it, and the lines fill it."""
    folder = HERE / f"{hole.chapter}-{hole.region}-{pathlib.Path(hole.source).stem}"
    folder.mkdir(parents=True, exist_ok=True)
    where = f"{hole.source}#{hole.region}"
    if hole.named not in holes.tests() or hole.shows not in runner.title(hole.named)[0]:
        return f"{where}: no test {hole.named} that names ({hole.shows})"
    text = holes.skeleton(hole.source, [hole])
    if holes.bare(holes.filled(text, [hole])) != holes.bare(pathlib.Path(hole.source).read_text()):
        return f"{where}: filled, it is not the source"
    file = folder / pathlib.Path(hole.source).name
    file.write_text(text)
    test, case = holes.tests()[hole.named]
    try:
        inputs = [BUILD / f"tests/{test}.o", module(hole.source, file, folder), HERE / "exit.o",
                  archive(folder, [hole.source])]
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
        module(source, file, folder)
    except runner.NotBuilt as error:
        return str(error)
    return None


def stage_fails(number, objects):
    """None if a stage passes the checks up to itself and no later one."""
    source, folder = f"tests/workshop/stage_{number}.c", HERE / f"stage_{number}"
    try:
        binary = thread(source, folder, objects)
        stage = {name: int(case) for name, (_, case) in holes.tests("workshop/checks.c").items()}
        results = dict.fromkeys(CASES, True)
        for name, passed, _ in runner.run(binary, ["my.c"], LIMIT):
            results[stage[name]] &= passed
    except runner.NotBuilt as error:
        return f"{source}: {error}"
    if number >= 7 and (fails := figure_fails(source, folder)):
        return f"{source}: the first figure: {fails}"
    # Nothing is added for stage 5: chapter 8 looks at the mass that stage 4 moves.
    want = {n: n <= number or (number, n) == (4, 5) for n in CASES}
    return None if results == want else f"{source}: passes {[n for n in CASES if results[n]]}"


def check():
    objects, cuts = harness(), holes.holes()
    files = {(hole.chapter, hole.source): [h for h in cuts if (h.chapter, h.source) == (hole.chapter, hole.source)]
             for hole in cuts}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [pool.submit(hole_fails, hole) for hole in cuts]
        jobs += [pool.submit(skeletons_fail, *item) for item in files.items() if len(item[1]) > 1]
        jobs += [pool.submit(stage_fails, number, objects) for number in STAGES]
        failed = [job.result() for job in jobs if job.result()]
    failed += exercises.faults()
    if failed:
        sys.exit("\n".join(failed))
    print(f"workshop: {len(exercises.exercises())} exercises, {len(files)} skeletons compile, {len(cuts)} holes are noticed and filled, "
          f"{len(STAGES)} stages pass their checks")


def accident_fails(entry, place, objects):
    """None if a wrong version of a stage gets the sentence that it deserves."""
    text = pathlib.Path("tests/workshop", entry["stage"]).read_text()
    where = f"{entry['stage']}: '{entry['wrong']}'"
    if text.count(entry["right"]) != 1:
        return f"{where}: '{entry['right']}' stands {text.count(entry['right'])} times there"
    folder, limit = HERE / f"accident_{place}", 1 if entry["says"].startswith("takes longer") else LIMIT
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "my.c"
    file.write_text(text.replace(entry["right"], entry["wrong"]))
    try:
        binary = thread(file, folder, objects)
        said = ["all is well"]
        for case in CASES[:CASES.index(int(entry["stage"][6])) + 1]:
            results = runner.run(binary, ["my.c"], limit, str(case))
            said = [sentence for _, passed, sentence in results if not passed] or said
            if said != ["all is well"]:
                break
    except runner.NotBuilt as error:
        said = [str(error).replace(str(file), "my.c")]
    return None if any(s.startswith(entry["says"]) for s in said) else f"{where}: says '{said[0]}'"


def accidents():
    objects = harness()
    entries = holes.paragraphs("tests/workshop/accidents.txt")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failed = list(filter(None, pool.map(lambda i: accident_fails(entries[i], i, objects), range(len(entries)))))
    if failed:
        sys.exit("\n".join(failed))
    print(f"workshop: {len(entries)} accidents are told in their sentences")


def tests(number=None):
    print(*chapter_tests(holes.holes(number)))


HERE.mkdir(parents=True, exist_ok=True)
{"start": start, "tests": tests, "chapter": chapter, "figure": figure, "check": check, "accidents": accidents, "exercise": exercises.main,
 "exercises": lambda: exercises.TABLE.write_text(exercises.table())}[sys.argv[2]](*sys.argv[3:])
