// SPDX-License-Identifier: MIT
#include "apps/common/distances/distance_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "ph/io/write.hpp"

namespace ph::app {
namespace {

/// The numbers of bars for which only the death is infinite, only the birth is infinite, and both
/// are infinite.
std::array<std::size_t, 3> infinite_bars(std::span<const Bar> bars) {
  std::array<std::size_t, 3> counts{};
  for (const Bar& bar : bars) {
    const bool was_always = bar.birth == -kInfinity, never_dies = bar.death == kInfinity;
    if (was_always || never_dies) ++counts[was_always ? (never_dies ? 2 : 1) : 0];
  }
  return counts;
}

/// Appends the unpaired bars of both diagrams, each paired with the diagonal.
void add_diagonal(std::vector<std::pair<std::int64_t, std::int64_t>>& pairs, std::size_t a,
                  std::size_t b) {
  std::vector<bool> has_pair[] = {std::vector<bool>(a), std::vector<bool>(b)};
  for (const auto& [i, j] : pairs) {
    has_pair[0][static_cast<std::size_t>(i)] = true;
    has_pair[1][static_cast<std::size_t>(j)] = true;
  }
  for (std::size_t i = 0; i < a; ++i)
    if (!has_pair[0][i]) pairs.emplace_back(i, -1);
  std::ranges::sort(pairs);
  for (std::size_t j = 0; j < b; ++j)
    if (!has_pair[1][j]) pairs.emplace_back(-1, j);  // mutant: matching-second
}

}  // namespace

double DistanceChoice::order() const {
  if (kind == DistanceKind::bottleneck) return kInfinity;
  return kind == DistanceKind::wasserstein ? wasserstein_order : 1;
}

std::optional<double> DistanceChoice::ground() const {
  if (kind == DistanceKind::sliced) return std::nullopt;
  return kind == DistanceKind::wasserstein ? wasserstein_ground : kInfinity;
}

std::string words_of(const DistanceChoice& choice) {
  static constexpr std::array<std::string_view, 3> kWords{"bottleneck", "Wasserstein",
                                                          "sliced Wasserstein"};
  std::string more = choice.ground() ? "ground norm " + shortest(*choice.ground())
                                     : fmt::format("{} directions", choice.directions);
  if (choice.limits.relative_error > 0)  // mutant: distance-text
    more += ", relative error " + shortest(choice.limits.relative_error);
  return fmt::format("{} distance (order {}, {})", kWords[static_cast<std::size_t>(choice.kind)],
                     shortest(choice.order()), more);
}

DistanceBounds distance_of(std::span<const Bar> a, std::span<const Bar> b,
                           const DistanceChoice& choice, const RunContext& context) {
  switch (choice.kind) {
    case DistanceKind::bottleneck:
      return bottleneck_bounds(a, b, choice.limits, context);
    case DistanceKind::wasserstein:
      // mutant: distance-ground
      return wasserstein_distance(
          a, b, {choice.wasserstein_order, choice.wasserstein_ground, choice.limits}, context);
    case DistanceKind::sliced:
      break;
  }
  const double distance = sliced_wasserstein_distance(a, b, choice.directions, context);
  return {distance, distance};
}

DiagramMatching matching_of(std::span<const Bar> a, std::span<const Bar> b,
                            const DistanceChoice& choice, const RunContext& context) {
  if (choice.kind == DistanceKind::wasserstein) {
    auto [distance, pairs] = wasserstein_matching(
        a, b, {choice.wasserstein_order, choice.wasserstein_ground, choice.limits}, context);
    return {distance, std::move(pairs)};
  }
  const auto [distance, pairs] = bottleneck_matching(a, b, context);
  DiagramMatching matching{{distance, distance}, {pairs.begin(), pairs.end()}};
  if (!std::isinf(distance)) add_diagonal(matching.pairs, a.size(), b.size());
  return matching;
}

std::vector<int> dims_of(std::span<const Barcode> barcodes) {
  std::set<int> dims;
  for (const Barcode& barcode : barcodes)
    for (std::size_t i = 0; i < barcode.size(); i += barcode.bars(barcode[i].dim).size())
      dims.insert(barcode[i].dim);
  return {dims.begin(), dims.end()};
}

std::string why_infinite(std::span<const Bar> a, std::span<const Bar> b) {
  static constexpr std::array<std::string_view, 3> kWhich{
      "that never die", "that were always there", "that were always there and never die"};
  const auto in_a = infinite_bars(a), in_b = infinite_bars(b);
  std::string text;
  for (std::size_t i = 0; i < kWhich.size(); ++i)
    if (in_a[i] != in_b[i])  // mutant: distance-infinite
      text +=
          fmt::format("{}{} and {} bars {}", text.empty() ? "" : ", ", in_a[i], in_b[i], kWhich[i]);
  return text;
}

std::string text_of(const DistanceBounds& distance, const DistanceChoice& choice,
                    std::span<const Bar> a, std::span<const Bar> b) {
  std::string value = shortest(distance.value), lower = shortest(distance.lower);
  if (std::isinf(distance.value)) return fmt::format("{}: {}", value, why_infinite(a, b));
  if (distance.lower > choice.limits.at_most)
    return fmt::format("more than {}: from {} to {}", shortest(choice.limits.at_most), lower,
                       value);
  // Without a relative error, the bounds differ only by rounding.
  // mutant: distance-exact
  if (choice.limits.relative_error > 0 && distance.lower < distance.value)
    return fmt::format("{} (at least {})", value, lower);
  return value;
}

}  // namespace ph::app
