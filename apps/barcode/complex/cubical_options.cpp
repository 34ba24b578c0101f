// SPDX-License-Identifier: MIT
#include "apps/barcode/complex/cubical_options.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ph::barcode {

CubicalOptions cubical_options(const Job& job, const Image& image,
                               const std::vector<bool>& periodic) {
  CubicalOptions options = job.question.cubical;
  options.threshold = job.question.threshold;
  if (options.periodic.empty()) options.periodic = periodic;
  const auto axes = static_cast<std::size_t>(image.dim());
  const bool all = options.periodic.size() == static_cast<std::size_t>(Cubical::kMaxDim) &&
                   std::ranges::all_of(options.periodic, [](bool on) { return on; });
  if (all) options.periodic.assign(axes, true);
  if (options.periodic.size() > axes)
    throw Error(ErrorKind::usage, fmt::format("--periodic: found axis {}, expected 0 to {}",
                                              options.periodic.size() - 1, axes - 1));
  return options;
}

void describe(const CubicalOptions& options, BarcodeInfo& info) {
  info.construction = name_of(options.construction);
  for (std::size_t axis = 0; axis < options.periodic.size(); ++axis)
    // mutant: json-periodic
    if (options.periodic[axis]) info.periodic.push_back(static_cast<int>(axis));
  info.superlevel = options.superlevel;
}

}  // namespace ph::barcode
