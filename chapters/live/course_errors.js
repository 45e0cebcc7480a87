// Chapter 10: how long a step may be, and what a run does just below and above.
FVI_LIVE.scene("course_errors", {
  about: "Drag the step over the edge, where the load is 1: below it the body comes to rest, above it each swing is larger than the last. "
    + "With κ = 1/2 the spring has no say; move κ.",
  controls: { h: ["step h", 1, 4, 3.1, 0.01], alpha: ["α", 0, 1, 0.25, 0.01], kappa: ["κ", 0, 1, 0.5, 0.05] },
  pictures: ["The load of a step, (10c), which can be dragged", "A run of 100 such steps"],

  compute({ h, alpha, kappa }, { run }, scene) {
    const of = (step, steps) => run({ method: "fvi", alpha, kappa, rho: 0.5, p0: 0, h: step, steps }, 1), name = `${alpha} ${kappa}`;
    if (scene.name !== name) { // the curve once for an alpha and a kappa
      const steps = Array.from({ length: 61 }, (_, i) => 1 + i / 20);
      Object.assign(scene, { name, steps, loads: steps.map(step => of(step, 1).stability.load) });
    }
    const { x, stability } = of(h, 100), { steps, loads } = scene, past = loads.findIndex(load => load > 1);
    return { steps, loads, load: stability.load, x: [...x],
      edge: past > 0 ? steps[past - 1] + (steps[past] - steps[past - 1]) * (1 - loads[past - 1]) / (loads[past] - loads[past - 1]) : past === 0 ? 1 : 4 };
  },

  says: ({ load, edge, x }, { h }) => `With h = ${FVI_LIVE.short(h)} the load is ${FVI_LIVE.short(Number(load.toPrecision(4)))}, `
    + `and after 100 steps |x| is ${FVI_LIVE.short(Number(Math.abs(x[100]).toPrecision(2)))}. `
    + `${edge >= 4 ? "Every step shown is stable, up to 4" : edge <= 1 ? "No step shown is stable, from 1 on" : `The edge is at h = ${FVI_LIVE.short(Number(edge.toPrecision(3)))}`}.`,

  draw({ steps, loads, load, x }, { h }, [left, right]) {
    const map = FVI_LIVE.axes(left, { x: [1, 4], y: [0, 2], names: ["h", "load"], ends: ["load"] }), cut = 1e3;
    map.curve([1, 4], [1, 1], "negative", [6, 4], 1.4);
    map.curve(steps, loads.map(value => Math.min(value, 2.5)), "run");
    map.ends([["load", "run", steps, loads], ["edge", "negative", [1, 4], [1, 1]]]);
    map.handle(h, Math.min(load, 2), "run", 6);
    const k = x.map((_, i) => i), shown = x.map(value => Math.min(Math.max(value, -cut), cut)); // what blows up is cut
    const run = FVI_LIVE.axes(right, { x: [0, 100], y: FVI_LIVE.span(shown), names: ["k", "x"] });
    run.curve(k, shown, "run", [], 1.2);
    for (const i of k) run.dot(i, shown[i], "run", 2);
    if (shown.some(value => Math.abs(value) === cut)) run.note(`cut at ±${cut}`);
  },

  drag(values, picture, x) {
    if (picture !== 0) return false;
    values.h = Math.round((1 + 3 * x) * 100) / 100;
  },
});
