// chapters/play/test_link.mjs -- Links, sliders, and the page as a file.
import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import assert from "node:assert/strict";
import { ask, asked, fvi, meant, model, page, test, wasm } from "./program.mjs";

const { methods, choices, ranges, first, defaults, stops, fault, parse, link, command, unpack, absent } = model;
const source = name => readFileSync(fileURLToPath(new URL(name, import.meta.url)), "utf8");

await test("alpha = 1/2 is kept for those methods only that know no other", async () => {
  const quarter = method => ["run", "--method", method, "--alpha", "0.25", "--steps", "1"];
  await ask(choices.method.map(quarter));
  for (const method of choices.method) {
    const { said } = asked(quarter(method));
    assert.equal(Boolean(methods[method].half), said.includes("all that"), method);
    const { state, wrong } = parse(`#method=${method}&alpha=0.25`);
    assert.equal(state.alpha, methods[method].half ? 0.5 : 0.25, method);
    assert.equal(wrong.length, methods[method].half ? 1 : 0, method);
  }
});

await test("kappa and the past matter to those methods that show them", () => {
  for (const method of choices.method) {
    const { half, kappa } = methods[method];
    const start = `#method=${method}&potential=duffing:1,1`, low = half ? "" : "&alpha=0.3", high = half ? "" : "&alpha=0.7";
    const ends = rest => { const { x, p } = fvi.run(meant(start + rest)); return [x.at(-1), p.at(-1)]; };
    const differ = (a, b) => ends(a).some((value, i) => value !== ends(b)[i]);
    assert.equal(differ(low, low + "&kappa=0.3"), Boolean(kappa), method);
    assert.equal(differ(low, low + "&past=rl"), !half, method);
    assert.equal(differ(low, low + "&past=caputo"), false, method);
    assert.equal(differ(high, high + "&past=caputo"), !half, method);
    assert.equal(differ(high + "&x0=0", high + "&x0=0&past=rl"), false, method);
    assert.equal(differ("", "&past=caputo") || differ("", "&past=rl"), false, `${method}: alpha = 1/2`);
  }
});

await test("links from before there were three pasts mean what they say", () => {
  for (const past of ["caputo", "rl"]) {
    assert.equal(meant(`#alpha=0.9&derivative=${past}`).past, past);
    assert.equal(link(meant(`#derivative=${past}`)), `#past=${past}`);
    assert.equal(command(meant(`#past=${past}`)), `build/fvi run --derivative ${past} --memory direct`);
  }
  assert.equal(meant("#rho=1").past, "held");
  assert.match(parse("#derivative=rl&past=held").wrong[0], /past: given twice/);
});

await test("a link without a word is the first view, and no other run has it", () => {
  for (const empty of ["", "#"]) assert.equal(link(meant(empty)), "#" + first);
  assert.equal(link(defaults()), "#alpha=0.5");
  assert.equal(meant("#rho=1").alpha, 0.5); // a link with a word has the program's defaults
});

await test("a link is the state, whatever it is", () => {
  const pick = values => values[Math.floor(random() * values.length)];
  let seed = 1;
  const random = () => (seed = seed * 48271 % 2147483647) / 2147483647;
  const places = Object.keys(ranges).map(name => [name, stops(name)]);
  for (let i = 0; i < 500; i++) {
    const state = defaults();
    for (const name in choices) state[name] = pick(choices[name]);
    for (const [name, values] of places) state[name] = pick(values);
    if (methods[state.method].half) state.alpha = 0.5;
    const again = meant(link(state));
    assert.equal(link(again), link(state));
    assert.equal(command(again), command(state));
    const { rows, solvable } = fvi.run({ ...state, steps: 10 }, 1);
    assert.equal(rows > 0, solvable || Boolean(methods[state.method].printed));
  }
});

await test("the links of the page and of the chapters are understood, and run", () => {
  const folder = fileURLToPath(new URL("..", import.meta.url)), links = [];
  for (const [, hash] of page.matchAll(/href="(#[^"]*)"/g)) links.push(["page.html", hash.replaceAll("&amp;", "&")]);
  const inPage = links.length;
  for (const name of readdirSync(folder, { recursive: true }).filter(name => name.endsWith(".md")))
    for (const [, hash] of readFileSync(folder + name, "utf8").matchAll(/play\/index\.html(#[^)\s>]*)/g))
      links.push([name, hash]);
  assert.ok(inPage === 8 && links.length - inPage >= 14, `only ${links.length}`);
  for (const [name, hash] of links) {
    const state = meant(hash), { rows, stability } = fvi.run(state);
    assert.ok(rows === state.steps + 1 || stability.crossed, `${name}: ${hash} ends after ${rows} rows`);
  }
  console.log(`  ${links.length} links`);
});

await test("each stop of the tour is one sentence that says what to move and what to see, and its chapter leads to it", () => {
  const stops = [...page.matchAll(/<li hidden><a href="(#[^"]*)"><b>.*?<\/b><\/a>: (.*) \(<a href="\.\.\/([^"]*)">H \d/g)];
  assert.equal(stops.length, 8);
  for (const [, hash, words, chapter] of stops) {
    assert.match(words, /^[A-Z][^.]*(\d\.\d[^.]*)*\.$/, words);
    assert.match(words, / see /);
    const there = [...source(`../${chapter}`).matchAll(/play\/index\.html(#[^)\s>]*)/g)].map(([, to]) => link(meant(to)));
    assert.ok(there.includes(link(meant(hash.replaceAll("&amp;", "&")))), `${chapter} does not lead to ${hash}`);
  }
});

await test("a slider cannot stand outside its range", () => {
  for (const name in ranges) {
    const values = stops(name), [least, most, usual] = ranges[name];
    values.forEach((value, i) => assert.ok(fault(name, value) === "" && (i === 0 || value > values[i - 1])));
    assert.deepEqual([values[0], values.at(-1)], [least, most], name);
    assert.ok(values.includes(usual), name);
  }
});

await test("nonsense in a link is named, and has its default", () => {
  const cases = [
    ["alpha=1.5", "alpha: '1.5' is outside [0, 1]"], ["alpha=", "alpha: '' is not a finite number"],
    ["alpha=0,5", "alpha: '0,5' is not a finite number"], ["alpha=NaN", "'NaN' is not a finite number"],
    ["rho=-1", "outside [0, 4]"], ["h=0", "outside [0.001, 3]"], ["h=1e999", "'1e999' is not a finite"],
    ["h=Infinity", "is not a finite"], ["h=0x10", "is not a finite"], ["steps=20.5", "is not a whole number"],
    ["steps=1e9", "outside [10, 4000]"], ["colour=red", "colour: there is no such parameter"],
    ["c=2", "c: there is no such parameter"], ["method=magic", "'magic' is none of fvi"],
    ["potential=harmonic", "has 0 numbers, not 1"], ["potential=duffing:1", "has 1 numbers, not 2"],
    ["potential=harmonic:x", "'x' is not"], ["potential=free:1", "has 1 numbers, not 0"],
    ["force=step:99,1", "a: '99' is outside"], ["force=step:1,-1", "b: '-1' is outside"],
    ["method=lda&alpha=0.25", "lda knows only 0.5"], ["rho=1&rho=2", "given twice"],
    ["alpha", "is not name=value"], ["=1", "is not name=value"], ["alpha=%", "is not a link's text"],
    ["__proto__=1", "no such parameter"], ["toString=1", "no such parameter"],
    ["past=constructor", "is none of"], ["potential=x;y", "';' is in no expression"], ["derivative=free", "past: 'free' is none of held"], ["<img onerror=x>", "no such parameter"],
  ];
  for (const [hash, complaint] of cases) {
    const { state, wrong } = parse("#" + hash);
    assert.ok(wrong.length === 1 && wrong[0].includes(complaint), `${hash}: ${wrong}`);
    if (!hash.startsWith("rho=1")) assert.equal(link(state).replace("method=lda", "alpha=0.5"), "#alpha=0.5", hash);
  }
  const { state, wrong } = parse("#alpha=7&rho=1.5&nonsense&&h=0.02");
  assert.equal(wrong.length, 2);
  assert.equal(link(state), "#rho=1.5&h=0.02");
});

// ---- the file ----

await test("the page is one file, up to date, that asks nobody for anything", async () => {
  for (const { module, name, kind } of WebAssembly.Module.imports(new WebAssembly.Module(await unpack(wasm)))) {
    assert.match(`${kind} ${module}.${name}`, /^function env\.(fvi|gsl)_/); // what wasm.py says to be absent
    assert.throws(() => absent[name](), { message: `${name} is not in this page` });
  }
  let want = source("page.html").replace("{wasm}", () => wasm);
  for (const name of ["theme.js", "model.js", "plot.js", "explain.js", "play.js"])
    want = want.replace(`{${name}}`, () => source(name).replaceAll(/^\s*\/\/.*\n/gm, "").trim()); // the comments stay in the parts
  assert.equal(page, want, "chapters/play/index.html is older than its parts: make play");
  assert.doesNotMatch(page.replace(wasm, ""), /https?:|\bsrc=|\bimport\b|@import|url\(|fetch\(/);
  // 140,400; of these 12.5 kB are wasi-libc's log, sin of huge numbers, complex products, 13 kB
  // what understands an expression, and 3 kB the nodes of stages, solved eight at once.
  assert.ok(page.length < 145e3);
});
