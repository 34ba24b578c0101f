// SPDX-License-Identifier: MIT
#include "libreport/report/arrays/point_arrays.hpp"

#include <algorithm>
#include <cmath>

#include "ph/barcode.hpp"

namespace ph::report {
namespace {

constexpr std::uint32_t kNoLabel = UINT32_MAX;

template <class T>
void add_as(ReportFile& report, std::string_view name, std::span<const std::uint32_t> labels) {
  const MemoryClaim copy(report.context().memory, labels.size() * sizeof(T));
  // UINT32_MAX, which means no label, becomes the largest value of the type.
  std::vector<T> numbers;
  numbers.reserve(labels.size());
  for (const std::uint32_t label : labels) numbers.push_back(static_cast<T>(label));
  report.add(name, numbers, {.delta = sizeof(T) > 1});
}

}  // namespace

template <class Real>
void add_positions(ReportFile& report, std::span<const Real> coordinates, std::size_t dims,
                   double tolerance) {
  constexpr double steps = UINT16_MAX;
  ArrayForm form{.shape = {coordinates.size() / dims, dims}};
  std::vector<double> low(dims, kInfinity), high(dims, -kInfinity);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    low[i % dims] = std::min(low[i % dims], double{coordinates[i]});
    high[i % dims] = std::max(high[i % dims], double{coordinates[i]});
  }
  std::vector<double> scale;
  for (std::size_t k = 0; k < dims; ++k)
    scale.push_back(high[k] > low[k] ? (high[k] - low[k]) / steps : 1);
  const bool fine = std::ranges::all_of(scale, [&](double s) { return s <= tolerance || s == 1; });
  if (coordinates.empty() || !fine) return report.add("points/position", coordinates, form);

  const MemoryClaim copy(report.context().memory, coordinates.size() * sizeof(std::uint16_t));
  std::vector<std::uint16_t> stored;
  stored.reserve(coordinates.size());
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const double step = std::round((double{coordinates[i]} - low[i % dims]) / scale[i % dims]);
    stored.push_back(static_cast<std::uint16_t>(std::clamp(step, 0.0, steps)));
  }
  form.delta = true;
  form.offset = std::move(low);
  form.scale = std::move(scale);
  report.add("points/position", stored, form);
}
template void add_positions(ReportFile&, std::span<const float>, std::size_t, double);
template void add_positions(ReportFile&, std::span<const double>, std::size_t, double);

std::array<std::int8_t, 2> octahedral(double x, double y, double z) {
  const double sum = std::abs(x) + std::abs(y) + std::abs(z);
  if (!(sum > 0) || !std::isfinite(sum)) return {-128, -128};
  double u = x / sum, v = y / sum;
  if (z < 0) {  // the lower half is folded over the corners
    const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
    v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
    u = folded;
  }
  const auto stored = [](double t) { return static_cast<std::int8_t>(std::round(127 * t)); };
  return {stored(u), stored(v)};
}

void add_labels(ReportFile& report, std::string_view name, std::span<const std::uint32_t> labels,
                bool none) {
  std::uint32_t largest = 0;
  for (const std::uint32_t label : labels)
    if (!none || label != kNoLabel) largest = std::max(largest, label);
  if (!none && largest <= UINT8_MAX)
    add_as<std::uint8_t>(report, name, labels);
  else if (largest < UINT16_MAX)
    add_as<std::uint16_t>(report, name, labels);
  else
    report.add(name, labels, {.delta = true});
}

}  // namespace ph::report
