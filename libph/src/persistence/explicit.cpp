// SPDX-License-Identifier: MIT
#include "ph/custom.hpp"

namespace ph {

template Barcode persistence<ExplicitComplex>(const ExplicitComplex&, const Options&,
                                              const RunContext&);
template Barcode persistence<FilteredGraph>(const FilteredGraph&, const Options&,
                                            const RunContext&);

}  // namespace ph
