// Chapter 7: three pasts of one body, and the one that has no motion.
FVI_LIVE.scene("course_pasts", {
  about: "Move α. One picture has three pasts and what follows from them. The other has the third body again, which came from zero and gets a kick. "
    + "Above α = 1/2 a shorter step makes the kick larger.",
  controls: { alpha: ["α", 0.05, 0.95, 0.75, 0.01], quarters: ["how often the step 0.2 is divided by 4", 0, 3, 3, 1] },
  pictures: ["Held, full; a straight line, dotted; from zero, dashed (h = 0.05)", "From zero, with this step and all longer ones"],

  compute({ alpha, quarters }, { run }) {
    const of = (past, i) => [...run({ method: "fvi", alpha, rho: 0.5, p0: 0.5, past, h: 0.2 / 4 ** i, steps: 30 * 4 ** i }, 1).x];
    const h = 0.2 / 4 ** quarters, zero = Array.from({ length: quarters + 1 }, (_, i) => of("rl", i));
    return { h, held: of("held", 1), line: of("caputo", 1), jumps: of("rl", 1), zero, kick: 0.5 * h ** (1 - 2 * alpha) };
  },

  says: ({ h, kick, zero }, { alpha }) => `With the step ${FVI_LIVE.short(h)} the kick is ρ x₀ h^(1 − 2α) = ${FVI_LIVE.short(Number(kick.toPrecision(3)))}, and from zero `
    + `x(2) = ${FVI_LIVE.short(Number(zero.at(-1)[10 * 4 ** (zero.length - 1)].toPrecision(4)))}. `
    + `A shorter step makes the kick ${alpha > 0.5 ? "larger" : alpha < 0.5 ? "smaller" : "neither larger nor smaller"} for α = ${FVI_LIVE.short(alpha)}.`,

  draw({ held, line, jumps, zero }, values, [left, right]) {
    const times = of => of.map((_, k) => 6 * k / (of.length - 1));
    const pasts = FVI_LIVE.axes(left, { x: [-2, 6], y: FVI_LIVE.span(held, line, jumps, [-0.2]), names: ["t", "x"], ends: ["held"] });
    const draw = (before, of, name, dash) => {
      pasts.curve([-2, 0, 0], [...before, of[0]], name, dash);
      pasts.curve(times(of), of, name, dash);
    };
    draw([1, 1], held, "run", []);
    draw([0, 1], line, "positive", [2, 3]);
    draw([0, 0], jumps, "negative", [7, 4]);
    pasts.ends([["held", "run", times(held), held], ["line", "positive", times(line), line], ["zero", "negative", times(jumps), jumps]]);
    const look = i => (i === zero.length - 1 ? ["negative", [7, 4], 2.4] : ["past", [], 1.2]), name = i => `h = ${FVI_LIVE.short(0.2 / 4 ** i)}`;
    const steps = FVI_LIVE.axes(right, { x: [0, 6], y: FVI_LIVE.span(...zero), names: ["t", "x"], ends: zero.map((_, i) => name(i)) });
    zero.forEach((of, i) => steps.curve(times(of), of, ...look(i)));
    steps.ends(zero.map((of, i) => [name(i), look(i)[0], times(of), of]));
  },
});
