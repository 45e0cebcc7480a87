// chapters/play/explain.js -- What tells a reader what to look at: the tour, a pinned run, the
// error, the body itself, what was cut; and undo, and what may be saved.

// ---- a run to compare with ----

let pinned; // { name, t, x, p, energy, error } of the run that was pinned, or nothing

function pin() {
  if (pinned) pinned = undefined;
  else if (result.rows > 0) {
    const { x, p, energy } = result, t = Array.from(x, (_, i) => i * state.h);
    pinned = { name: link(state), t, x: x.slice(), p: p.slice(), energy: energy.slice(), error: errors() };
  }
  element("pin").textContent = pinned ? "Unpin" : "Pin this run";
  element("pin").setAttribute("aria-pressed", Boolean(pinned));
  element("legend-pinned").hidden = !pinned;
  element("pinned-name").textContent = pinned?.name ?? "";
  redraw();
}

// [t, |x - exact|] at the nodes where both are known.
function errors() {
  const { exact, every, parts, x, rows } = result, found = [];
  for (let i = 0; i * every < rows && i * parts < exact.x.length; i++)
    found.push([i * every * state.h, Math.abs(x[i * every] - exact.x[i * parts])]);
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

// A wall, a spring, the body at its place, and where it was, as large as that weighs.
function drawBody(high) {
  const canvas = element("body"), { x, weights } = result, k = moment();
  const at = picture(canvas, { x: span(x, [0]).map(end => Math.min(Math.max(end, -high), high)), y: [-1, 1], names: ["", ""], bare: true });
  const wall = at.left, place = Math.min(Math.max(x[k], -high), high), coils = 12;
  at.curve(Array.from({ length: 2 * coils + 1 }, (_, i) => wall + (place - wall) * i / (2 * coils)),
    Array.from({ length: 2 * coils + 1 }, (_, i) => (i % 2 ? (i % 4 === 1 ? 0.35 : -0.35) : 0)), "axis", [], 1.3);
  for (let n = remembers() ? k : 0; n > 0; n--) {
    const radius = 9 * Math.cbrt(Math.abs(weights[n]));
    if (radius > 0.5) at.dot(x[k - n], 0, "past", radius, true);
  }
  at.dot(place, 0, "run", 9);
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

function explain() {
  for (const [id, what] of [["pin", pin], ["play", togglePlay], ["undo", undo], ["save-table", saveTable],
    ["save-picture", () => save("x.png", element("x").toDataURL())], ["tour-back", () => goTour(-1)], ["tour-next", () => goTour(1)]])
    element(id).addEventListener("click", what);
}
