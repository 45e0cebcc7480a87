// chapters/book/test_pages.mjs -- Each page from the disk, in one browser.      (a part of make test-book)
//
// A long page takes seconds to load where others are at work: all is asked of it at one go.
import assert from "node:assert/strict";
import { lookWithAxe } from "./test_axe.mjs";

const WIDTHS = [320, 360, 800, 970, 1024, 1180, 1600, 3840];

// Run in the page, before its figures are drawn: gathers the words on canvases that an edge cuts.
function watchWords() {
  const write = CanvasRenderingContext2D.prototype.fillText;
  window.cut = [];
  CanvasRenderingContext2D.prototype.fillText = function (words, x, y) {
    const wide = this.measureText(words).width, from = x - wide * { left: 0, center: 0.5, right: 1 }[this.textAlign];
    if (from < -0.5 || from + wide > this.canvas.width / this.getTransform().a + 0.5) window.cut.push(words);
    write.call(this, words, x, y);
  };
}

// Run in the page: the text, without code and formulas, that is none: marks of Markdown's mathematics.
function unread() {
  const text = document.querySelector("main").cloneNode(true);
  text.querySelectorAll("code, pre, .katex").forEach(e => e.remove());
  return text.textContent.match(/.{0,30}(\$|\\[a-z]{2}).{0,30}/g) ?? [];
}

// Run in the page: what is beyond the column and does not scroll, cut in height, on top of its neighbour, or
// a stop that begins a line.
function misplaced() {
  const out = [], say = (what, e) => out.push(`${what}: ${e.outerHTML.replace(/\s+/g, " ").slice(0, 90)}`);
  const main = document.querySelector("main").getBoundingClientRect();
  const seen = e => e.getClientRects().length > 0 && getComputedStyle(e).visibility !== "hidden";
  // of a formula in the text, the parts between which it may break
  for (const e of document.querySelectorAll("main :is(:not(.katex *, .anchor), .katex-html > .base):not(:is(.scroll, .formula, pre, figure > a) *)")) {
    if (!seen(e)) continue;
    const { left, right, width } = e.getBoundingClientRect();
    if (width > 0 && (right > main.right + 1 || left < main.left - 1)) say("beyond the column", e);
  }
  for (const e of document.querySelectorAll("main .scroll, main pre"))
    if (e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).overflowX !== "auto") say("cut at the right", e);
  for (const e of document.querySelectorAll("main .formula")) {
    if (e.scrollHeight > e.clientHeight + 2) say(`cut by ${e.scrollHeight - e.clientHeight} in height`, e);
    if (innerWidth > 400 && [1, 2].includes(e.scrollWidth - e.clientWidth)) say("with a scroll bar for nothing", e);
  }
  const texts = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT), range = document.createRange();
  for (let text; (text = texts.nextNode());) {
    const before = text.previousSibling?.getClientRects?.();
    if (!/^[.,;:]/.test(text.data) || !before?.length) continue;
    range.setStart(text, 0);
    range.setEnd(text, 1);
    if (range.getBoundingClientRect().top > before[before.length - 1].bottom) say(`${text.data.slice(0, 9)} begins a line after`, text.previousSibling);
  }
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

export async function testPages(browser, test, { names, url, read, moves, axe }) {
  const { evaluate, go, size, until } = browser;
  const figure = name => `document.querySelector('[data-live="${name}"]')`;
  let moved = 0;

  for (const name of names) {
    const figures = [...read(name).matchAll(/data-live="([^"]*)"/g)].map(match => match[1]);

    await test("widths", `${name} does not scroll sideways, cuts no table or formula, puts nothing on another, begins no line with a stop, from a phone to a wall`, async () => {
      const faults = [];
      await size(WIDTHS[0]);
      await go(url(name));
      assert.deepEqual(await evaluate(`(${unread})()`), []);
      await evaluate(`(${watchWords})()`);
      for (const live of figures) {
        const before = await evaluate(`${figure(live)}.offsetHeight`);
        await evaluate(`${figure(live)}.scrollIntoView()`);
        await until(`${figure(live)}.live`);
        const after = await evaluate(`${figure(live)}.offsetHeight`); // at 320; two lines more at most
        if (after - before > 40) faults.push(`${live} was ${before} high, and is ${after}`);
      }
      await evaluate(`document.querySelectorAll("details").forEach(one => { one.open = true; }), document.fonts.ready.then(() => 0)`);
      for (const width of WIDTHS) {
        await size(width);
        const wide = await evaluate("document.documentElement.scrollWidth");
        if (wide > width) faults.push(`at ${width}: ${wide} wide`);
        faults.push(...(await evaluate(`(${misplaced})()`)).map(fault => `at ${width}: ${fault}`));
      }
      faults.push(...(await evaluate("window.cut")).map(words => `cut by the edge of its picture: ${words}`));
      assert.ok(faults.length === 0, faults.join("\n"));
    });

    await size(1280);
    for (const live of figures) {
      await test("figures", `a slider moves ${live}, and its picture stays`, () => slide(browser, figure(live), live));
      // They are moved where test_live.mjs moved them, which compares what they show with fvi.
      await test("figures", `${live} moves, and says so`, async () => {
        const said = new Set();
        for (const move of moves.filter(move => move.name === live)) {
          Object.assign(move, await show(browser, figure(live), move.values));
          said.add(move.said);
        }
        assert.ok(said.size > 1);
        moved++;
      });
    }

    if (axe) await test("axe", `axe finds no fault in ${name}, by day and by night`, () => lookWithAxe(browser, axe));
  }
  return moved;
}

async function slide({ evaluate }, figure, name) {
  const [still, moving] = await evaluate(`["img", "canvas"].map(of => ${figure}.querySelector(of)?.offsetParent != null)`);
  assert.ok(moving && !still, `${name}: it stands in the place of its still picture`);
  for (const control of await evaluate(`[...${figure}.querySelectorAll("input[data-of]")].map(slider => slider.dataset.of)`)) {
    const before = await evaluate(`${figure}.live.values.${control}`);
    await evaluate(`(slider => { slider.value = Math.round(0.7 * slider.max) - (slider.value > 0.6 * slider.max ? Math.ceil(slider.max / 3) : 0);
      slider.dispatchEvent(new Event("input")); })(${figure}.querySelector("input[data-of=${control}]"))`);
    assert.notEqual(await evaluate(`${figure}.live.values.${control}`), before, `${name}, ${control}`);
  }
}

// A figure, moved there: its numbers, and its sentence.
async function show({ evaluate, until }, figure, values) {
  await evaluate(`(figure => {
    const { values, moved } = figure.live;
    for (const name of Object.keys(values)) delete values[name];
    Object.assign(values, ${JSON.stringify(values)});
    figure.live = null;
    moved();
  })(${figure})`);
  await until(`${figure}.live`);
  return {
    data: await evaluate(`JSON.parse(JSON.stringify(${figure}.live.data, (_, v) => ArrayBuffer.isView(v) ? [...v] : v))`),
    said: await evaluate(`${figure}.querySelector(".says").textContent`),
  };
}
