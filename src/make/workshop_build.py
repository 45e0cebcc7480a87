"""What is built of a student's files: programs of checks, modules, archives."""
import pathlib
import shutil
import subprocess
import sys

import workshop_run as runner

BUILD = pathlib.Path(sys.argv[1])
HERE = BUILD / "workshop"
DIALECT = ["-std=gnu11", "-O1", "-g", "-include", "tests/workshop/my.h"]
FIGURE = BUILD / "figures/experiments/experiments_alphas.dat"


def compile_plain(source, *flags):
    target = HERE / (pathlib.Path(source).stem + ".o")
    subprocess.run([*runner.CC, *runner.FLAGS, *flags, "-c", source, "-o", target], check=True)
    return target


def harness():
    return [compile_plain("tests/workshop/checks.c", "-O0", "-Isrc", "-Itests"),
            compile_plain("tests/workshop/exit.c")]


def thread(source, folder, objects, show_warning=0):
    """The program of all checks, with a my.c in it."""
    folder.mkdir(parents=True, exist_ok=True)
    sanitizers = [f for f in runner.FLAGS if "sanitize" in f]
    mine = runner.compile_student(source, folder / "my.o", *DIALECT, *sanitizers, show_warning=show_warning)
    subprocess.run(["objcopy", "--redefine-sym=main=student_main", mine], check=True)
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
            try:
                numbers.append([float(word) for word in line.split()])
            except ValueError:
                raise ValueError(f"`my figure` prints '{line}', which is not two numbers") from None
    return names, numbers


def figure_fails(source, folder):
    """None if my.c prints the data of the first figure, else what differs."""
    try:
        done = subprocess.run([program(source, folder), "figure"], capture_output=True, text=True, timeout=20)
        names, numbers = rows(done.stdout)
    except subprocess.TimeoutExpired:
        return "my figure takes longer than 20 s"
    except ValueError as error:
        return str(error)
    if done.returncode:
        return f"the program ends with {done.returncode}"
    (folder / "figure.dat").write_text(done.stdout)
    ours = FIGURE.read_text()
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


def meeting(source, file, folder, test, show_warning=0):
    """What a program of tests takes of a student's version of a source: a module, beside the object of
    the test, or a test that is compiled anew, as that version or with it in the place of its header."""
    if source.startswith("src/"):
        return [BUILD / f"tests/{test}.o", module(source, file, folder, show_warning)]
    path = next(pathlib.Path("tests").glob(f"*/{test}.c"))
    what, *instead = (path, "-include", file) if source.endswith(".h") else (file,)
    return [runner.compile_student(what, folder / f"{test}.o", *runner.FLAGS, "-Isrc", "-Itests", f"-I{path.parent}",
                                   "-include", "math.h", *instead, file=file, show_warning=show_warning)]
