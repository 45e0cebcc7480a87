// H 24: the valley of alpha, place by place, and the interval that it gives.
{
const n = 30, every = 20, h = 0.02, step = every * h, x0 = 1, p0 = 0, truth = { rho: 0.4, c: 1 }, REACH = 1.96, SIDE = 12, MOST = 60;
let seed = 1964;
const uniform = () => (seed = seed * 48271 % 2147483647) / 2147483647;
const noise = Array.from({ length: n }, () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform()));

// The best of all three, from where it was before, by as many steps as it takes.
function fit(c, view, sigma, before = [0.5, 0.3, 1.2]) {
  view(3, 3).set(before);
  for (let i = 0; i < 60; i++)
    if (c.live_fit(x0, p0, h, n, every, sigma) || view(3, 9)[8] < 1e-7) break;
  const [alpha, rho, k, sdAlpha, , , , chi2] = view(3, 8);
  return { theta: [alpha, rho, k], sd: sdAlpha, chi2 };
}

const rootOf = ({ chi2 }, best) => Math.sqrt(Math.max(0, chi2 - best));
const next = ({ sign, at }, sd) => at[at.length - 1].alpha + sign * Math.min(2.6 * sd, 0.7) / SIDE;
const isEnd = alpha => alpha <= 0.002 || alpha >= 0.998;
// A side is walked along until the root of what chi^2 grew by is well above 1.96, or no order is left.
const isDone = (side, best, sd) => rootOf(side.at[side.at.length - 1], best) > 1.3 * REACH || isEnd(next(side, sd)) || side.at.length > MOST;

// Where that root is 1.96; an end of the possible orders if it never is.
function edge({ sign, at }, best) {
  for (let i = 1; i < at.length; i++) {
    const low = rootOf(at[i - 1], best), high = rootOf(at[i], best), [a, b] = [at[i - 1].alpha, at[i].alpha];
    if (high >= REACH) return Number.isFinite(high) ? a + (b - a) * (REACH - low) / (high - low) : a;
  }
  return sign < 0 ? 0 : 1;
}

FVI_LIVE.scene("identification_believed", {
  about: "More noise: the valley of α becomes wide, and then it bends away from the parabola of the standard deviation.",
  c: "chapters-live-inverse",
  controls: { sigma: ["noise σ", 0.005, 0.4, 0.05, "log"], alpha: ["α of the data", 0.1, 0.7, 0.3, 0.05] },
  pictures: ["The data, and the fit", "What χ² grows by where α is held and ρ and c make up for it; dashed, the parabola; the line of 95 percent"],

  compute(values, { c, view }) {
    const asked = `${values.alpha} ${values.sigma}`;
    c.live_release(values.alpha, truth.rho, n * step, n + 1); // exact, not by the method of the fit
    const data = [...view(1, n + 1)].slice(1).map((x, i) => x + values.sigma * noise[i]);
    view(0, n).set(data);
    if (values.asked !== asked) {
      values.asked = asked;
      values.found = fit(c, view, values.sigma, values.found?.theta);
      values.curve = [...view(1, n * every + 1)];
      values.sides = [-1, 1].map(sign => ({ sign, at: [{ alpha: values.found.theta[0], chi2: values.found.chi2, others: values.found.theta.slice(1) }] }));
    }
    const { theta, sd, chi2 } = values.found;
    for (const side of values.sides.filter(side => !isDone(side, chi2, sd))) { // one place further, from where ρ and c were
      const { at } = side, alpha = next(side, sd), last = at[at.length - 1], before = at[at.length - 2] ?? last;
      view(3, 3).set([alpha, ...last.others.map((value, j) => Math.max(1e-3, 2 * value - before.others[j]))]);
      const failed = c.live_valley(x0, p0, h, n, every, values.sigma);
      at.push({ alpha, chi2: failed ? Infinity : view(3, 4)[3], others: failed ? last.others : [...view(3, 3).slice(1)] });
    }
    const done = values.sides.every(side => isDone(side, chi2, sd));
    const [low, high] = values.sides.map(side => (done ? edge(side, chi2) : NaN));
    const valley = [...values.sides[0].at.slice(1).reverse(), ...values.sides[1].at].map(place => [place.alpha, place.chi2 - chi2]);
    return { data, curve: values.curve, theta, sd, chi2, valley, low, high, going: done ? 0 : 1 };
  },

  more: ({ going }) => going > 0,

  says({ theta: [alpha], sd, low, high }, values) {
    const of = (a, b) => `[${a.toFixed(3)}, ${b.toFixed(3)}]`, holds = (a, b) => a <= values.alpha && values.alpha <= b;
    const parabola = [alpha - REACH * sd, alpha + REACH * sd];
    if (Number.isNaN(low) || Number.isNaN(high)) return `α = ${alpha.toFixed(3)} ± ${sd.toFixed(3)}; the valley is walked along.`;
    return `α = ${alpha.toFixed(3)} ± ${sd.toFixed(3)}. The interval of the valley is ${of(low, high)}, which ${holds(low, high) ? "holds" : "misses"} `
      + `the truth ${values.alpha}; that of the standard deviation would be ${of(...parabola)}${parabola[0] < 0 || parabola[1] > 1 ? ", and goes where no α is" : ""}.`;
  },

  draw({ data, curve, theta: [alpha], sd, valley, low, high }, values, [left, right]) {
    const motion = FVI_LIVE.axes(left, { x: [0, n * step], y: [-1.6, 1.6], names: ["t", "x"] });
    motion.curve([...curve.keys()].map(k => k * h), curve, "run");
    data.forEach((value, i) => motion.dot((i + 1) * step, value, "negative", 3));
    const reach = Math.max(3 * sd, 0.02), from = Math.max(0, alpha - reach), to = Math.min(1, alpha + reach), high95 = REACH * REACH;
    const plane = FVI_LIVE.axes(right, { x: [from, to], y: [0, 8], names: ["α", "Δχ²"] });
    const across = Array.from({ length: 61 }, (_, i) => from + (to - from) * i / 60);
    plane.curve(across, across.map(a => ((a - alpha) / sd) ** 2), "exact", [4, 4], 1.2);
    plane.curve([from, to], [high95, high95], "axis", [2, 3], 1);
    const within = valley.filter(([a, grown]) => a >= from && a <= to && grown < 12);
    plane.curve(within.map(([a]) => a), within.map(([, grown]) => grown), "run");
    if (low <= high) plane.curve([Math.max(low, from), Math.min(high, to)], [high95, high95], "negative", [], 4);
    plane.dot(alpha, 0, "run", 4);
    if (values.alpha >= from && values.alpha <= to) {
      plane.dot(values.alpha, 0, "ink", 6, true);
      plane.text(values.alpha, 0.5, "truth", "ink", true);
    }
  },
});
}
