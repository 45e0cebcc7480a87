// chapters/live/drawn.js -- A curve that is drawn by hand, as its places at 61 knots: what H 5 and 7 share.
const KNOTS = 60;
const bump = (N, top) => Array.from({ length: N + 1 }, (_, k) => Math.exp(-(((k - top) / 30) ** 2)));
const drawn = {
  keeps: { drawn: KNOTS + 1 },

  // N + 1 places, straight between the knots; a bump about `top` until something is drawn.
  curve({ drawn: knots }, N, top) {
    if (!knots) return bump(N, top);
    return Array.from({ length: N + 1 }, (_, k) => {
      const at = k * KNOTS / N, i = Math.min(Math.floor(at), KNOTS - 1);
      return knots[i] + (at - i) * (knots[i + 1] - knots[i]);
    });
  },

  // With the pen where it was last, or at the highest place.
  draw(canvas, { last }, t, x) {
    const picture = axes(canvas, { x: [t[0], t.at(-1)], y: [-1.5, 1.5], names: ["t", "x"], ends: ["x"] });
    const pen = last === undefined ? x.indexOf(Math.max(...x)) : last * (x.length - 1) / KNOTS;
    picture.curve(t, x, "exact");
    picture.ends([["x", "exact", t, x]]);
    picture.handle(t[pen], x[pen], "exact", 4);
  },

  // The knots under the pointer: straight from where it was last. The axis y goes from -1.5 to 1.5.
  drag(values, x, y, type, N, top) {
    const knots = values.drawn ??= bump(N, top).filter((_, k) => k % (N / KNOTS) === 0).map(place => Number(place.toFixed(3)));
    const i = Math.round(x * KNOTS), height = 3 * y - 1.5, from = type === "pointerdown" ? i : values.last, by = Math.sign(i - from) || 1, first = knots[from];
    for (let j = from; j !== i + by; j += by) knots[j] = Number((from === i ? height : first + (height - first) * (j - from) / (i - from)).toFixed(3));
    values.last = i;
  },
};
