// chapters/live/address.js -- The state of a figure as a link: #fig-13.1&alpha=0.4.
//
// What is as at the start is left out. scene.keeps: { name: how many numbers }, of what is
// dragged and has no slider. Of a link that a stranger wrote, what cannot be is passed over.
function addressOf(id, scene, values) {
  const first = start(scene), words = [id];
  for (const name of [...Object.keys(first), ...Object.keys(scene.keeps ?? {})]) {
    const value = values[name];
    if (value === undefined || String(value) === String(first[name]) || (Array.isArray(value) && value.every(one => one === 0))) continue;
    words.push(`${name}=${Array.isArray(value) ? value.map(one => Number(one.toFixed(3))) : value}`);
  }
  return `#${words.join("&")}`;
}

// The values that such a link asks for; null, if it is the link of something else.
function asked(hash, id, scene) {
  const [name, ...words] = hash.replace(/%2c/gi, ",").slice(1).split("&"), values = {};
  if (name !== id || words.length === 0) return null;
  const own = (kind, of) => (Object.hasOwn(scene[kind] ?? {}, of) ? scene[kind][of] : null);
  for (const [of, text] of words.map(word => word.split("="))) {
    const numbers = (text || "x").split(",").map(Number), control = own("controls", of), [, least, most] = control ?? ["", -10, 10];
    if (own("choices", of)?.slice(1).includes(text)) values[of] = text;
    else if (numbers.length === (control ? 1 : own("keeps", of)) && numbers.every(Number.isFinite)) {
      const within = numbers.map(value => Math.min(Math.max(value, least), most));
      values[of] = within.length > 1 ? within : within[0];
    }
  }
  return values;
}
