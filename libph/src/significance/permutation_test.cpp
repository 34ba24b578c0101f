// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>

#include "libph/src/core/random.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/error.hpp"
#include "ph/significance.hpp"

namespace ph {
namespace {

/// The group of each diagram, numbered 0, 1, …, and the size of each group.
struct Groups {
  std::vector<std::uint32_t> of;
  std::vector<std::size_t> sizes;
};

Groups numbered(std::span<const std::int64_t> given) {
  std::map<std::int64_t, std::uint32_t> numbers;
  Groups groups;
  for (const std::int64_t name : given) {
    const auto [place, is_new] =
        numbers.try_emplace(name, static_cast<std::uint32_t>(numbers.size()));
    if (is_new) groups.sizes.push_back(0);
    groups.of.push_back(place->second);
    ++groups.sizes[place->second];
  }
  for (const auto& [name, number] : numbers)
    if (groups.sizes[number] < 2)
      throw Error(ErrorKind::usage,
                  fmt::format("permutation_test: found one diagram in group {}, expected at least "
                              "2 in each group",
                              name));
  if (numbers.size() < 2)
    throw Error(
        ErrorKind::usage,
        fmt::format("permutation_test: found {} groups, expected at least 2", numbers.size()));
  return groups;
}

void check(const DistanceMatrix& distances, std::size_t labels, const PermutationOptions& options) {
  if (options.shuffles == 0)
    throw Error(ErrorKind::usage, "permutation_test: shuffles: found 0, expected at least 1");
  if (!(options.power > 0) || std::isinf(options.power))
    throw Error(ErrorKind::usage,
                fmt::format("permutation_test: power: found {}, expected a finite number above 0",
                            options.power));
  if (labels != static_cast<std::size_t>(distances.size()))
    throw Error(
        ErrorKind::usage,
        fmt::format("permutation_test: found the groups of {} diagrams, expected those of {}, "
                    "the number of rows of the distances",
                    labels, distances.size()));
}

/// A unit in which the power of the largest distance neither overflows nor underflows. The unit is
/// 1 if possible.
double unit_of(const DistanceMatrix& distances, double power) {
  double largest = 0;
  for (Index i = 0; i < distances.size(); ++i)
    for (Index j = 0; j < i; ++j) largest = std::max(largest, distances(i, j));
  const double least = 1e-280, most = 1e280;  // these limits leave room for sums of powers
  const double of_largest = std::pow(largest, power);
  // mutant: permutation-powers
  return largest == 0 || (of_largest >= least && of_largest <= most) ? 1 : largest;
}

/// The distances below the diagonal, row by row, raised to the power.
std::pmr::vector<double> powers_of(const DistanceMatrix& distances, double power, double unit,
                                   const RunContext& context) {
  const Index n = distances.size();
  std::pmr::vector<double> powers(&context.memory);
  powers.reserve(static_cast<std::size_t>(n * (n - 1) / 2));
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < i; ++j) {
      const double distance = distances(i, j);
      if (std::isinf(distance))
        throw Error(ErrorKind::bad_data,
                    fmt::format("permutation_test: diagrams {} and {}: found an infinite distance, "
                                "expected finite distances; leave out bars that never die",
                                j, i));
      powers.push_back(power == 1 ? distance / unit : std::pow(distance / unit, power));
    }
  return powers;
}

/// The sum, over all groups, of half the mean power of the pairs in the group. For a group of n
/// diagrams, half the mean power is 1 / (2 n (n - 1)) times the sum over ordered pairs.
double loss_of(std::span<const double> powers, std::span<const std::uint32_t> groups,
               std::span<const std::size_t> sizes, std::vector<double>& sums) {
  sums.assign(sizes.size(), 0.0);
  const double* power = powers.data();
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (std::size_t j = 0; j < i; ++j, ++power)
      if (groups[i] == groups[j]) sums[groups[i]] += *power;
  double loss = 0;
  for (std::size_t g = 0; g < sizes.size(); ++g)
    loss += sums[g] / static_cast<double>(sizes[g] * (sizes[g] - 1));  // mutant: permutation-itself
  return loss;
}

}  // namespace

PermutationTest permutation_test(const DistanceMatrix& distances,
                                 std::span<const std::int64_t> groups,
                                 const PermutationOptions& options, const RunContext& context) {
  check(distances, groups.size(), options);
  const Groups observed = numbered(groups);
  const double unit = unit_of(distances, options.power);
  const std::pmr::vector<double> powers = powers_of(distances, options.power, unit, context);
  std::vector<double> sums;
  PermutationTest result;
  const double loss = loss_of(powers, observed.of, observed.sizes, sums);
  result.loss =
      unit == 1 ? loss : std::pow(unit * std::pow(loss, 1 / options.power), options.power);
  // The factor allows for rounding, because sums in a different order differ slightly. Shuffles
  // that only exchange the labels of groups then count as ties.
  const double as_low = loss * (1 + 1e-12);
  std::atomic<std::size_t> as_low_count = 0;
  for_each_piece("shuffles", options.shuffles, 1, context, [&](std::size_t begin, std::size_t end) {
    std::vector<double> own_sums;
    std::size_t own_count = 0;
    for (std::size_t k = begin; k < end; ++k) {
      if (context.stop.stop_requested()) return;
      Random random(options.seed, k);
      std::vector<std::uint32_t> shuffled = observed.of;
      draw(shuffled, shuffled.size(), random);
      own_count += loss_of(powers, shuffled, observed.sizes, own_sums) <= as_low;
    }
    as_low_count += own_count;
  });
  // mutant: permutation-observed
  result.p = (static_cast<double>(as_low_count) + 1) / (static_cast<double>(options.shuffles) + 1);
  return result;
}

}  // namespace ph
