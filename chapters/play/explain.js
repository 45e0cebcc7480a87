// chapters/play/explain.js -- What tells a reader what to look at: the tour, a pinned run, the
// error, the body itself, what was cut; and undo, and what may be saved.

// ---- a run to compare with ----

let pinned; // { name, t, x, p, energy, error } of the run that was pinned, or nothing

function pin() {
  if (pinned) pinned = undefined;
  else if (result.rows > 0) keepRun(state, result);
  showPinned();
  history.replaceState(null, "", wholeLink());
}
function keepRun(of, { x, p, energy, ...run }) {
  pinned = { name: link(of), t: Array.from(x, (_, i) => i * of.h), x: x.slice(), p: p.slice(), energy: energy.slice(), error: errors({ x, ...run }, of.h) };
}

// The link with the run that is pinned, whose words are joined by semicolons: #alpha=0.3&pin=alpha=0.5;rho=1
function wholeLink() {
  return link(state) + (pinned ? `&pin=${pinned.name.slice(1).replaceAll("&", ";")}` : "");
}
function pinFrom(hash) {
  const [, words] = /&pin=([^&]*)/.exec(hash) ?? [];
  if (!words) return;
  const { state: of, wrong } = parse(words.replaceAll(";", "&")), run = wrong.length || (of.potential === "own" && fvi.misprint(of)) ? { rows: 0 } : fvi.run(of);
  if (run.rows > 0) keepRun(of, run);
  showPinned();
}
async function copyLink() {
  await navigator.clipboard.writeText(location.href.replace(/#.*/, "") + wholeLink());
  element("copy").textContent = "Copied";
  setTimeout(() => { element("copy").textContent = "Copy link"; }, 1500);
}

function showPinned() {
  element("pin").textContent = pinned ? "Unpin" : "Pin this run";
  element("pin").setAttribute("aria-pressed", Boolean(pinned));
  element("legend-pinned").hidden = !pinned;
  element("pinned-name").textContent = pinned?.name ?? "";
  redraw();
}

// [t, |x - exact|] at the nodes where both are known.
function errors({ exact, every, parts, x, rows } = result, h = state.h) {
  const found = [];
  for (let i = 0; i * every < rows && i * parts < exact.x.length; i++)
    found.push([i * every * h, Math.abs(x[i * every] - exact.x[i * parts])]);
  return found;
}

function drawError(t) {
  const now = errors(), other = pinned?.error ?? [], sizes = [...now, ...other].map(pair => pair[1]).filter(size => size > 0);
  const high = Math.min(Math.max(...sizes, 1e-14) * 2, 1e6), low = Math.max(Math.min(...sizes, high / 100), 1e-17);
  const at = picture(element("error"), { x: t, y: [low / 2, high], log: "y", names: ["t", "error"] });
  const line = (pairs, ...how) => at.curve(pairs.map(pair => pair[0]), pairs.map(pair => Math.max(pair[1], low / 2)), ...how);
  line(other, "pinned", [2, 3]);
  line(now, "run");
  if (now.length === 0) at.note("no exact solution to compare with");
  element("error").setAttribute("aria-label", `Error of x against time, logarithmic; the largest is ${short(Math.max(0, ...now.map(pair => pair[1])))}`);
}

// ---- what is too high to be read ----

// The size at which pictures of x end: what blows up would flatten all that is worth seeing.
function readable({ x, exact }) {
  const size = array => array.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  const usual = exact.x.length ? Math.max(size(exact.x), size(exact.v)) : Math.max(1, Math.abs(state.x0), Math.abs(state.p0), size(x.slice(0, 4)));
  return (exact.x.length ? 8 : 100) * Math.max(usual, 1e-6);
}

function sayCut(high) {
  const most = result.x.reduce((size, value) => Math.max(size, Math.abs(value)), 0), cut = most > high;
  element("cut").hidden = !cut;
  if (cut) element("cut").textContent = `The pictures are cut at ±${short(Number(high.toPrecision(2)))}: the run goes up to ${short(Number(most.toPrecision(2)))}.`;
}

// ---- the body ----

// A wall, a spring above, a springpot below, the body, and where it was, as large as that weighs.
function drawBody(high) {
  const canvas = element("body"), { x, weights } = result, k = moment();
  const at = picture(canvas, { x: span(x, [0]).map(end => Math.min(Math.max(end, -high), high)), y: [-1.6, 1.6], names: ["", ""], bare: true });
  const wall = at.left, place = Math.min(Math.max(x[k], -high), high), coils = 12, along = share => wall + (place - wall) * share;
  if (state.potential !== "free")
    at.curve(Array.from({ length: 2 * coils + 1 }, (_, i) => along(i / 2 / coils)),
      Array.from({ length: 2 * coils + 1 }, (_, i) => 0.5 + (i % 2 ? (i % 4 === 1 ? 0.3 : -0.3) : 0)), "axis", [], 1.3);
  if (state.rho > 0) // its sign is a rhomb
    at.curve([0, 0.4, 0.5, 0.6, 0.5, 0.4, 0.5, 0.6, 1].map(along), [-0.5, -0.5, -0.1, -0.5, -0.9, -0.5, -0.1, -0.5, -0.5], "axis", [], 1.3);
  for (let n = remembers() ? k : 0; n > 0; n--) {
    const radius = 9 * Math.cbrt(Math.abs(weights[n]));
    if (radius > 0.5) at.dot(x[k - n], 0, "past", radius, true);
  }
  at.curve([place, place], [-0.7, 0.7], "axis", [], 3);
  at.dot(place, 0, "run", 9);
  const name = state.alpha === 0 ? "a second spring" : state.alpha === 0.5 ? "dashpot" : state.alpha === 1 ? "a second mass" : "springpot";
  if (state.potential !== "free") at.text(wall, 1.1, "spring", "soft-ink");
  if (state.rho > 0) at.text(wall, -1.15, name, "soft-ink");
  at.text(place, 1.1, "mass", "run");
}

// ---- weight times x ----

// The size of each part, on a logarithmic scale: full if it is positive, hollow if negative.
function drawParts(t) {
  const k = moment(), adds = parts(state, result, k), sum = adds.reduce((total, part) => total + part, 0), canvas = element("parts");
  const most = Math.max(1e-9, ...adds.map(Math.abs)), low = 1e-6 * most, every = Math.ceil(adds.length / 500);
  const at = picture(canvas, { x: t, y: [low, 3 * most], log: "y", names: ["t", "size of weight × x"] });
  for (let j = k % every; j <= k; j += every)
    if (Math.abs(adds[j]) > low) at.dot(j * state.h, Math.abs(adds[j]), adds[j] < 0 ? "negative" : "positive", 2.5, adds[j] < 0);
  if (!remembers()) at.note("no memory");
  canvas.setAttribute("aria-label", `What each moment adds to the damping at k = ${k}; the sum is ${short(sum)}`);
  element("parts-sum").textContent = short(Number(sum.toPrecision(3)));
}

// ---- three pasts ----

let three = false, others = []; // the runs of the other two: { past, x }
function runOthers() {
  others = three && !methods[state.method].half ? choices.past.filter(past => past !== state.past)
    .map(past => ({ past, x: fvi.run({ ...state, past }, 1).x.slice() })) : [];
}
function toggleThree() {
  three = !three;
  element("three").setAttribute("aria-pressed", three);
  redraw();
}
function drawOthers(at) {
  others.forEach(({ past, x }, i) => {
    at.curve(Array.from(x, (_, j) => j * state.h), x, ["positive", "negative"][i], [[2, 3], [9, 3, 2, 3]][i], 1.4);
    if (x.length) at.text((x.length - 1) * state.h * (0.8 - 0.25 * i), x[Math.round((x.length - 1) * (0.8 - 0.25 * i))], past, ["positive", "negative"][i]);
  });
}

let playing = 0; // when the last frame was, or 0
function play(time) {
  if (!playing) return;
  look += (time - playing) / 12000; // the whole run in twelve seconds
  playing = time;
  if (look >= 1) look = 0;
  redraw();
  requestAnimationFrame(play);
}
function togglePlay() {
  playing = playing ? 0 : performance.now();
  element("play").textContent = playing ? "Pause" : "Play";
  element("play").setAttribute("aria-pressed", Boolean(playing));
  if (playing) requestAnimationFrame(play);
}

// ---- undo ----

const trail = []; // links, the present one last
function remember() {
  const now = link(state);
  if (trail.at(-1) !== now) trail.push(now);
  element("undo").disabled = trail.length < 2;
}
function undo() {
  trail.pop();
  history.replaceState(null, "", trail.at(-1));
  read();
}

// ---- the tour ----

const stopsOfTour = () => [...document.querySelectorAll("#tour li")];
function showTour() {
  const all = stopsOfTour(), here = all.findIndex(stop => link(parse(stop.querySelector("a").hash).state) === link(state));
  all.forEach((stop, i) => { stop.hidden = i !== here; });
  element("tour-back").disabled = here <= 0;
  element("tour-next").disabled = here === all.length - 1;
  element("tour-place").textContent = here < 0 ? "A tour of eight stops: begin with Next, or move a slider." : `Stop ${here + 1} of ${all.length}`;
}
function goTour(by) {
  const all = stopsOfTour(), here = all.findIndex(stop => !stop.hidden);
  location.hash = all[Math.max(0, here + by)].querySelector("a").hash;
}

// ---- what may be saved ----

function save(name, url) {
  const anchor = document.createElement("a");
  anchor.download = name;
  anchor.href = url;
  anchor.click();
}
function saveTable() {
  const { x, p, energy } = result, rows = Array.from(x, (_, i) => [i * state.h, x[i], p[i], energy[i]].join(","));
  save("run.csv", URL.createObjectURL(new Blob([["t,x,p,energy", ...rows, ""].join("\n")], { type: "text/csv" })));
}

// What draws as a canvas's pen does, into the text of an SVG; as much of it as plot.js asks for.
function svgPen(width, height) {
  const out = [], round = value => Math.round(value * 100) / 100, pen = { dash: [] };
  let path = "", box; // box: the last rectangle
  const known = (...values) => values.every(Number.isFinite); // a canvas, too, leaves out the others
  const shape = style => out.push(`<path d="${path}" ${style}/>`);
  return Object.assign(pen, {
    setTransform() {}, save() {}, setLineDash(dash) { pen.dash = dash; },
    clearRect(...box) { this.fillStyle = colours.ground; path = ""; this.rect(...box); this.fill(); },
    beginPath() { path = ""; },
    moveTo(x, y) { if (known(x, y)) path += `M${round(x)} ${round(y)}`; },
    lineTo(x, y) { if (known(x, y)) path += `${path ? "L" : "M"}${round(x)} ${round(y)}`; },
    rect(x, y, w, h) { box = [x, y, w, h]; path += `M${round(x)} ${round(y)}h${round(w)}v${round(h)}h${round(-w)}z`; },
    arc(x, y, r) { if (known(x, y)) path += `M${round(x - r)} ${round(y)}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0`; },
    clip() { const [x, y, w, h] = box; out.push(`<svg x="${x}" y="${y}" width="${w}" height="${h}" viewBox="${x} ${y} ${w} ${h}">`); },
    restore() { out.push("</svg>"); },
    stroke() { shape(`fill="none" stroke="${pen.strokeStyle}" stroke-width="${pen.lineWidth}" stroke-linejoin="round" stroke-dasharray="${pen.dash.join(" ")}"`); },
    fill() { shape(`fill="${pen.fillStyle}"`); },
    measureText: text => ({ width: 7 * text.length }),
    fillText(text, x, y) {
      const anchor = { left: "start", center: "middle", right: "end" }[pen.textAlign], base = { top: "0.8em", middle: "0.35em", bottom: "-0.2em" }[pen.textBaseline];
      out.push(`<text x="${round(x)}" y="${round(y)}" dy="${base}" text-anchor="${anchor}" fill="${pen.fillStyle}">${text.replaceAll("&", "&amp;").replaceAll("<", "&lt;")}</text>`);
    },
    text: () => `<svg xmlns="${"http"}://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" `
      + `font-family="system-ui, sans-serif" font-size="12">${out.join("\n")}</svg>\n`,
  });
}

// The picture that is chosen, as an SVG, a PNG, or a table of what is drawn in it.
const kinds = {
  svg(canvas) {
    canvas.pen = svgPen(canvas.clientWidth / enlarged(), canvas.clientHeight / enlarged());
    draw();
    const text = canvas.pen.text();
    delete canvas.pen;
    draw();
    return new Blob([text], { type: "image/svg+xml" });
  },
  png(canvas) {
    const copy = document.createElement("canvas"), pen = copy.getContext("2d");
    Object.assign(copy, { width: canvas.width, height: canvas.height });
    pen.fillStyle = colours.ground;
    pen.fillRect(0, 0, copy.width, copy.height);
    pen.drawImage(canvas, 0, 0);
    return new Promise(done => copy.toBlob(done, "image/png"));
  },
  csv(canvas) {
    canvas.series = [];
    draw();
    const rows = canvas.series.flatMap(([name, x, y]) => Array.from(y, (value, i) => `${name},${x[i]},${value}`));
    delete canvas.series;
    return new Blob([["curve,x,y", ...rows, ""].join("\n")], { type: "text/csv" });
  },
};
async function savePicture(kind) {
  const which = element("which").value;
  save(`${which}.${kind}`, URL.createObjectURL(await kinds[kind](element(which))));
}

function explain() {
  for (const [id, what] of [["pin", pin], ["play", togglePlay], ["undo", undo], ["save-table", saveTable],
    ["three", toggleThree], ["copy", copyLink], ...Object.keys(kinds).map(kind => [`save-${kind}`, () => savePicture(kind)]), ["tour-back", () => goTour(-1)], ["tour-next", () => goTour(1)]])
    element(id).addEventListener("click", what);
}
