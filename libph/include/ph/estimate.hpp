// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "ph/persistence.hpp"

namespace ph {

/// How `persistence` will go about a task.
struct RunPlan {
  Engine engine = Engine::automatic;  ///< the engine that will run
  std::string reason;                 ///< why it was chosen, one phrase
  bool collapses = false;             ///< whether edges are collapsed first
  std::string collapse_reason;        ///< why, or why not, one phrase; empty: no Rips complex
  int max_dim = 0;                    ///< highest homology dimension
};
/// Decides as `persistence` does. Computes nothing but a sample of the edges where that decides
/// whether they are collapsed. @throws as `persistence`.
RunPlan plan(const AnyComplex& complex, const Options& options = {},
             const RunContext& context = default_context());

/// The options with what the plan decided, so that it is not decided again.
Options with_plan(const Options& options, const RunPlan& plan);

/// What a computation will take, before it is done.
struct Estimate : RunPlan {
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
/// a few thousand, and collapses edges where they are few. @throws as `persistence`.
Estimate estimate(const AnyComplex& complex, const Options& options = {},
                  const RunContext& context = default_context());

}  // namespace ph
