// SPDX-License-Identifier: MIT
// Writes every synthetic report to a folder for inspection: node test/support/write_fixtures.mjs
// [folder]
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import * as odd from "./odd_fixtures.mjs";
import { image } from "./image_fixture.mjs";
import { clusters, torus } from "./point_fixtures.mjs";
import { scene } from "./scene_fixture.mjs";
import { reportHtml } from "./write_report.mjs";

const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
const folder = process.argv[2] ?? join(root, "build/fixtures");
const template = readFileSync(join(root, "build/report-template.html"), "utf8");
const all = {
  torus,
  clusters,
  image,
  volume: () => image([28, 36, 44]),
  scene,
  ...odd,
};
mkdirSync(folder, { recursive: true });
for (const [name, make] of Object.entries(all)) {
  const { meta, arrays } = make();
  const html = reportHtml(template, meta, arrays);
  writeFileSync(join(folder, `${name}.html`), html);
  console.log(`${name}.html ${(html.length / 2 ** 20).toFixed(2)} MiB`);
}
