// SPDX-License-Identifier: MIT
#include "barcode/memory/forecast_text.hpp"

#include <fmt/format.h>

#include <string_view>

#include "common/arguments/numbers.hpp"

namespace ph::barcode {

namespace {

/// @param beside what is not counted.
template <class Forecast>
std::string lines_of(const Forecast& forecast, bool on_ranks, std::string_view beside) {
  std::string text;
  const auto add = [&](std::string_view what, double low, double high, std::string_view of) {
    text += fmt::format("{:8} {} to {} ({})\n", what, app::format_size(low), app::format_size(high),
                        of);
  };
  if (on_ranks) {
    // The first rank has the bars of all.
    add("memory", forecast.memory.low, forecast.memory.high + forecast.join.high / 2,
        fmt::format("the rank that takes most{}", beside));
    add("sent", forecast.sent.low, forecast.sent.high, "by all ranks together");
  } else {
    add("memory", forecast.memory.low, forecast.memory.high,
        fmt::format("the part that takes most{}", beside));
    add("file", forecast.file.low, forecast.file.high, "the largest");
    add("join", forecast.join.low, forecast.join.high, "memory of --join of all");
  }
  return text;
}

}  // namespace

std::string forecast_text(const ImagePartForecast& forecast, const std::string& description,
                          int parts, bool on_ranks) {
  return fmt::format(
             "input    {}\nparts    {}, the longest takes {:.1f} times the mean{}\n", description,
             parts, forecast.longest,
             on_ranks && is_unequal(forecast) ? ": ranks share layers by what is in them" : "") +
         lines_of(forecast, on_ranks, "");
}

std::string forecast_text(const CloudPartForecast& forecast, const std::string& description,
                          int parts, bool on_ranks) {
  return fmt::format("input    {}\nparts    {}\n", description, parts) +
         lines_of(forecast, on_ranks, ", beside the points");
}

}  // namespace ph::barcode
