// SPDX-License-Identifier: MIT
// Checks alpha complexes of points whose coordinates are arbitrary doubles.
#include "ph/persistence.hpp"
#include "tests/fuzz/chosen_numbers.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/violation.hpp"
#include "tests/libph/alpha/alpha_oracle.hpp"

namespace ph::fuzz {
namespace {

using test::Rational;

Rational magnitude(const Rational& x) { return x < 0 ? Rational(-x) : x; }

/// Checks that faces come before cofaces, and that the Euler characteristic is 1.
/// @return true if the complex has any simplex.
bool check_simplices(const Alpha& alpha) {
  long euler = 0, count = 0;
  for (int dim = 0; dim <= alpha.top_dim(); ++dim)
    alpha.for_each_cell(dim, [&](const Alpha::Cell& cell) {
      ++count;
      euler += dim % 2 == 0 ? 1 : -1;
      const double value = alpha.value(cell);
      require(std::isfinite(value), "values are finite");
      alpha.for_each_facet(dim, cell, [&](const Alpha::Cell& facet, auto&&...) {
        require(alpha.value(facet) <= value, "no face is later than a coface");
      });
    });
  require(count == 0 || euler == 1, "the Euler characteristic is 1");
  return count > 0;
}

void check_bars(const Alpha& alpha, std::size_t vertices) {
  const Barcode bars = persistence(alpha);
  std::size_t essential = 0;
  for (const Bar& bar : bars) {
    require(bar.birth < bar.death, "bars have a length");
    if (!bar.is_infinite()) continue;
    ++essential;
    require(bar.dim == 0, "holes are filled in the end");
  }
  require(essential == (vertices > 0 ? 1 : 0), "one component is left");
  require(bars.bars(0).size() <= vertices, "a vertex begins one component");
  const Barcode oracle = persistence(alpha, {.engine = Engine::standard});
  require(std::ranges::equal(bars, oracle), "the bars are those of the textbook");
  const Barcode all =
      persistence(alpha, {.max_dim = 0, .engine = Engine::standard, .min_persistence = -1});
  require(all.size() == vertices, "each vertex begins a component");
}

/// Checks that the simplices and their values agree with the definition.
void check_definition(const Alpha& alpha, PointsView points, const std::vector<double>& weights,
                      bool squared) {
  const test::AlphaOracle oracle(points, weights);
  Rational largest = 0;
  for (Index i = 0; i < points.rows(); ++i)
    for (Index k = 0; k < points.cols(); ++k)
      largest = std::max(largest, magnitude(Rational(points(i, k))));
  Rational size = largest * largest;
  for (const double w : weights) size = std::max(size, magnitude(Rational(w)));
  for (int dim = 0; dim <= alpha.top_dim(); ++dim)
    alpha.for_each_cell(dim, [&](const Alpha::Cell& cell) {
      std::vector<Index> numbers;
      alpha.append_input_cell(dim, cell, numbers);
      unsigned simplex = 0;
      for (const Index v : numbers) simplex |= 1U << v;
      const auto at = oracle.values().find(simplex);
      require(at != oracle.values().end(), "each simplex is one of the definition");
      const Rational found(alpha.value(cell));
      const Rational square = squared ? found : Rational(found * found);
      // The promise of alpha.hpp does not cover numbers whose squares are too small or too large
      // for doubles.
      const Rational last(std::numeric_limits<double>::denorm_min());
      const Rational least =
          Rational(1e-300) * size + (squared ? 4 * last : Rational(last * (2 * found + last)));
      if (at->second > Rational(1e300) * size || at->second > Rational(1e307)) return;
      const Rational scale = weights.empty() ? at->second : Rational(magnitude(at->second) + size);
      require(magnitude(square - at->second) <= Rational(1e-11) * scale + least,
              "values are those of the definition");
    });
}

/// True if the coordinates and weights have few digits. With longer numbers, arithmetic with exact
/// fractions would take seconds.
bool is_of_few_digits(PointsView points, std::vector<double> numbers) {
  for (Index i = 0; i < points.rows(); ++i)
    for (Index k = 0; k < points.cols(); ++k) numbers.push_back(points(i, k));
  std::erase(numbers, 0);
  if (numbers.empty()) return true;
  const auto [low, high] = std::ranges::minmax(numbers, {}, [](double x) { return std::ilogb(x); });
  constexpr int few = 100;
  return std::ilogb(high) - std::ilogb(low) <= few;
}

}  // namespace

void run_alpha(std::string_view bytes) {
  ChosenNumbers choices(bytes);
  const Index coordinates = choices.choice(2) + 1;
  const int most = choices.choice(3) == 0 ? 30 : 6;
  const Index count = choices.choice(most);
  const bool weighted = choices.choice(2) == 0, squared = weighted || choices.choice(1) == 1;
  const Points points = choices.points(count, coordinates);
  AlphaOptions options;
  if (weighted) options.weights = choices.numbers(count);
  options.unit = squared ? AlphaOptions::Unit::squared : AlphaOptions::Unit::radius;
  try {
    const Alpha alpha(points, options);
    const std::vector<std::size_t> counts = alpha.simplex_counts();
    const std::size_t vertices = counts.empty() ? 0 : counts[0];
    require(vertices + alpha.hidden().size() == static_cast<std::size_t>(count),
            "each point is a vertex or hidden");
    require(check_simplices(alpha) == (count > 0), "points make simplices");
    check_bars(alpha, vertices);
    if (count > 0 && count <= 5 && is_of_few_digits(points, options.weights))
      check_definition(alpha, points, options.weights, squared);
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::bad_data, "numbers are refused as bad data");
  }
}

}  // namespace ph::fuzz
