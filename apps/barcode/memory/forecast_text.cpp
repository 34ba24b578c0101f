// SPDX-License-Identifier: MIT
#include "barcode/memory/forecast_text.hpp"

#include <fmt/format.h>

#include <string_view>

#include "common/arguments/numbers.hpp"

namespace ph::barcode {

std::string forecast_text(const ImagePartForecast& forecast, const std::string& description,
                          int parts, bool on_ranks) {
  std::string text = fmt::format(
      "input    {}\nparts    {}, the longest takes {:.1f} times the mean{}\n", description, parts,
      forecast.longest,
      on_ranks && is_unequal(forecast) ? ": ranks share layers by what is in them" : "");
  const auto add = [&](std::string_view what, const ImagePartForecast::Bytes& bytes,
                       std::string_view of) {
    text += fmt::format("{:8} {} to {} ({})\n", what, app::format_size(bytes.low),
                        app::format_size(bytes.high), of);
  };
  ImagePartForecast::Bytes memory = forecast.memory;
  if (on_ranks) memory.high += forecast.join.high / 2;  // the first rank has the bars of all
  add("memory", memory, on_ranks ? "the rank that takes most" : "the part that takes most");
  if (on_ranks) {
    add("sent", forecast.sent, "by all ranks together");
  } else {
    add("file", forecast.file, "the largest");
    add("join", forecast.join, "memory of --join of all");
  }
  return text;
}

}  // namespace ph::barcode
