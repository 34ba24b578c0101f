// SPDX-License-Identifier: MIT
#pragma once
// For a complex of your own: the engines for any filtration, as templates. Costly to compile;
// whoever uses the complexes of libph needs persistence.hpp only.
#include "ph/detail/choose_engine.hpp"

namespace ph {

/// The barcode of a complex of your own: anything that models Filtration. @throws as the others.
template <Filtration F>
Barcode persistence(const F& filtration, const Options& options = {},
                    const RunContext& context = default_context()) {
  return detail::compute<GenericEngines>(filtration, options, context);
}

}  // namespace ph
