// SPDX-License-Identifier: MIT
// Opens reports in headless Firefox, outside the test suite: node --experimental-websocket
// in_firefox.mjs REPORT.html…. It prints how long each report took to draw its first frame. It
// fails on errors and warnings in the console, except messages about WebGL: three.js writes them on
// a machine without WebGL, which the page itself reports.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const firefox = process.env.FIREFOX ?? "/usr/bin/firefox-esr";
const profile = mkdtempSync(join(tmpdir(), "ph-firefox-"));
const child = spawn(firefox, ["--headless", "--no-remote", "--profile", profile,
  "--remote-debugging-port", "0", "about:blank"]);
const address = await new Promise((found, failed) => {
  let text = "";
  child.stderr.on("data", (some) => {
    text += some;
    const match = /WebDriver BiDi listening on (ws:\S+)/.exec(text);
    if (match) found(match[1]);
  });
  child.on("exit", () => failed(new Error(text)));
});

const socket = new WebSocket(`${address}/session`);
await new Promise((opened) => socket.addEventListener("open", opened));
const waiting = new Map();
let problems = [];
socket.addEventListener("message", ({ data }) => {
  const { id, result, method, params, message } = JSON.parse(data);
  if (method === "log.entryAdded" && ["error", "warn"].includes(params.level) && !/WebGL/.test(params.text))
    problems.push(params.text);
  if (id === undefined) return;
  const { done, failed } = waiting.get(id);
  if (result) done(result);
  else failed(new Error(message));
});
let calls = 0;
const call = (method, params) =>
  new Promise((done, failed) => {
    waiting.set(++calls, { done, failed });
    socket.send(JSON.stringify({ id: calls, method, params }));
  });

let faults = 0;
try {
  await call("session.new", { capabilities: {} });
  await call("session.subscribe", { events: ["log.entryAdded"] });
  const { contexts } = await call("browsingContext.getTree", {});
  const context = contexts[0].context;
  for (const path of process.argv.slice(2)) {
    problems = [];
    const start = performance.now();
    const url = pathToFileURL(resolve(path)).href;
    await call("browsingContext.navigate", { context, url, wait: "complete" });
    const { result } = await call("script.evaluate", {
      target: { context },
      awaitPromise: true,
      expression: `new Promise((done) => { const look = () => {
        const app = document.querySelector("#app[data-first-frame], .failure");
        if (app) done(JSON.stringify([app.className, document.title, document.scripts.length,
          app.dataset.firstFrame]));
        else setTimeout(look, 20); }; look(); })`,
    });
    const [failure, title, scripts, firstFrame] = JSON.parse(result.value);
    faults += problems.length + (failure ? 1 : 0);
    const wall = performance.now() - start;
    console.log(
      `${path}: ${JSON.stringify(title)}, ${scripts} scripts, first frame after ` +
        `${Number(firstFrame).toFixed(0)} ms, ${wall.toFixed(0)} ms in all`,
      failure, problems);
  }
} finally {
  socket.close();
  child.kill();
  await new Promise((ended) => child.on("exit", ended));
  rmSync(profile, { recursive: true, force: true });
}
process.exit(faults ? 1 : 0);
