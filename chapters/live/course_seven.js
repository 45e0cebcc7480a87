// The running body of the Course, from a second spring through a dashpot to a second mass: it
// moves, and below it hangs its past, each place as large as its weight in the memory.
{
const h = 0.05, steps = 280, ago = 0.5, back = 16; // dots of the past: one in ago, back of them
const orders = [0, 0.25, 0.4, 0.5, 0.6, 0.75, 1];
const words = alpha => (alpha === 0 ? "A second spring" : alpha < 0.5 ? "Between a spring and a dashpot" : alpha === 0.5
  ? "A dashpot, friction without memory" : alpha < 1 ? "Between a dashpot and a mass" : "A second mass");

FVI_LIVE.scene("course_seven", {
  about: "Move α from a spring (0) through a dashpot (1/2) to a mass (1). Drag the body, left, and let go: the dots behind it are its past, "
    + "each as large as its weight in the force of the springpot. Right, the small dots are the program of Chapter 6.",
  controls: { alpha: ["α: 0 spring, ½ dashpot, 1 mass;", 0, 1, 0.25, 0.01], rho: ["ρ", 0, 2, 0.5, 0.02] },
  keeps: { x0: 1 },
  buttons: { again: ["Let go again", FVI_LIVE.again] },
  pictures: ["The body, which can be dragged, and its past", "Its place against time; thin, other α"],

  compute(values, { c, view, run }, scene) {
    values.x0 ??= 1;
    values.at ??= 0; // how far it is in the motion
    const { alpha, rho, x0 } = values, of = a => [...run({ method: "fvi-lobatto4", alpha: a, rho, x0, p0: 0, h, steps }, 1).x];
    if (scene.rho !== rho) { // they are linear in x0
      scene.rho = rho;
      scene.seven = orders.map(a => run({ method: "fvi-lobatto4", alpha: a, rho, x0: 1, p0: 0, h, steps }, 1).x.slice());
    }
    const x = of(alpha);
    c.live_weights(2 * alpha, back + 1);
    const stage6 = [...run({ method: "fvi", alpha, rho, x0, p0: 0, h: 0.1, steps: steps / 2 }, 1).x];
    return { x, stage6, weights: [...view(0, back + 1)], seven: scene.seven.map(one => [...one]) };
  },

  more: (data, values) => FVI_LIVE.goOn(values, steps, 1 / 12),

  says: ({ x }, { alpha }) => `${words(alpha)}: at t = 14 the body is at ${FVI_LIVE.short(Number(x[steps].toPrecision(4)))}, `
    + `and on the way it came to ${FVI_LIVE.short(Number(Math.min(...x.map(value => value * Math.sign(x[0] || 1))).toPrecision(4) * Math.sign(x[0] || 1)))} on the other side.`,

  draw({ x, stage6, weights, seven }, { alpha, x0, at }, [left, right]) {
    const k = Math.round(at), body = FVI_LIVE.axes(left, { x: [-2.2, 1.6], y: [-8.5, 3], names: ["x", "time ago, downwards from 0"] });
    for (let n = back; n > 0; n--) { // before t = 0 it was held
      const then = k - n * ago / h;
      body.dot(then > 0 ? x[Math.round(then)] : x0, -n * ago, "past", Math.min(9, 0.7 + 11 * Math.sqrt(Math.abs(weights[n]))));
    }
    const here = x[k], wall = -2, zigzag = [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1];
    body.curve([wall, wall], [-0.3, 2.6], "axis", [], 4);
    body.curve(zigzag.map(s => wall + s * (here - wall)), zigzag.map((s, i) => 1.9 + (i === 0 || i === 10 ? 0 : i % 2 ? 0.3 : -0.3)), "soft-ink");
    const middle = (wall + here) / 2; // the springpot's sign, a diamond
    body.curve([wall, middle - 0.25, middle, middle + 0.25, middle, middle - 0.25], [0.4, 0.4, 0.7, 0.4, 0.1, 0.4], "run");
    body.curve([middle + 0.25, here], [0.4, 0.4], "run");
    body.curve([here, here], [0.4, 1.9], "soft-ink");
    body.text(wall, 2.7, "spring", "soft-ink");
    body.text(wall, -0.6, "springpot", "run");
    body.handle(here, 1.1, "run", 9);
    const place = FVI_LIVE.axes(right, { x: [0, 14], y: [-1.3, 1.3], names: ["t", "x"], ends: orders.map(a => `α = ${a}`) });
    const t = x.map((_, i) => i * h);
    for (const one of seven) place.curve(t, one.map(value => value * x0), "grid", [], 1.2);
    place.ends(orders.map((a, i) => [`α = ${a}`, a === alpha ? "run" : "soft-ink", t, seven[i].map(value => value * x0)]));
    place.curve(t, x, "past", [], 1.2);
    place.curve(t.slice(0, k + 1), x.slice(0, k + 1), "run", [], 2.4);
    for (let i = 0; i < stage6.length; i += 10)
      place.dot(0.1 * i, stage6[i], "soft-ink", 2.5);
    place.dot(t[k], x[k], "run", 6);
  },

  drag(values, picture, x) {
    if (picture !== 0) return false;
    values.x0 = Math.round(Math.min(Math.max(-2.2 + 3.8 * x, -1.3), 1.3) * 100) / 100;
    FVI_LIVE.again(values);
  },
});
}
