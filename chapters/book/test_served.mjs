// chapters/book/test_served.mjs -- The book from a server, packed: bytes, first paint.      (a part of make test-book)
//
// The server stands on this machine and on a path of its own, as a public host's would. Where
// more work than there are processors, a page may take as many times longer.
import { createServer } from "node:http";
import { existsSync, readFileSync } from "node:fs";
import { availableParallelism, loadavg } from "node:os";
import { extname, join, normalize } from "node:path";
import { gzipSync } from "node:zlib";
import assert from "node:assert/strict";

const MOST = 600e3, PAINTED = 500;
const KINDS = { ".html": "text/html; charset=utf-8", ".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml", ".woff2": "font/woff2" };

export async function testServed({ evaluate, go, name: browser, size }, test, { out, names }) {
  const missing = [], packed = new Map();
  let bytes = 0;
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, "http://here").pathname);
    const file = join(out, normalize(path.replace(/^\/course\//, "")));
    if (!path.startsWith("/course/") || !existsSync(file)) {
      missing.push(path);
      response.writeHead(404).end();
      return;
    }
    const kind = KINDS[extname(file)];
    if (!packed.has(file)) packed.set(file, extname(file) === ".woff2" ? readFileSync(file) : gzipSync(readFileSync(file)));
    bytes += packed.get(file).length + 300; // and a head
    response.writeHead(200, { "content-type": kind, "cache-control": "no-store", ...(extname(file) === ".woff2" ? {} : { "content-encoding": "gzip" }) });
    response.end(packed.get(file));
  });
  await new Promise(done => server.listen(0, "127.0.0.1", done));
  const url = name => `http://127.0.0.1:${server.address().port}/course/${name}`;
  try {
    let most = 0, slowest = 0, crowd = 1;
    await size(1600);
    for (const name of names)
      await test("served", `${name} with all that it shows is below ${MOST / 1000} kB, and painted in ${PAINTED} ms`, async () => {
        let painted = Infinity;
        crowd = Math.max(1, loadavg()[0] / availableParallelism());
        for (let tries = 0; tries < 5 && painted > PAINTED * crowd; tries++) { // the least: others work on this machine too
          bytes = 0;
          await go(url(name));
          painted = Math.min(painted, await evaluate(`new Promise(done => { const look = () => {
            const [entry] = performance.getEntriesByName("first-contentful-paint"); entry ? done(entry.startTime) : setTimeout(look, 20); }; look(); })`));
        }
        await evaluate(`(async () => { for (const figure of document.querySelectorAll("[data-live]")) {
          figure.scrollIntoView();
          while (!figure.live) await new Promise(done => setTimeout(done, 20));
        } })()`);
        assert.ok(bytes < MOST, `${bytes} bytes`);
        assert.ok(painted < PAINTED * crowd, `painted after ${painted} ms`);
        assert.deepEqual(missing, []);
        most = Math.max(most, bytes);
        slowest = Math.max(slowest, painted);
      });
    console.log(`  ${browser}: at most ${Math.round(most / 1000)} kB a page, first paint after at most ${Math.round(slowest)} ms; `
      + `${crowd.toFixed(1)} at work for each processor`);
  } finally {
    server.closeAllConnections();
    server.close();
  }
}
