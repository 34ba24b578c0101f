// SPDX-License-Identifier: MIT
// Writes every made-up report to a folder, to be looked at: node test/support/write_fixtures.mjs [folder]
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import * as odd from "./odd_fixtures.mjs";
import * as plain from "./fixtures.mjs";
import { reportHtml } from "./write_report.mjs";

const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
const folder = process.argv[2] ?? join(root, "build/fixtures");
const template = readFileSync(join(root, "build/report-template.html"), "utf8");
const all = {
  torus: plain.torus, clusters: plain.clusters, image: plain.image, volume: () => plain.image([28, 36, 44]), scene: plain.scene,
  ...odd,
};
mkdirSync(folder, { recursive: true });
for (const [name, make] of Object.entries(all)) {
  const { meta, arrays } = make();
  const html = reportHtml(template, meta, arrays);
  writeFileSync(join(folder, `${name}.html`), html);
  console.log(`${name}.html ${(html.length / 2 ** 20).toFixed(2)} MiB`);
}
