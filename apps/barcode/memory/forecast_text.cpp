// SPDX-License-Identifier: MIT
#include "apps/barcode/memory/forecast_text.hpp"

#include <fmt/format.h>

#include <string_view>

#include "ph/detail/core/format_size.hpp"

namespace ph::barcode {

namespace {

/// @param beside words for the memory that is needed in addition to the forecast.
template <class Forecast>
std::string lines_of(const Forecast& forecast, std::string_view process, std::string_view beside) {
  std::string text;
  const auto add = [&](std::string_view what, double low, double high, std::string_view of) {
    text += fmt::format("{:8} {} to {} ({})\n", what, format_size(low), format_size(high), of);
  };
  if (!process.empty()) {
    // The first rank also stores the bars of all other ranks.
    add("memory", forecast.memory.low, forecast.memory.high + forecast.join.high / 2,
        fmt::format("the {} that takes most{}", process, beside));
    add("sent", forecast.sent.low, forecast.sent.high, fmt::format("by all {}s together", process));
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
                          int parts, std::string_view process) {
  return fmt::format("input    {}\nparts    {}, the longest takes {:.1f} times the mean{}\n",
                     description, parts, forecast.longest,
                     !process.empty() && is_unequal(forecast)
                         ? fmt::format(": {}s share layers by what is in them", process)
                         : "") +
         lines_of(forecast, process, "");
}

std::string forecast_text(const CloudPartForecast& forecast, const std::string& description,
                          int parts, std::string_view process) {
  return fmt::format("input    {}\nparts    {}\n", description, parts) +
         lines_of(forecast, process, ", beside the points");
}

}  // namespace ph::barcode
