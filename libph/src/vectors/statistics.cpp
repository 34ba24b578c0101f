// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>

#include "libph/src/vectors/long_sum.hpp"
#include "ph/detail/vectors/checked_bars.hpp"
#include "ph/vectorise.hpp"

namespace ph {
namespace vectors {
namespace {

constexpr std::size_t kNumbersEach = 9;

double mean_of(const std::vector<double>& numbers) {
  LongSum sum;
  for (const double x : numbers) sum.add(x);
  return sum.value() / static_cast<double>(numbers.size());
}

double deviation_of(const std::vector<double>& numbers, double mean) {
  double largest = 0;
  for (const double x : numbers) largest = std::max(largest, std::abs(x - mean));
  if (largest == 0) return 0;
  LongSum sum;  // numbers are scaled to [-1, 1], because small squares would be 0
  for (const double x : numbers) sum.add((x - mean) / largest * ((x - mean) / largest));
  // mutant: deviation
  return largest * std::sqrt(sum.value() / static_cast<double>(numbers.size()));
}

/// Interpolates between two adjacent numbers, starting from the nearer number.
double percentile_of(const std::vector<double>& sorted, double percent) {
  const double place = percent / 100 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double low = sorted[below], high = sorted[std::min(below + 1, sorted.size() - 1)];
  const double part = place - static_cast<double>(below);
  // mutant: percentile
  return part < 0.5 ? low + (high - low) * part : high - (high - low) * (1 - part);
}

void describe(std::vector<double> numbers, std::span<double> out) {
  std::ranges::sort(numbers);
  const double low = percentile_of(numbers, 25), high = percentile_of(numbers, 75);
  out[0] = mean_of(numbers);
  out[1] = deviation_of(numbers, out[0]);
  out[2] = percentile_of(numbers, 50);
  out[3] = high - low;
  out[4] = numbers.back() - numbers.front();
  out[5] = percentile_of(numbers, 10);
  out[6] = low;
  out[7] = high;
  out[8] = percentile_of(numbers, 90);
}

/// The entropy of the lengths of bars. All lengths must be above 0.
double entropy_of(const std::vector<Bar>& bars) {
  LongSum total, sum;
  for (const Bar& bar : bars) total.add(bar.persistence());
  for (const Bar& bar : bars) {
    const double share = bar.persistence() / total.value();
    if (share > 0) sum.add(share * std::log(share));
  }
  return std::max(0.0, -sum.value());
}

}  // namespace
}  // namespace vectors

void statistics(std::span<const Bar> given, std::span<double> out) {
  using vectors::kNumbersEach;
  vectors::check_size(out, kStatistics, "statistics");
  const std::vector<Bar> bars = vectors::checked_bars(given, vectors::Ends::finite, "statistics");
  std::ranges::fill(out, 0);
  if (bars.empty()) return;
  const std::function<double(const Bar&)> numbers[] = {
      [](const Bar& bar) { return bar.birth; },
      [](const Bar& bar) { return bar.death; },
      [](const Bar& bar) { return (bar.birth + bar.death) / 2; },
      [](const Bar& bar) { return bar.persistence(); },
  };
  std::size_t first = 0;
  for (const auto& number : numbers) {
    std::vector<double> all;
    all.reserve(bars.size());
    for (const Bar& bar : bars) all.push_back(number(bar));
    vectors::describe(std::move(all), out.subspan(first, kNumbersEach));
    first += kNumbersEach;
  }
  out[first] = static_cast<double>(bars.size());
  out[first + 1] = vectors::entropy_of(bars);
}

const std::array<std::string_view, kStatistics>& statistics_names() {
  static constexpr std::array<std::string_view, kStatistics> names = {
      "birth_mean",      "birth_sd",     "birth_median",   "birth_iqr",     "birth_range",
      "birth_p10",       "birth_p25",    "birth_p75",      "birth_p90",     "death_mean",
      "death_sd",        "death_median", "death_iqr",      "death_range",   "death_p10",
      "death_p25",       "death_p75",    "death_p90",      "midpoint_mean", "midpoint_sd",
      "midpoint_median", "midpoint_iqr", "midpoint_range", "midpoint_p10",  "midpoint_p25",
      "midpoint_p75",    "midpoint_p90", "length_mean",    "length_sd",     "length_median",
      "length_iqr",      "length_range", "length_p10",     "length_p25",    "length_p75",
      "length_p90",      "count",        "entropy"};
  return names;
}

double entropy(std::span<const Bar> given, bool normalised) {
  const std::vector<Bar> bars = vectors::checked_bars(given, vectors::Ends::finite, "entropy");
  if (bars.size() < 2) return 0;
  const double nats = vectors::entropy_of(bars);
  return normalised ? nats / std::log(static_cast<double>(bars.size())) : nats;
}

void longest_lengths(std::span<const Bar> bars, std::span<double> out) {
  std::vector<double> lengths;
  for (const Bar& bar : vectors::checked_bars(bars, vectors::Ends::finite, "longest_lengths"))
    lengths.push_back(bar.persistence());
  const std::size_t count = std::min(out.size(), lengths.size());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(count);
  std::ranges::partial_sort(lengths, middle, std::greater<>());
  std::fill(std::copy(lengths.begin(), middle, out.begin()), out.end(), 0.0);
}

}  // namespace ph
