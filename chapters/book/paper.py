"""The chapters as one document for paper, OUT/print.html; print.mjs makes the PDF of it.

Places get the name of their chapter in front, so that none stands twice; a link to a
file that is not on paper keeps its words only; answers stand at the end of their chapter."""
import datetime
import re
import subprocess

FRAME = """<!DOCTYPE html>
<html lang="en" data-theme="light">
<head>
<meta charset="utf-8">
<title>Fractional variational integrators: a course that runs</title>
<link rel="stylesheet" href="assets/katex.min.css">
<link rel="stylesheet" href="assets/style.css">
<link rel="stylesheet" href="assets/print.css">
<style>
{heads}
</style>
</head>
<body>
<section class="cover"><p class="title">Fractional variational integrators</p>
<p>A course that runs: mechanics with memory, simulated by discretising a variational principle.</p>
<p>The method is by Fernando Jiménez and Sina Ober-Blöbaum, <em>Fractional damping through restricted calculus of
variations</em>. The course, the program and the library are by the authors of the repository.</p>
<p class="small">Version {version}, {date}, made from {source} by <code>make pdf</code>. Each chapter has a module in C, a test, a proof by sympy and figures drawn from what the C
printed; the files that are named here stand in the repository of the course.</p></section>
<nav class="toc"><h1 class="plain">Contents</h1><ol>
{rows}
</ol></nav>
{chapters}
</body>
</html>
"""


def answers_last(page, body):
    """The answers to exercise 1, 2, ... move to the end, each with its number."""
    start = body.find("<h2 id=\"exercises\"")
    if start < 0:
        return body
    out, answers, number, depth, end = [], [], 0, 0, start
    for match in re.finditer(r"<ol[^>]*>|</ol>|<li\b[^>]*>|<details>\s*<summary>Answer\.?</summary>(.*?)</details>", body[start:], re.S):
        if match[1] is None:
            depth += {"<ol": 1, "</o": -1}.get(match[0][:3], 0)
            number += match[0].startswith("<li") and depth == 1
            continue
        out.append(body[end:start + match.start()])
        end = start + match.end()
        answers.append(f'<div class="answer"><p class="number"><b>{number}.</b></p>{match[1]}</div>')
    if not answers:
        return body
    return body[:start] + "".join(out) + body[end:] + '<h2 id="answers">Answers</h2>' + "".join(answers)


def on_paper(page, body, names):
    """Its places and links, as they are in the one document."""
    body = re.sub(r'<a class="anchor".*?</a>', "", answers_last(page, body), flags=re.S)
    body = re.sub(r'<p>Play with it:\s*<a [^>]*>[^<]*</a>\.\s*</p>', "", body)  # paper does not
    body = re.sub(r'<figure [^>]*data-live="[^"]*"><figcaption>.*?</figure>', "", body, flags=re.S)  # nothing moves on paper
    body = re.sub(r' data-live="[^"]*"', "", body)
    body = re.sub(r"<details[^>]*>\s*<summary>(.*?)</summary>", r'<div class="more"><p class="summary">\1</p>', body, flags=re.S)
    body = body.replace("</details>", "</div>")  # nothing is folded
    body = re.sub(r'(<(?!annotation)[^>]*?\bid=")([^"]*)"', rf'\g<1>{page.name}--\g<2>"', body)
    body = re.sub(r'<h1 id="[^"]*"', f'<h1 id="{page.name}"', body, count=1)

    def link(match):
        file, anchor = re.fullmatch(r"(?:([^#]*?)(?:\.html)?)?(?:#(.*))?", match[1]).groups()
        name = file or page.name
        if re.match(r"https?:", match[1]):
            return match[0]
        if name not in names:
            return match[2]
        return f'<a href="#{name}{"--" + anchor if anchor else ""}">{match[2]}</a>'

    return re.sub(r'<a\b[^>]*?href="([^"]*)"[^>]*>(.*?)</a>', link, body, flags=re.S)


def row(level, ident, title):
    return (f'<li class="level{level}"><a href="#{ident}"><span>{title}</span><span class="dots"></span>'
            f'<span class="page"></span></a></li>')


def made_from():
    """The day and the name of the state of the repository; without git, today."""
    run = subprocess.run(["git", "log", "-1", "--format=%cs %h"], capture_output=True, text=True)
    day, name = run.stdout.split() if run.returncode == 0 else (datetime.date.today().isoformat(), "")
    return f"{int(day[8:])} {datetime.date.fromisoformat(day):%B %Y}", f"the state {name} of the repository" if name else "the sources"


def write(out, chapters, words, version):
    """words: of a title, its words (for running heads)."""
    date, source = made_from()
    names = {page.name for page in chapters}
    heads, rows, bodies = [], [], []
    for page in chapters:
        title = words(page.title).replace('"', '\\"')
        mark = "c" + (page.number.replace(" ", "") or page.name)
        heads.append(f'.{mark} {{ page: {mark} }} @page {mark} {{ @top-left {{ content: "{title}" }} }}')
        rows.append(row(1, page.name, page.title))
        rows += [row(2, f"{page.name}--{ident}", title) for level, ident, title in page.headings if level == 2]
        bodies.append(f'<article class="{mark}">{on_paper(page, page.body, names)}</article>')
    (out / "print.html").write_text(FRAME.replace("{heads}", "\n".join(heads)).replace("{version}", version).replace("{date}", date).replace("{source}", source)
                                    .replace("{rows}", "\n".join(rows)).replace("{chapters}", "\n".join(bodies)))
