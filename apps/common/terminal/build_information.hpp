// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace ph::app {

/// The part of --version --verbose that all programs share. It states the compiler, the build and
/// the libraries, one per line.
std::string build_information();

/// Returns a text such as "ph-barcode 0.1.0".
std::string program_and_version(const std::string& program);

}  // namespace ph::app
