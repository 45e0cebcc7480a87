// H 1: how the past is weighed, and what that does to a sine.
FVI_LIVE.scene("fractional_derivative_kernel", {
  about: "Move the order from 0, no derivative, to 1, the first: the memory shortens, and the sine becomes the cosine.",
  controls: { order: ["order", 0, 1, 0.5, 0.01] },
  pictures: ["The weight of the past against its age", "The derivative of the sine that begins at t = 0"],

  compute({ order }, { c, view }) {
    const N = 1200, h = 0.01, t = Array.from({ length: N + 1 }, (_, i) => i * h);
    view(0, N + 1).set(t.map(Math.sin));
    c.live_operators(order, h, N);
    const derivative = view(1, N + 1).slice(), age = view(0, 200);
    age.set(age.map((_, i) => (i + 1) / 40));
    c.live_powers(order, 200);
    return { t, derivative, age: age.slice(), kernel: view(1, 200).slice() };
  },

  says: ({ derivative, kernel }, { order }) => `Order ${FVI_LIVE.short(order)}: what is 1 old weighs ${FVI_LIVE.short(kernel[39])}; `
    + `at t = 6 the derivative of the sine is ${FVI_LIVE.short(derivative[600])}.`,

  draw({ t, derivative, age, kernel }, { order }, [left, right]) {
    const weight = FVI_LIVE.axes(left, { x: [0, 5], y: [0, 2], names: ["age", "weight"], ends: ["weight"] });
    weight.curve(age, kernel, "run");
    weight.ends([["weight", "run", age, kernel]]);
    if (order === 1) weight.note("only the present");
    const sine = FVI_LIVE.axes(right, { x: [0, 12], y: [-1.3, 1.3], names: ["t", ""], ends: ["derivative"] });
    sine.curve(t, t.map(Math.sin), "exact", [2, 3], 1.2);
    sine.curve(t, t.map(Math.cos), "exact", [8, 5], 1.2);
    sine.curve(t, derivative, "run");
    sine.ends([["sine", "exact", t, t.map(Math.sin)], ["cosine", "exact", t, t.map(Math.cos)], ["derivative", "run", t, derivative]]);
  },
});
