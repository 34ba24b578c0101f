// SPDX-License-Identifier: MIT
#include "ph/diagram/bottleneck.hpp"

#include <fmt/format.h>

#include <bit>
#include <numeric>
#include <utility>

#include "near_points.hpp"
#include "ph/core/error.hpp"

namespace ph {
namespace {

using diagram::NearPoints;
using diagram::Point;

constexpr std::uint32_t kNone = UINT32_MAX;

std::vector<std::uint32_t> all_of(std::span<const Point> points) {
  std::vector<std::uint32_t> ids(points.size());
  std::iota(ids.begin(), ids.end(), 0U);
  return ids;
}

/// How far a bar is from the diagonal.
double to_diagonal(const Point& p) {
  const double length = p[1] - p[0];
  return std::isfinite(length) ? length / 2 : p[1] / 2 - p[0] / 2;
}

/// Pairs bars of one diagram with bars of another, the long ones of the first among them. What was
/// found at one value is where the search begins at the next.
class OneSidedMatching {
 public:
  /// @param from the longest first.
  OneSidedMatching(std::span<const Point> from, std::span<const Point> to,
                   const RunContext& context)
      : from_(from),
        to_(to),
        of_from_(from.size(), kNone),
        of_to_(to.size(), kNone),
        ticker_(context, "bottleneck distance") {}

  /// Below this one of the long bars has nobody to be paired with.
  double lower_bound() {
    const NearPoints near(to_, all_of(to_));
    double bound = 0;
    for (const Point& p : from_) {
      ticker_.work();
      const double alone = to_diagonal(p);
      if (alone > bound) bound = std::max(bound, near.nearest(p, alone));
    }
    return bound;
  }
  /// Whether all bars that are farther than `radius` from the diagonal can be paired with bars that
  /// are no farther than that from them.
  bool is_possible(double radius) {
    keep_pairs_within(radius);
    std::vector<std::uint32_t> alone;
    for (;;) {  // each round makes the shortest augmenting paths longer: O(sqrt(n)) rounds
      alone.clear();
      for (std::uint32_t a = 0; a < long_; ++a)
        if (of_from_[a] == kNone) alone.push_back(a);
      if (alone.empty()) return true;
      std::vector<NearPoints> layers = layers_from(alone, radius);
      if (layers.empty()) return false;
      for (const std::uint32_t a : alone) augment(a, layers, radius);
    }
  }

 private:
  void keep_pairs_within(double radius) {
    long_ = 0;
    while (long_ < from_.size() && to_diagonal(from_[long_]) > radius) ++long_;
    for (std::uint32_t a = 0; a < from_.size(); ++a) {
      const std::uint32_t b = of_from_[a];
      if (b == kNone || (a < long_ && diagram::distance(from_[a], to_[b]) <= radius)) continue;
      of_from_[a] = of_to_[b] = kNone;
    }
  }
  /// Bars of the other diagram by how many pairs lie on the way to them, up to those that the first
  /// free one is among; none if no free one is reached.
  std::vector<NearPoints> layers_from(std::vector<std::uint32_t> front, double radius) {
    NearPoints unseen(to_, all_of(to_));
    std::vector<NearPoints> layers;
    bool found = false;
    while (!found && !front.empty()) {
      std::vector<std::uint32_t> layer, next;
      for (const std::uint32_t a : front) {
        ticker_.work();
        while (const auto b = unseen.take(from_[a], radius)) {
          layer.push_back(*b);
          if (of_to_[*b] == kNone)
            found = true;
          else
            next.push_back(of_to_[*b]);
        }
      }
      layers.emplace_back(to_, std::move(layer));
      front = std::move(next);
    }
    if (!found) layers.clear();
    return layers;
  }
  /// Looks for a way from a bar that is alone to one that is, layer by layer. Whoever was seen is
  /// taken away: no second way leads through them.
  void augment(std::uint32_t start, std::vector<NearPoints>& layers, double radius) {
    struct Step {
      std::uint32_t a, b = kNone;
    };
    std::vector<Step> way = {{start}};
    while (!way.empty()) {
      ticker_.work();
      const auto b = layers[way.size() - 1].take(from_[way.back().a], radius);
      if (!b) {
        way.pop_back();
        continue;
      }
      way.back().b = *b;
      if (of_to_[*b] == kNone) {
        for (const auto& [from, to] : way) {
          of_from_[from] = to;
          of_to_[to] = from;
        }
        return;
      }
      if (way.size() < layers.size()) way.push_back({of_to_[*b]});
    }
  }

  std::span<const Point> from_, to_;
  std::vector<std::uint32_t> of_from_, of_to_;
  std::uint32_t long_ = 0;  // so many of from_ must be paired
  Ticker ticker_;
};

/// Bars of a diagram by which of their ends are finite. The infinite ones by what is left of them.
struct Parts {
  std::vector<Point> finite;    // the longest first
  std::vector<double> rays[2];  // births of bars without death; deaths of bars without birth
  std::size_t lines = 0;        // neither
};

Parts parts_of(std::span<const Bar> bars) {
  Parts parts;
  for (const Bar& bar : bars) {
    if (!(bar.birth <= bar.death))
      throw Error(ErrorKind::bad_data,
                  fmt::format("bottleneck_distance: found a bar [{}, {}), expected birth <= death",
                              bar.birth, bar.death));
    if (bar.birth == bar.death) continue;
    const bool has_birth = bar.birth > -kInfinity, has_death = bar.death < kInfinity;
    if (has_birth && has_death)
      parts.finite.push_back({bar.birth, bar.death});
    else if (has_birth || has_death)
      parts.rays[has_birth ? 0 : 1].push_back(has_birth ? bar.birth : bar.death);
    else
      ++parts.lines;
  }
  std::ranges::sort(parts.finite, std::greater<>(), to_diagonal);
  for (std::vector<double>& values : parts.rays) std::ranges::sort(values);
  return parts;
}

/// On a line nobody gains by crossing over. @param a, b ascending.
double distance_of_rays(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return kInfinity;
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i) result = std::max(result, std::abs(a[i] - b[i]));
  return result;
}

double distance_of_finite(std::span<const Point> a, std::span<const Point> b,
                          const RunContext& context) {
  OneSidedMatching there(a, b, context), back(b, a, context);
  const auto is_possible = [&](double radius) {
    return there.is_possible(radius) && back.is_possible(radius);
  };
  const double bound = std::max(there.lower_bound(), back.lower_bound());
  if (is_possible(bound)) return bound;
  double all_left_over = 0;
  for (const std::span<const Point>& points : {a, b})
    if (!points.empty()) all_left_over = std::max(all_left_over, to_diagonal(points.front()));
  // Doubles above 0 are in the order of their bits: the least one that is possible is the answer,
  // without a list of all differences.
  auto no = std::bit_cast<std::uint64_t>(bound), yes = std::bit_cast<std::uint64_t>(all_left_over);
  while (yes - no > 1) {
    const std::uint64_t middle = no + (yes - no) / 2;
    (is_possible(std::bit_cast<double>(middle)) ? yes : no) = middle;
  }
  return std::bit_cast<double>(yes);
}

}  // namespace

double bottleneck_distance(std::span<const Bar> a, std::span<const Bar> b,
                           const RunContext& context) {
  constexpr std::size_t bytes_a_bar = 2 * sizeof(Point) + 32 * sizeof(std::uint32_t);
  const MemoryClaim claim(context.memory, (a.size() + b.size()) * bytes_a_bar);
  const Parts first = parts_of(a), second = parts_of(b);
  if (first.lines != second.lines) return kInfinity;
  double result = 0;
  for (const std::size_t k : {0U, 1U})
    result = std::max(result, distance_of_rays(first.rays[k], second.rays[k]));
  if (result == kInfinity) return result;
  return std::max(result, distance_of_finite(first.finite, second.finite, context));
}

}  // namespace ph
