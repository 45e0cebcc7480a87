"""The sources as pages with colours, a number and an anchor for each line."""
import html
import json
import pathlib
import re

SUFFIXES = {".c": "c", ".h": "c", ".py": "python", ".sh": "sh", ".gp": "sh", ".mjs": "js", ".js": "js",
            ".txt": "text", ".toml": "sh", ".tsv": "text", ".css": "text", ".html": "text", ".1": "text", ".md": "text",
            ".ipynb": "python"}
WORDS = {
    "c": "auto break case char const continue default do double else enum extern float for goto if inline int long "
         "register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while "
         "size_t _Bool _Complex _Alignas NULL",
    "python": "and as assert break class continue def del elif else except finally for from global if import in is "
              "lambda nonlocal not or pass raise return try while with yield True False None",
    "js": "async await break case catch class const continue default delete do else export extends finally for from "
          "function if import in instanceof let new null of return static switch this throw true false try typeof "
          "undefined var while yield",
    "sh": "if then else elif fi for in do done while case esac plot splot set unset define endef ifeq ifneq endif",
}
NUMBER = r"(?<![\w.])(?:0x[\da-fA-F.]+(?:p[+-]?\d+)?|\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)[uUlLfF]*"
STRING = r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\''
COMMENT = {"c": r"/\*.*?\*/|//[^\n]*", "python": r"#[^\n]*", "sh": r"(?<![^\s])#[^\n]*", "js": r"/\*.*?\*/|//[^\n]*"}
LONG = {"python": r'"""(?:.*?)"""|', "js": r"`(?:\\.|[^`\\])*`|"}


def pattern(language):
    words = "|".join(WORDS[language].split())
    directive = r"|(?P<directive>^[ \t]*\#[ \t]*\w+)" if language == "c" else ""
    return re.compile(rf"(?P<comment>{COMMENT[language]})|(?P<string>{LONG.get(language, '')}{STRING})"
                      rf"{directive}|(?P<number>{NUMBER})|(?P<word>\b(?:{words})\b)", re.S | re.M)


PATTERNS = {language: pattern(language) for language in WORDS}
# What a chapter calls a language; the rest is not coloured.
NAMES = {"c": "c", "python": "python", "sh": "", "bash": "sh", "gnuplot": "sh", "make": "sh", "js": "js", "javascript": "js"}
CLASSES = {"comment": "co", "string": "st", "directive": "kw", "number": "st", "word": "kw"}


def colour(code, language):
    """HTML of a piece of code: comments, words of the language, constants."""
    find = PATTERNS.get(NAMES.get(language, language))
    if not find:
        return html.escape(code)
    out, end = [], 0
    for match in find.finditer(code):
        out.append(html.escape(code[end:match.start()]))
        out.append(f'<span class="{CLASSES[match.lastgroup]}">{html.escape(match[0])}</span>')
        end = match.end()
    return "".join(out) + html.escape(code[end:])


def source_page(path):
    """src/memory/past.c -> src-memory-past.c.html; a folder -> its part of the list."""
    path = pathlib.Path(path)
    if path.is_dir():
        return f"index.html#{'-'.join(path.parts)}"
    return "-".join(path.parts) + ".html"


def all_sources():
    """Every file of text that a reader may want to follow a link to."""
    roots = ("src", "tests", "verify", "figures", "chapters")
    pages = [*pathlib.Path("chapters").glob("*.md"), *pathlib.Path("chapters").glob("[fh]*/*.md"), pathlib.Path("chapters/play/index.html")]
    files = [p for root in roots for p in pathlib.Path(root).rglob("*")
             if p.is_file() and p.suffix in SUFFIXES and "__pycache__" not in p.parts and p not in pages]
    return sorted([*files, pathlib.Path("Makefile"), pathlib.Path("LICENSE")])


def lines_of(code):
    """The coloured lines; what is open at the end of one is closed, and opened in the next."""
    open_tags, out = [], []
    for line in code.split("\n"):
        text = "".join(open_tags) + line
        for tag in re.findall(r"<span[^>]*>|</span>", line):
            open_tags.pop() if tag == "</span>" else open_tags.append(tag)
        out.append(text + "</span>" * len(open_tags))
    return out


def include(match, names):
    """#include <fvi/x.h> or "room/x.h" -> a link to that header's page, if it has one of those names."""
    header = pathlib.Path("src") / match[2]  # the include paths are src and tests
    if ".." in match[2] or source_page(header) not in names:
        return match[0]
    return f'{match[1]}<a href="{source_page(header)}">{match[2]}</a>{match[3]}'


def text_of(path):
    """What a reader wants to see of a source: of a notebook its cells, as a script."""
    if path.suffix != ".ipynb":
        return path.read_text(errors="replace")
    cells = json.loads(path.read_text())["cells"]
    return "\n\n".join("".join(cell["source"] if cell["cell_type"] == "code" else ["# " + line for line in cell["source"]])
                       for cell in cells)


def source_html(path, names):
    """The body of the page of one source; names: of the pages that there are."""
    language = "sh" if path.name == "Makefile" else SUFFIXES.get(path.suffix, "text")
    code = colour(text_of(path).rstrip("\n"), language)
    if language == "c":
        code = re.sub(r'(<span class="kw">#include</span> (?:&lt;|<span class="st">"))([\w/.]+)(&gt;|")', lambda found: include(found, names), code)
    lines = "\n".join(f'<span class="l" id="L{i}"><a href="#L{i}" aria-label="Line {i}"></a>{line}</span>'
                      for i, line in enumerate(lines_of(code), 1))
    return f'<h1 id="top">{html.escape(str(path))}</h1>\n{{used}}<pre class="source">{lines}</pre>'
