// chapters/live/test_live.mjs -- The numbers of the figures that move, against build/fvi.
//
//   node test_live.mjs BOOK PROGRAM [MOVES]      (part of make test-book)
//
// MOVES, if it is not there, is written: where each figure was moved to. A browser moves them
// there, and adds what they show; if it is there, it is this that is compared.
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import assert from "node:assert/strict";
import vm from "node:vm";

const [, , book, program, movesName] = process.argv, folder = `${book}/live`;
const read = name => vm.runInThisContext(readFileSync(`${folder}/${name}`, "utf8"), name);
["kernel.js", "live.js", ...readdirSync(folder).filter(name => !["kernel.js", "live.js"].includes(name))].forEach(read);
const { scenes, open, start, error } = vm.runInThisContext("FVI_LIVE");
const library = await open(vm.runInThisContext("FVI_WASM"));
const shown = movesName && existsSync(movesName) ? JSON.parse(readFileSync(movesName, "utf8")) : null, moves = [];
let tests = 0;
async function test(name, body) {
  try {
    await body();
  } catch (fault) {
    console.error(`not ok: ${name}`);
    throw fault;
  }
  tests++;
}

// What a figure computes when it is moved there, and says.
function moved(name, values) {
  const scene = scenes.get(name), all = { ...start(scene), ...values };
  moves.push({ name, values: { ...all } });
  if (shown) {
    const move = shown[moves.length - 1];
    assert.equal(move.name, name);
    return { ...move.data, said: move.said };
  }
  const data = scene.compute(all, library, scene);
  return { ...data, said: scene.says(data, all) };
}
// The columns of what the program prints.
function asked(words) {
  const { stdout, stderr } = spawnSync(program, words.split(" "), { encoding: "utf8", maxBuffer: 1 << 26 });
  const rows = stdout.split("\n").filter(line => line && !line.startsWith("#")).map(line => line.split("\t").map(Number));
  assert.ok(rows.length, stderr);
  return i => rows.map(row => row[i]);
}
// The digits of pow, exp, sin and the gamma function differ between the C libraries.
function near(got, want, tolerance, what) {
  assert.ok(Math.abs(got - want) <= tolerance, `${what}: ${got} is not ${want}`);
}
function nearAll(got, want, tolerance, what) {
  assert.equal(got.length, want.length, what);
  got.forEach((value, i) => near(value, want[i], tolerance, `${what}, ${i}`));
}

await test("every figure computes, and says what it found in a sentence", () => {
  for (const [name] of scenes) {
    const { said } = moved(name, {});
    assert.match(said, /\d.*\.$/, name);
    assert.doesNotMatch(said, /NaN|undefined|Infinity/, name);
  }
});

await test("04: weights and sums are the program's", () => {
  for (const order of [0.5, 0.13, 1.7, 2, 0]) {
    const { w, sums } = moved("coefficients_weights", { order });
    const want = asked(`coefficients --alpha ${order} --count 2001`)(1);
    assert.deepEqual([...w], want, `order ${order}`);
    want.reduce((sum, value, n) => (near(sums[n], sum + value, 1e-13, "sum"), sum + value), 0);
  }
});

await test("11: the motion is the program's, the pole a zero of Q", () => {
  for (const [alpha, rho] of [[0.25, 0.5], [0.75, 1.2], [0.5, 0.4]]) {
    const { x, re, im, swing, tail } = moved("exact_solution_plane", { alpha, rho });
    nearAll(x, asked(`exact --alpha ${alpha} --rho ${rho} --p0 0 --h 0.05 --steps 600 --columns x`)(0), 1e-13, "x");
    const size = Math.hypot(re, im) ** (2 * alpha), angle = 2 * alpha * Math.atan2(im, re);
    near(re * re - im * im + 1 + rho * size * Math.cos(angle), 0, 1e-13, "Re Q");
    near(2 * re * im + rho * size * Math.sin(angle), 0, 1e-13, "Im Q");
    swing.forEach((value, i) => near(value + tail[i], x[i], 1e-15, "the sum"));
    if (alpha === 0.5) tail.forEach(value => near(value, 0, 1e-13, "no tail"));
  }
});

await test("12: the exponentials keep the program's weights to the error that is asked for", () => {
  for (const [order, tolerance] of [[0.5, 1e-6], [0.1, 1e-2], [0.9, 1e-12]]) {
    const { worst, lags, size, Q } = moved("memory", { order, tolerance, N: 5000 });
    const w = asked(`coefficients --alpha ${order} --count 8192`)(1);
    lags.forEach((n, i) => assert.equal(size[i], -w[n]));
    assert.ok(worst <= tolerance + 1e-13 && worst > tolerance / 1e3, `${worst}`);
    assert.ok(Q < moved("memory", { order, tolerance: tolerance / 100, N: 5000 }).Q);
  }
});

await test("13, 17: errors are those of the program's runs, and the orders as proved", () => {
  for (const [name, methods, orders] of [["convolution_quadrature", ["fvi", "fvi-shifted", "fvi-bdf2"], [1, 2, 2]],
    ["lobatto", ["fvi-lobatto2", "fvi-lobatto3", "fvi-lobatto4"], [2, 3.5, 4.5]]]) {
    const found = moved(name, { k: 4 }), problem = "--alpha 0.75 --rho 1 --x0 0 --p0 0 --force step:8,1";
    methods.forEach((method, i) => {
      const grid = `${problem} --h 0.0625 --steps 128 --columns x`;
      const x = asked(`run ${grid} --method ${method}`)(0), exact = asked(`exact ${grid}`)(0);
      const worst = Math.max(...x.slice(32).map((value, k) => Math.abs(value - exact[k + 32])));
      near(found.errors[i][3], worst, 1e-9 * worst + 1e-12, method);
      near(found.orders[i], orders[i], 0.2, `order of ${method}`);
    });
  }
});

await test("14: the edge is where a run begins to grow", () => {
  for (const method of ["fvi", "fvi-shifted", "fvi-bdf2"]) {
    const { edge } = moved("stability_map", { method });
    const R = edge.R[60]; // alpha = 0.3
    for (const [share, grows] of [[0.8, false], [1.3, true]]) {
      const { x, load } = moved("stability_map", { method, alpha: 0.3, R: share * R });
      near(load, share, 1e-12, "load");
      const want = asked(`run --method ${method} --alpha 0.3 --rho ${share * R} --h 1 --steps 60 --p0 0 --potential harmonic:0.1 --columns x`)(0);
      nearAll(x, want, 1e-10 * Math.max(1, ...want.map(Math.abs)), method);
      const late = Math.max(...want.slice(50).map(Math.abs)), before = Math.max(...want.slice(30, 40).map(Math.abs));
      assert.equal(late > before, grows, `${method}, ${share}`);
    }
  }
});

await test("00, 09: runs are the program's", () => {
  const { x } = moved("springpot_run", { alpha: 0.3, rho: 0.7 });
  nearAll(x, asked("run --method fvi-lobatto4 --alpha 0.3 --rho 0.7 --p0 0 --h 0.1 --steps 300 --columns x")(0), 1e-12, "springpot");
  const { printed, held } = moved("fvi_kick", { h: 0.05, alpha: 0.8 }), words = "--alpha 0.8 --p0 0 --h 0.05 --steps 300 --columns x --memory direct";
  nearAll(held, asked(`run ${words}`)(0), 1e-12, "held");
  nearAll(printed, asked(`run ${words} --derivative rl`)(0), 1e-11, "printed");
});

await test("01, 05, 07: the sums are those of the program's weights", () => {
  const { derivative, kernel } = moved("fractional_derivative_kernel", { order: 0.4 });
  const w = asked("coefficients --alpha 0.4 --count 601")(1);
  near(derivative[600], w.reduce((sum, value, n) => sum + value * Math.sin((600 - n) * 0.01), 0) * 100 ** 0.4, 1e-11, "derivative");
  near(kernel[39], 1 / 1.4891922488128171, 1e-14, "1 / Gamma(0.6)");
  const { x, back, ahead, sums } = moved("integration_by_parts", { alpha: 0.4 });
  near(back[200], w.slice(0, 201).reduce((sum, value, n) => sum + value * x[200 - n], 0) * 100 ** 0.4, 1e-11, "retarded");
  near(ahead[100], w.slice(0, 201).reduce((sum, value, n) => sum + value * x[100 + n], 0) * 100 ** 0.4, 1e-11, "advanced");
  near(sums[0], sums[1], 1e-12, "the two sums");
  assert.ok(moved("half_derivative", { alpha: 0.5 }).apart < 1e-10 && moved("half_derivative", { alpha: 0.45 }).apart > 0.1);
});

await test("a scene of two thousand steps takes less than a sixtieth of a second, but for a slow machine's sake a tenth", () => {
  const scene = scenes.get("fvi_kick"), values = { ...start(scene), h: 0.0075 };
  scene.compute(values, library, scene);
  const began = performance.now();
  scene.compute(values, library, scene);
  const took = performance.now() - began;
  console.log(`  two runs of 2000 steps: ${took.toFixed(1)} ms`);
  assert.ok(took < 100);
});

console.log(`figures that move: ${tests} tests, ${scenes.size} figures`);
if (movesName && !shown) writeFileSync(movesName, JSON.stringify(moves));
