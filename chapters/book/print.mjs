// chapters/book/print.mjs -- The book as a PDF.      node print.mjs OUT      (make pdf)
//
// Chromium prints OUT/print.html; pdfinfo says on which page each place of the contents has
// come to stand; these numbers are written into the contents, and it is printed again, until
// they no longer change. qpdf packs what came out. A formula, a table or code that is wider than
// the line is set smaller, and ends the build if a third less is not enough.
import { execFileSync } from "node:child_process";
import { closeSync, openSync, rmSync, statSync, writeSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { open } from "../play/browser.mjs";

const out = process.argv[2], raw = `${out}/print.pdf`, book = `${out}/fvi.pdf`;
const browser = await open();

async function print(last) {
  const { stream } = await browser.call("Page.printToPDF", { preferCSSPageSize: true, printBackground: true,
    generateDocumentOutline: last, generateTaggedPDF: last, transferMode: "ReturnAsStream" });
  const file = openSync(raw, "w");
  for (let eof = false; !eof;) {
    const part = await browser.call("IO.read", { handle: stream, size: 1 << 20 });
    writeSync(file, Buffer.from(part.data, part.base64Encoded ? "base64" : "utf8"));
    eof = part.eof;
  }
  closeSync(file);
  await browser.call("IO.close", { handle: stream });
}

// Place -> page, of each place that a link leads to.
function places() {
  const lines = execFileSync("pdfinfo", ["-dests", raw], { encoding: "utf8", maxBuffer: 1 << 26 }).split("\n");
  return Object.fromEntries(lines.map(line => /^\s*(\d+) \[.*\] "(.*)"$/.exec(line)).filter(Boolean)
    .map(([, page, place]) => [place, Number(page)]));
}

// Runs in the page: makes fit what is too wide; returns what cannot, and the words that a table breaks.
function fit() {
  const bad = [];
  for (const box of document.querySelectorAll(".formula, .scroll, pre")) {
    const part = box.querySelector(".katex-html, table, code") ?? box, whole = parseFloat(getComputedStyle(part).fontSize);
    const room = box.clientWidth - parseFloat(getComputedStyle(box).paddingRight);
    const right = () => Math.max(...[part, ...part.querySelectorAll(".base, .tag")].map(e => e.getBoundingClientRect().right))
      - box.getBoundingClientRect().left;
    const fits = least => {
      for (let share = 1; share > least - 0.01; share -= 0.05) {
        part.style.fontSize = `${whole * share}px`;
        if (right() <= room + 1) return true;
      }
      return false;
    };
    box.classList.add("unbroken"); // better a little smaller than in two lines
    if (fits(part.className === "table" ? 0.68 : 0.75)) continue;
    box.classList.remove("unbroken");
    if (part.className == "table" || !fits(0.65)) bad.push(box.textContent.slice(0, 60));
  }
  for (const code of document.querySelectorAll("pre")) // a quarter of a page at most is not divided
    if (code.clientHeight < 240) code.style.breakInside = "avoid";
  for (const cell of document.querySelectorAll("td, th")) {
    const texts = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT), range = document.createRange();
    for (let text = texts.nextNode(); text; text = texts.nextNode())
      for (const { 0: word, index } of text.parentElement.closest(".katex") ? [] : text.data.matchAll(/[\p{L}\p{N}]+/gu)) {
        range.setStart(text, index);
        range.setEnd(text, index + word.length);
        if (new Set([...range.getClientRects()].map(box => Math.round(box.top))).size > 1) bad.push(`${word} in: ${cell.textContent.slice(0, 40)}`);
      }
  }
  return bad;
}

try {
  // 170 mm at 96 dpi
  await browser.call("Emulation.setDeviceMetricsOverride", { width: 643, height: 900, deviceScaleFactor: 1, mobile: false });
  await browser.call("Emulation.setEmulatedMedia", { media: "print" });
  await browser.go(pathToFileURL(resolve(out, "print.html")).href);
  await browser.evaluate("document.fonts.ready.then(() => 0)");
  const bad = await browser.evaluate(`(${fit})()`);
  if (bad.length) throw new Error(`wider than the line: ${bad.join(" | ")}`);
  await browser.call("Emulation.setEmulatedMedia", { media: "" });
  const wanted = await browser.evaluate(`[...document.querySelectorAll(".toc a")].map(a => a.getAttribute("href").slice(1))`);
  let numbers = [], pass = 0;
  for (let stable = false; !stable; pass++) {
    if (pass === 4) throw new Error("the page numbers do not settle");
    await print(pass > 0);
    const at = places(), now = wanted.map(place => at[place]);
    if (now.includes(undefined)) throw new Error(`no page for ${wanted[now.indexOf(undefined)]}`);
    stable = pass > 0 && now.every((page, i) => page === numbers[i]);
    numbers = now;
    await browser.evaluate(`document.querySelectorAll(".toc .page").forEach((e, i) => { e.textContent = ${JSON.stringify(now)}[i]; })`);
  }
  execFileSync("qpdf", ["--object-streams=generate", "--recompress-flate", "--compression-level=9", raw, book]);
  rmSync(raw);
  const pages = /Pages:\s+(\d+)/.exec(execFileSync("pdfinfo", [book], { encoding: "utf8" }))[1];
  console.log(`${book}: ${pages} pages, ${(statSync(book).size / 1e6).toFixed(2)} MB, printed ${pass} times`);
} finally {
  await browser.close();
}
