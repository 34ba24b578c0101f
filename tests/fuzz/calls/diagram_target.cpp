// SPDX-License-Identifier: MIT
// Checks distances and vectors of persistence diagrams whose births and deaths are arbitrary
// doubles.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "ph/distances.hpp"
#include "ph/error.hpp"
#include "ph/vectorise.hpp"
#include "tests/fuzz/chosen_numbers.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/violation.hpp"

namespace ph::fuzz {
namespace {

using Bars = std::vector<Bar>;

Bars bars_of(ChosenNumbers& chosen, int most) {
  Bars bars(static_cast<std::size_t>(chosen.choice(most)));
  // Occasionally, bars may contain NaN or die before they are born.
  const bool may_be_none = chosen.choice(15) == 0;
  for (Bar& bar : bars) {
    bar = {0, chosen.number(), chosen.number()};
    if (chosen.choice(7) == 0) bar.death = kInfinity;
    if (may_be_none) continue;
    if (std::isnan(bar.birth)) bar.birth = 0;
    if (std::isnan(bar.death)) bar.death = kInfinity;
    if (bar.death < bar.birth) std::swap(bar.birth, bar.death);
  }
  return bars;
}

bool is_diagram(const Bars& bars) {
  return std::ranges::all_of(bars, [](const Bar& bar) { return bar.birth <= bar.death; });
}

/// The cost of matchings of bars, by the definition.
struct Cost {
  double order, ground;  ///< exponents; if the order is infinite, the largest cost of a pair counts

  long double apart(const Bar& a, const Bar& b) const {
    const auto between = [](long double x, long double y) { return x == y ? 0 : std::abs(x - y); };
    const long double x = between(a.birth, b.birth), y = between(a.death, b.death);
    if (std::isinf(ground)) return std::max(x, y);
    // If both bars have always been alive, or both never die, they differ in only one end.
    if (x == 0 || y == 0) return x + y;
    const long double large = std::max(x, y), part = std::min(x, y) / large;
    return large * std::pow(1 + std::pow(part, static_cast<long double>(ground)), 1.0L / ground);
  }
  long double from_diagonal(const Bar& bar) const {
    if (bar.birth == bar.death) return 0;
    const long double length = static_cast<long double>(bar.death) - bar.birth;
    return std::isinf(ground) ? length / 2 : length * std::pow(2.0L, 1.0L / ground - 1);
  }
  long double sum(long double a, long double b) const {
    return std::isinf(order) ? std::max(a, b) : a + b;
  }
  long double power(long double cost) const {
    return std::isinf(order) ? cost : std::pow(cost, static_cast<long double>(order));
  }
};

/// The least cost over all ways to pair the bars of `a`, from the i-th on, with unused bars of `b`
/// or the diagonal.
long double least(const Bars& a, const Bars& b, const Cost& cost, std::vector<bool>& used,
                  std::size_t i = 0) {
  if (i == a.size()) {
    long double sum = 0;
    for (std::size_t j = 0; j < b.size(); ++j)
      if (!used[j]) sum = cost.sum(sum, cost.power(cost.from_diagonal(b[j])));
    return sum;
  }
  long double best = cost.sum(cost.power(cost.from_diagonal(a[i])), least(a, b, cost, used, i + 1));
  for (std::size_t j = 0; j < b.size(); ++j) {
    if (used[j]) continue;
    used[j] = true;
    best = std::min(best,
                    cost.sum(cost.power(cost.apart(a[i], b[j])), least(a, b, cost, used, i + 1)));
    used[j] = false;
  }
  return best;
}

long double by_all_matchings(const Bars& a, const Bars& b, const Cost& cost) {
  std::vector<bool> used(b.size());
  const long double sum = least(a, b, cost, used);
  return std::isinf(cost.order) ? sum : std::pow(sum, 1.0L / cost.order);
}

/// True if sums of powers are neither infinite nor zero as doubles. Otherwise the results would
/// have no correct digits.
bool is_moderate(const Bars& a, const Bars& b, double order) {
  constexpr double large = 1e150, small = 1e-150;
  const double most = std::isinf(order) ? large : std::pow(large, 1 / order),
               fewest = std::isinf(order) ? small : std::pow(small, 1 / order);
  const auto is = [&](double x) {
    return std::isinf(x) || x == 0 || (std::abs(x) < most && std::abs(x) > fewest);
  };
  const auto all = [&](const Bars& bars) {
    return std::ranges::all_of(bars, [&](const Bar& x) { return is(x.birth) && is(x.death); });
  };
  return all(a) && all(b);
}

bool is_near(double found, long double expected, long double scale) {
  if (std::isinf(expected)) return found == expected;
  return std::abs(found - expected) <= 1e-9L * (scale + expected);
}

void check_bottleneck(const Bars& a, const Bars& b) {
  const double distance = bottleneck_distance(a, b);
  require(distance >= 0, "a distance is no number or less than zero");
  require(bottleneck_distance(b, a) == distance, "the bottleneck distance depends on the order");
  require(bottleneck_distance(a, a) == 0, "a diagram is apart from itself");
  const long double expected = by_all_matchings(a, b, {kInfinity, kInfinity});
  if (is_moderate(a, b, kInfinity))
    require(is_near(distance, expected, 0), "the bottleneck distance is that of all matchings");
  const BottleneckMatching matching = bottleneck_matching(a, b);
  require(matching.distance == distance, "the matching has another distance");
  if (std::isinf(distance)) return;
  std::vector<bool> of_a(a.size()), of_b(b.size());
  const Cost cost{kInfinity, kInfinity};
  for (const auto& [i, j] : matching.pairs) {
    require(!of_a.at(i) && !of_b.at(j), "a bar has two partners");
    of_a[i] = of_b[j] = true;
    require(static_cast<double>(cost.apart(a[i], b[j])) <= distance, "a pair is too far apart");
  }
  for (std::size_t i = 0; i < a.size(); ++i)
    require(of_a[i] || a[i].persistence() / 2 <= distance, "a long bar has no partner");
  for (std::size_t j = 0; j < b.size(); ++j)
    require(of_b[j] || b[j].persistence() / 2 <= distance, "a long bar has no partner");
}

void check_wasserstein(const Bars& a, const Bars& b, const WassersteinOptions& options) {
  const DistanceBounds found = wasserstein_distance(a, b, options);
  require(found.lower <= found.value && found.lower >= 0, "bounds are none");
  if (!is_moderate(a, b, options.order)) return;
  const long double expected = by_all_matchings(a, b, {options.order, options.ground});
  // Computes the cost of pairing every bar with the diagonal.
  long double scale = 0;
  const Cost cost{options.order, options.ground};
  for (const Bars* bars : {&a, &b})
    for (const Bar& bar : *bars)
      if (std::isfinite(bar.birth) && std::isfinite(bar.death))
        scale = cost.sum(scale, cost.power(cost.from_diagonal(bar)));
  // ph/distances.hpp promises that p-th powers are accurate to 2e-15 of this cost. This test allows
  // an error of 1e-13.
  const long double rounding = std::pow(1e-13L * scale, 1.0L / options.order);
  require(std::isinf(expected) ? found.value == expected
                               : found.value >= expected * (1 - 1e-9L) - rounding,
          "a matching is cheaper than the cheapest");
  if (!std::isinf(expected))
    require(found.lower <= expected * (1 + 1e-9L) + rounding, "the lower bound is too high");
  if (options.limits.relative_error == 0 && std::isfinite(expected))
    require(found.value <= expected * (1 + 1e-9L) + rounding,
            "the Wasserstein distance is that of all matchings");
}

/// Runs a function that may refuse its bars. @return true if it did not refuse them.
template <class Run>
bool is_taken(Run&& run) {
  try {
    run();
    return true;
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::bad_data || error.kind() == ErrorKind::usage ||
                error.kind() == ErrorKind::resource,
            "a diagram is neither bad nor too large");
    require(std::string_view(error.what()).find('\n') == std::string_view::npos,
            "a message of several lines");
    return false;
  }
}

void check_vectors(const Bars& a, const Bars& b, ChosenNumbers& chosen) {
  const std::array<std::span<const Bar>, 2> both{a, b};
  std::vector<double> out(static_cast<std::size_t>(1 + chosen.choice(7)));
  const auto are_numbers = [&] {
    require(std::ranges::none_of(out, [](double x) { return std::isnan(x); }), "a vector is none");
  };
  is_taken([&] {
    const Grid grid = fit_grid(both, out.size());
    betti_curve(a, grid, out);
    are_numbers();
    // Checks that the number of living bars is never negative.
    for (std::size_t k = 0; k < out.size(); ++k) require(out[k] >= 0, "a negative Betti number");
    life_entropy_curve(a, grid, out);
    are_numbers();
    silhouette(a, grid, 1 + chosen.choice(2), out);
    are_numbers();
  });
  is_taken([&] {
    longest_lengths(a, out);
    require(std::ranges::is_sorted(out, std::greater()), "lengths are not sorted");
  });
  is_taken([&] { exact_landscape(a, 3); });
  is_taken([&] { entropy(a, chosen.coin()); });
  is_taken([&] {
    std::array<double, kStatistics> numbers{};
    statistics(a, numbers);
  });
}

}  // namespace

void run_diagrams(std::string_view bytes) {
  ChosenNumbers chosen(bytes);
  constexpr int most = 4;
  const Bars a = bars_of(chosen, most), b = bars_of(chosen, most);
  if (!is_diagram(a) || !is_diagram(b)) {
    require(!is_taken([&] { bottleneck_distance(a, b); }), "no diagrams have a distance");
    require(!is_taken([&] { wasserstein_distance(a, b); }), "no diagrams have a distance");
    require(!is_taken([&] { sliced_wasserstein_distance(a, b); }), "no diagrams have a distance");
    return;
  }
  switch (chosen.choice(3)) {
    case 0:
      return check_bottleneck(a, b);
    case 1:
      return check_vectors(a, b, chosen);
    default: {
      constexpr std::array<double, 4> orders{1, 2, 1.5, 3}, grounds{kInfinity, 2, 1, 3.5};
      WassersteinOptions options;
      options.order = orders[static_cast<std::size_t>(chosen.choice(3))];
      options.ground = grounds[static_cast<std::size_t>(chosen.choice(3))];
      if (chosen.coin()) options.limits.relative_error = 0.01;
      check_wasserstein(a, b, options);
      const double sliced = sliced_wasserstein_distance(a, b, 1 + chosen.choice(6));
      require(sliced >= 0, "a distance is no number or less than zero");
    }
  }
}

}  // namespace ph::fuzz
