// SPDX-License-Identifier: MIT
#include "facade/collapse_choice.hpp"
#include "ph/detail/rips/rips_filtration.hpp"
#include "ph/estimate.hpp"

namespace ph {
namespace {

template <Filtration F>
RunPlan plan_of(const detail::Plan<F>& plan) {
  RunPlan result;
  result.engine = plan.choice.engine->id;
  result.reason = plan.choice.reason;
  result.max_dim = plan.max_dim;
  return result;
}

template <class Complex>
RunPlan plan_one(const Complex& complex, const Options& options, const RunContext&) {
  return plan_of(detail::plan_for(complex, options));
}
RunPlan plan_one(const Rips& rips, const Options& options, const RunContext& context) {
  Options rips_options = options;
  rips_options.max_dim = detail::rips_max_dim(rips, options);
  const detail::CollapseChoice choice = detail::choose_collapse(rips, rips_options, context);
  rips_options.collapse = Collapse::off;  // done before or not at all
  RunPlan result;
  if (choice.collapses) {
    result.engine = choice.engine;
    result.reason = choice.engine_reason;
    result.max_dim = *rips_options.max_dim;  // the top dimension is not known before the collapse
  } else {
    result = rips.with_filtration(*rips_options.max_dim, [&](const auto& f) {
      return plan_of(detail::plan_for(f, rips_options));
    });
  }
  if (rips.has_only_components()) result.reason += "; a spanning forest knows them";
  result.collapses = choice.collapses;
  result.collapse_reason = choice.reason;
  return result;
}

}  // namespace

RunPlan plan(const AnyComplex& complex, const Options& options, const RunContext& context) {
  return std::visit([&](const auto& c) { return plan_one(c, options, context); }, complex);
}

Options with_plan(const Options& options, const RunPlan& plan) {
  Options settled = options;
  settled.engine = plan.engine;
  settled.max_dim = plan.max_dim;
  settled.collapse = plan.collapses ? Collapse::on : Collapse::off;
  return settled;
}

}  // namespace ph
