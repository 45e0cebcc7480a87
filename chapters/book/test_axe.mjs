// chapters/book/test_axe.mjs -- WCAG's rules on every page, by axe-core.      (a part of make test-book)
//
// By day all rules are looked at, by night those that a theme can break. Of a formula axe is shown
// what a screen reader is, its MathML: the thousands of boxes that are painted, which took most of
// the time and once all of it, are hidden from one, and have the colour of the text about them.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import assert from "node:assert/strict";

const SOURCES = ["source/index.html", "source/src-memory-past.c.html", "source/chapters-live-live.js.html"];
const RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"];
// preload: axe would ask for the style sheets, which no page from a disk may read.
const OPTIONS = { resultTypes: ["violations"], preload: false };

export async function testAxe({ evaluate, go, scheme, size }, test, { out, names, axe }) {
  const text = readFileSync(axe, "utf8"), faults = [];
  const look = options => evaluate(`Promise.race([axe.run({ include: [["html"]], exclude: [[".katex-html"]] }, ${JSON.stringify({ ...OPTIONS, ...options })}),
    new Promise((_, late) => setTimeout(late, 60000, new Error("axe is not done in a minute")))]).then(({ violations }) =>
    violations.map(({ id, nodes }) => id + " (" + nodes.length + "): " + nodes.slice(0, 3).map(node => node.html.slice(0, 160)).join(" | ")))`);
  const dress = async theme => {
    await scheme(theme); // the live page has no switch
    await evaluate(`document.documentElement.dataset.theme = "${theme}"`);
  };
  await size(1280);
  for (const name of [...names, ...SOURCES, "play/index.html"])
    await test(`axe finds no fault in ${name}, by day and by night`, async () => {
      await go(pathToFileURL(resolve(out, name)).href);
      await dress("light");
      await evaluate(text);
      assert.equal(await evaluate(`document.querySelector('.katex-html:not([aria-hidden]), .katex-html [style*="color"]:not([style*="transparent"]), .katex-html [style*="background"]')`), null);
      for (const fault of await look({ runOnly: RULES })) faults.push(`${name}, light: ${fault}`);
      await dress("dark");
      for (const fault of await look({ runOnly: ["color-contrast", "link-in-text-block"] })) faults.push(`${name}, dark: ${fault}`);
    }, 3);
  assert.deepEqual(faults, []);
}
