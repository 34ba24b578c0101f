// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <span>
#include <variant>

#include "ph/detail/rips/rips_graph.hpp"
#include "ph/rips.hpp"

namespace ph {

/// Points with whoever owns them; null: the caller of Rips::borrowed does.
struct HeldPoints {
  PointsView view;
  std::shared_ptr<const Points> owner;
};

/// A metric of the user's own with the object that it reads.
struct HeldMetric {
  AnyMetric metric;
  std::shared_ptr<const void> owner;
};

/// What a Rips filtration is of.
using RipsData = std::variant<HeldPoints, DistanceMatrix, SparseDistances, HeldMetric>;

Index size_of(const RipsData& data);

/// Which points are vertices and when they enter, once the options are settled.
struct ChosenVertices {
  std::span<const std::uint32_t> vertices;  ///< ascending; empty: all
  std::span<const double> births;           ///< by point of the input; empty: all at 0
};

/// @throws Error (usage) on options that the data cannot have, Error (bad_data) on coordinates that
/// are no numbers, Error (resource) on too many points.
void check_options(const RipsData& data, const RipsOptions& options, const RunContext& context);

/// Makes a form of the filtration. Precondition: check_options has passed.
/// @throws Error as Rips::graph.
RipsGraph make_graph(const RipsData& data, const RipsOptions& options, RipsForm form,
                     const ChosenVertices& chosen, const RunContext& context);

}  // namespace ph
