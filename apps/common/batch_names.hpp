// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

namespace ph::app {

/// Names for the outputs of inputs: the shortest that only one of them has, without extension, with
/// it, or with folders. Two inputs may still have the same: the same file named twice.
std::vector<std::string> output_names(const std::vector<std::string>& inputs);

bool is_folder(const std::string& path);

/// Fine if it is there already. @throws Error (cannot_create).
void create_folder(const std::string& path);

}  // namespace ph::app
