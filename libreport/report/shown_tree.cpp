// SPDX-License-Identifier: MIT
#include "ph/detail/report/shown_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libreport/report/arrays/tree_arrays.hpp"
#include "ph/detail/core/floating.hpp"
#include "ph/detail/rips/rips_graph.hpp"

namespace ph::report {
namespace {

// With up to this number of merges, a page stays interactive. If there are more, the merges at the
// lowest levels are contracted.
constexpr std::size_t kMostMerges = 100'000;

std::optional<MergeTree> tree_of(const Rips& rips, const RunContext& context) {
  RipsOptions options = rips.options();
  if (rips.size() == 0 || !rips.has_form(RipsForm::forest)) return std::nullopt;
  // The tree needs all points, including equal points.
  if (options.merge_equal_points.value_or(false)) {
    options.merge_equal_points.reset();
    return tree_of(rips.with(std::move(options), context), context);
  }
  // In a graph with names, some points may not be vertices.
  if (rips.graph(RipsForm::forest, context).has_names()) return std::nullopt;
  return merge_tree(rips, context);
}

std::optional<MergeTree> tree_of(const Cubical& cubical, const RunContext& context) {
  const CubicalImage image = cubical.cubical_image();
  if (!image.voxels_are_vertices || image.size() > kMostTreeVoxels) return std::nullopt;
  return merge_tree(cubical, context);
}

std::optional<MergeTree> tree_of(const ExplicitComplex& complex, const RunContext& context) {
  if (!complex.edges_join_vertices() || complex.threshold()) return std::nullopt;
  return merge_tree(complex, context);
}

std::optional<MergeTree> tree_of(const Alpha& alpha, const RunContext& context) {
  if (alpha.is_periodic()) return std::nullopt;
  return merge_tree(alpha, context);
}

/// The birth vertex of each bar of H0, as a vertex of the tree. Empty if the barcode has no cells.
std::vector<std::uint32_t> birth_vertices(const Barcode& barcode, const Cubical* cubical) {
  std::vector<std::uint32_t> vertices;
  std::vector<Index> extents;
  if (cubical) extents = cubical->cubical_image().extents;
  for (std::size_t i = 0; i < barcode.bars(0).size(); ++i) {
    const InputCell cell = barcode.birth_cell(i);
    if (cell.numbers.empty()) return {};
    Index vertex = cubical ? 0 : cell.numbers.front();
    for (std::size_t axis = 0; axis < extents.size(); ++axis)
      vertex = vertex * extents[axis] + cell.numbers[axis] / 2;
    vertices.push_back(static_cast<std::uint32_t>(vertex));
  }
  return vertices;
}

/// A number rounded to three significant digits.
double rounded(double x) {
  const std::string digits = fmt::format("{:.3g}", x);
  floating_from_chars(digits.data(), digits.data() + digits.size(), x);
  return x;
}

/// The middle of the widest gap between neighbouring levels in an ascending list. Empty if no gap
/// is wider than `least`. A gap counts only if its upper level is at least a tenth of the largest
/// level, because gaps at much lower levels occur by chance.
/// @param width returns the distance between two levels.
template <class Width>
std::optional<double> middle_of_widest(const std::vector<double>& levels, double least,
                                       Width width) {
  constexpr double least_share = 0.1;
  std::optional<double> middle;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    if (levels[i] < least_share * levels.back()) continue;  // mutant: report-cut
    const double apart = width(levels[i - 1], levels[i]);
    if (apart <= least) continue;
    least = apart;
    middle = rounded(std::sqrt(levels[i - 1]) * std::sqrt(levels[i]));
  }
  return middle;
}

/// A cut in a gap between neighbouring levels of the largest merges: the gap whose two levels have
/// the largest ratio. Merges above this gap are much more persistent than merges below it. If no
/// ratio is large, the cut of basins is in the gap whose two levels have the largest difference,
/// and the cut of components is the largest level, which leaves the fewest parts. Without merges,
/// the cut is `from`.
double cut_in_gap(const ContractedTree& contracted, const MergeTree& tree, CutRule rule,
                  double from) {
  constexpr std::ptrdiff_t most = 65;  // the upper end of a gap is one of the largest 64 levels
  constexpr double least_ratio = 1.2;
  std::vector<double> levels;
  for (const auto& kept : contracted.merges) {
    const Merge& m = tree.merges[kept.merge];
    const double level = rule == CutRule::value ? m.value : m.persistence();
    if (level > 0 && std::isfinite(level)) levels.push_back(level);
  }
  if (levels.empty()) return from;
  std::ranges::sort(levels);
  if (std::ssize(levels) > most) levels.erase(levels.begin(), levels.end() - most);
  auto cut =
      middle_of_widest(levels, least_ratio, [](double low, double high) { return high / low; });
  if (!cut && rule == CutRule::persistence)
    cut = middle_of_widest(levels, 0, [](double low, double high) { return high - low; });
  return cut.value_or(levels.back());
}

/// The meaning of the values of a complex whose points enter together. Such a complex has clusters
/// at each value. Empty for any other complex, because its minima have different depths.
std::string_view label_of_values(const AnyComplex& complex) {
  if (std::holds_alternative<Rips>(complex)) return "distance";
  const auto* alpha = std::get_if<Alpha>(&complex);
  if (!alpha || alpha->is_weighted()) return "";
  return alpha->unit() == AlphaOptions::Unit::radius ? "radius" : "squared radius";
}

}  // namespace

std::optional<MergeTree> whole_tree(const AnyComplex& complex, const RunContext& context) {
  return std::visit([&](const auto& c) { return tree_of(c, context); }, complex);
}

ShownTree shown_tree(MergeTree tree, const Barcode& barcode, const AnyComplex& complex,
                     const RunContext& context) {
  const std::string_view clusters_at = label_of_values(complex);
  TreeMeta meta;
  meta.rule = clusters_at.empty() ? CutRule::persistence : CutRule::value;
  meta.label = clusters_at.empty() ? "persistence" : clusters_at;
  meta.what = clusters_at.empty() ? "basin" : "component";
  meta.from = least_cut(tree, meta.rule, kMostMerges);
  ContractedTree made = contracted(tree, meta.rule, meta.from, 1, {}, context);
  meta.cut = cut_in_gap(made, tree, meta.rule, meta.from);
  LinkedBars bars =
      linked_bars(tree, barcode, birth_vertices(barcode, std::get_if<Cubical>(&complex)));
  return {std::move(tree), std::move(made), std::move(bars), std::move(meta)};
}

}  // namespace ph::report
