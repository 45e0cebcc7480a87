"""The exercises of all chapters: their table, their answers, and whether an answer is right.

An exercise begins `3. *(experiment, 20 min; after 9.6)* ...`: its kind, the minutes that it
takes, the equation before it. Where a program can judge the answer, the box has a note:
    <!-- answer 1.00, 2.00; not 2, 1 -->
Numbers by hand must be equal, or, where they are not whole, right to half a per cent. Those of an experiment
must lie in what workshop_experiments.py measures, made wider; this note is then only an
example of a right answer and, after `not`, of wrong ones, and `make check` asks for both."""
import fractions
import functools
import pathlib
import re
import sys

import workshop_experiments as experiments

KINDS = ("by hand", "code", "break it", "experiment")
HEAD = re.compile(r"^(\d+)\. (?:\*\((" + "|".join(KINDS) + r"), (\d+) min; after ([\d.]+)\)\* )?(.*)", re.M)
TABLE = pathlib.Path("chapters/workshop/exercises.md")
PLAN = pathlib.Path("chapters/workshop/lectures.md")


class Exercise:
    def __init__(self, page, number, kind, minutes, after, text):
        self.chapter, self.page, self.number = page.stem[:2], page, int(number)
        self.kind, self.minutes, self.after, self.text = kind, minutes and int(minutes), after, text
        self.name = f"{self.chapter}-{number}"
        note = re.search(r"<!-- answer (.*?)(?:; not (.*?))? -->", text)
        self.right = note and note[1]
        self.wrong = note and note[2]


def exercises():
    found = []
    for page in sorted(pathlib.Path("chapters").glob("[fh]*/[0-9][0-9]-*.md"), key=lambda page: page.name):
        part = page.read_text().partition("\n## Exercises\n")[2].partition("\n## ")[0]
        heads = list(HEAD.finditer(part))
        ends = [m.start() for m in heads[1:]] + [len(part)]
        found += [Exercise(page, *m.groups()[:4], part[m.start(5):end]) for m, end in zip(heads, ends)]
    return found


def numbers(text):
    return [fractions.Fraction(word) for word in re.split(r"[,\s]+", text.strip())]


def widened(least, largest):
    """By its own width, but not by more than a twentieth, and by one per cent."""
    size = max(abs(least), abs(largest))
    more = min(largest - least, size / 20) + (size / 100 if least != largest or least != round(least) else 0)
    return least - more, largest + more


@functools.cache
def measured(chapter):
    return experiments.EXPERIMENTS[chapter]()


def judge(exercise, answer):
    """None if the answer is right, else a sentence."""
    try:
        got = numbers(answer)
    except (ValueError, ZeroDivisionError):
        return "numbers are wanted, such as 1.5 or -4/81, with commas between them"
    if exercise.kind == "experiment":
        ranges = [widened(*pair) for pair in measured(exercise.chapter)]
    else:
        ranges = [(w, w) if w.denominator == 1 else (w - abs(w) / 200, w + abs(w) / 200)
                  for w in numbers(exercise.right)]
    if len(got) != len(ranges):
        return f"{len(ranges)} numbers are wanted"
    for place, (value, (low, high)) in enumerate(zip(got, ranges), 1):
        if not low <= value <= high:
            return f"number {place}, {float(value):.6g}, is too {'small' if value < low else 'large'}"
    return None


def groups(text, size):
    """The wrong answers: `2, 1` for two numbers is one, `526, 528` for one number two."""
    words = re.split(r",\s*", text)
    return [", ".join(words[i:i + size]) for i in range(0, len(words), size)]


def faults():
    """What `make check` holds of all exercises."""
    every = exercises()
    numbered = set(re.findall(r"\\tag\{([\d.]+)\}", "".join(map(pathlib.Path.read_text, PLAN.parent.parent.glob("**/*.md")))))
    for e in every:
        if not e.kind:
            yield f"{e.page}: exercise {e.number} does not begin with its kind, such as *(by hand, 10 min; after 9.4)*"
        elif e.after not in numbered:
            yield f"{e.page}: exercise {e.number} comes after ({e.after}), which is nowhere"
        if e.kind == "experiment" and e.right and e.chapter not in experiments.EXPERIMENTS:
            yield f"{e.page}: nothing measures what exercise {e.number} asks for"
        if e.kind == "code" and "make workshop-" in e.text and f"make workshop-{e.chapter}" not in e.text:
            yield f"{e.page}: exercise {e.number} names another chapter's workshop"
        if e.right:
            if fault := judge(e, e.right):
                yield f"{e.page}: the answer to exercise {e.number} is refused: {fault}"
            for wrong in groups(e.wrong or "", len(numbers(e.right))):
                if wrong and not judge(e, wrong):
                    yield f"{e.page}: exercise {e.number} accepts {wrong}"
    for page in sorted({e.page for e in every}, key=lambda page: page.name):
        own = [e for e in every if e.page == page]
        if [e.number for e in own] != list(range(1, len(own) + 1)):
            yield f"{page}: its exercises are not numbered 1 to {len(own)}"
        if not any(e.kind == "by hand" for e in own):
            yield f"{page}: no exercise by hand"
        if not any(e.kind == "code" and f"make workshop-{e.chapter}" in e.text for e in own):
            yield f"{page}: no exercise in code that has a hole"
        if not any(e.kind == "experiment" and e.right for e in own):
            yield f"{page}: no exercise by experiment whose answer is judged"
    for name in re.findall(r"\b\d\d-\d+\b", PLAN.read_text()):
        if name not in {e.name for e in every}:
            yield f"{PLAN}: there is no exercise {name}"
    if TABLE.read_text() != table():
        yield f"{TABLE} is not made of the chapters' exercises: run `make exercises`"


def table():
    every = exercises()
    lines = ["# All exercises", "",
             f"{len(every)} exercises of {len({e.page for e in every})} pages of Further and the Handbook, made from their heads by `make exercises`. "
             "*By hand* needs paper; *code* has a hole",
             "in the course's own source and a test that names the equation, where `make workshop-NN` is listed; *break it* "
             "changes a line of the",
             "course and asks which test notices; an *experiment* measures. `make exercise-04-7` shows an exercise, and",
             "`make exercise-04-7 ANSWER=527` judges an answer, where the last column says so.", "",
             "| exercise | kind | minutes | after | judged by |", "|---|---|---|---|---|"]
    for e in every:
        by = f"`make workshop-{e.chapter}`" if f"make workshop-{e.chapter}" in e.text else \
            f"`make exercise-{e.name} ANSWER=...`" if e.right else ""
        lines.append(f"| [{e.name}](../{e.page.relative_to('chapters')}#exercises) | {e.kind} | {e.minutes} | ({e.after}) | {by} |")
    minutes = {kind: sum(e.minutes or 0 for e in every if e.kind == kind) for kind in KINDS}
    lines += ["", "Hours, by kind: " + ", ".join(f"{kind} {minutes[kind] / 60:.0f}" for kind in KINDS) + "."]
    return "\n".join(lines) + "\n"


def write_table():
    TABLE.write_text(table())


def main(name, answer=None):
    exercise = next((e for e in exercises() if e.name == name), None)
    if not exercise:
        sys.exit(f"there is no exercise {name}: see {TABLE}")
    text = re.sub(r"\s*<details>.*", "", exercise.text, flags=re.S)
    if not answer:
        print(f"{exercise.name}, {exercise.kind}, {exercise.minutes} minutes, after ({exercise.after}); "
              f"the answer is in {exercise.page}\n\n   {text}\n")
        if exercise.right:
            print(f'Your answer: make exercise-{name} ANSWER="{" ".join("?" * len(numbers(exercise.right)))}"')
        return
    if not exercise.right:
        sys.exit(f"exercise {name} is not for a program to judge; the answer is in {exercise.page}")
    fault = judge(exercise, answer)
    print(f"{name}: {'not yet: ' + fault if fault else 'yes'}")
