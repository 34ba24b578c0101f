// SPDX-License-Identifier: MIT
#include "libsegment/src/objects/weak_seams.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

namespace ph::segment {
namespace {

using Basin = std::uint32_t;  // a basin, named by one of its voxels

/// All seams between basins, the weakest first.
class Seams {
 public:
  void add(Basin a, Basin b, double value) { values_[std::minmax(a, b)].push_back(value); }
  /// Must be called after the last seam was added.
  void weigh() {
    for (const auto& [both, values] : values_) {
      neighbours_[both.first].insert(both.second);
      neighbours_[both.second].insert(both.first);
      push(both);
    }
  }
  /// The two basins with the weakest seam between them. Empty if no seam is weaker than `least`.
  std::optional<std::pair<Basin, Basin>> weakest(double least) {
    for (; !queue_.empty(); queue_.pop()) {
      const auto& [strength, both, size] = queue_.top();
      const auto seam = values_.find(both);
      // mutant: seam-outdated
      if (seam == values_.end() || seam->second.size() != size) continue;  // the seam has changed
      return strength < least ? std::optional(both) : std::nullopt;
    }
    return std::nullopt;
  }
  /// Turns the seams of `gone` into seams of `kept`.
  void join(Basin kept, Basin gone) {
    for (const Basin other : neighbours_[gone]) {
      auto seam = values_.extract(std::minmax(gone, other));
      neighbours_[other].erase(gone);
      if (other == kept) continue;
      const Both both = std::minmax(kept, other);
      Values& values = values_[both];
      values.insert(values.end(), seam.mapped().begin(), seam.mapped().end());
      neighbours_[other].insert(kept);
      neighbours_[kept].insert(other);
      push(both);  // mutant: seam-grown
    }
    neighbours_.erase(gone);
  }

 private:
  using Both = std::pair<Basin, Basin>;
  using Values = std::vector<double>;

  void push(const Both& both) {
    Values& values = values_[both];
    // mutant: seam-quartile
    const auto quartile = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
    std::ranges::nth_element(values, quartile);
    queue_.emplace(*quartile, both, values.size());
  }

  std::map<Both, Values> values_;
  std::map<Basin, std::set<Basin>> neighbours_;
  /// The seams, ordered by strength. If a seam has grown since its entry was made, its size differs
  /// from the size in the entry.
  using Weighed = std::tuple<double, Both, std::size_t>;
  std::priority_queue<Weighed, std::vector<Weighed>, std::greater<>> queue_;
};

}  // namespace

std::vector<Index> join_over_weak_seams(const std::vector<Index>& basin_of,
                                        const std::vector<double>& births,
                                        std::span<const VoxelPair> pairs, double radius,
                                        double least, const RunContext& context) {
  Seams seams;
  for (const VoxelPair& pair : pairs) {
    const Index a = basin_of[pair.u], b = basin_of[pair.v];
    if (a != b && pair.distance < radius)  // mutant: seam-adjacent
      seams.add(static_cast<Basin>(a), static_cast<Basin>(b),
                std::max(births[pair.u], births[pair.v]));
  }
  seams.weigh();
  // For each basin that is gone, the basin into which it was merged.
  std::map<Basin, Basin> into;
  while (const auto both = seams.weakest(least)) {
    context.poll();
    seams.join(both->first, both->second);
    into[both->second] = both->first;
  }
  std::vector<Index> left = basin_of;
  // `kept` is smaller than `gone`, and has therefore been resolved already.
  for (auto& [gone, kept] : into)
    // mutant: seam-basin
    if (const auto further = into.find(kept); further != into.end()) kept = further->second;
  for (Index& basin : left)
    if (const auto gone = into.find(static_cast<Basin>(basin)); gone != into.end())
      basin = gone->second;
  return left;
}

}  // namespace ph::segment
