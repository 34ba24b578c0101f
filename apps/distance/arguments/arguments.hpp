// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/common/arguments/command_line.hpp"
#include "apps/common/arguments/option_scope.hpp"
#include "apps/common/distances/distance_choice.hpp"
#include "apps/common/manual/manual.hpp"
#include "ph/significance.hpp"

namespace ph::distance_program {

enum class OutputFormat { text, csv, json };

/// Everything that the command line states.
struct Arguments {
  app::CommonOptions common;
  std::vector<std::string> inputs;
  std::vector<int> dims;  // if empty, all dimensions
  app::DistanceChoice distance;

  std::optional<std::string> output;
  std::optional<OutputFormat> output_format;
  std::string matching;  // a path; empty if there is none
  std::string matrix;    // a path; empty if there is none

  std::string groups;  // a path; empty if there is none
  PermutationOptions test;
  // The given options that have no effect in some situations.
  std::vector<app::GivenOption> given;

  std::string output_path() const { return output.value_or("-"); }
  // mutant: matrix-table
  /// True if distances or tests are written. A matrix replaces them, unless they are requested
  /// explicitly.
  bool writes_table() const { return matrix.empty() || !groups.empty() || output || output_format; }
  OutputFormat table_format() const;
};

/// Parses the command line. @return the answer to --help or --version, if one of these was given.
/// @throws Error (usage).
std::optional<std::string> parse_arguments(int argc, const char* const* argv, Arguments& arguments);

/// The manual of ph-distance.
const app::Manual& manual();

}  // namespace ph::distance_program

namespace ph {

template <>
inline constexpr std::array names_of<distance_program::OutputFormat>{
    Named{distance_program::OutputFormat::text, "text"},
    Named{distance_program::OutputFormat::csv, "csv"},
    Named{distance_program::OutputFormat::json, "json"},
};

}  // namespace ph
