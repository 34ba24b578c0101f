// SPDX-License-Identifier: MIT
#include "ph/explicit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "ph/barcode.hpp"
#include "ph/detail/core/fingerprint.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

[[noreturn]] void fail(const CellNamer& name, std::size_t cell, const std::string& what) {
  throw Error(ErrorKind::bad_data,
              mark_place(name ? name(cell) : fmt::format("cell {}", cell)) + ": " + what);
}

std::string vertex_list(std::span<const Index> vertices) {
  return fmt::format("({})", fmt::join(vertices, " "));
}

/// The simplices of a list, found by their vertices: a hash table with linear probing. It takes 8
/// to 16 bytes per simplex, in one block.
class Positions {
 public:
  Positions(const SimplexList& simplices, const RunContext& context)
      : simplices_(simplices),
        slots_(std::bit_ceil(2 * simplices.size() + 1), kNone, &context.memory) {}

  /// @return false if there is such a simplex already.
  bool add(std::uint32_t simplex) {
    std::uint32_t& slot = slot_of(simplices_.simplex(simplex));
    if (slot != kNone) return false;
    slot = simplex;
    return true;
  }
  std::optional<std::uint32_t> find(std::span<const Index> vertices) {
    const std::uint32_t found = slot_of(vertices);
    return found == kNone ? std::nullopt : std::optional(found);
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// The slot of a simplex, or the empty slot where it belongs.
  std::uint32_t& slot_of(std::span<const Index> vertices) {
    Fingerprint hash;
    for (const Index v : vertices) hash.add(static_cast<std::uint64_t>(v));
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash.value() & mask;
    while (slots_[at] != kNone && !std::ranges::equal(simplices_.simplex(slots_[at]), vertices))
      at = (at + 1) & mask;
    return slots_[at];
  }

  const SimplexList& simplices_;
  std::pmr::vector<std::uint32_t> slots_;
};

std::size_t bytes_of(const SimplexList& list) {
  return list.vertices.size() * sizeof(Index) + list.offsets.size() * sizeof(std::size_t) +
         list.values.size() * sizeof(double);
}

void check_size(std::size_t cells) {
  if (cells >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::resource,
                fmt::format("explicit complex: found {} cells, expected at most 2^32 - 2", cells));
  }
}

// Tables have one row for each dimension. The limit prevents huge tables if a number in a file is
// wrong.
constexpr int kLargestDimension = 65535;

[[noreturn]] void refuse(std::string_view what, const std::string& fault) {
  throw Error(ErrorKind::bad_data, fmt::format("{}: {}", what, fault));
}

// Checks the offsets of compressed rows: row i consists of the entries from offsets[i] to offsets[i
// + 1] - 1. @param items the number of all entries.
void check_offsets(std::string_view what, const std::vector<std::size_t>& offsets,
                   std::size_t items) {
  if (!offsets.empty() && offsets.front() == 0 && offsets.back() == items &&
      std::ranges::is_sorted(offsets))
    return;
  refuse(what, fmt::format("found {}, expected offsets that ascend from 0 to {}",
                           offsets.empty() ? "no offsets"
                                           : fmt::format("{} offsets from {} to {}", offsets.size(),
                                                         offsets.front(), offsets.back()),
                           items));
}

void check_layout(const BoundaryMatrix& matrix) {
  const std::size_t n = matrix.size();
  constexpr std::string_view what = "boundary matrix";
  if (matrix.offsets.size() != n + 1)
    refuse(what, fmt::format("found {} offsets, expected {}", matrix.offsets.size(), n + 1));
  if (!matrix.values.empty() && matrix.values.size() != n)
    refuse(what, fmt::format("found {} values, expected {}", matrix.values.size(), n));
  check_offsets(what, matrix.offsets, matrix.rows.size());
  if (!matrix.incidences.empty() && matrix.incidences.size() != matrix.rows.size())
    refuse(what, fmt::format("found {} incidence numbers, expected {}", matrix.incidences.size(),
                             matrix.rows.size()));
}

// The boundary matrix of a set of simplices. The vertices of each simplex must be in ascending
// order.
BoundaryMatrix boundary_of(const SimplexList& simplices, const CellNamer& name,
                           const RunContext& context) {
  Positions positions(simplices, context);
  BoundaryMatrix matrix;
  matrix.values = simplices.values;
  matrix.dims.reserve(simplices.size());
  matrix.offsets.reserve(simplices.size() + 1);
  matrix.rows.reserve(simplices.vertices.size());
  matrix.incidences.reserve(simplices.vertices.size());
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    const auto vertices = simplices.simplex(i);
    if (!positions.add(static_cast<std::uint32_t>(i)))
      fail(name, i, fmt::format("simplex {} occurs twice", vertex_list(vertices)));
    matrix.dims.push_back(static_cast<int>(vertices.size()) - 1);
  }
  std::vector<Index> facet;
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    const auto vertices = simplices.simplex(i);
    for (std::size_t k = 0; vertices.size() > 1 && k < vertices.size(); ++k) {
      facet.assign(vertices.begin(), vertices.end());
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(k));
      const auto found = positions.find(facet);
      if (!found) {
        fail(name, i,
             fmt::format("simplex {}: its facet {} is missing", vertex_list(vertices),
                         vertex_list(facet)));
      }
      matrix.rows.push_back(static_cast<Index>(*found));
      matrix.incidences.push_back(k % 2 == 0 ? 1 : -1);
    }
    matrix.offsets.push_back(matrix.rows.size());
  }
  return matrix;
}

}  // namespace

void SimplexList::check_layout() const {
  check_offsets("list of simplices", offsets, vertices.size());
}

ExplicitComplex ExplicitComplex::from_simplices(SimplexList simplices, const CellNamer& name,
                                                const RunContext& context) {
  simplices.check_layout();  // mutant: explicit-layout
  check_size(simplices.size());
  if (simplices.values.size() != simplices.size())  // mutant: explicit-values
    refuse("list of simplices",
           fmt::format("found {} values, expected {}", simplices.values.size(), simplices.size()));
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    const auto vertex = [&](std::size_t k) {
      return simplices.vertices.begin() + static_cast<std::ptrdiff_t>(k);
    };
    const auto begin = vertex(simplices.offsets[i]), end = vertex(simplices.offsets[i + 1]);
    if (begin == end) fail(name, i, "found a simplex without vertices, expected at least one");
    std::sort(begin, end);
    if (*begin < 0) fail(name, i, fmt::format("found vertex {}, expected >= 0", *begin));
    if (const auto it = std::adjacent_find(begin, end); it != end)
      fail(name, i, fmt::format("vertex {} occurs twice in one simplex", *it));
  }
  auto claim = std::make_shared<const MemoryClaim>(context.memory, bytes_of(simplices));
  // An upper bound on the memory of the boundary matrix.
  const MemoryClaim for_matrix(
      context.memory, simplices.size() * (sizeof(int) + sizeof(std::size_t) + sizeof(double)) +
                          simplices.vertices.size() * (sizeof(Index) + sizeof(int)));
  ExplicitComplex complex = from_boundary(boundary_of(simplices, name, context), name, context);
  complex.kind_ = CellKind::vertices;
  complex.simplices_ = std::move(simplices);
  complex.simplices_claim_ = std::move(claim);
  return complex;
}

ExplicitComplex ExplicitComplex::from_boundary(const BoundaryMatrix& matrix, const CellNamer& name,
                                               const RunContext& context) {
  const std::size_t n = matrix.size();
  check_size(n);
  check_layout(matrix);
  std::pmr::vector<double> values(matrix.values.begin(), matrix.values.end(), &context.memory);
  if (values.empty()) {
    values.resize(n);
    std::iota(values.begin(), values.end(), 0.0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isnan(values[i])) fail(name, i, "found the value nan, expected a number");
    if (matrix.dims[i] < 0 || matrix.dims[i] > kLargestDimension) {
      fail(name, i,
           fmt::format("found dimension {}, expected 0 to {}", matrix.dims[i], kLargestDimension));
    }
    values[i] += 0.0;
  }

  context.poll();
  ExplicitComplex complex(&context.memory);
  complex.has_incidences_ = !matrix.incidences.empty() || matrix.rows.empty();
  complex.order_cells(matrix.dims, values);
  complex.facets_.offsets.reserve(n + 1);
  complex.facets_.offsets.push_back(0);
  complex.facets_.cells.reserve(matrix.rows.size());
  complex.facets_.incidences.reserve(matrix.rows.size());
  std::vector<std::pair<std::uint32_t, int>> column;
  for (std::uint32_t id = 0; id < n; ++id) {
    const std::size_t i = complex.input_position_[id];
    column.clear();
    for (std::size_t k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
      const Index row = matrix.rows[k];
      if (row < 0 || static_cast<std::size_t>(row) >= n)
        fail(name, i, fmt::format("facet: found {}, expected a cell >= 0 and below {}", row, n));
      const auto facet = static_cast<std::size_t>(row);
      if (matrix.dims[facet] != matrix.dims[i] - 1) {
        fail(name, i,
             fmt::format("facet {}: found dimension {}, expected {}", row, matrix.dims[facet],
                         matrix.dims[i] - 1));
      }
      if (values[facet] > values[i]) {  // mutant: explicit-facet
        fail(name, i,
             fmt::format("the cell enters at {}, before its facet {} at {}", values[i], row,
                         values[facet]));
      }
      column.emplace_back(complex.id_of_[facet],
                          matrix.incidences.empty() ? 1 : matrix.incidences[k]);
    }
    std::sort(column.begin(), column.end());
    for (const auto& [facet, incidence] : column) {
      if (complex.facets_.cells.size() > complex.facets_.offsets.back() &&
          complex.facets_.cells.back() == facet) {
        fail(name, i, fmt::format("facet {} occurs twice", complex.input_position_[facet]));
      }
      complex.facets_.cells.push_back(facet);
      complex.facets_.incidences.push_back(incidence);
    }
    complex.facets_.offsets.push_back(complex.facets_.cells.size());
  }
  context.poll();
  complex.check(matrix.dims, name);
  complex.leave_out_what_never_enters();  // mutant: explicit-infinite
  complex.sort_by_dimension(matrix.dims);
  complex.build_cofacets();
  return complex;
}

void ExplicitComplex::order_cells(const std::vector<int>& dims, std::span<const double> values) {
  const std::size_t n = dims.size();
  input_position_.resize(n);
  std::iota(input_position_.begin(), input_position_.end(), 0U);
  std::sort(input_position_.begin(), input_position_.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (values[a] != values[b]) return values[a] < values[b];
    return dims[a] != dims[b] ? dims[a] < dims[b] : a < b;
  });
  id_of_.resize(n);
  key_.resize(n);
  for (std::uint32_t id = 0; id < n; ++id) {
    const std::uint32_t i = input_position_[id];
    id_of_[i] = id;
    if (values_.empty() || values_.back() != values[i]) values_.push_back(values[i]);
    key_[id] = static_cast<std::uint32_t>(values_.size() - 1);
  }
}

// Cells of infinite value come last in the order, and none of them is a facet of a cell that
// enters.
void ExplicitComplex::leave_out_what_never_enters() {
  if (values_.empty() || values_.back() < kInfinity) return;
  const auto never = static_cast<std::uint32_t>(values_.size() - 1);
  const auto count = static_cast<std::size_t>(std::ranges::lower_bound(key_, never) - key_.begin());
  values_.pop_back();
  key_.resize(count);
  input_position_.resize(count);
  facets_.offsets.resize(count + 1);
  facets_.cells.resize(facets_.offsets.back());
  facets_.incidences.resize(facets_.offsets.back());
}

void ExplicitComplex::sort_by_dimension(const std::vector<int>& dims) {
  const auto dim_of = [&](std::size_t i) { return static_cast<std::size_t>(dims[i]); };
  first_of_dim_.assign(1, 0);
  for (const std::uint32_t i : input_position_) {
    if (dim_of(i) + 2 > first_of_dim_.size()) first_of_dim_.resize(dim_of(i) + 2, 0);
    ++first_of_dim_[dim_of(i) + 1];
  }
  std::partial_sum(first_of_dim_.begin(), first_of_dim_.end(), first_of_dim_.begin());
  of_dim_.resize(size());
  std::vector<std::size_t> next(first_of_dim_.begin(), first_of_dim_.end());
  // Within a dimension, cells keep the order of the input.
  for (std::size_t i = 0; i < dims.size(); ++i) {
    if (dims[i] == 0) vertices_.push_back(static_cast<std::uint32_t>(i));
    if (id_of_[i] < size()) of_dim_[next[dim_of(i)]++] = id_of_[i];
  }
}

void ExplicitComplex::set_threshold(double largest) {
  if (std::isnan(largest)) throw Error(ErrorKind::usage, "threshold: found nan, expected a number");
  threshold_ = largest;
}

std::size_t ExplicitComplex::vertex_number(Cell vertex) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(vertices_, input_position_[vertex.id]) -
                                  vertices_.begin());
}

void ExplicitComplex::build_cofacets() {
  const std::size_t n = size();
  cofacets_.offsets.assign(n + 1, 0);
  for (const std::uint32_t f : facets_.cells) ++cofacets_.offsets[f + 1];
  std::partial_sum(cofacets_.offsets.begin(), cofacets_.offsets.end(), cofacets_.offsets.begin());
  cofacets_.cells.resize(facets_.cells.size());
  cofacets_.incidences.resize(facets_.cells.size());
  std::pmr::vector<std::size_t> next(cofacets_.offsets.begin(), cofacets_.offsets.end() - 1,
                                     cofacets_.offsets.get_allocator());
  for (std::uint32_t id = 0; id < n; ++id) {  // the ascending order puts the oldest cofacet first
    for (std::size_t k = facets_.offsets[id]; k < facets_.offsets[id + 1]; ++k) {
      const std::size_t at = next[facets_.cells[k]]++;
      cofacets_.cells[at] = id;
      cofacets_.incidences[at] = facets_.incidences[k];
    }
  }
}

void ExplicitComplex::check(const std::vector<int>& dims, const CellNamer& name) {
  std::map<std::uint32_t, Index> square;
  for (std::uint32_t id = 0; id < size(); ++id) {
    const std::size_t i = input_position_[id];
    square.clear();
    Index sum = 0;
    const std::size_t begin = facets_.offsets[id], end = facets_.offsets[id + 1];
    for (std::size_t k = begin; k < end; ++k) {
      sum += facets_.incidences[k];
      const std::uint32_t f = facets_.cells[k];
      for (std::size_t m = facets_.offsets[f]; m < facets_.offsets[f + 1]; ++m)
        square[facets_.cells[m]] += Index{facets_.incidences[k]} * facets_.incidences[m];
    }
    for (const auto& [cell, coefficient] : square) {
      const bool is_zero = has_incidences_ ? coefficient == 0 : coefficient % 2 == 0;
      if (!is_zero) {
        fail(name, i,
             fmt::format("the boundary of its boundary is not zero at cell {}",
                         input_position_[cell]));
      }
    }
    if (dims[i] == 1) {
      const bool joins = end - begin == 2 && (!has_incidences_ || sum == 0) &&
                         (facets_.incidences[begin] == 1 || facets_.incidences[begin] == -1);
      edges_join_vertices_ = edges_join_vertices_ && (begin == end || joins);
    }
  }
}

void ExplicitComplex::append_input_cell(int, Cell cell, std::vector<Index>& numbers) const {
  const std::size_t i = input_position_[cell.id];
  if (kind_ == CellKind::row) {
    numbers.push_back(static_cast<Index>(i));
  } else {
    const auto vertices = simplices_.simplex(i);
    numbers.insert(numbers.end(), vertices.begin(), vertices.end());
  }
}

}  // namespace ph
