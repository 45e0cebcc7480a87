// chapters/live/live.js -- What the figures that move share: sliders, pictures, the C behind them.
//
// kernel.py puts model.js and plot.js of the live page in front of this, labels.js, address.js, orders.js,
// modes.js and drawn.js behind it, and all into one function. A figure's script says what moves it, what is computed and how it is drawn:
//
//   FVI_LIVE.scene("name of the picture", {
//     about: "what to do and what to see",
//     controls: { alpha: ["label", least, most, start, step] },   step "log": by ratios
//     choices: { method: ["label", "fvi", "fvi-bdf2"] },
//     pictures: ["what the first canvas shows", ...],
//     compute(values, kernel, scene) -> data,      numbers only: a test runs it in node
//     says(data, values) -> a sentence with the numbers,
//     draw(data, values, canvases),                with axes() of labels.js
//     drag(values, i, x, y, type): the pointer, or what the arrow keys move, is in canvas i, at
//       those fractions of its axes; a finger must begin at a handle(), else it scrolls the page
//     keeps: { name: how many numbers }, of what is dragged and belongs into a link; see address.js
//     buttons: { again: ["label", values => what it does] }
//     more(data, values, kernel): after a picture, what goes on by itself; true: another picture
//     notes(data, values) -> a sentence with what only this browser knows, such as times
//     kernel: the script with its C, if that is not kernel.js, and what it is called there
//     c: the page with its C, if that is not the one of live.c
//   });
const scenes = new Map(), libraries = new Map();
const kernelOf = ({ kernel: [name, text] = ["kernel", () => FVI_WASM] }) => ({ name, text });

// The C of a scene, once for all figures of a page that have it.
function libraryOf(scene) {
  const { name, text } = kernelOf(scene);
  if (!libraries.has(name)) libraries.set(name, open(text()));
  return libraries.get(name);
}

const countOf = ([, least, most, , step]) => (step === "log" ? 200 : Math.round((most - least) / step));
const stopsOf = control => {
  const [, least, most, , step] = control, many = countOf(control);
  return i => step === "log" ? Number((least * (most / least) ** (i / many)).toPrecision(3))
    : Number((least + (most - least) * i / many).toPrecision(12));
};
const nearest = (control, value) => {
  const [, least, most, , step] = control, many = countOf(control);
  const i = step === "log" ? Math.log(value / least) / Math.log(most / least) * many : (value - least) / (most - least) * many;
  return Math.min(Math.max(Math.round(i), 0), many);
};

// The kernel of model.js, and of live.c its arrays as views: read them before the next call.
async function open(text) {
  const page = await kernel(text);
  const view = (which, length) => new Float64Array(page.c.memory.buffer, page.c.live_array(which), length);
  // A run of the live page, with what differs from its defaults.
  const run = (changes, points) => page.run({ ...defaults(), ...changes }, points);
  return { c: page.c, view, run };
}

// What a scene that goes on by itself comes to.
function settled(scene, values, kernel) {
  for (;;) {
    const data = scene.compute(values, kernel, scene);
    if (!scene.more?.(data, values, kernel)) return data;
  }
}

// For `more`: a motion of that many steps goes on by itself, from values.at, so many steps in a millisecond.
const isStill = () => globalThis.matchMedia?.("(prefers-reduced-motion: reduce)").matches;
function goOn(values, steps, pace) {
  const now = performance.now(), passed = now - (values.clock ?? now);
  values.clock = now;
  if (values.at >= steps) { values.clock = undefined; return false; }
  values.at = isStill() ? steps : Math.min(steps, values.at + Math.min(Math.max(passed * pace, steps / 560), steps / 28));
  return true;
}
const again = values => Object.assign(values, { at: 0, clock: undefined });

function start(scene) {
  return Object.fromEntries([...Object.entries(scene.controls ?? {}).map(([name, control]) => [name, control[3]]),
    ...Object.entries(scene.choices ?? {}).map(([name, [, first]]) => [name, first])]);
}

// ---- in a page ----

// Other words into the text that is there: with a new one a browser looks for the style of the whole page again.
function write(element, words) {
  if (element.firstChild) element.firstChild.data = words;
  else element.append(words);
}

function control(name, of, values, moved) {
  const row = document.createElement("label"), shown = document.createElement("output"), slider = document.createElement("input");
  const at = stopsOf(of);
  Object.assign(slider, { type: "range", min: 0, max: countOf(of), step: 1 });
  slider.dataset.of = name;
  row.append(`${of[0]} `, shown, slider);
  const show = () => {
    slider.value = nearest(of, values[name]);
    write(shown, short(values[name]));
    slider.setAttribute("aria-valuetext", short(values[name]));
  };
  slider.addEventListener("input", () => { values[name] = at(Number(slider.value)); moved(); });
  return { row, show };
}

function choice(name, [label, ...words], values, moved) {
  const row = document.createElement("label"), select = document.createElement("select");
  select.append(...words.map(word => new Option(word, word)));
  select.dataset.of = name;
  row.append(`${label} `, select);
  select.addEventListener("input", () => { values[name] = select.value; moved(); });
  return { row, show: () => { select.value = values[name]; } };
}

function button([label, act], values, moved) {
  const element = document.createElement("button");
  Object.assign(element, { type: "button", textContent: label });
  element.addEventListener("click", () => { act(values); moved(); });
  return element;
}

function canvasOf(label, i, scene, values, moved) {
  const canvas = document.createElement("canvas");
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", label);
  canvas.dataset.label = label;
  if (scene.drag) draggable(canvas, (x, y, type) => {
    if (scene.drag(values, i, x, y, type) !== false) moved();
  });
  return canvas;
}

// By the pointer, and by the arrow keys, with Shift in small steps. A finger scrolls the page, unless it
// begins at a handle.
const REACH = 28; // pixels, of a finger
function draggable(canvas, to) {
  const within = share => Math.min(Math.max(share, 0), 1), place = [0.5, 0.5];
  const inside = event => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
  const taken = event => { const [x, y] = inside(event); return canvas.handles?.some(([a, b]) => Math.hypot(a - x, b - y) < REACH); };
  const go = type => to(...place, type);
  let finger = false; // one that took a handle
  const pointer = event => {
    if (!canvas.axes || (event.type === "pointermove" && event.buttons === 0) || (event.pointerType === "touch" && !finger)) return;
    const [x, y] = inside(event);
    place[0] = within(canvas.axes.fraction(x));
    place[1] = within(canvas.axes.height(y));
    go(event.type);
  };
  canvas.addEventListener("pointerdown", event => {
    finger = event.pointerType === "touch" && taken(event);
    if (event.pointerType === "touch" && !finger) return;
    canvas.setPointerCapture(event.pointerId);
    pointer(event);
  });
  canvas.addEventListener("touchstart", event => { if (finger && event.cancelable) event.preventDefault(); }, { passive: false });
  canvas.addEventListener("pointermove", pointer);
  canvas.tabIndex = 0;
  canvas.addEventListener("keydown", event => {
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
    if (!by || !canvas.axes) return;
    event.preventDefault();
    by.forEach((step, j) => { place[j] = within(place[j] + step / (event.shiftKey ? 200 : 40)); });
    go("pointerdown");
  });
  canvas.classList.add("draggable");
}

const element = (name, of = {}, ...inside) => {
  const made = Object.assign(document.createElement(name), of);
  made.append(...inside);
  return made;
};

// The frame of a figure, in the place of its still picture and as high as it will be: before the C is there.
function frame(figure) {
  const scene = scenes.get(figure.dataset.live), values = { ...start(scene), ...asked(location.hash, figure.id, scene) };
  const moved = () => figure.redraw?.();
  const byHand = () => { moved(); remember(figure, scene, values); };
  const rows = [...Object.entries(scene.controls ?? {}).map(([name, of]) => control(name, of, values, byHand)),
    ...Object.entries(scene.choices ?? {}).map(([name, of]) => choice(name, of, values, byHand))];
  const canvases = scene.pictures.map((label, i) => canvasOf(label, i, scene, values, byHand));
  const number = figure.querySelector("figcaption > a").cloneNode(true), says = element("p", { className: "says" });
  const panel = element("div", { className: "live" }, element("p", {}, number, ` moves. ${scene.about}`),
    element("div", { className: "controls" }, ...rows.map(({ row }) => row), ...Object.values(scene.buttons ?? {}).map(of => button(of, values, byHand))),
    element("div", { className: "pictures" }, ...canvases.map(canvas =>
      element("div", {}, element("p", { className: "title", textContent: canvas.dataset.label }), canvas))), says);
  const notes = scene.notes ? panel.appendChild(element("p", { className: "says" })) : null, took = element("output");
  rows.forEach(row => row.show());
  figure.append(panel, linksOf(figure, scene, took));
  figure.classList.add("is-live");
  addEventListener("hashchange", () => {
    const values_ = asked(location.hash, figure.id, scene);
    if (values_) { Object.assign(values, start(scene), values_); moved(); figure.scrollIntoView(); }
  });
  Object.assign(figure, { parts: { scene, values, rows, canvases, says, notes, took, panel } });
  if (asked(location.hash, figure.id, scene)) figure.scrollIntoView();
}

// Below a figure: its sources, and its still picture, of which the text may say more.
function linksOf(figure, scene, took) {
  const links = element("p", { className: "links" }, element("a", { href: `${figure.dataset.root ?? ""}source/chapters-live-${figure.dataset.live}.js.html`, textContent: "its script" }), " ",
    element("a", { href: `${figure.dataset.root ?? ""}source/${scene.c ?? "chapters-live-live"}.c.html`, textContent: "its C" }), " ");
  if (figure.querySelector("img")) {
    const still = element("button", { type: "button", textContent: "still picture" });
    still.addEventListener("click", () => { still.textContent = figure.classList.toggle("is-live") ? "still picture" : "moving picture"; });
    links.append(still, " ");
  }
  links.append(took);
  return links;
}

// The address shows what was moved by hand, once it rests: browsers count how often it changes.
let resting;
function remember(figure, scene, values) {
  clearTimeout(resting);
  if (figure.id) resting = setTimeout(() => history.replaceState(null, "", addressOf(figure.id, scene, values)), 300);
}

// A panel is as high as it ever was, so that nothing below it jumps. And what changes in it is laid out without
// the rest of the page, whose formulas would take longer than the figure.
function keepHeight(panel) {
  if (panel.scrollHeight > panel.clientHeight || !panel.style.height) panel.style.height = `${panel.scrollHeight + 2}px`;
  panel.style.contain = "strict";
}

// Its first picture, as soon as the C is there; and then whenever something moves.
async function begin(figure) {
  const { scene, values, rows, canvases, says, notes, took, panel } = figure.parts;
  const library = await libraryOf(scene);
  let waiting = false;
  const redraw = () => {
    waiting = false;
    const began = performance.now();
    readColours();
    rows.forEach(row => row.show());
    const data = scene.compute(values, library, scene), words = scene.says(data, values);
    scene.draw(data, values, canvases);
    write(says, words);
    if (notes) write(notes, scene.notes(data, values));
    canvases.forEach(canvas => canvas.setAttribute("aria-label", `${canvas.dataset.label}. ${words}`));
    keepHeight(panel);
    figure.dataset.frame = (performance.now() - began).toFixed(2);
    write(took, `drawn in ${Math.max(1, Math.round(figure.dataset.frame))} ms`);
    if (scene.more?.(data, values, library)) moved();
    else figure.live = { values, moved, data }; // it stands still
  };
  const moved = figure.redraw = () => {
    if (!waiting) requestAnimationFrame(redraw);
    waiting = true;
  };
  redraw();
  let wide = panel.offsetWidth;
  new ResizeObserver(() => {
    if (panel.offsetWidth === wide) return;
    wide = panel.offsetWidth;
    Object.assign(panel.style, { contain: "", height: "" });
    moved();
  }).observe(panel);
  addEventListener("themechange", moved);
}

const scene = (name, what) => scenes.set(name, what);
