// SPDX-License-Identifier: MIT
#include "facade/collapse_choice.hpp"

#include <fmt/format.h>

#include "ph/detail/rips/rips_graph.hpp"
#include "rips/collapse/edge_collapse.hpp"

namespace ph::detail {
namespace {

// Measured, H2 to H7: the more edges are dominated, the more is gained, up to some hundred times;
// at two thirds it is still half of the time and of the memory. Below, on spheres of higher
// dimension and on distances that are no metric, nearly all edges are kept and what the collapse
// takes is lost.
constexpr double kWorthwhileShare = 0.6;

/// Why a collapse would spoil what is asked for; empty if it would not.
std::string_view obstacle(const Options& options) {
  if (options.min_persistence < 0) return "bars of length zero are asked for";
  if (options.representatives == Representatives::cocycles)
    return "cocycles are asked for, and those of fewer edges say nothing of the others";
  return {};
}

/// Why a collapse is not worth a sample; empty if it may be.
std::string_view no_need(const EngineFacts& engine) {
  if (engine.goes_by_edges) return "the engine goes by edges alone";
  if (engine.is_oracle) return "the reference engine takes the complex as it is";
  return {};
}

}  // namespace

int rips_max_dim(const Rips& rips, const Options& options) {
  const bool only_components = rips.has_only_components();
  check(options);
  const int max_dim = options.max_dim.value_or(only_components ? 0 : 1);
  if (only_components && max_dim > 0) {
    throw Error(ErrorKind::usage,
                fmt::format("highest dimension: found {}, expected 0: of this Rips filtration only "
                            "the components are there",
                            max_dim));
  }
  if (!options.max_dim && options.min_dim > max_dim) {
    throw Error(ErrorKind::usage,
                fmt::format("lowest dimension: found {}, expected at most {}, the highest unless "
                            "another is given",
                            options.min_dim, max_dim));
  }
  if (rips.has_only_points()) {
    const std::string_view obstacle = obstacle_to_points_alone(options, max_dim);
    if (!obstacle.empty())
      throw Error(ErrorKind::usage,
                  fmt::format("of this Rips filtration only the points are there, which is enough "
                              "for {}",
                              obstacle));
  }
  return max_dim;
}

CollapseChoice choose_collapse(const Rips& rips, const Options& options,
                               const RunContext& context) {
  // Engines are told apart by the kind of a filtration only, not by the size of its cells.
  const RipsFiltration<RipsLayout::sparse, 1> filtration(rips.graph());
  const auto choice =
      choose_engine(filtration, options.engine, task_of(options, options.max_dim.value_or(1)));
  const auto decide = [&](bool collapses, std::string_view reason) {
    return CollapseChoice{collapses, std::string(reason), choice.engine->id, choice.reason};
  };
  if (options.collapse == Collapse::off) return decide(false, "asked for");
  const std::string_view spoilt = obstacle(options);
  if (options.collapse == Collapse::on) {
    if (!spoilt.empty())
      throw Error(ErrorKind::usage, fmt::format("edge collapse is not possible: {}", spoilt));
    return decide(true, "asked for");
  }
  if (!spoilt.empty()) return decide(false, spoilt);
  if (const std::string_view reason = no_need(*choice.engine); !reason.empty())
    return decide(false, reason);
  const double share = dominated_share(rips.graph(), context);
  return decide(share >= kWorthwhileShare,
                fmt::format("{:.0f} % of a sample of the edges are dominated", 100 * share));
}

}  // namespace ph::detail
