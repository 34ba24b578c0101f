// SPDX-License-Identifier: MIT
#include "libph/src/io/matrices/matrix_entry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/barcode.hpp"
#include "ph/detail/io/table.hpp"

namespace ph::detail {
namespace {

std::string read_correlations() {
  return mark(Setting::from_correlation) + " reads a correlation matrix";
}

}  // namespace

void MatrixEntries::look_at(double distance) {
  if (distance > largest_ && std::isfinite(distance)) largest_ = distance;
}

void MatrixEntries::doubt(Kind kind, const Doubt& doubt) {
  if (doubt.size > worst_[kind].size) worst_[kind] = doubt;
}

double MatrixEntries::rounding() const {
  // For a correlation r, the bound is for the rounding of r, not of 1 - r.
  // mutant: matrix-rounding
  return kRounding * (options_.from_correlation ? 1 : largest_);
}

Fault MatrixEntries::fault_of(double raw, bool on_diagonal) const {
  if (std::isnan(raw)) {
    if (options_.nan == NanPolicy::error)
      return {"not a distance", "NaN", "0 or more",
              mark(Setting::nan, "drop") + " never joins such a pair"};
  } else if (options_.from_correlation) {
    if (on_diagonal && !(std::abs(raw - 1) <= kRounding))
      return {"diagonal of a correlation matrix", fmt::format("{}", raw), "1", {}};
    if (std::abs(raw) > 1 + kRounding)
      return {"not a correlation", fmt::format("{}", raw), "-1 to 1", {}};
  } else if (on_diagonal && options_.diagonal == Diagonal::births) {
    if (!(raw >= 0 && raw < kInfinity))
      return {"not a birth", fmt::format("{} on the diagonal", raw), "a finite number >= 0", {}};
  }
  return {};
}

double MatrixEntries::distance_of(double raw, const EntryPlace& place) {
  const bool on_diagonal = place.row == place.column;
  if (std::isnan(raw)) return on_diagonal ? 0 : kInfinity;
  if (options_.from_correlation) return 1 - std::clamp(raw, -1.0, 1.0);
  if (on_diagonal && options_.diagonal == Diagonal::births) return raw;
  doubt(on_diagonal ? kDiagonal : kNegative, {std::abs(raw), raw, 0, place});
  return 0;
}

double MatrixEntries::merged(double upper, double lower, const EntryPlace& place) {
  switch (options_.symmetrise) {
    case Symmetrise::max:
      return std::max(upper, lower);
    case Symmetrise::min:
      return std::min(upper, lower);
    case Symmetrise::lower:
      return lower;
    case Symmetrise::none:
      break;
  }
  if (upper != lower) doubt(kAsymmetric, {std::abs(upper - lower), lower, upper, place});
  return lower;
}

Fault MatrixEntries::fault_of(Kind kind, const Doubt& doubt) const {
  const auto [i, j, byte] = doubt.place;
  const std::string slack =
      rounding() > 0 ? fmt::format(", or a rounding error of at most {:.2g}", rounding()) : "";
  if (kind == kNegative)
    return {"negative distance", fmt::format("{}", doubt.value), "0 or more",
            doubt.value >= -1 ? read_correlations() : ""};
  if (kind == kAsymmetric)
    return {"asymmetric matrix",
            fmt::format("d({},{}) = {} but d({},{}) = {}", i, j, doubt.value, j, i, doubt.other),
            "both equal", mark(Setting::symmetrise, "max|min|lower") + " accepts it"};
  const std::string zero = mark(Setting::diagonal, "zero");
  const bool is_one = std::abs(doubt.value - 1) <= kRounding;
  return {"non-zero diagonal", fmt::format("{}", doubt.value), "0" + slack,
          is_one            ? read_correlations()
          : doubt.value > 0 ? fmt::format("{} takes it as 0, {} as the births of the points", zero,
                                          mark(Setting::diagonal, "births"))
                            : zero + " takes it as 0"};
}

void MatrixEntries::finish(const std::function<void(const EntryPlace&, const Fault&)>& fail) const {
  const auto is_accepted = [&](Kind kind) {
    return worst_[kind].size <= rounding() ||
           (kind == kDiagonal && options_.diagonal == Diagonal::any);
  };
  for (const Kind kind : {kNegative, kAsymmetric, kDiagonal})  // mutant: matrix-negative
    if (!is_accepted(kind)) fail(worst_[kind].place, fault_of(kind, worst_[kind]));
  const auto tell = [&](Kind kind, std::string_view what) {
    if (worst_[kind].size > 0)
      note(options_, fmt::format("{} for rounding errors of at most {:.2g}, which are taken as 0",
                                 what, worst_[kind].size));
  };
  tell(kNegative, "distances are 0 or more except");
  const Doubt& diagonal = worst_[kDiagonal];
  if (diagonal.size > rounding())
    note(options_, fmt::format("{}: the diagonal has entries up to {:.2g}, taken as 0",
                               mark(Setting::diagonal, "zero"), diagonal.size));
  else
    tell(kDiagonal, "the diagonal is 0 except");
}

void fail_in_text(const Input& input, std::size_t byte, const Fault& fault) {
  const std::string_view before = input.text().substr(0, byte);
  const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
  const auto line = static_cast<std::size_t>(std::ranges::count(before, '\n')) + 1;
  input.fail_at(line, byte - start + 1, fault);
}

}  // namespace ph::detail
