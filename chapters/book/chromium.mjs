// chapters/book/chromium.mjs -- Chromium as the tests of the book drive a browser; firefox.mjs is the other.
import { open as start } from "../play/browser.mjs";

export async function open() {
  const { call, complaints, close, evaluate, go, key } = await start();
  return {
    name: "Chromium", call, close, evaluate, go, key,
    size: (width, height = 900) => call("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: width < 500 }),
    scheme: value => call("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value }] }),
    scripts: on => call("Emulation.setScriptExecutionDisabled", { value: !on }),
    type: text => call("Input.insertText", { text }),
    complaints: async () => complaints,
  };
}
