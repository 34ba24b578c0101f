// SPDX-License-Identifier: MIT
// Bundles the page into one template, build/report-template.html. The template has the final script
// and style, and their hashes in its content security policy. The programs later replace its marker
// with a payload. Beside the template, report-template.inputs lists all files in the page,
// including files of npm packages. Usage: node build.mjs [output folder]
import { createHash } from "node:crypto";
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const folder = process.argv[2] ?? join(here, "build");

// Uses the source files of three.js instead of the bundle that three.js ships, so that
// report-template.inputs lists the source of everything in the page.
const asWritten = {
  name: "as-written",
  setup(steps) {
    steps.onResolve({ filter: /^three$/ }, (asked) =>
      steps.resolve("three/src/Three.js", { kind: asked.kind, resolveDir: asked.resolveDir }));
  },
};

const inputs = new Set(["src/page/page.html"]);
async function bundle(entry, options) {
  const result = await build({
    absWorkingDir: here,
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    metafile: true,
    charset: "utf8",
    logLevel: "warning",
    plugins: [asWritten],
    ...options,
  });
  for (const path of Object.keys(result.metafile.inputs)) inputs.add(path);
  return result.outputFiles[0].text.trim();
}

const code = await bundle("src/page/main.ts", {
  format: "iife",
  target: "es2022",
  legalComments: "inline",
});
// The licences of the packages in the page, which every copy of the page must include.
const folders = [...inputs].map((path) => /^node_modules\/(@[^/]+\/)?[^/]+/.exec(path)?.[0]);
const notices = [...new Set(folders)].filter(Boolean).sort().map((folder) => {
  const { name, version } = JSON.parse(readFileSync(join(here, folder, "package.json"), "utf8"));
  return `/*! ${name} ${version}\n\n${readFileSync(join(here, folder, "LICENSE"), "utf8").trim()}\n*/\n`;
});
const script = notices.join("") + code;
const style = await bundle("src/page/style.css", {});
for (const [what, text, end] of [
  ["script", script, "</script"],
  ["style", style, "</style"],
])
  if (text.toLowerCase().includes(end)) throw new Error(`the ${what} contains its own end tag`);

// Identifies the sources of the page; libreport/ready_page.cmake computes the same value.
const digest = (text) => createHash("sha256").update(text).digest("hex");
const sources = readdirSync(join(here, "src"), { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile())
  .map((entry) => relative(here, join(entry.parentPath ?? entry.path, entry.name)))
  .concat("build.mjs", "package-lock.json")
  .sort()
  .map((path) => `${digest(readFileSync(join(here, path)))}  ${path}\n`)
  .join("");

const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
const policy = [
  "default-src 'none'",
  `script-src ${hash(script)}`,
  `style-src ${hash(style)}`,
  "img-src data:",
  "base-uri 'none'",
  "form-action 'none'",
  "require-trusted-types-for 'script'",
  "trusted-types 'none'",
].join("; ");

// The replacements are functions, because `$&` in a replacement text would have a special meaning.
const page = readFileSync(join(here, "src/page/page.html"), "utf8")
  .replace("{{policy}}", () => policy)
  .replace("{{sources}}", digest(sources))
  .replace("{{style}}", () => style)
  .replace("{{script}}", () => script);
const marker = "<!--ph:payload-->";
if (page.split(marker).length !== 2) throw new Error("the template needs its marker exactly once");
mkdirSync(folder, { recursive: true });
const path = join(folder, "report-template.html");
writeFileSync(path, page);
writeFileSync(join(folder, "report-template.inputs"), [...inputs].sort().join("\n") + "\n");
console.log(`${path}: ${(page.length / 1024).toFixed(0)} KiB`);
