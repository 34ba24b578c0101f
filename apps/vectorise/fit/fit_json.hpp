// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "ph/detail/io/reader.hpp"
#include "vectorise/fit/fit.hpp"

namespace ph::vectorise {

/// What `--fit` writes. @param dropped bars that were left out when it was made.
std::string fit_json(const Fit& fit, std::size_t dropped);

/// What `--fitted` reads. @throws Error (bad_data) on anything else.
Fit read_fit(const Input& input);

}  // namespace ph::vectorise
