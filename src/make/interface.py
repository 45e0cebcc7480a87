"""What a user of the library sees, before and after linking.

    interface.py LIBFVI.so

The library exports the names that the headers of src/fvi declare, and no other; and
each header compiles alone, as C11 and, where there is a g++, as C++17; there they compile
together, too, over the headers of the C++ library, whose <cmath> takes three quarters of the
time when each header alone asks for it."""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

HEADERS = sorted(pathlib.Path("src/fvi").rglob("*.h"))


def declared(header):
    """The functions and objects that a header declares."""
    text = re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.S)
    text = re.sub(r"^\s*#.*$", "", text.replace("\\\n", ""), flags=re.M)
    text = re.sub(r'extern "C" \{', "", text)
    while re.search(r"\{[^{}]*\}", text):  # bodies, of the innermost first
        text = re.sub(r"(static inline [^;{}]*)?\{[^{}]*\}", "", text)
    for statement in map(str.strip, text.split(";")):
        if statement.startswith("extern"):
            yield from re.findall(r"\bfvi_\w+(?=,|\[|$)", statement)
        elif not statement.startswith("typedef"):
            yield from re.findall(r"\b(fvi_\w+)\(", statement)[:1]


def exported(library):
    lines = subprocess.run(["nm", "-D", "--defined-only", "-P", library], check=True,
                           capture_output=True, text=True).stdout.splitlines()
    return {line.split()[0] for line in lines}


def compilers():
    """A command, and what it is to compile."""
    gsl = shlex.split(os.environ.get("GSL_CFLAGS", ""))
    strict = ["-Isrc", "-fsyntax-only", "-Wall", "-Wextra", "-pedantic", "-Werror"]
    alone = [[header] for header in HEADERS]
    yield [os.environ.get("CC", "gcc"), "-std=c11", "-x", "c", *strict, *gsl], alone
    if shutil.which("g++"):
        plus = ["g++", "-std=c++17", "-x", "c++", *strict, *gsl]
        yield [*plus, "-nostdinc++"], alone
        yield plus, [HEADERS]
    else:
        print("no g++: the headers were not compiled as C++")


def main():
    promised = {name for header in HEADERS for name in declared(header)}
    given = exported(sys.argv[1])
    wrong = [f"exported, and in no header: {name}" for name in sorted(given - promised)]
    wrong += [f"in a header, and not exported: {name}" for name in sorted(promised - given)]
    for compiler, units in compilers():
        for headers in units:
            unit = "".join(f"#include <{header.relative_to('src')}>\n" for header in headers)
            done = subprocess.run([*compiler, "-"], input=unit, text=True, capture_output=True)
            if done.returncode:
                which = f"{headers[0]} alone" if len(headers) == 1 else "all headers together"
                wrong.append(f"{which}: {' '.join(compiler[:2])} does not compile:\n{done.stderr}")
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"interface: {len(given)} names, {len(HEADERS)} headers")


main()
