// SPDX-License-Identifier: MIT
#include "apps/common/values/numbers.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "ph/detail/core/floating.hpp"
#include "ph/detail/core/lower_case.hpp"
#include "ph/error.hpp"

namespace ph::app {
namespace {

[[noreturn]] void reject(std::string_view option, std::string_view text, std::string_view expected,
                         std::string_view hint = {}) {
  throw Error(ErrorKind::usage, fmt::format("{}: found '{}', expected {}{}{}", option, text,
                                            expected, hint.empty() ? "" : "; ", hint));
}

/// The number at the start of a text, and the rest of the text. An optional '+' is accepted.
struct Read {
  double value = 0;
  std::string_view rest;
  bool ok = false;
};
Read read_number(std::string_view text) {
  Read read;
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, error] = floating_from_chars(text.data(), text.data() + text.size(), read.value);
  read.ok = error == std::errc{};
  read.rest = text.substr(static_cast<std::size_t>(end - text.data()));
  return read;
}

constexpr std::string_view kNumber = "a number";

/// Calls `use(part)` for each part between the commas of a list.
template <class Use>
void for_each_part(std::string_view list, Use&& use) {
  for (;;) {
    const std::size_t comma = list.find(',');
    use(list.substr(0, comma));
    if (comma == list.npos) return;
    list.remove_prefix(comma + 1);
  }
}

}  // namespace

double parse_number(std::string_view option, std::string_view text) {
  const Read read = read_number(text);
  if (!read.ok || !read.rest.empty())
    reject(option, text, kNumber,
           text.find(',') != text.npos ? "decimals are separated by a point" : "");
  if (std::isnan(read.value)) reject(option, text, kNumber);
  return read.value == 0 ? 0.0 : read.value;
}

std::vector<double> parse_numbers(std::string_view option, std::string_view text, std::size_t count,
                                  std::string_view hint) {
  std::vector<double> numbers;
  for_each_part(text, [&](std::string_view part) {
    const Read read = read_number(part);
    if (!read.ok || !read.rest.empty() || std::isnan(read.value))
      reject(option, text, "numbers separated by commas", hint);
    numbers.push_back(read.value == 0 ? 0.0 : read.value);
  });
  if (count != 0 && numbers.size() != count)
    reject(option, text, fmt::format("{} numbers separated by commas", count));
  return numbers;
}

std::vector<std::int64_t> parse_integers(std::string_view option, std::string_view text,
                                         std::int64_t least, std::int64_t most) {
  std::vector<std::int64_t> numbers;
  for_each_part(text, [&](std::string_view part) {
    numbers.push_back(parse_integer(option, part, least, most));
  });
  return numbers;
}

std::int64_t parse_integer(std::string_view option, std::string_view text, std::int64_t least,
                           std::int64_t most) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  if (!whole || value < least || value > most)
    reject(option, text,
           most == INT64_MAX ? fmt::format("a whole number, at least {}", least)
                             : fmt::format("a whole number from {} to {}", least, most));
  return value;
}

std::uint64_t parse_size(std::string_view option, std::string_view text) {
  struct Unit {
    std::string_view name;
    double bytes;
  };
  constexpr double kKibi = 1024;
  static constexpr Unit kUnits[] = {
      {"", 1},
      {"b", 1},
      {"k", 1e3},
      {"kb", 1e3},
      {"m", 1e6},
      {"mb", 1e6},
      {"g", 1e9},
      {"gb", 1e9},
      {"t", 1e12},
      {"tb", 1e12},
      {"ki", kKibi},
      {"kib", kKibi},
      {"mi", kKibi * kKibi},
      {"mib", kKibi * kKibi},
      {"gi", kKibi * kKibi * kKibi},
      {"gib", kKibi * kKibi * kKibi},
      {"ti", kKibi * kKibi * kKibi * kKibi},
      {"tib", kKibi * kKibi * kKibi * kKibi},
  };
  const Read read = read_number(text);
  std::string unit = lower_case(read.rest);
  if (unit.starts_with(' ')) unit.erase(0, 1);
  for (const Unit& known : kUnits) {
    if (!read.ok || unit != known.name) continue;
    const double bytes = read.value * known.bytes;
    if (!(bytes >= 1) || !(bytes < 0x1p63)) break;
    return static_cast<std::uint64_t>(bytes);
  }
  reject(option, text, "a size such as 4GiB, 500MB or 1e9");
}

std::string count_of(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace ph::app
