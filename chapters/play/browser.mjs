// chapters/play/browser.mjs -- A headless Chromium on a pipe (DevTools protocol).
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

// Opens one empty tab. call(method, parameters) asks it; evaluate(text) runs text
// in the page; complaints collects errors, warnings and requests to the network.
export async function open() {
  const profile = mkdtempSync(join(tmpdir(), "fvi-play-"));
  const child = spawn("chromium", ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
    "--disable-extensions", `--user-data-dir=${profile}`, "--remote-debugging-pipe", "about:blank"],
  { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
  const [, , , out, from] = child.stdio, waiting = new Map(), complaints = [], loaded = new Set();
  let last = 0, text = "", session, arrived = () => {};

  function hear(message) {
    const { id, method, params, result, error } = message;
    if (waiting.has(id)) {
      const { resolve, reject } = waiting.get(id);
      waiting.delete(id);
      return error ? reject(new Error(error.message)) : resolve(result);
    }
    if (method === "Runtime.exceptionThrown") complaints.push(params.exceptionDetails.exception?.description);
    if (method === "Runtime.consoleAPICalled") complaints.push(`console: ${params.args[0]?.value}`);
    if (method === "Log.entryAdded") complaints.push(`log: ${params.entry.text}`);
    if (method === "Network.requestWillBeSent" && !/^(file|data):/.test(params.request.url))
      complaints.push(`request: ${params.request.url}`);
    if (method === "Inspector.targetCrashed") // nobody would answer
      for (const { reject } of waiting.values()) reject(new Error("the page crashed"));
    if (method === "Page.lifecycleEvent" && params.name === "load") {
      loaded.add(params.loaderId);
      arrived();
    }
  }
  from.on("data", bytes => {
    const parts = (text + bytes).split("\0");
    text = parts.pop();
    parts.forEach(part => hear(JSON.parse(part)));
  });
  const call = (method, params = {}) => new Promise((resolve, reject) => {
    waiting.set(++last, { resolve, reject });
    out.write(JSON.stringify({ id: last, method, params, sessionId: session }) + "\0");
  });
  await new Promise((resolve, reject) => {
    child.once("spawn", resolve);
    child.once("error", () => reject(new Error("chromium is not there: apt-get install chromium")));
  });
  const { targetInfos } = await call("Target.getTargets");
  const targetId = targetInfos.find(target => target.type === "page").targetId;
  session = (await call("Target.attachToTarget", { targetId, flatten: true })).sessionId;
  for (const domain of ["Page", "Runtime", "Log", "Network", "Inspector"]) await call(`${domain}.enable`);
  await call("Page.setLifecycleEventsEnabled", { enabled: true });
  await call("Emulation.setFocusEmulationEnabled", { enabled: true }); // as if its window were in front

  return {
    call, complaints,
    async go(url) {
      for (const there of ["about:blank", url]) { // a new hash alone would load nothing
        const { loaderId, errorText } = await call("Page.navigate", { url: there });
        if (errorText) throw new Error(`${there}: ${errorText}`);
        while (!loaded.has(loaderId)) await new Promise(resolve => { arrived = resolve; }); // this page, not the one before
      }
    },
    async evaluate(expression) {
      const { result, exceptionDetails } = await call("Runtime.evaluate",
        { expression, awaitPromise: true, returnByValue: true });
      if (exceptionDetails) throw new Error(exceptionDetails.exception.description);
      return result.value;
    },
    async mouse(type, x, y) {
      const buttons = type === "mouseReleased" ? 0 : 1;
      await call("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons, clickCount: 1 });
    },
    async key(key) {
      const windowsVirtualKeyCode = { Tab: 9, Escape: 27, End: 35, Home: 36, ArrowRight: 39, ArrowDown: 40 }[key];
      for (const type of ["keyDown", "keyUp"])
        await call("Input.dispatchKeyEvent", { type, key, code: key, windowsVirtualKeyCode });
    },
    async close() {
      const ended = new Promise(resolve => child.once("exit", resolve));
      const late = setTimeout(() => child.kill("SIGKILL"), 20000); // it may hang, too
      call("Browser.close").catch(() => {});
      await ended;
      clearTimeout(late);
      rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
    },
  };
}
