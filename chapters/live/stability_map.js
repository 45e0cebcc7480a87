// H 14: where a step is stable, and the run at the pointer.
FVI_LIVE.scene("stability_map", {
  about: "Drag the point over the edge, and see the run below and above it. A step has length 1; R is the damping, W the spring.",
  controls: { alpha: ["α", 0, 0.995, 0.75, 0.005], R: ["damping R", 0.1, 60, 1, "log"], W: ["spring W", 0, 1, 0.1, 0.01] },
  choices: { method: ["method", "fvi", "fvi-shifted", "fvi-bdf2"] },
  pictures: ["Damping R against α, with the edge of the stable range", "The run at the point"],

  compute({ alpha, R, W, method }, { run }, scene) {
    const state = { method, h: 1, steps: 60, p0: 0, c: W };
    if (scene.edge?.method !== method) { // for kappa = 1/2 the load is R times that of R = 1, whatever W
      scene.edge = { method, alpha: Array.from({ length: 200 }, (_, i) => i / 200) };
      scene.edge.R = scene.edge.alpha.map(a => 1 / run({ ...state, alpha: a, rho: 1, steps: 1 }).stability.load);
    }
    const { x, stability } = run({ ...state, alpha, rho: R });
    return { edge: scene.edge, load: stability.load, x: x.slice() };
  },

  says: ({ load, x }) => `Load ${FVI_LIVE.short(load)}: ${load > 1 ? "a mode grows, and changes its sign at each step" : "no mode grows"}. `
    + `Largest |x| in 60 steps: ${FVI_LIVE.short(x.reduce((most, value) => Math.max(most, Math.abs(value)), 0))}.`,

  draw({ edge, x }, { alpha, R }, [left, right]) {
    const map = FVI_LIVE.axes(left, { x: [0, 1], y: [0.1, 60], log: "y", names: ["α", "R"], ends: ["edge"] }), edges = edge.R.map(r => (r > 0 && r < 1e3 ? r : NaN));
    map.curve(edge.alpha, edges, "negative", [], 2.5);
    map.ends([["edge", "negative", edge.alpha, edges]]);
    map.handle(alpha, R, "run", 6);
    const cut = 1e3, k = [...x.keys()], shown = [...x].map(value => Math.min(Math.max(value, -cut), cut)); // what blows up is cut
    const run = FVI_LIVE.axes(right, { x: [0, 60], y: FVI_LIVE.span(shown), names: ["k", "x"] });
    run.curve(k, shown, "run", [], 1.3);
    for (const i of k) run.dot(i, shown[i], "run", 2.2);
    if (shown.some(value => Math.abs(value) === cut)) run.note(`cut at ±${cut}`);
  },

  drag(values, picture, x, y) {
    if (picture !== 0) return false;
    values.alpha = Math.min(0.995, Math.round(x * 200) / 200);
    values.R = Number((0.1 * 600 ** y).toPrecision(3));
  },
});
