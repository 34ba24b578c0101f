// SPDX-License-Identifier: MIT
#include "ph/persistence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "libph/src/facade/rips_plan.hpp"
#include "ph/detail/facade/adjust.hpp"
#include "ph/detail/facade/alpha_engines.hpp"
#include "ph/detail/facade/choose_engine.hpp"

namespace ph {
namespace {

std::string describe(const Bar& bar) {
  return fmt::format("H{} [{}, {})", bar.dim, bar.birth, bar.death);
}

}  // namespace

Barcode persistence(const Rips& rips, const Options& options, const RunContext& context) {
  return detail::run_rips(rips, detail::plan_rips(rips, options, context), context);
}

Barcode persistence(Rips&& rips, const Options& options, const RunContext& context) {
  const RunPlan plan = detail::plan_rips(rips, options, context);
  detail::build_rips(rips, plan, context);
  if (rips.is_only_copy()) rips.forget_input();
  return detail::run_rips(rips, plan, context);
}

Barcode persistence(const Cubical& cubical, const Options& options, const RunContext& context) {
  return detail::compute(cubical, options, context);
}

Barcode persistence(const ExplicitComplex& complex, const Options& options,
                    const RunContext& context) {
  if (!complex.threshold()) return detail::compute(complex, options, context);
  // A class that outlives the threshold becomes an infinite bar, even if its full bar is short.
  // Short bars are therefore removed only after the cut.
  Options all = options;
  all.min_persistence = std::min(options.min_persistence, 0.0);
  return cut_at(detail::compute(complex, all, context), complex, *complex.threshold(),
                options.min_persistence);
}

Barcode persistence(const Alpha& alpha, const Options& options, const RunContext& context) {
  return detail::compute(alpha, options, context);
}

Barcode persistence(const FilteredGraph& graph, const Options& options, const RunContext& context) {
  return detail::compute(graph, options, context);
}

Barcode persistence(const AnyComplex& complex, const Options& options, const RunContext& context) {
  return std::visit([&](const auto& c) { return persistence(c, options, context); }, complex);
}

std::string first_difference(const Barcode& a, const Barcode& b) {
  const auto before = [](const Bar& x, const Bar& y) {
    return std::tie(x.dim, x.birth, x.death) < std::tie(y.dim, y.birth, y.death);
  };
  // A barcode may be unsorted if the caller has added bars to it.
  const auto sorted = [&](const Barcode& barcode) {
    std::vector<Bar> bars(barcode.begin(), barcode.end());
    std::ranges::sort(bars, before);
    return bars;
  };
  const std::vector<Bar> first = sorted(a), second = sorted(b);
  const auto [x, y] = std::ranges::mismatch(first, second);
  if (x == first.end() && y == second.end()) return "";
  if (y == second.end() || (x != first.end() && before(*x, *y)))
    return describe(*x) + " is in the first barcode only";
  return describe(*y) + " is in the second barcode only";
}

}  // namespace ph
