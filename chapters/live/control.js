// H 25: the least force that brings a body to rest, and what memory does afterwards.
{
const h = 0.01, last = 2000, x0 = 1, p0 = 0.25;
FVI_LIVE.scene("control", {
  about: "Drag the moment of rest: the least force brings the body to x = 0 and p = 0 there. Let go, it moves again, as the damping remembers; "
    + "it stays if a force holds against the damping.",
  c: "chapters-live-inverse",
  controls: { T: ["at rest at T", 1, 15, 10, 0.1], alpha: ["α", 0, 0.95, 0.31, 0.01], rho: ["ρ", 0, 1, 0.375, 0.005] },
  pictures: ["The body: brought to rest and held, and, dashed, let go", "The force: until T, and, dashed, what holds"],

  compute({ T, alpha, rho }, { c, view }) {
    const N = Math.round(T / h);
    c.live_control(alpha, rho, x0, p0, h, N, last);
    const [force, held, freed] = [0, 1, 2].map(which => view(which, last + 1).slice()), [cost, miss] = view(3, 2);
    const largest = array => array.reduce((most, value) => Math.abs(value) > Math.abs(most) ? value : most, 0);
    return { N, force, held, freed, cost, miss, after: largest(freed.slice(N)), stays: largest(held.slice(N)) };
  },

  says({ N, force, cost, after }, { T, alpha, rho }) {
    const three = value => FVI_LIVE.short(Number(value.toPrecision(3)));
    return `It costs ½∫F² = ${three(cost)} to be at rest at T = ${T}. ` + (alpha === 0.5 || rho === 0 ? "There is no memory: let go, the body stays."
      : `Let go, it comes as far as ${three(after)} until t = 20; to hold it takes ${three(force[N + 1])} at first, ${three(force[last])} at the end.`);
  },

  draw({ N, force, held, freed }, { T }, [left, right]) {
    const t = [...held.keys()].map(k => k * h), body = FVI_LIVE.axes(left, { x: [0, 20], y: [-1.2, 1.2], names: ["t", "x"], ends: ["let go"] });
    body.curve([T, T], [-1.2, 1.2], "axis", [], 2);
    body.curve(t, held, "run");
    body.curve(t.slice(N), freed.slice(N), "negative", [7, 4]);
    body.ends([["held", "run", t, held], ["let go", "negative", t, freed]]);
    body.handle(T, 0, "run", 6);
    const pull = FVI_LIVE.axes(right, { x: [0, 20], y: FVI_LIVE.span(force), names: ["t", "F"], ends: ["it holds"] });
    pull.curve(t.slice(0, N + 1), force.slice(0, N + 1), "positive");
    pull.curve(t.slice(N + 1), force.slice(N + 1), "negative", [7, 4]);
    pull.ends([["it holds", "negative", t, force]]);
  },

  drag(values, picture, x) {
    values.T = Number(Math.min(15, Math.max(1, 20 * x)).toFixed(1));
  },
});
}
