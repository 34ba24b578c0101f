// SPDX-License-Identifier: MIT
#pragma once
#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "ph/detail/rips/rips_graph.hpp"
#include "ph/persistence.hpp"
#include "python/src/data/metric_space.hpp"
#include "python/src/results/bars.hpp"

namespace ph::python {

/// The computation to run.
struct Task {
  Options options;
  LoopChoice loops = LoopChoice::none;
};

/// A complex.
struct Built {
  AnyComplex complex;
  std::shared_ptr<const MemoryClaim> data = nullptr;  ///< of the recipe's copies of the data
};

/// The data and options from which a complex is built. The complex is built within a run, which can
/// be stopped.
class Recipe {
 public:
  virtual ~Recipe() = default;
  /// @param context outlives the complex.
  virtual Built build(const RunContext& context) const = 0;
  /// True if building the complex and computing its homology takes milliseconds at most.
  virtual bool is_short(const Options& options) const = 0;
  /// For each vertex of the complex, its number in the input. If empty, each vertex has its own
  /// number.
  virtual const std::vector<Index>& vertex_ids() const;

  // The points, for a page that shows the data. Empty if the complex is not built from points.
  virtual std::optional<PointsView> points() const { return std::nullopt; }
  /// True if the edges up to a value are exactly the pairs of points within this distance.
  virtual bool is_euclidean() const { return false; }
};

class RipsRecipe final : public Recipe {
 public:
  /// @param options all options except the metric, which belongs to the space.
  /// @param ids the numbers of the points in the input; if empty, they are the indices of the
  /// points.
  RipsRecipe(std::shared_ptr<const MetricSpace> space, RipsOptions options, std::vector<Index> ids);

  Built build(const RunContext& context) const override;
  bool is_short(const Options& options) const override;
  const std::vector<Index>& vertex_ids() const override { return ids_; }
  std::optional<PointsView> points() const override;
  bool is_euclidean() const override;
  /// The edges of the complex after the collapse.
  RipsGraph collapsed(const RunContext& context) const;

 private:
  Rips rips(const RunContext& context) const;

  const std::shared_ptr<const MetricSpace> space_;
  RipsOptions options_;
  const std::vector<Index> ids_;
};

/// The complex of an image in an array with one of the voxel types. The recipe keeps the array
/// alive.
class CubicalRecipe final : public Recipe {
 public:
  /// @param is_file true if the array is a mapped file that cannot be written.
  CubicalRecipe(const py::buffer& image, bool is_masked, bool is_file, CubicalOptions options);

  Built build(const RunContext& context) const override;
  bool is_short(const Options& options) const override;
  Image image(const RunContext& context) const;
  const CubicalOptions& options() const { return options_; }

 private:
  py::buffer_info array_;
  VoxelType type_;
  bool is_masked_, is_file_;
  CubicalOptions options_;
};

/// A complex of cells that are listed one by one.
class ListedRecipe final : public Recipe {
 public:
  using List = std::function<ExplicitComplex(const RunContext&)>;
  /// @param bytes the memory of the list. It is counted twice, because Python's arrays, from which
  /// the list was copied, may still be in the heap.
  ListedRecipe(List list, std::optional<double> threshold, std::size_t cells, std::size_t bytes)
      : list_(std::move(list)), threshold_(threshold), cells_(cells), bytes_(2 * bytes) {}

  Built build(const RunContext& context) const override;
  bool is_short(const Options& options) const override;

 private:
  List list_;
  std::optional<double> threshold_;
  std::size_t cells_, bytes_;
};

}  // namespace ph::python
