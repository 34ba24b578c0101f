// SPDX-License-Identifier: MIT
#include "libreport/report/arrays/tree_arrays.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "ph/detail/components/disjoint_sets.hpp"

namespace ph::report {
namespace {

bool is_kept(const Merge& m, CutRule rule, double from, Index min_part) {
  return rule == CutRule::value ? m.value > from : m.separates(from, min_part);
}

/// The level of a merge, which the page compares with the cut. It is exactly the double that the
/// program compares with the cut.
double level(const Merge& m, CutRule rule) {
  return rule == CutRule::value ? m.value : m.persistence();
}

}  // namespace

ContractedTree contracted(const MergeTree& tree, CutRule rule, double from, Index min_part,
                          std::span<const std::uint32_t> points, const RunContext& context) {
  const std::size_t n = tree.births.size();
  ContractedTree result;
  DisjointSets together(n, &context.memory);
  for (const Merge& m : tree.merges) {
    if (is_kept(m, rule, from, min_part)) continue;
    together.link(together.find(static_cast<std::uint32_t>(m.u)),
                  together.find(static_cast<std::uint32_t>(m.v)));
  }
  result.leaf_of.assign(n, kNone);
  std::pmr::vector<std::uint32_t> leaf_of_root(n, kNone, &context.memory);
  for (std::uint32_t v = 0; v < n; ++v) {
    if (tree.births[v] == kInfinity) continue;
    std::uint32_t& leaf = leaf_of_root[together.find(v)];
    if (leaf == kNone) {
      leaf = static_cast<std::uint32_t>(result.leaf_birth.size());
      result.leaf_birth.push_back(kInfinity);
      result.leaf_points.push_back(0);
      result.leaf_vertices.push_back(0);
    }
    result.leaf_of[v] = leaf;
    result.leaf_birth[leaf] = std::min(result.leaf_birth[leaf], tree.births[v]);
    result.leaf_points[leaf] += points.empty() ? 1 : points[v];
    ++result.leaf_vertices[leaf];
  }
  // The root of a component is its birth vertex.
  DisjointSets components(n, &context.memory);
  for (std::size_t i = 0; i < tree.merges.size(); ++i) {
    const Merge& m = tree.merges[i];
    if (is_kept(m, rule, from, min_part)) {
      const bool u_is_younger = components.find(static_cast<std::uint32_t>(m.u)) == m.younger;
      const std::uint32_t u = result.leaf_of[static_cast<std::size_t>(m.u)],
                          v = result.leaf_of[static_cast<std::size_t>(m.v)];
      result.merges.push_back({i, u_is_younger ? u : v, u_is_younger ? v : u});
    }
    components.link(static_cast<std::uint32_t>(m.younger), static_cast<std::uint32_t>(m.elder));
  }
  return result;
}

double least_cut(const MergeTree& tree, CutRule rule, std::size_t most) {
  std::vector<double> levels;
  for (const Merge& m : tree.merges)
    if (level(m, rule) > 0 || rule == CutRule::value) levels.push_back(level(m, rule));
  if (rule == CutRule::persistence &&
      std::ranges::none_of(levels, [](double x) { return std::isfinite(x); }))
    levels.clear();
  if (levels.empty()) {
    // If no merge has finite persistence, any cut above 0 performs all merges. The result is then a
    // cut as large as the range of the births.
    if (rule == CutRule::value || tree.merges.empty()) return 0;
    double low = kInfinity, high = -kInfinity;
    for (const double birth : tree.births)
      if (std::isfinite(birth)) {
        low = std::min(low, birth);
        high = std::max(high, birth);
      }
    return high > low && std::isfinite(high - low) ? high - low : 1;
  }
  // The rule `persistence` keeps merges at `from` itself. The rule `value` keeps only merges above
  // it.
  if (levels.size() <= most)
    return rule == CutRule::persistence ? *std::ranges::min_element(levels) : 0;
  const auto last = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() - most);
  std::ranges::nth_element(levels, last - 1);
  const double excluded = *(last - 1);
  if (rule == CutRule::value) return excluded;
  double least = kInfinity;
  for (const double x : levels)
    if (x > excluded) least = std::min(least, x);
  return least == kInfinity ? excluded : least;
}

LinkedBars linked_bars(const MergeTree& tree, const Barcode& barcode,
                       std::span<const std::uint32_t> birth_vertices) {
  struct Bar {
    double birth, death;
    std::uint32_t vertex, number;
  };
  std::vector<Bar> bars;
  for (std::uint32_t i = 0; i < barcode.bars(0).size(); ++i)
    bars.push_back({barcode[i].birth, barcode[i].death,
                    i < birth_vertices.size() ? birth_vertices[i] : kNone, i});
  std::ranges::sort(bars, {},
                    [](const Bar& bar) { return std::tuple(bar.birth, bar.death, bar.vertex); });

  LinkedBars result{std::vector(tree.merges.size(), kNone), std::vector(tree.births.size(), kNone)};
  const std::vector<MergeTree::Class> classes = tree.classes();
  auto next = classes.begin();
  for (const Bar& bar : bars) {
    const auto values = [](const auto& c) { return std::tuple(c.birth, c.death); };
    while (next != classes.end() && values(*next) < values(bar)) ++next;
    if (next == classes.end() || values(*next) != values(bar)) continue;
    if (next->merge < 0)
      result.of_vertex[static_cast<std::size_t>(next->vertex)] = bar.number;
    else
      result.of_merge[static_cast<std::size_t>(next->merge)] = bar.number;
    ++next;
  }
  return result;
}

void add_tree(ReportFile& report, const MergeTree& tree, const ContractedTree& contracted,
              const LinkedBars& bars, CutRule rule) {
  std::vector<std::uint32_t> younger, elder, merge_bar, leaf_bar;
  std::vector<double> values, levels;
  std::vector<bool> kept(tree.merges.size());
  for (const ContractedTree::KeptMerge& k : contracted.merges) {
    kept[k.merge] = true;
    younger.push_back(k.younger);
    elder.push_back(k.elder);
    values.push_back(tree.merges[k.merge].value);
    levels.push_back(level(tree.merges[k.merge], rule));
    merge_bar.push_back(bars.of_merge[k.merge]);
  }
  const auto lie_in = [&](std::size_t vertex, std::uint32_t bar) {
    if (bar == kNone) return;
    leaf_bar.push_back(contracted.leaf_of[vertex]);
    leaf_bar.push_back(bar);
  };
  for (std::size_t v = 0; v < bars.of_vertex.size(); ++v) lie_in(v, bars.of_vertex[v]);
  for (std::size_t i = 0; i < tree.merges.size(); ++i)
    if (!kept[i]) lie_in(static_cast<std::size_t>(tree.merges[i].younger), bars.of_merge[i]);

  const ArrayForm delta{.delta = true};
  report.add("tree/leaf_birth", contracted.leaf_birth);
  report.add("tree/leaf_points", contracted.leaf_points, delta);
  report.add("tree/leaf_vertices", contracted.leaf_vertices, delta);
  report.add("tree/merge_younger", younger, delta);
  report.add("tree/merge_elder", elder, delta);
  report.add("tree/merge_value", values);
  report.add("tree/merge_level", levels);
  report.add("tree/merge_bar", merge_bar, delta);
  report.add("tree/leaf_bar", leaf_bar, {.shape = {leaf_bar.size() / 2, 2}, .delta = true});
}

}  // namespace ph::report
