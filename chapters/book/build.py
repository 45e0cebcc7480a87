"""The chapters as one HTML page.      build.py OUT     (make book)

GitHub's markdown is turned into pandoc's, pandoc makes HTML, katex.js renders
every formula, and equation numbers in the text become links. Everything that the
page needs lies beside it, so it opens from a disk, without JavaScript. A formula
that KaTeX refuses, a missing figure or a link that leads nowhere stops the build."""
import html
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
OUT = pathlib.Path(sys.argv[1])
KATEX = pathlib.Path("/usr/share/javascript/katex")
CHAPTERS = sorted(pathlib.Path("chapters").glob("[0-9][0-9]-*.md"))


def pandoc_math(text):
    """GitHub's ```math blocks and $`...`$ -> pandoc's dollars. Code is not touched."""
    out, prose, fence = [], [], None

    def flush():
        out.append(re.sub(r"\$`(.+?)`\$", r"$\1$", "\n".join(prose), flags=re.S))
        prose.clear()

    for line in text.split("\n"):
        if line.startswith("```") and fence is None:
            flush()
            fence = line
            out.append("$$" if line == "```math" else line)
        elif line.startswith("```"):
            if fence == "```math":
                out[-1] += " $$"
            else:
                out.append(line)
            fence = None
        elif fence == "```math":
            out[-1] += " " + line  # one line: `-` at the left margin begins no list
        else:
            (out if fence else prose).append(line)
    flush()
    return "\n".join(out)


def chapter(path):
    """One chapter, its links turned to places in the page or to the sources."""
    name = path.stem
    text = pandoc_math(re.sub(r"[ \t]*<!-- from\n.*?-->\n", "", path.read_text(), flags=re.S))
    text = re.sub(r"<!-- excerpt: (\S+?)(?:#([\w-]+))? -->",
                  r'<p class="from"><a href="../../\1">\1</a></p>\n', text)
    # a page of the course -> its heading; a figure -> beside the page; else the source
    text = re.sub(r"\]\((\d\d-\w+)\.md(?:#([^)]*))?\)",
                  lambda m: f"](#{m[1]}{'--' + m[2] if m[2] else ''})", text)
    text = re.sub(r"\]\(#(?!\d\d-)([^)]*)\)", rf"](#{name}--\1)", text)
    text = re.sub(r"\]\(\.\./figures/\w+/(\w+\.svg)\)", r"](figures/\1)", text)
    text = re.sub(r"\]\(\.\./([^)]*)\)", r"](../../\1)", text)
    text = re.sub(r"\]\((README\.md|play/[^)]*)\)", r"](../../chapters/\1)", text)
    return name, text


def to_html(name, text):
    page = subprocess.run(["pandoc", "-f", "gfm+tex_math_dollars", "-t", "html5", "--mathjax",
                           "--wrap=preserve"], input=text, capture_output=True, text=True, check=True).stdout
    # on a narrow screen a figure is small: touch it to see it alone
    page = re.sub(r'<img src="(figures/[^"]+)"[^>]*/>', r'<a href="\1">\g<0></a>', page)
    page = re.sub(r'(<h[1-6][^>]*? id=")([^"]*)"', rf'\g<1>{name}--\g<2>"', page)
    return re.sub(r'<h1 id="[^"]*"', f'<h1 id="{name}"', page, count=1)


def contents(page):
    rows = []
    for level, ident, title in re.findall(r'<h([12])[^>]*? id="([^"]*)"[^>]*>(.*?)</h[12]>', page, re.S):
        rows.append(f'<li class="level{level}"><a href="#{ident}">{title}</a></li>')
    return "<nav><h2>Contents</h2><ol>" + "\n".join(rows) + "</ol></nav>"


def link_equations(page):
    """(4.3) in the text -> a link to the equation that carries that tag."""
    tags = set(re.findall(r'id="eq-([\d.]+)"', page))
    out, inside = [], []
    for piece in re.split(r"(<[^>]+>)", page):
        if piece.startswith("<"):
            tag = re.match(r"</?(\w+)", piece)
            word = tag[1] if tag else ""
            if word in ("a", "code", "pre", "math", "annotation", "svg", "h1", "h2"):
                inside.pop() if piece.startswith("</") else inside.append(word)
            out.append(piece)
        elif inside:
            out.append(piece)
        else:
            out.append(re.sub(r"\((\d+\.\d+)\)",
                              lambda m: f'<a href="#eq-{m[1]}">({m[1]})</a>' if m[1] in tags else m[0],
                              piece))
    return "".join(out)


def check_links(page):
    places = set(re.findall(r' id="([^"]+)"', page))
    dead = sorted({t for t in re.findall(r'href="#([^"]+)"', page) if html.unescape(t) not in places})
    missing = sorted({f for f in re.findall(r'src="(figures/[^"]+)"', page) if not (OUT / f).exists()})
    if dead or missing:
        sys.exit("\n".join([f"the book: no such place: #{d}" for d in dead]
                           + [f"the book: no such figure: {m}" for m in missing]))


def main():
    shutil.rmtree(OUT, ignore_errors=True)
    (OUT / "figures").mkdir(parents=True)
    for figure in pathlib.Path("figures").glob("*/*.svg"):
        shutil.copy(figure, OUT / "figures")
    shutil.copytree(KATEX / "fonts", OUT / "fonts")
    shutil.copy(KATEX / "katex.min.css", OUT)
    shutil.copy(HERE / "style.css", OUT)
    page = "\n".join(f"<article>{to_html(*chapter(path))}</article>" for path in CHAPTERS)
    rendered = subprocess.run(["node", str(HERE / "katex.js")], input=page, capture_output=True,
                              text=True)
    if rendered.returncode:
        sys.exit(rendered.stderr)
    loose = re.search(r"\$\$.{0,60}|\\tag\{[^}]*\}(?![^<]*</annotation>)", rendered.stdout)
    if loose:
        sys.exit(f"the book: a formula was not recognised: {loose[0]}")
    page = link_equations(rendered.stdout)
    page = (HERE / "frame.html").read_text().replace("{contents}", contents(page)).replace("{page}", page)
    check_links(page)
    (OUT / "index.html").write_text(page)
    # on paper a link to a file of the repository leads nowhere: only its words
    (OUT / "print.html").write_text(re.sub(r'<a href="\.\./\.\./[^"]*">(.*?)</a>', r"\1", page, flags=re.S))
    print(f"{OUT}/index.html: {len(CHAPTERS)} chapters, {page.count('katex-mathml')} formulas")


main()
