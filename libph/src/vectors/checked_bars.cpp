// SPDX-License-Identifier: MIT
#include "ph/detail/vectors/checked_bars.hpp"

#include <fmt/format.h>

#include <cmath>

#include "ph/error.hpp"
#include "ph/vectorise.hpp"

namespace ph::vectors {

void check_bar(const Bar& bar, std::string_view function) {
  if (!(bar.birth <= bar.death))
    throw Error(ErrorKind::bad_data,
                fmt::format("{}: found a bar [{}, {}), expected birth <= death",
                            mark_place(function), bar.birth, bar.death));
  for (const double end : {bar.birth, bar.death})
    if (std::isfinite(end) && std::abs(end) > kLargest)
      throw Error(
          ErrorKind::bad_data,
          fmt::format("{}: found {}, expected at most {} in absolute value; choose a larger unit",
                      mark_place(function), end, kLargest));
}

std::vector<Bar> checked_bars(std::span<const Bar> bars, Ends allowed, std::string_view function) {
  std::vector<Bar> checked;
  checked.reserve(bars.size());
  for (const Bar& bar : bars) {
    check_bar(bar, function);
    if (bar.birth == bar.death) continue;  // mutant: vector-length-zero
    const bool is_allowed =
        allowed == Ends::any ||
        (std::isfinite(bar.birth) && (allowed == Ends::any_death || std::isfinite(bar.death)));
    if (!is_allowed)
      throw Error(ErrorKind::bad_data,
                  fmt::format("{}: found a bar [{}, {}), expected {}; {} leaves it out",
                              mark_place(function), bar.birth, bar.death,
                              allowed == Ends::finite ? "finite bars" : "a finite birth",
                              mark(Setting::infinite, "drop")));
    checked.push_back(bar);
  }
  return checked;
}

void check_size(std::span<const double> out, std::size_t expected, std::string_view function) {
  if (out.size() != expected)
    throw Error(ErrorKind::usage, fmt::format("{}: out: found room for {} numbers, expected {}",
                                              mark_place(function), out.size(), expected));
}

void check_power(double power, std::string_view function) {
  if (!(power >= 0 && power < kInfinity))
    throw Error(ErrorKind::usage, fmt::format("{}: power: found {}, expected a finite number >= 0",
                                              mark_place(function), power));
}

void check_positive(double number, std::string_view name, std::string_view function) {
  if (!(number > 0 && number < kInfinity))
    throw Error(ErrorKind::usage, fmt::format("{}: {}: found {}, expected a finite number > 0",
                                              mark_place(function), name, number));
}

}  // namespace ph::vectors

namespace ph {

FiniteBars finite_bars(std::span<const Bar> bars, const InfiniteBars& rule) {
  using Rule = InfiniteBars::Rule;
  if (rule.rule == Rule::cap && !(std::abs(rule.cap) <= vectors::kLargest))
    throw Error(ErrorKind::usage,
                fmt::format("{}: cap: found {}, expected a number of at most {} in absolute value",
                            mark_place("finite_bars"), rule.cap, vectors::kLargest));
  FiniteBars finite;
  finite.bars.reserve(bars.size());
  for (Bar bar : bars) {
    vectors::check_bar(bar, "finite_bars");
    const bool has_birth = std::isfinite(bar.birth);
    if (!has_birth || !std::isfinite(bar.death)) {
      if (rule.rule == Rule::drop) {
        ++finite.dropped;
        continue;
      }
      if (rule.rule == Rule::refuse || !has_birth)
        throw Error(
            ErrorKind::bad_data,
            fmt::format("{}: found a bar [{}, {}), expected finite bars{}",
                        mark_place("finite_bars"), bar.birth, bar.death,
                        rule.rule == Rule::cap ? "; a cap replaces only infinite deaths" : ""));
      if (bar.birth > rule.cap)
        throw Error(ErrorKind::usage,
                    fmt::format("{}: cap: found {}, expected at least {}, the birth of a bar that "
                                "never dies",
                                mark_place("finite_bars"), rule.cap, bar.birth));
      bar.death = rule.cap;  // mutant: vector-capped
    }
    finite.bars.push_back(bar);
  }
  return finite;
}

}  // namespace ph
