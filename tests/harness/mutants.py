"""The tests are tested: build each wrong version of tests/*/mutants.txt, run the
test file that must notice, and see that the named test fails.

    mutants.py BUILD [STEM ...]     (make mutants; CC, CFLAGS, LIBS from there)
    mutants.py --lines              (part of make text: does each line stand, and each test?)

An entry of tests/*/mutants.txt is four lines and a blank one:
    file   src/methods/fvi.c
    right  one piece of that file, standing there exactly once
    wrong  what it becomes
    named  the test that must fail
and, where the test can tell them apart only with a header of an optional package, or under a
sanitizer of the compiler, with which the wrong file is then compiled, a fifth:
    with   suitesparse/cholmod.h
    under  address
A mutant that does not compile, survives, or dies without its test fails the run; so does a
test that fails without a mutant, which would name everything."""
import concurrent.futures
import os
import pathlib
import re
import shlex
import subprocess
import sys
import time

BUILD = pathlib.Path(sys.argv[1])
STEMS = set(sys.argv[2:])
CC = shlex.split(os.environ["CC"]) + shlex.split(os.environ.get("CFLAGS", ""))
LIBS = shlex.split(os.environ.get("LIBS", ""))
PROGRAM = {path.stem: path for room in ("program", "command_*", "output", "options", "input") for path in sorted(pathlib.Path("src").glob(f"{room}/*.c"))}
FOUND = [(name, path) for path in sorted(pathlib.Path("tests").glob("*/test_*.c"))
         for name in re.findall(r"START_TEST\(\s*(\w+)\s*\)", path.read_text())]
TESTS, NAMES = dict(FOUND), [name for name, _ in FOUND]

SURVIVED = "it survived"


def entries():
    pages = [path.read_text() for path in sorted(pathlib.Path("tests").glob("*/mutants.txt"))]
    text = re.sub(r"^#.*\n", "", "\n\n".join(pages), flags=re.M)
    for block in filter(str.strip, re.split(r"\n\s*\n", text)):
        entry = dict((line.split(None, 1) + [""])[:2] for line in block.strip().splitlines())
        header = entry.pop("with", None)
        sanitizer = entry.pop("under", None)
        if set(entry) != {"file", "right", "wrong", "named"}:
            sys.exit(f"tests/*/mutants.txt: not four lines:\n{block}")
        entry["options"] = [f"-fsanitize={sanitizer}"] if sanitizer else []
        if STEMS and pathlib.Path(entry["file"]).stem not in STEMS:
            continue
        if header and not pathlib.Path("/usr/include", header).exists():
            print(f"left out: {entry['file']}: {entry['right']}: there is no {header}")
        else:
            yield entry


def misplaced(entry):
    """Why this is no mutant of the code as it is; None if it is one."""
    file = pathlib.Path(entry["file"])
    if not file.exists():
        return "there is no such file"
    times = file.read_text().count(entry["right"])
    if times != 1:
        return f"'{entry['right']}' stands {times} times there"
    if file.suffix == ".h":
        return "a header is no mutant's place"
    return None if entry["named"] in TESTS else f"there is no test {entry['named']}"


def compile_object(source, target, *beside):
    subprocess.run([*CC, "-w", "-Isrc", "-Itests", *beside, "-c", source, "-o", target], check=True)
    return target


def runs_the_program(test):
    """Does a test, or a header of its folder that it includes, include program.h?"""
    beside = [test.parent / name for name in re.findall(r'^#include "([\w.]+)"', test.read_text(), re.M)]
    return any(file.name == "program.h" or file.exists() and runs_the_program(file) for file in beside)


def build(folder, entry, test):
    """The test binary, and the program if the test runs it, with the mutant in."""
    file = pathlib.Path(entry["file"])
    mutant = folder / file.name
    mutant.write_text(file.read_text().replace(entry["right"], entry["wrong"]))
    wrong = compile_object(mutant, folder / "mutant.o", "-I" + str(file.parent), *entry["options"])
    program = [wrong if file.stem == p else BUILD / "mutants" / f"{p}.o" for p in PROGRAM]
    if file.parent.name == "course":  # a stage stands within its test
        return subprocess.run([*CC, "-w", "-Isrc", "-Itests", f'-DSTAGE="{mutant.resolve()}"', test, BUILD / "libfvi.a", *LIBS,
                               "-o", folder / "test"], check=True)
    library = [] if file.stem in PROGRAM else [wrong]
    library += [BUILD / "peers.a", BUILD / "libfvi.a"]
    parser = folder / "program.a"  # without main; of it the test takes what it needs
    parser.unlink(missing_ok=True)
    subprocess.run(["ar", "rcs", parser, *(o for o, p in zip(program, PROGRAM) if p != "fvi_cli")], check=True)
    subprocess.run([*CC, BUILD / "mutants" / f"{test.stem}.o", parser, *library, *LIBS,
                    *entry["options"], "-o", folder / "test"], check=True)
    if runs_the_program(test):
        subprocess.run([*CC, *program, *library, *LIBS, *entry["options"], "-o", folder / "fvi"], check=True)


def watched(command, environment, seconds):
    """Its exit code and what it says. One that does not end is asked to, not killed: Check
    then ends the test that runs, which is a process of its own."""
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          text=True) as process:
        try:
            said = process.communicate(timeout=seconds)[0]
            return process.returncode, said
        except subprocess.TimeoutExpired:
            process.terminate()
            raise


def run(number, entry):
    """None if the mutant was named, else what happened; SURVIVED where nothing did."""
    if wrong := misplaced(entry):
        return wrong
    try:
        test = TESTS[entry["named"]]
        folder = BUILD / "mutants" / str(number)
        folder.mkdir(parents=True, exist_ok=True)
        build(folder, entry, test)
        # A mutant may never end; a test as it is ends, also on a machine that is busy.
        busy = 1 if entry["wrong"] != entry["right"] else 10
        environment = dict(os.environ, FVI=str(folder / "fvi"), CK_VERBOSITY="normal",
                           CK_DEFAULT_TIMEOUT=str(20 * busy), ASAN_OPTIONS="detect_leaks=0", CPATH=str(pathlib.Path("src").resolve()))
        status, said = watched([folder / "test"], environment, 120 * busy)
    except subprocess.CalledProcessError:
        return "it does not compile"
    except subprocess.TimeoutExpired:
        return "no end within two minutes"
    failed = re.findall(r":[FE]:[^:]*:(\w+):", said)
    if entry["named"] in failed:
        return None
    if not failed:
        return "it died and no test was named" if status else SURVIVED
    return "it was named by " + ", ".join(sorted(set(failed)))


def main():
    began = time.time()
    if len(TESTS) != len(NAMES):
        sys.exit("two tests have the same name: " + ", ".join(n for n in TESTS if NAMES.count(n) > 1))
    todo = list(entries())
    if not todo:
        sys.exit("no mutant was tried")
    if str(BUILD) == "--lines":
        faults = [f"{entry['file']}: {fault}" for entry in todo if (fault := misplaced(entry))]
        if faults:
            sys.exit("\n".join(faults) + "\nmutants whose line or test is another now: tests/*/mutants.txt")
        print(f"mutants: each of {len(todo)} lines stands once, and each test is there")
        return
    (BUILD / "mutants").mkdir(parents=True, exist_ok=True)
    for name, path in PROGRAM.items():
        compile_object(path, BUILD / "mutants" / f"{name}.o")
    for test in {TESTS[e["named"]] for e in todo if e["named"] in TESTS}:
        compile_object(test, BUILD / "mutants" / f"{test.stem}.o")
    ones = {(TESTS[e["named"]], *e["options"]): dict(e, wrong=e["right"]) for e in todo if e["named"] in TESTS}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for entry, verdict in zip(ones.values(), pool.map(run, range(len(ones)), ones.values())):
            if verdict != SURVIVED:
                named = entry["named"]
                sys.exit(f"{TESTS[named]} as it is: {verdict or named + ' fails'}")
        verdicts = list(pool.map(run, range(len(todo)), todo))
    for entry, verdict in zip(todo, verdicts):
        if verdict:
            print(f"{entry['file']}: {entry['right']} -> {entry['wrong']}: {verdict}")
    bad = sum(map(bool, verdicts))
    print(f"{len(todo) - bad} of {len(todo)} mutants named by their test, "
          f"{time.time() - began:.0f} s")
    sys.exit(bad > 0)


main()
