// SPDX-License-Identifier: MIT
// Tests which bars stand out, and the sentence about them: the criterion of
// docs/reference/report.md, case by case.
import assert from "node:assert/strict";
import test from "node:test";
import { random } from "./support/random.mjs";
import { importSource } from "./support/import_source.mjs";

const { findingOf, widestGap } = await importSource("model/finding.ts");
const { suggestedCut } = await importSource("model/cuts.ts");
const { Bars } = await importSource("model/bars.ts");
const { Matching } = await importSource("model/matching.ts");

const kNever = Infinity;
const columns = (bars) => ({
  dim: Uint8Array.from(bars, (b) => b[0]),
  birth: Float64Array.from(bars, (b) => b[1]),
  death: Float64Array.from(bars, (b) => b[2]),
});

/// @param bars [dim, birth, death] each, of one barcode, or of two.
function finding(bars, { threshold = null, value = {}, second, distances, pairs, ...more } = {}) {
  const barcodes = (second ? [bars, second] : [bars]).map((_, i) => ({ name: `${i}` }));
  return findingOf({
    bars: new Bars((second ? [bars, second] : [bars]).map(columns), barcodes, 0),
    meta: { barcodes, value: { label: "", ...value }, provenance: { threshold }, distances },
    matching: pairs && new Matching(pairs),
    ...more,
  });
}
const noise = (dim, lengths, birth = 0.1) => lengths.map((length) => [dim, birth, birth + length]);

test("the widest gap", () => {
  assert.deepEqual(widestGap([8, 2, 1]), { count: 1, ratio: 4 });
  assert.deepEqual(widestGap([8, 7, 1, 0.9]), { count: 2, ratio: 7 });
  // Far below the longest bar, gaps occur by chance.
  assert.deepEqual(widestGap([10, 6, 5, 4, 0.5, 0.001]), { count: 4, ratio: 8 });
  assert.deepEqual(widestGap([10, 9, 8, 7, 6, 0.9, 1e-9]), { count: 5, ratio: 6 / 0.9 });
  assert.deepEqual(widestGap([3]), { count: 1, ratio: Infinity });
  assert.deepEqual(widestGap([3, 3]), { count: 2, ratio: Infinity });
  // If there are so few bars, all of them may stand out, unless the gap is much wider than chance
  // explains.
  assert.deepEqual(widestGap([3, 1]), { count: 2, ratio: Infinity });
  assert.deepEqual(widestGap([3, 0.5]), { count: 1, ratio: 6 });
  assert.deepEqual(widestGap([3, 1], 1), { count: 1, ratio: 3 });
  assert.equal(widestGap([]).count, 0);
  assert.equal(widestGap([2, 2, 2, 2, 2, 2]).ratio, 1);
});

test("more equal bars than are looked at, and bars whose length overflows", () => {
  const equal = (many) => finding(noise(1, Array(many).fill(0.5))).sentence;
  assert.match(equal(20), /: all are equally long\.$/);
  assert.match(equal(3000), /: the longest are equally long\.$/);
  const huge = [0, 1].map((dim) => [dim, -1e308, 1e308]);
  assert.match(finding([...huge, [1, 0, 1e308]]).sentence, /^One loop is longer than any number: /);
});

test("a few loops and no noise: all of them", () => {
  const points = [[0, 0, kNever], ...noise(0, [0.14, 0.13, 0.12], 0)];
  const two = finding([...points, [1, 0.153, 1.657], [1, 0.107, 0.82]]);
  assert.equal(
    two.sentence,
    "Two loops stand out: there are no others, and the shorter is [0.107, 0.82).",
  );
  assert.deepEqual(two.bars, [4, 5]);
  // Both are shorter than a third of the longest, but too long to count as specks.
  assert.equal(finding([...points, [1, 0, 1], [1, 0.3, 0.6], [1, 0.3, 0.55]]).bars.length, 3);
  assert.equal(finding([...points, [1, 0, 1], [1, 0.3, 0.38]]).bars.length, 1);
});

test("one loop, and how long it is", () => {
  const bars = [[0, 0, kNever], ...noise(0, [0.2, 0.19, 0.18], 0), [1, 0.184, 1.465], ...noise(1, [0.064, 0.06, 0.05, 0.04])];
  const { dim, bars: chosen, sentence } = finding(bars);
  assert.equal(sentence, "One loop stands out: [0.184, 1.465), 20 times as long as the next.");
  assert.deepEqual([dim, chosen], [1, [4]]);
});

test("the highest dimension in which some stand out is chosen, others are told", () => {
  const bars = [[0, 0, kNever], [1, 0.3, 1.3], [1, 0.3, 2.3], ...noise(1, [0.1, 0.09, 0.08, 0.08]), [2, 0.5, 1.4], ...noise(2, [0.1, 0.09, 0.08, 0.08], 1)];
  const { dim, bars: chosen, sentence } = finding(bars);
  assert.deepEqual([dim, chosen], [2, [7]]);
  assert.equal(sentence, "One void stands out: [0.5, 1.4), 9.0 times as long as the next. Two loops stand out as well.");
  const higher = finding([...bars, [3, 1, 3], ...noise(3, [0.1, 0.1, 0.1, 0.1])]);
  assert.match(higher.sentence, /^One H₃ class stands out: \[1, 3\), 20 times .* One void and two loops stand out as well\.$/);
});

test("noise of a higher dimension is no finding", () => {
  const loop = [[0, 0, kNever], [1, 0.2, 1.5], ...noise(1, [0.06, 0.05, 0.05, 0.05])];
  for (const voids of [[0.02], [0.02, 0.001], [0.09, 0.04, 0.03, 0.03, 0.02]]) {
    const { dim } = finding([...loop, ...noise(2, voids, 1)]);
    assert.equal(dim, 1, `${voids}`);
  }
  // A single bar has nothing below it to stand out from.
  assert.equal(finding([[0, 0, kNever], [1, 0, 1], ...noise(1, [0.1, 0.1, 0.1]), [2, 0.5, 0.65]]).dim, 1);
  // The only bar is short.
  const { bars, sentence } = finding([[0, 0, kNever], [1, 1, 1.05]]);
  assert.deepEqual(bars, []);
  assert.equal(sentence, "No loop stands out: there is one, and it is short.");
});

test("honest where nothing stands out", () => {
  const told = (bars, more) => {
    const found = finding(bars, more);
    assert.deepEqual(found.bars, []);
    return found.sentence;
  };
  const loops = [[0, 0, kNever], ...noise(1, [1.1, 1, 0.9, 0.8, 0.7])];
  assert.equal(told(loops), "No loop stands out: the longest is 1.1 times as long as the next.");
  assert.equal(
    told([...loops, ...noise(2, [0.6, 0.5, 0.4, 0.3, 0.3])]),
    "No void or loop stands out: the longest void is 1.2 times as long as the next and the longest loop is 1.1 times as long as the next.",
  );
  assert.equal(told([]), "There are no bars.");
  assert.equal(told([[0, 0, kNever]]), "All is one component: there is no other bar.");
  assert.equal(told(noise(1, [2, 2, 2, 2, 2])), "No loop stands out: all are equally long.");
  assert.equal(told(noise(1, [2, 1.99, 1.98, 1.97, 1.96])), "No loop stands out: the longest is hardly longer than the next.");
  assert.equal(told([[0, 1, 1], [1, 2, 2]]), "No bar stands out: all have length 0.");
  assert.equal(
    told([[0, 0, kNever], [0, 95, 100]], { image: {} }),
    "No other component stands out: there is one other, and it is short.",
  );
  // Independent lengths with an exponential distribution have no structure.
  const next = random(3);
  let outstanding = 0;
  for (let round = 0; round < 200; ++round)
    outstanding += finding(noise(1, Array.from({ length: 200 }, () => -Math.log(1 - next())))).bars.length > 0;
  assert.ok(outstanding < 10, `${outstanding} of 200`);
});

/// A tree in which a cut leaves the basins with a level above it, and the oldest one.
function treeOf(levels, rule = "persistence") {
  const cut = (at) => ({ segments: [0, ...levels.filter((level) => level >= at)] });
  return { arrays: { rule, levels: Float64Array.from(levels) }, cut };
}

test("where nothing stands out the sentence names the gap that the page cuts at", () => {
  // The widest gap has a ratio below two, and is the one that the page suggests.
  const levels = [90, 89, 60, 59, 58, 57, 56];
  const bars = [[0, 0, kNever], ...noise(0, levels, 0), ...noise(1, [50, 49.9, 49, 48, 47], 0)];
  const meta = { image: {}, tree: treeOf(levels) };
  const found = finding(bars, meta);
  assert.equal(
    found.sentence,
    "No loop or component stands out: in both, the longest bar is hardly longer than the next; " +
      "the widest gap leaves 3 segments.",
  );
  assert.ok(found.components, "the cut is open");
  assert.deepEqual(found.bars, []);
  // For points with loops, components are not mentioned.
  assert.ok(!finding(bars, { tree: treeOf(levels) }).components);
  // All levels are equal: the cut carries no information.
  const fives = [5, 5, 5, 5, 5];
  const more = { image: {}, tree: treeOf(fives) };
  const alike = finding([[0, 0, kNever], ...noise(0, fives, 0)], more);
  assert.ok(!alike.components);
  assert.equal(alike.sentence, "No other component stands out: all are equally long.");
});

test("components: one is always there, several are a finding", () => {
  const three = [[0, 0, kNever], [0, 0, 1.9], [0, 0, 1.6], ...noise(0, [0.17, 0.16, 0.1], 0)];
  const found = finding(three);
  assert.equal(found.sentence, "Three components stand out: the shortest, [0, 1.6), is 9.4 times as long as the next.");
  assert.ok(found.components);
  assert.deepEqual(found.bars, [0, 1, 2]);
  const apart = finding([[0, 0, kNever], [0, 0, kNever], ...noise(0, [0.2, 0.19, 0.18, 0.17, 0.16], 0)]);
  assert.equal(apart.sentence, "Two components never merge: [0, ∞) and [0, ∞).");
  assert.ok(!finding([[0, 0, kNever], ...noise(0, [0.2, 0.19, 0.18, 0.17, 0.16], 0)]).components);
  const begun = finding([[0, -Infinity, 3]]);
  assert.equal(begun.sentence, "One component has no beginning: [−∞, 3).");
  // So many bars are mentioned, but not selected.
  const dust = finding(Array(70_001).fill([0, 0, kNever]));
  assert.deepEqual([dust.sentence, dust.bars], ["70,001 components never merge.", []]);
});

test("beyond the threshold nobody has looked", () => {
  const two = [[0, 0, kNever], [0, 0, kNever], ...noise(0, [0.2, 0.19, 0.18, 0.17, 0.16], 0)];
  assert.equal(finding(two, { threshold: 0.5 }).sentence, "Two components are apart up to 0.5: [0, ∞) and [0, ∞).");
  const negated = two.map(([dim, birth, death]) => [dim, birth - 3, death - 3]);
  assert.match(
    finding(negated, { threshold: -2.5, value: { negated: true } }).sentence,
    /^Two components are apart down to 2\.5/,
  );
  // Both bars are alive at 1, and at least 0.9 and 0.3 long. They may be longer: no gap between
  // them is known.
  const loops = [[0, 0, kNever], [1, 0.1, kNever], [1, 0.7, kNever], ...noise(1, [0.1, 0.1, 0.09, 0.08])];
  assert.equal(
    finding(loops, { threshold: 1 }).sentence,
    "Two loops stand out: the shorter, [0.7, ∞), is at least 3.0 times as long as the next.",
  );
  // The gap is among dead bars, whose lengths are known.
  const dead = [[0, 0, kNever], [1, 0.1, kNever], ...noise(1, [0.6, 0.05, 0.05, 0.04, 0.04])];
  assert.equal(
    finding(dead, { threshold: 1 }).sentence,
    "Two loops stand out: the shorter, [0.1, 0.7), is 12 times as long as the next.",
  );
  const alike = [[0, 0, kNever], ...[0.1, 0.12].map((b) => [1, b, kNever]), ...noise(1, [0.8, 0.7, 0.6, 0.5])];
  assert.equal(
    finding(alike, { threshold: 1 }).sentence,
    "No loop stands out: the shortest alive at the threshold is at least 1.1 times as long as the next.",
  );
});

test("the page cuts where the sentence has its gap", () => {
  // The widest ratio is far below the longest bar, where ratios are due to chance.
  const levels = [0.0001, 0.009, 0.01, 0.5, 1];
  const cut = suggestedCut({ arrays: { rule: "value", levels: Float64Array.from(levels) } }, 0, Infinity);
  const bars = [[0, 0, kNever], ...[...levels].reverse().map((death) => [0, 0, death])];
  assert.equal(finding(bars).bars.length, bars.filter(([, , death]) => death > cut).length);
  assert.ok(cut > 0.01 && cut < 0.5, `${cut}`);
});

test("bars that never end", () => {
  const { sentence, bars } = finding([[0, -3, kNever], [1, -1, kNever], [1, 1, kNever], [2, 3, kNever]]);
  assert.equal(sentence, "Two loops never end: [−1, ∞) and [1, ∞). One void stands out as well.");
  assert.deepEqual(bars, [1, 2]);
  // A bar that is alive at the threshold is at least as long as its known part.
  const cut = [[0, 0, kNever], [1, 0.1, kNever], ...noise(1, [0.1, 0.09, 0.08, 0.08])];
  assert.equal(finding(cut, { threshold: 0.9 }).sentence, "One loop stands out: [0.1, ∞), at least 8.0 times as long as the next.");
  // For a bar that is born right before the threshold, the length is unknown.
  assert.deepEqual(finding([[0, 0, kNever], [1, 0.88, kNever], ...noise(1, [0.1, 0.09, 0.08, 0.08])], { threshold: 0.9 }).bars, []);
});

test("specks are as short beside bars that never end as beside others", () => {
  const loops = [-0.43, -0.4, -0.36, -0.33].map((birth) => [1, birth, kNever]);
  const specks = [0.02, 0.02, 0.015, 0.012, 0.001].map((length) => [1, -0.2, -0.2 + length]);
  const { sentence } = finding([[0, -0.6, kNever], [0, -0.5, -0.06], ...loops, ...specks]);
  assert.match(sentence, /^Four loops never end/);
});

test("the void of a closed surface leads only if there is nothing else", () => {
  const sphere = [[0, -3, kNever], [2, 3, kNever]];
  assert.equal(finding(sphere).sentence, "One void never ends: [3, ∞).");
  const legs = [[0, -2, 2], [0, -2, 1.9], ...noise(0, [0.2, 0.1, 0.1, 0.1], 0)];
  const last = /^Three components stand out.* One void stands out as well\.$/;
  assert.match(finding([...sphere, ...legs]).sentence, last);
  // A void that ends depends on the values, and thus says something about the data.
  assert.match(finding([...sphere, [2, -1, 2], ...legs]).sentence, /^Two voids/);
});

test("of superlevel sets the values of the data", () => {
  const { sentence } = finding([[0, -200, kNever], [1, -96, -80], ...noise(1, [2, 2, 1, 1], -10)], { value: { negated: true } });
  assert.match(sentence, /^One loop stands out: \[96, 80\), 8.0 times/);
});

test("two barcodes: where they differ most, and the pair that decides", () => {
  const a = [[0, 0, kNever], [1, 0, 4], [1, 0, 1]],
    b = [[0, 0, kNever], [1, 0, 3.5], [1, 2, 2.1]];
  const distances = [{ dim: 0, bottleneck: 0 }, { dim: 1, bottleneck: 0.5 }];
  const pairs = Uint32Array.of(0, 3, 1, 4);
  const found = finding(a, { second: b, distances, pairs });
  assert.equal(found.sentence, "The barcodes differ most in H₁: the bottleneck distance is 0.5.");
  assert.equal(found.dim, 1);
  assert.deepEqual(found.bars, [1, 4]);
  assert.match(finding(a, { second: a, distances: [{ dim: 1, bottleneck: 0 }] }).sentence, /are equal/);
  const left = finding(a, { second: a, distances: [{ dim: 0, bottleneck: 0 }] }).sentence;
  assert.equal(left, "The two barcodes are equal in H₀: every bottleneck distance is 0. H₁ was not compared.");
  assert.match(finding(a, { second: b, distances: [{ dim: 1, bottleneck: null }] }).sentence, /never end: .* infinite/);
});
