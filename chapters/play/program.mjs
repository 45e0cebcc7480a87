// chapters/play/program.mjs -- The page and build/fvi, side by side, for test_play.mjs.
//
// The page is chapters/play/index.html as it is committed: its WebAssembly and its
// model.js are what is run here.
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import assert from "node:assert/strict";
import vm from "node:vm";

const [, , pageName, program] = process.argv;
export const page = readFileSync(pageName, "utf8");
export const [, wasm, source] =
  page.match(/<script>const wasm = "([^"]*)";<\/script>\n<script>\n([^]*?)<\/script>/);
vm.runInThisContext(source);
export const model = vm.runInThisContext(`({ methods, choices, ranges, first, defaults, stops, fault, parse, link,
  command, before, lacking, decay, unpack, kernel })`);
export const fvi = await model.kernel(wasm);

// What the program prints and says.
export function asked(words) {
  const { stdout, stderr, error } = spawnSync(program, words, { encoding: "utf8", maxBuffer: 1 << 26 });
  if (error) throw error;
  return { stdout, said: stderr };
}

// Its rows, numbers as it printed them.
export function rows(words) {
  const { stdout, said } = asked(words);
  const lines = stdout.split("\n").filter(line => line && !line.startsWith("#"));
  const number = text => Number(text.replace("inf", "Infinity")); // an energy may overflow
  return { table: lines.map(line => line.split("\t").map(number)), said };
}
export const ran = state => rows(model.command(state).split(" ").slice(1));

// The state of a link that must be understood.
export function meant(hash) {
  const { state, wrong } = model.parse(hash);
  assert.deepEqual(wrong, [], hash);
  return state;
}

export let tests = 0;
export async function test(name, body) {
  try {
    await body();
  } catch (error) {
    console.error(`not ok: ${name}`);
    throw error;
  }
  tests++;
}
