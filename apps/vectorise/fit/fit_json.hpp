// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "ph/detail/io/reader.hpp"
#include "vectorise/fit/fit.hpp"

namespace ph::vectorise {

/// The content that `--fit` writes. @param dropped number of bars that were left out of the fit.
std::string fit_json(const Fit& fit, std::size_t dropped);

/// Parses a file for `--fitted`. @throws Error (bad_data) on anything else.
Fit read_fit(const Input& input);

}  // namespace ph::vectorise
