// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "ph/persistence.hpp"

namespace ph {

/// A forecast of a computation's time and memory.
struct Estimate : RunPlan {
  /// Facts about the complex; empty if its edges were not made.
  RunFacts built;
  /// Numbers of cells by dimension, as far as the engine lists them: the engines `edge-links` and
  /// `union-find` list only vertices and edges; `gradient` and `beta-skeleton` list no cells. If
  /// there is a collapse, the cells are counted after it, except with `cells_at_most`.
  std::vector<double> cells;
  /// Cells of dimensions below this one are counted; the numbers of all other cells are estimated
  /// from a sample, usually within a few per cent.
  int counted_dims = 0;
  /// True if `cells` are upper bounds, counted before a collapse that would take too long for an
  /// estimate.
  bool cells_at_most = false;
  double bytes_held = 0;  ///< memory that the complex already takes
  double bytes_low = 0;   ///< lower bound of the memory of the complex and the computation
  double bytes_high = 0;  ///< upper bound of that memory; see docs/explanation/engines/estimates.md
};
/// Forecasts a computation in a fraction of its time and memory: it counts up to a million cells,
/// or a few thousand samples, and collapses edges if there are few. It makes the parts of the
/// complex that the plan needs, and these stay in the complex. If the edges of a Rips filtration
/// would not fit into the memory limit or the machine's memory, they are not made; their number is
/// estimated from a sample of pairs of points.
/// @throws as `persistence`, except when only these edges need too much memory.
Estimate estimate(const AnyComplex& complex, const Options& options = {},
                  const RunContext& context = default_context());

/// Changes that make a computation fit into the memory limit, and the memory that it then takes.
struct Fit {
  std::vector<Remedy> changes;           ///< to be made together
  double bytes_low = 0, bytes_high = 0;  ///< as in Estimate
};
/// Looks for changes that make a computation fit into the memory limit of `context`, after the
/// computation ran out of memory. It checks each change with an estimate; for a Rips filtration it
/// also makes the planned form within the memory limit. It tries another engine, no representatives
/// and lower dimensions; for a Rips filtration it then tries a subsample, a lower threshold and an
/// edge collapse.
/// @return at most three ways to fit; the search stops after a few CPU seconds.
/// @throws Error (cancelled) on a stop request.
std::vector<Fit> what_fits(const AnyComplex& complex, const Options& options,
                           const RunContext& context);

}  // namespace ph
