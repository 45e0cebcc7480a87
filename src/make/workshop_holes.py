"""Skeletons: the files of the course with holes, made from the sources themselves.

tests/workshop/holes.txt says which regions are cut (its head tells the format). A region
lies between `//> name` and `//< name`, as for the quotes in the chapters."""
import functools
import pathlib
import re
import textwrap

MARK = re.compile(r"\s*//[<>] [\w-]+")
TABLE = pathlib.Path("tests/workshop/holes.txt")


class Hole:
    def __init__(self, entry):
        self.source, self.region = entry["region"].split("#")
        self.leaves, self.shows, self.named = entry["leaves"], entry["shows"], entry["named"]
        self.chapter = entry.get("chapter", f"{int(self.shows.split('.')[0]):02d}")


def paragraphs(path):
    """Of each paragraph its lines, as name and value."""
    blocks = re.sub(r"^#.*\n", "", pathlib.Path(path).read_text(), flags=re.M).split("\n\n")
    return [dict(line.split(None, 1) for line in block.strip().splitlines()) for block in blocks if block.strip()]


def holes(chapter=None):
    found = [Hole(entry) for entry in paragraphs(TABLE)]
    return [hole for hole in found if chapter in (None, hole.chapter)]


@functools.cache
def tests(files="*/test_*.c"):
    """Of each test its program and its case: {"eq_4_1_...": ("test_coefficients", "values")}."""
    return {name: (path.stem, case) for path in sorted(pathlib.Path("tests").glob(files))
            for case, names in re.findall(r'ADD_CASE\(\w+,\s*"([^"]*)",([^;]*)\);', path.read_text())
            for name in re.findall(r"\w+", names)}


@functools.cache
def page(chapter):
    return next(pathlib.Path("chapters").glob(f"[fh]*/{chapter}-*.md"))


def equation(number):
    """The displayed formula with this number, as the chapter has it."""
    chapter = page(f"{int(number.split('.')[0]):02d}")
    for block in re.findall(r"```math\n(.*?)```", chapter.read_text(), re.S):
        if rf"\tag{{{number}}}" in block:
            return textwrap.dedent(re.sub(r" *\\tag\{[^}]*\}", "", block)).strip().splitlines()
    raise SystemExit(f"{chapter} has no equation ({number})")


@functools.cache
def declarations():
    """Of each public function what its header says: {"fvi_gl_weights": "/* ... */"}."""
    found = {}
    for path in pathlib.Path("src/fvi").glob("**/*.h"):
        for comment, name in re.findall(r"(/\*(?:(?!\*/).)*\*/)\n\w[\w *]*?\b(fvi_\w+)\(",
                                        path.read_text(), re.S):
            found[name] = comment
    return found


def split(lines, name):
    """Before, within and after a region."""
    first, last = ([i for i, line in enumerate(lines) if line.strip() == f"//{sign} {name}"] for sign in "><")
    if not len(first) == len(last) == 1:
        raise SystemExit(f"{TABLE}: there is no region {name}, or not one, in the source that it names")
    first, last = first[0], last[0]
    return lines[:first], [l for l in lines[first + 1:last] if not MARK.fullmatch(l)], lines[last + 1:]


def cut(lines, hole):
    """The source without the region, but with what it leaves."""
    before, within, after = split(lines, hole.region)
    keep, end = [], []
    if within.count("{") > 1:
        raise SystemExit(f"{TABLE}: {hole.source}#{hole.region} holds several functions, and a hole is in one")
    if "{" in within and within[-1] == "}":  # a whole function: its head and braces stay
        start = within.index("{") + 1
        keep, within, end = within[:start], within[start:-1], within[-1:]
    margin = re.match(r" *", within[0]).group()
    note = [f"/* ({hole.shows}): your lines, for the one below this comment.", " *",
            *(f" *     {line}".rstrip() for line in equation(hole.shows)), " */", hole.leaves]
    return before + keep + [margin + line for line in note] + end + after


def with_headers(lines):
    """Above each public function that has a hole, what its header says of it."""
    out, function = [], None
    for line in lines:
        found = re.match(r"\w[\w *]*?\b(fvi_\w+)\(", line)
        if found:
            function = (len(out), found.group(1))
        elif line == "}":
            function = None
        if "): your lines, for" in line and function and function[1] in declarations():
            place, name = function
            out[place:place] = declarations()[name].splitlines()
            function = None
        out.append(line)
    return out


def skeleton(source, cuts):
    lines = pathlib.Path(source).read_text().splitlines()
    for hole in cuts:
        lines = cut(lines, hole)
    lines = with_headers([line for line in lines if not MARK.fullmatch(line)])
    return "\n".join(lines) + "\n"


def filled(text, cuts):
    """A skeleton, every hole's line replaced by the lines of the source."""
    for hole in cuts:
        within = split(pathlib.Path(hole.source).read_text().splitlines(), hole.region)[1]
        if "{" in within and within[-1] == "}":
            within = within[within.index("{") + 1:-1]
        text = text.replace(hole.leaves, "\n".join(within), 1)
    return text


def without_comments(text):
    """A program without comments and spaces, to compare two of them."""
    return "".join(re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S).split())


def place(chapter, source):
    return pathlib.Path("workshop", f"{chapter}-{pathlib.Path(source).name}")


def lay_out(chapter):
    """The skeletons of a chapter, where none is there yet; their sources and places."""
    found = {}
    for source in dict.fromkeys(hole.source for hole in holes(chapter)):
        found[source] = place(chapter, source)
        if not found[source].exists():
            found[source].parent.mkdir(exist_ok=True)
            found[source].write_text(skeleton(source, [h for h in holes(chapter) if h.source == source]))
            print(f"made {found[source]}")
    return found
