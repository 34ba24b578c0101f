// SPDX-License-Identifier: MIT
#include "ph/io/save.hpp"

#include <fmt/format.h>

#include <cmath>

#include "ph/detail/metric/metric.hpp"

namespace ph {
namespace {

/// Adds the facts about a complex.
class Describe {
 public:
  Describe(BarcodeInfo& info, const RunFacts& facts, std::optional<RipsForm> form)
      : info_(info), facts_(facts), form_(form) {}

  void operator()(const Rips& rips) const {
    info_.complex = "rips";
    info_.points = rips.size();
    if (const auto points = rips.points()) {
      info_.coordinates = points->cols();
      info_.metric = metric_name(rips.options().distance, rips.options().minkowski_p);
    } else {
      info_.metric = "precomputed";
    }
    info_.approximation = rips.options().approximation;
    info_.threshold = facts_.threshold;
    info_.vertices = facts_.vertices;
    // A spanning forest has only some of the edges of the complex.
    if (form_ != RipsForm::forest) info_.edges = facts_.edges;
    if (facts_.covering_radius)
      info_.subsample = {*facts_.vertices, rips.size(), *facts_.covering_radius};
  }
  void operator()(const Cubical& cubical) const {
    const CubicalImage image = cubical.cubical_image();
    info_.complex = "cubical";
    info_.shape = image.extents;
    info_.construction = image.voxels_are_vertices ? "vertices" : "cells";
    for (std::size_t axis = 0; axis < image.periodic.size(); ++axis)
      if (image.periodic[axis]) info_.periodic.push_back(static_cast<int>(axis));
    info_.superlevel = image.superlevel;
    if (image.limit < std::numeric_limits<double>::max()) info_.threshold = image.limit;
  }
  void operator()(const ExplicitComplex&) const { info_.complex = "explicit"; }
  void operator()(const Alpha& alpha) const {
    info_.complex = name_of(alpha.value_kind());
    info_.points = static_cast<Index>(alpha.vertex_count());
    if (std::isfinite(alpha.threshold())) info_.threshold = alpha.threshold();
    auto& values = info_.alpha.emplace();
    values.squared = alpha.unit() == AlphaOptions::Unit::squared;
    values.hidden.assign(alpha.hidden().begin(), alpha.hidden().end());
  }

 private:
  BarcodeInfo& info_;
  const RunFacts& facts_;
  std::optional<RipsForm> form_;
};

}  // namespace

BarcodeInfo info_of(const AnyComplex& complex, const RunPlan& plan, const RunContext& context) {
  BarcodeInfo info;
  info.program = "libph " PH_VERSION;
  const RunFacts found = facts(complex, plan, context);
  std::visit(Describe(info, found, plan.form), complex);
  info.field = plan.options.field;
  info.max_dim = *plan.options.max_dim;
  info.collapsed = plan.options.collapse == Collapse::on;
  info.min_persistence = plan.options.min_persistence;
  info.min_dim = plan.options.min_dim;
  info.engine = plan.options.engine.name();
  return info;
}

void save(const std::string& path, const Barcode& bars, const BarcodeInfo& info) {
  const auto format = barcode_format_of_path(path);
  if (!format)
    throw Error(ErrorKind::usage,
                fmt::format("{}: found no known extension, expected .csv, .json, .ripser, .pers, "
                            ".dipha or .npy",
                            printable(path)));
  OutputFile file(path);
  write_barcode(file, bars, *format, info);
  file.commit();
}

}  // namespace ph
