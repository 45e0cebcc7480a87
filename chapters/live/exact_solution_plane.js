// H 11: the poles, the cut, and the motion that they add up to.
FVI_LIVE.scene("exact_solution_plane", {
  about: "Move the order and the damping: the pole walks, and the part that belongs to the cut, the tail, changes its sign.",
  controls: { alpha: ["α", 0, 1, 0.25, 0.005], rho: ["ρ", 0, 2.5, 0.5, 0.01] },
  pictures: ["The plane of s: the pole, its mirror image, the way it came, the cut", "The released body: motion, oscillation and tail"],

  compute({ alpha, rho }, { c, view }) {
    const way = [];
    for (let i = 0; i <= 60 && c.live_pole(alpha, rho * i / 60) === 0; i++) way.push([...view(3, 2)]);
    const [re, im] = c.live_pole(alpha, rho) === 0 ? view(3, 2) : [NaN, NaN];
    c.live_release(alpha, rho, 30, 601);
    const t = view(0, 601), x = view(1, 601), swing = view(2, 601);
    return { way, re, im, t, x, swing, tail: x.map((value, i) => value - swing[i]) };
  },

  says({ re, im, x, tail }, { alpha }) {
    const pole = Number.isNaN(re) ? "No complex pole: nothing swings" : `Pole ${FVI_LIVE.short(re)} ± ${FVI_LIVE.short(im)} i`;
    return `${pole}. At t = 15, x = ${FVI_LIVE.short(x[300])}, of which the tail is ${FVI_LIVE.short(tail[300])}`
      + (alpha === 0.5 ? " (no tail for α = 1/2)." : ".");
  },

  draw({ way, re, im, t, x, swing, tail }, values, [left, right]) {
    const plane = FVI_LIVE.axes(left, { x: [-1.6, 0.4], y: [-1.6, 1.6], names: ["Re s", "Im s"] });
    plane.curve([-9, 0], [0, 0], "negative", [], 4);
    plane.text(-1.5, 0.14, "the cut", "negative");
    plane.text(re, im + 0.16, "pole", "run");
    for (const sign of [1, -1]) {
      plane.curve(way.map(([a]) => a), way.map(([, b]) => sign * b), "run", [3, 3], 1.2);
      plane.dot(re, sign * im, "run", 5);
    }
    const motion = FVI_LIVE.axes(right, { x: [0, 30], y: [-1.1, 1.1], names: ["t", "x"], ends: ["oscillation"] });
    motion.curve(t, swing, "positive", [7, 4], 1.3);
    motion.curve(t, tail, "negative", [2, 3]);
    motion.curve(t, x, "run");
    motion.ends([["motion", "run", t, x], ["oscillation", "positive", t, swing], ["tail", "negative", t, tail]]);
  },
});
