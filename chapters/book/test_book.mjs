// chapters/book/test_book.mjs -- The book, in Chromium and in Firefox.      (make test-book)
//
//   node test_book.mjs OUT PROGRAM AXE [WORD]
//
// OUT is what build.py wrote, which has followed every link; PROGRAM is fvi; AXE the text of
// axe-core, a checker of WCAG's rules, which may be missing. With WORD the pages whose names
// have it are looked at, else all. What was left out is said in the last line.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import assert from "node:assert/strict";
import vm from "node:vm";
import { open as chromium } from "./chromium.mjs";
import { open as firefox } from "./firefox.mjs";
import { lookWithAxe } from "./test_axe.mjs";
import { testPages } from "./test_pages.mjs";
import { testServed } from "./test_served.mjs";
import { testSite } from "./test_site.mjs";

const [, , out, program, axeName, word = ""] = process.argv;
const names = readdirSync(out).filter(name => name.endsWith(".html") && name !== "print.html" && name.includes(word));
const MORE = ["source/index.html", "source/src-memory-past.c.html", "source/chapters-live-live.js.html", "play/index.html"];
const TEST_LIVE = fileURLToPath(new URL("../live/test_live.mjs", import.meta.url));
const read = name => readFileSync(`${out}/${name}`, "utf8"), url = name => pathToFileURL(resolve(out, name)).href;
const axe = existsSync(axeName) ? readFileSync(axeName, "utf8") : "";
const leftOut = axe ? [] : ["WCAG's rules, as axe-core is not there"];
const folder = mkdtempSync(join(tmpdir(), "fvi-moves-")), movesName = join(folder, "moves.json");
process.on("exit", () => rmSync(folder, { recursive: true }));
const spent = new Map(); // kind of test -> seconds, in this browser
const failed = [], LATE = "too late";
let tests = 0, where = "node", now = "";
setInterval(() => console.log(`  ${where}: ${tests} tests; now: ${now}`), 60000).unref(); // it takes some minutes

// A test that fails is told, and the others are made; one that hangs ends all: nobody waits for it
// more than so many minutes.
async function test(kind, name, body, minutes = 5) {
  const began = Date.now();
  let clock;
  now = name;
  try {
    await Promise.race([body(), new Promise((_, late) => {
      clock = setTimeout(() => late(new Error(LATE)), 60000 * minutes);
    })]);
  } catch (error) {
    console.error(`not ok in ${where}: ${name}\n${error.message}`);
    failed.push(`${where}: ${name}`);
    if (error.message === LATE) throw error;
  } finally {
    clearTimeout(clock);
  }
  tests++;
  spent.set(kind, (spent.get(kind) ?? 0) + (Date.now() - began) / 1000);
}
function sayTimes() {
  console.log(`  ${where}, seconds: ${[...spent].map(([kind, time]) => `${kind} ${Math.round(time)}`).join(", ")}`);
  spent.clear();
}

// ---- without a browser ----

// What figures compute, against fvi: writes down where they were moved, or compares what a browser shows there.
const compare = () => execFileSync("node", [TEST_LIVE, out, program, movesName], { stdio: "inherit", timeout: 300000 });
await test("figures", "the figures that move have the program's numbers, in node", compare);

vm.runInThisContext(["assets/texts.js", "assets/search.js"].map(read).join("\n"));
const { search, list, near } = vm.runInThisContext("FVI_SEARCH");

await test("search", "search finds words, their beginnings, and one slip of the pen", async () => {
  assert.ok(near("solutoin", "solution") && near("weihgts", "weights") && near("wieght", "weight"));
  assert.ok(near("stablity", "stability") && near("stabillity", "stability") && !near("stable", "memory"));
  assert.ok(search("solutoin").length > 0);
  const first = question => search(question)[0]?.u ?? "nothing";
  assert.match(first("rounding stability"), /^h14-/);
  assert.match(first("errata"), /^h16-/);
  // What a visitor types leads to a chapter or to the manual, and not to a source; where no section has all words, to those with some.
  for (const [question, page] of [["springpot", /^(h00|01)-/], ["python", /^python/], ["checkpoint", /^manual/], ["install", /^(manual|index|python)/],
    ["stability", /^(h14|10)-/], ["event", /^manual/], ["damper", /^(h27|h29|manual)/], ["lagrangian", /^(h29|manual)/], ["how do I install it on windows", /^(manual|index|python)/], ["springpot zzzz", /^(h00|01)-/]])
    assert.match(first(question), page, question);
  assert.ok(search("coefficients.c").some(place => place.u === "source/src-memory-coefficients.c.html"));
  assert.ok(search("expon").length >= search("exponential").length);
  assert.ok(search("zzzz").length === 0 && list("zzzz", "").includes("Nothing found"));
});

await test("search", "the number of an equation leads to it", async () => {
  assert.match(list("(4.3)", "../"), /href="\.\.\/h04-coefficients\.html#eq-4\.3"/);
  assert.match(list("4.3", ""), /href="h04-coefficients\.html#eq-4\.3"/);
});

await test("search", "what is found cannot be markup", async () => {
  assert.doesNotMatch(list("<img src=x onerror=alert(1)>", ""), /<img/);
});
sayTimes();

// ---- in the browsers ----

let moving = 0;
for (const open of [chromium, firefox]) {
  let browser;
  try {
    browser = await open();
  } catch (error) {
    leftOut.push(error.message);
    continue;
  }
  where = browser.name;
  browser.until = text => browser.evaluate(`new Promise((done, failed) => {
    const end = Date.now() + 30000, look = () => (${text}) ? done() : Date.now() > end
      ? failed(new Error(${JSON.stringify(text)})) : setTimeout(look, 20);
    look();
  })`);
  const isChromium = where === "Chromium", moves = JSON.parse(readFileSync(movesName, "utf8")).map(({ name, values }) => ({ name, values }));
  try {
    moving += await testPages(browser, test, { names, url, read, moves, axe: isChromium && axe });
    if (names.length > 30) await test("figures", "figures that move show the numbers of the program", () => {
      writeFileSync(movesName, JSON.stringify(moves));
      compare();
    });
    await testSite(browser, test, { out, url });
    if (isChromium) await testServed(browser, test, { out, names }); // a headless Firefox tells no first paint
    for (const name of isChromium && axe ? MORE : [])
      await test("axe", `axe finds no fault in ${name}, by day and by night`, async () => {
        await browser.go(url(name));
        await lookWithAxe(browser, axe);
      });
    const own = /^request: http:\/\/127\.0\.0\.1:/; // testServed's
    await test("site", "no word on the console, no request", async () => assert.deepEqual((await browser.complaints()).filter(complaint => !own.test(complaint)), []));
  } finally {
    await browser.close();
  }
  sayTimes();
}
assert.ok(moving > 0 || word || leftOut.length > 1, "no figure has moved");
console.log(`the book: ${tests} tests, ${names.length} pages, ${moving} figures moved${leftOut.length ? `; left out: ${leftOut.join(", ")}` : ""}`);
if (failed.length) {
  console.error(`not ok: ${failed.length}\n${failed.join("\n")}`);
  process.exit(1);
}
