// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include "libph/src/diagram/diagram_parts.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/diagram/thread_context.hpp"
#include "ph/distance_matrix.hpp"
#include "ph/distances.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

using Diagrams = std::span<const std::span<const Bar>>;

constexpr WassersteinOptions kEuclidean{.order = 2, .ground = 2};

void check(Diagrams diagrams, const BarycentreOptions& options) {
  if (diagrams.empty())
    throw Error(ErrorKind::usage, "barycentre: found no diagram, expected at least one");
  if (options.most_rounds < 0)
    throw Error(ErrorKind::usage, fmt::format("barycentre: most_rounds: found {}, expected >= 0",
                                              options.most_rounds));
  if (!(options.least_gain >= 0))
    throw Error(ErrorKind::usage,
                fmt::format("barycentre: least_gain: found {}, expected >= 0", options.least_gain));
  const diagram::DiagramParts first(diagrams.front(), "barycentre");
  for (std::size_t i = 1; i < diagrams.size(); ++i)
    if (!diagram::have_as_many_infinite(first, {diagrams[i], "barycentre"}))
      throw Error(
          ErrorKind::bad_data,
          fmt::format(
              "barycentre: found numbers of infinite bars in diagram {} that differ from "
              "diagram 0, expected equal numbers of bars [-inf, d), of bars [b, inf) and of bars "
              "[-inf, inf); leave out infinite bars",
              i));
}

/// Works even if the squares of the numbers are too large for doubles.
double root_mean_square(const std::vector<double>& numbers) {
  const double largest = std::ranges::max(numbers);
  if (!(largest > 0)) return 0;
  double sum = 0;
  for (const double x : numbers) sum += x / largest * (x / largest);
  return largest * std::sqrt(sum / static_cast<double>(numbers.size()));
}

/// The index of the diagram with the least sum of squared distances to all diagrams. If several
/// diagrams have the least sum, returns the first of them. The distances have a relative error of
/// up to 1 percent.
std::size_t medoid(Diagrams diagrams, const RunContext& context) {
  const DistanceMatrix distances = diagram_distances(
      diagrams,
      [](std::span<const Bar> a, std::span<const Bar> b, const RunContext& task) {
        WassersteinOptions options = kEuclidean;
        options.limits.relative_error = 0.01;
        return wasserstein_distance(a, b, options, task).value;
      },
      context);
  std::size_t best = 0;
  double least = kInfinity;
  std::vector<double> row(diagrams.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    for (std::size_t j = 0; j < row.size(); ++j)
      row[j] = distances(static_cast<Index>(i), static_cast<Index>(j));
    const double mean = root_mean_square(row);
    if (mean < least) {
      least = mean;
      best = i;
    }
  }
  return best;
}

/// The mean of `count` points. The first points are the given bars. If there are fewer bars than
/// `count`, every other point is the point on the diagonal that is nearest to the mean of the bars.
/// Infinite ends stay infinite.
Bar mean_of(const std::vector<Bar>& partners, std::size_t count) {
  const auto n = static_cast<double>(partners.size());
  double birth = 0, death = 0;
  for (const Bar& bar : partners) {
    birth += bar.birth / n;
    death += bar.death / n;
  }
  const double share = n / static_cast<double>(count);
  if (share == 1) return {0, birth, death};  // mutant: barycentre-diagonal
  const double middle = birth / 2 + death / 2, reach = (death / 2 - birth / 2) * share;
  return {0, middle - reach, middle + reach};
}

class Alternation {
 public:
  Alternation(Diagrams diagrams, const RunContext& context)
      : diagrams_(diagrams), context_(context), matchings_(diagrams.size()) {
    for (const Bar& bar : diagrams[medoid(diagrams, context)])
      if (bar.birth < bar.death) bars_.push_back({0, bar.birth, bar.death});
  }

  /// Matches each diagram with the current bars. @return the root mean square of the distances.
  double match() {
    const diagram::ThreadContexts contexts(diagrams_.size(), context_);
    for_each_piece("barycentre", diagrams_.size(), 1, context_,
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t i = begin; i < end; ++i) {
                       RunContext task;
                       contexts.prepare(task);
                       matchings_[i] = wasserstein_matching(bars_, diagrams_[i], kEuclidean, task);
                     }
                   });
    std::vector<double> distances;
    for (const WassersteinMatching& matching : matchings_)
      distances.push_back(matching.distance.value);
    return root_mean_square(distances);
  }
  /// Moves each bar to the mean of its partners in the last `match`. A diagram without a partner
  /// counts with a point on the diagonal (see mean_of). Drops a bar that had no partner in any
  /// diagram. If a bar of a diagram had no partner, adds a new bar for it.
  void move() {
    std::vector<std::vector<Bar>> partners(bars_.size());
    std::vector<Bar> moved;
    for (std::size_t i = 0; i < diagrams_.size(); ++i)
      for (const auto& [own, other] : matchings_[i].pairs) {
        if (other < 0) continue;
        const Bar& bar = diagrams_[i][static_cast<std::size_t>(other)];
        if (own >= 0)
          partners[static_cast<std::size_t>(own)].push_back(bar);
        else
          moved.push_back(mean_of({bar}, diagrams_.size()));
      }
    for (const std::vector<Bar>& own : partners)
      if (!own.empty()) moved.push_back(mean_of(own, diagrams_.size()));
    // Removes bars whose length has underflowed to zero.
    std::erase_if(moved, [](const Bar& bar) { return !(bar.birth < bar.death); });
    bars_.swap(moved);
  }
  /// The bars, sorted by birth and then by death.
  std::vector<Bar> bars() const {
    std::vector<Bar> sorted = bars_;
    std::ranges::sort(sorted, {}, [](const Bar& bar) { return std::tie(bar.birth, bar.death); });
    return sorted;
  }

 private:
  Diagrams diagrams_;
  const RunContext& context_;
  std::vector<Bar> bars_;
  std::vector<WassersteinMatching> matchings_;
};

}  // namespace

Barycentre barycentre(Diagrams diagrams, const BarycentreOptions& options,
                      const RunContext& context) {
  check(diagrams, options);
  Alternation alternation(diagrams, context);
  Barycentre result;
  result.root_mean_square = alternation.match();
  result.bars = alternation.bars();
  for (; result.rounds < options.most_rounds; ++result.rounds) {
    alternation.move();
    const double now = alternation.match();
    // Rounding may raise the value after convergence.
    result.converged = !(result.root_mean_square - now > options.least_gain * now);
    if (now < result.root_mean_square) {
      result.root_mean_square = now;
      result.bars = alternation.bars();
    }
    if (result.converged) break;
  }
  return result;
}

}  // namespace ph
