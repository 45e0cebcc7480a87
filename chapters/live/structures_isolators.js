// H 27: a building on isolators of an alpha to be chosen, in an earthquake and in a wind.
{
const steps = 4000, floors = 6, seen = 4; // of the floors' places each fourth
const GROUND = 6, ROOF = 7; // arrays of building.c
const three = value => FVI_LIVE.short(Number(value.toPrecision(3)));

FVI_LIVE.scene("structures_isolators", {
  about: "Choose the isolators by their α, and watch the roof. A test at one frequency cannot tell them apart, and in the earthquake the roof "
    + "hardly can. Then choose the wind.",
  kernel: ["building_kernel", () => FVI_WASM_BUILDING],
  c: "chapters-live-building",
  controls: { alpha: ["α of the isolators", 0.095, 0.5, 0.2, 0.005] },
  choices: { load: ["load", "earthquake", "wind"] },
  buttons: { again: ["Once more", FVI_LIVE.again] },
  pictures: ["The building on its isolators, and the same on firm ground", "In the earthquake the acceleration of the roof, in the wind the shift of the slab"],

  compute(values, { c, view }, scene) {
    const { alpha, load } = values;
    values.at ??= 0;
    scene.known ??= new Map(); // one building moves, and the motion goes on for many pictures
    const of = (a, isKept) => {
      const name = `${a} ${load}`;
      if (scene.known.has(name)) return scene.known.get(name);
      const spring = c.live_building(a, load === "wind" ? 1 : 0);
      const places = Array.from({ length: floors }, (_, i) => [...view(i, steps + 1).filter((_, k) => k % seen === 0)]);
      const found = { spring, places, roof: [...view(ROOF, steps)], ground: [...view(GROUND, steps + 1)] };
      if (isKept) scene.known.set(name, found);
      return found;
    };
    if (scene.last !== `${alpha} ${load}`) {
      if (scene.last?.split(" ")[1] !== load) FVI_LIVE.again(values);
      Object.assign(scene, { last: `${alpha} ${load}`, chosen: of(alpha) });
    }
    const others = load === "wind" ? [of(0.1, true), of(0.4, true)] : [];
    return { ...scene.chosen, firm: of(0, true), others: others.map(({ places }) => places[0]) };
  },

  more: (data, values) => FVI_LIVE.goOn(values, steps, steps / 7000),

  says({ spring, places, roof, firm }, { alpha, load }) {
    const most = of => of.reduce((top, value) => Math.max(top, Math.abs(value)), 0), about = `α = ${FVI_LIVE.short(alpha)}: beside the springpot stands a spring of ${three(spring)}. `;
    return load === "wind" ? `${about}When the wind has blown for 200 seconds, the slab has moved by ${three(places[0].at(-1))}.`
      : `${about}The roof feels an acceleration of ${three(most(roof))} at most; on firm ground it feels ${three(most(firm.roof))}.`;
  },

  draw({ places, roof, firm, others }, { alpha, load, at }, [left, right]) {
    const isWind = load === "wind", larger = isWind ? 5 : 1, now = Math.floor(at / seen);
    const house = FVI_LIVE.axes(left, { x: [-0.7, 1.9], y: [-0.9, 7], names: ["x", "floor"] });
    house.curve([-0.7, 1.9], [0, 0], "axis", [], 3);
    const building = (of, from, colour, isIsolated) => {
      const x = of.map(floor => from + larger * floor[now]);
      x.forEach((place, i) => house.curve([place - 0.25, place + 0.25], [i + 0.5, i + 0.5], colour, [], i ? 2 : 4));
      for (const side of [-0.25, 0.25]) house.curve(x.map(place => place + side), x.map((_, i) => i + 0.5), colour, [], 1.4);
      for (const side of [-0.2, 0, 0.2]) house.curve([from + side, (from + x[0]) / 2 + side + (isIsolated ? 0.06 : 0), x[0] + side], [0, 0.25, 0.5], colour, [], isIsolated ? 1.6 : 4);
      house.text(from - 0.35, 6.5, isIsolated ? "isolators" : "firm ground", colour);
    };
    building(places, 0, "run", true);
    building(firm.places, 1.2, "soft-ink", false);
    if (isWind) house.text(-0.7, -0.5, "shifts are drawn five times as long", "soft-ink");
    if (isWind) drawWind(right, { places, others }, alpha, at / 20);
    else drawRoof(right, roof, firm.roof, at / 200);
  },
});

function drawRoof(canvas, roof, firm, now) {
  const t = roof.map((_, k) => (k + 0.5) / 200), picture = FVI_LIVE.axes(canvas, { x: [0, 20], y: [-14, 14], names: ["t", "acceleration"], ends: ["firm ground"] });
  picture.curve(t, firm, "past", [], 1);
  picture.curve(t, roof, "run");
  picture.curve([now, now], [-14, 14], "axis", [3, 3], 1);
  picture.ends([["isolators", "run", t, roof.map(() => 2)], ["firm ground", "past", t, roof.map(() => -2)]]);
}

function drawWind(canvas, { places, others }, alpha, now) {
  const t = places[0].map((_, i) => i * seen / 20), picture = FVI_LIVE.axes(canvas, { x: [0, 200], y: [0, 0.06], names: ["t", "slab"], ends: ["α = 0.135"] });
  others.forEach(slab => picture.curve(t, slab, "past", [7, 4], 1.2));
  picture.curve(t, places[0], "run");
  picture.curve([now, now], [0, 0.06], "axis", [3, 3], 1);
  picture.ends([...others.map((slab, i) => [`α = ${[0.1, 0.4][i]}`, "past", t, slab]), [`α = ${FVI_LIVE.short(alpha)}`, "run", t, places[0]]]);
}
}
