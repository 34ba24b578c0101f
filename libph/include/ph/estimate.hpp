// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "ph/persistence.hpp"

namespace ph {

/// What a computation will take, before it is done.
struct Estimate : RunPlan {
  /// What the complex turned out to be; empty where the edges were not made.
  RunFacts built;
  /// Cells by dimension, as far as the engine lists them: the sweep of edge links and union-find
  /// list vertices and edges, no more, `gradient` none. After the collapse, if there is one.
  std::vector<double> cells;
  /// The dimensions below it are counted; above, cells are estimated from a sample of them, as a
  /// rule within a few percent.
  int counted_dims = 0;
  /// Whether the cells are those before a collapse that was too long to do for an estimate.
  bool cells_at_most = false;
  double bytes_held = 0;  ///< memory that the complex takes already
  double bytes_low = 0;   ///< memory of the complex and the computation: at least …
  double bytes_high = 0;  ///< … and at most, as foreseen: see docs/explanation/engines/estimates.md
};
/// Takes a fraction of the computation's time and memory: counts up to a million cells or samples
/// a few thousand, and collapses edges where they are few. It makes what the plan needs, which
/// stays in the complex. Edges of a Rips filtration that do not fit the memory limit, or the
/// machine, are not made: a sample of the pairs of points says about how many there are.
/// @throws as `persistence`, but for the memory of those edges.
Estimate estimate(const AnyComplex& complex, const Options& options = {},
                  const RunContext& context = default_context());

/// Changes of a computation with which it fits, and what it then takes.
struct Fit {
  std::vector<Remedy> changes;           ///< to be made together
  double bytes_low = 0, bytes_high = 0;  ///< as in Estimate
};
/// Looks for changes with which a computation that ran out of memory fits the limit of `context`:
/// an estimate of each says so, and the form of a Rips filtration was made within it. Tries another
/// engine, no representatives, lower dimensions, then of a Rips filtration a subsample, a lower
/// threshold and an edge collapse.
/// @return at most three; it stops looking after a few CPU seconds.
/// @throws Error (cancelled) on a stop request.
std::vector<Fit> what_fits(const AnyComplex& complex, const Options& options,
                           const RunContext& context);

}  // namespace ph
