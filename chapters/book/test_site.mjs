// chapters/book/test_site.mjs -- What the pages share, in one browser: theme, search, previews.      (a part of make test-book)
import { mkdtempSync, readFileSync, readdirSync, rmSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import assert from "node:assert/strict";

export async function testSite({ evaluate, go, key, name: browser, scheme, scripts, size, type, until }, test, { out, url }) {
  await test("site", "a theme lasts over a click, and into the folder of the sources; figures follow it", async () => {
    await size(1600);
    await scheme("light");
    await go(url("h04-coefficients.html"));
    assert.equal(await evaluate("getComputedStyle(document.querySelector('main img')).colorScheme"), "light dark");
    const ground = () => evaluate("getComputedStyle(document.body).backgroundColor"), light = await ground();
    await evaluate("document.getElementById('theme').click()");
    for (const next of ["h05-integration_by_parts.html", "source/src-memory-coefficients.c.html"]) {
      await go(url(next));
      assert.equal(await evaluate("document.documentElement.dataset.theme"), "dark", next);
      assert.notEqual(await ground(), light);
    }
    await go(url("h04-coefficients.html"));
    assert.equal(await evaluate("getComputedStyle(document.querySelector('main img')).colorScheme"), "dark");
    await evaluate("document.getElementById('theme').click()");
    assert.equal(await evaluate("document.documentElement.dataset.theme"), "light");
    assert.equal(await ground(), light);
  });

  // A line of letters is up to 3.2 pixels higher than they are, as Chromium measures it.
  if (browser === "Chromium") await test("site", "no word of a figure is cut by its edge", async () => {
    await go(url("h04-coefficients.html"));
    for (const name of readdirSync(join(out, "figures"))) {
      const svg = readFileSync(join(out, "figures", name), "utf8").replace(/^[^]*?(?=<svg)/, "");
      assert.deepEqual(await evaluate(`(() => {
        const main = document.querySelector("main");
        main.innerHTML = ${JSON.stringify(svg)};
        const svg = main.querySelector("svg"), scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width, edge = svg.getBoundingClientRect();
        return [...svg.querySelectorAll("text")].filter(text => {
          const { left, right, top, bottom } = text.getBoundingClientRect();
          return text.textContent.trim() && Math.min(left - edge.left, edge.right - right, top - edge.top, edge.bottom - bottom) < -3.3 * scale;
        }).map(text => text.textContent);
      })()`), [], name);
    }
  });

  await test("site", "the search field answers, with the keyboard", async () => {
    await go(url("h09-fvi.html"));
    await evaluate(`document.getElementById("query").focus()`);
    await type("memory exponentials");
    await until(`document.querySelectorAll("#found a").length > 3`);
    await key("ArrowDown");
    assert.match(await evaluate("document.activeElement.getAttribute('href')"), /\.html/);
    await key("Escape");
    assert.equal(await evaluate("document.getElementById('found').hidden"), true);
  });

  await test("site", "an equation shows itself at its number, from this page and from another", async () => {
    await go(url("h07-half_derivative.html"));
    for (const start of ["#eq-7", "h04-coefficients.html#eq-4"]) {
      await evaluate(`document.querySelector('main a.eq[href^="${start}"]').focus()`);
      await until(`document.getElementById("preview").hidden === false && document.querySelector("#preview .katex-html")`);
      await key("Escape");
      assert.equal(await evaluate(`document.getElementById("preview").hidden`), true);
      await evaluate("document.activeElement.blur()");
    }
  });

  await test("site", "a copy button takes the code as it stands in the source", async () => {
    await go(url("h04-coefficients.html"));
    await evaluate(`navigator.clipboard.writeText = async text => { window.taken = text; }, 0`);
    await evaluate(`document.querySelector(".copied button").click()`);
    await until("window.taken");
    assert.match(await evaluate("window.taken"), /^w\[0\] = 1;\n/);
  });

  await test("site", "without scripts a page has its contents, its figures and no dead button", async () => {
    await scripts(false);
    await size(320);
    await go(url("h04-coefficients.html"));
    const visible = async selector => evaluate(`(e => e !== null && e.getClientRects().length > 0)(document.querySelector("${selector}"))`);
    assert.equal(await evaluate(`document.documentElement.className`), "", "scripts are off");
    for (const there of ["#contents a", "main figure img", ".formula", ".turn a"]) assert.ok(await visible(there), there);
    for (const not of ["#menu", "#theme", "#find", "#found"]) assert.ok(!await visible(not), not);
    await scripts(true);
  });

  await test("site", "the folder may be moved", async () => {
    const there = mkdtempSync(join(tmpdir(), "fvi moved é-"));
    try {
      symlinkSync(resolve(out), join(there, "a book"));
      await size(1600);
      for (const name of ["source/src-memory-coefficients.c.html", "h04-coefficients.html"])
        await go(pathToFileURL(join(there, "a book", name)).href);
      await evaluate(`document.querySelector("[data-live]").scrollIntoView()`);
      await until(`document.querySelector("[data-live]").live`);
      await evaluate(`document.getElementById("query").focus()`);
      await type("kernel");
      await until(`document.querySelectorAll("#found a").length > 3`);
      assert.ok(await evaluate(`[...document.images].every(image => image.naturalWidth > 0)`));
      assert.equal(await evaluate(`getComputedStyle(document.querySelector(".bar")).position`), "sticky");
    } finally {
      rmSync(there, { recursive: true });
    }
  });
}
