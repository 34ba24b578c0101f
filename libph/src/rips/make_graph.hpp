// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <variant>

#include "ph/detail/rips/rips_graph.hpp"
#include "ph/rips.hpp"

namespace ph {

/// Points and their owner. If `owner` is null, the caller of Rips::borrowed owns the points.
struct HeldPoints {
  PointsView view;
  std::shared_ptr<const Points> owner;
};

/// A metric that the user has defined, and the object that it reads.
struct HeldMetric {
  AnyMetric metric;
  std::shared_ptr<const void> owner;
};

/// The data of a Rips filtration.
using RipsData = std::variant<HeldPoints, DistanceMatrix, SparseDistances, HeldMetric>;

Index size_of(const RipsData& data);

/// The points that become vertices, and the births of points, as the options determine them.
struct ChosenVertices {
  std::span<const std::uint32_t> vertices;  ///< ascending; if empty, all points are vertices
  std::span<const double> births;           ///< for all points of the input; if empty, all are 0
};

/// @throws Error (usage) if the options do not fit the data; Error (bad_data) if coordinates are
/// not finite; Error (resource) if there are too many points.
void check_options(const RipsData& data, const RipsOptions& options, const RunContext& context);

/// Makes a form of the filtration. Precondition: check_options has passed.
/// @throws Error as Rips::graph does.
RipsGraph make_graph(const RipsData& data, const RipsOptions& options, RipsForm form,
                     const ChosenVertices& chosen, const RunContext& context);

/// Makes a spanning forest with core distances as births, which are found in the same search. Null
/// if the data or the options need something else. Precondition: check_options has passed.
/// @throws Error as Rips::graph does.
std::optional<RipsGraph> make_core_forest(const RipsData& data, const RipsOptions& options,
                                          const RunContext& context);

/// Does the work of Rips::sample.
RipsSample sample_of(const RipsData& data, const RipsOptions& options, const RunContext& context);

}  // namespace ph
