// SPDX-License-Identifier: MIT
#include "apps/common/inputs/set_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "apps/common/arguments/options.hpp"
#include "apps/common/values/choices.hpp"
#include "apps/common/values/numbers.hpp"
#include "ph/error.hpp"

namespace ph::app {
namespace {

void take_columns(ReadOptions& to, const std::string& text) {
  to.columns.clear();
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    std::string_view word = rest.substr(0, comma);
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    if (word.empty())
      throw Error(ErrorKind::usage,
                  fmt::format("--columns: found '{}', expected names or numbers such as x,y or 2-3",
                              printable(text, 80)));
    to.columns.emplace_back(word);
    if (comma == std::string_view::npos) return;
    rest.remove_prefix(comma + 1);
  }
}

void take_metric(RipsOptions& to, const std::string& text) {
  constexpr std::string_view kMinkowski = "minkowski:";
  if (text.starts_with(kMinkowski)) {
    to.distance = PointDistance::minkowski;
    to.minkowski_p = parse_number("--metric minkowski:P", text.substr(kMinkowski.size()));
    if (to.minkowski_p < 1)
      throw Error(ErrorKind::usage, fmt::format("--metric: found '{}', expected P >= 1", text));
  } else if (text == "minkowski") {
    throw Error(ErrorKind::usage,
                "--metric: found 'minkowski', expected minkowski:P with its exponent P");
  } else {
    std::vector<std::string_view> names(all_names<PointDistance>.begin(),
                                        all_names<PointDistance>.end());
    std::ranges::replace(names, "minkowski", "minkowski:P");
    to.distance = names_of<PointDistance>[choose("--metric", text, names)].value;
  }
}

}  // namespace

void add_matrix_options(Options& options, const Scope& matrices, const Scope& distances,
                        ReadOptions& to) {
  options.choice<Symmetrise>(
      {"--symmetrise", matrices},
      "take an asymmetric distance matrix, by the larger, the smaller or the lower entry",
      [&to](Symmetrise way) {
        to.symmetrise = way;
        to.array = ArrayMeaning::distances;
      },
      std::span(names_of<Symmetrise>).subspan(1));
  options.flag({"--from-correlation", distances},
               "the matrix holds correlations r; distances are 1 - r", [&to] {
                 to.from_correlation = true;
                 to.array = ArrayMeaning::distances;
               });
  options.choice(
      {"--diagonal", matrices}, {"zero", "births"},
      "what the diagonal of a distance matrix has: 0, whatever stands there, or when each "
      "point enters (default: 0, else an error)",
      [&to](std::size_t i) {
        to.diagonal = i == 0 ? Diagonal::any : Diagonal::births;
        to.array = ArrayMeaning::distances;
      });
}

void add_columns_option(Options& options, const Scope& scope, ReadOptions& to) {
  options.value(
      {"--columns", scope}, "LIST",
      "columns of a table that are read, by the names in its header or by numbers from 1: "
      "x,y or 2-4 or 1,3 (default: all but an index)",
      [&to](const std::string& text) { take_columns(to, text); });
}

void add_metric_option(Options& options, const Scope& scope, RipsOptions& to) {
  options.value({"--metric", scope}, "euclidean|manhattan|chebyshev|cosine|minkowski:P|hamming",
                "distance of points (default euclidean)",
                [&to](const std::string& text) { take_metric(to, text); });
}

RawLayout& raw_layout(ReadOptions& options) {
  if (!options.raw) options.raw.emplace().type.clear();
  return *options.raw;
}

void add_raw_options(Options& options, const Scope& points, const Scope& numbers,
                     std::string_view usual_type, ReadOptions& to) {
  options.value({"--raw-points", points}, "D",
                "numbers per point, in a file of points without a header; --columns chooses some "
                "of these numbers",
                [&to](const std::string& text) {
                  constexpr Index most = Index{1} << 20;
                  raw_layout(to).coordinates = parse_integer("--raw-points", text, 1, most);
                });
  options.choice({"--raw-type", numbers},
                 {"uint8", "int8", "uint16", "int16", "uint32", "int32", "uint64", "int64",
                  "float16", "float32", "float64"},
                 fmt::format("type of the numbers (default {})", usual_type), [&to](std::size_t i) {
                   constexpr std::array kTypes{"u1", "i1", "u2", "i2", "u4", "i4",
                                               "u8", "i8", "f2", "f4", "f8"};
                   raw_layout(to).type = kTypes[i];
                 });
  options.flag({"--raw-big-endian", numbers}, "the high byte comes first (default: last)",
               [&to] { raw_layout(to).big_endian = true; });
  options.value({"--raw-skip", numbers}, "BYTES", "bytes before the first number (default 0)",
                [&to](const std::string& text) {
                  raw_layout(to).skip =
                      static_cast<std::size_t>(parse_integer("--raw-skip", text, 0));
                });
}

void settle_raw(RawLayout& layout) {
  if (layout.type.empty()) layout.type = layout.coordinates != 0 ? "f4" : "u1";
  if (layout.big_endian && layout.type.ends_with('1'))
    throw Error(
        ErrorKind::usage,
        "--raw-big-endian: found numbers of one byte, expected a --raw-type of several bytes");
}

}  // namespace ph::app
