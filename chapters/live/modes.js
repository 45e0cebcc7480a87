// chapters/live/modes.js -- A power law as a sum of exponentials: what Chapter 11 and H 12 share.
const modes = name => scene(name, {
  about: "Ask for a longer past or a smaller error: a few more exponentials do it.",
  controls: { order: ["order", 0.05, 0.95, 0.5, 0.01], N: ["longest lag N", 128, 1e6, 1e4, "log"],
    tolerance: ["relative error δ", 1e-14, 1e-2, 1e-6, "log"] },
  pictures: ["Weights, and the exponentials whose sum they are", "Relative error of the sum, against the lag"],

  compute({ order, N, tolerance }, { c, view }) {
    const Q = c.live_nodes(order, N, tolerance), s = view(0, Q).slice(), a = view(1, Q).slice();
    c.live_weights(order, 8192);
    const w = view(0, 8192), lags = [], error = [], size = [];
    for (let n = 33; n < 8192 && n <= N; n = Math.ceil(n * 1.03)) { // the exponentials begin at 33
      let sum = 0;
      for (let q = 0; q < Q; q++) sum += a[q] * Math.exp(-n * s[q]); // (12.6)
      lags.push(n);
      size.push(-w[n]);
      error.push(Math.abs(sum / w[n] - 1));
    }
    return { Q, s, a, lags, size, error, worst: Math.max(...error) };
  },

  says: ({ Q, worst }, { tolerance }) => `${Q} exponentials; the largest relative error of a weight seen is ${short(Number(worst.toPrecision(2)))}, `
    + `at most δ = ${short(tolerance)}, or some units of rounding.`,

  draw({ Q, s, a, lags, size, error }, { N, tolerance }, [left, right]) {
    const many = Array.from({ length: 200 }, (_, i) => N ** (i / 199)), least = 1e-3 * N ** -1.5;
    const all = axes(left, { x: [1, N], y: [least, 1], log: "xy", names: ["n", "weight, negative"], ends: ["exponentials"] });
    for (let q = 0; q < Q; q++) all.curve(many, many.map(n => -a[q] * Math.exp(-n * s[q]) || NaN), "past", [], 1);
    all.curve(lags, size, "run", [], 2.5);
    const q = [...s.keys()].reduce((best, i) => (-a[i] * Math.exp(-N * s[i]) > -a[best] * Math.exp(-N * s[best]) ? i : best)); // the last has the name of all
    all.ends([["weights", "run", lags, size], ["exponentials", "past", many, many.map(n => -a[q] * Math.exp(-n * s[q]))]]);
    const errors = axes(right, { x: [30, 8200], y: [1e-17, 1], log: "xy", names: ["n", "relative error"], ends: ["error"] });
    errors.curve([30, 8200], [tolerance, tolerance], "exact", [6, 4], 1.2);
    const seen = error.map(e => Math.max(e, 1e-17));
    errors.curve(lags, seen, "run");
    errors.ends([["δ", "exact", [30, 8200], [tolerance, tolerance]], ["error", "run", lags, seen]]);
  },
});
