// Chapter 4: two bodies, bent alike, and what becomes of their action.
FVI_LIVE.scene("course_bend", {
  about: "Bend both bodies, left, by dragging a curve up or down: both alike, the action stands still at first; x alone, it does not. "
    + "Move α: it stands still for every α, as x moves by the integrator.",
  controls: { alpha: ["α", 0, 0.95, 0.25, 0.01], bend: ["size ε of the bend", -0.5, 0.5, 0.3, 0.01] },
  pictures: ["The body x and its mirror y; dotted, both bent", "How the action changes: both bent alike, and x alone, dashed"],

  compute({ alpha, bend }, { c, view, run }, scene) {
    const N = 100, h = 0.1, rho = 0.5;
    const x = [...run({ method: "fvi", alpha, rho, p0: 0, h, steps: N }, 1).x], y = x.slice().reverse();
    const bump = x.map((_, k) => 4 * (k / N) ** 2 * (1 - k / N)), bent = (of, e) => of.map((value, k) => value + e * bump[k]);
    const action = (a, b) => {
      view(0, N + 1).set(bent(x, a));
      view(1, N + 1).set(bent(y, b));
      return c.live_action(alpha, rho, h, N);
    };
    const middle = action(0, 0), e = Array.from({ length: 41 }, (_, i) => (i - 20) / 40);
    if (scene.alpha !== alpha) // the curves once for an alpha
      Object.assign(scene, { alpha, both: e.map(value => action(value, value) - middle), one: e.map(value => action(value, 0) - middle) });
    const { both, one } = scene, tiny = 1e-4;
    return { t: x.map((_, k) => k * h), x, y, bentX: bent(x, bend), bentY: bent(y, bend), e, both, one, middle,
      here: [action(bend, bend) - middle, action(bend, 0) - middle],
      slopes: [(action(tiny, tiny) - action(-tiny, -tiny)) / (2 * tiny), (action(tiny, 0) - action(-tiny, 0)) / (2 * tiny)] };
  },

  says: ({ slopes, here }, { bend }) => `Bent by ε = ${FVI_LIVE.short(bend)}, both alike, the action changes by ${FVI_LIVE.short(Number(here[0].toPrecision(3)))}. `
    + `Its slope at ε = 0 is ${Math.abs(slopes[0]) < 1e-8 ? "0" : slopes[0].toPrecision(3)} for both, and ${FVI_LIVE.short(Number(slopes[1].toPrecision(3)))} for x alone.`,

  draw({ t, x, y, bentX, bentY, e, both, one, here }, { bend }, [left, right]) {
    const paths = FVI_LIVE.axes(left, { x: [0, 10], y: [-1.1, 1.3], names: ["t", "place"], ends: ["y bent"] });
    for (const [of, moved, name] of [[x, bentX, "run"], [y, bentY, "positive"]]) {
      paths.curve(t, of, name);
      paths.curve(t, moved, name, [2, 3], 1.4);
    }
    paths.ends([["x", "run", t, x], ["x bent", "run", t.slice(0, 90), bentX.slice(0, 90)], ["y", "positive", t, y]]);
    paths.handle(t[67], bentX[67], "run", 5); // where the bump is largest
    const change = FVI_LIVE.axes(right, { x: [-0.5, 0.5], y: FVI_LIVE.span(both, one), names: ["ε", "S − S(0)"], ends: ["x alone"] });
    change.curve(e, one, "negative", [7, 4]);
    change.curve(e, both, "run");
    change.ends([["both", "run", e, both], ["x alone", "negative", e, one]]);
    change.handle(bend, here[0], "run", 5);
    change.dot(bend, here[1], "negative", 5, true);
  },

  drag(values, picture, x, y) {
    values.bend = Math.round(100 * Math.min(Math.max(picture === 0 ? y - 0.5 : x - 0.5, -0.5), 0.5)) / 100;
  },
});
