"""Formulas within a line that GitHub would spoil are written with backticks.

    formulas.py            write them so, in every page
    formulas.py --check    exit 1 if one is not, or if a line of one begins with "- ", "+ " or "1. " as
                           an item of a list does (part of make text)

GitHub reads $...$ as Markdown first, and takes a backslash before a punctuation mark away: $a\\,b$
loses its space, and a matrix its rows. Of $`...`$ it takes nothing. Only Python's standard
library is used."""
import pathlib
import re
import sys

PAGES = [pathlib.Path("README.md"), *sorted(pathlib.Path("chapters").glob("**/*.md"))]
# What stands as it is: blocks of code, notes, formulas with backticks, code within a line.
KEPT = re.compile(r"^ *```.*?^ *```$|<!--.*?-->|\$`.+?`\$|(?<!`)(`+)(?!`).+?(?<!`)\1(?!`)", re.M | re.S)
FORMULA = re.compile(r"(?<![\\$])\$(?! )((?:[^$\n\\]|\\.|\n(?!\n))+?)(?<! )\$(?!\d)")
SPOILT = re.compile(r"\\[!-/:-@\[-`{-~]")


def mended(text):
    """The page with backticks where they are needed, and the lines of these formulas."""
    lines, out, end = [], [], 0

    def mend(start, piece):
        def with_backticks(match):
            if not SPOILT.search(match[1]):
                return match[0]
            lines.append(text.count("\n", 0, start + match.start()) + 1)
            return f"$`{match[1]}`$"
        return FORMULA.sub(with_backticks, piece)

    for kept in KEPT.finditer(text):
        out += [mend(end, text[end:kept.start()]), kept[0]]
        end = kept.end()
    return "".join([*out, mend(end, text[end:])]), lines


LISTED = re.compile(r"\n *(?:[-+*]|\d+[.)]) ")


def listed(text):
    """The numbers of the lines where a formula begins that has such a line: for GitHub a list ends the formula."""
    within = re.sub(r"^ *```.*?^ *```$|<!--.*?-->", lambda kept: re.sub(r"[^\n]", " ", kept[0]), text, flags=re.M | re.S)
    return [within.count("\n", 0, match.start()) + 1 for match in re.finditer(rf"\$`.+?`\$|{FORMULA.pattern}", within, re.S) if LISTED.search(match[0])]


def main():
    faults = []
    for page in PAGES:
        text, lines = mended(page.read_text())
        if sys.argv[1:] == ["--check"]:
            faults += [f"{page}:{line}: GitHub takes backslashes out of this formula; write $`...`$" for line in lines]
            faults += [f"{page}:{line}: a line of this formula begins a list; break it elsewhere" for line in listed(page.read_text())]
        elif lines:
            page.write_text(text)
    sys.exit("\n".join(faults) or 0)


main()
