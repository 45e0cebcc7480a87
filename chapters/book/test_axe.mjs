// chapters/book/test_axe.mjs -- WCAG's rules, by axe-core.      (a part of make test-book)
//
// By day all rules are looked at, by night those that a theme can break. axe would spend three
// quarters of its time on the parts of formulas: that these have the colour of the text around
// them, and no role, link or stop of their own, is seen here; then each formula is made one piece.
import assert from "node:assert/strict";

const RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"];
// preload: axe would ask for the style sheets, which no page from a disk may read.
const OPTIONS = { resultTypes: ["violations"], preload: false };

// Run in the page: formulas of another colour than their text, but for room left free; or that are more than text.
function strangeFormulas() {
  const colour = e => getComputedStyle(e).color, free = "rgba(0, 0, 0, 0)";
  return [...document.querySelectorAll(".katex")].filter(formula => {
    const text = colour(formula.parentElement), shown = formula.querySelector(".katex-html");
    return shown?.getAttribute("aria-hidden") !== "true" || [...shown.querySelectorAll("*")].some(e => ![text, free].includes(colour(e)))
      || formula.querySelector(":is([role], [tabindex], [href], a, img)");
  }).map(formula => `not of text alone: ${formula.textContent}`);
}
// Run in the page: takes the parts of formulas out; what held them keeps its words and its size.
function joinFormulas() {
  const shown = [...document.querySelectorAll(".katex-html")], boxes = shown.map(html => html.getBoundingClientRect());
  shown.forEach((html, i) => {
    html.replaceChildren();
    html.style.cssText = `display: inline-block; width: ${boxes[i].width}px; height: ${boxes[i].height}px`;
  });
  for (const read of document.querySelectorAll(".katex-mathml")) read.textContent = read.textContent;
  scrollTo(0, 0); // nothing is behind the bar
}

// The page that is open. axe: the text of axe-core.
export async function lookWithAxe({ evaluate, scheme, size }, axe) {
  const look = options => evaluate(`axe.run(document, ${JSON.stringify({ ...OPTIONS, ...options })}).then(({ violations }) =>
    violations.map(({ id, nodes }) => id + " (" + nodes.length + "): " + nodes.slice(0, 3).map(node => node.html.slice(0, 160)).join(" | ")))`);
  const found = [];
  await size(1280);
  for (const theme of ["dark", "light"]) {
    await dress(theme);
    found.push(...await evaluate(`(${strangeFormulas})()`));
  }
  await evaluate(`(${joinFormulas})()`);
  await evaluate(axe);
  found.push(...await look({ runOnly: RULES }));
  await dress("dark");
  found.push(...await look({ runOnly: ["color-contrast", "link-in-text-block"] }));
  assert.deepEqual(found, []);

  async function dress(theme) {
    await scheme(theme); // the live page has no switch
    await evaluate(`document.documentElement.dataset.theme = "${theme}"`);
  }
}
