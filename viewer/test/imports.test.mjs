// SPDX-License-Identifier: MIT
// No module of the page needs itself, types included: each can be read after those that it imports.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import test from "node:test";

const folder = new URL("../src/", import.meta.url);
const importsOf = (name) =>
  [...readFileSync(new URL(`${name}.ts`, folder), "utf8").matchAll(/\bfrom\s+"(\.[\w./]+)"/g)].map(([, to]) =>
    join(name, "..", to),
  );

/// A way from a module back to itself; empty: there is none.
function cycle(modules, imports) {
  const done = new Set();
  const search = (module, path) => {
    if (path.includes(module)) return [...path.slice(path.indexOf(module)), module];
    if (done.has(module)) return [];
    for (const next of imports(module)) {
      const found = search(next, [...path, module]);
      if (found.length > 0) return found;
    }
    done.add(module);
    return [];
  };
  for (const module of modules) {
    const found = search(module, []);
    if (found.length > 0) return found;
  }
  return [];
}

test("no cycle of imports", () => {
  const modules = readdirSync(folder, { recursive: true })
    .filter((name) => name.endsWith(".ts"))
    .map((name) => name.slice(0, -3));
  assert.ok(modules.length > 40 && importsOf("page/main").length > 10);
  assert.deepEqual(cycle(modules, importsOf), []);
  const bad = { a: ["b"], b: ["c", "d"], c: [], d: ["b"] };
  assert.deepEqual(cycle(Object.keys(bad), (name) => bad[name]), ["b", "d", "b"]);
});
