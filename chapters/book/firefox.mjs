// chapters/book/firefox.mjs -- A headless Firefox on a socket (Marionette), with the face of chromium.mjs.
//
// A message is LENGTH:[0, id, command, parameters], its answer LENGTH:[1, id, error, result].
// What a page may not do itself, its width below a window's least, the system's theme, no
// scripts, is set in Firefox's own context ("chrome"), where complaints are gathered too.
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";

// No request of its own; and the port is one that is free.
const PREFERENCES = { "marionette.port": 0, "browser.shell.checkDefaultBrowser": false, "browser.startup.page": 0,
  "datareporting.policy.dataSubmissionEnabled": false, "app.update.enabled": false, "network.captive-portal-service.enabled": false,
  "network.connectivity-service.enabled": false, "browser.safebrowsing.update.enabled": false, "extensions.update.enabled": false,
  "services.settings.server": "data:,", "browser.newtabpage.enabled": false, "security.fileuri.strict_origin_policy": true };
const KEYS = { Escape: "\uE00C", ArrowDown: "\uE015", Tab: "\uE004" };
const pause = milliseconds => new Promise(done => setTimeout(done, milliseconds));

// Gathers, in Firefox's own context, what Chromium's DevTools say of a page; but not that a formula
// lacks children, which is said of those of which the half has come.
const WATCH = `const heard = window.heard = [];
  Services.console.registerListener({ observe(message) {
    if (message instanceof Ci.nsIScriptError && /^(file|blob|data):/.test(message.sourceName) && !(message.flags & 1)
        && !message.errorMessage.includes("Incorrect number of children"))
      heard.push(message.sourceName + ": " + message.errorMessage);
  } });
  Services.obs.addObserver({ observe(request) {
    const about = request.QueryInterface(Ci.nsIHttpChannel);
    if (about.loadInfo?.browsingContextID) heard.push("request: " + about.URI.spec);
  } }, "http-on-modify-request");`;

export async function open() {
  const profile = mkdtempSync(join(tmpdir(), "fvi-firefox-"));
  writeFileSync(join(profile, "user.js"), Object.entries(PREFERENCES).map(([name, value]) =>
    `user_pref("${name}", ${JSON.stringify(value)});\n`).join(""));
  const child = spawn("firefox-esr", ["--headless", "--no-remote", "--marionette", "--remote-allow-system-access", "--profile", profile, "about:blank"],
    { stdio: "ignore", env: { ...process.env, MOZ_HEADLESS_WIDTH: "1600", MOZ_HEADLESS_HEIGHT: "1000", HOME: profile } });
  let gone = false;
  await new Promise((resolve, reject) => {
    child.once("spawn", resolve);
    child.once("error", () => reject(new Error("firefox-esr is not there")));
  });
  const ended = new Promise(resolve => child.once("exit", () => { gone = true; resolve(); }));
  const left = () => rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
  let port = 0;
  for (let tries = 0; !port && tries < 600 && !gone; tries++) {
    await pause(100);
    try { port = Number(readFileSync(join(profile, "MarionetteActivePort"), "utf8")); } catch { /* not yet */ }
  }
  if (!port) {
    child.kill();
    throw new Error("firefox-esr does not open its socket");
  }
  const socket = connect(port, "127.0.0.1"), waiting = new Map();
  let bytes = Buffer.alloc(0), last = 0;
  socket.on("data", more => {
    bytes = Buffer.concat([bytes, more]);
    for (;;) {
      const colon = bytes.indexOf(":"), length = Number(bytes.subarray(0, Math.max(colon, 0)));
      if (colon < 0 || bytes.length < colon + 1 + length) return;
      const message = JSON.parse(bytes.subarray(colon + 1, colon + 1 + length));
      bytes = bytes.subarray(colon + 1 + length);
      if (!Array.isArray(message)) continue; // its greeting
      const [, id, error, result] = message, { resolve, reject } = waiting.get(id);
      waiting.delete(id);
      error ? reject(new Error(error.message)) : resolve(result);
    }
  });
  const lost = () => { for (const { reject } of waiting.values()) reject(new Error("firefox-esr is gone")); };
  socket.on("close", lost).on("error", lost);
  const call = (command, parameters = {}) => new Promise((resolve, reject) => {
    waiting.set(++last, { resolve, reject });
    const text = JSON.stringify([0, last, command, parameters]);
    socket.write(`${Buffer.byteLength(text)}:${text}`);
  });
  await call("WebDriver:NewSession", { capabilities: { alwaysMatch: { unhandledPromptBehavior: "ignore" } } });
  await call("WebDriver:SetTimeouts", { script: 600000, pageLoad: 120000 });

  const run = async (script, args) => (await call("WebDriver:ExecuteScript", { script, args, sandbox: null, newSandbox: false })).value;
  const within = async (script, ...args) => {
    await call("Marionette:SetContext", { value: "chrome" });
    try {
      return await run(`const tab = gBrowser.selectedBrowser; ${script}`, args);
    } finally {
      await call("Marionette:SetContext", { value: "content" });
    }
  };
  const press = async keys => {
    const actions = [...keys].flatMap(value => [{ type: "keyDown", value }, { type: "keyUp", value }]);
    await call("WebDriver:PerformActions", { actions: [{ type: "key", id: "keys", actions }] });
  };
  await within(WATCH);

  return {
    name: "Firefox", call,
    async go(url) {
      for (const there of ["about:blank", url]) await call("WebDriver:Navigate", { url: there }); // a new hash alone would load nothing
    },
    // The text runs as a script of the page: it sees the consts of the page's scripts.
    async evaluate(text) {
      const value = await run(`return Promise.resolve(window.eval(arguments[0])).then(value => JSON.stringify(value));`, [text]);
      return value === null ? undefined : JSON.parse(value);
    },
    async size(width, height = 900) {
      await within(`for (const [name, value] of [["width", arguments[0]], ["height", arguments[1]]])
        for (const rule of [name, "min-" + name, "max-" + name]) tab.style.setProperty(rule, value + "px", "important");`, width, height);
      for (let tries = 0; tries < 100; tries++)
        if (await run("return innerWidth", []) === width) return;
        else await pause(20);
      throw new Error(`no window of ${width} pixels`);
    },
    scheme: value => within(`Services.prefs.setIntPref("layout.css.prefers-color-scheme.content-override", arguments[0]);`, value === "dark" ? 0 : 1),
    scripts: on => within(`tab.browsingContext.allowJavascript = arguments[0];`, on),
    key: key => press([KEYS[key]]),
    type: press,
    complaints: () => within("return window.heard;"),
    async close() {
      const late = setTimeout(() => child.kill("SIGKILL"), 20000); // it may hang, too
      call("Marionette:Quit", { flags: ["eForceQuit"] }).catch(() => {});
      await ended;
      clearTimeout(late);
      socket.destroy();
      left();
    },
  };
}
