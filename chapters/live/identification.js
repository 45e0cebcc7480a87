// H 24: data that are dragged, and the fit that follows.
{
const n = 40, every = 50, h = 0.01, x0 = 1, p0 = 0, truth = { rho: 0.4, c: 1 };
const guess = [0.5, 0.3, 1.2]; // α, ρ, c to begin with
let seed = 2003;
const uniform = () => (seed = seed * 48271 % 2147483647) / 2147483647;
const noise = Array.from({ length: n }, () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform()));

FVI_LIVE.scene("identification", {
  about: "Drag a dot up or down: the least squares are searched from where they were, a step of Levenberg and Marquardt for each picture.",
  c: "chapters-live-inverse",
  keeps: { moved: 40 },
  controls: { alpha: ["α of the data", 0.05, 0.7, 0.3, 0.05], sigma: ["noise σ", 0.002, 0.2, 0.05, "log"] },
  pictures: ["Data, which can be dragged, the fit, and the motion behind the data, dashed", "α and ρ: the fit, 95 of 100 repetitions within the ellipse; ○, the truth"],
  buttons: { again: ["Begin again", values => { values.moved = values.theta = undefined; }] },

  compute(values, { c, view }) {
    values.moved ??= new Array(n).fill(0);
    values.theta ??= guess;
    c.live_release(values.alpha, truth.rho, 20, n + 1); // exact, not by the method of the fit
    const exact = view(1, n + 1).slice(), data = values.moved.map((by, i) => exact[i + 1] + values.sigma * noise[i] + by);
    values.unmoved = data.map((value, i) => value - values.moved[i]);
    view(0, n).set(data);
    view(3, 3).set(values.theta);
    const failed = c.live_fit(x0, p0, h, n, every, values.sigma), [alpha, rho, k, sdAlpha, sdRho, sdK, together, chi2, far] = view(3, 9);
    if (failed) values.theta = guess;
    else values.theta = [alpha, rho, k];
    return { exact, data, x: view(1, n * every + 1).slice(), theta: values.theta, sd: [sdAlpha, sdRho, sdK], together, chi2, far: failed ? 0 : far };
  },

  more: ({ far }) => far > 1e-6, // of the steps that make χ² larger by 1

  says({ theta, sd, together, chi2 }) {
    const of = (name, i) => `${name} = ${theta[i].toFixed(3)} ± ${sd[i].toFixed(3)}`;
    return `${of("α", 0)}, ${of("ρ", 1)}, ${of("c", 2)}; α and ρ are correlated by ${together.toFixed(2)}. `
      + `χ² = ${chi2.toFixed(1)}, where ${n - theta.length} is expected, give or take ${Math.sqrt(2 * (n - theta.length)).toFixed(0)}.`;
  },

  draw({ exact, data, x, theta, sd, together }, { alpha, held: last }, [left, right]) {
    const motion = FVI_LIVE.axes(left, { x: [0, 20], y: [-1.4, 1.4], names: ["t", "x"], ends: ["truth"] });
    const times = [...exact.keys()].map(i => i * every * h), fine = [...x.keys()].map(k => k * h);
    motion.curve(times, exact, "exact", [3, 4], 1.2);
    motion.curve(fine, x, "run");
    motion.ends([["fit", "run", fine, x], ["truth", "exact", times, exact]]);
    data.forEach((value, i) => (i === (last ?? 11) ? motion.handle : motion.dot)((i + 1) * every * h, value, "negative", 4));
    const plane = FVI_LIVE.axes(right, { x: [alpha - 0.2, alpha + 0.2], y: [0.2, 0.6], names: ["α", "ρ"] }), around = Array.from({ length: 61 }, (_, i) => i * Math.PI / 30);
    const reach = 2.4477; // (-2 ln 0.05)^(1/2)
    plane.curve(around.map(a => theta[0] + reach * sd[0] * Math.cos(a)),
      around.map(a => theta[1] + reach * sd[1] * (together * Math.cos(a) + Math.sqrt(1 - together * together) * Math.sin(a))), "run");
    plane.dot(theta[0], theta[1], "run", 4);
    plane.text(theta[0], theta[1], "fit", "run");
    plane.dot(alpha, truth.rho, "ink", 6, true);
    plane.text(alpha, truth.rho + 0.02, "truth", "ink", true);
  },

  drag(values, picture, x, y, type) {
    if (picture !== 0) return false;
    if (type === "pointerdown") values.held = Math.min(n, Math.max(1, Math.round(20 * x / (every * h)))) - 1;
    values.moved[values.held] = 2.8 * y - 1.4 - values.unmoved[values.held];
  },
});
}
