// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libph/src/core/for_each_target.hpp"
#include "libph/src/vectors/grid_cells.hpp"
#include "ph/detail/vectors/checked_bars.hpp"
#include "ph/error.hpp"

namespace ph {
namespace vectors {
namespace {

// mutant: image-window
constexpr double kReach = 8;  // in standard deviations

/// The masses that a normal distribution has in the pixels of an interval.
class Masses {
 public:
  Masses(const PixelRange& range, double sigma)
      : edges_(Grid{range.lo, range.hi, range.pixels + 1}.values()),
        reach_(kReach * sigma),
        width_(sigma * std::numbers::sqrt2),
        masses_(range.pixels) {}

  /// Finds the pixels near a centre, and the mass that the distribution around this centre has in
  /// each of them.
  void go_to(double centre) {
    first_ = pixel_at(centre - reach_);
    const std::size_t end = std::min(pixel_at(centre + reach_) + 1, masses_.size());
    count_ = end > first_ ? end - first_ : 0;
    if (count_ == 0) return;
    double before = std::erf((edges_[first_] - centre) / width_);
    for (std::size_t i = first_; i < end; ++i) {
      const double behind = std::erf((edges_[i + 1] - centre) / width_);
      masses_[i] = (behind - before) / 2;  // mutant: image-integral
      before = behind;
    }
  }
  std::size_t first() const { return first_; }
  std::size_t count() const { return count_; }
  const double* data() const { return masses_.data() + first_; }

 private:
  /// The pixel that contains x. It is 0 if x is below all pixels, and the number of pixels if x is
  /// above all pixels.
  std::size_t pixel_at(double x) const {
    const auto count = static_cast<double>(masses_.size());
    const double part = (x - edges_.front()) / (edges_.back() - edges_.front());
    return static_cast<std::size_t>(std::clamp(part * count, 0.0, count));
  }

  std::vector<double> edges_;
  double reach_, width_;
  std::vector<double> masses_;
  std::size_t first_ = 0, count_ = 0;
};

/// Adds the product of a column and a row of numbers to part of a matrix.
PH_FOR_EACH_TARGET void add_product(const double* column, std::size_t rows, const double* row,
                                    std::size_t columns, double factor, double* out,
                                    std::size_t stride) {
  for (std::size_t r = 0; r < rows; ++r) {
    const double x = factor * column[r];
    double* to = out + r * stride;
    for (std::size_t c = 0; c < columns; ++c) to[c] += x * row[c];
  }
}

void check_range(const PixelRange& range, std::string_view name) {
  if (range.pixels < 1 || range.pixels > std::size_t{1} << 30)
    throw Error(ErrorKind::usage,
                fmt::format("persistence_image: {}: found {} pixels, expected 1 to 2^30", name,
                            range.pixels));
  if (!(range.lo < range.hi) || std::abs(range.lo) > kLargestPixel ||
      std::abs(range.hi) > kLargestPixel)
    throw Error(
        ErrorKind::usage,
        fmt::format("persistence_image: {}: found a range from {} to {}, expected the smaller end "
                    "first, and both ends at most {} in absolute value",
                    name, range.lo, range.hi, kLargestPixel));
}

}  // namespace
}  // namespace vectors

void persistence_image(std::span<const Bar> given, const ImageFrame& frame, double sigma,
                       double power, std::span<double> out, const RunContext& context) {
  vectors::check_range(frame.births, "births");
  vectors::check_range(frame.lengths, "lengths");
  vectors::check_positive(sigma, "sigma", "persistence_image");
  vectors::check_power(power, "persistence_image");
  vectors::check_size(out, frame.births.pixels * frame.lengths.pixels, "persistence_image");
  const std::vector<Bar> bars =
      vectors::checked_bars(given, vectors::Ends::finite, "persistence_image");
  std::ranges::fill(out, 0);
  vectors::Masses births(frame.births, sigma), lengths(frame.lengths, sigma);
  Ticker ticker(context, "persistence image", bars.size());
  for (const Bar& bar : bars) {
    const double weight = std::pow(bar.persistence(), power);
    if (!(weight < kInfinity))
      throw Error(ErrorKind::bad_data,
                  fmt::format("{}: found a bar of length {} and the power {}, expected "
                              "a finite weight",
                              mark_place("persistence_image"), bar.persistence(), power));
    births.go_to(bar.birth);
    lengths.go_to(bar.persistence());
    if (births.count() > 0 && lengths.count() > 0)
      vectors::add_product(lengths.data(), lengths.count(), births.data(), births.count(), weight,
                           out.data() + lengths.first() * frame.births.pixels + births.first(),
                           frame.births.pixels);
    ticker.tick();
  }
}

}  // namespace ph
