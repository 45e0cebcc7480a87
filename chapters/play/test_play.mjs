// chapters/play/test_play.mjs -- The numbers of the page are those of build/fvi.
//
//   node test_play.mjs PAGE FVI      (make test-play)
//
// PAGE is chapters/play/index.html as it is committed: its WebAssembly and its
// model.js are what is run here.
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import assert from "node:assert/strict";
import vm from "node:vm";

const [, , pageName, program] = process.argv;
const page = readFileSync(pageName, "utf8");
const source = name => readFileSync(fileURLToPath(new URL(name, import.meta.url)), "utf8");
const [, wasm, model] = page.match(/<script>const wasm = "([^"]*)";<\/script>\n<script>\n([^]*?)<\/script>/);
vm.runInThisContext(model);
const { choices, ranges, defaults, stops, fault, parse, link, command, kernel } =
  vm.runInThisContext("({ choices, ranges, defaults, stops, fault, parse, link, command, kernel })");
const bytes = Buffer.from(wasm, "base64"), fvi = await kernel(bytes);
const U = 2 ** -53;

// The rows of a command of the program, numbers as it printed them, and what it said.
function rows(words) {
  const { stdout, stderr, error } = spawnSync(program, words, { encoding: "utf8", maxBuffer: 1 << 26 });
  if (error) throw error;
  const lines = stdout.split("\n").filter(line => line && !line.startsWith("#"));
  const number = text => Number(text.replace("inf", "Infinity")); // an energy may overflow
  return { table: lines.map(line => line.split("\t").map(number)), said: stderr };
}
const ran = state => rows(command(state).split(" ").slice(1));
function meant(hash) {
  const { state, wrong } = parse(hash);
  assert.deepEqual(wrong, [], hash);
  return state;
}

let tests = 0;
async function test(name, body) {
  try {
    await body();
  } catch (error) {
    console.error(`not ok: ${name}`);
    throw error;
  }
  tests++;
}

// ---- values ----

// Where only + - * / and fma occur, all 17 digits. pow(h, 1 - 2 alpha) is a power of
// two for h = 1/16 and alpha = k/8, and both libraries' pow is exact there: its error
// before the last rounding is below 2^-60. alpha = 1/2 asks for pow(h, 0) = 1.
await test("every digit of t, x, p and energy where no function is rounded", () => {
  let runs = 0;
  const forces = ["none", "step:2,1"], potentials = ["harmonic:1", "harmonic:3.3", "duffing:1,0.7", "free"];
  const same = hash => {
    const state = meant(hash), { table } = ran(state), run = fvi.run(state);
    assert.equal(run.rows, table.length, hash);
    table.forEach((row, k) =>
      assert.deepEqual([k * state.h, run.x[k], run.p[k], run.energy[k]], row, `${hash} k=${k}`));
    runs++;
  };
  for (let eighths = 0; eighths <= 8; eighths++)
    for (const potential of potentials)
      for (const force of forces)
        for (const rest of ["derivative=rl&kappa=0.5", "derivative=caputo&kappa=0.3&rho=0.9&steps=333"])
          same(`#alpha=${eighths / 8}&h=0.0625&potential=${potential}&force=${force}&${rest}`);
  for (const method of choices.method)
    for (const potential of potentials)
      same(`#method=${method}&potential=${potential}&force=step:-1,0.7&h=0.083&x0=1.7&p0=-0.3`);
  console.log(`  ${runs} runs, every digit`);
});

// With pow, sin or cos the two libraries may differ by an ulp. In one step of either
// that, and the roundings which then fall otherwise, change
//   x by at most e_x = 4 u |dx| + u |x| <= 9 u X,
//   p by at most e_p = u (4 P + h 8 (|F| + C X) + f 2 X (N/8 + 16)),
// u = 2^-53, X = max|x|, P = max|p|, f = rho h^(1 - 2 alpha), sum |w_n| <= 2, a sum of
// up to N/8 + 3 terms in each of eight lanes. A change of x or p by 1 at step j changes
// x_k by at most G_x, G_p, the largest answers to (x0, p0) = (1, 0) and (0, 1): measured
// on the kernel for a linear run; for a pendulum with friction at most e^t, as |cos| <= 1.
// Two runs differ by at most 2 N (G_x e_x + G_p e_p). Seen: see the line it prints.
await test("else to the rounding of pow, sin and cos", () => {
  const most = values => values.reduce((m, v) => Math.max(m, Math.abs(v)), 0);
  let worst = 0, share = 0, equal = 0, all = 0;
  for (const hash of ["#alpha=0.3&x0=0", "#alpha=0.3", "#alpha=0.37&h=0.013&steps=2000&x0=0&rho=1.3",
    "#alpha=0.81&h=0.07&rho=0.6&x0=0&force=step:8,1", "#alpha=0.75&h=0.3&kappa=0.2&derivative=caputo",
    "#alpha=0.9&derivative=caputo&potential=free&steps=500", "#alpha=0.6&x0=0&p0=0&force=cosine:1,2",
    "#alpha=0.2&force=cosine:0.7,1.3&potential=harmonic:2.2&steps=1000", "#force=cosine:3,0.9",
    "#potential=pendulum:1&x0=2&h=0.0625&steps=64", "#potential=pendulum:1&rho=0&x0=3&h=0.03&steps=128",
    "#potential=pendulum:1&method=lda&h=0.05&steps=80"]) {
    const state = meant(hash), { table } = ran(state), N = state.steps, h = state.h;
    const answer = (x0, p0) => {
      const run = fvi.run({ ...state, x0, p0, force: "none", derivative: "rl" });
      return [most(run.x), most(run.p)];
    };
    const growth = Math.exp(N * h), nonlinear = state.potential === "pendulum";
    const gx = nonlinear ? [growth, growth] : answer(1, 0), gp = nonlinear ? [growth, growth] : answer(0, 1);
    const run = fvi.run(state), X = most(run.x), P = most(run.p);
    const C = state.potential === "free" ? 0 : state.c, F = state.force === "none" ? 0 : Math.abs(state.a);
    const f = state.rho * h ** (1 - 2 * state.alpha);
    const ex = 9 * U * X, ep = U * (4 * P + h * 8 * (F + C * X) + f * 2 * X * (N / 8 + 16));
    table.forEach(([, x, p], k) => {
      const bound = [0, 1].map(i => 2 * N * (gx[i] * ex + gp[i] * ep));
      const off = [Math.abs(run.x[k] - x), Math.abs(run.p[k] - p)];
      assert.ok(off[0] <= bound[0] && off[1] <= bound[1], `${hash} k=${k}: off by ${off}, bound ${bound}`);
      worst = Math.max(worst, off[0] / X, off[1] / P);
      share = Math.max(share, off[0] / bound[0], off[1] / bound[1]);
      equal += off[0] === 0 && off[1] === 0;
      all++;
    });
  }
  console.log(`  ${equal} of ${all} rows to every digit, worst ${worst.toExponential(1)} relative, `
    + `${share.toExponential(1)} of the bound`);
});

// Each of the two is within 4e-14 max|x| of the truth (src/exact_solution.h).
await test("the exact solution is that of fvi exact", () => {
  let worst = 0;
  for (const hash of ["#", "#alpha=0.25", "#alpha=0.75&rho=1&x0=0&p0=0&force=step:8,1&h=0.05&steps=400",
    "#alpha=0.9&derivative=caputo", "#alpha=0.3&force=cosine:1,1&steps=900", "#potential=free&alpha=0.4&x0=0",
    "#alpha=1&x0=0", "#alpha=0"]) {
    const state = meant(hash), words = command(state).replace(/ --memory direct/, "").split(" ").slice(2);
    const { table } = rows(["exact", ...words]), { exact, every } = fvi.run(state);
    const X = Math.max(...table.map(row => Math.abs(row[1])));
    assert.equal(exact.x.length, Math.floor(state.steps / every) + 1, hash);
    exact.x.forEach((x, i) => {
      const off = Math.abs(x - table[i * every][1]) / X;
      worst = Math.max(worst, off);
      assert.ok(off <= 8e-14, `${hash} i=${i}: off by ${off} max|x|`);
    });
  }
  for (const hash of ["#potential=duffing:1,1", "#potential=pendulum:1", "#alpha=0.75"])
    assert.equal(fvi.run(meant(hash)).exact.x.length, 0, hash);
  console.log(`  worst ${worst.toExponential(1)} max|x|`);
});

await test("every digit of the weights", () => {
  for (const alpha of [0, 0.005, 0.25, 0.3, 0.5, 0.775, 0.995, 1]) {
    const { table } = rows(["coefficients", "--alpha", 2 * alpha, "--count", 4001]);
    const { weights } = fvi.run({ ...defaults(), alpha, steps: 4000 });
    table.forEach(([n, w]) => assert.equal(weights[n], w, `alpha=${alpha} n=${n}`));
  }
});

// (14.3) in one dimension: three roundings and two pow of at most 1 ulp each.
await test("eq_14_3_the_load is the formula, and the program warns where it is above 1", () => {
  let crossed = 0;
  for (const hash of ["#", "#alpha=1&rho=0.99", "#alpha=1&rho=1.01", "#kappa=0&h=1.9&rho=0",
    "#kappa=0&h=2.1&rho=0", "#alpha=0.75&rho=1&h=2.1", "#alpha=0.25&rho=4&h=0.4&kappa=1",
    "#method=lda&rho=3&h=0.6", "#method=lda&rho=4&h=0.6"]) {
    const state = meant(hash), { alpha, rho, h, kappa, c } = state, run = fvi.run(state);
    const load = ((1 - 2 * kappa) ** 2 * h * h * c + 4 ** alpha * h ** (2 - 2 * alpha) * rho) / 4;
    assert.ok(Math.abs(run.load - load) <= 16 * U * load, `${hash}: ${run.load}, not ${load}`);
    assert.equal(ran(state).said.includes("unstable"), run.load > 1, hash);
    crossed += run.load > 1;
    if (Number.isFinite(run.largest) && run.largest > 0)
      assert.ok(Math.abs(fvi.run({ ...state, h: run.largest }).load - 1) < 1e-13, hash);
  }
  assert.equal(crossed, 4);
  assert.ok(Number.isNaN(fvi.run(meant("#method=euler-explicit")).load));
});

await test("a run that blows up ends where the program ends", () => {
  const state = meant("#kappa=0&h=3&steps=4000"), { table, said } = ran(state), run = fvi.run(state);
  assert.ok(run.rows < 4001);
  assert.equal(run.rows, table.length);
  assert.match(said, new RegExp(`step ${run.rows}: a value is no longer finite`));
});

// ---- the link and the sliders ----

await test("a link is the state, whatever it is", () => {
  assert.equal(link(defaults()), "#");
  const pick = values => values[Math.floor(random() * values.length)];
  let seed = 1;
  const random = () => (seed = seed * 48271 % 2147483647) / 2147483647;
  for (let i = 0; i < 500; i++) {
    const state = defaults();
    for (const name in choices) state[name] = pick(choices[name]);
    for (const name in ranges) state[name] = pick(stops(name));
    if (state.method !== "fvi") state.alpha = 0.5;
    const again = meant(link(state));
    assert.equal(link(again), link(state));
    assert.equal(command(again), command(state));
    assert.ok(fvi.run({ ...state, steps: 10 }).rows > 0);
  }
});

await test("a slider cannot stand outside its range", () => {
  for (const name in ranges) {
    const values = stops(name), [least, most, usual] = ranges[name];
    values.forEach((value, i) => assert.ok(fault(name, value) === "" && (i === 0 || value > values[i - 1])));
    assert.deepEqual([values[0], values.at(-1)], [least, most], name);
    assert.ok(values.includes(usual), name);
  }
});

await test("nonsense in a link is named, and has its default", () => {
  const cases = [
    ["alpha=1.5", "alpha: '1.5' is outside [0, 1]"], ["alpha=", "alpha: '' is not a finite number"],
    ["alpha=0,5", "alpha: '0,5' is not a finite number"], ["alpha=NaN", "'NaN' is not a finite number"],
    ["rho=-1", "outside [0, 4]"], ["h=0", "outside [0.001, 3]"], ["h=1e999", "'1e999' is not a finite"],
    ["h=Infinity", "is not a finite"], ["h=0x10", "is not a finite"], ["steps=20.5", "is not a whole number"],
    ["steps=1e9", "outside [10, 4000]"], ["colour=red", "colour: there is no such parameter"],
    ["c=2", "c: there is no such parameter"], ["method=magic", "'magic' is none of fvi"],
    ["potential=harmonic", "has 0 numbers, not 1"], ["potential=duffing:1", "has 1 numbers, not 2"],
    ["potential=harmonic:x", "'x' is not"], ["potential=free:1", "has 1 numbers, not 0"],
    ["force=step:99,1", "a: '99' is outside"], ["force=step:1,-1", "b: '-1' is outside"],
    ["method=lda&alpha=0.25", "lda knows only 0.5"], ["rho=1&rho=2", "given twice"],
    ["alpha", "is not name=value"], ["=1", "is not name=value"], ["alpha=%", "is not a link's text"],
    ["__proto__=1", "no such parameter"], ["toString=1", "no such parameter"],
    ["derivative=constructor", "is none of"], ["<img onerror=x>", "no such parameter"],
  ];
  for (const [hash, complaint] of cases) {
    const { state, wrong } = parse("#" + hash);
    assert.ok(wrong.length === 1 && wrong[0].includes(complaint), `${hash}: ${wrong}`);
    if (!hash.startsWith("rho=1")) assert.equal(link(state).replace("method=lda", ""), "#", hash);
  }
  const { state, wrong } = parse("#alpha=7&rho=1.5&nonsense&&h=0.02");
  assert.equal(wrong.length, 2);
  assert.equal(link(state), "#rho=1.5&h=0.02");
});

// ---- the file ----

await test("the page is one file, up to date, that asks nobody for anything", () => {
  assert.deepEqual(WebAssembly.Module.imports(new WebAssembly.Module(bytes)), []);
  let want = source("page.html").replace("{wasm}", () => wasm);
  for (const name of ["model.js", "plot.js", "play.js"])
    want = want.replace(`{${name}}`, () => source(name).trim());
  assert.equal(page, want, "chapters/play/index.html is older than its parts: make play");
  assert.doesNotMatch(page.replace(wasm, ""), /https?:|\bsrc=|\bimport\b|@import|url\(|fetch\(/);
  for (const [, hash] of page.matchAll(/href="(#[^"]*)"/g)) meant(hash.replaceAll("&amp;", "&"));
  assert.ok(page.length < 150e3);
});

await test("a run of 2000 steps with all that belongs to it takes less than a frame", () => {
  const state = meant("#alpha=0.3&x0=0&steps=2000&h=0.01"), times = [];
  for (let i = 0; i < 15; i++) {
    const began = performance.now();
    fvi.run(state);
    times.push(performance.now() - began);
  }
  const median = times.sort((a, b) => a - b)[7];
  console.log(`  ${median.toFixed(1)} ms`);
  assert.ok(median < 20);
});

const { length } = bytes;
console.log(`the live page: ${tests} tests passed; ${length} bytes of WebAssembly, no imports`);
