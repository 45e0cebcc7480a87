"""Build a student's file, run the tests on it, and say in sentences what happened."""
import os
import pathlib
import re
import shlex
import subprocess
import xml.etree.ElementTree as xml

CC = shlex.split(os.environ.get("CC", "gcc"))
FLAGS = shlex.split(os.environ.get("FLAGS", ""))
LIBS = shlex.split(os.environ.get("LIBS", ""))
WARNINGS = ["-Wall", "-Wextra", "-Wno-unused", "-Wno-unused-parameter"]
# What was never set shows: the stack is filled with a pattern here, the heap below.
STUDENT = [*WARNINGS, "-ftrivial-auto-var-init=pattern", "-fno-omit-frame-pointer"]
ENDS = ("exit", "_exit", "_Exit", "quick_exit")
SANITIZERS = {
    "ASAN_OPTIONS": "exitcode=77:detect_leaks=1:allocator_may_return_null=1:hard_rss_limit_mb=3000:"
                    "max_malloc_fill_size=1000000000:malloc_fill_byte=255",
    "UBSAN_OPTIONS": "exitcode=77:print_stacktrace=1"}

ACCIDENTS = [  # what a sanitizer calls it, and a person
    (r"SEGV on unknown address 0x0000000000[0-9a-f]{2}\b", "follows a null pointer"),
    (r"null pointer", "follows a null pointer"),
    (r"stack-overflow", "fills the stack: a recursion without end, or a huge local array"),
    (r"buffer-overflow(.|\n)*?\nREAD", "reads beyond an array"),
    (r"buffer-overflow(.|\n)*?\nWRITE", "writes beyond an array"),
    (r"out of bounds", "goes beyond an array"),
    (r"heap-use-after-free", "uses memory that was given back"),
    (r"attempting double-free", "gives memory back twice"),
    (r"bad-free|not malloc\(\)-ed", "gives back what malloc never gave"),
    (r"stack-use-after", "uses a local variable that is no more"),
    (r"detected memory leaks", "never gives memory back: a malloc without its free"),
    (r"division by zero", "divides an integer by zero"),
    (r"integer overflow", "lets an integer overflow"),
    (r"allocation-size-too-big|requested allocation size", "asks malloc for more than there is"),
    (r"rss limit", "takes more than 3 GB"),
    (r"SEGV|SIGSEGV", "touches memory that is not its own"),
    (r"FPE|SIGFPE", "divides an integer by zero"),
    (r"SIGABRT|Abort", "ends by abort"),
]


ENDLESS = "takes longer than"
FILE_LIMIT = 65536  # the size of a file that a student's program may write, in blocks of 512 bytes


class NotBuilt(Exception):
    """A sentence that says why there is nothing to run."""


def say(command):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, errors="replace",
                          env={**os.environ, "LC_ALL": "C"})


def compile_student(source, target, *flags, file=None, show_warning=0):
    """The object of a student's file, or of a source that takes it in; its first warning is printed."""
    done = say([*CC, *STUDENT, *flags, "-c", source, "-o", target])
    file = file or source
    name = pathlib.Path(file).name
    notes = re.findall(r"^[^\n]*?" + re.escape(name) + r":(\d+):\d+: (?:fatal )?(error|warning): (.*?)(?: \[-W.*\])?$",
                       done.stderr, re.M)
    if done.returncode:
        where = [f"line {line}: {text}" for line, kind, text in notes if kind == "error"]
        raise NotBuilt(f"{file} does not compile: {(where or done.stderr.splitlines()[-1:])[0]}")
    for line, _, text in notes[:show_warning]:
        print(f"  (a warning of the compiler, line {line}: {text})")
    renamed = [f"--redefine-sym={name}=student_{name}" for name in ENDS]
    subprocess.run(["objcopy", *renamed, target], check=True)
    return target


def symbols(file):
    """What an object, or each member of an archive, defines for others: {"coefficients.o": {...}}."""
    found = {}
    for line in say(["nm", "-A", "-g", "--defined-only", file]).stdout.splitlines():
        place, _, name = line.rpartition(" ")
        member = re.search(r"([^:/]+\.o):", place)[1]
        found.setdefault(member, set()).add(name)
    return found


def names_of(obj):
    """What an object defines, static or not."""
    lines = say(["nm", "--defined-only", obj]).stdout.splitlines()
    return {line.split()[-1].split(".")[0] for line in lines}


def each_has_one_place(file, obj, library):
    """A student's object must define what the module did that it replaces, and no more of the library."""
    ours, mine = symbols(library), symbols(obj).get(pathlib.Path(obj).name, set())
    own = ours.pop(pathlib.Path(obj).name)
    for name in sorted(own - mine):
        if not name.startswith("__"):
            raise NotBuilt(f"there is no {name} in {file}: it must be there, under this name, not static")
    for member, names in ours.items():
        for name in sorted(names & mine):
            raise NotBuilt(f"{name} is defined in {file}, and a second time in {member[:-2]}.c: each function has one place")


def link(target, files, inputs):
    done = say([*CC, *FLAGS, *inputs, *LIBS, "-o", target])
    if done.returncode == 0:
        return target
    names = " or ".join(str(f) for f in files)
    missing = re.search(r"undefined reference to [`'](\w+)'", done.stderr)
    twice = re.search(r"multiple definition of [`'](\w+)'", done.stderr)
    if twice:
        raise NotBuilt(f"{twice[1]} is defined in {names}, and a second time elsewhere: "
                       "each function has one place")
    if missing:
        raise NotBuilt(f"there is no {missing[1]} in {names}: it must be there, under this name, not static")
    raise NotBuilt(f"{names} does not link: {done.stderr.strip().splitlines()[-1]}")


def reports(stderr):
    """What the sanitizers wrote, one text for each process that they ended."""
    start = r"(?=^==\d+==\s?(?:ERROR|HARD)|^[^\n]*: runtime error: )"
    return [part for part in re.split(start, stderr, flags=re.M)
            if re.match(r"==\d+==|[^\n]*: runtime error", part) and "Shadow byte" not in part[:20]]


def accident(report, names):
    what = next((text for pattern, text in ACCIDENTS if re.search(pattern, report, re.I)), None)
    if not what:
        text = re.search(r"runtime error: (.*)|Sanitizer: (.*)", report)
        what = f"is stopped: {text[1] or text[2]}" if text else "dies"
    for name in names:
        line = re.search(re.escape(name) + r":(\d+)", report)
        if line:
            return f"{what} ({name}, line {line[1]})"
    return what


def run(binary, names, seconds, case=None):
    """Of each test: its name, whether it passed, and a sentence. A test may take so many
    seconds of the processor, which are the same on a machine that does other things, too."""
    log = pathlib.Path(f"{binary}.xml")
    log.unlink(missing_ok=True)
    env = {**os.environ, **SANITIZERS, "CK_VERBOSITY": "silent", "CK_XML_LOG_FILE_NAME": str(log),
           "CK_TIMEOUT_MULTIPLIER": "2"}
    for word in ("SEEN", "CK_RUN_CASE", "CK_FORK"):
        env.pop(word, None)
    if case:
        env["CK_RUN_CASE"] = case
    with subprocess.Popen(["sh", "-c", f'ulimit -S -t {seconds}; ulimit -f {FILE_LIMIT}; exec "$0"', str(binary)], env=env, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, stdin=subprocess.DEVNULL) as process:
        errors = process.communicate()[1].decode(errors="replace")
    try:
        tests = list(xml.parse(log).getroot().iter("{http://check.sourceforge.net/ns}test"))
    except (OSError, xml.ParseError):
        found = reports(errors)
        raise NotBuilt("it ends before the tests: " + (accident(found[0], names) if found else "no log")) from None
    waiting, out = reports(errors), []
    for test in tests:
        ns = "{http://check.sourceforge.net/ns}"
        message = test.findtext(ns + "message") or ""
        passed = test.get("result") == "success"
        if "return value 77" in message and waiting:
            message = accident(waiting.pop(0), names)
        out.append((test.findtext(ns + "id"), passed, sentence(message, seconds)))
    return out


def digits(got, want):
    """Two numbers with as many digits as it takes to tell them apart."""
    for n in range(4, 18):
        a, b = f"{float(got):.{n}g}", f"{float(want):.{n}g}"
        if a != b:
            return a, b
    return a, b


def sentence(message, limit):
    values = re.match(r"(.*): got (\S+?)(?: \(\S+\))?, want (\S+?)(?: \(\S+\))?: ", message, re.S)
    if values:
        if "nan" in values[3]:
            return f"{values[1]}: it compares with what is not there yet"
        if "nan" in values[2]:
            return f"{values[1]}: got NaN, which is no number, want {float(values[3]):.4g}: was something never set, or divided by 0?"
        got, want = digits(values[2], values[3])
        return f"{values[1]}: got {got}, want {want}"
    if "timeout" in message.lower() or "signal 24" in message:
        return f"{ENDLESS} {limit} s: is there a loop without an end?"
    if "Early exit" in message:
        return "ends the process"
    signal = re.search(r"signal (\d+)", message)
    if signal:
        return {"11": "touches memory that is not its own", "8": "divides an integer by zero",
                "6": "ends by abort", "25": "prints without an end"}.get(signal[1], f"dies of signal {signal[1]}")
    failed = re.match(r"Assertion '(.*)' failed(?:: (.*))?", message, re.S)
    if failed:
        message = failed[2] or f"{failed[1]} does not hold"
    return " ".join(message.split())


def title(name):
    """eq_4_1_the_weights: its numbers, and "(4.1) the weights"; eq_2b_the_weights of the Course, "(2b) the weights";
    without a number, words."""
    course = re.match(r"eq((?:_(?:and_)?\d+[a-z])+)_(.*)", name)
    if course:
        numbers = re.findall(r"\d+[a-z]", course[1])
        return numbers, f"({', '.join(numbers)}) {course[2].replace('_', ' ')}"
    found = re.match(r"eq((?:_(?:and_|to_)?\d+_\d+)+)_(.*)", name)
    if not found:
        return [], name.replace("_", " ")
    numbers = [f"{a}.{b}" for a, b in re.findall(r"(\d+)_(\d+)", found[1])]
    return numbers, f"({', '.join(numbers)}) {found[2].replace('_', ' ')}"


def show(results):
    """A line an equation. What has no number, such as bad arguments, waits for those."""
    numbered = [r for r in results if title(r[0])[0]]
    done = all(passed for _, passed, _ in numbered)
    for name, passed, text in results if done else numbered:
        print(f"  {title(name)[1]}: {'yes' if passed else 'not yet: ' + text}")
    return done and all(passed for _, passed, _ in results)
