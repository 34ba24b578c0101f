// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libph/src/plot/plot_canvas.hpp"
#include "ph/error.hpp"
#include "ph/io/write.hpp"

namespace ph::plot {
namespace {

/// The floor of the decimal logarithm of a positive number.
int magnitude(double value) { return static_cast<int>(std::floor(std::log10(value))); }

double in_units(double value, int exponent) {
  // Divides in two steps, because a power of ten beyond 10^±308 is not a double, but its root is.
  const int half = exponent / 2;
  return value / std::pow(10.0, half) / std::pow(10.0, exponent - half);
}

std::string superscript(int number) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number))) text += kDigits[digit - '0'];
  return text;
}

/// Rounds up to 1, 2 or 5 times a power of ten. A number that is at most 1 % above one of these
/// values is rounded down to that value.
double round_step(double rough) {
  const double power = std::pow(10.0, magnitude(rough));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough * 0.99) step = factor * power;
  return step;
}

/// True if numbers of this magnitude are written without a power of ten.
bool has_plain_labels(int power) { return power >= -3 && power <= 4; }

}  // namespace

Axis::Axis(const Range& range, const PlotOptions& options, double from, double to)
    : from_(from), to_(to), logarithmic_(options.axis.logarithmic), negated_(options.negated) {
  const PlotAxis limits = limits_of(options);
  const double low = limits.low.value_or(range.low), high = limits.high.value_or(range.high);
  // The values that the axis shows.
  const double lowest = negated_ ? -high : low, highest = negated_ ? -low : high;
  const bool is_given = limits.low || limits.high;
  if (is_given && !(std::isfinite(low) && std::isfinite(high)))
    throw Error(ErrorKind::usage, fmt::format("axis: found {} to {}, expected finite ends",
                                              shortest(lowest), shortest(highest)));
  if (is_given && !(low < high))
    throw Error(ErrorKind::usage, fmt::format("axis: found {} to {}, expected a lower number first",
                                              shortest(lowest), shortest(highest)));
  if (logarithmic_) {
    if (!(lowest > 0))
      throw Error(
          ErrorKind::usage,
          fmt::format("logarithmic axis: found {}, expected values above 0", shortest(lowest)));
    low_ = in_scale(low);
    high_ = in_scale(high);
    if (!(high_ - low_ > 1e-12)) high_ = low_ + 1;
    return;
  }
  const double largest = std::max(std::abs(low), std::abs(high));
  if (largest > 0) {
    const int power = magnitude(largest);
    shows_unit_ = !has_plain_labels(power);
    if (shows_unit_) exponent_ = power;
  }
  low_ = in_units(low, exponent_);
  high_ = in_units(high, exponent_);
  // The ends may be equal, or so close that few doubles are between them. The right end is then
  // moved to the right, so that a class that begins at the left end has room for its bar.
  const double least = 1e-12 * std::max({std::abs(low_), std::abs(high_), 1e-300});
  // mutant: plot-one-class
  if (!(high_ - low_ > least)) high_ += low_ == 0 ? 1 : 0.5 * std::abs(low_);
}

double Axis::in_scale(double value) const {
  if (!logarithmic_) return in_units(value, exponent_);
  if (negated_) return value < 0 ? -std::log10(-value) : kInfinity;
  return value > 0 ? std::log10(value) : -kInfinity;
}

double Axis::at(double value) const {
  const double part = (in_scale(value) - low_) / (high_ - low_);
  return from_ + std::clamp(part, 0.0, 1.0) * (to_ - from_);
}

std::string Axis::label_of(double value, int decimals) const {
  if (negated_ && !logarithmic_) value = -value;  // mutant: plot-negated
  std::string label = fmt::format("{:.{}f}", value == 0 ? 0.0 : value, decimals);
  if (label.front() == '-') label.replace(0, 1, "−");
  return label;
}

/// Ticks at 1, 2 and 5 times the powers of ten, or only at powers of ten if there is little room.
std::vector<Axis::Tick> Axis::powers_of_ten(int count) const {
  std::vector<Tick> ticks;
  const auto add = [&](double factor, int power) {
    const double place = (negated_ ? -1 : 1) * (std::log10(factor) + power);
    constexpr double slack = 1e-9;
    if (place < low_ - slack || place > high_ + slack) return;
    const double part = std::clamp((place - low_) / (high_ - low_), 0.0, 1.0);
    const std::string label =
        has_plain_labels(power)
            ? label_of(factor * std::pow(10.0, power), std::max(0, -power))
            : fmt::format("{}10{}", factor == 1 ? "" : fmt::format("{}·", factor),
                          superscript(power));
    ticks.push_back({from_ + part * (to_ - from_), label});
  };
  const double least = negated_ ? -high_ : low_, most = negated_ ? -low_ : high_;
  const auto first = static_cast<int>(std::floor(least)), last = static_cast<int>(std::ceil(most));
  const int step = std::max(1, (last - first) / std::max(1, count));
  for (int power = first; power <= last; power += step)
    for (const double factor : {1.0, 2.0, 5.0})
      if (factor == 1 || (last - first) * 3 <= 2 * count) add(factor, power);
  return ticks;
}

/// Ticks at round values, for an axis that does not contain two powers of ten.
std::vector<Axis::Tick> Axis::round_values(int count) const {
  // The unit is chosen so that neither the ends nor a step leave the range of double.
  const auto unit = static_cast<int>(std::floor(negated_ ? -low_ : high_));
  const double least = std::pow(10.0, (negated_ ? -high_ : low_) - unit),
               most = std::pow(10.0, (negated_ ? -low_ : high_) - unit);
  const double step = round_step((most - least) / count);
  const int power = unit + magnitude(most), digits = unit + magnitude(step * 1.0001);
  constexpr double slack = 1e-6;
  const double last = std::floor(most / step + slack);
  std::vector<Tick> ticks;
  for (double i = std::ceil(least / step - slack); i <= last && std::ssize(ticks) < 4 * count;
       ++i) {
    const double value = i * step, place = (negated_ ? -1 : 1) * (std::log10(value) + unit);
    const double part = std::clamp((place - low_) / (high_ - low_), 0.0, 1.0);
    const std::string label =
        has_plain_labels(power)
            ? label_of(value * std::pow(10.0, unit), std::max(0, -digits))
            : fmt::format("{}·10{}", label_of(value / std::pow(10.0, power - unit), power - digits),
                          superscript(power));
    ticks.push_back({from_ + part * (to_ - from_), label});
  }
  return ticks;
}

std::vector<Axis::Tick> Axis::ticks(int count) const {
  if (logarithmic_) {
    std::vector<Tick> powers = powers_of_ten(count);
    return powers.size() > 1 ? powers : round_values(count);
  }
  const double step = round_step((high_ - low_) / count);
  const int decimals = std::max(0, -magnitude(step * 1.0001));
  std::vector<Tick> ticks;
  const double slack = 1e-6;
  const double first = std::ceil(low_ / step - slack);
  const double last = std::floor(high_ / step + slack);
  for (int i = 0; first + i <= last && i < 4 * count; ++i) {
    const double value = (first + i) * step;
    const double part = std::clamp((value - low_) / (high_ - low_), 0.0, 1.0);
    ticks.push_back({from_ + part * (to_ - from_), label_of(value, decimals)});
  }
  return ticks;
}

std::string Axis::unit() const { return shows_unit_ ? "×10" + superscript(exponent_) : ""; }

void Axis::draw_below(Canvas& canvas, double top, double bottom, const std::string& name) const {
  std::vector<Tick> shown = ticks(6);
  // Long labels need room, because a digit of 7 points is about 4 points wide.
  for (int count = 5; count >= 2; --count) {
    double needed = 0;
    for (const Tick& tick : shown)
      needed += 4.0 * static_cast<double>(characters_of(tick.label).size()) + 8;
    if (needed <= std::abs(to_ - from_) + 8) break;
    shown = ticks(count);
  }
  for (const Tick& tick : shown) {
    canvas.line(tick.position, top, tick.position, bottom, kGrid, 0.5);
    canvas.line(tick.position, bottom, tick.position, bottom + 2.5, kInk, 0.6);
    // The last label must not leave the picture.
    const double half = 2.0 * static_cast<double>(tick.label.size()) + 1;
    canvas.text(std::min(tick.position, kWidth - half), bottom + 9.5, tick.label, Anchor::middle);
  }
  canvas.line(std::min(from_, to_), bottom, std::max(from_, to_), bottom, kInk, 0.6);
  const std::string with_unit = unit().empty() ? name : name + " (" + unit() + ")";
  canvas.text((from_ + to_) / 2, bottom + 20, with_unit, Anchor::middle, 7.5);
}

PlotAxis limits_of(const PlotOptions& options) {
  PlotAxis limits = options.axis;
  if (!options.negated) return limits;  // mutant: plot-limits
  std::swap(limits.low, limits.high);
  for (std::optional<double>* limit : {&limits.low, &limits.high})
    if (*limit) *limit = -**limit;
  return limits;
}

namespace {

/// Collects the finite values that have a place on the axis.
class Values {
 public:
  explicit Values(const PlotOptions& options) : options_(options) {}

  void add(double value) {
    const double own = options_.negated ? -value : value;
    if (!std::isfinite(value) || (options_.axis.logarithmic && own <= 0)) return;
    range_.low = std::min(range_.low, value);
    range_.high = std::max(range_.high, value);
  }

  Range range() const {
    if (range_.low <= range_.high) return range_;
    if (!options_.axis.logarithmic) return {};
    return options_.negated ? Range{-10, -1} : Range{1, 10};
  }

 private:
  const PlotOptions& options_;
  Range range_{kInfinity, -kInfinity};
};

}  // namespace

Range finite_range(const Barcode& barcode, const PlotOptions& options) {
  Values values(options);
  for (const Bar& bar : barcode)
    for (const double value : {bar.birth, bar.death}) values.add(value);
  return values.range();
}

Range finite_range(std::span<const Branch> tree, const std::vector<std::size_t>& classes,
                   const PlotOptions& options) {
  Values values(options);
  for (const std::size_t i : classes)
    for (const double value : {tree[i].birth, tree[i].death}) values.add(value);
  return values.range();
}

std::vector<int> dims_of(const Barcode& barcode) {
  std::vector<int> dims;
  for (const Bar& bar : barcode)
    if (dims.empty() || dims.back() != bar.dim) dims.push_back(bar.dim);
  return dims;
}

std::string description_of(const Barcode& barcode) {
  std::string text;
  for (const int dim : dims_of(barcode)) {
    if (!text.empty()) text += ", ";
    text += grouped(barcode.bars(dim).size()) + (text.empty() ? " bars in " : " in ") +
            with_subscript("H", dim);
  }
  return text.empty() ? "no bars" : text;
}

}  // namespace ph::plot
