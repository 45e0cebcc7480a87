"""Test the tests: build each wrong version of tests/*/mutants.txt, run the test file
that must notice it, and check that the named test fails.

    mutants.py BUILD [STEM ...]     (make mutants; CC, CFLAGS, LIBS from there)
    mutants.py --lines              (part of make text: does each line and each test still exist?)

An entry of tests/*/mutants.txt is four lines and a blank one:
    file   src/methods/fvi.c
    right  a piece of this file that occurs there exactly once
    wrong  its replacement
    named  the test that must fail
A fifth line is needed if the test can notice the mutant only with a header of an optional package,
or only if the wrong file is compiled with a sanitizer:
    with   suitesparse/cholmod.h
    under  address
The run fails if a mutant does not compile, survives, or ends without a failure of its test. It also
fails if a test fails without a mutant, because such a test would notice every mutant."""
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
    """Return why this entry does not fit the code as it is; None if it fits."""
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
    """Return whether a test, or a header of its folder that it includes, includes program.h."""
    beside = [test.parent / name for name in re.findall(r'^#include "([\w.]+)"', test.read_text(), re.M)]
    return any(file.name == "program.h" or file.exists() and runs_the_program(file) for file in beside)


def build(folder, entry, test):
    """Build the test with the mutant, and the program if the test runs it."""
    file = pathlib.Path(entry["file"])
    mutant = folder / file.name
    mutant.write_text(file.read_text().replace(entry["right"], entry["wrong"]))
    wrong = compile_object(mutant, folder / "mutant.o", "-I" + str(file.parent), *entry["options"])
    program = [wrong if file.stem == p else BUILD / "mutants" / f"{p}.o" for p in PROGRAM]
    if file.parent.name == "course":  # a test of the Course includes its stage
        return subprocess.run([*CC, "-w", "-Isrc", "-Itests", f'-DSTAGE="{mutant.resolve()}"', test, BUILD / "libfvi.a", *LIBS,
                               "-o", folder / "test"], check=True)
    library = [] if file.stem in PROGRAM else [wrong]
    library += [BUILD / "peers.a", BUILD / "libfvi.a"]
    parser = folder / "program.a"  # without main; the linker takes the objects that the test needs
    parser.unlink(missing_ok=True)
    subprocess.run(["ar", "rcs", parser, *(o for o, p in zip(program, PROGRAM) if p != "fvi_cli")], check=True)
    subprocess.run([*CC, BUILD / "mutants" / f"{test.stem}.o", parser, *library, *LIBS,
                    *entry["options"], "-o", folder / "test"], check=True)
    if runs_the_program(test):
        subprocess.run([*CC, *program, *library, *LIBS, *entry["options"], "-o", folder / "fvi"], check=True)


def watched(command, environment, seconds):
    """Run a command. Return its exit code and its output. A command that does not end is terminated, not
    killed, so that Check can end the running test, which is a process of its own."""
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          text=True) as process:
        try:
            said = process.communicate(timeout=seconds)[0]
            return process.returncode, said
        except subprocess.TimeoutExpired:
            process.terminate()
            raise


def run(number, entry):
    """Return None if the named test failed, else what happened; SURVIVED if nothing did."""
    if wrong := misplaced(entry):
        return wrong
    try:
        test = TESTS[entry["named"]]
        folder = BUILD / "mutants" / str(number)
        folder.mkdir(parents=True, exist_ok=True)
        build(folder, entry, test)
        # A mutant may never end. A test without a mutant ends, also on a busy machine, so it gets more time.
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
