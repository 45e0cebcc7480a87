"""Follow every relative link of README.md and the chapters; see that the page of
statements names all 87 of the paper, each with a link; see that an entry of the bibliography
names the pages that cite it, and that no other page prints a volume and a year; that a function
stands in the file that a table names beside it; that the page on names from one version to the next gives a name that there is for one that there is not. Exit 1
with the list of what is wrong."""
import pathlib
import re
import sys

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
REGIONS = re.compile(r"regions? ((?:`[\w-]+`(?:,\s+|\s+and\s+)?)+)\s+of\s+\[[^\]]*\]\(([^)\s]+)\)")
STATEMENTS = 87
BIBLIOGRAPHY = pathlib.Path("chapters/handbook/bibliography.md")
FENCE = re.compile(r"^```.*?^```$", re.M | re.S)


def anchors(page):
    """The names that GitHub gives to the headings of a page, and explicit ones."""
    text = FENCE.sub("", page.read_text())
    names = set(re.findall(r'<a (?:id|name)="([^"]+)"', text))
    names.update(map(heading_id, re.findall(r"^#+ (.*)$", text, re.M)))
    return names


def heading_id(heading):
    plain = re.sub(r"[`*$\\]|\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
    return re.sub(r"[^\w\- ]", "", plain).strip().replace(" ", "-")


def faults_of_links(page):
    for target in LINK.findall(FENCE.sub("", page.read_text())):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path) if path else page
        if not file.exists():
            yield f"{page}: dead link: {target}"
        elif anchor and file.suffix == ".md" and anchor not in anchors(file):
            yield f"{page}: no such heading: {target}"


def faults_of_regions(page):
    """The answers of the exercises point to regions, which lie between marks of the source."""
    for names, path in REGIONS.findall(page.read_text()):
        file = page.parent / path
        source = file.read_text() if file.is_file() else ""
        for name in re.findall(r"`([\w-]+)`", names):
            if not re.search(rf"^\s*(?://|#|/\*)> {name}(?: \*/)?$", source, re.M):
                yield f"{page}: no such region: {name} of {path}"


def faults_of_statements(page):
    """Rows `| number | statement | [link] | check |` of the section on the paper."""
    section = page.read_text().partition("## Every statement of the paper")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| (\d+) \|.*\]\(.*$", section, re.M)
    if [int(row) for row in rows] != list(range(1, STATEMENTS + 1)):
        missing = sorted(set(range(1, STATEMENTS + 1)) - set(map(int, rows)))
        yield f"{page}: the statements are not 1 to {STATEMENTS}; missing: {missing}"


def faults_of_bibliography(pages):
    """The entries are `- <a id="name"></a>**Label.** ...` and end with links to the pages that cite them. The paper's
    entry names none of them, since nearly all pages cite the paper."""
    cited = {}
    for page in pages:
        text = page.read_text()
        for name in re.findall(rf"{BIBLIOGRAPHY.name}#([\w-]+)", text):
            cited.setdefault(name, set()).add(page.resolve())
        if page != BIBLIOGRAPHY and re.search(r"\* \d+ \((18|19|20)\d\d\)", text):
            yield f"{page}: a reference with volume and year; its place is {BIBLIOGRAPHY}"
    entries = re.findall(r'^- <a id="([\w-]+)"></a>(.*)$', BIBLIOGRAPHY.read_text(), re.M)
    for name, entry in entries:
        named = {(BIBLIOGRAPHY.parent / path).resolve() for path in re.findall(r"\]\(([^)#]*\d\d-[^)#]+)\)", entry)}
        if name.startswith("jimenez-ober-blobaum-2021"):
            continue
        for page in sorted(named ^ cited.get(name, set())):
            yield f"{BIBLIOGRAPHY}: {name}: only one of the entry and {page.name} names the other"
        if not named:
            yield f"{BIBLIOGRAPHY}: {name}: no page cites it"


def faults_of_places(page):
    """Rows `| function | file | ...`: the function stands in that file."""
    for name, path in re.findall(r"^\| `(\w+)` \| `(src/[\w/]+\.c)` \|", page.read_text(), re.M):
        file = pathlib.Path(path)
        if not file.exists() or not re.search(rf"^\w[\w *]*\b{name}\([^;]*\n", file.read_text(), re.M):
            yield f"{page}: no function {name} in {path}"


def faults_of_names(page):
    """Rows `| old | new | header |`, each in backquotes but the header, below src/fvi."""
    rows = re.findall(r"^\| `(\w+)` \| `(\w+)` \| ([\w/]+\.h) \|$", page.read_text(), re.M)
    headers = {str(path.relative_to("src/fvi")): set(re.findall(r"\w+", re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.S)))
               for path in pathlib.Path("src/fvi").rglob("*.h")}
    public = set().union(*headers.values())
    for old, new, header in rows:
        if new not in headers.get(header, ()):
            yield f"{page}: {new} is not in src/fvi/{header}"
        if old in public:
            yield f"{page}: {old} is a name of today's"
    if not rows:
        yield f"{page}: there is no table of names"


def main():
    root = pathlib.Path(".")
    pages = [root / "README.md", *sorted(root.glob("chapters/**/*.md"))]
    faults = [fault for page in pages for fault in (*faults_of_links(page), *faults_of_regions(page), *faults_of_places(page))]
    faults += faults_of_statements(root / "chapters/handbook/statements.md")
    faults += faults_of_bibliography(pages)
    faults += faults_of_names(root / "chapters/handbook/moving.md")
    sys.exit("\n".join(faults) or 0)


if __name__ == "__main__":
    main()
