// chapters/live/orders.js -- An order read off by dragging the step: what H 13 and 17 share.
const orders = (name, methods) => scene(name, {
  about: "Drag h, or move α: the errors once the push is over, and the order between h and h/2. Bagley and Torvik's plate, pushed until t = 1.",
  controls: { k: ["halvings of the step", 0, 5, 2, 1], alpha: ["α", 0.05, 0.95, 0.75, 0.05] },
  pictures: ["Largest error of x from t = 2 to 8 against h; drag the dot", "The run with this step, and the exact motion"],
  methods,
  problem: { potential: "harmonic", c: 1, rho: 1, x0: 0, p0: 0, force: "step", a: 8, b: 1 },

  compute({ k, alpha }, { run }, scene) {
    const at = (method, i, points) => run({ ...scene.problem, method, alpha, h: 0.5 ** (i + 1), steps: 8 * 2 ** (i + 1) }, points);
    if (scene.ladder?.alpha !== alpha) { // all steps once for an alpha; the exact motion takes the time, so 128 points of it
      const h = [0, 1, 2, 3, 4, 5, 6].map(i => 0.5 ** (i + 1)), { t, x } = at("fvi", 3, 128).exact;
      const exact = { t: t.slice(), x: x.slice() }, worst = (method, i) => {
        const found = at(method, i, 1).x, [by, far] = i < 3 ? [1, 2 ** (3 - i)] : [2 ** (i - 3), 1];
        let most = 0;
        for (let j = 32 / far; j * far <= 128; j++) most = Math.max(most, Math.abs(found[j * by] - exact.x[j * far]));
        return most;
      };
      scene.ladder = { alpha, h, exact, errors: scene.methods.map(method => h.map((_, i) => worst(method, i))) };
    }
    const { h, errors, exact } = scene.ladder, orders = errors.map(e => Math.log2(e[k] / e[k + 1]));
    return { h, errors, orders, step: h[k], x: at(scene.methods.at(-1), k, 1).x.slice(), exact };
  },

  says({ errors, orders, step }, { k }) {
    const of = this.methods.map((method, i) => `${method}: error ${short(Number(errors[i][k].toPrecision(3)))}, order ${orders[i].toFixed(2)}`);
    return `h = ${step}. ${of.join("; ")}.`;
  },

  draw({ h, errors, step, x, exact }, { k }, [left, right]) {
    const styles = [["run", []], ["negative", [8, 4]], ["positive", [2, 3]]], low = Math.min(...errors.flat().filter(e => e > 0));
    const fall = axes(left, { x: [h[6] / 1.3, h[0] * 1.3], y: [low / 3, 2 * Math.max(...errors.flat())], log: "xy", names: ["h", "error"], ends: this.methods });
    errors.forEach((e, i) => {
      fall.curve(h, e, ...styles[i]);
      h.forEach((value, j) => (j === k && i === 0 ? fall.handle : fall.dot)(value, e[j], styles[i][0], j === k || j === k + 1 ? 6 : 3, j !== k));
    });
    fall.ends(errors.map((e, i) => [this.methods[i], styles[i][0], h.toReversed(), e.toReversed()]));
    const t = [...x.keys()].map(i => i * step), run = axes(right, { x: [0, 8], y: span(exact.x, x), names: ["t", "x"], ends: ["exact", this.methods.at(-1)] });
    run.curve(exact.t, exact.x, "exact", [8, 5]);
    run.curve(t, x, styles.at(-1)[0], [], 1.2);
    run.ends([["exact", "exact", exact.t, exact.x], [this.methods.at(-1), styles.at(-1)[0], t, x]]);
    if (x.length < 150) for (const i of x.keys()) run.dot(t[i], x[i], styles.at(-1)[0], 2.5);
  },

  drag(values, picture, x) {
    if (picture !== 0) return false;
    const least = 0.5 ** 7 / 1.3, most = 0.5 * 1.3, h = least * (most / least) ** x;
    values.k = Math.min(5, Math.max(0, Math.round(-Math.log2(h)) - 1));
  },
});
