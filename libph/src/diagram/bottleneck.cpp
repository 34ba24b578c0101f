// SPDX-License-Identifier: MIT
#include "ph/bottleneck.hpp"

#include <fmt/format.h>

#include <bit>
#include <optional>
#include <utility>

#include "diagram/near_points.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

using diagram::NearPoints;
using diagram::Point;

constexpr std::uint32_t kNone = UINT32_MAX;

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
        ticker_(context, "bottleneck distance") {
    if (!to.empty()) near_.emplace(to, context);
  }

  /// Below this one of the long bars has nobody to be paired with.
  double lower_bound() {
    double bound = 0;
    for (const Point& p : from_) {
      ticker_.work();
      const double alone = to_diagonal(p);
      if (alone > bound) bound = std::max(bound, near_ ? near_->nearest(p, alone) : alone);
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
      const NearPoints::Label layers = layers_from(alone, radius);
      if (layers == 0) return false;
      for (const std::uint32_t a : alone) augment(a, layers, radius);
    }
  }
  /// After is_possible: of each bar of the first and of the second diagram the other one, or kNone.
  std::span<const std::uint32_t> of_from() const { return of_from_; }
  std::span<const std::uint32_t> of_to() const { return of_to_; }

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
  /// Labels the bars of the other diagram by how many pairs lie on the way to them: from 1 up to
  /// the label that the first free one has. @return that label; 0 if no free one is reached.
  NearPoints::Label layers_from(std::vector<std::uint32_t> front, double radius) {
    if (!near_) return 0;
    near_->label_all(kUnseen);
    for (NearPoints::Label layer = 1; !front.empty(); ++layer) {
      bool found = false;
      std::vector<std::uint32_t> next;
      for (const std::uint32_t a : front) {
        ticker_.work();
        while (const auto b = near_->relabel(from_[a], radius, kUnseen, layer)) {
          if (of_to_[*b] == kNone)
            found = true;
          else
            next.push_back(of_to_[*b]);
        }
      }
      if (found) return layer;
      front = std::move(next);
    }
    return 0;
  }
  /// Looks for a way from a bar that is alone to one that is, layer by layer. Whoever was seen
  /// loses the label: no second way leads through them.
  void augment(std::uint32_t start, NearPoints::Label layers, double radius) {
    struct Step {
      std::uint32_t a, b = kNone;
    };
    std::vector<Step> way = {{start}};
    while (!way.empty()) {
      ticker_.work();
      const auto layer = static_cast<NearPoints::Label>(way.size());
      const auto b = near_->relabel(from_[way.back().a], radius, layer, NearPoints::kNoLabel);
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
      if (layer < layers) way.push_back({of_to_[*b]});
    }
  }

  std::span<const Point> from_, to_;
  std::vector<std::uint32_t> of_from_, of_to_;
  static constexpr NearPoints::Label kUnseen = 0;
  std::optional<NearPoints> near_;  // those of to_, if there are any
  std::uint32_t long_ = 0;          // so many of from_ must be paired
  Ticker ticker_;
};

/// A bar and its place among those that were given.
template <class T>
struct Placed {
  T value;
  std::uint32_t place;
};

/// Bars of a diagram by which of their ends are finite. The infinite ones by what is left of them.
struct Parts {
  std::vector<Point> finite;  // the longest first
  std::vector<std::uint32_t> places;
  std::vector<Placed<double>>
      rays[2];                       // births of bars without death; deaths of those without birth
  std::vector<std::uint32_t> lines;  // neither
};

Parts parts_of(std::span<const Bar> bars) {
  Parts parts;
  std::vector<Placed<Point>> finite;
  for (std::uint32_t i = 0; i < bars.size(); ++i) {
    const Bar& bar = bars[i];
    if (!(bar.birth <= bar.death))
      throw Error(ErrorKind::bad_data,
                  fmt::format("bottleneck_distance: found a bar [{}, {}), expected birth <= death",
                              bar.birth, bar.death));
    if (bar.birth == bar.death) continue;
    const bool has_birth = bar.birth > -kInfinity, has_death = bar.death < kInfinity;
    if (has_birth && has_death)
      finite.push_back({{bar.birth, bar.death}, i});
    else if (has_birth || has_death)
      parts.rays[has_birth ? 0 : 1].push_back({has_birth ? bar.birth : bar.death, i});
    else
      parts.lines.push_back(i);
  }
  std::ranges::sort(finite, std::greater<>(), [](const auto& p) { return to_diagonal(p.value); });
  for (const auto& [point, place] : finite) {
    parts.finite.push_back(point);
    parts.places.push_back(place);
  }
  for (auto& rays : parts.rays) std::ranges::sort(rays, {}, &Placed<double>::value);
  return parts;
}

/// On a line nobody gains by crossing over: the k-th are for each other.
double distance_of_rays(std::span<const Placed<double>> a, std::span<const Placed<double>> b) {
  if (a.size() != b.size()) return kInfinity;
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    result = std::max(result, std::abs(a[i].value - b[i].value));
  return result;
}

/// Two matchings, one with all long bars of the first diagram, one with those of the second, made
/// one that has all of both. Together they are paths and cycles, whose pairs come from one and the
/// other in turn; of each path one of the two has all long bars (Mendelsohn and Dulmage).
class JoinedMatchings {
 public:
  using Mates = std::span<const std::uint32_t>;

  /// @param first_of_a, first_of_b the first matching by bars of either diagram; kNone: no pair.
  JoinedMatchings(Mates first_of_a, Mates first_of_b, Mates second_of_a, Mates second_of_b)
      : mates_{{first_of_a, first_of_b}, {second_of_a, second_of_b}},
        seen_(first_of_a.size() + first_of_b.size()) {}

  /// @return the partner of each bar of the first diagram, or kNone.
  std::vector<std::uint32_t> join() {
    partners_.assign(mates_[0][0].size(), kNone);
    // Paths from their ends, which have a pair in one matching only; what is left are cycles.
    for (const bool ends : {true, false})
      for (std::size_t side : {0U, 1U})
        for (std::uint32_t i = 0; i < mates_[0][side].size(); ++i) {
          const bool in_first = mate(0, side, i) != kNone, in_second = mate(1, side, i) != kNone;
          if (seen(side, i) || !(in_first || in_second) || (ends && in_first && in_second))
            continue;
          take(side, i, in_first ? 0 : 1);
        }
    return std::move(partners_);
  }

 private:
  std::uint32_t mate(std::size_t matching, std::size_t side, std::uint32_t i) const {
    return mates_[matching][side][i];
  }
  std::vector<bool>::reference seen(std::size_t side, std::uint32_t i) {
    return seen_[side * mates_[0][0].size() + i];
  }
  /// Follows a path from one of its ends, or a cycle, and keeps the pairs of one matching: the one
  /// with more of them; of as many, the one with the bar at the end that the first diagram has in
  /// the first matching, or the second in the second.
  void take(std::size_t side, std::uint32_t start, std::size_t matching) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs[2];
    std::size_t at_side = side, at_matching = matching;
    std::uint32_t at = start;
    seen(side, start) = true;
    for (;;) {
      const std::uint32_t next = mate(at_matching, at_side, at);
      if (next == kNone) break;
      pairs[at_matching].emplace_back(at_side == 0 ? at : next, at_side == 0 ? next : at);
      at_side = 1 - at_side;
      if (seen(at_side, next)) break;
      seen(at_side, next) = true;
      at = next;
      at_matching = 1 - at_matching;
    }
    // A path of as many pairs of each ends where it began, on the same side.
    const std::size_t better =
        pairs[0].size() != pairs[1].size() ? (pairs[0].size() > pairs[1].size() ? 0U : 1U) : side;
    for (const auto& [a, b] : pairs[better]) partners_[a] = b;
  }

  Mates mates_[2][2];
  std::vector<bool> seen_;
  std::vector<std::uint32_t> partners_;
};

class FiniteBars {
 public:
  FiniteBars(std::span<const Point> a, std::span<const Point> b, const RunContext& context)
      : a_(a), b_(b), there_(a, b, context), back_(b, a, context) {}

  double distance() {
    const double bound = std::max(there_.lower_bound(), back_.lower_bound());
    if (is_possible(bound)) return bound;
    double all_left_over = 0;
    for (const std::span<const Point>& points : {a_, b_})
      if (!points.empty()) all_left_over = std::max(all_left_over, to_diagonal(points.front()));
    // Doubles above 0 are in the order of their bits: the least one that is possible is the answer,
    // without a list of all differences.
    auto no = std::bit_cast<std::uint64_t>(bound),
         yes = std::bit_cast<std::uint64_t>(all_left_over);
    while (yes - no > 1) {
      const std::uint64_t middle = no + (yes - no) / 2;
      (is_possible(std::bit_cast<double>(middle)) ? yes : no) = middle;
    }
    return std::bit_cast<double>(yes);
  }
  /// Of each bar of the first diagram the one of the second, or kNone. @param radius that is
  /// possible
  std::vector<std::uint32_t> partners(double radius) {
    is_possible(radius);
    return JoinedMatchings(there_.of_from(), there_.of_to(), back_.of_to(), back_.of_from()).join();
  }

 private:
  bool is_possible(double radius) {
    return there_.is_possible(radius) && back_.is_possible(radius);
  }

  std::span<const Point> a_, b_;
  OneSidedMatching there_, back_;
};

// Trees count themselves.
constexpr std::size_t kBytesABar = 2 * sizeof(Point) + 20 * sizeof(std::uint32_t);

/// What infinite bars alone decide.
double distance_of_infinite(const Parts& a, const Parts& b) {
  if (a.lines.size() != b.lines.size()) return kInfinity;
  return std::max(distance_of_rays(a.rays[0], b.rays[0]), distance_of_rays(a.rays[1], b.rays[1]));
}

}  // namespace

double bottleneck_distance(std::span<const Bar> a, std::span<const Bar> b,
                           const RunContext& context) {
  const MemoryClaim claim(context.memory, (a.size() + b.size()) * kBytesABar);
  const Parts first = parts_of(a), second = parts_of(b);
  const double infinite = distance_of_infinite(first, second);
  if (infinite == kInfinity) return infinite;
  return std::max(infinite, FiniteBars(first.finite, second.finite, context).distance());
}

BottleneckMatching bottleneck_matching(std::span<const Bar> a, std::span<const Bar> b,
                                       const RunContext& context) {
  const MemoryClaim claim(context.memory, (a.size() + b.size()) * kBytesABar);
  const Parts first = parts_of(a), second = parts_of(b);
  BottleneckMatching result{distance_of_infinite(first, second), {}};
  if (result.distance == kInfinity) return result;
  FiniteBars finite(first.finite, second.finite, context);
  result.distance = std::max(result.distance, finite.distance());
  const std::vector<std::uint32_t> partners = finite.partners(result.distance);
  for (std::size_t i = 0; i < partners.size(); ++i)
    if (partners[i] != kNone)
      result.pairs.emplace_back(first.places[i], second.places[partners[i]]);
  for (const std::size_t k : {0U, 1U})
    for (std::size_t i = 0; i < first.rays[k].size(); ++i)
      result.pairs.emplace_back(first.rays[k][i].place, second.rays[k][i].place);
  for (std::size_t i = 0; i < first.lines.size(); ++i)
    result.pairs.emplace_back(first.lines[i], second.lines[i]);
  std::ranges::sort(result.pairs);
  return result;
}

}  // namespace ph
