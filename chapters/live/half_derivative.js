// H 7: a derivative of order alpha, taken twice.
FVI_LIVE.scene("half_derivative", {
  about: "Draw a curve with the pointer, and bring α to 1/2: twice the half derivative is the slope, and nothing else is remembered.",
  controls: { alpha: ["α", 0, 1, 0.35, 0.01] },
  keeps: FVI_LIVE.drawn.keeps,
  pictures: ["The curve: draw here", "Its derivative of order α, taken twice; dashed, its slope"],

  compute(values, { c, view }) {
    const N = 300, h = 0.01;
    const x = FVI_LIVE.drawn.curve(values, N, 100);
    view(0, N + 1).set(x);
    c.live_operators(values.alpha, h, N);
    const twice = view(3, N + 1).slice(), slope = x.map((value, k) => (value - (x[k - 1] ?? 0)) / h);
    return { x, t: [...twice.keys()].map(k => k * h), twice, slope,
      apart: twice.reduce((most, value, k) => Math.max(most, Math.abs(value - slope[k])), 0) };
  },

  says: ({ apart }, { alpha }) => `Order ${FVI_LIVE.short(2 * alpha)} in all; largest distance from the slope: `
    + `${FVI_LIVE.short(apart)}${alpha === 0.5 ? ", which is rounding" : ""}.`,

  draw({ x, t, twice, slope }, values, [left, right]) {
    FVI_LIVE.drawn.draw(left, values, t, x);
    const both = FVI_LIVE.axes(right, { x: [0, 3], y: FVI_LIVE.span(twice.slice(1), slope.slice(1)), names: ["t", ""], ends: ["slope"] });
    both.curve(t, twice, "run");
    both.curve(t, slope, "negative", [7, 4]);
    both.ends([["twice", "run", t, twice], ["slope", "negative", t, slope]]);
  },

  drag: (values, picture, x, y, type) => (picture === 0 ? FVI_LIVE.drawn.drag(values, x, y, type, 300, 100) : false),
});
