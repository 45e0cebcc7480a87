"""Each program and Python module that a target starts or imports has a line in need.sh.

    needs.py        (part of make text)

The targets are those that README.md and the workflows of .github/ name. `make -Bn TARGET` prints every
command of one, and nothing is run. Followed are the programs in it, the Python modules that its
scripts import and the programs that they start, those of the tests, proofs and pages too. Each must be
among the tools that the target asks need.sh for, or in what any Debian with git, make and a
compiler has. What a script looks for before it takes it may be missing. Only the standard library is used."""
import ast
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

# Debian's essential packages, those of a compiler, and the shell itself.
EVERYWHERE = set("""awk basename cat cd chmod cmp command cp cut date dirname echo env exec exit export expr false find fold
  getconf git grep head id install kill ld ldconfig ln ls make mkdir mktemp mv nice nm nproc objcopy objdump locale paste printf pwd rm
  sed set sh shift size sleep sort strip tail tar tee test time touch tr trap true uname uniq wait wc xargs ar gcc bash
  if then else elif fi for while do done case esac in read local return : [ { } !""".split())
NEED = pathlib.Path("src/make/need.sh").read_text()
PAGES = [pathlib.Path("README.md"), *sorted(pathlib.Path(".github/workflows").glob("*.yml")), pathlib.Path(".ci/run")]
SCRIPTS = {path.stem: path for place in ("src/make", "chapters", "verify", "tests", "src/python") for path in sorted(pathlib.Path(place).rglob("*.py"))}
OWN = {"fvi", "_fvi"}  # the package itself
FOLDERS = {path.parent.name for path in SCRIPTS.values()}
STARTS = [r"subprocess|Popen", r"subprocess|Popen|'(run|say)'"]  # the functions that start a program; those of src/, too
FACTS = {}


def known():
    """tool of need.sh -> the words of its line, which may name the programs that come with it, and of its packages"""
    words = {}
    for function in re.findall(r"^(?:have|packages)\(\) \{(.*?)^\}", NEED, re.S | re.M):
        for names, body in re.findall(r"^    ([\w. |]+)\) (.*?) *;;", function, re.M):
            for name in names.replace("|", " ").split():
                words.setdefault(name, set()).update(word.removeprefix("python3-") for word in re.findall(r"[\w+-]+", body))
    return words


def guarded(tree):
    """Imports that may fail: those within a try that catches it."""
    return {id(node) for attempt in ast.walk(tree) if isinstance(attempt, ast.Try)
            and any("ImportError" in ast.dump(handler) or "ModuleNotFound" in ast.dump(handler) for handler in attempt.handlers)
            for part in attempt.body for node in ast.walk(part)}


def of_python(path):
    """What a script of Python and all of its own modules start, and what they import: "import cffi"."""
    if path in FACTS:
        return FACTS[path]
    found = FACTS[path] = set()
    text = path.read_text()
    tree = ast.parse(text)
    optional = guarded(tree)
    looked_for = set(re.findall(r"""(?:which|have)\(["']([\w.-]+)""", text))
    for node in ast.walk(tree):
        names = []
        if id(node) in optional:
            continue
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            # `shared` and its like are folders of scripts.
            names = [node.module] if node.module.split(".")[0] not in FOLDERS else \
                [node.module.split(".")[1]] if "." in node.module else [alias.name for alias in node.names]
        elif isinstance(node, ast.Call) and re.search(STARTS[path.parts[0] == "src"], ast.dump(node.func)):
            first = node.args[0] if node.args else None
            if isinstance(first, ast.List) and first.elts and isinstance(first.elts[0], ast.Constant):
                if (program := str(first.elts[0].value)) not in looked_for:
                    found.add(program)
        for name in (n.split(".")[0] for n in names):
            if name in OWN or name in sys.stdlib_module_names:
                continue
            found |= of_python(SCRIPTS[name]) if name in SCRIPTS else {f"import {name}"}
    return found


def of_node(path):
    """What a script of node and those beside it start."""
    if path in FACTS:
        return FACTS[path]
    text = path.read_text()
    found = FACTS[path] = set(re.findall(r"""\b(?:spawn|spawnSync|execFile|execFileSync|ask)\(["']([\w.-]+)["']""", text))
    for other in re.findall(r"""from ["'](\.[^"']+)["']""", text):
        found |= of_node((path.parent / other).resolve().relative_to(pathlib.Path.cwd()))
    return found


def of_words(words):
    """What one command starts."""
    while words and (re.match(r"\w+=", words[0]) or words[0] in ("+", "exec", "nice", "!", "then", "do", "else", "{", "if")):
        words = words[1:]
    if not words or "/" in words[0] and words[0] != "/usr/bin/python3" or not re.match(r"[a-zA-Z/]", words[0]):
        return set()
    program, rest = pathlib.Path(words[0]).name, words[1:]
    found = {"python" if program == "python3" else program}
    if program == "python3":
        if "-m" in rest:
            module = rest[rest.index("-m") + 1]
            found |= {f"import {module}"} if module not in sys.stdlib_module_names else set()
        for word in rest:
            path = pathlib.Path(word)
            if word.endswith("setup.py"):
                found |= of_python(pathlib.Path("src/python/setup.py"))
            elif path.suffix == ".py" and path.exists():
                found |= of_python(path)
            elif path.is_dir() and "import pytest" in found:
                found = found.union(*map(of_python, path.glob("*.py")))
        if "src/make/prove.py" in rest:  # behind it stand the folder of what is built, and proofs
            found = found.union(*(of_python(SCRIPTS[stem]) for stem in rest[rest.index("src/make/prove.py") + 2:] if stem in SCRIPTS))
    if program == "node":
        found |= of_node(pathlib.Path(rest[0]))
    return found


def commands_of(target, rules):
    """What make would run for it."""
    clean = {k: v for k, v in os.environ.items() if not k.startswith(("MAKE", "MFLAGS"))}
    return subprocess.run(["make", "--no-print-directory", "-f", "-", "-Bnk", target, "CC=gcc", "PYTHON=/usr/bin/python3"], input=rules,
                          env=clean, capture_output=True, text=True).stdout.replace("\\\n", " ")


def of_commands(said):
    """(the tools that they ask need.sh for, all that they start)"""
    tools, started = set(), set()
    for line in said.splitlines():
        if "need.sh" in line:
            tools |= set(line.split("need.sh")[1].split()) - {"--bring"}
            continue
        line = re.sub(r"'[^']*'", "''", line)  # programs of awk, sed and printf
        within = re.findall(r"\$\(([^()]*)\)", line)
        for part in [re.sub(r"\$\(([^()]*)\)", "x", line), *within]:
            for command in re.split(r"[;|&()`]+", part.replace('"', " ")):
                started |= of_words(command.split())
    return tools, started


def main():
    # A recipe with + or with $(MAKE) would be run even now.
    rules = re.sub(r"^\t\+", "\t", pathlib.Path("Makefile").read_text(), flags=re.M)
    rules = rules.replace("$(MAKE) ", "make ")
    targets = sorted({target for page in PAGES for target in re.findall(r"\bmake ([a-z]+(?:-[a-z0-9]+)*\d*)\b", page.read_text())
                      if re.search(rf"^{re.escape(re.sub('[0-9]+$', '', target))}[%:]|^\.PHONY:.*\b{target}\b|^ch\d", rules, re.M)
                      or re.match(r"(ch|workshop-|erratum-|exercise-)\d", target)})
    words, faults, count = known(), set(), 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        said = list(pool.map(lambda target: commands_of(target, rules), targets))
    for target, (tools, started) in zip(targets, map(of_commands, said)):
        # need.sh takes a tool without a line for a program of that name; a module must have one.
        brought = set().union(*({tool} | words[tool] for tool in tools if tool in words))
        had = EVERYWHERE | tools | brought | {f"import {name}" for name in brought}
        count += len(started)
        faults |= {f"make {target}: src/make/need.sh is not asked for '{what}', or has no line for it; asked for: {' '.join(sorted(tools))}"
                   for what in started - had}
    if faults:
        sys.exit("\n".join(sorted(faults)))
    if not {"check", "figures", "book"} <= set(targets):
        sys.exit(f"{sys.argv[0]} does not find the targets of README.md: {' '.join(targets)}")
    print(f"need.sh: {len(targets)} targets start and import {count} programs and modules, all of which they ask for")


main()
