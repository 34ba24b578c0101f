// SPDX-License-Identifier: MIT
// Tests the rooms of src/ against the table in README.md. A room imports only what its row names, a
// row names only rows above it and npm packages, no module imports itself through other modules
// (even for types only), and no folder has more than 20 files.
import assert from "node:assert/strict";
import { readdirSync, readFileSync, statSync } from "node:fs";
import { dirname, join } from "node:path/posix";
import test from "node:test";

const kMostFiles = 20;
const viewer = new URL("../", import.meta.url);
const read = (path) => readFileSync(new URL(path, viewer), "utf8");

/// All files below a folder of viewer/, as "charts/axis.ts".
function filesIn(folder) {
  const base = new URL(folder, viewer);
  return readdirSync(base, { recursive: true }).filter((name) =>
    statSync(new URL(name, base)).isFile(),
  );
}

/// The rooms that each room may import, in the order of the table.
function roomsOf(table) {
  const rows = [...table.matchAll(/^\| `(\w+)\/` \|.*\|([^|]*)\|$/gm)];
  const names = (knows) => knows.match(/\w+/g).filter((word) => word !== "nothing");
  return new Map(rows.map(([, room, knows]) => [room, names(knows)]));
}

/// The imports of a module: modules as "charts/axis", packages as "three".
function importsOf(module, text) {
  const found = text.matchAll(/\b(?:from|import)\s*\(?\s*["']([^"']+)["']/g);
  return [...found].map(([, to]) =>
    to.startsWith(".") ? join(dirname(module), to) : to.split("/")[0],
  );
}

/// A cycle of imports from a module to itself; empty if there is none.
function cycle(imports) {
  const done = new Set();
  const search = (module, path) => {
    if (path.includes(module)) return [...path.slice(path.indexOf(module)), module];
    if (done.has(module)) return [];
    for (const next of imports.get(module) ?? []) {
      const found = search(next, [...path, module]);
      if (found.length > 0) return found;
    }
    done.add(module);
    return [];
  };
  for (const module of imports.keys()) {
    const found = search(module, []);
    if (found.length > 0) return found;
  }
  return [];
}

/// Violations of the table. @param imports the imports of each module of src/. @param rooms the
/// rooms that each room may import.
function faultsOf(imports, rooms, packages) {
  const faults = [];
  const order = [...rooms.keys()];
  for (const [room, knows] of rooms)
    for (const other of knows)
      if (!packages.includes(other) && !order.slice(0, order.indexOf(room)).includes(other))
        faults.push(`README.md: ${room} knows ${other}, which is no row above it and no package`);
  for (const [module, wanted] of imports) {
    const room = dirname(module);
    if (!rooms.has(room)) faults.push(`${module} is in no room of README.md`);
    for (const to of wanted) {
      const isPackage = packages.includes(to);
      if (!isPackage && !imports.has(to))
        faults.push(`${module} imports ${to}: found no such module`);
      const other = isPackage ? to : dirname(to);
      if (other !== room && !rooms.get(room)?.includes(other))
        faults.push(`${module} imports ${to}: ${room} does not know ${other}`);
    }
  }
  const circle = cycle(imports);
  if (circle.length > 0) faults.push(`cycle: ${circle.join(" → ")}`);
  return faults;
}

/// Folders with too many files.
function fullFolders(files) {
  const counts = new Map();
  for (const file of files) counts.set(dirname(file), (counts.get(dirname(file)) ?? 0) + 1);
  return [...counts].filter(([, count]) => count > kMostFiles).map(([folder]) => folder);
}

test("rooms import as README.md says, and nothing in a circle", () => {
  const rooms = roomsOf(read("README.md"));
  const modules = filesIn("src/")
    .filter((name) => name.endsWith(".ts"))
    .map((name) => name.slice(0, -3));
  const imports = new Map(modules.map((m) => [m, importsOf(m, read(`src/${m}.ts`))]));
  assert.ok(modules.length > 40 && imports.get("page/main").length > 10);
  const used = new Set(modules.map((module) => dirname(module)));
  assert.deepEqual([...rooms.keys()].sort(), [...used].sort());
  const packages = Object.keys(JSON.parse(read("package.json")).dependencies);
  assert.deepEqual(faultsOf(imports, rooms, packages), []);
});

test("no folder has too many files", () => {
  assert.deepEqual(fullFolders(filesIn("src/")), []);
  assert.deepEqual(fullFolders(filesIn("test/")), []);
  const files = Array.from({ length: kMostFiles }, (_, i) => `a/${i}.ts`);
  assert.deepEqual(fullFolders([...files, "b/0.ts"]), []);
  assert.deepEqual(fullFolders([...files, "a/b/0.ts", "a/style.css"]), ["a"]);
});

test("what is out of order is found", () => {
  const rooms = roomsOf("| `low/` | a \\| b | nothing |\n| `high/` | c | low, three |\n");
  assert.deepEqual([...rooms], [["low", []], ["high", ["low", "three"]]]);
  const faults = (texts) => {
    const modules = { "low/a": "", "high/b": "", "high/c": "", ...texts };
    const imports = Object.entries(modules).map(([m, text]) => [m, importsOf(m, text)]);
    return faultsOf(new Map(imports), rooms, ["three"]).join("; ");
  };
  assert.equal(faults({}), "");
  const right = 'import {\n  a,\n} from "../low/a";\nimport "three/x.js";\nexport * from "./c";';
  assert.equal(faults({ "high/b": right }), "");
  const low = (text) => faults({ "low/a": text });
  assert.match(low('import type { B } from "../high/b";'), /low does not know high/);
  assert.match(low('const b = await import("../high/b");'), /low does not know high/);
  assert.match(low('import { Vector3 } from "three";'), /low does not know three/);
  assert.match(low('import "./nothing";'), /found no such module/);
  assert.match(low('import "esbuild";'), /found no such module/);
  assert.match(faults({ main: "" }), /main is in no room/);
  assert.match(faults({ "other/d": "" }), /d is in no room/);
  const circle = { "high/b": 'import "./c";', "high/c": 'export { b } from "./b";' };
  assert.equal(faults(circle), "cycle: high/b → high/c → high/b");
  const upwards = new Map([["low", ["high"]], ["high", []]]);
  assert.match(faultsOf(new Map(), upwards, []).join(), /low knows high, which is no row above it/);
});
