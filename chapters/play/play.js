// chapters/play/play.js -- The page: controls, pictures, and the link in between.
const element = id => document.getElementById(id);
const notes = {
  alpha: "the damping is of order 2α", rho: "damping ρ", h: "time step", steps: "number of steps N",
  kappa: "U taken at κ xₖ + (1 − κ) xₖ₊₁", x0: "start x(0)", p0: "start p(0)",
  c: "stiffness C", g: "cubic stiffness G", a: "size A", b: "until T",
};
const spelled = { held: "held at x0", caputo: "on a line (Caputo)", rl: "at 0 (Riemann-Liouville)" };

const middle = 0.6; // of the run: the moment to look at, 0 the first, 1 the last
let state, fvi, result, look = middle; // explain.js has: pinned, the run to compare with
let motion; // the picture of x(t), for the pointer
let waiting = false, linkTimer;

// ---- what is said ----

function say(lines) {
  element("message").textContent = lines.join("; ");
  element("message").hidden = lines.length === 0;
}

// What is wrong with a field, below it.
function sayFault(name, text) {
  element(`${name}-fault`).textContent = text;
  element(`${name}-fault`).hidden = !text;
}

function sayStability() {
  const { text, crossed, load } = result.stability;
  element("load").classList.toggle("crossed", crossed);
  element("load-track").style.visibility = load >= 0 || load < 0 ? "" : "hidden";
  element("load-bar").style.width = `${100 * Math.min(Math.max(load, 0) || 0, 1)}%`;
  if (element("load-text").textContent !== text) element("load-text").textContent = text;
}

// Does the past of a step act on it?
const remembers = () => !methods[state.method].half && state.rho > 0;

// What is not drawn is not in the legend, and it is said why.
function sayExact() {
  const { exact, rows, solvable } = result, why = lacking(state, result);
  element("legend-run").hidden = rows === 0;
  element("legend-past").hidden = rows === 0 || !remembers();
  element("legend-exact").hidden = exact.x.length === 0;
  element("lacking").hidden = !why;
  element("lacking").classList.toggle("lit", !solvable);
  if (element("lacking").textContent !== why) element("lacking").textContent = why;
}

// How far the run is from the exact solution.
function compare() {
  const { exact, every, parts, x, rows } = result;
  if (exact.x.length === 0) return "";
  let worst = 0;
  for (let i = 0; i * every < rows && i * parts < exact.x.length; i++)
    worst = Math.max(worst, Math.abs(x[i * every] - exact.x[i * parts]));
  return `; largest error ${Number(worst.toPrecision(2))} at ${every === 1 ? "the nodes" : `one node in ${every}`}`;
}

function moment() {
  return Math.round(look * Math.max(result.rows - 1, 0));
}

function sayMoment() {
  const k = moment(), { x, p, energy, rows } = result;
  const ended = rows <= state.steps ? `; step ${rows} gave no finite value` : "";
  const text = rows === 0 ? "no run" : `k = ${k}: t = ${short(k * state.h)}, x = ${short(x[k])}, `
    + `p = ${short(p[k])}, E = ${short(energy[k])}${compare()}${ended}`;
  element("moment").textContent = text;
  element("look").disabled = rows === 0;
  element("look").max = Math.max(rows - 1, 1);
  element("look").value = k;
  element("look").setAttribute("aria-valuetext", `k = ${k}`);
  element("x").setAttribute("aria-label", `Position against time, ${state.method}, ${text}`);
}

// ---- what is drawn ----

// The past of step k, each x_j with a dot as large as its weight: area by power 2/3.
function drawPast(at, times) {
  const k = moment(), { x, weights } = result;
  for (let n = remembers() ? k : 0; n > 0; n--) {
    const radius = 7 * Math.cbrt(Math.abs(weights[n]));
    if (radius > 0.3) at.dot(times[k - n], x[k - n], "past", radius);
  }
  if (x.length < 100) // long steps: where they end
    for (let j = 0; j < x.length; j++) at.dot(times[j], x[j], "run", 2.2);
  at.dot(times[k], x[k], "run", 5);
  at.dot(times[k], x[k], "ink", 7, true);
}

function drawMotion() {
  const { x, p, energy, exact, rows } = result, k = moment(), dash = [8, 5], other = pinned ?? { t: [], x: [], p: [], energy: [] };
  const times = Float64Array.from({ length: rows }, (_, i) => i * state.h);
  const c = state.potential === "free" ? 0 : state.c; // of a U with an exact solution
  const exactEnergy = exact.x.map((x, i) => (exact.v[i] ** 2 + c * x * x) / 2);
  const t = [0, Math.max(rows - 1, 1) * state.h], high = readable(result);
  const fit = (most, ...arrays) => span(...arrays.map(values => values.map(value => Math.min(Math.max(value, -most), most))));
  sayCut(high);
  const at = motion = picture(element("x"), { x: t, y: fit(high, x, exact.x, other.x, ...others.map(run => run.x)), names: ["t", "x"] });
  at.curve(other.t, other.x, "pinned", [2, 3]);
  drawOthers(at);
  at.curve(times, x, "run");
  at.curve(exact.t, exact.x, "exact", dash);
  drawPast(at, times);
  const e = picture(element("energy"), { x: t, y: fit(high * high, energy, exactEnergy, other.energy, [0]), names: ["t", "E"] });
  e.curve(other.t, other.energy, "pinned", [2, 3]);
  e.curve(times, energy, "run");
  e.curve(exact.t, exactEnergy, "exact", dash);
  e.dot(times[k], energy[k], "run", 4);
  const phase = picture(element("phase"), { x: fit(high, x, exact.x, other.x), y: fit(high, p, exact.v, other.p), names: ["x", "p"] });
  phase.curve(other.x, other.p, "pinned", [2, 3], 1.2);
  phase.curve(x, p, "run", [], 1.2);
  phase.curve(exact.x, exact.v, "exact", dash, 1.2);
  phase.dot(x[k], p[k], "run", 4);
  drawError(t);
  drawParts(t);
  drawBody(high);
}

// The axes alone, of a run that is refused.
function drawNothing() {
  const t = [0, state.steps * state.h], y = [-1, 1];
  sayCut(Infinity);
  for (const [id, x, names] of [["body", y, ["", ""]], ["error", t, ["t", "error"]], ["parts", t, ["t", "part"]], ["energy", t, ["t", "E"]], ["phase", y, ["x", "p"]], ["x", t, ["t", "x"]]]) {
    motion = picture(element(id), { x, y, names }); // that of x is the last
    motion.note("no run");
  }
}

function drawWeights() {
  const { weights } = result, last = state.steps, marks = [], power = decay(state);
  const least = methods[state.method].stages ? 1e-13 : 1e-300; // what a memory keeps of stages
  for (let n = 1; n <= last; n = Math.max(n + 1, Math.floor(n * 1.12))) {
    const size = Math.abs(weights[n]);
    if (size > least) marks.push([n, size, weights[n] < 0]);
  }
  const sizes = marks.map(mark => mark[1]), low = Math.min(0.1, ...sizes), high = Math.max(1, ...sizes);
  const at = picture(element("weights"), { x: [0.9, 1.2 * last], y: [low / 2, 2 * high], log: "xy",
    names: ["n steps ago", "weight"] });
  if (marks.length > 3) { // the predicted decay, through the last mark
    const [n, size] = marks.at(-1);
    at.curve([1, n], [size * n ** -power, size], "exact", [2, 3], 1.2);
  } else {
    at.note("the others are zero: no memory is left");
  }
  element("falls").hidden = marks.length <= 3;
  for (const [n, size, negative] of marks) at.dot(n, size, negative ? "negative" : "positive", 3.2, negative);
  element("power").textContent = short(power).replace("-", "\u2212");
  element("of-what").textContent = methods[state.method].stages ? "velocities" : "positions";
  element("weights").setAttribute("aria-label", `The weights of past `
    + `${element("of-what").textContent} for order ${short(2 * state.alpha)}: `
    + (marks.length > 3 ? `they decay like n to the ${short(power)}` : "the others are zero"));
}

function draw() {
  waiting = false;
  const began = performance.now();
  readColours();
  runOthers(); // before the run: its arrays are views
  result = fvi.run(state);
  sayStability();
  sayExact();
  sayMoment();
  if (result.rows === 0) drawNothing();
  else drawMotion();
  drawWeights();
  const took = performance.now() - began;
  document.documentElement.dataset.frame = took.toFixed(2);
  element("took").textContent = `${took.toFixed(1)} ms`;
}

function redraw() {
  if (!waiting) requestAnimationFrame(draw);
  waiting = true;
}

// ---- the controls ----

// A slider and a field for one number. The slider stands on one of its stops; the
// field takes any number in the range, and says what is wrong with another.
function control(name) {
  const row = document.createElement("div"), values = stops(name);
  row.className = "row";
  row.dataset.of = name;
  row.innerHTML = `<label for="${name}-slider"><var>${name}</var> <span></span></label>
    <input type="range" id="${name}-slider" min="0" max="${values.length - 1}" step="1">
    <input type="text" id="${name}" inputmode="decimal" autocomplete="off" spellcheck="false" aria-describedby="${name}-fault">
    <p class="fault" id="${name}-fault" role="alert" hidden></p>`;
  const [slider, field] = row.querySelectorAll("input");
  field.setAttribute("aria-label", `${name} as a number`);
  slider.addEventListener("input", () => set(name, values[slider.value]));
  field.addEventListener("input", () => {
    const text = field.value.trim(), wrong = fault(name, text);
    field.setAttribute("aria-invalid", Boolean(wrong));
    sayFault(name, wrong && `${wrong}; ${name} stays ${state[name]}`);
    if (!wrong) set(name, number(text));
  });
  field.addEventListener("change", () => show());
  if (name === "alpha") row.insertAdjacentHTML("beforeend", '<p class="ends"><span>spring</span><span>dashpot</span><span>mass</span></p>');
  return row;
}

function set(name, value) {
  state[name] = value;
  say([]);
  change();
}

// After any change: what belongs to alpha = 1/2, the controls, the link, a picture.
function change() {
  const wrong = settle(state);
  show();
  if (wrong) sayFault("alpha", wrong);
  clearTimeout(linkTimer);
  linkTimer = setTimeout(() => { // the hand rests
    remember();
    history.replaceState(null, "", wholeLink());
    showTour();
  }, 150);
  redraw();
}

// The controls say what the state is; what does not matter is not there.
function show() {
  const asked = [...parameters[state.potential], ...parameters[state.force]];
  const { half, kappa } = methods[state.method];
  for (const name in ranges) {
    const slider = element(`${name}-slider`), field = element(name), values = stops(name);
    let nearest = 0;
    values.forEach((value, i) => {
      if (Math.abs(value - state[name]) < Math.abs(values[nearest] - state[name])) nearest = i;
    });
    slider.value = nearest;
    slider.setAttribute("aria-valuetext", String(state[name]));
    const typing = field === document.activeElement && number(field.value.trim()) === state[name];
    if (!typing || fault(name, field.value.trim())) {
      field.value = state[name];
      field.setAttribute("aria-invalid", false);
      sayFault(name, "");
    }
    const row = slider.parentNode, frequency = name === "b" && state.force === "cosine";
    const unused = name === "alpha" && half ? `${state.method} knows only 1/2`
      : name === "kappa" && !kappa ? `not used by ${state.method}` : "";
    row.querySelector("span").textContent = unused || (frequency ? "frequency W" : notes[name]);
    row.hidden = "cgab".includes(name) && !asked.includes(name);
    slider.disabled = field.disabled = Boolean(unused);
  }
  for (const name in choices) element(name).value = state[name];
  element("own-row").hidden = state.potential !== "own";
  if (element("own") !== document.activeElement) element("own").value = state.own;
  element("past").disabled = Boolean(half);
  element("before").textContent = before(state);
  element("command").replaceChildren(...command(state).split(/ (?=--)/).flatMap(words => {
    const option = document.createElement("span"); // is not broken over two lines
    option.textContent = words;
    return [option, " "];
  }));
}

function build() {
  for (const place of document.querySelectorAll("[data-controls]"))
    place.append(...place.dataset.controls.split(" ").map(control));
  for (const name in choices) {
    element(name).append(...choices[name].map(word => new Option(spelled[word] ?? word, word)));
    element(name).addEventListener("input", () => set(name, element(name).value));
  }
  element("own").addEventListener("input", () => {
    const own = element("own").value, wrong = fvi.misprint({ ...state, own });
    element("own").setAttribute("aria-invalid", Boolean(wrong));
    sayFault("own", wrong && `${wrong}; U stays ${state.own}`);
    if (!wrong) set("own", own.replaceAll(/\s/g, ""));
  });
  element("own").addEventListener("change", () => {
    element("own").value = state.own;
    element("own").setAttribute("aria-invalid", false);
    sayFault("own", "");
  });
  element("look").addEventListener("input", () => {
    look = Number(element("look").value) / Math.max(result.rows - 1, 1);
    redraw();
  });
  const drag = event => {
    if (event.type === "pointermove" && event.buttons === 0) return;
    const pixel = event.clientX - element("x").getBoundingClientRect().left;
    look = Math.min(Math.max(motion.fraction(pixel), 0), 1);
    redraw();
  };
  element("x").addEventListener("pointerdown", event => {
    event.target.setPointerCapture(event.pointerId);
    drag(event);
  });
  element("x").addEventListener("pointermove", drag);
  element("reset").addEventListener("click", () => {
    state = parse("").state;
    look = middle;
    say([]);
    change();
  });
  window.addEventListener("hashchange", read);
  window.addEventListener("resize", redraw);
  const dress = () => { wear(chosen()); element("theme").textContent = chosen() === "dark" ? "Light" : "Dark"; redraw(); };
  night.addEventListener("change", dress);
  element("theme").addEventListener("click", () => {
    const theme = chosen() === "dark" ? "light" : "dark";
    try { localStorage.setItem("theme", theme); } catch { /* the cookie, then */ }
    document.cookie = `theme=${theme};max-age=31536000;path=/;samesite=lax`;
    dress();
  });
  dress();
}

// The link into the state; what is wrong with it is said, not hidden.
function read() {
  const { state: meant, wrong } = parse(location.hash);
  clearTimeout(linkTimer);
  const misprint = meant.potential === "own" && fvi.misprint(meant);
  if (misprint) {
    wrong.push(misprint);
    Object.assign(meant, { potential: "harmonic", own: defaults().own });
  }
  state = meant;
  if (meant.method !== "fvi" || meant.kappa !== 0.5) element("numerics").open = true;
  pinFrom(location.hash);
  remember();
  showTour();
  say(wrong.length ? [`This link is not all understood: ${wrong.join("; ")}`] : []);
  show();
  redraw();
}

async function begin() {
  fvi = await kernel(wasm);
  build();
  explain();
  read();
}
begin().catch(error => say([`The page could not start: ${error.message}`]));
