"""The book as a folder of pages.      build.py OUT     (make book)

A page for each chapter, for README.md and the map of the course, and for each source that
a reader may ask for. OUT opens from a disk, without a network, and without JavaScript but
for search and the figures that move; it may be moved, or served, from anywhere. A formula
that KaTeX refuses, a missing figure or a link that leads nowhere stops the build."""
import html
import json
import pathlib
import posixpath
import re
import shutil
import sys

HERE = pathlib.Path(__file__).parent
sys.path.append(str(HERE.parent / "live"))
import figures  # noqa: E402
import kernel  # noqa: E402
import pages  # noqa: E402
import paper  # noqa: E402
import sources  # noqa: E402

OUT = pathlib.Path(sys.argv[1])
KATEX = pathlib.Path("/usr/share/javascript/katex")
FRAME = (HERE / "frame.html").read_text()
NAMES = {"index": "Start", "course": "The course on one page", "workshop": "The workshop", "glossary": "Glossary and index"}  # in the contents


def captions():
    """What stands below a figure: from captions.txt; else the begin of its description."""
    known = dict(line.split(": ", 1) for line in (HERE / "captions.txt").read_text().splitlines() if ": " in line)

    def caption(source, alt):
        first = re.split(r"(?<=[^\d])[.;:] ", alt)[0].rstrip(".;:")
        return html.escape(known[pathlib.Path(source).stem], quote=False) if pathlib.Path(source).stem in known else f"{first}."
    return caption


# ---- the frame of a page ----

def named(page):
    return NAMES.get(page.name, page.title)


def contents(all_pages, here, root):
    """Every page, and the sections of this one."""
    rows, part = [], ""
    for page in all_pages:
        if pages.part(page) != part:
            part = pages.part(page)
            rows.append(f'<li class="part">{part}</li>')
        mark = ' aria-current="page"' if page is here else ""
        inner = ""
        if page is here:
            inner = "".join(f'<li><a href="#{ident}">{title}</a></li>' for level, ident, title in page.headings if level == 2)
            inner = f"<ol>{inner}</ol>" if inner else ""
        rows.append(f'<li><a href="{root}{page.name}.html"{mark}>{unlinked(named(page))}</a>{inner}</li>')
    rows.insert(1, f'<li><a href="{root}play/index.html">The live page</a></li>')
    rows.append(f'<li><a href="{root}source/index.html">The sources</a></li>')
    return f"<ol>{''.join(rows)}</ol>"


def unlinked(title):
    return re.sub(r"</?a\b[^>]*>", "", title)


def plain(title):
    """Of a title, its words: without markup, a formula by its source."""
    title = re.sub(r'<span class="katex">.*?<annotation[^>]*>(.*?)</annotation>.*?aria-hidden="true">.*?</span></span></span>', r"\1", title)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", title)).strip()


def turn(before, after):
    back = f'<a rel="prev" href="{before.name}.html">← {unlinked(named(before))}</a>' if before else ""
    on = f'<a rel="next" href="{after.name}.html">{unlinked(named(after))} →</a>' if after else ""
    return f'<nav class="turn" aria-label="Neighbours">{back}{on}</nav>'


def live_scripts(body):
    """The scripts of the figures that move on a page; the C comes when one of them is near."""
    names = ["live", *dict.fromkeys(re.findall(r'data-live="(\w+)"', body))]
    return "".join(f'<script src="live/{name}.js" defer></script>\n' for name in names) if len(names) > 1 else ""


def framed(body, title, table, root="", kind="text", neighbours=""):
    page = FRAME
    for name, value in (("root", root), ("title", title), ("kind", kind), ("contents", table), ("turn", neighbours), ("scripts", live_scripts(body)),
                        ("page", body)):
        page = page.replace(f"{{{name}}}", value)
    return page


# ---- the parts of the site ----

def write_pages(all_pages):
    for i, page in enumerate(all_pages):
        before, after = (all_pages[j] if 0 <= j < len(all_pages) else None for j in (i - 1, i + 1))
        text = framed(f'<article id="top">{page.body}</article>', plain(page.title), contents(all_pages, page, ""), neighbours=turn(before, after))
        (OUT / f"{page.name}.html").write_text(text)


def add_index(all_pages):
    """Below the glossary: each function that the text names, its header, and the pages that name it."""
    headers = {name: path for path in sorted(pathlib.Path("src/fvi").rglob("*.h"))
               for name in re.findall(r"^[a-z][\w *]*?\b(fvi_\w+)\(", path.read_text(), re.M)}
    rows = []
    for name in sorted(headers):
        users = [page for page in all_pages if re.search(rf"<code>{name}\b", page.body)]
        links = ", ".join(f'<a href="{page.name}.html">{page.number or unlinked(named(page))}</a>' for page in users)
        header = sources.source_page(headers[name])
        rows.append(f'<li><a href="source/{header}"><code>{pages.breakable(name)}</code></a>{": " if links else ""}{links}</li>')
    glossary = next(page for page in all_pages if page.name == "glossary")
    glossary.headings.append((2, "functions", "The functions of the library"))
    glossary.body += (f'<h2 id="functions">The functions of the library</h2><p>Each leads to its header; the numbers are '
                      f'the chapters that name it.</p><ul class="names">{"".join(rows)}</ul>')


def write_sources(all_pages):
    """A page for each source that a page of the text leads to, for the library's headers and for the figures that
    move; the others are named in the list."""
    every = sources.all_sources()
    folder, table = OUT / "source", contents(all_pages, None, "../")
    folder.mkdir()
    for page in all_pages:
        page.sources = set(re.findall(r'"source/([^"#]*)', page.body))
    opened = set().union(*(page.sources for page in all_pages))
    files = [path for path in every if sources.source_page(path) in opened or path.parts[:2] in (("src", "fvi"), ("chapters", "live"))
             or path == pathlib.Path("chapters/play/play.c")]
    names = {sources.source_page(path) for path in files}
    for path in files:
        name = sources.source_page(path)
        users = [page for page in all_pages if name in page.sources]
        used = "".join(f'<a href="../{page.name}.html">{page.number or unlinked(page.title)}</a> ' for page in users)
        body = sources.source_html(path, names).replace("{used}", f"<p>Read about it in: {used}</p>" if used else "", 1)
        (folder / name).write_text(framed(body, str(path), table, "../", "source"))
    rows = []
    for parent in sorted({path.parent for path in every}):
        links = " ".join(f'<li><a href="{sources.source_page(p)}">{p.name}</a></li>' if sources.source_page(p) in names else f"<li>{p.name}</li>"
                         for p in every if p.parent == parent)
        rows.append(f'<h2 id="{"-".join(parent.parts) or "root"}">{parent}/</h2><ul class="names">{links}</ul>')
    (folder / "index.html").write_text(framed(f'<h1 id="top">The sources</h1>{"".join(rows)}', "The sources", table, "../", "source"))
    return files


def words_of(body):
    """The text of a section for the search: no display, no code block; a short formula as words."""
    body = re.sub(r'<pre.*?</pre>|<span class="math display">.*?</span>|<p class="from">.*?</p>|<a class="anchor".*?</a>', " ", body, flags=re.S)
    body = re.sub(r'<span class="math inline">\\\((.*?)\\\)</span>', lambda m: simple(m[1]), body, flags=re.S)
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", " ", body))).strip()


def simple(formula):
    greek = {"alpha": "α", "beta": "β", "rho": "ρ", "kappa": "κ", "omega": "ω", "lambda": "λ", "gamma": "γ", "Delta": "Δ",
             "Gamma": "Γ", "le": "≤", "ge": "≥", "to": "→", "infty": "∞", "cdot": "·", "tfrac12": "1/2", "mu": "μ", "tau": "τ"}
    text = re.sub(r"\\(tfrac12|[A-Za-z]+) ?", lambda m: greek.get(m[1], "\\"), formula).replace("\\,", " ")
    return "…" if re.search(r"[\\{}&]", text) else text


def write_search(all_pages, files, found):
    rows = []
    for page in all_pages:
        for part in re.split(r"(?=<h[1-3] )", page.plain):
            heading = re.match(r'<h[1-3] id="([^"]*)">(.*?)</h[1-3]>', part, re.S)
            if heading:
                rows.append({"u": f"{page.name}.html#{heading[1]}", "p": words_of(page.plain_title),
                             "t": words_of(heading[2]), "x": words_of(part[heading.end():])})
    rows += [{"u": f"source/{sources.source_page(path)}", "p": "source", "t": str(path), "x": ""} for path in files]
    places = {number: f"{page.name}.html#eq-{number}" for number, (page, _) in found.items()}
    (OUT / "assets/texts.js").write_text(f"const FVI_TEXTS = {script(rows)};\nconst FVI_PLACES = {script(places)};\n")
    return len(rows)


def script(value):
    return json.dumps(value, ensure_ascii=False, separators=(",", ":")).replace("</", "<\\/")


def write_equations(found):
    """The formulas of each page for the previews of the others, without their MathML."""
    by_page = {}
    for number, (page, formula) in found.items():
        shown = re.sub(r'<span class="katex-mathml">.*?</math></span>', "", formula, flags=re.S)
        by_page.setdefault(page.name, {})[number] = shown
    for name, formulas in by_page.items():
        (OUT / f"assets/equations-{name}.js").write_text(
            f"globalThis.FVI_EQUATIONS = Object.assign(globalThis.FVI_EQUATIONS ?? {{}}, {script(formulas)});\n")


def write_assets():
    (OUT / "assets/fonts").mkdir(parents=True)
    for font in (KATEX / "fonts").glob("*.woff2"):
        shutil.copy(font, OUT / "assets/fonts")
    css = (KATEX / "katex.min.css").read_text()
    (OUT / "assets/katex.min.css").write_text(re.sub(r',url\([^)]*\.(?:woff|ttf)\) format\("[a-z]*"\)', "", css))
    for name in ("style.css", "print.css", "head.js", "book.js", "search.js"):
        shutil.copy(HERE / name, OUT / "assets")


def write_live_page():
    """The live page, whose links to the chapters are those of the repository."""
    (OUT / "play").mkdir()
    page = (HERE.parent / "play/index.html").read_text()
    page = page.replace('href="../README.md"', 'href="../index.html"')
    (OUT / "play/index.html").write_text(re.sub(r'href="\.\./(?:further|handbook)/(\d\d-\w+)\.md', r'href="../h\1.html', page))


# ---- every link leads somewhere ----

def check_links():
    """Returns how many; a dead one, or an id that stands twice on a page, ends the build."""
    texts = {file.relative_to(OUT).as_posix(): re.sub(r"<script>.*?</script>", "", file.read_text(), flags=re.S)
             for file in OUT.rglob("*.html")}
    others = {file.relative_to(OUT).as_posix() for file in OUT.rglob("*.*")}
    ids, faults, count = {}, [], 0
    for name, text in texts.items():
        found = re.findall(r'\bid="([^"]+)"', text)
        ids[name] = set(found)
        if len(found) != len(ids[name]):
            faults.append(f"{name}: an id stands twice: {sorted(i for i in ids[name] if found.count(i) > 1)}")
    for name, text in texts.items():
        for target in set(re.findall(r'\b(?:href|src)="([^"]*)"', text)):
            path, _, anchor = html.unescape(target).partition("#")
            if re.match(r"(https?|mailto|data):", path):
                continue
            count += 1
            there = posixpath.normpath(posixpath.join(posixpath.dirname(name), path)) if path else name
            if there not in others:
                faults.append(f"{name}: leads nowhere: {target}")
            elif anchor and not there.startswith("play/") and anchor not in ids[there]:
                faults.append(f"{name}: no such place: {target}")
    if faults:
        sys.exit("\n".join(faults))
    return count


def main():
    shutil.rmtree(OUT, ignore_errors=True)
    write_assets()
    figures.copy_all(OUT / "figures")
    all_pages = pages.all_pages()
    pages.to_html(all_pages)
    for page in all_pages:
        pages.to_places(page)
        pages.number_headings(page)
        pages.exercises(page)
        pages.row_of_files(page)
        pages.without_neighbours(page)
        pages.number_figures(page, captions())
        page.plain, page.plain_title = page.body, page.title
        pages.colour_code(page)
        pages.scrolling_tables(page)
        pages.unbroken(page)
    found = pages.render(all_pages)
    for page in all_pages:
        pages.link_equations(page, found)
    all_pages.sort(key=pages.order)
    add_index(all_pages)
    write_pages(all_pages)
    files = write_sources(all_pages)
    sections = write_search(all_pages, files, found)
    write_equations(found)
    write_live_page()
    kernel.write(OUT / "live")
    version = re.search(r'FVI_VERSION "([^"]*)"', pathlib.Path("src/fvi/version.h").read_text())[1]
    paper.write(OUT, [page for page in all_pages if pages.on_paper(page)], plain, version)
    links = check_links()
    print(f"{OUT}/index.html: {len(all_pages)} pages, {len(files)} sources, {len(found)} numbered equations, "
          f"{sections} places to search, {links} links")


main()
