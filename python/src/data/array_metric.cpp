// SPDX-License-Identifier: MIT
#include "python/src/data/array_metric.hpp"

#include <fmt/format.h>

#include <compare>
#include <mutex>
#include <string>
#include <string_view>

#include "ph/detail/core/parallel.hpp"
#include "ph/error.hpp"

namespace ph::python {
namespace {

constexpr double kRounding = 1e-6;
// The number of rows, and of columns, of a tile that is processed at once.
constexpr Index kTile = 64;

struct Place {
  Index i = 0, j = 0;
  friend auto operator<=>(const Place&, const Place&) = default;
};

/// The number with the largest deviation from its required value. If several numbers have the same
/// deviation, it is the first of them.
struct Doubt {
  double size = 0;
  Place place;

  void take(double its_size, Place its_place) {
    if (its_size > size || (its_size == size && size > 0 && its_place < place))
      *this = {its_size, its_place};
  }
};

/// The findings of the check. Whether a deviation is an error depends on the largest distance, and
/// the choice of the reported error must not depend on threads.
struct Findings {
  double largest = 0;
  Doubt nan, negative, asymmetric, diagonal;

  void merge(const Findings& other) {
    largest = std::max(largest, other.largest);
    nan.take(other.nan.size, other.nan.place);
    negative.take(other.negative.size, other.negative.place);
    asymmetric.take(other.asymmetric.size, other.asymmetric.place);
    diagonal.take(other.diagonal.size, other.diagonal.place);
  }
};

[[noreturn]] void fail(const std::string& place, double found, std::string_view expected) {
  throw Error(ErrorKind::bad_data,
              fmt::format("distances: {}: found {}, expected {}", place, found, expected));
}

std::string name_of(const DistanceArray& array, Place place) {
  const auto [i, j] = place;
  if (!array.is_condensed) return fmt::format("row {}, column {}", i, j);
  return fmt::format("entry {}, of points {} and {}", array.condensed_place(i, j), i, j);
}

template <class Number>
class Check {
 public:
  Check(const DistanceArray& array, const RunContext& context)
      : array_(array), metric_(array), context_(context) {}

  void square() {
    const auto tiles = static_cast<std::size_t>((array_.points + kTile - 1) / kTile);
    for_each_piece("checking distances", tiles, 1, context_, [&](std::size_t tile, std::size_t) {
      Findings found;
      const Index first_row = static_cast<Index>(tile) * kTile;
      for (Index first_column = 0; first_column <= first_row; first_column += kTile) {
        context_.poll();
        look_at_tile(first_row, first_column, found);
      }
      add(found);
    });
    const double rounding = kRounding * all_.largest;
    fail_if_no_distance(rounding);
    if (const auto& [size, place] = all_.asymmetric; size > rounding)
      throw Error(
          ErrorKind::bad_data,
          fmt::format("distances: asymmetric: row {0}, column {1} is {2} but row {1}, "
                      "column {0} is {3}, expected both equal; {4} accepts it",
                      place.i, place.j, metric_.entry(place.i, place.j),
                      metric_.entry(place.j, place.i), mark(Setting::symmetrise, "max|min|lower")));
    if (const auto& [size, place] = all_.diagonal; size > rounding)
      fail(name_of(array_, place), metric_.entry(place.i, place.j),
           fmt::format("0 on the diagonal; {} treats it as the birth of the point, {} as 0",
                       mark(Setting::diagonal, "births"), mark(Setting::diagonal, "any")));
  }

  void condensed() {
    const auto rows = static_cast<std::size_t>(array_.points);
    for_each_piece("checking distances", rows, kTile, context_,
                   [&](std::size_t begin, std::size_t end) {
                     Findings found;
                     for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i)
                       for (Index j = i + 1; j < array_.points; ++j)
                         look_at(metric_.condensed(i, j), {i, j}, found);
                     add(found);
                   });
    fail_if_no_distance(kRounding * all_.largest);
  }

 private:
  void look_at_tile(Index first_row, Index first_column, Findings& found) const {
    const Index rows = std::min(first_row + kTile, array_.points);
    for (Index i = first_row; i < rows; ++i) {
      for (Index j = first_column; j < std::min(first_column + kTile, i); ++j) {
        const double lower = metric_.entry(i, j), upper = metric_.entry(j, i);
        look_at(lower, {i, j}, found);
        look_at(upper, {j, i}, found);
        if (lower != upper && array_.symmetrise == Symmetrise::none)
          found.asymmetric.take(difference(lower, upper), {i, j});
      }
    }
    if (first_column != first_row || !array_.has_zero_diagonal) return;
    for (Index i = first_row; i < rows; ++i) {
      const double value = metric_.entry(i, i);
      if (value == 0) continue;
      std::isnan(value) ? found.nan.take(1, {i, i}) : found.diagonal.take(std::abs(value), {i, i});
    }
  }
  static void look_at(double value, Place place, Findings& found) {
    if (value >= 0) {
      if (value > found.largest && std::isfinite(value)) found.largest = value;
    } else {
      std::isnan(value) ? found.nan.take(1, place) : found.negative.take(-value, place);
    }
  }
  /// The difference between two numbers that are not equal.
  static double difference(double a, double b) {
    if (std::isnan(a) && std::isnan(b)) return 0;
    const double d = std::abs(a - b);
    return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
  }
  void fail_if_no_distance(double rounding) const {
    if (all_.nan.size > 0 && array_.nan == NanPolicy::error)
      fail(name_of(array_, all_.nan.place), std::numeric_limits<double>::quiet_NaN(),
           array_.has_nan_option
               ? fmt::format("0 or more; {} never joins such a pair", mark(Setting::nan, "drop"))
               : "0 or more");
    if (all_.negative.size > rounding)
      fail(name_of(array_, all_.negative.place), -all_.negative.size, "0 or more");
  }
  void add(const Findings& found) {
    const std::lock_guard lock(mutex_);
    all_.merge(found);
  }

  const DistanceArray& array_;
  const ArrayMetric<Number> metric_;
  const RunContext& context_;
  Findings all_;
  std::mutex mutex_;
};

}  // namespace

template <class Number>
void check_distances(const DistanceArray& array, const RunContext& context) {
  Check<Number> all(array, context);
  array.is_condensed ? all.condensed() : all.square();
}

template void check_distances<float>(const DistanceArray& array, const RunContext& context);
template void check_distances<double>(const DistanceArray& array, const RunContext& context);

}  // namespace ph::python
