// chapters/play/model.js -- The state of the page, its link, and the C behind it.
// Nothing here knows of a document: test_play.mjs runs the same lines in node.

// What a method takes. kappa: it takes U at kappa x_k + (1 - kappa) x_{k+1}; half: it knows
// alpha = 1/2 only; printed: it runs also what has no solution, as the paper does; stages: of
// a step, and its weights are those of velocities; bound: the equation that says when it is
// stable.
const methods = {
  "fvi": { kappa: true, printed: true, bound: "(14.3)" },
  "lda": { kappa: true, half: true, bound: "(14.3)" },
  "euler-explicit": { half: true, bound: "(10.4)" },
  "euler-implicit": { half: true, bound: "(10.4)" },
  "fvi-shifted": { kappa: true, bound: "(13.14)" },
  "fvi-bdf2": { kappa: true, bound: "(13.14)" },
  "fvi-lobatto2": { stages: 2, bound: "(17.15)" },
  "fvi-lobatto3": { stages: 3, bound: "(17.15)" },
  "fvi-lobatto4": { stages: 4, bound: "(17.15)" },
};
// What a run is made of. Names, words and defaults are those of `build/fvi run`.
const choices = {
  method: Object.keys(methods),
  potential: ["harmonic", "duffing", "pendulum", "free", "own"], // own: an expression in x
  force: ["none", "step", "cosine"],
  past: ["held", "caputo", "rl"],
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
const fields = ["method", "alpha", "rho", "potential", "c", "g", "force", "a", "b", "past",
  "kappa", "x0", "p0", "h", "steps"];
// The parameters that a word takes: harmonic:C, duffing:C,G, step:A,T, cosine:A,W.
const parameters = {
  harmonic: ["c"], duffing: ["c", "g"], pendulum: ["c"], free: [], own: [],
  none: [], step: ["a", "b"], cosine: ["a", "b"],
};

// What a link without a word shows: the defaults, but with a memory.
const first = "alpha=0.3";

function defaults() {
  const state = {};
  for (const name in choices) state[name] = choices[name][0];
  for (const name in ranges) state[name] = ranges[name][2];
  state.own = "x^4/4-x^2/2";
  return state;
}

// Why a text cannot be an expression, at a glance: the C understands it, or says where it does not.
function strange(text) {
  if (!text.trim()) return "U: there is nothing";
  if (text.length > 200) return "U: more than 200 letters";
  const [letter] = /[^\w\s.+\-*/^()]/.exec(text) ?? [];
  return letter ? `U: '${letter}' is in no expression` : "";
}

// A number as the program reads one, or a fraction such as 1/3, or NaN; never "", "0,5",
// "1e", "Infinity".
function number(text) {
  const parts = /^(\d{1,6})\/(\d{1,6})$/.exec(text);
  if (parts) return parts[2] > 0 ? parts[1] / parts[2] : NaN;
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
  if (name === "potential" && !choices.potential.slice(0, -1).includes(text.split(":")[0])) {
    const wrong = strange(text);
    if (wrong) return `potential: '${text}' is none of ${choices.potential.slice(0, -1).join(", ")}, and no expression: ${wrong}`;
    Object.assign(state, { potential: "own", own: text.replaceAll(/\s/g, "") });
    return "";
  }
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
  if (!methods[state.method].half || state.alpha === 0.5) return "";
  const wrong = `alpha: ${state.method} knows only 0.5, not ${state.alpha}`;
  state.alpha = 0.5;
  return wrong;
}

// The state that a link means, and a list of complaints; what is wrong or not
// there has its default.
function parse(hash) {
  const state = defaults(), wrong = [], seen = new Set();
  for (const pair of (hash.replace(/^#/, "").replace(/&pin=[^&]*/, "") || first).split("&").filter(Boolean)) {
    const equals = pair.indexOf("=");
    let name = pair.slice(0, Math.max(equals, 0)), text = pair.slice(equals + 1), complaint;
    try {
      text = decodeURIComponent(text);
      if (name === "derivative") name = "past"; // as older links call it
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

// name -> value as text, for every number and word of the link.
function words(state) {
  const call = word => word === "own" ? state.own : word + (parameters[word].length ? ":" : "")
    + parameters[word].map(name => state[name]).join(",");
  return {
    method: state.method, alpha: state.alpha, rho: state.rho, potential: call(state.potential),
    force: call(state.force), past: state.past, kappa: state.kappa, x0: state.x0,
    p0: state.p0, h: state.h, steps: state.steps,
  };
}

// What differs from the defaults, as a link and as a command.
function changes(state) {
  const usual = words(defaults());
  return Object.entries(words(state)).filter(([name, value]) => value !== usual[name]);
}
function link(state) {
  return "#" + (changes(state).map(([name, value]) => `${name}=${value}`).join("&") || `alpha=${state.alpha}`);
}
function command(state) {
  const option = name => name === "past" ? "derivative" : name;
  const quoted = value => /[()*^]/.test(value) ? `'${value}'` : value; // from the shell
  const taken = ([name]) => name !== "kappa" || methods[state.method].kappa; // the program refuses it, too
  return ["build/fvi run", ...changes(state).filter(taken).map(([name, value]) => `--${option(name)} ${quoted(value)}`),
    ...methods[state.method].stages ? [] : ["--memory direct"]].join(" ");
}

// ---- what is known of a run ----

// What the body did before t = 0, and so on what D acts.
function before({ past, alpha, rho, x0 }) {
  if (rho === 0) return "Without damping the past does not matter.";
  if (alpha === 0.5) return "D is d/dt, without memory: all three pasts have the same future.";
  if (past === "held")
    return `It rested at x0 and was let go with p0: D acts on x − x0.${alpha < 0.5 ? " So does Caputo’s here." : ""}`;
  if (past === "caputo")
    return alpha > 0.5 ? "It came along the straight line of its start: D acts on x − x0 − t v0."
      : "D acts on x − x0, as if held; the straight line matters for α > 1/2.";
  return `It was at 0, then put at x0: D acts on x.${x0 === 0 ? " With x0 = 0 that is held." : ""}`;
}

// Why there is no exact curve; "" if there is one.
function lacking({ method, potential }, { solvable, exact }) {
  if (solvable)
    return exact.x.length ? "" : potential === "own" ? "No exact curve: no formula is looked for where U is typed." : `No exact curve: U of ${potential} is not quadratic, and no formula is known.`;
  return "This problem has no solution: for α > 1/2 the damping answers the jump from 0 to x0 with an infinite impulse. "
    + (methods[method].printed ? `${method} runs it, as Algorithm 3 is printed: another h, another curve.`
      : `${method} refuses it.`) + " Take another past, or x0 = 0.";
}

const short = value => Number.isFinite(value) ? String(Number(value.toPrecision(5))) : String(value);

// What each moment j <= k adds to rho D x at step k: a weight times x_j less what the past makes
// of it; of stages, times a step's change of x. (5.1), (17.9)
function parts(state, { x, weights }, k) {
  const { method, alpha, rho, h, past, x0, p0 } = state, scale = rho * h ** (-2 * alpha);
  const less = j => past === "rl" ? 0 : x0 + (past === "caputo" && alpha > 0.5 ? j * h * p0 : 0);
  const of = methods[method].stages ? j => (j > 0 ? x[j] - x[j - 1] : 0) : j => x[j] - less(j);
  return Array.from({ length: k + 1 }, (_, j) => scale * weights[k - j] * of(j));
}

// The weight of what was n steps ago falls like n to this power.
const decay = ({ method, alpha }) => methods[method].stages ? -2 * alpha : -1 - 2 * alpha;

// Is the step stable? { text, crossed, load, largest }, from the load and the largest step
// that the C says; load is NaN where there is none.
function stability(state, load, largest, solvable) {
  const { method, potential, alpha, rho, h } = state, { half, kappa, printed, stages, bound } = methods[method];
  const linear = potential === "harmonic" || potential === "free";
  const upTo = largest === 0 ? "no step is stable" : largest === Infinity ? "every step is stable"
    : `stable up to h = ${short(largest)}`;
  if (half && !kappa) { // Euler
    const hh = potential === "harmonic" ? h * h * state.c : 0;
    const areas = method === "euler-explicit" ? 1 - h * rho + hh : 1 / (1 + h * rho + hh);
    const crossed = linear && Math.abs(areas) > 1, by = `a step multiplies areas by ${short(areas)}`;
    return { crossed, load: NaN, largest, text: !linear
      ? "stability: nothing is said here of Euler's methods and this U"
      : `${crossed ? "unstable" : "stability"}: ${by}, by ${bound}` };
  }
  const local = !linear && (stages || state.kappa !== 0.5), where = local ? ", for small motions about x0" : "";
  if (local && potential === "pendulum" && Math.cos(state.x0) < 0 && !(load > 1))
    return { crossed: false, load: NaN, largest, text: "stability: nothing is said here, as U″ < 0 at x0" };
  if (local && potential === "own")
    return { crossed: false, load: NaN, largest, text: "stability: nothing is said here of a U that is typed" };
  const spring = stages && rho > 0 && alpha < 0.5;
  if (spring && stages > 2 && alpha > 0)
    return { crossed: false, load: NaN, largest, text: `stability: no formula is known for ${stages} stages and `
      + `0 < α < 1/2; without damping ${upTo}, by ${bound}${where}` };
  const from = spring && stages === 2 ? "(17.16)" : bound, crossed = load > 1;
  // With (17.15) damping may help; three and four stages are stable again beyond a gap.
  const sure = !stages || (stages === 2 && (rho === 0 || alpha < 0.5 || alpha === 1));
  if (!solvable && !(printed && crossed))
    return { crossed, load: NaN, largest, text: "stability: nothing is said, as there is no motion to stay near" };
  const now = crossed ? `${sure ? "unstable" : "beyond the bound"}: load ${short(load)} is above 1`
    : `stability: load ${short(Math.max(load, 0))} of 1`;
  return { crossed, load, largest, text: `${now}; ${upTo}, by ${from}${where}` };
}

// ---- the C ----

// The bytes of the module: deflated, then in base64.
async function unpack(text) {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

// What wasm.py says to be absent, as no page reaches it.
const absent = new Proxy({}, { get: (_, name) => () => { throw new Error(`${name} is not in this page`); } });

// The functions of play.c.
async function kernel(text) {
  const { instance: { exports: c } } = await WebAssembly.instantiate(await unpack(text), { env: absent });
  const array = (which, length) => new Float64Array(c.memory.buffer, c.play_array(which), length);
  const write = state => {
    new Float64Array(c.memory.buffer, c.play_input(), fields.length).set(fields.map(name =>
      name in choices ? choices[name].indexOf(state[name]) : state[name]));
    const letters = new TextEncoder().encode(state.own.slice(0, 200) + "\0");
    new Uint8Array(c.memory.buffer, c.play_text(), letters.length).set(letters);
  };
  return {
    c,
    // What is wrong with the expression of a state, "" if nothing.
    misprint(state) {
      const glance = strange(state.own);
      write({ ...state, potential: "own" });
      const bytes = new Uint8Array(c.memory.buffer, c.play_wrong()), reason = String.fromCharCode(...bytes.slice(0, bytes.indexOf(0)));
      const rest = state.own.slice(c.play_wrong_at());
      return glance || (reason && `U: ${reason}${rest ? `, at '${rest}'` : ", at its end"}`);
    },
    // Everything that the page shows of a state. The arrays are views: read them
    // before the next call.
    run(state, points = 400) {
      write(state);
      const every = Math.ceil(state.steps / points), parts = Math.floor(Math.max(1, points / state.steps));
      const solvable = Boolean(c.play_solvable()), rows = c.play_run(), exact = c.play_exact(every, parts), count = state.steps + 1;
      c.play_weights(count);
      return {
        solvable, rows, every, parts, stability: stability(state, c.play_load(), c.play_step(), solvable),
        x: array(0, rows), p: array(1, rows), energy: array(2, rows), weights: array(3, count),
        exact: { t: array(4, exact), x: array(5, exact), v: array(6, exact) },
      };
    },
  };
}
