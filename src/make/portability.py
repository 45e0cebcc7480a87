"""The same digits everywhere: other compilers, options, C libraries, locales, whole numbers.

    portability.py BUILD [PART ...]     (make portability PARTS="clang san"; all, half an hour)

Each build has a folder of its own in BUILD/portability. It runs the tests, or those of
them that concern it, and tests/run/trajectories.c, whose runs are compared
with those of gcc -O2: to the bit where the C library is the same, and where only
+ - * / sqrt and fma occur, which IEEE 754 determines. Where pow, exp, sin or gamma is
that of another library, or -O3 -march=native may take what follows from them in
another order (seen: 9 runs of 252, 2.1 u), a run of 96 steps may differ by LIMIT u of the
largest |x| or |p|, u = 2^-53: a sanity limit, not a bound that is derived. The part
`processor` needs no such limit, for it compares each call of a function. The part `bare` types the two commands of README.md on a
Debian that has nothing else (bare.sh: root, debootstrap, a network). What this machine has not, or was not asked for, is
left out, and said. Only the standard library
is used."""
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys

HOME = pathlib.Path(sys.argv[1]) / "portability"
PARTS = "processor locale O0 native clang san threads valgrind m32 musl proofs bare".split()
ASKED = sys.argv[2:] or PARTS
LIMIT = 256     # seen: 18 with musl, 96 with GSL's LU factors on x87 (i386)
ENV = {k: v for k, v in os.environ.items() if not k.startswith(("MAKE", "MFLAGS", "LC_", "LANG"))}
# Seconds of a test mean nothing under ASan; and a program that compiles a potential finds the
# headers beside its folder, which is not where these are built.
ENV |= {"CC": "gcc", "CK_TIMEOUT_MULTIPLIER": "10", "CPATH": str(pathlib.Path("src").resolve())}
ARCH = pathlib.Path("/usr/lib/i386-linux-gnu")
GSL = pathlib.Path("/usr/lib/x86_64-linux-gnu")
report, left_out, failed = [], [], []


def run(words, **env):
    """(it went well, all that it printed)"""
    done = subprocess.run(list(map(str, words)), env=ENV | {k: str(v) for k, v in env.items()}, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.returncode == 0, done.stdout


def make(name, goals, variables, **env):
    """A goal of the Makefile in the build's own folder."""
    return run(["make", "--no-print-directory", f"B={HOME / name}", *variables, *goals], **env)


def checks(text):
    return sum(map(int, re.findall(r"Checks: (\d+), Failures: 0, Errors: 0", text)))


def say(name, well, text, words):
    """One line of the report, and what went wrong at once."""
    report.append(f"{name}: {words}" if well else f"{name}: FAILED")
    print(report[-1], flush=True)
    if not well:
        failed.append(name)
        lines = text.splitlines()
        print("\n".join([v for v in lines[:-25] if re.search(":[EF]:|error|Error [0-9]", v)] + lines[-25:]))


# ---- the same digits ----

def trajectories(program, **env):
    """name -> what it needs, its status, its numbers"""
    well, text = run([program], **env)
    if not well:
        return {}, text
    rows = (line.split("\t") for line in text.splitlines())
    return {name: (needs, status, numbers.split()) for needs, name, status, numbers in rows}, text


def distance(one, other):
    """Largest difference of the x, and of the p, in u of the largest: 3 x, 3 p, 3 x, ..."""
    parts = []
    for half in (0, 1):
        a, b = ([float.fromhex(v) for i, v in enumerate(row) if i // 3 % 2 == half] for row in (one, other))
        parts += [abs(s - t) / max(map(abs, b)) * 2**53 for s, t in zip(a, b)]
    return max(parts) if all(map(math.isfinite, parts)) else math.inf


def compare(name, reference, program, free=(), **env):
    """The runs of `program` against the reference: to the bit, but for the kinds in `free`."""
    found, text = trajectories(program, **env)
    well, equal, worst = found.keys() == reference.keys() and len(found) > 0, 0, 0.0
    for run_, (needs, status, row) in found.items() if well else ():
        want = reference[run_]
        if (needs, status, row) == want:
            equal += 1
            continue
        away = distance(row, want[2]) if status == want[1] and len(row) == len(want[2]) else float("inf")
        worst = max(worst, away)
        if needs not in free or not away <= LIMIT:
            well, text = False, f"{run_} ({needs}) is off by {away:.3g} u\n{row}\n{want[2]}"
            break
    rest = len(found) - equal
    words = f"{equal} of {len(found)} runs equal to the bit"
    if rest:
        words += f", the other {rest} ({', '.join(free)}) to {worst:.2g} u"
    return well, text, words


def build_and_compare(name, label, reference, variables, goals, free=(), **env):
    """Build, test, compare; one line."""
    well, text = make(name, [*goals, f"{HOME / name}/trajectories"], variables, **env)
    words = f"{checks(text)} checks; " if checks(text) else "builds; "
    if well:
        well, text, more = compare(label, reference, HOME / name / "trajectories", free, **env)
        words += more
    say(label, well, text, words)


# ---- what a machine may lack ----

def have(tool, label):
    if shutil.which(tool) is None:
        left_out.append(f"{label}: there is no {tool}")
        return False
    return True


def compiles(words, label):
    source = HOME / "one.c"
    source.write_text("#include <stdio.h>\nint main(void) { return puts(\"\") < 0; }\n")
    well, text = run([*words, source, "-o", HOME / "one"])
    if not well:
        left_out.append(f"{label}: {' '.join(words)} does not link a program")
    return well


def gsl_of_32_bits():
    """A folder with GSL and Check for i386; fetched, not installed, where apt-get is."""
    if (ARCH / "libgsl.so.27").exists() and (ARCH / "libcheck_pic.a").exists():
        return ARCH
    here = (HOME / "i386").resolve()
    lib = here / "root/usr/lib/i386-linux-gnu"
    if not (lib / "libgsl.so.27").exists() and shutil.which("apt-get"):
        print("fetching Debian's GSL and Check for i386 into", HOME / "i386", "(nothing is installed)", flush=True)
        for part in ("lists/partial", "cache/archives/partial", "root"):
            (here / part).mkdir(parents=True, exist_ok=True)
        own = [f"-o{v}" for v in ("APT::Architecture=i386", "APT::Architectures::=i386", "Debug::NoLocking=1",
                                  f"Dir::State::lists={here}/lists", f"Dir::Cache={here}/cache",
                                  "Dir::State::status=/dev/null", "APT::Sandbox::User=")]
        run(["apt-get", *own, "update", "-qq"])
        run(["sh", "-c", f'cd "{here}" && apt-get {" ".join(own)} download libgsl27 libgslcblas0 check libsubunit0 '
                         "&& for d in *.deb; do dpkg -x $d root; done"])
    return lib if (lib / "libgsl.so.27").exists() else None


# ---- the builds ----

def compiled(name, label, words, env, reference):
    """All tests by another compiler, or with other options."""
    compiler, options = words[0][3:], [w for w in " ".join(words).split() if w.startswith("-fsanitize=")]
    if have(compiler, label) and compiles([compiler, *options], label):
        goals = ["test", *([] if options else ["test-headers"])]  # the examples leave their memory to the system
        build_and_compare(name, label, reference, words, goals, **env)


def german(reference):
    """The tests of the first build where the decimal point is a comma."""
    label, place = "gcc -O2, LC_ALL=de_DE.UTF-8", (HOME / "locale").resolve()
    place.mkdir(exist_ok=True)
    if not have("localedef", label):
        return
    run(["localedef", "-i", "de_DE", "-f", "UTF-8", place / "de_DE.UTF-8"])
    env = {"LC_ALL": "de_DE.UTF-8", "LOCPATH": place}
    if run(["locale", "decimal_point"], **env)[1].strip() != ",":
        left_out.append(f"{label}: localedef could not make it")
        return
    build_and_compare("gcc", label, reference, ["CC=gcc"], ["test"], **env)


def processor(reference):
    """A processor without AVX2 and fma: other clones of our sums, other functions of libm.

    libgcc asks the processor itself, so a program of its own gets the other clones. The
    loader chooses the functions of libm, and a tunable chooses for it. Two functions of pow
    may round to different neighbours (they do for 28.5^-0.25). So each call must agree with
    that of the reference within a bound that follows from their accuracy
    (tests/run/recorded_functions.c), and with the reference's value the runs must be equal to
    the bit. That includes fma, which libm then makes of whole numbers."""
    well, text = make("plain", [HOME / "plain/trajectories"],
                      ["CC=gcc", "CHOLMOD_LIBS=tests/run/processor_without_vectors.c "
                       "-Wl,--as-needed -lumfpack -lcholmod -Wl,--no-as-needed"])
    words = ""
    if well:
        well, text, words = compare("", reference, HOME / "plain/trajectories")
    say("gcc -O2, the clones without AVX2", well, text, words)
    label, library, calls = "gcc -O2, the functions without AVX2 and fma", HOME / "functions.so", HOME / "functions"
    well, text = run(["gcc", "-std=c11", "-O1", "-fno-builtin", "-fPIC", "-shared", "tests/run/recorded_functions.c",
                      "-o", library, "-lm", "-ldl"])
    preload = {"LD_PRELOAD": library.resolve()}
    if well:
        well, text, words = compare("", reference, HOME / "gcc/trajectories", FVI_RECORD=calls, **preload)
    if well:
        tunables = "glibc.cpu.hwcaps=" + ",".join(f"-{v}{end}" for v in ("AVX2", "AVX512F", "FMA", "FMA4")
                                                  for end in ("", "_Usable"))
        well, text, words = compare("", reference, HOME / "gcc/trajectories", FVI_REPLAY=calls,
                                    GLIBC_TUNABLES=tunables, **preload)
    say(label, well, text, words)


def threads():
    """No races: runs in two threads under ThreadSanitizer."""
    label, flags = "gcc ThreadSanitizer", ["CFLAGS=-O1 -g -fsanitize=thread"]
    if compiles(["gcc", "-fsanitize=thread"], label):
        test = HOME / "tsan/tests/test_threads"
        well, text = make("tsan", [test], flags)
        if well:
            well, text = run([test], CK_FORK="no", TSAN_OPTIONS="halt_on_error=1")
        say(label, well, text, f"{checks(text)} check, runs in two threads equal to those of one")


def thirty_two(reference):
    label = "gcc -m32"
    if not compiles(["gcc", "-m32"], label):
        return
    lib = gsl_of_32_bits()
    if lib is None:
        left_out.append(f"{label}: no GSL for i386 to be had")
        return
    # The FPU of the 8087 rounds to other lengths: double_double.h refuses it. GSL was
    # compiled for it, so that its LU factors differ.
    left_out.append(f"{label}: the program and the tests that open CHOLMOD, which is not fetched for i386")
    build_and_compare("m32", label, reference,
                      ["CC=gcc -m32", "CFLAGS=-O2 -g -msse2 -mfpmath=sse", "CHOLMOD_LIBS=",
                       f"GSL_LIBS={lib}/libgsl.so.27 {lib}/libgslcblas.so.0 -lm",
                       f"CHECK_LIBS={lib}/libcheck_pic.a {lib}/libsubunit.so.0 -pthread -lrt -lm"],
                      ["test-past", "test-coefficients"],
                      ("linear algebra", "functions"), LD_LIBRARY_PATH=lib)


def musl(reference):
    label = "musl-gcc -static"
    if not have("musl-gcc", label):
        return
    if not (GSL / "libgsl.a").exists():
        left_out.append(f"{label}: there is no {GSL}/libgsl.a")
        return
    include = (HOME / "headers").resolve()     # of /usr/include nothing but GSL and CHOLMOD
    include.mkdir(exist_ok=True)
    for folder in ("gsl", "suitesparse"):
        if not (include / folder).exists():
            (include / folder).symlink_to(f"/usr/include/{folder}")
    left_out.append(f"{label}: the program, for there is no CHOLMOD of musl")
    build_and_compare("musl", label, reference,
                      ["CC=musl-gcc", f"GSL_CFLAGS=-I{include}", "CHOLMOD_LIBS=",
                       f"GSL_LIBS={GSL}/libgsl.a {GSL}/libgslcblas.a -lm -static"],
                      [], ("functions",))


def memory_errors():
    label, stems = "valgrind", ("past", "trajectory")
    if have("valgrind", label):
        well, text = make("gcc", [f"valgrind-{stem}" for stem in stems], ["CC=gcc"])
        say(label, well, text, f"{len(stems)} of the stems, {' and '.join(stems)}, no error and no leak")


def proofs():
    """The headers of the proofs, in Python's whole numbers where mpmath and sympy take those of gmpy2."""
    label = "proofs without gmpy2"
    if run([sys.executable, "-c", "import gmpy2, sympy"])[0]:
        well, text = make("proofs", ["verify"], [], MPMATH_NOGMPY=1, SYMPY_GROUND_TYPES="python")
        say(label, well, text, f"{len(list((HOME / 'proofs/verify').glob('*.ok')))} headers equal to the byte")
    else:
        left_out.append(f"{label}: there is no gmpy2, or no sympy, so that `make verify` has no other numbers")


def bare():
    """README's two commands on a minimal Debian; 77 of bare.sh says that this machine cannot try it."""
    label = "a bare Debian"
    done = subprocess.run(["nice", "sh", "src/make/bare.sh", HOME / "bare"], env=ENV, text=True, stdout=subprocess.PIPE)
    if done.returncode == 77:
        left_out.append(f"{label}: {done.stdout.strip()}")
    else:
        say(label, done.returncode == 0, done.stdout, done.stdout.strip())


def main():
    unknown = [part for part in ASKED if part not in PARTS]
    if unknown:
        sys.exit(f"no part {', '.join(unknown)}; the parts are {', '.join(PARTS)}")
    HOME.mkdir(parents=True, exist_ok=True)
    well, text = make("gcc", [f"{HOME}/gcc/trajectories"], ["CC=gcc"])
    reference, text = trajectories(HOME / "gcc/trajectories") if well else ({}, text)
    if not reference:
        sys.exit(text)
    say("gcc -O2", True, "", f"{len(reference)} runs, the measure of the others")
    builds = {
        "O0": ("gcc -O0", ["CC=gcc", "CFLAGS=-O0 -g"], {}),
        "native": ("gcc -O3 -march=native", ["CC=gcc", "CFLAGS=-O3 -march=native -g"], {"free": ("functions",)}),
        "clang": ("clang -O2", ["CC=clang"], {}),
        "san": ("gcc AddressSanitizer, UBSan",
                ["CC=gcc", "CFLAGS=-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all"],
                {"ASAN_OPTIONS": "allocator_may_return_null=1"})}
    others = {"processor": lambda: processor(reference), "locale": lambda: german(reference), "threads": threads,
              "valgrind": memory_errors, "proofs": proofs, "bare": bare,
              "m32": lambda: thirty_two(reference), "musl": lambda: musl(reference)}
    for part in ASKED:
        if part in builds:
            compiled(part, *builds[part], reference)
        else:
            others[part]()
    left_out.extend(f"{part}: not asked for" for part in PARTS if part not in ASKED)
    print("\nportability:", *report, sep="\n  ")
    print("left out:" if left_out else "nothing was left out", *left_out, sep="\n  ")
    sys.exit(f"failed: {', '.join(failed)}" if failed else 0)


main()
