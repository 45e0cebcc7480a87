// chapters/book/test_axe.mjs -- WCAG's rules on every page, by axe-core.      (a part of make test-book)
//
// By day all rules are looked at, by night those that a theme can break. A long chapter takes axe
// four seconds of the processor each time, whatever it is asked, and minutes where many work.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import assert from "node:assert/strict";

const SOURCES = ["source/index.html", "source/src-memory-past.c.html", "source/chapters-live-live.js.html"];
const RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"];
// preload: axe would ask for the style sheets, which no page from a disk may read.
const OPTIONS = { resultTypes: ["violations"], preload: false };

export async function testAxe({ evaluate, go, scheme, size }, test, { out, names, axe }) {
  const text = readFileSync(axe, "utf8");
  const look = options => evaluate(`axe.run(document, ${JSON.stringify({ ...OPTIONS, ...options })}).then(({ violations }) =>
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
      const light = await look({ runOnly: RULES });
      await dress("dark");
      const dark = await look({ runOnly: ["color-contrast", "link-in-text-block"] });
      assert.deepEqual([light, dark], [[], []]);
    });
}
