// SPDX-License-Identifier: MIT
// What made-up reports are put together from.

export const kNone = 0xffffffff;

/// @param bars [dim, birth, death] each.
export function barArrays(bars, prefix = "bars") {
  return {
    [`${prefix}/dim`]: Uint8Array.from(bars, (b) => b[0]),
    [`${prefix}/birth`]: Float64Array.from(bars, (b) => b[1]),
    [`${prefix}/death`]: Float64Array.from(bars, (b) => b[2]),
  };
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
