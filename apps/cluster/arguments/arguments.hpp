// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/common/arguments/command_line.hpp"
#include "apps/common/arguments/option_scope.hpp"
#include "apps/common/manual/manual.hpp"
#include "ph/cluster_tree.hpp"
#include "ph/io/read.hpp"
#include "ph/rips.hpp"

namespace ph::cluster {

/// The formats of the labels. With pcd and ply, they are a field of the cloud that was read.
enum class OutputFormat { csv, json, npy, pcd, ply };

/// Everything that the command line states.
struct Arguments {
  app::CommonOptions common;
  std::vector<std::string> inputs;  ///< exactly one
  Format format = Format::automatic;
  ReadOptions reading;
  RipsOptions rips;  ///< the distance of points

  Index min_size = 5;
  std::optional<Index> neighbours;
  ClusterOptions choice;

  std::string output = "-";
  std::optional<OutputFormat> output_format;
  bool scores = false;
  std::string tree;  ///< a path; empty if there is none
  bool dry_run = false;
  /// The given options that have no effect in some situations.
  std::vector<app::GivenOption> given;

  const std::string& input() const { return inputs.front(); }
  /// True if the diagonal of a matrix states when points enter. Core distances are then not used.
  bool has_births() const { return reading.diagonal == Diagonal::births; }
  /// The format that an option or the extension names; empty if none does.
  std::optional<OutputFormat> named_format() const;
  OutputFormat written_format() const { return named_format().value_or(OutputFormat::csv); }
  bool writes_cloud() const {
    return written_format() == OutputFormat::pcd || written_format() == OutputFormat::ply;
  }
};

/// Parses the command line. @return the answer to --help or --version, if one of these was given.
/// @throws Error (usage).
std::optional<std::string> parse_arguments(int argc, const char* const* argv, Arguments& arguments);

/// The formats in which points and distances may be, with Format::automatic first.
std::span<const Format> input_formats();

/// The manual of ph-cluster.
const app::Manual& manual();

}  // namespace ph::cluster

namespace ph {

template <>
inline constexpr std::array names_of<cluster::OutputFormat>{
    Named{cluster::OutputFormat::csv, "csv"}, Named{cluster::OutputFormat::json, "json"},
    Named{cluster::OutputFormat::npy, "npy"}, Named{cluster::OutputFormat::pcd, "pcd"},
    Named{cluster::OutputFormat::ply, "ply"},
};

}  // namespace ph
