// SPDX-License-Identifier: MIT
// Reads the data that a program wrote into the page: one JSON block and any number of arrays.
// docs/reference/report-format.md describes the bytes.

export type Numbers =
  | Uint8Array
  | Int8Array
  | Uint16Array
  | Int16Array
  | Uint32Array
  | Int32Array
  | Float32Array
  | Float64Array;

/// No leaf, no bar, no merge.
export const kNone = 0xffffffff;

/// A block of numbers with `shape[0]` rows. A stored number means offset + scale * number if the
/// block has an offset and a scale (one for all, or one per column).
export interface Block {
  values: Numbers;
  shape: number[];
  offset: number[];
  scale: number[];
}

export interface Payload {
  meta: unknown;
  blocks: Map<string, Block>;
  /// The length of the base64 text in bytes, one of the figures that the page states about itself.
  bytes: number;
}

export class PayloadError extends Error {}

const kTypes = {
  u8: Uint8Array,
  i8: Int8Array,
  u16: Uint16Array,
  i16: Int16Array,
  u32: Uint32Array,
  i32: Int32Array,
  f32: Float32Array,
  f64: Float64Array,
} as const;

export async function readPayload(page: Document): Promise<Payload> {
  const metaElement = page.getElementById("ph-meta");
  if (!metaElement) throw new PayloadError("this template holds no report yet");
  const meta: unknown = JSON.parse(metaElement.textContent ?? "");
  const elements = [...page.querySelectorAll<HTMLScriptElement>("script[data-array]")];
  const blocks = new Map<string, Block>();
  let bytes = 0;
  await Promise.all(
    elements.map(async (element) => {
      const name = element.dataset["array"] ?? "";
      const text = (element.textContent ?? "").trim();
      bytes += text.length;
      blocks.set(name, await readBlock(name, element.dataset, text));
      element.remove(); // frees the text, which is as large as the numbers
    }),
  );
  return { meta, blocks, bytes };
}

async function readBlock(name: string, data: DOMStringMap, text: string): Promise<Block> {
  const fail = (what: string) => new PayloadError(`array ${name}: ${what}`);
  const type = data["type"] as keyof typeof kTypes;
  const make = Object.hasOwn(kTypes, type ?? "") ? kTypes[type] : undefined;
  if (!make) throw fail(`unknown type ${String(data["type"])}`);
  const shape = numbersOf(data["shape"]);
  if (shape.length === 0 || shape.some((n) => !Number.isSafeInteger(n) || n < 0))
    throw fail(`shape ${String(data["shape"])}`);
  const count = shape.reduce((product, n) => product * n, 1);
  let bytes = await inflate(fromBase64(text));
  if (bytes.byteLength !== count * make.BYTES_PER_ELEMENT)
    throw fail(`found ${bytes.byteLength} bytes, expected ${count * make.BYTES_PER_ELEMENT}`);
  const filters = (data["filter"] ?? "").split(" ").filter((word) => word !== "");
  for (const filter of filters)
    if (filter !== "delta" && filter !== "planes") throw fail(`unknown filter ${filter}`);
  if (filters.includes("planes")) bytes = fromPlanes(bytes, make.BYTES_PER_ELEMENT);
  const values = new make(bytes.buffer as ArrayBuffer);
  if (filters.includes("delta")) undoDelta(values, shape.length > 1 ? count / (shape[0] || 1) : 1);
  return { values, shape, offset: numbersOf(data["offset"]), scale: numbersOf(data["scale"]) };
}

function numbersOf(list: string | undefined): number[] {
  return list ? list.split(",").map(Number) : [];
}

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflate(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// Undoes the filter that stores the first bytes of all numbers, then their second bytes, and so
/// on.
function fromPlanes(planes: Uint8Array, size: number): Uint8Array {
  const bytes = new Uint8Array(planes.length);
  const count = planes.length / size;
  for (let k = 0; k < size; ++k)
    for (let i = 0, at = k, from = k * count; i < count; ++i, at += size)
      bytes[at] = planes[from + i]!;
  return bytes;
}

/// Undoes the filter that stores each number as its difference from the number in the previous row,
/// modulo the width of its type.
function undoDelta(values: Numbers, columns: number): void {
  for (let i = columns; i < values.length; ++i) values[i]! += values[i - columns]!;
}

/// The numbers that a block represents.
export function decoded(block: Block): Numbers {
  if (block.scale.length === 0) return block.values;
  const columns = block.scale.length;
  const result = new Float32Array(block.values.length);
  for (let i = 0, column = 0; i < result.length; ++i) {
    result[i] = (block.offset[column] ?? 0) + block.scale[column]! * block.values[i]!;
    if (++column === columns) column = 0;
  }
  return result;
}
