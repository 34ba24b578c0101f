// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libph/src/core/random.hpp"
#include "libph/src/significance/quantile.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/error.hpp"
#include "ph/significance.hpp"

namespace ph {
namespace {

constexpr double kLargest = 1e300;  // this limit keeps sums finite

void check(std::span<const double> functions, std::size_t samples, const BandOptions& options) {
  significance::check_alpha(options.alpha, "multiplier_bootstrap");
  if (options.repetitions == 0)
    throw Error(ErrorKind::usage,
                "multiplier_bootstrap: repetitions: found 0, expected at least 1");
  if (samples < 2)
    throw Error(
        ErrorKind::usage,
        fmt::format("multiplier_bootstrap: found {} samples, expected at least 2", samples));
  if (functions.size() % samples != 0)
    throw Error(ErrorKind::usage,
                fmt::format("multiplier_bootstrap: found {0} numbers for {1} samples, expected a "
                            "multiple of {1}: one row of equal length per sample",
                            functions.size(), samples));
  for (const double number : functions)
    if (!(std::abs(number) <= kLargest))
      throw Error(ErrorKind::bad_data,
                  fmt::format("multiplier_bootstrap: found {}, expected numbers of at most {} in "
                              "absolute value",
                              number, kLargest));
}

}  // namespace

ConfidenceBand multiplier_bootstrap(std::span<const double> functions, std::size_t samples,
                                    const BandOptions& options, const RunContext& context) {
  check(functions, samples, options);
  const std::size_t length = functions.size() / samples;
  const auto count = static_cast<double>(samples);
  ConfidenceBand band;
  band.mean.resize(length);
  for (std::size_t i = 0; i < functions.size(); ++i) band.mean[i % length] += functions[i];
  for (double& mean : band.mean) mean /= count;

  std::pmr::vector<double> residuals(functions.begin(), functions.end(), &context.memory);
  for (std::size_t i = 0; i < residuals.size(); ++i) residuals[i] -= band.mean[i % length];
  // The largest absolute deviation of the mean in each repetition.
  std::pmr::vector<double> deviations(options.repetitions, &context.memory);
  for_each_piece("bootstrap", options.repetitions, 1, context,
                 [&](std::size_t begin, std::size_t end) {
                   std::pmr::vector<double> sums(length, &context.memory);
                   for (std::size_t k = begin; k < end; ++k) {
                     if (context.stop.stop_requested()) return;
                     Random random(options.seed, k);
                     std::ranges::fill(sums, 0.0);
                     const double* row = residuals.data();
                     for (std::size_t i = 0; i < samples; ++i, row += length) {
                       const double multiplier = random.normal();
                       for (std::size_t j = 0; j < length; ++j) sums[j] += multiplier * row[j];
                     }
                     double largest = 0;
                     for (const double sum : sums) largest = std::max(largest, std::abs(sum));
                     deviations[k] = largest / count;  // mutant: bootstrap-mean
                   }
                 });
  band.half_width = significance::upper_quantile(deviations, options.alpha);
  return band;
}

}  // namespace ph
