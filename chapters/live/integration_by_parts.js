// H 5: the retarded and the advanced derivative of a curve drawn by hand.
FVI_LIVE.scene("integration_by_parts", {
  about: "Draw a curve with the pointer: the retarded derivative knows what came before, the advanced one what is to come.",
  controls: { alpha: ["α", 0, 1, 0.5, 0.01] },
  keeps: FVI_LIVE.drawn.keeps,
  pictures: ["The curve: draw here", "Its retarded derivative, full, and its advanced one, dashed"],

  compute(values, { c, view }) {
    const N = 300, h = 0.01;
    const x = FVI_LIVE.drawn.curve(values, N, 150);
    view(0, N + 1).set(x);
    c.live_operators(values.alpha, h, N);
    const back = view(1, N + 1).slice(), ahead = view(2, N + 1).slice();
    const sum = of => h * of.reduce((total, value, k) => total + value * x[k], 0);
    return { x, t: [...back.keys()].map(k => k * h), back, ahead, sums: [sum(back), sum(ahead)] };
  },

  says: ({ sums }) => `The sums of x Δ₋x and of x Δ₊x, all nodes in, are one number: ${FVI_LIVE.short(sums[0])} and ${FVI_LIVE.short(sums[1])}.`,

  draw({ x, t, back, ahead }, values, [left, right]) {
    FVI_LIVE.drawn.draw(left, values, t, x);
    const both = FVI_LIVE.axes(right, { x: [0, 3], y: FVI_LIVE.span(back.slice(1), ahead.slice(0, -1)), names: ["t", ""], ends: ["looks ahead"] });
    both.curve(t, back, "run");
    both.curve(t, ahead, "negative", [7, 4]);
    both.ends([["looks back", "run", t, back], ["looks ahead", "negative", t, ahead]]);
  },

  drag: (values, picture, x, y, type) => (picture === 0 ? FVI_LIVE.drawn.drag(values, x, y, type, 300, 150) : false),
});
