// SPDX-License-Identifier: MIT
#include "facade/all_engines.hpp"

namespace ph::detail {

template Barcode compute<AllEngines>(const ExplicitComplex&, const Options&, const RunContext&);
template Barcode compute<AllEngines>(const FilteredGraph&, const Options&, const RunContext&);

}  // namespace ph::detail
