"""Keep the code that the chapters show equal to the code that runs.

    excerpts.py [PAGE ...]    rewrite the blocks          (make excerpts)
    excerpts.py --check       say what differs, exit 1    (part of make check)

A block of a chapter that shows code stands under an invisible pointer:
    <!-- excerpt: src/stem.c#region -->
    <!-- excerpt: src/course/body_06.c#run() -->
The second form is a function with the comment above it, or several, as in #U(),dU(). A region lies between the lines `//> region` and `//< region` of the source
(`#> region`, `#< region` in Python and gnuplot); without #region the whole file
is meant. Below a pointer to words, such as those that a benchmark prints, stands a quote
instead: lines that begin with `>`. A fenced block in a language other than text, sh and math must have a
pointer. Only Python's standard library is used."""
import difflib
import pathlib
import re
import sys
import textwrap

FREE = {"", "text", "sh", "math", "mermaid"}
POINTER = re.compile(r"<!-- excerpt: (\S+?)(?:#([\w-]+|\w+\(\)(?:,\w+\(\))*))? -->")
MARK = re.compile(r"\s*(?://|#|/\*)([<>]) ([\w-]+)(?: \*/)?\s*")


def function(path, name):
    """The lines of a function of C, with the comment above it."""
    lines = pathlib.Path(path).read_text().splitlines()
    heads = [i for i, line in enumerate(lines) if re.match(rf"\w[\w *]*\b{re.escape(name)}\([^;]*$|\w[\w *]*\b{re.escape(name)}\(.*\{{", line)]
    if len(heads) != 1:
        raise ValueError(f"{path}: the function {name} must stand there once, and stands there {len(heads)} times")
    first = last = heads[0]
    while lines[first - 1].startswith(("/*", " *")):
        first -= 1
    if "}" not in lines[last]:
        last = lines.index("}", last)
    return lines[first:last + 1]


def region(path, name):
    """The lines of a region, without marks, moved to the left margin."""
    if name and name.endswith("()"):
        return [line for word in name.split(",") for line in function(path, word[:-2])]
    lines = pathlib.Path(path).read_text().splitlines()
    marks = [(i, *m.groups()) for i, line in enumerate(lines) if (m := MARK.fullmatch(line))]
    if name:
        ends = [(i, sign) for i, sign, n in marks if n == name]
        if [sign for _, sign in ends] != [">", "<"]:
            raise ValueError(f"{path}: region {name} must open once and then close once")
        lines = lines[ends[0][0] + 1:ends[1][0]]
    body = "\n".join(line for line in lines if not MARK.fullmatch(line))
    return textwrap.dedent(body).strip("\n").split("\n")


def rewrite(lines):
    """The chapter with every quoted block made anew."""
    out, i = [], 0
    while i < len(lines):
        line = lines[i]
        pointer = POINTER.fullmatch(line.strip())
        if "<!-- excerpt:" in line and not pointer:
            raise ValueError(f"line {i + 1}: not a pointer: {line}")
        out.append(line)
        i += 1
        if pointer:
            if i < len(lines) and lines[i].startswith(">"):
                while i < len(lines) and lines[i].startswith(">"):
                    i += 1
                out += [f"> {text}".rstrip() for text in region(*pointer.groups())]
                continue
            if i == len(lines) or not re.fullmatch(r"```\w+", lines[i]):
                raise ValueError(f"line {i}: a pointer needs a ``` block below it")
            out.append(lines[i])
            i = lines.index("```", i + 1)
            out += region(*pointer.groups()) + ["```"]
            i += 1
        elif re.match(r"\s*(````|~~~)|\s+```", line):
            raise ValueError(f"line {i}: write fences as ``` at the left margin")
        elif line.startswith("```"):
            if line[3:].strip() not in FREE:
                raise ValueError(f"line {i}: a block of code without a pointer")
            end = lines.index("```", i)
            out += lines[i:end + 1]
            i = end + 1
    return out


def main():
    check = "--check" in sys.argv[1:]
    drift = []
    named = [pathlib.Path(a) for a in sys.argv[1:] if a != "--check"]
    for page in named or [pathlib.Path("README.md"), *sorted(pathlib.Path("chapters").glob("**/*.md"))]:
        old = page.read_text().split("\n")
        try:
            new = rewrite(old)
        except (ValueError, OSError) as error:
            sys.exit(f"{page}: {error}")
        drift += difflib.unified_diff(old, new, str(page), "the source", lineterm="")
        if new != old and not check:
            page.write_text("\n".join(new))
    if drift and check:
        sys.exit("\n".join(drift) + "\nchapters differ from the source: run `make excerpts`")


if __name__ == "__main__":
    main()
