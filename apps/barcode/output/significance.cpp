// SPDX-License-Identifier: MIT
#include "apps/barcode/output/significance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "ph/significance.hpp"

namespace ph::barcode {

void require_significance(BarcodeFormat format, const Job& job) {
  if (!job.results.significance) return;
  const auto reject = [](const std::string& found) {
    throw Error(ErrorKind::usage, "--significance: found " + found);
  };
  if (format != BarcodeFormat::csv && format != BarcodeFormat::json)
    reject(fmt::format("output format {}, expected csv or json, which have room for p",
                       barcode_format_name(format)));
  if (job.question.options.min_persistence > 0)
    reject(
        "--min-persistence, expected all bars, because p compares each bar with the others; leave "
        "out bars with a large p afterwards");
  if (job.question.complex == ComplexKind::delaunay_rips)
    reject(
        "--complex delaunay-rips, expected rips, alpha or delaunay-cech, because p-values are "
        "known only for these");
  if (job.question.rips.computes_births() || !job.question.vertex_weights.empty() ||
      !job.question.weights.empty())
    reject(
        "vertices with weights, expected vertices that enter at 0, because p compares ratios of "
        "death to birth");
  if (job.question.options.max_dim == 0)
    reject("--max-dim 0, expected dimension 1 or above, because components are born at 0");
}

std::vector<double> p_values_of(const Barcode& barcode, DistanceFiltration filtration) {
  std::vector<double> result(barcode.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t begin = 0; begin < barcode.size();) {
    std::size_t end = begin;
    std::vector<Bar> bars;  // the bars of one dimension, in the order of the dimension
    while (end < barcode.size() && barcode[end].dim == barcode[begin].dim)
      bars.push_back(barcode[end++]);
    if (barcode[begin].dim > 0)
      std::ranges::copy(universal_p_values(bars, filtration).corrected,
                        result.begin() + static_cast<std::ptrdiff_t>(begin));
    begin = end;
  }
  return result;
}

}  // namespace ph::barcode
