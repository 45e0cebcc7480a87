// chapters/play/program.mjs -- The page and build/fvi, side by side, for test_play.mjs.
//
// The page is chapters/play/index.html as it is committed: its WebAssembly and its
// model.js are what is run here.
import { spawn, spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { availableParallelism } from "node:os";
import assert from "node:assert/strict";
import vm from "node:vm";

const [, , pageName, program] = process.argv;
export const page = readFileSync(pageName, "utf8");
export const [, wasm, source] =
  page.match(/<script>const wasm = "([^"]*)";<\/script>\n<script>\n([^]*?)<\/script>/);
vm.runInThisContext(source);
export const model = vm.runInThisContext(`({ methods, choices, ranges, first, defaults, stops, fault, parse, link,
  command, before, lacking, decay, parts, unpack, absent, kernel })`);
export const fvi = await model.kernel(wasm);

const heard = new Map(); // the words of a call -> { stdout, said }

// Many calls at once, for `asked` to find: node takes three times as long to start a program as
// a shell does, of which there are as many as processors. After each call both streams get a 0.
export async function ask(calls) {
  const fresh = [...new Set(calls.map(words => words.join(" ")))].filter(call => !heard.has(call));
  const shells = availableParallelism();
  await Promise.all(Array.from({ length: shells }, async (_, i) => {
    const mine = fresh.filter((_, j) => j % shells === i), shell = spawn("sh");
    const [out, said] = [shell.stdout, shell.stderr].map(stream => stream.setEncoding("utf8").toArray());
    shell.stdin.end(mine.map(call => `'${program}' ${call.replaceAll(/\S+/g, "'$&'")}; printf '\\0'; printf '\\0' >&2\n`).join(""));
    const [outs, saids] = (await Promise.all([out, said])).map(pieces => pieces.join("").split("\0"));
    assert.deepEqual([outs.length, saids.length], [mine.length + 1, mine.length + 1]);
    mine.forEach((call, j) => heard.set(call, { stdout: outs[j], said: saids[j] }));
  }));
}

// What the program prints and says.
export function asked(words) {
  const known = heard.get(words.join(" "));
  if (known) return known;
  const { stdout, stderr, error } = spawnSync(program, words, { encoding: "utf8", maxBuffer: 1 << 26 });
  if (error) throw error;
  return { stdout, said: stderr };
}

// Its rows, numbers as it printed them.
export function rows(words) {
  const { stdout, said } = asked(words);
  const text = stdout.replaceAll("inf", "Infinity"); // an energy may overflow
  const lines = text.split("\n").filter(line => line && !line.startsWith("#"));
  return { table: lines.map(line => line.split("\t").map(Number)), said };
}
export const call = state => model.command(state).replaceAll("'", "").split(" ").slice(1);
export const ran = state => rows(call(state));

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
