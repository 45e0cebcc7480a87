// H 4: the weights of a derivative, and what they add up to.
FVI_LIVE.scene("coefficients_weights", {
  about: "Move the order from 0 to 1 and on to 2; look n steps back.",
  controls: { order: ["order of the derivative", 0, 2, 0.5, 0.01], n: ["n steps ago", 1, 2000, 10, "log"] },
  pictures: ["The first weights and their partial sums", "Sizes of weights and partial sums; drag the dot"],

  compute({ order, n }, { c, view }) {
    const last = 2000, sums = [];
    c.live_weights(order, last + 1);
    const w = view(0, last + 1);
    w.reduce((sum, value) => (sums.push(sum + value), sum + value), 0); // (4.3)
    n = Math.round(n);
    return { w, sums, n, weight: w[n], sum: sums[n] };
  },

  says: ({ n, weight, sum }, { order }) => `Order ${FVI_LIVE.short(order)}: the weight of ${n} steps ago is ${FVI_LIVE.short(weight)}; `
    + `with all before it, it adds up to ${FVI_LIVE.short(sum)}.`,

  draw({ w, sums, n }, values, [left, right]) {
    const few = 12, first = FVI_LIVE.axes(left, { x: [-0.5, few + 0.5], y: [-2.1, 1.2], names: ["n", "weight ●, sum ○"] });
    for (let i = 0; i <= few; i++) {
      first.dot(i, w[i], "run", 4);
      first.dot(i, sums[i], "negative", 4, true);
    }
    const far = FVI_LIVE.axes(right, { x: [0.9, 2500], y: [1e-9, 4], log: "xy", names: ["n", "size"], ends: ["weights"] });
    const steps = [...w.keys()].slice(1);
    const size = steps.map(i => Math.abs(w[i]) || NaN), total = steps.map(i => Math.abs(sums[i]) || NaN);
    far.curve(steps, size, "run");
    far.curve(steps, total, "negative", [7, 4]);
    far.ends([["weights", "run", steps, size], ["sums", "negative", steps, total]]);
    if (w[n]) far.handle(n, Math.abs(w[n]), "run", 5);
    if (sums[n]) far.dot(n, Math.abs(sums[n]), "negative", 5, true);
  },

  drag(values, picture, x) { // the right one chooses n
    if (picture === 1) values.n = Math.min(2000, Math.max(1, 0.9 * (2500 / 0.9) ** x));
  },
});
