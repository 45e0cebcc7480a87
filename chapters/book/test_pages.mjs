// chapters/book/test_pages.mjs -- The pages from the disk, in one browser.      (a part of make test-book)
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import assert from "node:assert/strict";

const WIDTHS = [320, 800, 1600, 3840];

// Run in the page: what is beyond the column and does not scroll, cut in height, or on top of its neighbour.
function misplaced() {
  const out = [], say = (what, e) => out.push(`${what}: ${e.outerHTML.replace(/\s+/g, " ").slice(0, 90)}`);
  const main = document.querySelector("main").getBoundingClientRect();
  const seen = e => e.getClientRects().length > 0 && getComputedStyle(e).visibility !== "hidden";
  // of a formula in the text, the parts between which it may break
  for (const e of document.querySelectorAll("main :is(:not(.katex *, .anchor), .katex-html > .base):not(:is(.scroll, .formula, pre) *)")) {
    if (!seen(e)) continue;
    const { left, right, width } = e.getBoundingClientRect();
    if (width > 0 && (right > main.right + 1 || left < main.left - 1)) say("beyond the column", e);
  }
  for (const e of document.querySelectorAll("main .scroll, main pre"))
    if (e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).overflowX !== "auto") say("cut at the right", e);
  for (const e of document.querySelectorAll("main .formula"))
    if (e.scrollHeight > e.clientHeight + 2) say(`cut by ${e.scrollHeight - e.clientHeight} in height`, e);
  const over = (a, b, slack) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > slack && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > slack;
  const inFlow = e => {
    const { position, float, display } = getComputedStyle(e);
    return seen(e) && !/absolute|fixed|sticky/.test(position) && float === "none" && !display.startsWith("inline");
  };
  for (const parent of document.querySelectorAll("body, main, article, .bar, .live, .live *, figure, li, dd, td, th, details, blockquote, .turn, #contents, #contents ol")) {
    const boxes = [...parent.children].filter(inFlow).map(e => [e, e.getBoundingClientRect()]);
    boxes.slice(1).forEach(([e, box], i) => over(boxes[i][1], box, 1.5) && say("on top of its neighbour", e));
  }
  for (const html of document.querySelectorAll(".formula .katex-display > .katex > .katex-html")) {
    const tag = html.querySelector(":scope > .tag")?.getBoundingClientRect();
    if (tag) for (const base of html.querySelectorAll(":scope > .base")) if (over(base.getBoundingClientRect(), tag, 2)) say("under its number", html);
  }
  return out;
}

const TEST_LIVE = fileURLToPath(new URL("../live/test_live.mjs", import.meta.url));

export async function testPages({ evaluate, go, key, scheme, scripts, size, type }, test, { out, program, names, read }) {
  const url = name => pathToFileURL(resolve(out, name)).href;
  const until = text => evaluate(`new Promise((done, failed) => {
    const end = Date.now() + 30000, look = () => (${text}) ? done() : Date.now() > end
      ? failed(new Error(${JSON.stringify(text)})) : setTimeout(look, 20);
    look();
  })`);
  const figures = page => [...read(page).matchAll(/data-live="([^"]*)"/g)].map(match => match[1]);
  const figure = name => `document.querySelector('[data-live="${name}"]')`;
  const begin = async name => {
    await evaluate(`${figure(name)}.scrollIntoView()`);
    await until(`${figure(name)}.live`);
  };
  let moved = 0;

  for (const name of names)
    await test(`${name} does not scroll sideways, cuts no table or formula, puts nothing on another, from a phone to a wall`, async () => {
      const faults = [];
      await size(WIDTHS[0]);
      await go(url(name));
      for (const live of figures(name)) await begin(live);
      await evaluate(`document.querySelectorAll("details").forEach(one => { one.open = true; }), document.fonts.ready.then(() => 0)`);
      for (const width of WIDTHS) {
        await size(width);
        const wide = await evaluate("document.documentElement.scrollWidth");
        if (wide > width) faults.push(`at ${width}: ${wide} wide`);
        faults.push(...(await evaluate(`(${misplaced})()`)).map(fault => `at ${width}: ${fault}`));
      }
      assert.ok(faults.length === 0, faults.join("\n"));
    });

  await test("a theme lasts over a click, and into the folder of the sources; figures follow it", async () => {
    await size(1600);
    await scheme("light");
    await go(url("04-coefficients.html"));
    assert.equal(await evaluate("getComputedStyle(document.querySelector('main img')).colorScheme"), "light dark");
    const ground = () => evaluate("getComputedStyle(document.body).backgroundColor"), light = await ground();
    await evaluate("document.getElementById('theme').click()");
    for (const next of ["05-integration_by_parts.html", "source/src-memory-coefficients.c.html"]) {
      await go(url(next));
      assert.equal(await evaluate("document.documentElement.dataset.theme"), "dark", next);
      assert.notEqual(await ground(), light);
    }
    await go(url("04-coefficients.html"));
    assert.equal(await evaluate("getComputedStyle(document.querySelector('main img')).colorScheme"), "dark");
    await evaluate("document.getElementById('theme').click()");
    assert.equal(await evaluate("document.documentElement.dataset.theme"), "light");
    assert.equal(await ground(), light);
  });

  await test("the search field answers, with the keyboard", async () => {
    await go(url("09-fvi.html"));
    await evaluate(`document.getElementById("query").focus()`);
    await type("memory exponentials");
    await until(`document.querySelectorAll("#found a").length > 3`);
    await key("ArrowDown");
    assert.match(await evaluate("document.activeElement.getAttribute('href')"), /\.html/);
    await key("Escape");
    assert.equal(await evaluate("document.getElementById('found').hidden"), true);
  });

  await test("an equation shows itself at its number, from this page and from another", async () => {
    await go(url("07-half_derivative.html"));
    for (const start of ["#eq-7", "04-coefficients.html#eq-4"]) {
      await evaluate(`document.querySelector('main a.eq[href^="${start}"]').focus()`);
      await until(`document.getElementById("preview").hidden === false && document.querySelector("#preview .katex-html")`);
      await key("Escape");
      assert.equal(await evaluate(`document.getElementById("preview").hidden`), true);
      await evaluate("document.activeElement.blur()");
    }
  });

  await test("a copy button takes the code as it stands in the source", async () => {
    await go(url("04-coefficients.html"));
    await evaluate(`navigator.clipboard.writeText = async text => { window.taken = text; }, 0`);
    await evaluate(`document.querySelector(".copied button").click()`);
    await until("window.taken");
    assert.match(await evaluate("window.taken"), /^S = weight_symbolic\(a - 1\)  # the claim/);
  });

  await test("a slider moves a figure, and the picture is hidden behind it", async () => {
    for (const page of names)
      for (const name of figures(page)) {
        await go(url(page));
        await begin(name);
        assert.equal(await evaluate(`${figure(name)}.querySelector("img").offsetParent`), null, `${name}: the image is hidden`);
        for (const control of await evaluate(`[...${figure(name)}.querySelectorAll("input[data-of]")].map(slider => slider.dataset.of)`)) {
          const before = await evaluate(`${figure(name)}.live.values.${control}`);
          await evaluate(`(slider => { slider.value = Math.round(0.7 * slider.max) - (slider.value > 0.6 * slider.max ? Math.ceil(slider.max / 3) : 0);
            slider.dispatchEvent(new Event("input")); })(${figure(name)}.querySelector("input[data-of=${control}]"))`);
          assert.notEqual(await evaluate(`${figure(name)}.live.values.${control}`), before, `${name}, ${control}`);
        }
      }
  });

  // test_live.mjs compares what figures compute in node with fvi, and writes down where it
  // moved them; they are moved there here, and it compares the numbers that they then show.
  await test("a figure that moves shows the numbers of the program", async () => {
    const folder = mkdtempSync(join(tmpdir(), "fvi-moves-")), file = join(folder, "moves.json");
    const ask = () => execFileSync("node", [TEST_LIVE, out, program, file], { stdio: ["ignore", "ignore", "inherit"] });
    try {
      ask();
      const moves = JSON.parse(readFileSync(file, "utf8"));
      for (const page of names)
        for (const name of figures(page)) {
          await go(url(page));
          await begin(name);
          const says = new Set();
          for (const move of moves.filter(move => move.name === name)) {
            await evaluate(`(figure => {
              const { values, moved } = figure.live;
              for (const name of Object.keys(values)) delete values[name];
              Object.assign(values, ${JSON.stringify(move.values)});
              figure.live = null;
              moved();
            })(${figure(name)})`);
            await until(`${figure(name)}.live`);
            move.data = await evaluate(`JSON.parse(JSON.stringify(${figure(name)}.live.data, (_, v) => ArrayBuffer.isView(v) ? [...v] : v))`);
            move.said = await evaluate(`${figure(name)}.querySelector(".says").textContent`);
            says.add(move.said);
          }
          assert.ok(says.size > 1, `${name} is moved, and says so`);
          moved++;
        }
      if (names.length > 30) {
        writeFileSync(file, JSON.stringify(moves));
        ask();
      }
    } finally {
      rmSync(folder, { recursive: true });
    }
  });

  await test("without scripts a page has its contents, its figures and no dead button", async () => {
    await scripts(false);
    await size(320);
    await go(url("04-coefficients.html"));
    const visible = async selector => evaluate(`(e => e !== null && e.getClientRects().length > 0)(document.querySelector("${selector}"))`);
    assert.equal(await evaluate(`document.documentElement.className`), "", "scripts are off");
    for (const there of ["#contents a", "main figure img", ".formula", ".turn a"]) assert.ok(await visible(there), there);
    for (const not of ["#menu", "#theme", "#find", "#found"]) assert.ok(!await visible(not), not);
    await scripts(true);
  });

  await test("the folder may be moved", async () => {
    const there = mkdtempSync(join(tmpdir(), "fvi moved é-"));
    try {
      symlinkSync(resolve(out), join(there, "a book"));
      await size(1600);
      for (const name of ["source/src-memory-coefficients.c.html", "04-coefficients.html"])
        await go(pathToFileURL(join(there, "a book", name)).href);
      await begin("coefficients_weights");
      await evaluate(`document.getElementById("query").focus()`);
      await type("kernel");
      await until(`document.querySelectorAll("#found a").length > 3`);
      assert.ok(await evaluate(`[...document.images].every(image => image.naturalWidth > 0)`));
      assert.equal(await evaluate(`getComputedStyle(document.querySelector(".bar")).position`), "sticky");
    } finally {
      rmSync(there, { recursive: true });
    }
  });

  return moved;
}
