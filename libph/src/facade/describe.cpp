// SPDX-License-Identifier: MIT
#include "ph/detail/facade/describe.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "libph/src/alpha/intervals/intervals.hpp"

namespace ph::detail {
namespace {

/// The source of the births and the weight exponent; empty if all vertices enter at 0.
std::string weights_of(const Rips& rips) {
  const RipsOptions& options = rips.options();
  if (!rips.has_births()) return {};
  std::string source = options.births.empty() ? "diagonal" : "given";
  if (options.dtm_neighbours) source = fmt::format("dtm {}", *options.dtm_neighbours);
  if (options.core_neighbours) source = fmt::format("core {}", *options.core_neighbours);
  return fmt::format("{}, exponent {}", source,
                     name_of(options.weight_exponent.value_or(
                         options.dtm_neighbours ? WeightExponent::one : WeightExponent::infinity)));
}

}  // namespace

BarcodeInfo info_of_task(const Options& options, int max_dim, Engine engine) {
  BarcodeInfo info;
  info.program = "libph " PH_VERSION;
  info.field = options.field;
  info.max_dim = max_dim;
  info.min_persistence = options.min_persistence;
  info.min_dim = options.min_dim;
  info.engine = engine.name();
  return info;
}

void describe(const CubicalImage& image, BarcodeInfo& info) {
  info.complex = "cubical";
  info.shape = image.extents;
  info.construction = image.voxels_are_vertices ? "vertices" : "cells";
  for (std::size_t axis = 0; axis < image.periodic.size(); ++axis)
    // mutant: json-periodic
    if (image.periodic[axis]) info.periodic.push_back(static_cast<int>(axis));
  info.superlevel = image.superlevel;
  if (image.limit < std::numeric_limits<double>::max()) info.threshold = image.limit;
}

void describe(const Cubical& cubical, BarcodeInfo& info) {
  describe(cubical.cubical_image(), info);
}

void describe(const ExplicitComplex&, BarcodeInfo& info) { info.complex = "explicit"; }

void describe(const FilteredGraph&, BarcodeInfo& info) { info.complex = "explicit"; }

void describe(const Alpha& alpha, BarcodeInfo& info) {
  info.complex = name_of(alpha.value_kind());
  info.points = static_cast<Index>(alpha.vertex_count());
  info.coordinates = alpha.cells().sites.coordinates;
  if (std::isfinite(alpha.threshold())) info.threshold = alpha.threshold();
  if (alpha.is_weighted()) info.vertex_weights = "squared radii of balls, given";
  auto& values = info.alpha.emplace();
  values.squared = alpha.unit() == AlphaOptions::Unit::squared;
  values.period = alpha.cells().period;
  values.hidden.assign(alpha.hidden().begin(), alpha.hidden().end());
}

void describe(const Rips& rips, const RunPlan& plan, BarcodeInfo& info, const RunContext& context) {
  const RunFacts found = facts(rips, plan, context);
  info.complex = "rips";
  info.points = rips.size();
  info.coordinates = rips.coordinates();
  info.metric = rips.metric();
  info.vertex_weights = weights_of(rips);
  info.approximation = rips.options().approximation;
  info.threshold = found.threshold;
  info.vertices = found.vertices;
  // A spanning forest has only some of the edges of the complex.
  if (plan.form != RipsForm::forest) info.edges = found.edges;
  info.collapsed = plan.options.collapse == Collapse::on;
  if (found.covering_radius)
    info.subsample = {*found.vertices, rips.size(), *found.covering_radius};
}

}  // namespace ph::detail
