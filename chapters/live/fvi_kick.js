// H 9: the first step, as it is printed, kicks the body.
FVI_LIVE.scene("fvi_kick", {
  about: "Make the step smaller: as printed, the body was at 0 before it stood at 1, and is kicked the harder; held, nothing happens.",
  controls: { h: ["step h", 0.004, 0.5, 0.1, "log"], alpha: ["α", 0.5, 1, 0.9, 0.01] },
  pictures: ["As printed", "Held"],

  compute({ h, alpha }, { run }) {
    const state = { method: "fvi", alpha, rho: 0.2, h, steps: Math.ceil(15 / h), p0: 0 };
    const printed = run({ ...state, past: "rl" }, 10).x.slice(), held = run({ ...state, past: "held" }, 10).x.slice();
    const most = x => x.reduce((m, value) => Math.max(m, Math.abs(value)), 0);
    return { printed, held, sizes: [most(printed), most(held)], t: [...held.keys()].map(k => k * h) };
  },

  says: ({ sizes }, { h }) => `h = ${FVI_LIVE.short(h)}: largest |x| is ${FVI_LIVE.short(sizes[0])} as printed, ${FVI_LIVE.short(sizes[1])} held.`,

  draw({ t, printed, held, sizes }, values, canvases) {
    const top = Math.max(1.2, 1.1 * sizes[0]), axes = { x: [0, 15], y: [-top, top], names: ["t", "x"], ends: ["printed"] };
    [["printed", printed, "negative"], ["held", held, "run"]].forEach(([name, x, colour], i) => {
      const one = FVI_LIVE.axes(canvases[i], axes);
      one.curve(t, x, colour);
      one.ends([[name, colour, t, x]]);
    });
  },
});
