// SPDX-License-Identifier: MIT
#pragma once
#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "data/metric_space.hpp"
#include "ph/merge_tree.hpp"
#include "ph/persistence.hpp"
#include "results/bars.hpp"

namespace ph::python {

/// Whether bars of H1 that come with cycles come with loops, too.
enum class LoopChoice { none, plain, tight };

/// What is computed.
struct Task {
  Options options;
  LoopChoice loops = LoopChoice::none;
};

/// A complex, and what was found out while it was built.
struct Built {
  AnyComplex complex;
  Facts facts = {};
  /// A threshold that has to be applied to the bars, because the complex holds larger values too.
  std::optional<double> cut = std::nullopt;
};

/// What a complex is built of, and how. It is built within a run, which can be stopped.
class Recipe {
 public:
  virtual ~Recipe() = default;
  /// @param options of the homology: what is not needed for it may be left out of the complex.
  /// @param context outlives the complex.
  virtual Built build(const Options& options, const RunContext& context) const = 0;
  /// Whether building it and computing its homology takes milliseconds at most.
  virtual bool is_short(const Options& options) const = 0;
  /// By vertex of the complex its number in the input; empty: its own.
  virtual const std::vector<Index>& vertex_ids() const;

  // For a page that shows the data.
  /// The points, if it is built of some.
  virtual std::optional<PointsView> points() const { return std::nullopt; }
  /// Whether all pairs of points within a distance are the edges at that distance.
  virtual bool is_euclidean() const { return false; }
  /// The merge tree of all of its vertices; nothing where it has not all that are in the input.
  /// @param built by these options, or by those of the same homology.
  virtual std::optional<MergeTree> whole_tree(const Built& built, const Options& options,
                                              const RunContext& context) const;
};

class RipsRecipe final : public Recipe {
 public:
  struct Choices {
    std::optional<double> threshold;
    std::vector<double> births;           ///< by point; empty: 0
    std::optional<Index> dtm_neighbours;  ///< births by the distance to this measure
    WeightExponent weight_exponent = WeightExponent::infinity;
    std::optional<GreedyLimits> subsample;
    std::optional<double> approximation;
    std::optional<bool> merge_equal_points;  ///< none: where it may
    Device device = Device::cpu;
    std::vector<Index> ids;  ///< of the points; empty: their numbers
  };
  RipsRecipe(std::shared_ptr<const MetricSpace> space, Choices choices)
      : space_(std::move(space)), choices_(std::move(choices)) {}

  Built build(const Options& options, const RunContext& context) const override;
  bool is_short(const Options& options) const override;
  const std::vector<Index>& vertex_ids() const override { return choices_.ids; }
  std::optional<PointsView> points() const override;
  bool is_euclidean() const override;
  std::optional<MergeTree> whole_tree(const Built& built, const Options& options,
                                      const RunContext& context) const override;
  /// The edges of the complex after they were collapsed.
  Rips collapsed(const RunContext& context) const;

 private:
  template <class Data>
  Built build(const Data& data, RipsOptions options, const Options& task,
              const RunContext& context) const;

  const std::shared_ptr<const MetricSpace> space_;
  const Choices choices_;
};

/// Of an image in an array of one of the types of voxels, which it keeps.
class CubicalRecipe final : public Recipe {
 public:
  /// @param is_file whether the array is a file that is mapped and cannot be written.
  CubicalRecipe(const py::buffer& image, bool is_masked, bool is_file, CubicalOptions options);

  Built build(const Options& options, const RunContext& context) const override;
  bool is_short(const Options& options) const override;
  Image image(const RunContext& context) const;
  const CubicalOptions& options() const { return options_; }

 private:
  py::buffer_info array_;
  VoxelType type_;
  bool is_masked_, is_file_;
  CubicalOptions options_;
};

/// Of cells that are listed one by one.
class ListedRecipe final : public Recipe {
 public:
  using List = std::function<ExplicitComplex(const RunContext&)>;
  ListedRecipe(List list, std::optional<double> threshold, std::size_t cells)
      : list_(std::move(list)), threshold_(threshold), cells_(cells) {}

  Built build(const Options& options, const RunContext& context) const override;
  bool is_short(const Options& options) const override;

 private:
  List list_;
  std::optional<double> threshold_;
  std::size_t cells_;
};

}  // namespace ph::python
