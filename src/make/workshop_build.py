"""What is built of a student's files: programs of checks, modules, archives."""
import pathlib
import shutil
import subprocess
import sys

import workshop_run as runner

BUILD = pathlib.Path(sys.argv[1])
HERE = BUILD / "workshop"


def compile_plain(source, *flags):
    target = HERE / (pathlib.Path(source).stem + ".o")
    subprocess.run([*runner.CC, *runner.FLAGS, *flags, "-c", source, "-o", target], check=True)
    return target


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


def linked_parts(source, file, folder, test, show_warning=0):
    """What a program of tests takes of a student's version of a source: a module, beside the object of
    the test, or a test that is compiled anew, as that version or with it in the place of its header."""
    if source.startswith("src/"):
        return [BUILD / f"tests/{test}.o", module(source, file, folder, show_warning)]
    path = next(pathlib.Path("tests").glob(f"*/{test}.c"))
    what, *instead = (path, "-include", file) if source.endswith(".h") else (file,)
    return [runner.compile_student(what, folder / f"{test}.o", *runner.FLAGS, "-Isrc", "-Itests", f"-I{path.parent}",
                                   "-include", "math.h", *instead, file=file, show_warning=show_warning)]
