// chapters/book/test_pdf.mjs -- The book on paper.      node test_pdf.mjs OUT      (a part of make pdf)
//
// By poppler's tools: pages, running heads, the numbers in the contents, bookmarks, answers.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import assert from "node:assert/strict";

const out = process.argv[2], book = `${out}/fvi.pdf`;
const ask = (tool, ...words) => execFileSync(tool, words, { encoding: "utf8", maxBuffer: 1 << 28 });
const pages = ask("pdftotext", "-layout", book, "-").split("\f").slice(0, -1);
const html = readFileSync(`${out}/print.html`, "utf8");
// What a chapter's title begins with: its number, or the title of a page that has none.
const chapters = [...html.matchAll(/<article class="c(H?)(\d*)\w*"><h1 id="([^"]*)"[^>]*>([^<]*)/g)]
  .map(([, of, number, name, title]) => ({ head: number ? `${of ? "H " : ""}${number}. ` : title.trim(), name }));
const at = Object.fromEntries(ask("pdfinfo", "-dests", book).split("\n").map(line => /^\s*(\d+) \[.*\] "(.*)"$/.exec(line))
  .filter(Boolean).map(([, page, place]) => [place, Number(page)]));
let tests = 0;
function test(name, body) {
  try {
    body();
  } catch (error) {
    console.error(`not ok: ${name}`);
    throw error;
  }
  tests++;
}

test("every page but the cover has its number at its foot", () => {
  pages.slice(1).forEach((text, i) => assert.equal(text.trimEnd().split("\n").at(-1).trim(), String(i + 2)));
});

test("the cover says whose method it is, the version, the day, and from what it is made", () => {
  for (const words of [/Fernando Jiménez and Sina Ober-Blöbaum/, /Version \d+\.\d+\.\d+, \d+ [A-Z]\w+ 20\d\d/, /make pdf/]) assert.match(pages[0].replace(/\s+/g, " "), words);
});

test("symbols, glossary and one bibliography are on paper", () => {
  for (const name of ["symbols", "glossary", "bibliography"]) assert.equal(chapters.filter(chapter => chapter.name === name).length, 1, name);
});

test("the head of a page is the title of its chapter", () => {
  assert.ok(chapters.length > 26);
  chapters.forEach(({ head, name }, i) => {
    const end = i + 1 < chapters.length ? at[chapters[i + 1].name] : pages.length + 1;
    for (let page = at[name]; page < end; page++)
      assert.ok(pages[page - 1].trimStart().startsWith(head), `page ${page}, ${name}: ${pages[page - 1].trimStart().slice(0, 40)}`);
  });
});

test("the contents name the pages on which chapters begin", () => {
  const contents = pages.slice(1, at[chapters[0].name] - 1).join("\n");
  for (const { head, name } of chapters)
    assert.match(contents, new RegExp(`${head.replace(".", "\\.")}[^\\n]*?${at[name]}\\b`), `${name} on page ${at[name]}`);
});

test("no word stands in a margin, and nothing of the screen is on paper", () => {
  const mm = 72 / 25.4, left = 20 * mm, right = (210 - 20) * mm;
  ask("pdftotext", "-bbox", book, "-").split("<page ").slice(1).forEach((page, i) => {
    for (const [, from, to, word] of page.matchAll(/<word xMin="([-\d.]+)" yMin="[-\d.]+" xMax="([-\d.]+)"[^>]*>(.*)<\/word>/g))
      assert.ok(Number(from) > left - 2 && Number(to) < right + 2, `page ${i + 1}: ${word} from ${from} to ${to}`);
  });
  pages.forEach((text, i) => assert.doesNotMatch(text, /[\u25b6\u25b8]|^\s*(Copy|Previous: .*)$/m, `page ${i + 1}`)); // a fold, a button
});

test("each chapter has a bookmark that leads to it", () => {
  const marks = JSON.parse(ask("qpdf", "--json", "--json-key=outlines", book)).outlines.map(mark => mark.destpageposfrom1);
  for (const { name } of chapters) assert.ok(marks.includes(at[name]), name);
});

test("answers stand behind the exercises", () => {
  for (const { head, name } of chapters.filter(({ head }) => head.startsWith("H "))) { // the Course's stand there, too
    const exercises = html.indexOf(`id="${name}--exercises"`), answers = html.indexOf(`id="${name}--answers"`);
    assert.ok(exercises < 0 || answers > exercises, head + name);
  }
  assert.doesNotMatch(html, /<summary>Answer<\/summary>/);
});

console.log(`the book on paper: ${tests} tests, ${pages.length} pages`);
