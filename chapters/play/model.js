// chapters/play/model.js -- The state of the page, its link, and the C behind it.
// Nothing here knows of a document: test_play.mjs runs the same lines in node.

// What a run is made of. Names, words and defaults are those of `build/fvi run`.
const choices = {
  method: ["fvi", "lda", "euler-explicit", "euler-implicit"],
  potential: ["harmonic", "duffing", "pendulum", "free"],
  force: ["none", "step", "cosine"],
  derivative: ["rl", "caputo"],
};
// [least, most, default, step of the slider]; "log": the slider moves by ratios.
const ranges = {
  alpha: [0, 1, 0.5, 0.005],
  rho: [0, 4, 0.2, 0.01],
  h: [0.001, 3, 0.1, "log"],
  steps: [10, 4000, 200, "log"],
  kappa: [0, 1, 0.5, 0.01],
  x0: [-4, 4, 1, 0.01],
  p0: [-4, 4, 0.5, 0.01],
  c: [0, 10, 1, 0.05],
  g: [0, 10, 0.5, 0.05],
  a: [-10, 10, 1, 0.1],
  b: [0, 10, 1, 0.05],
};
// The order of the numbers in `input` of play.c.
const fields = ["method", "alpha", "rho", "potential", "c", "g", "force", "a", "b", "derivative",
  "kappa", "x0", "p0", "h", "steps"];
// The parameters that a word takes: harmonic:C, duffing:C,G, step:A,T, cosine:A,W.
const parameters = {
  harmonic: ["c"], duffing: ["c", "g"], pendulum: ["c"], free: [],
  none: [], step: ["a", "b"], cosine: ["a", "b"],
};

function defaults() {
  const state = {};
  for (const name in choices) state[name] = choices[name][0];
  for (const name in ranges) state[name] = ranges[name][2];
  return state;
}

// A number as the program reads one, or NaN; never "", "0,5", "1e", "Infinity".
function number(text) {
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text) ? Number(text) : NaN;
}

// Why `value` cannot be the number called `name`; "" if it can.
function fault(name, text) {
  const value = number(String(text)), [least, most] = ranges[name];
  if (!Number.isFinite(value)) return `${name}: '${text}' is not a finite number`;
  if (value < least || value > most) return `${name}: '${text}' is outside [${least}, ${most}]`;
  if (name === "steps" && !Number.isInteger(value)) return `${name}: '${text}' is not a whole number`;
  return "";
}

// The values at which a slider can stand. "log": ten to a decade, rounded.
function stops(name) {
  const [least, most, , step] = ranges[name], values = [];
  if (step !== "log") {
    for (let i = 0; i <= Math.round((most - least) / step); i++)
      values.push(Number((least + i * step).toFixed(3)));
    return values;
  }
  for (let decade = -3; decade <= 3; decade++)
    for (const digits of [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8]) {
      const value = Number((digits * 10 ** decade).toPrecision(2));
      if (value >= least && value <= most) values.push(value);
    }
  return values;
}

// ---- the link: #alpha=0.75&potential=duffing:1,0.5&... ----

// One word of the link into the state; returns what is wrong with it, or "".
function take(state, name, text) {
  if (Object.hasOwn(ranges, name) && !"cgab".includes(name)) {
    const wrong = fault(name, text);
    if (!wrong) state[name] = number(text);
    return wrong;
  }
  if (!Object.hasOwn(choices, name)) return `${name}: there is no such parameter`;
  const [word, ...rest] = text.split(":"), values = rest.length ? rest.join(":").split(",") : [];
  if (!choices[name].includes(word)) return `${name}: '${text}' is none of ${choices[name].join(", ")}`;
  const wanted = parameters[word] ?? [];
  if (values.length !== wanted.length)
    return `${name}: '${text}' has ${values.length} numbers, not ${wanted.length}`;
  for (let i = 0; i < wanted.length; i++) {
    const wrong = fault(wanted[i], values[i]);
    if (wrong) return `${name}: ${wrong}`;
  }
  wanted.forEach((parameter, i) => { state[parameter] = number(values[i]); });
  state[name] = word;
  return "";
}

// What is known of alpha = 1/2 only says so, as the program does.
function settle(state) {
  if (state.method === "fvi" || state.alpha === 0.5) return "";
  const wrong = `alpha: ${state.method} knows only 0.5, not ${state.alpha}`;
  state.alpha = 0.5;
  return wrong;
}

// The state that a link means, and a list of complaints; what is wrong or not
// there has its default.
function parse(hash) {
  const state = defaults(), wrong = [], seen = new Set();
  for (const pair of hash.replace(/^#/, "").split("&").filter(Boolean)) {
    const equals = pair.indexOf("=");
    let name = pair.slice(0, Math.max(equals, 0)), text = pair.slice(equals + 1), complaint;
    try {
      text = decodeURIComponent(text);
      if (equals < 1) complaint = `'${text}' is not name=value`;
      else if (seen.has(name)) complaint = `${name}: given twice`;
      else complaint = take(state, name, text);
    } catch {
      complaint = `'${pair}' is not a link's text`;
    }
    seen.add(name);
    if (complaint) wrong.push(complaint);
  }
  const complaint = settle(state);
  if (complaint) wrong.push(complaint);
  return { state, wrong };
}

// name -> value as text, for every option of the program.
function words(state) {
  const call = word => word + (parameters[word].length ? ":" : "")
    + parameters[word].map(name => state[name]).join(",");
  return {
    method: state.method, alpha: state.alpha, rho: state.rho, potential: call(state.potential),
    force: call(state.force), derivative: state.derivative, kappa: state.kappa, x0: state.x0,
    p0: state.p0, h: state.h, steps: state.steps,
  };
}

// What differs from the defaults, as a link and as a command.
function changes(state) {
  const usual = words(defaults());
  return Object.entries(words(state)).filter(([name, value]) => value !== usual[name]);
}
function link(state) {
  return "#" + changes(state).map(([name, value]) => `${name}=${value}`).join("&");
}
function command(state) {
  return ["build/fvi run", ...changes(state).map(([name, value]) => `--${name} ${value}`),
    "--memory direct"].join(" ");
}

// ---- the C ----

// The functions of play.c, from the bytes of the module.
async function kernel(bytes) {
  const { instance: { exports: c } } = await WebAssembly.instantiate(bytes, {});
  const array = (which, length) => new Float64Array(c.memory.buffer, c.play_array(which), length);
  return {
    // Everything that the page shows of a state. The arrays are views: read them
    // before the next call.
    run(state, exactPoints = 400) {
      new Float64Array(c.memory.buffer, c.play_input(), fields.length).set(fields.map(name =>
        name in choices ? choices[name].indexOf(state[name]) : state[name]));
      const rows = c.play_run(), every = Math.max(1, Math.ceil(state.steps / exactPoints));
      const exact = c.play_exact(every), count = state.steps + 1;
      const known = state.method === "fvi" || state.method === "lda";
      c.play_weights(count);
      return {
        rows, every,
        load: known ? c.play_load() : NaN, largest: known ? c.play_step() : NaN,
        x: array(0, rows), p: array(1, rows), energy: array(2, rows), weights: array(3, count),
        exact: { t: array(4, exact), x: array(5, exact), v: array(6, exact) },
      };
    },
  };
}
