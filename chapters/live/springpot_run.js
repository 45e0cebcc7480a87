// H 0: from a spring through a dashpot to a mass.
FVI_LIVE.scene("springpot_run", {
  about: "Move α: at 0 the springpot is a second spring, at 1/2 a dashpot, at 1 a second mass; in between it is what they are not.",
  controls: { alpha: ["α", 0, 1, 0.25, 0.01], rho: ["ρ", 0, 2, 0.5, 0.02] },
  pictures: ["The body on a spring and a springpot, held at 1 and let go", "What the springpot alone gives way under a force 1"],

  compute({ alpha, rho }, { c, view, run }) {
    const { x, exact } = run({ method: "fvi-lobatto4", alpha, rho, p0: 0, h: 0.1, steps: 300 }, 300);
    const t = view(0, 120), motion = { x: x.slice(), exact: { t: exact.t.slice(), x: exact.x.slice() } };
    t.set(t.map((_, i) => 10 ** (i / 40 - 1)));
    c.live_powers(2 * alpha, 120);
    return { ...motion, t: t.slice(), creep: view(2, 120).map(value => value / rho), at: x[150] };
  },

  says: ({ at }, { alpha }) => `${alpha === 0 ? "A spring" : alpha < 0.5 ? "Between spring and dashpot" : alpha === 0.5 ? "A dashpot"
    : alpha < 1 ? "Between dashpot and mass" : "A mass"}: the body is at ${FVI_LIVE.short(at)} when t = 15; `
    + `the springpot gives way like t to the power ${FVI_LIVE.short(2 * alpha)}.`,

  draw({ x, exact, t, creep }, { rho }, [left, right]) {
    const body = FVI_LIVE.axes(left, { x: [0, 30], y: [-1.1, 1.1], names: ["t", "x"], ends: ["exact, dashed"] });
    const times = [...x.keys()].map(i => i / 10);
    body.curve(times, x, "run");
    body.curve(exact.t, exact.x, "exact", [8, 5], 1);
    body.ends([["body", "run", times, x], ["exact, dashed", "exact", exact.t, exact.x]]);
    const way = FVI_LIVE.axes(right, { x: [0.1, 100], y: [0.01, 1e4], log: "xy", names: ["t", "stretch"], ends: ["springpot"] });
    if (rho > 0) {
      way.curve(t, creep, "negative");
      way.ends([["springpot", "negative", t, creep]]);
    } else way.note("no springpot");
  },
});
