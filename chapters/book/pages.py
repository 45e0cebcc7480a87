"""From a page of the course, written for GitHub, to the HTML of its text.

pandoc makes the HTML, of all pages in one call; katex.js renders the formulas; the rest
is here: ids of headings, equations and figures, links to places of the site, the row of
files below a title, quoted code with its colours, and a link on each number of an equation."""
import functools
import html
import json
import pathlib
import re
import subprocess
import sys

import figures
from sources import colour, source_page

HERE = pathlib.Path(__file__).parent
ROOT = pathlib.Path(".")
sys.path.append(str(HERE.parent / "tools"))
from excerpts import MARK, POINTER, function  # noqa: E402
from links import heading_id  # noqa: E402

# The pages that are no chapter, and what they are called in the site.
OTHERS = {"README.md": "index", "chapters/README.md": "course",
          "chapters/workshop/README.md": "workshop", "chapters/workshop/exercises.md": "exercises",
          "chapters/workshop/lectures.md": "lectures", ".github/CONTRIBUTING.md": "contributing",
          **{f"chapters/handbook/{name}.md": name for name in
             ("manual", "reports", "python", "packages", "tour", "moving", "equations", "statements", "what_the_principle_buys", "evidence", "symbols", "glossary", "bibliography")}}
FOLDERS = ("", "further", "handbook")  # of the Course, and of the two that stand behind it
CUT = "page-ends-here"
MOVES = re.compile(r"<!-- moves: (\w+) -->")


def file_name(path):
    """In the site, without .html: 05-... is of the Course, h05-... of Further or the Handbook."""
    return ("h" if path.parent.name in FOLDERS[1:] else "") + path.stem


def part(page):
    """Where the contents put a page."""
    if page.name in ("index", "course"):
        return ""
    return {"further": "Further", "handbook": "Handbook"}.get(page.path.parent.name, "Course" if page.number else "More")


def order(page):
    """Where a page stands in the book; its part first, and a numbered page before one without a number."""
    return ("", "Course", "Further", "Handbook", "More").index(part(page)), not page.number


def on_paper(page):
    """The numbered pages, and what they send the reader to."""
    return page.number or page.name in ("symbols", "glossary", "bibliography")


class Page:
    """name: of the file, without .html; path: of the Markdown; number: "4" of the Course, "H 4" or "";
    title, body: HTML; headings: [(level, id, title as HTML)]; sections: see search.py."""

    def __init__(self, path):
        self.path = path
        self.name = OTHERS.get(str(path), file_name(path))
        number = path.name[:2] if re.match(r"\d\d-", path.name) else ""
        self.number = f"H {int(number)}" if number and path.parent.name in FOLDERS[1:] else number.lstrip("0")
        self.headings = []

    @property
    def short(self):
        """The title without its number."""
        return re.sub(r"^(H )?\d+\. ", "", self.title)


def all_pages():
    chapters = [path for folder in FOLDERS for path in sorted((ROOT / "chapters" / folder).glob("[0-9][0-9]-*.md"))]
    return [Page(path) for path in [*chapters, *map(ROOT.joinpath, OTHERS)]]


def pandoc_math(text):
    """GitHub's ```math blocks and $`...`$ -> pandoc's dollars. Code is not touched."""
    out, prose, fence = [], [], None

    def flush():
        out.append(re.sub(r"\$`(.+?)`\$", r"$\1$", "\n".join(prose), flags=re.S))
        prose.clear()

    for line in text.split("\n"):
        quote, line = re.fullmatch(r"((?:> ?)?)(.*)", line).groups()  # a theorem is a quotation
        if line.startswith("```") and fence is None:
            flush()
            fence = line
            out.append(quote + ("$$" if line == "```math" else line))
        elif line.startswith("```"):
            if fence == "```math":
                out[-1] += " $$"
            else:
                out.append(quote + line)
            fence = None
        elif fence == "```math":
            out[-1] += " " + line  # one line: `-` at the left margin begins no list
        else:
            (out if fence else prose).append(quote + line)
    flush()
    return "\n".join(out)


def where_from(match):
    """A pointer above quoted code -> a link to its first line."""
    file, region = match[1], match[2]
    lines = pathlib.Path(file).read_text().splitlines()
    first = lines.index(function(file, region.partition("()")[0])[0]) + 1 if (region or "").endswith("()") else 1
    for i, line in enumerate(lines, 1):
        mark = MARK.fullmatch(line)
        if mark and mark[1] == ">" and mark[2] == region:
            first = i + 1
    # the link is one from the root: to_places() takes it from there
    return f'<p class="from"><a href="/{file}#L{first}">{file}</a></p>\n'


def markdown(page):
    text = re.sub(r"[ \t]*<!-- from\n.*?-->\n", "", page.path.read_text(), flags=re.S)
    return POINTER.sub(where_from, pandoc_math(text))


def to_html(pages):
    """One call of pandoc for all: its start takes longer than a chapter."""
    text = f"\n\n<!-- {CUT} -->\n\n".join(map(markdown, pages))
    run = subprocess.run(["pandoc", "-f", "gfm+tex_math_dollars-gfm_auto_identifiers", "-t", "html5",
                          "--mathjax", "--wrap=preserve", "--preserve-tabs", "--no-highlight"],
                         input=text, capture_output=True, text=True, check=True)
    bodies = run.stdout.split(f"<!-- {CUT} -->")
    assert len(bodies) == len(pages)
    for page, body in zip(pages, bodies):
        page.body = body.strip()


# ---- places ----

def to_places(page):
    """Links, as they are in the repository -> as they are in the site."""
    places = {str(p): name for p, name in OTHERS.items()}

    def place(match):
        attribute, target = match[1], html.unescape(match[2])
        if re.match(r"[a-z]+:|#", target):
            return match[0]
        path, _, anchor = target.partition("#")
        file = pathlib.Path(path[1:]) if path.startswith("/") else page.path.parent / path
        file = pathlib.Path(*resolve(file.parts))
        anchor = f"#{anchor}" if anchor else ""
        if str(file) in places:
            new = f"{places[str(file)]}.html"
        elif file.parent in [pathlib.Path("chapters", folder) for folder in FOLDERS] and file.suffix == ".md":
            new = f"{file_name(file)}.html"
        elif file == pathlib.Path("chapters/play/index.html"):
            new = "play/index.html"
        elif file.suffix == ".svg":
            new = f"figures/{file.name}"
        else:
            new = f"source/{source_page(file)}"
        return f'{attribute}="{html.escape(new + anchor)}"'

    page.body = re.sub(r'\b(href|src)="([^"]*)"', place, page.body)


def resolve(parts):
    """a/b/../c -> a/c"""
    out = []
    for part in parts:
        out = out[:-1] if part == ".." else [*out, part]
    return out


def number_headings(page):
    seen = {}

    def heading(match):
        level, title = int(match[1]), match[2]
        ident = heading_id(html.unescape(re.sub(r"\\[()]|<[^>]*>", "", title)))
        count = seen[ident] = seen.get(ident, -1) + 1
        ident += f"-{count}" if count else ""
        page.headings.append((level, ident, title))
        if level == 1:
            page.title = title
            return f'<h1 id="{ident}">{title}</h1>'
        return (f'<h{level} id="{ident}">{title} <a class="anchor" href="#{ident}" '
                f'aria-label="Link to this section">#</a></h{level}>')

    page.body = re.sub(r"<h([1-6])>(.*?)</h\1>", heading, page.body, flags=re.S)


def without_neighbours(page):
    """The last line of a chapter on GitHub, Previous and Next: a page has them below, paper needs none."""
    page.body = re.sub(r"<p>(?:<a [^>]*>)?(?:Previous|Next|Back to)\b(?:(?!<p>).)*</p>\s*$", "", page.body, flags=re.S)


def row_of_files(page):
    """The table below a title -> a list, which a narrow screen can break."""
    def row(match):
        names, cells = (re.findall(rf"<{tag}[^>]*>(.*?)</{tag}>", match[2], re.S) for tag in ("th", "td"))
        cells = [re.sub(r"(?<=\w)_(?=\w[^<>]*</a>)", "_<wbr>", beside_stops(cell)) for cell in cells]
        rows = "".join(f"<div><dt>{n}</dt><dd>{c}</dd></div>" for n, c in zip(names, cells) if c.strip())
        return f'{match[1]}<dl class="files">{rows}</dl>'

    page.body = re.sub(r"(</h1>\s*)<table[^>]*>(\s*<thead>.*?)</table>", row, page.body, count=1, flags=re.S)


def beside_stops(cell):
    """In a table a link is a block of its own, beside which a line could break: between it and a comma, too."""
    return re.sub(r"(\(?<a\b[^>]*>(?:[^<]|<wbr>){1,32}</a>[.,;:)]+)", r'<span class="keep">\1</span>', cell)


def number_figures(page, captions):
    """A paragraph that is an image -> a figure with its number and a caption."""
    count = 0

    def figure(match):
        nonlocal count
        count += 1
        source, alt = match["src"], match["alt"]
        number = f"{page.number}.{count}" if page.number else str(count)
        wide, high = size_of(page, source)
        image = f'<img src="{source}" alt="{alt}" width="{wide}" height="{high}" style="--wide: {int(wide) / 16:g}rem">'
        return (f'<figure id="fig-{number.replace(" ", "")}"{live(source)}><a href="{source}">{in_two(source, image)}</a>\n'
                f'<figcaption><a href="#fig-{number.replace(" ", "")}">Figure {number}</a> {captions(source, alt)}</figcaption></figure>')

    def moving(match):
        return (f'<figure id="fig-{match[1]}" data-live="{match[1]}"><figcaption><a href="#fig-{match[1]}">This figure</a> moves, '
                'in a browser that runs scripts.</figcaption></figure>')

    page.body = MOVES.sub(moving, page.body)
    page.body = re.sub(r'<p><img\s+src="(?P<src>figures/[^"]*)"\s+alt="(?P<alt>[^"]*)"\s*/>\s*</p>', figure, page.body)


def live(source):
    """A figure whose place in a page a moving one takes says which: by its own name. One that a comment puts elsewhere takes no place."""
    name = pathlib.Path(source).stem
    return f' data-live="{name}"' if name not in alone() and (HERE.parent / "live" / f"{name}.js").exists() else ""


def exercises(page):
    """The third exercise of a page has the address #exercise-3, and the link that is called 04-3 leads there."""
    start = page.body.find('<h2 id="exercises"')
    depth = count = 0

    def item(match):
        nonlocal depth, count
        depth += {"<ol": 1, "</o": -1}.get(match[0][:3], 0)
        if match[0][:3] == "<ol" and depth == 1:
            count = int((re.search(r'start="(\d+)"', match[0]) or [0, 1])[1]) - 1
        if match[0] != "<li>" or depth != 1:
            return match[0]
        count += 1
        return f'<li id="exercise-{count}"><a class="anchor" href="#exercise-{count}" aria-label="Link to this exercise">#</a>'

    if start >= 0:
        page.body = page.body[:start] + re.sub(r"<ol[^>]*>|</ol>|<li>", item, page.body[start:])
    page.body = re.sub(r'(href="[^"]*)#exercises"(>\d\d-(\d+)</a>)', r'\1#exercise-\3"\2', page.body)


def in_two(source, image):
    """On a phone the second panel of a figure stands below the first."""
    if figures.split(next(ROOT.glob(f"figures/*/{pathlib.Path(source).name}"))) is None:
        return image
    return f'<picture><source media="screen and (max-width: 40rem)" srcset="{source[:-4]}.narrow.svg">{image}</picture>'


@functools.cache
def alone():
    """The figures that move where a page says <!-- moves: NAME -->."""
    return {name for path in (ROOT / "chapters").rglob("*.md") for name in MOVES.findall(path.read_text())}


def size_of(page, source):
    name = pathlib.Path(source).name
    svg = next(ROOT.glob(f"figures/*/{name}"), None)
    if svg is None:
        sys.exit(f"{page.path}: no such figure: {source}")
    return re.search(r'viewBox="0 0 (\d+) (\d+)"', svg.read_text()).groups()


def columns(code):
    """A table of columns with tabs between them: each as wide as its widest entry."""
    rows = [[cell.rstrip() for cell in line.split("\t")] for line in code.split("\n")]
    widths = [max((len(row[i]) for row in rows if i < len(row) - 1), default=0) for i in range(max(map(len, rows)))]
    return "\n".join("".join(cell.ljust(width + 2) for cell, width in zip(row[:-1], widths)) + row[-1] for row in rows)


def colour_code(page):
    def block(match):
        language, code = match[1] or "", html.unescape(match[2])
        table = ""
        if language == "text" and "\t" in code:
            code, table = columns(code), ' class="table"'
        return f'<pre class="code"><code{table}>{colour(code, language)}</code></pre>'

    page.body = re.sub(r'<pre(?: class="([^"]*)")?><code>(.*?)</code></pre>', block, page.body, flags=re.S)


def breakable(code):
    """A name of 25 letters and more may end a line behind a _, so that it fits on a phone."""
    return re.sub(r"\w{25,}", lambda word: re.sub(r"(?<=\w{9})_(?=\w{4})", "_<wbr>", word[0]), code)


def unbroken(page):
    """No line of the text ends within a short command or name, with -- or fvi-, say; a long name may end one behind a _."""
    def kept(code):
        if len(code) <= 16:
            return f'<span class="keep">{code}</span>' if re.search("[- ]", code) else code
        code = breakable(code)
        return re.sub(r"[^\s<-]*-[^\s<]*", lambda word: f'<span class="keep">{word[0]}</span>' if len(word[0]) <= 24 else word[0], code)

    page.body = re.sub(r'(?<!<pre class="code">)<code>([^<]*)</code>', lambda code: f"<code>{kept(code[1])}</code>", page.body)


def sentence(cell):
    """A cell of more than a few words: on a phone it has a width, and the table scrolls."""
    words = len(re.sub(r"<[^>]+>|\\\w+", "", cell[2]))
    return f'<td{cell[1]} class="{"sentence" if words > 50 else "words"}">{cell[2]}</td>' if words > 15 else cell[0]


def scrolling_tables(page):
    """A table that is too wide scrolls by itself; one of many words may be wider than the text."""
    def box(match):
        rows = [re.sub(r"<[^>]+>", "", row) for row in match[0].split("</tr>")]
        wide = " wide" if match[0].count("<th") > 4 and max(map(len, rows)) > 180 else ""
        table = re.sub(r"(?<=\w)_(?=\w[^<>]*</(?:a|code)>)", "_<wbr>", match[0])  # a long name may break
        table = re.sub(r"<td([^>]*)>(.*?)</td>", sentence, table, flags=re.S)
        return f'<div class="scroll{wide}" role="region" aria-label="Table">{table}</div>'

    page.body = re.sub(r"<table.*?</table>", box, page.body, flags=re.S)


# ---- formulas ----

def render(pages):
    """Every formula by KaTeX, in one process. Returns number -> (page, HTML of the equation)."""
    texts = json.dumps([[page.title, page.body, *(title for _, _, title in page.headings)] for page in pages])
    run = subprocess.run(["node", str(HERE / "katex.js")], input=texts, capture_output=True, text=True)
    if run.returncode:
        sys.exit(run.stderr)
    done = json.loads(run.stdout)
    for page, (title, body, *titles) in zip(pages, done["pages"]):
        page.title, page.body = title, body
        page.headings = [(level, ident, new) for (level, ident, _), new in zip(page.headings, titles)]
        loose = re.search(r"\$\$.{0,60}|\\tag\{[^}]*\}(?![^<]*</annotation>)", page.body)
        if loose:
            sys.exit(f"{page.path}: a formula was not recognised: {loose[0]}")
    return {number: (pages[i], formula) for number, (i, formula) in done["equations"].items()}


def link_equations(page, found):
    """(4.3) in the text -> a link to the equation that carries that number."""
    def link(match):
        if match[1] not in found:
            return match[0]
        there = found[match[1]][0]
        file = "" if there is page else f"{there.name}.html"
        return f'<a class="eq" href="{file}#eq-{match[1]}">({match[1]})</a>'

    out, inside = [], []
    for piece in re.split(r"(<[^>]+>)", page.body):
        if piece.startswith("<"):
            tag = re.match(r"</?(\w+)", piece)
            word = tag[1] if tag else ""
            if word in ("a", "code", "pre", "math", "annotation", "svg", "summary", "h1", "h2", "h3", "h4"):
                inside.pop() if piece.startswith("</") else inside.append(word)
            out.append(piece)
        else:
            out.append(piece if inside else re.sub(r"\((\d+\.\d+|\d+[a-e])\)", link, piece))
    page.body = re.sub(r"<td.*?</td>", lambda cell: beside_stops(cell[0]), "".join(out), flags=re.S)
