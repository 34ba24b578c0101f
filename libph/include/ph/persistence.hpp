// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ph/alpha.hpp"
#include "ph/barcode.hpp"
#include "ph/cubical.hpp"
#include "ph/detail/complex/filtered_graph.hpp"
#include "ph/detail/core/engine.hpp"
#include "ph/explicit.hpp"
#include "ph/rips.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Whether the edges of a Rips complex are collapsed before its homology is computed: the bars of
/// positive length stay the same, see docs/explanation/engines/edge-collapse.md.
enum class Collapse {
  automatic,  ///< where it is allowed and a sample of the edges says that it pays
  on,
  off,
};

/// What to compute, and how.
struct Options {
  /// Highest homology dimension reported; default: 1 for Rips, all dimensions otherwise.
  std::optional<int> max_dim = std::nullopt;
  int min_dim = 0;  ///< lowest one reported: where that saves work, lower ones are not computed
  std::int64_t field = 2;             ///< characteristic of the coefficients: a prime < 2^31
  Engine engine = Engine::automatic;  ///< which engine
  /// Rips only. With it, birth and death cells have the values of their bar, but among the many of
  /// one value others may be named; zero-length bars and cocycles exclude it.
  Collapse collapse = Collapse::automatic;
  double min_persistence = 0;  ///< bars with death - birth <= this are left out; < 0: none
  Representatives representatives = Representatives::none;  ///< chains that come with the bars
  bool cells = true;  ///< whether bars know the cells of their birth and death: time and memory
};

/// The barcode of a filtered complex.
/// @throws Error (usage) on a field that is not one, a negative dimension, a NaN, an engine that
///         cannot do the task or a collapse that would spoil it; Error (resource) beyond the memory
///         limit; Error (cancelled) on a stop request.
Barcode persistence(const Rips& rips, const Options& options = {},
                    const RunContext& context = default_context());
Barcode persistence(const Cubical& cubical, const Options& options = {},
                    const RunContext& context = default_context());
Barcode persistence(const ExplicitComplex& complex, const Options& options = {},
                    const RunContext& context = default_context());
Barcode persistence(const Alpha& alpha, const Options& options = {},
                    const RunContext& context = default_context());
Barcode persistence(const FilteredGraph& graph, const Options& options = {},
                    const RunContext& context = default_context());
// For a complex of your own there is a template: ph/custom.hpp.

/// Whether a Rips filtration of points had better hold them alone for a task: with
/// RipsOptions::only_points, which is otherwise as given.
/// @throws Error (usage) if Engine::beta_skeleton is asked for where it cannot do the task.
bool holds_points_alone(PointsView points, const RipsOptions& rips, const Options& options);

/// Data that no complex has been chosen for.
template <class T>
concept DataWithoutComplex = std::convertible_to<const T&, PointsView> ||
    std::same_as<T, DistanceMatrix> || std::same_as<T, SparseDistances> || std::same_as<T, Image>;
/// Does not compile: says which complex to choose.
template <DataWithoutComplex Data>
Barcode persistence(const Data&, const Options& = {}, const RunContext& = default_context()) {
  static_assert(!DataWithoutComplex<Data>,
                "choose a complex: ph::persistence(ph::Rips(points)) for points or distances, "
                "ph::persistence(ph::Cubical(image)) for an image");
  return Barcode(CellKind::vertices);
}

/// Any of the complexes above, for programs that learn at run time what they have.
using AnyComplex = std::variant<Rips, Cubical, ExplicitComplex, Alpha>;
Barcode persistence(const AnyComplex& complex, const Options& options = {},
                    const RunContext& context = default_context());

/// Compares two barcodes as multisets of (dim, birth, death). @return an empty string if they are
/// equal, else the first bar that one has and the other has not, in words.
std::string first_difference(const Barcode& a, const Barcode& b);

}  // namespace ph
