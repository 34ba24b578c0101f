// SPDX-License-Identifier: MIT
// The parts of synthetic reports.

export const kNone = 0xffffffff;

/// @param bars [dim, birth, death] each.
export function barArrays(bars, prefix = "bars") {
  const columns = [Uint8Array, Float64Array, Float64Array].map((Type, k) => {
    const column = new Type(bars.length); // for a million bars an iterator is slow
    for (let i = 0; i < bars.length; ++i) column[i] = bars[i][k];
    return column;
  });
  return Object.fromEntries(
    ["dim", "birth", "death"].map((name, k) => [`${prefix}/${name}`, columns[k]]),
  );
}

export function metaOf(title, more = {}) {
  return {
    format: "ph-report",
    version: 1,
    title,
    program: "ph-barcode 0.1.0",
    value: { label: "Filtration value" },
    barcodes: [{ name: title, cells: "vertices" }],
    ...more,
    provenance: {
      version: "ph-barcode 0.1.0",
      command: ["ph-barcode", title, "--report", "out.html"],
      field: 2,
      input: {
        path: title,
        sha256: "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855",
      },
      engine: "edge-links",
      timings: { read: 0.0021, persistence: 0.184, write: 0.02 },
      peak_memory: 41_000_000,
      ...more.provenance,
    },
  };
}

/// The order of a barcode.
export const byOrder = (a, b) => a[0] - b[0] || a[1] - b[1] || a[2] - b[2];
