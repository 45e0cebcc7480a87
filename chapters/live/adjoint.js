// H 23: what a push at t does to the end, by one mirrored run.
{
const N = 2000, h = 0.01, eps = 1e-4;
FVI_LIVE.scene("adjoint", {
  about: "Drag the start, left, or a sample of the force, right: the gradient of x(20) by every push is one run that goes backwards, "
    + "and two runs with a push more and less say whether it is right there.",
  c: "chapters-live-inverse",
  keeps: { force: 21 },
  controls: { alpha: ["α", 0, 1, 0.3, 0.01], rho: ["ρ", 0, 1, 0.3, 0.01], g: ["cubic stiffness g", 0, 2, 0.5, 0.05],
    x0: ["start x(0)", -2, 2, 1.2, 0.01], at: ["the push is at t", 1, 20, 7, 1] },
  pictures: ["The run; its start can be dragged", "The force ●, which can be dragged, and what a push at t does to x(20), dashed; wide, the mirror"],

  compute(values, { c, view }) {
    const { alpha, rho, g, x0, at } = values, k = Math.round(at / h);
    values.force ??= new Array(21).fill(0); // a sample for each unit of t, lines between
    const force = new Float64Array(N + 1), samples = values.force;
    force.forEach((_, j) => { const i = Math.min(Math.floor(j * h), 19), s = j * h - i; force[j] = (1 - s) * samples[i] + s * samples[i + 1]; });
    view(0, N + 1).set(force); // a view ends when the memory grows
    c.live_gradient(alpha, rho, g, x0, h, N, 1);
    const x = view(1, N + 1).slice(), by = view(2, N + 1).slice(), mirror = view(3, N + 1).slice().reverse(), [byStart] = view(4, 1);
    const end = (start, push) => { // x(20) if both change by that much
      view(0, N + 1)[k] = force[k] + push;
      c.live_gradient(alpha, rho, g, x0 + start, h, N, 0);
      view(0, N + 1)[k] = force[k];
      return view(1, N + 1)[N];
    };
    return { x, force, by, mirror, byStart, k, byPush: by[k] / h,
      checkPush: (end(0, eps / h) - end(0, -eps / h)) / (2 * eps), checkStart: (end(eps, 0) - end(-eps, 0)) / (2 * eps) };
  },

  says({ byPush, checkPush, byStart, checkStart }, { at }) {
    const [a, b, c, d] = [byPush, checkPush, byStart, checkStart].map(value => FVI_LIVE.short(Number(value.toFixed(5))));
    return `A push at t = ${at} moves x(20) by ${a} of its impulse, says the mirrored run, and by ${b}, say two runs. The start moves it by ${c} and ${d}.`;
  },

  draw({ x, force, by, mirror, k, checkPush }, { x0, at, force: samples }, [left, right]) {
    const t = [...x.keys()].map(j => j * h), run = FVI_LIVE.axes(left, { x: [0, 20], y: [-2.2, 2.2], names: ["t", "x"], ends: ["x(20)"] });
    run.curve(t, x, "run");
    run.ends([["x(20)", "run", t, x]]);
    run.handle(0, x0, "run", 7);
    const push = FVI_LIVE.axes(right, { x: [0, 20], y: [-1.2, 1.2], names: ["t", "F, dx(20)/d impulse"], ends: ["gradient"] });
    push.curve(t, mirror, "axis", [], 5);
    push.curve(t, force, "positive");
    const slope = by.slice(1).map(value => value / h);
    samples.forEach((F, j) => (j === at ? push.handle : push.dot)(j, F, "positive", j === at ? 5 : 3.5));
    push.curve(t.slice(1), slope, "negative", [7, 4]);
    push.ends([["F", "positive", t, force], ["gradient", "negative", t.slice(1), slope], ["mirror", "axis", t, mirror]]);
    push.dot(k * h, checkPush, "ink", 7, true);
  },

  drag(values, picture, x, y, type) {
    if (picture === 0) values.x0 = Number((4.4 * y - 2.2).toFixed(2));
    else values.force[values.at = Math.max(1, Math.round(20 * x))] = Number((2.4 * y - 1.2).toFixed(2));
  },
});
}
