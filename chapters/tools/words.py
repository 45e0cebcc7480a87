"""Count the words of every page, and see that each begins with a picture.

    words.py            the words of each page, section by section
    words.py --check    exit 1 if a page has no picture before its first heading, or the index
                        or README.md more words than it may (part of make text)

Counted is the text that one reads without opening anything: no box that folds, no quoted
code, displayed formula, table, invisible note or alternative text of a picture, and no
exercises, sources or appendix. A word is what stands between two spaces, so that a formula
within a line counts as a few. Only Python's standard library is used."""
import pathlib
import re
import sys

ASIDE = re.compile(r"<details>.*?</details>|^```.*?^```$|<!-- excerpt: \S+ -->\n(?:>.*\n)+|<!--.*?-->|!\[[^\]]*\]\([^)]*\)|^\|.*?$|\]\([^)]*\)",
                   re.M | re.S)
BEHIND = ("Exercises", "Sources", "Appendix")


def sections(text):
    """(heading, words) of the main text."""
    for section in re.split(r"^##? ", ASIDE.sub("", text), flags=re.M)[1:]:
        heading = section.partition("\n")[0]
        if not heading.startswith(BEHIND):
            yield heading, len(section.split())


def faults(page):
    if not re.search(r"!\[[^\]]*\]\(", page.read_text().partition("\n## ")[0]):
        yield f"{page}: no picture before the first heading"


def too_long():
    """The index says of a section how many words it has, a formula counted as one; README.md may have 900 in all,
    with its code and tables."""
    for heading, count in sections(re.sub(r"\$[^$]*\$", "formula", pathlib.Path("chapters/README.md").read_text())):
        most = re.fullmatch(r".* in (\d+) words", heading)
        if most and count - len(heading.split()) > int(most[1]):
            yield f"chapters/README.md: {heading}: it has {count - len(heading.split())}"
    readme = re.sub(r"!\[[^\]]*\]\([^)]*\)|\]\([^)]*\)|<!--.*?-->|\|", "", pathlib.Path("README.md").read_text())
    if len(readme.split()) > 900:
        yield f"README.md: {len(readme.split())} words, and 900 at most are wanted"


def main():
    pages = sorted(pathlib.Path("chapters").glob("**/[0-9][0-9]-*.md"))
    if sys.argv[1:] == ["--check"]:
        sys.exit("\n".join([*(fault for page in pages for fault in faults(page)), *too_long()]) or 0)
    for page in pages:
        found = list(sections(page.read_text()))
        print(f"{sum(count for _, count in found):5d}  {page.stem}: " + ", ".join(f"{h} {n}" for h, n in found[1:]))


main()
