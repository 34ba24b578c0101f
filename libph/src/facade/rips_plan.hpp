// SPDX-License-Identifier: MIT
#pragma once
#include "ph/persistence.hpp"

namespace ph::detail {

/// How the barcode of a Rips filtration will be computed: see `plan`.
///
/// Each engine is asked about the input, as far as it says anything about it, else about the edges
/// of a graph that has none. If the engine that suits best goes by edges, the form is the first one
/// that it takes and the input can give. Otherwise the engine, the dimension and the collapse
/// depend on the edges, which that engine needs anyway: they are made.
RunPlan plan_rips(const Rips& rips, const Options& options, const RunContext& context);
/// The form that is planned without an edge being made; nothing where the edges have a say or are
/// the form. @throws Error (usage) as `plan`.
std::optional<RipsForm> form_without_edges(const Rips& rips, const Options& options);
/// The plan as far as it is known without an edge: no collapse is looked at.
/// @throws Error (usage) as `plan`.
RunPlan plan_without_edges(const Rips& rips, const Options& options);
/// As `build` and `run`.
void build_rips(const Rips& rips, const RunPlan& plan, const RunContext& context);
Barcode run_rips(const Rips& rips, const RunPlan& plan, const RunContext& context);

/// The form for a merge tree: the forest, or the edges where there is none.
RipsForm form_of_tree(const Rips& rips);

}  // namespace ph::detail
