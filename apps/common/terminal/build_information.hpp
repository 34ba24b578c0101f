// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace ph::app {

/// The part of --version --verbose that all programs share: compiler, build, libraries; one per
/// line.
std::string build_information();

/// "ph-barcode 0.1.0"
std::string program_and_version(const std::string& program);

}  // namespace ph::app
