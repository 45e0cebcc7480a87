// H 29: a body on a spring, with a springpot strut beside it or with dampers along the axes.
{
const N = 1200, h = 0.05, least = 0.1; // nearer to the centre the spring has no direction
const t = Array.from({ length: N + 1 }, (_, k) => k * h);

FVI_LIVE.scene("lagrangian", {
  about: "Drag the body, which is the end of the strut, and let go. The energy falls, and the angular momentum stays to the last digits. "
    + "Then take dampers along the axes.",
  c: "chapters-live-pendulum",
  controls: { x1: ["x₁ at the start", -1.5, 1.5, 1.2, 0.01], x2: ["x₂ at the start", -1.5, 1.5, 0, 0.01], alpha: ["α", 0, 0.95, 0.3, 0.01], rho: ["ρ", 0, 1, 0.1, 0.01] },
  choices: { damper: ["damper along", "strut", "axes"] },
  buttons: { again: ["Let go again", FVI_LIVE.again] },
  pictures: ["The body, which can be dragged, on its spring and strut; its path", "Its angular momentum J and its energy E"],

  compute(values, { c, view }, scene) {
    const { x1, x2, alpha, rho, damper } = values, name = `${x1} ${x2} ${alpha} ${rho} ${damper}`;
    values.at ??= 0;
    if (scene.name === name) return scene.data; // the motion goes on for many pictures
    const far = Math.hypot(x1, x2), by = far >= least ? 1 : least / far;
    view(0, 4).set([far > 0 ? x1 * by : least, x2 * (far > 0 ? by : 0), 0.3, 0.8]);
    c.live_pendulum(alpha, rho, damper === "strut" ? 1 : 0, N);
    const [path1, path2, energy, turning] = [0, 1, 2, 3].map(which => [...view(which, N + 1)]);
    scene.name = name;
    return scene.data = { path1, path2, energy, turning, changed: Math.max(...turning.map(J => Math.abs(J - turning[0]))) };
  },

  more: (data, values) => FVI_LIVE.goOn(values, N, N / 9000),

  says: ({ energy, turning, changed }) => `J is ${turning[0].toFixed(15)} at first, ${turning[N].toFixed(15)} at t = 60, and it changed by `
    + `${changed.toExponential(1)} at most. E is ${FVI_LIVE.short(Number(energy[0].toPrecision(4)))} at first and ${FVI_LIVE.short(Number(energy[N].toPrecision(4)))} at the end.`,

  draw({ path1, path2, energy, turning }, { damper, at }, [left, right]) {
    const k = Math.floor(at), [wide, high] = rangesOf(left), plane = FVI_LIVE.axes(left, { x: [-wide, wide], y: [-high, high], names: ["x₁", "x₂"] });
    plane.curve(path1.slice(0, k + 1), path2.slice(0, k + 1), "past", [], 1);
    const [x, y] = [path1[k], path2[k]], r = Math.hypot(x, y), along = [x / r, y / r], across = [-y / r, x / r];
    const place = (s, side) => [s * along[0] + side * across[0], s * along[1] + side * across[1]];
    const line = (points, ...look) => plane.curve(points.map(p => p[0]), points.map(p => p[1]), ...look);
    line(Array.from({ length: 21 }, (_, i) => place(r * i / 20, 0.1 + (i > 2 && i < 18 ? (i % 2 ? 0.06 : -0.06) : 0))), "soft-ink", [], 1.2);
    if (damper === "strut") { // the springpot's sign, a diamond
      const [a, b] = [r / 2 - 0.12, r / 2 + 0.12];
      line([place(0, -0.1), place(a, -0.1), place(r / 2, -0.02), place(b, -0.1), place(r / 2, -0.18), place(a, -0.1)], "run", [], 1.8);
      line([place(b, -0.1), place(r, -0.1)], "run", [], 1.8);
    }
    plane.dot(0, 0, "ink", 4);
    plane.handle(x, y, "run", 7);
    const sums = FVI_LIVE.axes(right, { x: [0, 60], y: FVI_LIVE.span(energy, turning, [0]), names: ["t", "J and E"], ends: ["J"] });
    sums.curve(t, turning, "positive", [], 2.2);
    sums.curve(t, energy, "negative", [7, 4]);
    sums.curve([t[k], t[k]], FVI_LIVE.span(energy, turning, [0]), "axis", [3, 3], 1);
    sums.ends([["J", "positive", t, turning], ["E", "negative", t, energy]]);
  },

  drag(values, picture, x, y) {
    if (picture !== 0) return false;
    const [wide, high] = ranges, place = (share, most) => Math.min(Math.max(Math.round(100 * most * (2 * share - 1)) / 100, -1.5), 1.5);
    Object.assign(values, { x1: place(x, wide), x2: place(y, high) });
    FVI_LIVE.again(values);
  },
});

// A circle is round: one scale for both axes, at least 1.6 to each side.
let ranges = [1.6, 1.6];
function rangesOf(canvas) {
  const { left, right, top, bottom } = FVI_LIVE.axes(canvas, { x: [0, 1], y: [0, 1], names: ["", ""] }).edges;
  const scale = 1.6 / Math.min(right - left, bottom - top);
  return ranges = [scale * (right - left), scale * (bottom - top)];
}
}
