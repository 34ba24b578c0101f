// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/read.hpp"

namespace ph {

CellNamer SimplicesInput::namer() const {
  return [lines_of = lines, file = name](std::size_t i) {
    return i < lines_of.size() ? fmt::format("{}:{}", file, lines_of[i]) : file;
  };
}

SimplicesInput read_simplices(const Input& input, const ReadOptions& options) {
  constexpr std::int64_t kMostVertices = std::int64_t{1} << 62;
  SimplicesInput result;
  result.name = input.name();
  TextLines lines(input);
  std::vector<Index> vertices;
  while (lines.next()) {
    const std::string_view line = lines.line();
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) {
      lines.fail(line.data() + line.size(), {"no value", "the end of the line", "': value'",
                                             "a simplex is a line v0 v1 … : value"});
    }
    Cells cells(lines);
    vertices.clear();
    for (cells.start_in(line.substr(0, colon)); cells.more();) {
      vertices.push_back(cells.integer(0, kMostVertices, "vertex"));
    }
    if (vertices.empty()) lines.fail(line.data(), {"no vertices", "':'", "v0 v1 … : value", {}});
    Cells value_cells(lines);
    value_cells.start_in(line.substr(colon + 1));
    if (!value_cells.more()) {
      lines.fail(line.data() + line.size(), {"no value", "the end of the line", "a number", {}});
    }
    const double value = value_cells.number(Allow::infinite);
    value_cells.expect_end("one value");
    detail::require_growth(input, result.lines);
    detail::require_growth(input, result.simplices.vertices);
    result.simplices.add(vertices, value);
    result.lines.push_back(lines.number());
  }
  if (result.lines.empty() && !options.allow_empty) {
    input.fail({"no simplices",
                {},
                "lines v0 v1 … : value",
                mark(Setting::allow_empty) + " accepts an empty complex"});
  }
  return result;
}

SimplicesInput read_simplices(const std::filesystem::path& path, const ReadOptions& options) {
  return read_simplices(Input::open(path, options.context, Input::Excess::refused,
                                    detail::start_check(Format::simplices)),
                        options);
}

}  // namespace ph
