// SPDX-License-Identifier: MIT
#pragma once
#include "ph/persistence.hpp"

namespace ph::detail {

/// Decides how the barcode of a Rips filtration will be computed (see `plan`).
///
/// An engine that can judge the input is asked about the input. Any other engine is asked about a
/// graph with the same vertices and no edges. If the best engine works edge by edge, the plan uses
/// the first form of the filtration that the engine accepts and the input can provide. Otherwise,
/// the choice of the engine, the dimension and the collapse depends on the edges. The edges are
/// then made at once, because the engine needs them anyway.
RunPlan plan_rips(const Rips& rips, const Options& options, const RunContext& context);
/// The form that can be planned without edges. Nothing if the plan depends on the edges or the form
/// consists of edges. @throws Error (usage) as `plan` does.
std::optional<RipsForm> form_without_edges(const Rips& rips, const Options& options);
/// The plan as far as it is known without edges. It does not include a collapse.
/// @throws Error (usage) as `plan` does.
RunPlan plan_without_edges(const Rips& rips, const Options& options);
/// Does the same as `build` and `run`, for Rips filtrations.
void build_rips(const Rips& rips, const RunPlan& plan, const RunContext& context);
Barcode run_rips(const Rips& rips, const RunPlan& plan, const RunContext& context);

/// The form for a merge tree, which is the forest if there is one, otherwise the edges.
RipsForm form_of_tree(const Rips& rips);

}  // namespace ph::detail
