"""The workshop of the Course: the student's program workshop/body.c, checked stage by stage.

The checks are those of tests/course. One program of checks is made of the tests of a stage and of
all stages before it. It takes body.c in as tests/course/stage.h does. A test of an earlier stage is
left out if it calls a function that the Course's own program of the later stage no longer has."""
import pathlib
import re
import subprocess

import workshop_holes as holes
import workshop_run as runner
from workshop_build import BUILD, HERE, compile_plain

STAGES = range(1, 13)
HINTS = "tests/workshop/hints.txt"
PROJECT = ["-Wunused", "-Wconversion", "-Wshadow", "-pedantic"]  # beside those that every student's file has
HEAD = """#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
extern double kappa __attribute__((weak)); /* not there before stage 3 */
#include "course/stage.h"
"""


def answer(stage):
    return pathlib.Path(f"src/course/body_{stage:02d}.c")


def without_comments(text):
    """C without its comments and strings."""
    return re.sub(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"', " ", text, flags=re.S)


def constants(text):
    lists = re.findall(r"^\s*enum\s*\w*\s*\{([^}]*)\}", without_comments(text), re.M)
    return set(re.findall(r"(?:^|,)\s*(\w+)", "\n".join(lists))) | set(re.findall(r"^\s*#\s*define\s+(\w+)", text, re.M))


def functions(text):
    """Of each function of a program in the Course's layout its lines, with the comment above it."""
    found = re.findall(r"^((?:/\*(?:(?!\*/).)*\*/\n)?\w[\w *]*?\b(\w+)\([^)]*\)(?: \{[^\n]*\}|\n\{.*?^\}))", text, re.M | re.S)
    return {name: lines for lines, name in found}


def variables(text):
    lines = re.findall(r"^(?:double|int) ([^(){};]*);", without_comments(text), re.M)
    return set(re.findall(r"(?:^|,) *(\w+)", "\n".join(lines), re.M))


def prototypes(text):
    """Of each function its head: {"weights": "void weights(double b, int count)"}."""
    return {name: re.search(r"^\w[^)]*\)", re.sub(r"^/\*.*?\*/\n", "", lines, flags=re.S))[0]
            for name, lines in functions(text).items() if name != "main"}


def flat(path):
    """A test with the headers of its folder in the place of the lines that include them."""
    def included(line):
        file = path.parent / line[1]
        return flat(file) if file.exists() and file.name not in ("stage.h", "course_ref.h") else ""
    return re.sub(r'^#include "(\w+\.h)"\n', included, path.read_text(), flags=re.M)


class Check:
    """A test, or a function that tests call: its lines, and the names that it uses."""

    def __init__(self, stage, text, name):
        self.stage, self.text, self.name = stage, text, name
        self.words = set(re.findall(r"(?<!\.)\b[A-Za-z_]\w*", without_comments(text)))
        self.needs = set()


def checks(stage):
    """The tests of a stage, and their functions; each with the names that body.c must have for it."""
    text = flat(pathlib.Path(f"tests/course/test_body_{stage:02d}.c"))
    program = answer(stage).read_text()
    has = set(prototypes(program)) | variables(program) | constants(program)
    tests = [Check(stage, *found) for found in re.findall(r"^(START_TEST\((\w+)\).*?^END_TEST)", text, re.M | re.S)]
    helpers = [Check(stage, *found) for found in re.findall(r"^(static [\w *]*?\b(\w+)\([^)]*\)\n\{.*?^\})", text, re.M | re.S)]
    for one in helpers:
        one.needs = (one.words & has) - {"main"}
    for one in tests:
        one.needs = one.words & has
        for helper in helpers:
            if helper.name in one.words:
                one.needs |= helper.needs
    return tests, helpers


def needed(stage):
    """All names that the checks of a stage use."""
    return set().union(*(test.needs for test in checks(stage)[0]))


def asked(stage):
    """The tests of a stage and those of earlier ones that still make sense, and the functions that they call."""
    here = answer(stage).read_text()
    has, now = needed(stage) | set(prototypes(here)) | variables(here) | constants(here), prototypes(here)
    tests, helpers = checks(stage)
    for earlier in range(stage - 1, 1, -1):  # the first stage is a main only, which the next one changes
        before = prototypes(answer(earlier).read_text())
        more, used = checks(earlier)
        names = {test.name for test in tests}
        tests += [test for test in more if test.name not in names and test.needs <= has
                  and all(before.get(name) == now.get(name) for name in test.needs)]
        helpers += [helper for helper in used if helper.name not in {h.name for h in helpers}]
    called = set().union(*(test.words for test in tests))
    return tests, [helper for helper in helpers if helper.name in called]


class Student:
    """A body.c: compiled alone, and the names that it has."""

    def __init__(self, file, stage, folder, show_warning=0):
        self.file, self.stage, self.folder = pathlib.Path(file), stage, folder
        folder.mkdir(parents=True, exist_ok=True)
        heads = prototypes(answer(stage).read_text())
        self.prelude = folder / "prototypes.h"
        self.prelude.write_text("".join(f"{heads[name]};\n" for name in sorted(set(heads) & needed(stage))))
        try:
            obj = runner.compile_student(self.file, folder / "alone.o", *runner.FLAGS, *PROJECT, "-O0", "-include", self.prelude,
                                         show_warning=show_warning)
        except runner.NotBuilt as error:
            other = re.search(r"(?:conflicting types for|static declaration of) '(\w+)'", str(error))
            if not other or other[1] not in heads:
                raise
            said = re.sub(r"; have '.*'", "", str(error))
            raise runner.NotBuilt(f"{said}: the chapter has {heads[other[1]]}") from None
        self.has = runner.names_of(obj) | constants(self.file.read_text())

    def results(self, seconds, library=None):
        """Of each test that is asked: its stage, its name, whether it passed, and a sentence."""
        tests, helpers = asked(self.stage)
        if not library:
            of_library = {h.name for h in helpers if "fvi_" in h.text}
            helpers = [h for h in helpers if h.name not in of_library]
            tests = [t for t in tests if "fvi_" not in t.text and not of_library & t.words]
        if self.stage == 1 and "main" not in self.has:
            raise runner.NotBuilt(f"there is no main in {self.file}")
        lacks = {test.name: sorted(test.needs - self.has) for test in tests}
        runs = [test for test in tests if not lacks[test.name]]
        told = {}
        if runs:
            told = {name: (passed, text) for name, passed, text in self.run(runs, helpers, seconds, library)}
        return [(t.stage, t.name, *(told.get(t.name) or (False, self.absent(lacks[t.name])))) for t in tests]

    def absent(self, names):
        return f"there is no {' and no '.join(names[:2])} in {self.file}" + (", and more is missing" if len(names) > 2 else "")

    def run(self, tests, helpers, seconds, library):
        called = set().union(*(test.words for test in tests))
        parts = [HEAD, *(part.text for part in [*helpers, *tests] if part in tests or part.name in called),
                 "int main(void)\n{\n    Suite *suite = suite_create(\"body.c\");",
                 f"    ADD_CASE(suite, \"all\", {', '.join(test.name for test in tests)});",
                 "    return run_suite(suite);\n}\n"]
        source = self.folder / "checks.c"
        source.write_text("\n\n".join(parts))
        obj = runner.compile_student(source, self.folder / "checks.o", *runner.FLAGS, "-w", "-I.", "-Isrc", "-Itests",
                                     f'-DSTAGE="{self.file}"', file=self.file)
        binary = runner.link(self.folder / "checks", [self.file], [obj, HERE / "exit.o", *([library] if library else [])])
        return runner.run(binary, [self.file.name], seconds)


def prepare():
    """What every program of checks is linked with."""
    HERE.mkdir(parents=True, exist_ok=True)
    compile_plain("tests/workshop/exit.c")


def latest_complete(file, folder, least):
    """The latest stage, from least on, all of whose functions are in body.c; or least."""
    has = Student(file, 1, folder).has
    return max([stage for stage in STAGES if stage > least and needed(stage) <= has], default=least)


def hints(stage):
    """The three hints for a stage, the gentlest first."""
    found = next((entry for entry in holes.paragraphs(HINTS) if entry["stage"] == str(stage)), {})
    return [found[place] for place in ("first", "second", "third") if place in found]


def added(stage):
    """The functions that are new in a stage, or changed, as text; all of the first one."""
    text = answer(stage).read_text()
    if stage == 1:
        return {"main": text}
    before = functions(answer(stage - 1).read_text())
    return {name: lines for name, lines in functions(text).items() if name != "main" and without_comments(before.get(name, "")) != without_comments(lines)}


def no_longer_needed(stage):
    """The functions of the stage before that this one has not."""
    here = prototypes(answer(stage).read_text())
    return [name for name in prototypes(answer(stage - 1).read_text()) if name not in here]


def rows(file, folder, seconds):
    """The numbers that the program prints, as far as they are rows of a time and a place."""
    program, data = folder / "body", folder / "rows.dat"
    done = runner.say([*runner.CC, *runner.FLAGS, "-w", file, "-lm", "-o", program])
    if done.returncode:
        return None
    subprocess.run(["sh", "-c", f'ulimit -t {seconds}; ulimit -f {runner.FILE_LIMIT}; exec "$0" > "$1"', program, data],
                   stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
    found = []
    for line in data.read_text(errors="replace").splitlines()[:10000]:
        try:
            found.append([float(word) for word in line.split()[:2]])
        except ValueError:
            break
    data.write_text("".join(f"{row[0]!r} {row[1]!r}\n" for row in found if len(row) == 2))
    return data if sum(len(row) == 2 and row[1] == row[1] for row in found) > 1 else None


def library():
    path = BUILD / "libfvi.a"
    return path if path.exists() else None
