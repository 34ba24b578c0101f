// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory_resource>

#include "libph/src/vectors/grid_cells.hpp"
#include "ph/detail/vectors/checked_bars.hpp"
#include "ph/error.hpp"

namespace ph {
namespace vectors {
namespace {

/// Keeps the best `most` numbers of all numbers that were offered, in order.
template <class Better>
class Best {
 public:
  explicit Best(std::size_t most) : most_(most) {}
  void offer(double x) {
    if (numbers_.size() == most_) {
      if (!Better()(x, numbers_.back())) return;
      numbers_.pop_back();
    }
    numbers_.insert(std::ranges::upper_bound(numbers_, x, Better()), x);
  }
  const std::vector<double>& numbers() const { return numbers_; }

 private:
  std::size_t most_;
  std::vector<double> numbers_;
};

/// Bars sorted by the place in the grid where their tents begin to fall. The bars of place i have
/// the indices begin[i] … begin[i + 1] - 1.
struct SortedByTop {
  std::pmr::vector<Bar> bars;
  std::pmr::vector<std::size_t> begin;

  SortedByTop(const std::vector<Bar>& given, const GridCells& cells, const RunContext& context)
      : bars(given.size(), &context.memory), begin(cells.size() + 2, &context.memory) {
    std::pmr::vector<std::size_t> place(&context.memory);
    place.reserve(given.size());
    for (const Bar& bar : given) ++begin[place.emplace_back(cells.first_falling(bar)) + 1];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    std::pmr::vector<std::size_t> next(begin, &context.memory);
    for (std::size_t i = 0; i < given.size(); ++i) bars[next[place[i]]++] = given[i];
  }
  std::span<const Bar> at(std::size_t place) const {
    return std::span(bars).subspan(begin[place], begin[place + 1] - begin[place]);
  }
};

}  // namespace
}  // namespace vectors

void landscape(std::span<const Bar> given, const Grid& grid, std::size_t layers,
               std::span<double> out, const RunContext& context) {
  if (layers < 1) throw Error(ErrorKind::usage, "landscape: layers: found 0, expected at least 1");
  const vectors::GridCells cells(grid, "landscape");
  vectors::check_size(out, layers * grid.points, "landscape");
  const std::vector<Bar> bars = vectors::checked_bars(given, vectors::Ends::any_death, "landscape");
  std::ranges::fill(out, 0);
  if (bars.empty()) return;
  const std::size_t points = grid.points, most = std::min(layers, bars.size());
  const vectors::SortedByTop sorted(bars, cells, context);
  Ticker ticker(context, "landscape", 2 * points);
  // Among the tents that rise at t, the tents of the bars that are born first are highest. Among
  // the tents that fall at t, the tents of the bars that die last are highest.
  vectors::Best<std::less<>> births(most);
  for (std::size_t i = points; i-- > 0;) {
    for (const Bar& bar : sorted.at(i + 1)) births.offer(bar.birth);
    std::size_t layer = 0;
    for (const double birth : births.numbers()) {
      if (birth >= cells[i]) break;
      out[layer++ * points + i] = cells[i] - birth;
    }
    ticker.work(sorted.at(i + 1).size());
    ticker.tick();
  }
  vectors::Best<std::greater<>> deaths(most);
  std::vector<double> growing(most);
  for (std::size_t i = 0; i < points; ++i) {
    for (const Bar& bar : sorted.at(i)) deaths.offer(bar.death);  // mutant: landscape-deaths
    for (std::size_t layer = 0; layer < most; ++layer) growing[layer] = out[layer * points + i];
    std::size_t layer = 0, next = 0;
    for (const double death : deaths.numbers()) {
      if (death <= cells[i]) break;
      for (; layer < most && growing[next] >= death - cells[i]; ++layer)
        out[layer * points + i] = growing[next++];
      if (layer == most) break;
      out[layer++ * points + i] = death - cells[i];
    }
    for (; layer < most; ++layer) out[layer * points + i] = growing[next++];
    ticker.work(sorted.at(i).size());
    ticker.tick();
  }
}

double PiecewiseLinear::operator()(double t) const {
  if (at.size() != value.size())
    throw Error(
        ErrorKind::usage,
        fmt::format("PiecewiseLinear: found {} places and {} values, expected equal numbers",
                    at.size(), value.size()));
  const auto behind = std::ranges::upper_bound(at, t);
  if (behind == at.begin()) return 0;
  const auto i = static_cast<std::size_t>(behind - at.begin());
  if (i == at.size()) return at.back() == t ? value.back() : 0;
  const double width = at[i] - at[i - 1];
  return value[i - 1] + (value[i] - value[i - 1]) * ((t - at[i - 1]) / width);
}

std::vector<PiecewiseLinear> exact_landscape(std::span<const Bar> given, std::size_t layers,
                                             const RunContext& context) {
  if (layers < 1)
    throw Error(ErrorKind::usage, "exact_landscape: layers: found 0, expected at least 1");
  std::vector<Bar> tents = vectors::checked_bars(given, vectors::Ends::finite, "exact_landscape");
  const auto precedes = [](const Bar& a, const Bar& b) {
    return a.birth != b.birth ? a.birth < b.birth : a.death > b.death;  // mutant: landscape-order
  };
  std::ranges::sort(tents, precedes);
  Ticker ticker(context, "landscape", std::min(layers, tents.size()));
  std::vector<PiecewiseLinear> landscapes;
  std::vector<Bar> below;
  const std::size_t taken = 2 * tents.size() * sizeof(Bar);
  std::size_t points = 0;  // of the layers that are done
  MemoryClaim claim(context.memory, taken);
  while (!tents.empty() && landscapes.size() < layers) {
    PiecewiseLinear& layer = landscapes.emplace_back();
    const auto add = [&](double t, double value) {
      // A point that rounding has made equal to the last point is skipped.
      if (!layer.at.empty() && layer.at.back() == t) return;
      layer.at.push_back(t);
      layer.value.push_back(value);
    };
    const auto add_top = [&](const Bar& bar) {
      add(bar.birth / 2 + bar.death / 2, (bar.death - bar.birth) / 2);
    };
    // The loop follows the upper envelope of the tents. Where one tent emerges from another, the
    // part below both tents remains for lower layers.
    below.clear();
    Bar now = tents.front(), shared;
    bool has_shared = false;
    add(now.birth, 0);
    add_top(now);
    for (std::size_t i = 1; i < tents.size(); ++i) {
      const Bar& next = tents[i];
      ticker.work();
      if (has_shared && precedes(shared, next)) {
        below.push_back(shared);
        has_shared = false;
      }
      if (next.death <= now.death) {
        below.push_back(next);
        continue;
      }
      if (next.birth >= now.death) {
        add(now.death, 0);
        add(next.birth, 0);
      } else {
        shared = {now.dim, next.birth, now.death};
        has_shared = true;  // mutant: landscape-shared
        add_top(shared);
      }
      add_top(next);
      now = next;
    }
    if (has_shared) below.push_back(shared);
    add(now.death, 0);
    points += layer.at.capacity() + layer.value.capacity();
    claim.grow_to(taken + points * sizeof(double));
    tents.swap(below);
    ticker.tick();
  }
  return landscapes;
}

}  // namespace ph
