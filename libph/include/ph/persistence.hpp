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
#include "ph/detail/core/names.hpp"
#include "ph/explicit.hpp"
#include "ph/rips.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// Controls the collapse of edges before the homology of a Rips complex is computed. Bars of
/// positive length stay the same, see docs/explanation/engines/edge-collapse.md.
enum class Collapse {
  automatic,  ///< on if it is allowed and a sample of the edges shows that it is worthwhile
  on,
  off,
};

template <>
inline constexpr std::array names_of<Collapse>{
    Named{Collapse::automatic, "auto"},
    Named{Collapse::on, "on"},
    Named{Collapse::off, "off"},
};

/// The task, and the way to compute it.
struct Options {
  /// Highest dimension of homology that is reported; default: 1 for Rips, otherwise all dimensions.
  std::optional<int> max_dim = std::nullopt;
  int min_dim = 0;  ///< lowest dimension reported; lower ones are not computed if that saves work
  std::int64_t field = 2;             ///< characteristic of the coefficients: a prime < 2^31
  Engine engine = Engine::automatic;  ///< automatic: the engine that suits the task best
  /// Rips only. With a collapse, the birth and death cells of a bar have its birth and death as
  /// their values, but may be other cells than without a collapse. If bars of length zero or
  /// cocycles are requested, no collapse is possible.
  Collapse collapse = Collapse::automatic;
  /// Bars with death - birth <= this number are left out; a negative number keeps all bars.
  double min_persistence = 0;
  Representatives representatives = Representatives::none;  ///< the chains to compute for the bars
  /// True if bars get their birth and death cells, which take time and memory.
  bool cells = true;
};

/// The barcode of a filtered complex: `plan`, then `run`.
/// @throws Error (usage) on an invalid field, a negative dimension, a NaN among the options, an
///         engine that cannot do the task, or a collapse that the task does not allow; Error
///         (resource) beyond the memory limit; Error (cancelled) on a stop request.
Barcode persistence(const Rips& rips, const Options& options = {},
                    const RunContext& context = default_context());
/// Frees the input once the planned form is made, unless there are other copies.
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
// For a complex of your own, ph/custom.hpp has a template.

/// Data for which a complex must still be chosen.
template <class T>
concept DataWithoutComplex = std::convertible_to<const T&, PointsView> ||
    std::same_as<T, DistanceMatrix> || std::same_as<T, SparseDistances> || std::same_as<T, Image>;
/// Does not compile; the error says which complex to choose.
template <DataWithoutComplex Data>
Barcode persistence(const Data&, const Options& = {}, const RunContext& = default_context()) {
  static_assert(!DataWithoutComplex<Data>,
                "choose a complex: ph::persistence(ph::Rips(points)) for points or distances, "
                "ph::persistence(ph::Cubical(image)) for an image");
  return Barcode(CellKind::vertices);
}

/// Any of the complexes above, for programs that know the type only at run time.
using AnyComplex = std::variant<Rips, Cubical, ExplicitComplex, Alpha>;
Barcode persistence(const AnyComplex& complex, const Options& options = {},
                    const RunContext& context = default_context());

/// The plan of a computation. It is a function of complex and options alone: it depends neither on
/// earlier computations nor on threads or memory.
struct RunPlan {
  Options options;  ///< with engine, highest dimension and collapse (on or off) decided
  /// The form of a Rips filtration that the computation needs; empty for other complexes.
  std::optional<RipsForm> form;
  std::string reason;  ///< the reason for this engine, in one phrase
  /// The reason to collapse edges or not; empty unless the complex is a Rips filtration.
  std::string collapse_reason;
};
/// Decides in the same way as `persistence`. For most tasks on a Rips filtration no edges are made.
/// If the choice depends on the edges, they are made; for Collapse::automatic, a sample shows which
/// share of them is dominated.
/// @throws as `persistence`.
RunPlan plan(const AnyComplex& complex, const Options& options = {},
             const RunContext& context = default_context());
/// Makes the data that the plan needs; if `build` is not called, `run` makes them. @throws Error
/// (resource, cancelled); for a Rips filtration as Rips::graph.
void build(const AnyComplex& complex, const RunPlan& plan,
           const RunContext& context = default_context());
/// Computes as planned. @param plan a plan for this complex. @throws as `persistence`.
Barcode run(const AnyComplex& complex, const RunPlan& plan,
            const RunContext& context = default_context());
/// Frees the input of a Rips filtration once the form is made, unless there are other copies.
Barcode run(AnyComplex&& complex, const RunPlan& plan,
            const RunContext& context = default_context());

/// Facts about a complex that is built as planned.
struct RunFacts {
  std::optional<Index> vertices;          ///< this and all members below: only for Rips
  std::optional<std::size_t> edges;       ///< empty if only points are held
  std::optional<double> threshold;        ///< empty if there is no limit
  std::optional<double> covering_radius;  ///< of the subsample; empty without a subsample
};
/// Builds the data that are still missing. @throws as `build`.
RunFacts facts(const AnyComplex& complex, const RunPlan& plan,
               const RunContext& context = default_context());

/// Compares two barcodes as multisets of (dim, birth, death). @return an empty string if they are
/// equal, otherwise a description of the first bar that only one of them has.
std::string first_difference(const Barcode& a, const Barcode& b);

}  // namespace ph
