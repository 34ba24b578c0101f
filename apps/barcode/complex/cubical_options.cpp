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

}  // namespace ph::barcode
