// H 5: the retarded and the advanced derivative of a curve drawn by hand.
FVI_LIVE.scene("integration_by_parts", {
  about: "Draw a curve with the pointer: the retarded derivative knows what came before, the advanced one what is to come.",
  controls: { alpha: ["α", 0, 1, 0.5, 0.01] },
  pictures: ["The curve: draw here", "Its retarded derivative, full, and its advanced one, dashed"],

  compute(values, { c, view }) {
    const N = 300, h = 0.01;
    values.curve ??= Array.from({ length: N + 1 }, (_, k) => Math.exp(-(((k - 150) / 30) ** 2))); // a bump
    view(0, N + 1).set(values.curve);
    c.live_operators(values.alpha, h, N);
    const back = view(1, N + 1).slice(), ahead = view(2, N + 1).slice();
    const sum = of => h * of.reduce((total, value, k) => total + value * values.curve[k], 0);
    return { x: values.curve.slice(), t: [...back.keys()].map(k => k * h), back, ahead, sums: [sum(back), sum(ahead)] };
  },

  says: ({ sums }) => `The sums of x Δ₋x and of x Δ₊x, all nodes in, are one number: ${FVI_LIVE.short(sums[0])} and ${FVI_LIVE.short(sums[1])}.`,

  draw({ x, t, back, ahead }, { last }, [left, right]) {
    const drawn = FVI_LIVE.axes(left, { x: [0, 3], y: [-1.5, 1.5], names: ["t", "x"], ends: ["x"] }), pen = last ?? x.indexOf(Math.max(...x));
    drawn.curve(t, x, "exact");
    drawn.ends([["x", "exact", t, x]]);
    drawn.handle(t[pen], x[pen], "exact", 4);
    const both = FVI_LIVE.axes(right, { x: [0, 3], y: FVI_LIVE.span(back.slice(1), ahead.slice(0, -1)), names: ["t", ""], ends: ["looks ahead"] });
    both.curve(t, back, "run");
    both.curve(t, ahead, "negative", [7, 4]);
    both.ends([["looks back", "run", t, back], ["looks ahead", "negative", t, ahead]]);
  },

  // The curve under the pointer, drawn by hand: straight from where it was last.
  drag(values, picture, x, y, type) {
    if (picture !== 0) return false;
    const { curve } = values, N = curve.length - 1, i = Math.round(x * N), height = 3 * y - 1.5;
    const from = type === "pointerdown" ? i : values.last, by = Math.sign(i - from) || 1;
    for (let j = from; j !== i + by; j += by) curve[j] = from === i ? height : curve[from] + (height - curve[from]) * (j - from) / (i - from);
    values.last = i;
  },
});
