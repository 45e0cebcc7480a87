// H 18: work and precision, measured where this is read.
{
const methods = { "fvi": ["run", []], "fvi-shifted": ["negative", [8, 4]], "fvi-bdf2": ["positive", [2, 3]], "fvi-lobatto3": ["past", [8, 3, 2, 3]] };
const steps = [16, 32, 64, 128, 256, 512, 1024, 2048], names = Object.keys(methods);
const plate = { potential: "harmonic", c: 1, rho: 1, x0: 0, p0: 0, force: "step", a: 8, b: 1 };

// How often this browser's clock ticks, in ms: browsers make it coarse, against spies.
function tick() {
  let least = Infinity, changes = 0;
  for (let last = performance.now(); changes < 5;) {
    const now = performance.now();
    if (now > last) { least = Math.min(least, now - last); changes++; }
    last = now;
  }
  return least;
}
// ms for a call: the fastest of three batches, each of many ticks.
function time(call, least) {
  let best = Infinity, many = 1;
  for (let batch = 0; batch < 3;) {
    const began = performance.now();
    for (let i = 0; i < many; i++) call();
    const took = performance.now() - began;
    if (took < least) many = Math.ceil(many * Math.min(10, 1 + 1.2 * least / Math.max(took, least / 20)));
    else { best = Math.min(best, took / many); batch++; }
  }
  return best;
}

FVI_LIVE.scene("step_search", {
  about: "Measure: four methods run Bagley and Torvik's plate until t = 8 with more and more steps, in your browser. Further to the left and below is better.",
  c: "chapters-play-play",
  controls: { alpha: ["α", 0.05, 0.95, 0.75, 0.05] },
  buttons: { measure: ["Measure on this machine", values => { values.times = []; values.tick = tick(); }] },
  pictures: ["Largest error of x against the time of a run, in ms", "Largest error of x against the number of steps"],

  compute(values, { run }, scene) {
    if (scene.found?.alpha !== values.alpha) { // all errors once for an α
      values.times = undefined; // those of another problem
      const most = steps.at(-1), of = (method, N, points) => run({ ...plate, method, alpha: values.alpha, h: 8 / N, steps: N }, points);
      const exact = of("fvi", most, most).exact.x.slice();
      const error = (method, N) => of(method, N, 1).x.reduce((worst, x, k) => Math.max(worst, Math.abs(x - exact[k * most / N])), 0);
      scene.found = { alpha: values.alpha, errors: names.map(method => steps.map(N => error(method, N))) };
    }
    return scene.found;
  },

  // One point for each picture.
  more({ alpha }, values, { c, run }) {
    if (!values.times || values.times.length === names.length * steps.length) return false;
    const i = values.times.length, N = steps[i % steps.length];
    run({ ...plate, method: names[Math.floor(i / steps.length)], alpha, h: 8 / N, steps: N }, 1);
    values.times.push(time(() => c.play_run(), Math.max(10, 20 * values.tick)));
    return true;
  },

  says: ({ errors }) => `Largest errors with ${steps.at(-1)} steps: ${names.map((method, i) => `${method} ${errors[i].at(-1).toExponential(1)}`).join(", ")}.`,

  notes: (data, { times, tick }) => times === undefined ? "Nothing is measured yet."
    : `This browser's clock ticks every ${FVI_LIVE.short(Number(tick.toPrecision(2)))} ms: a run is repeated until twenty ticks and 10 ms have passed, and the fastest of `
      + `three such batches counts, so that the clock errs by a twentieth at most. ${times.length} of ${names.length * steps.length} points. `
      + "These are times of WebAssembly, with the sums over the past done directly; the program's own are in the chapter.",

  draw({ errors }, { times = [] }, [left, right]) {
    const low = Math.min(...errors.flat()) / 3, high = 3 * Math.max(...errors.flat()), known = times.length ? times : [0.01, 10];
    const cost = FVI_LIVE.axes(left, { x: [Math.min(...known) / 2, Math.max(...known) * 1.5], y: [low, high], log: "xy", names: ["ms", "error"], ends: ["fvi-lobatto3"] });
    const work = FVI_LIVE.axes(right, { x: [10, 3000], y: [low, high], log: "xy", names: ["steps", "error"], ends: ["fvi-lobatto3"] });
    if (times.length === 0) cost.note("press Measure");
    const mines = names.map((_, i) => times.slice(i * steps.length, (i + 1) * steps.length));
    names.forEach((method, i) => {
      const mine = mines[i];
      for (const [at, x] of [[cost, mine], [work, steps]]) {
        at.curve(x, errors[i].slice(0, x.length), ...methods[method]);
        x.forEach((value, j) => at.dot(value, errors[i][j], methods[method][0], 3.5));
      }
    });
    for (const [at, xs] of [[cost, mines], [work, names.map(() => steps)]])
      at.ends(names.map((method, i) => [method, methods[method][0], xs[i], errors[i].slice(0, xs[i].length)]));
  },
});
}
