// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <optional>
#include <vector>

#include "ph/detail/core/names.hpp"
#include "ph/detail/image/cubical_image.hpp"
#include "ph/filtration.hpp"
#include "ph/image.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// How voxels become cubes.
struct CubicalOptions {
  enum class Construction {
    /// V: voxels are vertices, and a cube enters with its last vertex. 4/6-neighbours join.
    vertices,
    /// T: voxels are top cubes, and a face enters with its first cube. 8/26-neighbours join.
    cells,
  };
  Construction construction = Construction::vertices;
  /// Uses the superlevel sets of f: the sublevel filtration of -f, reported with the values of f.
  bool superlevel = false;
  /// True for each axis (of the input) that closes up on itself; empty if none does.
  std::vector<bool> periodic = {};
  /// Cells with larger values never enter. With `superlevel`, the threshold is a value of -f.
  std::optional<double> threshold = std::nullopt;
};

template <>
inline constexpr std::array names_of<CubicalOptions::Construction>{
    Named{CubicalOptions::Construction::vertices, "vertices"},
    Named{CubicalOptions::Construction::cells, "cells"},
};

/// The cubical filtration of an image of any dimension, in doubled grid coordinates. An axis of n
/// voxels has 2n-1 coordinates in the V-construction (even: a voxel, odd: between two), 2n+1 in the
/// T-construction (odd: a voxel), and 2n in both if it is periodic. A cell's dimension is the
/// number of its odd coordinates. Order: (rank of the voxel that decides the value, dimension, grid
/// index).
///
/// The filtration holds the voxels, which it shares with the image. Engines for any filtration need
/// a table of 4 bytes per cell (2^d cells per voxel) and the sorted values. These are made once, by
/// `prepare` or when a cell or value is first requested; engines that work voxel by voxel do not
/// need them. A voxel with the value +infinity never enters, and a voxel with the value -infinity
/// is born at -infinity. For superlevel sets, this holds after the sign change. Absent voxels never
/// enter.
class Cubical {
 public:
  struct Cell {
    std::uint32_t key = 0;    ///< rank of the deciding voxel
    std::uint64_t index = 0;  ///< position in the doubled grid
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  static constexpr int kMaxDim = 8;
  static constexpr bool first_equal_cofacet_is_oldest = true;

  /// @param context must outlive the filtration.
  /// @throws Error (bad_data) on NaN unless the image is masked, on an axis of length 0, or if the
  ///         extents do not match the number of values; Error (usage) on more than 8 axes, a
  ///         threshold that is NaN or a periodic axis that does not exist; Error (resource) beyond
  ///         the context's memory limit.
  explicit Cubical(const Image& image, const CubicalOptions& options = {},
                   const RunContext& context = default_context());

  /// Makes the table of cells, unless it exists. The filtration keeps the table, which counts
  /// against the budget of the context that the filtration was built with. Sorting takes 32 more
  /// bytes per voxel; `context` limits the memory, receives the progress and can stop the work.
  /// O(cells). Thread-safe.
  /// @throws Error (resource), also on more than 2^32 - 2 voxels, and Error (cancelled); after
  ///         either error, the call can be repeated.
  void prepare(const RunContext& context) const;

  int top_dim() const { return dim_; }
  std::uint32_t key(const Cell& c) const { return c.key; }
  /// The value at which a cell enters; defined in ph/custom.hpp. If `prepare` was not called
  /// before, the first call of `value` does the work of `prepare`, with the context that the
  /// filtration was built with.
  /// @throws Error (resource) and (cancelled) in that case.
  inline double value(const Cell& c) const;
  static bool precedes(const Cell& a, const Cell& b) {
    return a.key != b.key ? a.key < b.key : a.index < b.index;
  }
  std::size_t slot_count() const { return cells_; }
  static std::size_t slot(const Cell& c) { return c.index; }
  static bool edges_join_vertices() { return true; }
  static CellKind cell_kind() { return CellKind::grid; }
  void append_input_cell(int dim, const Cell& cell, std::vector<Index>& numbers) const;
  /// The image itself, in the order of this filtration.
  CubicalImage cubical_image() const { return grid_; }
  /// Bytes taken by the voxels.
  std::size_t voxel_bytes() const { return voxels_.bytes(); }
  /// Number of vertices of the grid, including vertices that never enter: voxels (V) or corners
  /// (T).
  std::size_t vertex_count() const;
  /// The number of a vertex; the vertices of the grid are numbered in C order.
  std::size_t vertex_number(const Cell& vertex) const;

  // Engines call the following members, which are defined in ph/custom.hpp. As with `value`, the
  // first call may throw and takes O(cells) time.
  template <class Visit>
  void for_each_cell(int dim, Visit&& visit) const;
  template <class Visit>
  void for_each_facet(int dim, const Cell& cell, Visit&& visit) const;
  template <class Visit>
  void for_each_cofacet(int dim, const Cell& cell, Visit&& visit) const;

 private:
  static constexpr std::uint32_t kNever = UINT32_MAX;
  struct Axis {
    std::uint64_t stride = 0;
    std::uint64_t length = 0;  // doubled coordinates
    bool periodic = false;
  };
  /// The keys of all cells and the sorted values.
  struct Table;
  struct Lazy;
  inline const Table& table() const;
  /// The first thread that needs the table makes it, while the others wait.
  const Table& make_table(const RunContext& context) const;
  Table new_table(const RunContext& context) const;
  /// Fills the layers between (V) or around (T) the voxels along an axis.
  static void spread_keys(std::pmr::vector<std::uint32_t>& keys, const Axis& axis,
                          bool voxels_are_vertices, Ticker& ticker);
  std::uint64_t coordinate(std::uint64_t index, const Axis& axis) const {
    return index / axis.stride % axis.length;
  }

  int dim_ = 0;
  std::array<Axis, kMaxDim> axes_;  // in the order of the input, fastest axis last
  std::size_t cells_ = 0;           // number of cells of the doubled grid
  Voxels voxels_;
  CubicalImage grid_;  // points to voxels_
  const RunContext* context_;
  std::shared_ptr<const MemoryClaim> claim_;  // counts the memory of the voxels
  std::shared_ptr<Lazy> lazy_;
};

}  // namespace ph

template <>
struct std::hash<ph::Cubical::Cell> {
  std::size_t operator()(const ph::Cubical::Cell& c) const { return c.index; }
};
