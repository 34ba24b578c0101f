// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "libph/src/vectors/long_sum.hpp"
#include "ph/detail/core/parallel.hpp"
#include "ph/detail/diagram/thread_context.hpp"
#include "ph/detail/vectors/checked_bars.hpp"
#include "ph/vectorise.hpp"

namespace ph {
namespace vectors {
namespace {

constexpr double kLeastExponent = 40;  // exp(-40) is 4e-18

/// Computes Σ exp(-|p - q|² / width²) · factor(p, q) over pairs of nearby bars.
template <class Factor>
double sum_over_pairs(const std::vector<Bar>& a, std::vector<Bar> b, double width,
                      const RunContext& context, const Factor& factor) {
  std::ranges::sort(b, {}, &Bar::birth);
  const double reach = std::sqrt(kLeastExponent) * width;  // mutant: kernel-reach
  Ticker ticker(context, "kernel", a.size());
  LongSum sum;
  for (const Bar& p : a) {
    const auto first = std::ranges::lower_bound(b, p.birth - reach, {}, &Bar::birth);
    auto q = first;
    for (; q != b.end() && q->birth <= p.birth + reach; ++q) {
      const double x = (p.birth - q->birth) / width, y = (p.death - q->death) / width;
      const double exponent = x * x + y * y;
      if (exponent <= kLeastExponent) sum.add(std::exp(-exponent) * factor(p, *q));
    }
    ticker.work(static_cast<std::uint64_t>(q - first));
    ticker.tick();
  }
  return sum.value();
}

}  // namespace
}  // namespace vectors

double scale_space_kernel(std::span<const Bar> a, std::span<const Bar> b, double sigma,
                          const RunContext& context) {
  using vectors::Ends;
  vectors::check_positive(sigma, "sigma", "scale_space_kernel");
  const std::vector<Bar> first = vectors::checked_bars(a, Ends::finite, "scale_space_kernel");
  std::vector<Bar> second = vectors::checked_bars(b, Ends::finite, "scale_space_kernel");
  const double width = std::sqrt(8 * sigma);
  // Let q' be the mirror image of q at the diagonal. The squared distance |p - q'|² equals |p - q|²
  // + 2 length(p) length(q). This form needs no difference of nearly equal numbers.
  const double sum = vectors::sum_over_pairs(
      first, std::move(second), width, context, [width](const Bar& p, const Bar& q) {
        // mutant: kernel-mirror
        return -std::expm1(-2 * (p.persistence() / width) * (q.persistence() / width));
      });
  return sum / std::numbers::pi / 8 / sigma;
}

double weighted_gaussian_kernel(std::span<const Bar> a, std::span<const Bar> b,
                                const WeightedGaussian& options, const RunContext& context) {
  using vectors::Ends;
  constexpr std::string_view name = "weighted_gaussian_kernel";
  vectors::check_positive(options.sigma, "sigma", name);
  vectors::check_positive(options.slope, "slope", name);
  vectors::check_power(options.power, name);
  const std::vector<Bar> first = vectors::checked_bars(a, Ends::finite, name);
  std::vector<Bar> second = vectors::checked_bars(b, Ends::finite, name);
  const auto weight = [&](const Bar& bar) {
    return std::atan(options.slope * std::pow(bar.persistence(), options.power));
  };
  return vectors::sum_over_pairs(first, std::move(second), std::numbers::sqrt2 * options.sigma,
                                 context,
                                 [&](const Bar& p, const Bar& q) { return weight(p) * weight(q); });
}

std::vector<double> gram_matrix(std::span<const std::span<const Bar>> diagrams,
                                const DiagramKernel& kernel, const RunContext& context) {
  struct Pair {
    std::uint32_t row, column;
  };
  const std::size_t count = diagrams.size();
  // The claim counts half of the sorted list a second time, for the buffer of the stable sort.
  const MemoryClaim claim(context.memory, count * count * sizeof(double) +
                                              3 * (count * (count + 1) / 2) * sizeof(Pair) / 2);
  std::vector<double> matrix(count * count);
  std::vector<Pair> pairs;
  pairs.reserve(count * (count + 1) / 2);
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::uint32_t j = 0; j <= i; ++j) pairs.push_back({i, j});
  // The longest tasks come first, so that no thread starts a long task at the end.
  std::ranges::stable_sort(pairs, std::greater<>(), [&](const Pair& pair) {
    return diagrams[pair.row].size() * diagrams[pair.column].size();
  });
  const diagram::ThreadContexts tasks(pairs.size(), context);
  for_each_piece("Gram matrix", pairs.size(), 1, context, [&](std::size_t begin, std::size_t end) {
    RunContext task;
    tasks.prepare(task);
    for (std::size_t i = begin; i < end; ++i) {
      const auto [row, column] = pairs[i];
      const double value = kernel(diagrams[row], diagrams[column], task);
      matrix[row * count + column] = matrix[column * count + row] = value;
    }
  });
  return matrix;
}

}  // namespace ph
