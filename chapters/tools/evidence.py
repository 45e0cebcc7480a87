"""The numbers of chapters/handbook/evidence.md against the tests, proofs and mutants.

    evidence.py            print the numbers of each stem as they are
    evidence.py --check    exit 1 if a stem of tests/ has no row, or has less than its row says (part of make text)

A row names the equations that the scripts of verify/ prove or check; each must be named by one of their claims. It ends
with three numbers: claims of the proof scripts, tests, mutants. They are lower bounds, so that a new test
does not change the page; a test that is taken away does. Only Python's standard library is used."""
import pathlib
import re
import sys

PAGE = pathlib.Path("chapters/handbook/evidence.md")
ELSEWHERE = {"bench", "example", "harness", "random", "workshop"}  # what they are is said below the table
PATTERNS = (("verify", "*.py", r"^\s*(?:prove|prove_rational|claim)\("), ("tests", "*.[cp]*", r"^START_TEST\(|^def test_"), ("tests", "mutants.txt", r"^file "))


def counts(stem):
    """claims, tests, mutants of a stem."""
    return [sum(len(re.findall(pattern, path.read_text(), re.M)) for path in pathlib.Path(folder, stem).glob(files))
            for folder, files, pattern in PATTERNS]


def claimed(stem):
    """The equations that claims of the scripts name, as "17.6"."""
    words = [word for path in pathlib.Path("verify", stem).glob("*.py")
             for word in re.findall(r'(?:prove|prove_rational|claim)\(\s*f?"([^"]*)"', path.read_text())]
    return {number for word in words for number in re.findall(r"\((\d+\.\d+)\)", word)}


def named(cell):
    """The equations in a cell of the table; (17.1) to (17.3) are three."""
    for page, first, last in re.findall(r"\((\d+)\.(\d+)\)(?: to \(\d+\.(\d+)\))?", cell):
        yield from (f"{page}.{number}" for number in range(int(first), int(last or first) + 1))


def stems():
    return sorted(path.name for path in pathlib.Path("tests").iterdir() if path.is_dir() and path.name not in ELSEWHERE)


def faults():
    table = re.findall(r"^\| \[`(\w+)`\][^|]*\|[^|]*\|([^|]*)\|.*\| (\d+, \d+, \d+) \|$", PAGE.read_text(), re.M)
    for stem, cell, _ in table:
        for number in sorted(set(named(cell)) - claimed(stem)):
            yield f"{PAGE}: {stem}: no claim of its scripts names ({number})"
    rows = {stem: numbers for stem, _, numbers in table}
    for stem in stems():
        said = [int(number) for number in rows.pop(stem, "0, 0, 0").split(", ")]
        if not any(said):
            yield f"{PAGE}: no row for {stem}"
        for number, least, name in zip(counts(stem), said, ("claims", "tests", "mutants")):
            if number < least:
                yield f"{PAGE}: {stem} has {number} {name}, not at least {least}"
    for stem in rows:
        yield f"{PAGE}: there is no tests/{stem}"


def main():
    if sys.argv[1:] == ["--check"]:
        sys.exit("\n".join(faults()) or 0)
    for stem in stems():
        print(stem, *counts(stem))


main()
