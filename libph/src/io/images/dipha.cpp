// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "libph/src/io/bytes/readers.hpp"
#include "libph/src/io/matrices/matrix_entry.hpp"
#include "libph/src/io/tables/array.hpp"
#include "ph/barcode.hpp"
#include "ph/io/read.hpp"

// All numbers of a DIPHA file have eight bytes. They are int64 or float64, little endian.

namespace ph::detail {
namespace {

constexpr std::size_t kWord = 8;
constexpr std::size_t kHeader = 2 * kWord;  // the magic number and the type
constexpr std::int64_t kMostDimension = 1 << 20;
constexpr std::int64_t kMostPoints = std::int64_t{1} << 31;

const char* name_of(DiphaType type) {
  switch (type) {
    case DiphaType::boundary_matrix:
      return "a weighted boundary matrix";
    case DiphaType::image:
      return "an image";
    case DiphaType::diagram:
      return "a persistence diagram";
    case DiphaType::distance_matrix:
      return "a distance matrix";
    case DiphaType::sparse_distance_matrix:
      return "a sparse distance matrix";
  }
  return "";
}

// Returns a cursor after the header of a file. The type of the file must be `expected`.
BinaryCursor body_of(const Input& input, DiphaType expected) {
  const DiphaType type = dipha_type(input);
  if (type != expected) {
    input.fail_at_byte(kWord, {"another type of DIPHA file", name_of(type), name_of(expected), {}});
  }
  return BinaryCursor(input, std::endian::little, kHeader);
}

// Reads an integer from `least` to `most`. The error message names the place of the integer.
std::int64_t read_int(BinaryCursor& cursor, std::int64_t least, std::int64_t most,
                      const char* what) {
  const std::size_t at = cursor.offset();
  const auto value = cursor.read<std::int64_t>(what);
  if (value < least || value > most) {
    cursor.input().fail_at_byte(at, {fmt::format("{} out of range", what),
                                     fmt::format("{}", value),
                                     fmt::format("{} to {}", least, most),
                                     {}});
  }
  return value;
}

std::size_t to_size(std::int64_t value) { return static_cast<std::size_t>(value); }

// Reads the number of points. The file must have at least eight bytes per point. A file without
// points is an error unless options.allow_empty is set.
std::size_t read_points_count(BinaryCursor& cursor, const ReadOptions& options) {
  const std::size_t count = cursor.read_count("number of points", kWord);
  if (count == 0 && !options.allow_empty) {
    cursor.input().fail_at_byte(kHeader, {"no points", "0", "at least one",
                                          mark(Setting::allow_empty) + " accepts an empty set"});
  }
  return count;
}

// Reads the facets of all cells. The offsets of the cells come first, then the total number of
// facets, then the facets.
void read_facets(BinaryCursor& cursor, std::size_t cells, BoundaryMatrix& matrix) {
  const Input& input = cursor.input();
  const std::size_t offsets_at = cursor.offset();
  cursor.take(cells * kWord, "offsets of the facets");
  const std::size_t entries = cursor.read_count("number of facets", kWord);
  const std::size_t entries_at = cursor.offset();
  input.require_memory(cells * sizeof(std::size_t) + entries * sizeof(Index));
  matrix.offsets.clear();
  matrix.offsets.reserve(cells + 1);
  matrix.rows.reserve(entries);
  BinaryCursor offsets(input, std::endian::little, offsets_at);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const Index least = cell == 0 ? 0 : static_cast<Index>(matrix.offsets.back());
    const Index most = cell == 0 ? 0 : static_cast<Index>(entries);
    matrix.offsets.push_back(to_size(read_int(offsets, least, most, "offset of a cell's facets")));
  }
  if (cells == 0 && entries > 0) {
    input.fail_at_byte(entries_at - kWord,
                       {"facets without cells", fmt::format("{}", entries), "0", {}});
  }
  matrix.offsets.push_back(entries);
  for (std::size_t k = 0; k < entries; ++k) {
    matrix.rows.push_back(read_int(cursor, 0, static_cast<Index>(cells) - 1, "facet"));
  }
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto first = matrix.rows.begin() + static_cast<std::ptrdiff_t>(matrix.offsets[cell]);
    const auto last = matrix.rows.begin() + static_cast<std::ptrdiff_t>(matrix.offsets[cell + 1]);
    std::sort(first, last);  // the format does not guarantee that facets are sorted
    if (const auto twice = std::adjacent_find(first, last); twice != last) {
      input.fail_at_byte(entries_at + matrix.offsets[cell] * kWord,
                         {fmt::format("facet of cell {} listed twice", cell),
                          fmt::format("{}", *twice),
                          "each facet once",
                          {}});
    }
  }
}

}  // namespace

bool is_dipha(const Input& input) {
  return input.size() >= kWord &&
         load<std::int64_t>(input.bytes().data(), std::endian::little) == kDiphaMagic;
}

DiphaType dipha_type(const Input& input) {
  BinaryCursor cursor(input, std::endian::little);
  const auto magic = cursor.read<std::int64_t>("magic number");
  if (magic != kDiphaMagic) {
    input.fail_at_byte(
        0, {"not a DIPHA file", fmt::format("{}", magic), fmt::format("{}", kDiphaMagic), {}});
  }
  const auto type = cursor.read<std::int64_t>("type");
  for (const DiphaType known : {DiphaType::boundary_matrix, DiphaType::image, DiphaType::diagram,
                                DiphaType::distance_matrix, DiphaType::sparse_distance_matrix}) {
    if (type == static_cast<std::int64_t>(known)) return known;
  }
  input.fail_at_byte(kWord,
                     {"DIPHA file type",
                      fmt::format("{}", type),
                      "0 (boundary matrix), 1 (image), 2 (diagram), 7 (distance matrix) or 8 "
                      "(sparse distance matrix)",
                      {}});
}

Image read_dipha_image(const Input& input, const ReadOptions& options) {
  BinaryCursor cursor = body_of(input, DiphaType::image);
  const std::size_t count = cursor.read_count("number of values", kWord);
  const std::size_t axes = cursor.read_count("number of axes", kWord);
  if (axes == 0) input.fail_at_byte(kHeader + kWord, {"number of axes", "0", "1 or more", {}});
  std::vector<Index> extents;
  std::optional<std::size_t> product = 1;
  for (std::size_t axis = 0; axis < axes; ++axis) {
    extents.push_back(
        read_int(cursor, 0, std::numeric_limits<std::int64_t>::max(), "size of an axis"));
    if (product) product = checked_product(*product, to_size(extents.back()));
  }
  if (product != count) {
    input.fail_at_byte(
        kHeader, {"number of values",
                  fmt::format("{}", count),
                  product ? fmt::format("{}, the product of the sizes {}", *product,
                                        fmt::join(extents, " x "))
                          : fmt::format("the product of the sizes {}", fmt::join(extents, " x ")),
                  {}});
  }
  const ArrayLayout layout{*element_type("f8"), std::endian::little, true, cursor.offset()};
  return without_nan_pixels(
      load_array(input, layout, std::move(extents), Input::Excess::stays_in_file), input, options);
}

DistanceMatrix read_dipha_distances(const Input& input, const ReadOptions& options) {
  BinaryCursor cursor = body_of(input, DiphaType::distance_matrix);
  const auto n = static_cast<Index>(read_points_count(cursor, options));
  const ArrayLayout layout{*element_type("f8"), std::endian::little, false, cursor.offset()};
  return square_to_distances(load_array(input, layout, {n, n}), input, options);
}

SparseDistances read_dipha_sparse(const Input& input, const ReadOptions& options) {
  BinaryCursor cursor = body_of(input, DiphaType::sparse_distance_matrix);
  const std::size_t n = read_points_count(cursor, options);
  if (n > to_size(kMostPoints)) {
    input.fail_at_byte(
        kHeader,
        {"number of points", fmt::format("{}", n), fmt::format("at most {}", kMostPoints), {}});
  }
  const std::size_t degrees_at = cursor.offset();
  cursor.take(n * kWord, "numbers of connections");
  const std::size_t pairs = cursor.remaining() / (2 * kWord);
  std::size_t total = 0;
  BinaryCursor degrees(input, std::endian::little, degrees_at);
  for (std::size_t i = 0; i < n; ++i) {
    total += to_size(read_int(degrees, 0, static_cast<Index>(pairs - total),
                              "number of connections of a point"));
  }
  const std::size_t ids_at = cursor.offset();
  cursor.take(total * kWord, "connected points");
  const std::size_t values_at = cursor.offset();
  cursor.take(total * kWord, "distances");
  cursor.expect_end();

  input.require_memory(total * sizeof(LocatedEdge));
  std::vector<LocatedEdge> edges;
  edges.reserve(total);
  BinaryCursor again(input, std::endian::little, degrees_at);
  BinaryCursor ids(input, std::endian::little, ids_at);
  BinaryCursor values(input, std::endian::little, values_at);
  MatrixEntries entries(options);
  const auto fail_entry = [&](const EntryPlace& place, Fault fault) {
    fault.what += fmt::format(", distance of {} and {}", place.row, place.column);
    input.fail_at_byte(place.byte, fault);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const auto u = static_cast<Index>(i);
    for (auto left = again.read<std::int64_t>("degree"); left > 0; --left) {
      const Index v = read_int(ids, 0, static_cast<Index>(n) - 1, "connected point");
      const EntryPlace place{i, to_size(v), values.offset()};
      const double raw = values.read<double>("distance") + 0.0;
      const double value =
          entries.distance(raw, place, [&](const Fault& fault) { fail_entry(place, fault); });
      if (u != v) edges.push_back({{std::min(u, v), std::max(u, v), value}, place.byte});
    }
  }
  entries.finish(fail_entry);
  const auto fail = [&](std::size_t at, const Fault& fault) { input.fail_at_byte(at, fault); };
  return SparseDistances(static_cast<Index>(n), unique_edges(std::move(edges), input, fail));
}

BoundaryInput read_dipha_boundary(const Input& input, const ReadOptions& options) {
  BinaryCursor cursor = body_of(input, DiphaType::boundary_matrix);
  if (read_int(cursor, 0, 1, "kind of matrix") == 1) {
    input.fail_at_byte(kHeader, {"a dualised matrix", "coboundaries", "boundaries (0)",
                                 "DIPHA's program dualize turns one into the other"});
  }
  // A cell takes three words, which are its dimension, its value and its offset.
  const std::size_t cells = cursor.read_count("number of cells", 3 * kWord);
  if (cells == 0 && !options.allow_empty) {
    input.fail_at_byte(kHeader + kWord, {"no cells", "0", "at least one",
                                         mark(Setting::allow_empty) + " accepts an empty complex"});
  }
  const std::int64_t top = read_int(cursor, 0, kMostDimension, "dimension of the complex");
  BoundaryInput result;
  result.binary = true;
  result.name = input.name();
  input.require_memory(cells * (sizeof(int) + sizeof(double) + sizeof(std::size_t)));
  result.matrix.dims.reserve(cells);
  result.matrix.values.reserve(cells);
  result.places.reserve(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    result.places.push_back(cursor.offset());
    result.matrix.dims.push_back(static_cast<int>(read_int(cursor, 0, top, "dimension of a cell")));
  }
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::size_t at = cursor.offset();
    const auto value = cursor.read<double>("values of the cells");
    if (std::isnan(value)) {
      input.fail_at_byte(at, {fmt::format("value of cell {}", cell), "NaN", "a number", {}});
    }
    result.matrix.values.push_back(value + 0.0);
  }
  read_facets(cursor, cells, result.matrix);
  cursor.expect_end();
  return result;
}

}  // namespace ph::detail
