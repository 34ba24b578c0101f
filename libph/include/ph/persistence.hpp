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

/// The barcode of a filtered complex: `plan`, then `run`.
/// @throws Error (usage) on a field that is not one, a negative dimension, a NaN, an engine that
///         cannot do the task or a collapse that would spoil it; Error (resource) beyond the memory
///         limit; Error (cancelled) on a stop request.
Barcode persistence(const Rips& rips, const Options& options = {},
                    const RunContext& context = default_context());
/// Gives the input back once the form that was planned is there, unless there are other copies.
Barcode persistence(Rips&& rips, const Options& options = {},
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

/// How a barcode will be computed. A function of complex and options alone: it depends neither on
/// what was made before nor on threads or memory.
struct RunPlan {
  Options options;               ///< settled: engine, highest dimension, and collapse on or off
  std::optional<RipsForm> form;  ///< of a Rips filtration, which it needs; none: another complex
  std::string reason;            ///< why this engine was chosen, one phrase
  std::string collapse_reason;   ///< why edges are collapsed, or not; empty: no Rips filtration
};
/// Decides as `persistence` does. Of most tasks of a Rips filtration no edge is made; where the
/// choice depends on the edges they are made, and a sample of them is collapsed.
/// @throws as `persistence`.
RunPlan plan(const AnyComplex& complex, const Options& options = {},
             const RunContext& context = default_context());
/// Makes what the plan needs, which `run` would do otherwise. @throws Error (resource, cancelled);
/// of a Rips filtration as Rips::graph.
void build(const AnyComplex& complex, const RunPlan& plan,
           const RunContext& context = default_context());
/// Computes as planned. @param plan of this complex. @throws as `persistence`.
Barcode run(const AnyComplex& complex, const RunPlan& plan,
            const RunContext& context = default_context());
/// Gives the input of a Rips filtration back once the form is there, unless there are other copies.
Barcode run(AnyComplex&& complex, const RunPlan& plan,
            const RunContext& context = default_context());

/// What is known of a complex once it is built as planned.
struct RunFacts {
  std::optional<Index> vertices;          ///< of a Rips filtration, as all that follows
  std::optional<std::size_t> edges;       ///< none: points alone are held
  std::optional<double> threshold;        ///< none: there is no limit
  std::optional<double> covering_radius;  ///< of the subsample, if there is one
};
/// Builds what is not there yet. @throws as `build`.
RunFacts facts(const AnyComplex& complex, const RunPlan& plan,
               const RunContext& context = default_context());

/// Compares two barcodes as multisets of (dim, birth, death). @return an empty string if they are
/// equal, else the first bar that one has and the other has not, in words.
std::string first_difference(const Barcode& a, const Barcode& b);

}  // namespace ph
