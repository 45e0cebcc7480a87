"""The Python package: what it declares is what the headers say.

cffi compares a struct with the header only when the struct is first used. It compiles a call of each function, but in a
call an int becomes a double without a word. Here all structs are read, and all functions declared behind the headers."""
import pathlib
import re
import shutil
import subprocess

import pytest
from fvi._fvi import ffi, lib


def declared():
    """The statements of src/python/declarations, without comments; a brace holds one together."""
    parts = sorted(pathlib.Path("src/python/declarations").glob("*.h"))
    text = "\n".join(part.read_text() for part in parts)
    text = re.sub(r"^#.*$|/\*.*?\*/", "", text, flags=re.M)
    return [each.strip() for each in re.findall(r"(?:[^;{}]|\{[^{}]*\})+;", text)]


def functions():
    return [each for each in declared() if not re.match(r'typedef|enum|struct|extern "Python"', each)]


def refused(statements, tmp_path):
    """What the compiler says of them behind the headers."""
    source = tmp_path / "declared.c"
    source.write_text('#include "python/glue.h"\n' + "\n".join(statements) + "\n")
    flags = subprocess.run(["pkg-config", "--cflags", "gsl"], check=True, capture_output=True, text=True).stdout.split()
    run = subprocess.run(["gcc", "-std=c11", "-D_GNU_SOURCE", "-fsyntax-only", "-Isrc", *flags, str(source)],
                         capture_output=True, text=True)
    return "" if run.returncode == 0 else run.stderr


def test_structs_and_constants_are_those_of_the_headers():
    typedefs, structs, _ = ffi.list_types()
    read = 0
    for name in typedefs + ["struct " + tag for tag in structs]:
        kind = ffi.typeof(name)
        if kind.kind == "struct" and kind.fields is not None:  # ffi.error where a size or a place is another one
            read += len(kind.fields)
    assert read > 200
    for name in dir(lib):
        getattr(lib, name)


@pytest.mark.skipif(not shutil.which("gcc"), reason="no gcc")
def test_functions_are_those_of_the_headers(tmp_path):
    found = functions()
    own = {"ask_value", "ask_gradient", "ask_hessian", "ask_quadratic", "ask_force", "ask_symbol", "ask_event", "ask_normal", "ask_imposed",
           "look_up", "report_progress"}
    called = {name for name in dir(lib) if isinstance(getattr(lib, name), type(lib.fvi_version))}
    assert {match[1] for each in found if (match := re.search(r"(\w+)\(", each))} == called - own and len(called) > 80
    assert refused(found, tmp_path) == ""
    wrong = [each.replace("double alpha, size_t count", "size_t count, double alpha") for each in found]
    assert wrong != found and "conflicting types for 'fvi_gl_weights'" in refused(wrong, tmp_path).replace("‘", "'").replace("’", "'")
