// chapters/book/test_book.mjs -- The book in a browser.      (make test-book)
//
//   node test_book.mjs OUT AXE [WORD]
//
// OUT is what build.py wrote, which has followed every link; AXE the text of axe-core, a
// checker of WCAG's rules, or nothing if it could not be had. With WORD the pages whose
// names have it are looked at, else all.
import { existsSync, readFileSync, readdirSync, statSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import assert from "node:assert/strict";
import vm from "node:vm";
import { open } from "../play/browser.mjs";

const [, , out, axeName, word = ""] = process.argv;
const names = readdirSync(out).filter(name => name.endsWith(".html") && name !== "print.html" && name.includes(word));
const url = name => pathToFileURL(resolve(out, name)).href;
const read = name => readFileSync(`${out}/${name}`, "utf8");
let tests = 0, moving = 0;
async function test(name, body) {
  try {
    await body();
  } catch (error) {
    console.error(`not ok: ${name}`);
    throw error;
  }
  tests++;
}

// ---- without a browser ----

vm.runInThisContext(["assets/texts.js", "assets/search.js"].map(read).join("\n"));
const { search, list, near } = vm.runInThisContext("FVI_SEARCH");

await test("search finds words, their beginnings, and one slip of the pen", () => {
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

await test("the number of an equation leads to it", () => {
  assert.match(list("(4.3)", "../"), /href="\.\.\/04-coefficients\.html#eq-4\.3"/);
  assert.match(list("4.3", ""), /href="04-coefficients\.html#eq-4\.3"/);
});

await test("what is found cannot be markup", () => {
  assert.doesNotMatch(list("<img src=x onerror=alert(1)>", ""), /<img/);
});

await test("a page, packed as a server sends it, with its figures, is below 600 kB", () => {
  for (const name of names) {
    const files = [name, "assets/katex.min.css", "assets/style.css", "assets/head.js", "assets/book.js",
      ...new Set([...read(name).matchAll(/<img src="([^"]*)"/g)].map(match => match[1]))];
    const size = files.reduce((sum, file) => sum + gzipSync(read(file)).length, 0);
    const fonts = readdirSync(`${out}/assets/fonts`).reduce((sum, font) => sum + statSync(`${out}/assets/fonts/${font}`).size, 0);
    assert.ok(size + fonts < 600e3, `${name}: ${size} bytes and ${fonts} of fonts`);
  }
});

// ---- in Chromium ----

const browser = await open();
const { call, evaluate, key } = browser;
const size = (width, height = 900) => call("Emulation.setDeviceMetricsOverride",
  { width, height, deviceScaleFactor: 1, mobile: width < 500 });
const scheme = value => call("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value }] });
const until = text => evaluate(`new Promise((done, failed) => {
  const end = Date.now() + 10000, look = () => (${text}) ? done() : Date.now() > end
    ? failed(new Error(${JSON.stringify(text)})) : setTimeout(look, 20);
  look();
})`);

try {
  await test("no page scrolls sideways, from a phone to a wall", async () => {
    for (const name of names) {
      await size(320);
      await browser.go(url(name));
      for (const width of [320, 800, 1600, 3840]) {
        await size(width);
        const wide = await evaluate("document.documentElement.scrollWidth");
        assert.ok(wide <= width, `${name} at ${width}: ${wide}`);
      }
    }
  });

  await test("a theme lasts over a click, and into the folder of the sources; figures follow it", async () => {
    await size(1600);
    await scheme("light");
    await browser.go(url("04-coefficients.html"));
    assert.equal(await evaluate("getComputedStyle(document.querySelector('main img')).colorScheme"), "light dark");
    await evaluate("document.getElementById('theme').click()");
    for (const next of ["05-integration_by_parts.html", "source/src-memory-coefficients.c.html"]) {
      await browser.go(url(next));
      assert.equal(await evaluate("document.documentElement.dataset.theme"), "dark", next);
    }
    await browser.go(url("04-coefficients.html"));
    assert.equal(await evaluate("getComputedStyle(document.querySelector('main img')).colorScheme"), "dark");
    await evaluate("document.getElementById('theme').click()");
    assert.equal(await evaluate("document.documentElement.dataset.theme"), "light");
  });

  await test("the search field answers, with the keyboard", async () => {
    await browser.go(url("09-fvi.html"));
    await evaluate(`document.getElementById("query").focus()`);
    await call("Input.insertText", { text: "memory exponentials" });
    await until(`document.querySelectorAll("#found a").length > 3`);
    await key("ArrowDown");
    assert.match(await evaluate("document.activeElement.getAttribute('href')"), /\.html/);
    await key("Escape");
    assert.equal(await evaluate("document.getElementById('found').hidden"), true);
  });

  await test("an equation shows itself at its number, from this page and from another", async () => {
    await browser.go(url("07-half_derivative.html"));
    for (const start of ["#eq-7", "04-coefficients.html#eq-4"]) {
      await evaluate(`document.querySelector('main a.eq[href^="${start}"]').focus()`);
      await until(`document.getElementById("preview").hidden === false && document.querySelector("#preview .katex-html")`);
      await key("Escape");
      assert.equal(await evaluate(`document.getElementById("preview").hidden`), true);
      await evaluate("document.activeElement.blur()");
    }
  });

  await test("a copy button takes the code as it stands in the source", async () => {
    await browser.go(url("04-coefficients.html"));
    await evaluate(`navigator.clipboard.writeText = async text => { window.taken = text; }`);
    await evaluate(`document.querySelector(".copied button").click()`);
    await until("window.taken");
    assert.match(await evaluate("window.taken"), /^S = weight_symbolic\(a - 1\)  # the claim/);
  });

  await test("a figure that moves says in the browser what it says in node, and is then as test_live.mjs has it", async () => {
    const scripts = readdirSync(`${out}/live`).sort((a, b) => (b === "kernel.js") - (a === "kernel.js") || (b === "live.js") - (a === "live.js"));
    scripts.forEach(name => vm.runInThisContext(read(`live/${name}`), name));
    const { scenes, open: library, start } = vm.runInThisContext("FVI_LIVE"), kernel = await library(vm.runInThisContext("FVI_WASM"));
    const begun = name => `document.querySelector("[data-live=${name}]").live`;
    for (const page of names)
      for (const [, name] of read(page).matchAll(/data-live="([^"]*)"/g)) {
        await browser.go(url(page));
        await evaluate(`document.querySelector("[data-live=${name}]").scrollIntoView()`);
        await until(begun(name));
        assert.equal(await evaluate(`document.querySelector("[data-live=${name}] img").offsetParent`), null, `${name}: the image is hidden`);
        const scene = scenes.get(name), values = start(scene);
        for (const control of Object.keys(scene.controls)) {
          await evaluate(`(slider => { slider.value = Math.round(0.7 * slider.max); slider.dispatchEvent(new Event("input")); })
            (document.querySelector("[data-live=${name}] input[data-of=${control}]"))`);
          values[control] = await evaluate(`${begun(name)}.values.${control}`);
          assert.notEqual(values[control], start(scene)[control], control);
        }
        const data = scene.compute(values, kernel, scene);
        await until(`document.querySelector("[data-live=${name}] .says").textContent === ${JSON.stringify(scene.says(data, values))}`);
        moving++;
      }
  });

  await test("without scripts a page has its contents, its figures and no dead button", async () => {
    await call("Emulation.setScriptExecutionDisabled", { value: true });
    await size(320);
    await browser.go(url("04-coefficients.html"));
    const { root } = await call("DOM.getDocument", { depth: -1 });
    const visible = async selector => {
      const { nodeId } = await call("DOM.querySelector", { nodeId: root.nodeId, selector });
      return nodeId !== 0 && await call("DOM.getBoxModel", { nodeId }).then(() => true, () => false);
    };
    for (const there of ["#contents a", "main figure img", ".formula", ".turn a"]) assert.ok(await visible(there), there);
    for (const not of ["#menu", "#theme", "#find", "#found"]) assert.ok(!await visible(not), not);
    await call("Emulation.setScriptExecutionDisabled", { value: false });
  });

  assert.deepEqual(browser.complaints, []);

  if (axeName && existsSync(axeName)) await test("axe finds no fault, by day and by night", async () => {
    const axe = readFileSync(axeName, "utf8"), pages = [...names, "source/index.html", "source/src-memory-past.c.html"];
    const options = { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"], resultTypes: ["violations"] };
    const faults = [];
    await size(1280);
    for (const name of pages)
      for (const theme of ["light", "dark"]) {
        await browser.go(url(name));
        await evaluate(`document.documentElement.dataset.theme = "${theme}"`);
        await evaluate(axe);
        const found = await evaluate(`axe.run(document, ${JSON.stringify(options)}).then(({ violations }) =>
          violations.map(({ id, nodes }) => id + ": " + nodes.slice(0, 3).map(node => node.html.slice(0, 120)).join(" | ")))`);
        faults.push(...found.map(fault => `${name}, ${theme}: ${fault}`));
      }
    assert.deepEqual(faults, []);
  });
  else console.log("axe-core is not here: WCAG's rules were not checked");
} finally {
  await browser.close();
}
console.log(`the book: ${tests} tests, ${names.length} pages, ${moving} figures that move`);
