// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <vector>

#include "ph/alpha.hpp"
#include "python/src/recipes.hpp"

namespace ph::python {

/// Alpha complexes of points in one to three dimensions. The recipe shares the points.
class AlphaRecipe final : public Recipe {
 public:
  /// @param ids the numbers of the points in the input; if empty, they are the indices of the
  /// points.
  AlphaRecipe(std::shared_ptr<const MetricSpace> space, AlphaOptions options,
              std::vector<Index> ids)
      : space_(std::move(space)), options_(std::move(options)), ids_(std::move(ids)) {}

  Built build(const RunContext& context) const override;
  bool is_short(const Options& options) const override;
  const std::vector<Index>& vertex_ids() const override { return ids_; }
  std::optional<PointsView> points() const override { return space_->point_set()->points; }

  Alpha alpha(const RunContext& context) const;

 private:
  const std::shared_ptr<const MetricSpace> space_;
  const AlphaOptions options_;
  const std::vector<Index> ids_;
};

}  // namespace ph::python
