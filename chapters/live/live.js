// chapters/live/live.js -- What the figures that move share: sliders, pictures, the C behind them.
//
// kernel.py puts model.js and plot.js of the live page in front of this, orders.js and modes.js behind it, and
// all into one function. A figure's script says what moves it, what is computed and how it is drawn:
//
//   FVI_LIVE.scene("name of the picture", {
//     about: "what to do and what to see",
//     controls: { alpha: ["label", least, most, start, step] },   step "log": by ratios
//     choices: { method: ["label", "fvi", "fvi-bdf2"] },
//     pictures: ["what the first canvas shows", ...],
//     compute(values, kernel, scene) -> data,      numbers only: a test runs it in node
//     says(data, values) -> a sentence with the numbers,
//     draw(data, values, canvases),                with picture() of plot.js
//     drag(values, i, x, y, type): the pointer, or what the arrow keys move, is in canvas i, at
//       those fractions of its axes
//     buttons: { again: ["label", values => what it does] }
//     more(data, values, kernel): after a picture, what goes on by itself; true: another picture
//     notes(data, values) -> a sentence with what only this browser knows, such as times
//   });
const scenes = new Map();
let library; // the C, once for all figures of a page

const stopsOf = ([, least, most, , step]) => {
  const many = step === "log" ? 200 : Math.round((most - least) / step);
  return i => step === "log" ? Number((least * (most / least) ** (i / many)).toPrecision(3))
    : Number((least + (most - least) * i / many).toPrecision(12));
};
const countOf = ([, least, most, , step]) => step === "log" ? 200 : Math.round((most - least) / step);
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

function start(scene) {
  return Object.fromEntries([...Object.entries(scene.controls ?? {}).map(([name, control]) => [name, control[3]]),
    ...Object.entries(scene.choices ?? {}).map(([name, [, first]]) => [name, first])]);
}

// ---- in a page ----

function control(name, of, values, moved) {
  const row = document.createElement("label"), shown = document.createElement("output"), slider = document.createElement("input");
  const at = stopsOf(of);
  Object.assign(slider, { type: "range", min: 0, max: countOf(of), step: 1 });
  slider.dataset.of = name;
  row.append(`${of[0]} `, shown, slider);
  const show = () => {
    slider.value = nearest(of, values[name]);
    shown.textContent = short(values[name]);
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
  canvas.dataset.label = label;
  if (scene.drag) draggable(canvas, (x, y, type) => {
    if (scene.drag(values, i, x, y, type) !== false) moved();
  }, scene.drag.length > 3);
  return canvas;
}

// By the pointer, and by the arrow keys, with Shift in small steps. A finger scrolls the page
// where only x matters.
function draggable(canvas, to, both) {
  const within = share => Math.min(Math.max(share, 0), 1), place = [0.5, 0.5];
  const go = type => to(...place, type);
  const pointer = event => {
    if (event.type === "pointermove" && event.buttons === 0) return;
    const box = canvas.getBoundingClientRect();
    place[0] = within(canvas.axes.fraction(event.clientX - box.left));
    place[1] = within(canvas.axes.height(event.clientY - box.top));
    go(event.type);
  };
  canvas.addEventListener("pointerdown", event => { canvas.setPointerCapture(event.pointerId); pointer(event); });
  canvas.addEventListener("pointermove", pointer);
  canvas.tabIndex = 0;
  canvas.addEventListener("keydown", event => {
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
    if (!by) return;
    event.preventDefault();
    by.forEach((step, j) => { place[j] = within(place[j] + step / (event.shiftKey ? 200 : 40)); });
    go("pointerdown");
  });
  canvas.classList.add("draggable");
  if (both) canvas.style.touchAction = "none";
}

// The scene of a figure below its image, of which the text speaks.
async function begin(figure) {
  const scene = scenes.get(figure.dataset.live), values = start(scene), panel = document.createElement("div");
  library ??= await open(FVI_WASM);
  let waiting = false;
  const redraw = () => {
    waiting = false;
    const began = performance.now();
    readColours();
    rows.forEach(row => row.show());
    const data = scene.compute(values, library, scene), words = scene.says(data, values);
    scene.draw(data, values, canvases);
    says.textContent = words;
    notes.textContent = scene.notes?.(data, values) ?? "";
    canvases.forEach(canvas => canvas.setAttribute("aria-label", `${canvas.dataset.label}. ${words}`));
    figure.dataset.frame = (performance.now() - began).toFixed(2);
    took.textContent = `drawn in ${Math.max(1, Math.round(figure.dataset.frame))} ms`;
    if (scene.more?.(data, values, library)) moved();
    else figure.live = { values, moved, data }; // it stands still
  };
  const moved = () => {
    if (!waiting) requestAnimationFrame(redraw);
    waiting = true;
  };
  const rows = [...Object.entries(scene.controls ?? {}).map(([name, of]) => control(name, of, values, moved)),
    ...Object.entries(scene.choices ?? {}).map(([name, of]) => choice(name, of, values, moved))];
  const canvases = scene.pictures.map((label, i) => canvasOf(label, i, scene, values, moved));
  const about = document.createElement("p"), says = document.createElement("p"), notes = document.createElement("p"), pictures = document.createElement("div");
  const controls = document.createElement("div"), took = document.createElement("output");
  about.textContent = scene.about;
  says.className = "says";
  pictures.className = "pictures";
  controls.className = "controls";
  pictures.append(...canvases.map(canvas => {
    const box = document.createElement("div"), title = document.createElement("p");
    title.textContent = canvas.dataset.label;
    title.className = "title";
    box.append(title, canvas);
    return box;
  }));
  controls.append(...rows.map(({ row }) => row), ...Object.values(scene.buttons ?? {}).map(of => button(of, values, moved)));
  panel.className = "live";
  panel.append(about, controls, pictures, says);
  if (scene.notes) panel.append(notes);
  figure.append(panel); // the canvases have sizes from here on
  redraw();
  const source = document.createElement("a");
  source.href = `source/chapters-live-${figure.dataset.live}.js.html`;
  source.textContent = "its script";
  const c = document.createElement("a");
  c.href = `source/${scene.c ?? "chapters-live-live"}.c.html`;
  c.textContent = "its C";
  const links = document.createElement("p");
  links.className = "links";
  links.append(source, " ", c, " ", took);
  panel.after(links);
  new ResizeObserver(moved).observe(panel);
  addEventListener("themechange", moved);
}

// How far a run is from the exact motion, at the nodes from that one on.
function error({ x, exact, every, parts }, first) {
  let worst = 0;
  for (let i = Math.ceil(first / every); i * every < x.length && i * parts < exact.x.length; i++)
    worst = Math.max(worst, Math.abs(x[i * every] - exact.x[i * parts]));
  return worst;
}

// A picture, whose axes the pointer of its canvas then asks.
function axes(canvas, of) {
  return canvas.axes = picture(canvas, of);
}

const scene = (name, what) => scenes.set(name, what);
