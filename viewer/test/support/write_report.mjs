// SPDX-License-Identifier: MIT
// Writes a report as docs/reference/report-format.md describes it and as the C++ programs write it.
import { deflateSync } from "node:zlib";

const kTypes = new Map([
  [Uint8Array, "u8"],
  [Int8Array, "i8"],
  [Uint16Array, "u16"],
  [Int16Array, "i16"],
  [Uint32Array, "u32"],
  [Int32Array, "i32"],
  [Float32Array, "f32"],
  [Float64Array, "f64"],
]);

const attribute = (text) =>
  String(text).replace(/&/g, "&amp;").replace(/"/g, "&quot;").replace(/</g, "&lt;");

/// The difference of each number from the number in the previous row, modulo the width of the type.
function differences(values, columns) {
  const result = values.slice();
  for (let i = values.length - 1; i >= columns; --i) result[i] = values[i] - values[i - columns];
  return result;
}

function planes(bytes, size) {
  const result = new Uint8Array(bytes.length),
    count = bytes.length / size;
  for (let i = 0; i < count; ++i)
    for (let k = 0; k < size; ++k) result[k * count + i] = bytes[i * size + k];
  return result;
}

/// One array. @param more shape, filter ("delta planes"), offset, scale.
export function arrayBlock(
  name,
  values,
  { shape = [values.length], filter = "", offset, scale } = {},
) {
  const columns = shape.length > 1 ? values.length / (shape[0] || 1) : 1;
  const stored = filter.includes("delta") ? differences(values, columns) : values;
  let bytes = new Uint8Array(stored.buffer, stored.byteOffset, stored.byteLength);
  if (filter.includes("planes")) bytes = planes(bytes, values.BYTES_PER_ELEMENT);
  const attributes = {
    array: name,
    type: kTypes.get(values.constructor),
    shape: shape.join(),
    filter: filter || undefined,
    offset: offset?.join(),
    scale: scale?.join(),
  };
  const text = Object.entries(attributes)
    .filter(([, v]) => v !== undefined)
    .map(([k, v]) => ` data-${k}="${attribute(v)}"`)
    .join("");
  return `<script type="application/x-ph-array"${text}>${deflateSync(bytes).toString("base64")}</script>`;
}

/// @param arrays maps a name to numbers, or to [numbers, more].
export function reportHtml(template, meta, arrays) {
  const json = JSON.stringify(meta).replace(/</g, "\\u003c");
  const blocks = Object.entries(arrays).map(([name, value]) =>
    Array.isArray(value)
      ? arrayBlock(name, ...value)
      : arrayBlock(name, value, { filter: defaultFilter(value) }),
  );
  const payload = [`<script type="application/json" id="ph-meta">${json}</script>`, ...blocks].join(
    "\n",
  );
  return template.replace("<!--ph:payload-->", () => payload);
}

function defaultFilter(values) {
  if (values instanceof Float64Array || values instanceof Float32Array) return "planes";
  return values.BYTES_PER_ELEMENT > 1 ? "delta planes" : "";
}

/// Positions as 16-bit numbers relative to their bounding box.
export function quantised(values, dims) {
  const low = new Array(dims).fill(Infinity),
    high = new Array(dims).fill(-Infinity);
  values.forEach((v, i) => {
    low[i % dims] = Math.min(low[i % dims], v);
    high[i % dims] = Math.max(high[i % dims], v);
  });
  const scale = low.map((l, k) => (high[k] - l) / 65535 || 1);
  const stored = Uint16Array.from(values, (v, i) =>
    Math.round((v - low[i % dims]) / scale[i % dims]),
  );
  return [
    stored,
    { shape: [values.length / dims, dims], filter: "delta planes", offset: low, scale },
  ];
}

/// A unit vector in octahedral encoding, which has two numbers; NaN becomes -128, -128.
export function octahedral([x, y, z]) {
  if (!(Math.abs(x) + Math.abs(y) + Math.abs(z) > 0)) return [-128, -128];
  const sum = Math.abs(x) + Math.abs(y) + Math.abs(z);
  let u = x / sum,
    v = y / sum;
  if (z < 0) [u, v] = [(1 - Math.abs(v)) * (u < 0 ? -1 : 1), (1 - Math.abs(u)) * (v < 0 ? -1 : 1)];
  return [Math.round(127 * u), Math.round(127 * v)];
}
