"""What `make check` and `make mutants` hold of the workshop.

Every skeleton compiles; every hole makes the test red that names its equation, and filled
again the file is the source; every stage passes the checks up to itself; every exercise
has its head, and its answers are judged rightly; and every accident gets its sentence."""
import concurrent.futures
import os
import pathlib
import sys

import workshop_exercises as exercises
import workshop_holes as holes
import workshop_run as runner
from workshop_build import BUILD, HERE, figure_fails, harness, meeting, module, thread

ACCIDENTS = "tests/workshop/accidents.txt"
LIMIT = 10  # seconds of the processor for a test
STAGES = range(1, 10)
CASES = [n for n in STAGES if n != 7]  # the seventh is the figure


def text_fails(hole):
    """None if the hole can be cut, if the lines fill it, and if its test is there."""
    where = f"{hole.source}#{hole.region}"
    if hole.named not in holes.tests() or hole.shows not in runner.title(hole.named)[0]:
        return f"{where}: no test {hole.named} that names ({hole.shows})"
    text = holes.skeleton(hole.source, [hole])
    if holes.bare(holes.filled(text, [hole])) != holes.bare(pathlib.Path(hole.source).read_text()):
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
        inputs = [*meeting(hole.source, file, folder, test), HERE / "exit.o",
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
        meeting(source, file, folder, holes.tests()[cuts[0].named][0])
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
        for name, passed, said in runner.run(binary, ["my.c"], LIMIT):
            results[stage[name]] &= passed
            # From stage 4 on there is no delta, which must not be called right.
            if stage[name] == 3 and passed and (said == runner.GONE) != (number > 3):
                return f"{source}: {name} says '{said}'"
    except runner.NotBuilt as error:
        return f"{source}: {error}"
    if number >= 7 and (fails := figure_fails(source, folder)):
        return f"{source}: the first figure: {fails}"
    # Nothing is added for stage 5: chapter 8 looks at the mass that stage 4 moves.
    want = {n: n <= number or (number, n) == (4, 5) for n in CASES}
    return None if results == want else f"{source}: passes {[n for n in CASES if results[n]]}"


def text():
    """What needs no compiler: the part of `make text`."""
    if failed := list(filter(None, map(text_fails, holes.holes()))):
        sys.exit("\n".join(failed))


def check():
    objects, cuts = harness(), holes.holes()
    files = {(hole.chapter, hole.source): [h for h in cuts if (h.chapter, h.source) == (hole.chapter, hole.source)]
             for hole in cuts}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = pool.submit(lambda: list(exercises.faults()))  # the longest come first
        jobs = [pool.submit(stage_fails, number, objects) for number in reversed(STAGES)]
        jobs += [pool.submit(skeletons_fail, *item) for item in files.items() if len(item[1]) > 1]
        jobs += [pool.submit(hole_fails, hole) for hole in cuts]
        jobs += [pool.submit(module_accident_fails, entry, i) for i, entry in enumerate(holes.paragraphs(ACCIDENTS))
                 if "module" in entry]
        failed = [job.result() for job in jobs if job.result()] + faults.result()
    if failed:
        sys.exit("\n".join(failed))
    print(f"workshop: {len(exercises.exercises())} exercises, {len(files)} skeletons compile, {len(cuts)} holes are noticed and filled, "
          f"{len(STAGES)} stages pass their checks")


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


def accident_fails(entry, place, objects):
    """None if a wrong version of a stage gets the sentence that it deserves."""
    folder, limit = HERE / f"accident_{place}", 1 if entry["says"].startswith("takes longer") else LIMIT
    file = wrong_version(entry, f"tests/workshop/{entry['stage']}", folder / "my.c")
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
    return None if any(s.startswith(entry["says"]) for s in said) else f"{entry['stage']}: '{entry['wrong']}': says '{said[0]}'"


def accidents():
    objects = harness()
    entries = [entry for entry in holes.paragraphs(ACCIDENTS) if "stage" in entry]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failed = list(filter(None, pool.map(lambda i: accident_fails(entries[i], i, objects), range(len(entries)))))
    if failed:
        sys.exit("\n".join(failed))
    print(f"workshop: {len(entries)} accidents are told in their sentences")
