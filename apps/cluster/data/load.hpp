// SPDX-License-Identifier: MIT
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "apps/cluster/arguments/arguments.hpp"
#include "apps/common/run/session.hpp"
#include "ph/io/cloud.hpp"

namespace ph::cluster {

/// The points or distances, as they were read.
struct Loaded {
  std::string name;  ///< the name of the input, printable
  ReadResult read;
  Index points = 0;                         ///< number of points, without those that were left out
  Index rows = 0;                           ///< number of points of the input
  std::optional<Cloud> cloud = {};          ///< with all its fields, if the labels become a field
  std::unique_ptr<MemoryClaim> claim = {};  ///< of the memory of the data
};

/// Reads the input, and reports what was read and what was guessed.
/// @throws Error like the readers; Error (bad_data) on anything else than points or distances;
/// Error (usage) on options that do not fit the input.
Loaded load(const Arguments& arguments, app::Session& session);

}  // namespace ph::cluster
