// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libph/src/io/bytes/readers.hpp"
#include "ph/detail/io/table.hpp"
#include "ph/io/read.hpp"

namespace ph {
namespace {

constexpr std::int64_t kMostCells = std::int64_t{1} << 40;
constexpr std::int64_t kMostDimension = 1 << 20;

// Checks one facet of a column. The caller reports the fault, because it knows the place.
Fault fault_of_facet(Index facet, std::size_t column, std::optional<Index> before) {
  if (facet < 0 || facet >= static_cast<Index>(column)) {
    return {fmt::format("facet of cell {} out of range", column),
            fmt::format("{}", facet),
            column == 0 ? "no facets" : fmt::format("an earlier cell, 0 to {}", column - 1),
            {}};
  }
  if (before && facet <= *before) {
    return {fmt::format("facets of cell {} not ascending", column),
            fmt::format("{} after {}", facet, *before),
            "each facet once, ascending",
            {}};
  }
  return {};
}

BoundaryInput read_text(const Input& input) {
  BoundaryInput result;
  TextLines lines(input);
  Cells cells(lines);
  while (lines.next()) {
    const std::size_t column = result.matrix.size();
    cells.start();
    result.matrix.dims.push_back(static_cast<int>(cells.integer(0, kMostDimension, "dimension")));
    std::optional<Index> before;
    while (cells.more()) {
      const char* place = cells.place();
      const Index facet = cells.integer(0, kMostCells, "facet");
      const Fault fault = fault_of_facet(facet, column, before);
      if (!fault.what.empty()) lines.fail(place, fault);
      detail::require_growth(input, result.matrix.rows);
      result.matrix.rows.push_back(facet);
      before = facet;
    }
    detail::require_growth(input, result.places);
    result.matrix.offsets.push_back(result.matrix.rows.size());
    result.places.push_back(lines.number());
  }
  return result;
}

BoundaryInput read_binary(const Input& input) {
  BoundaryInput result;
  result.binary = true;
  BinaryCursor cursor(input, std::endian::little);
  const std::size_t columns = cursor.read_count("number of cells", 2 * sizeof(std::int64_t));
  const std::size_t entries = cursor.remaining() / sizeof(std::int64_t) - 2 * columns;
  input.require_memory(columns * (sizeof(int) + 2 * sizeof(std::size_t)) + entries * sizeof(Index));
  result.matrix.dims.reserve(columns);
  result.matrix.offsets.reserve(columns + 1);
  result.matrix.rows.reserve(entries);
  result.places.reserve(columns);
  for (std::size_t column = 0; column < columns; ++column) {
    const std::size_t start = cursor.offset();
    const auto dim = cursor.read<std::int64_t>("dimension of a cell");
    if (dim < 0 || dim > kMostDimension) {
      input.fail_at_byte(start, {fmt::format("dimension of cell {} out of range", column),
                                 fmt::format("{}", dim),
                                 fmt::format("0 to {}", kMostDimension),
                                 {}});
    }
    const std::size_t facets = cursor.read_count("number of facets", sizeof(std::int64_t));
    std::optional<Index> before;
    for (std::size_t k = 0; k < facets; ++k) {
      const std::size_t place = cursor.offset();
      const auto facet = cursor.read<std::int64_t>("facets");
      const Fault fault = fault_of_facet(facet, column, before);
      if (!fault.what.empty()) input.fail_at_byte(place, fault);
      result.matrix.rows.push_back(facet);
      before = facet;
    }
    result.matrix.dims.push_back(static_cast<int>(dim));
    result.matrix.offsets.push_back(result.matrix.rows.size());
    result.places.push_back(start);
  }
  cursor.expect_end();
  return result;
}

}  // namespace

CellNamer BoundaryInput::namer() const {
  return [at = places, in_bytes = binary, file = name](std::size_t i) {
    if (i >= at.size()) return file;
    return in_bytes ? fmt::format("{}: byte {} (cell {})", file, at[i], i)
                    : fmt::format("{}:{}", file, at[i]);
  };
}

BoundaryInput read_phat(const Input& input, const ReadOptions& options) {
  if (detail::is_dipha(input)) return detail::read_dipha_boundary(input, options);
  BoundaryInput result = detail::is_text(input.text()) ? read_text(input) : read_binary(input);
  result.name = input.name();
  if (result.matrix.size() == 0 && !options.allow_empty) {
    input.fail({"no cells",
                {},
                "a boundary matrix",
                mark(Setting::allow_empty) + " accepts an empty complex"});
  }
  return result;
}

BoundaryInput read_phat(const std::filesystem::path& path, const std::filesystem::path& values_path,
                        const ReadOptions& options) {
  BoundaryInput result = read_phat(Input::open(path, options.context), options);
  if (!values_path.empty()) {
    result.matrix.values = read_values(
        Input::open(values_path, options.context, Input::Excess::refused, detail::start_check()),
        result.matrix.size(), options);
  }
  return result;
}

}  // namespace ph
