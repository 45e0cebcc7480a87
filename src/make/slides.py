"""Slides of every chapter, from its own words.      slides.py OUT [06]

OUT/06-fvi.html is Chapter 6 of the Course, OUT/h09-fvi.html is page 9 of the Handbook.
A file has the question, the first picture, and for each section of the main text its statements,
figures and numbered equations with the sentence before them. Slides of the Course also show tables, code, what we
have now, and each exercise: about 25 for a lecture. Figures that move, move here, too. What stands in boxes that fold is left out, but for the
program. Each file stands alone: pictures, scripts, style and fonts are in it. The formulas go the way of the book,
by pandoc and KaTeX. Keys: right and left, Home and End; on paper a slide is a page."""
import base64
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path += ["chapters/book", "chapters/live"]
import kernel  # noqa: E402
from pages import MOVES, alone, file_name, pandoc_math  # noqa: E402

OUT = pathlib.Path(sys.argv[1])
KATEX = pathlib.Path("/usr/share/javascript/katex")
FIGURE = re.compile(r"^!\[([^\]]*)\]\((?:\.\./)+(figures/[^)]*\.svg)\)$", re.M)
EQUATION = re.compile(r"^```math\n(?:(?!^```).)*?\\tag\{.*?^```$", re.M | re.S)
FORMULA = re.compile(r"^```math\n.*?^```$", re.M | re.S)
TABLE = re.compile(r"^\|.*\n(?:\|.*\n)+", re.M)
CODE = re.compile(r"^```(?:c|text)\n.*?^```$", re.M | re.S)
LIST = re.compile(r"^- .*?(?=\n\n|\Z)", re.M | re.S)
LINES = 18  # of code on a slide
WORD = r"\*\*(?:Theorem|Lemma|Proposition|Corollary|Definition)\b"
STATEMENT = re.compile(rf"^{WORD}.*?(?=\n\n)", re.M | re.S)
QUOTED = re.compile(rf"^> {WORD}.*\n(?:>.*\n)*", re.M)
PROGRAM = re.compile(r"<details><summary>(?:Our|The library's) lines:.*?</summary>(.*?)</details>", re.S)
ASIDE = re.compile(r"<details>.*?</details>|<!--(?! moves:).*?-->", re.S)
TASK = re.compile(r"^(\d+)\. (.*?)(?=^\d+\. |^\*How we know|\Z)", re.M | re.S)
STYLE = """
body { margin: 0; font: 1.6rem/1.4 Georgia, "DejaVu Serif", serif; color: #222; background: #fff; }
section { box-sizing: border-box; width: 100vw; min-height: 100vh; padding: 4vh 6vw; page-break-after: always; }
.live section { display: none; } .live section.now { display: block; }
h1, h2, footer { font-family: "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; }
h1 { font-size: 3rem; margin-top: 22vh; } h2 { font-size: 1.19em; margin: 0 0 3vh; }
figure { margin: 0; text-align: center; } img { max-width: 100%; max-height: 68vh; }
figure:not(:last-child) img { max-height: 50vh; } figure + p { font-size: .75em; }
figcaption { font-size: .75em; color: #444; } footer { position: fixed; right: 2vw; bottom: 1vh; font-size: .9rem; color: #666; }
code { font-size: .85em; } pre { font-size: .75em; line-height: 1.25; } table { border-collapse: collapse; } td, th { padding: .2em .8em; border-bottom: 1px solid #ccc; } .katex { font-size: 1em; } .katex-display { margin: 1.2em 0; }
figure.is-live > img, figure.is-live > figcaption, figure:not(.is-live) > .live, .links { display: none; }
.live { font: 1.1rem/1.3 "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; text-align: left; } .live p { margin: .2rem 0; font-size: 1rem; }
.live .controls { display: grid; grid-template-columns: repeat(auto-fit, minmax(14rem, 1fr)); gap: .2rem 2rem; } .live label { display: block; }
.live input { display: block; width: 100%; } .live output { font-weight: bold; } .live .says { min-height: 2.8em; }
.live .pictures { display: grid; grid-template-columns: 1fr 1fr; gap: 1rem; } .live canvas { display: block; width: 100%; height: 38vh; cursor: crosshair; }
@media print { .live { display: none; } figure.is-live > img, figure.is-live > figcaption { display: block; } footer { display: none; } .live section { display: block; } }
"""
SCRIPT = """
const all = [...document.querySelectorAll('section')], foot = document.querySelector('footer');
// What does not fit on a wall gets smaller letters, but no smaller than half.
function fit(slide) {
  const page = document.documentElement, over = () => page.scrollHeight > innerHeight + 2 || page.scrollWidth > innerWidth + 2;
  slide.style.fontSize = '';
  for (let size = 1.5; over() && size >= 0.8; size -= 0.1) slide.style.fontSize = `${size}rem`;
}
function show(n) {
  n = Math.max(0, Math.min(all.length - 1, n));
  all.forEach((s, i) => s.classList.toggle('now', i === n));
  for (const figure of all[n].querySelectorAll('[data-live]:not(.is-live)')) {
    FVI_LIVE.frame(figure);
    FVI_LIVE.begin(figure).then(() => fit(all[n]));
  }
  fit(all[n]);
  foot.textContent = `${n + 1} / ${all.length}`;
  history.replaceState(null, '', `#${n + 1}`);
}
const here = () => all.findIndex(s => s.classList.contains('now'));
const steps = { ArrowRight: 1, ' ': 1, PageDown: 1, ArrowLeft: -1, PageUp: -1, Home: -1e9, End: 1e9 };
addEventListener('keydown', e => { if (e.key in steps && !e.target.closest('input, select, canvas, button')) { e.preventDefault(); show(here() + steps[e.key]); } });
addEventListener('click', e => { if (!e.target.closest('a, .live')) show(here() + 1); });
const again = () => fit(all[here()]);
addEventListener('resize', again);
document.fonts.ready.then(again);
document.body.classList.add('live');
show((parseInt(location.hash.slice(1)) || 1) - 1);
"""


def captions():
    lines = pathlib.Path("chapters/book/captions.txt").read_text().splitlines()
    return dict(line.split(": ", 1) for line in lines if ": " in line)


def picture(match, known):
    file = pathlib.Path(match[2])
    words = known.get(file.stem) if file.stem in known else re.split(r"(?<=[^\d])[.;:] ", match[1])[0].rstrip(".;:") + "."
    data = base64.b64encode(file.read_bytes()).decode()
    live = f' data-live="{file.stem}"' if file.stem not in alone() and (kernel.HERE / f"{file.stem}.js").exists() else ""
    return (f'<figure{live}><img src="data:image/svg+xml;base64,{data}" alt="{html.escape(match[1])}">'
            f"<figcaption>{'<a>This figure</a> ' if live else ''}{html.escape(words, quote=False)}</figcaption></figure>")


def moving(match):
    return f'<figure data-live="{match[1]}"><figcaption><a>This figure</a></figcaption></figure>'


def sentence_before(body, at):
    """The last sentence before this place, past formulas, tables and code; nothing, if no words stand there."""
    words = re.sub(r"^```.*?^```$", "", body[:at], flags=re.M | re.S).rstrip()
    paragraphs = [p for p in words.split("\n\n") if p.strip() and not re.match(r"[|>!<]", p.strip())]
    if not paragraphs:
        return ""
    paragraph = re.sub(r"^- ", "", paragraphs[-1].strip(), flags=re.M)
    return re.split(r"(?<=[.?!])\s+(?=[A-Z])", paragraph)[-1] + "\n\n"


def slides(page, known):
    """The Markdown of each slide."""
    text = ASIDE.sub("", PROGRAM.sub(r"\1", page.read_text()))
    course = page.parent.name == "chapters"
    front, *sections = re.split(r"^## ", text, flags=re.M)
    title = re.search(r"^# (.*)", front)[1]
    asked = [p for p in front.split("\n\n")[1:] if not p.startswith(("|", "Play with it", "![", "```"))]
    asked = [p for p in asked if "?" in p] or asked
    yield f"# {title}\n\n{asked[0]}"
    for match in FIGURE.finditer(front):  # what is to be seen in it stands below
        words = front[match.end():].strip().partition("\n\n")[0]
        yield f"## {title}\n\n{picture(match, {pathlib.Path(match[2]).stem: ''})}\n\n{words}"
    for match in MOVES.finditer(front):
        yield f"## {title}\n\n{moving(match)}"
    for section in sections:
        heading, _, body = section.partition("\n")
        if heading == "Exercises" and course:
            for match in TASK.finditer(body):
                yield f"## Exercise {match[1]}\n\n{match[2]}"
            return
        if heading.startswith(("Exercises", "Sources", "Appendix")):
            break
        kinds = [STATEMENT, QUOTED, FIGURE, MOVES] + ([FORMULA, TABLE, CODE, LIST] if course else [EQUATION])
        found = sorted([m for kind in kinds for m in kind.finditer(body)], key=lambda m: m.start())
        waiting = []
        for match in found:
            if match.re is FIGURE:
                yield f"## {heading}\n\n" + picture(match, known)
                continue
            if match.re is MOVES:
                yield f"## {heading}\n\n{moving(match)}"
                continue
            if match.re is CODE and match[0].count("\n") > LINES:
                continue
            before = sentence_before(body, match.start()) if match.re in (EQUATION, FORMULA, TABLE, CODE, LIST) else ""
            waiting.append(before + re.sub(r"^> ?", "", match[0], flags=re.M).strip())
            if course or match.re in (TABLE, CODE):
                yield f"## {heading}\n\n" + "\n\n".join(waiting)
                waiting = []
            if len(waiting) == 2:
                yield f"## {heading}\n\n" + "\n\n".join(waiting)
                waiting = []
        if waiting:
            yield f"## {heading}\n\n" + "\n\n".join(waiting)
    yield f"## Exercises\n\nThey stand at the end of `{page}`. All of them: `chapters/workshop/exercises.md`."


def to_html(markdown):
    cut = "<!-- slide -->"
    run = subprocess.run(["pandoc", "-f", "gfm+tex_math_dollars-gfm_auto_identifiers", "-t", "html5", "--mathjax",
                          "--wrap=preserve", "--no-highlight"], input=f"\n\n{cut}\n\n".join(map(pandoc_math, markdown)),
                         capture_output=True, text=True, check=True)
    pieces = run.stdout.split(cut)
    run = subprocess.run(["node", "chapters/book/katex.js"], input=json.dumps([pieces]), capture_output=True, text=True)
    if run.returncode:
        sys.exit(run.stderr)
    return [re.sub(r'<a class="anchor".*?</a>', "", piece) for piece in json.loads(run.stdout)["pages"][0]]


def style():
    """KaTeX's, with its fonts in it."""
    def font(match):
        data = base64.b64encode((KATEX / "fonts" / match[1]).read_bytes()).decode()
        return f"url(data:font/woff2;base64,{data})"
    css = re.sub(r',url\([^)]*\.(?:woff|ttf)\) format\("[a-z]*"\)', "", (KATEX / "katex.min.css").read_text())
    return re.sub(r"url\(fonts/([\w-]+\.woff2)\)", font, css) + STYLE


def scripts(body):
    """Of the figures that move on these slides, with the C."""
    names = list(dict.fromkeys(re.findall(r'data-live="(\w+)"', "".join(body))))
    return "".join(f"<script>{(OUT / f'live/{name}.js').read_text()}</script>" for name in ([*dict.fromkeys(map(kernel.script_of, names)), "live", *names] if names else []))


def main():
    known, css = captions(), style()
    css += re.search(r":root \{[^}]*\}", pathlib.Path("chapters/book/style.css").read_text())[0].replace("light dark", "light")  # the colours of curves
    OUT.mkdir(parents=True, exist_ok=True)
    shutil.rmtree(OUT / "live", ignore_errors=True)
    kernel.write(OUT / "live")
    pages = sorted(pathlib.Path("chapters").glob(f"**/{(sys.argv[2:] or ['[0-9][0-9]'])[0]}-*.md"))
    total = 0
    for page in pages:
        body = to_html(list(slides(page, known)))
        total += len(body)
        sections = "\n".join(f"<section>{piece}</section>" for piece in body)
        (OUT / f"{file_name(page)}.html").write_text(
            f'<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>{file_name(page)}</title><style>{css}</style>'
            f"<body>{sections}<footer></footer>{scripts(body)}<script>{SCRIPT}</script></body></html>\n")
    print(f"{total} slides of {len(pages)} chapters: {OUT}/*.html")


main()
