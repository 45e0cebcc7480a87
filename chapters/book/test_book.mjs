// chapters/book/test_book.mjs -- The book, in Chromium and in Firefox.      (make test-book)
//
//   node test_book.mjs OUT PROGRAM AXE [WORD]
//
// OUT is what build.py wrote, which has followed every link; PROGRAM is fvi; AXE the text of
// axe-core, a checker of WCAG's rules, which may be missing. With WORD the pages whose names
// have it are looked at, else all. What was left out is said in the last line.
import { existsSync, readFileSync, readdirSync } from "node:fs";
import assert from "node:assert/strict";
import vm from "node:vm";
import { open as chromium } from "./chromium.mjs";
import { open as firefox } from "./firefox.mjs";
import { testAxe } from "./test_axe.mjs";
import { testPages } from "./test_pages.mjs";
import { testServed } from "./test_served.mjs";

const [, , out, program, axe, word = ""] = process.argv;
const names = readdirSync(out).filter(name => name.endsWith(".html") && name !== "print.html" && name.includes(word));
const read = name => readFileSync(`${out}/${name}`, "utf8");
const leftOut = [];
let tests = 0, where = "node";

// A test that hangs is a fault too: nobody waits for it more than so many minutes.
async function test(name, body, minutes = 10) {
  const began = Date.now();
  let clock;
  try {
    await Promise.race([body(), new Promise((_, late) => {
      clock = setTimeout(() => late(new Error(`not done in ${minutes} minutes`)), 60000 * minutes);
    })]);
  } catch (error) {
    console.error(`not ok in ${where}: ${name}`);
    throw error;
  } finally {
    clearTimeout(clock);
  }
  tests++;
  if (Date.now() - began > 5000) console.log(`  ${where}: ${name}, ${Math.round((Date.now() - began) / 1000)} s`);
}

// ---- without a browser ----

vm.runInThisContext(["assets/texts.js", "assets/search.js"].map(read).join("\n"));
const { search, list, near } = vm.runInThisContext("FVI_SEARCH");

await test("search finds words, their beginnings, and one slip of the pen", async () => {
  assert.ok(near("solutoin", "solution") && near("weihgts", "weights") && near("wieght", "weight"));
  assert.ok(near("stablity", "stability") && near("stabillity", "stability") && !near("stable", "memory"));
  assert.ok(search("solutoin").length > 0);
  const first = question => search(question)[0]?.u ?? "nothing";
  assert.match(first("rounding stability"), /^14-/);
  assert.match(first("errata"), /^16-/);
  assert.match(first("fvi_restricted_slopes coefficients.c"), /nothing/);
  assert.ok(search("coefficients.c").some(place => place.u === "source/src-memory-coefficients.c.html"));
  assert.ok(search("expon").length >= search("exponential").length);
  assert.ok(search("zzzz").length === 0 && list("zzzz", "").includes("Nothing found"));
});

await test("the number of an equation leads to it", async () => {
  assert.match(list("(4.3)", "../"), /href="\.\.\/04-coefficients\.html#eq-4\.3"/);
  assert.match(list("4.3", ""), /href="04-coefficients\.html#eq-4\.3"/);
});

await test("what is found cannot be markup", async () => {
  assert.doesNotMatch(list("<img src=x onerror=alert(1)>", ""), /<img/);
});

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
  try {
    moving += await testPages(browser, test, { out, program, names, read });
    if (where === "Chromium") await testServed(browser, test, { out, names }); // a headless Firefox tells no first paint
    if (!existsSync(axe)) leftOut.push(`axe-core is not there for ${where}`);
    else if (where === "Chromium") await testAxe(browser, test, { out, names, axe });
    const own = /^request: http:\/\/127\.0\.0\.1:/; // testServed's
    assert.deepEqual((await browser.complaints()).filter(complaint => !own.test(complaint)), []);
  } finally {
    await browser.close();
  }
}
assert.ok(moving > 0 || word || leftOut.length > 1, "no figure has moved");
console.log(`the book: ${tests} tests, ${names.length} pages, ${moving} figures moved${leftOut.length ? `; left out: ${leftOut.join(", ")}` : ""}`);
