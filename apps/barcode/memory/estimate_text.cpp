// SPDX-License-Identifier: MIT
#include "apps/barcode/memory/estimate_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ph/detail/core/format_size.hpp"
#include "ph/io/write.hpp"

namespace ph::barcode {

std::string estimate_text(const Estimate& estimate, const BuiltComplex& built,
                          const std::string& description, double taken) {
  std::string text = fmt::format("input    {}\ncomplex  {}", description, built.name);
  if (built.threshold) text += fmt::format(", values up to {}", shortest(*built.threshold));
  if (!built.vertex_weights.empty())
    text += fmt::format(", vertices enter late ({})", built.vertex_weights);
  text += fmt::format("\nengine   {} ({})\n", estimate.options.engine.name(), estimate.reason);
  const bool is_collapsed = estimate.options.collapse == Collapse::on;
  if (!estimate.collapse_reason.empty())
    text +=
        fmt::format("collapse {} ({})\n", is_collapsed ? "on" : "off", estimate.collapse_reason);
  if (is_collapsed && estimate.built.edges)
    text += fmt::format("edges    {} before the collapse\n", *estimate.built.edges);
  for (std::size_t dim = 0; dim < estimate.cells.size(); ++dim) {
    const bool is_counted = static_cast<int>(dim) < estimate.counted_dims;
    text += fmt::format("cells    dimension {}: {}{:.0f}\n", dim,
                        estimate.cells_at_most ? "at most "
                        : is_counted           ? ""
                                               : "about ",
                        estimate.cells[dim]);
  }
  const int listed = static_cast<int>(estimate.cells.size()) - 1;
  if (listed < *estimate.options.max_dim + 1)
    text += fmt::format("cells    dimension {} and above: not listed\n", listed + 1);
  // Some of the measured memory consists of code pages, which any input needs.
  constexpr double code = 2 << 20;
  const double low = std::max({0.0, taken - code, estimate.bytes_low});
  // Memory that was freed after building may not suit the next allocations. In the worst case, none
  // of it is used again.
  const double high =
      std::max(taken, estimate.bytes_held) + estimate.bytes_high - estimate.bytes_held;
  return text + fmt::format("memory   {} to {}\n", format_size(low), format_size(high));
}

}  // namespace ph::barcode
