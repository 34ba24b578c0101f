// SPDX-License-Identifier: MIT
#include "barcode/output/h0_tree.hpp"

#include "ph/detail/report/shown_tree.hpp"
#include "ph/detail/rips/rips_graph.hpp"

namespace ph::barcode {

std::optional<MergeTree> whole_tree(const BuiltComplex& built, const NamedData& data,
                                    const Arguments& arguments, const RunContext& context) {
  if (built.cut || built.empty) return std::nullopt;
  const auto* rips = std::get_if<Rips>(&built.complex);
  if (!rips) return report::whole_tree(built.complex, context);
  if (rips->graph().has_names() && arguments.options.min_persistence < 0) return std::nullopt;
  if (built.subsample || arguments.rips.approximation) return std::nullopt;
  // The complex that was computed may hold all its edges and may have merged equal points; this one
  // is a spanning forest of all points.
  Arguments again = arguments;
  again.options.min_dim = again.options.max_dim.emplace(0);
  again.options.engine = Engine::automatic;
  again.options.min_persistence = -1;
  again.options.representatives = Representatives::none;
  again.check = false;
  again.threshold = built.threshold;
  const BuiltComplex forest = build_complex(data.read, data.name, data.dropped, again, context);
  return report::whole_tree(forest.complex, context);
}

}  // namespace ph::barcode
