// SPDX-License-Identifier: MIT
#pragma once
#include "ph/alpha.hpp"
#include "ph/detail/core/barcode_builder.hpp"
#include "ph/detail/core/field.hpp"

namespace ph::alpha {

/// The bars of an alpha complex that have a positive length.
template <Field K>
void pair_simplices(const Alpha& alpha, const K& field, BarcodeBuilder<Alpha>& bars,
                    const RunContext& context);

extern template void pair_simplices(const Alpha&, const Z2&, BarcodeBuilder<Alpha>&,
                                    const RunContext&);
extern template void pair_simplices(const Alpha&, const Zp&, BarcodeBuilder<Alpha>&,
                                    const RunContext&);

}  // namespace ph::alpha
