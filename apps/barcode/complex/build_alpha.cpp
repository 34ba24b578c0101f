// SPDX-License-Identifier: MIT
#include "apps/barcode/complex/build_complex.hpp"

#include <fmt/format.h>

#include "apps/common/system/process.hpp"

namespace ph::barcode {
namespace {

AlphaOptions::Value value_of(ComplexKind kind) {
  if (kind == ComplexKind::delaunay_cech) return AlphaOptions::Value::delaunay_cech;
  if (kind == ComplexKind::delaunay_rips) return AlphaOptions::Value::delaunay_rips;
  return AlphaOptions::Value::alpha;
}

}  // namespace

BuiltComplex build_alpha(const Points& points, std::vector<double> weights,
                         const std::vector<Index>& ids, const std::string& name, const Job& job,
                         const RunContext& context) {
  const std::string_view kind = complex_names()[static_cast<std::size_t>(job.question.complex)];
  constexpr Index most = 3;
  if (points.cols() > most)
    throw Error(ErrorKind::usage, fmt::format("--complex {}: found points of R^{}, expected R^1 to "
                                              "R^{}; rips takes points of any dimension",
                                              kind, points.cols(), most));
  AlphaOptions options;
  options.value = value_of(job.question.complex);
  options.unit = *job.question.alpha_unit;
  options.weights = std::move(weights);
  options.period = job.question.period;
  if (options.period.size() == 1)
    options.period.assign(static_cast<std::size_t>(points.cols()), options.period[0]);
  if (!options.period.empty() && std::ssize(options.period) != points.cols())
    throw Error(ErrorKind::usage,
                fmt::format("--period: found {} numbers for {} axes, expected one for all, or one "
                            "per axis",
                            options.period.size(), points.cols()));
  options.threshold = job.question.threshold.value_or(kInfinity);
  if (options.weights.empty() && options.threshold < 0)
    throw Error(ErrorKind::usage, fmt::format("--threshold: found {}, expected a radius or its "
                                              "square, at least 0",
                                              options.threshold));
  try {
    const bool is_weighted = !options.weights.empty();
    const Alpha alpha(points, options, context);
    // A triangulation consists of many blocks, each of which is too small to be returned to the
    // system by itself.
    app::give_back_freed_memory();
    BuiltComplex built{alpha, std::string(kind), job.question.threshold, points.rows() == 0};
    if (is_weighted) built.vertex_weights = "squared radii of balls, from a file";
    auto& values = built.alpha.emplace();
    values.squared = options.unit == AlphaOptions::Unit::squared;
    if (alpha.is_periodic()) values.period = options.period;
    for (const std::uint32_t v : alpha.hidden())
      values.hidden.push_back(ids.empty() ? Index{v} : ids[v]);
    return built;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_data) throw;
    throw Error(error.kind(), fmt::format("{}: {}", mark_place(name), error.marked()));
  }
}

}  // namespace ph::barcode
