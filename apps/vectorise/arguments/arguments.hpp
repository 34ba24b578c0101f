// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/common/arguments/command_line.hpp"
#include "apps/common/arguments/option_scope.hpp"
#include "apps/common/manual/manual.hpp"
#include "apps/vectorise/fit/fit.hpp"
#include "ph/io/read.hpp"

namespace ph::vectorise {

/// The value LO,HI,N, or N alone. With N alone, the range is fitted.
struct AxisArgument {
  std::optional<std::array<double, 2>> range;
  std::size_t count = 0;
};

enum class InputKind { automatic, barcode, image };
enum class OutputFormat { csv, npy };

/// Everything that the command line states.
struct Arguments {
  app::CommonOptions common;
  std::vector<std::string> inputs;
  InputKind format = InputKind::automatic;
  NanPolicy nan = NanPolicy::error;
  CubicalOptions cubical;

  Kind kind = Kind::statistics;
  std::vector<int> dims;  // if empty, all dimensions
  std::optional<InfiniteRule> infinite;
  std::optional<AxisArgument> grid, length_grid;
  std::size_t layers = 5;
  std::optional<std::size_t> count;
  std::optional<double> sigma;
  double power = 1;
  bool normalised = false;
  AtolOptions atol;

  std::string output = "-";
  std::optional<OutputFormat> output_format;
  std::string fit;     // a path; empty if there is none
  std::string fitted;  // a path; empty if there is none
  // The given options that have no effect for some kinds of vectors.
  std::vector<app::GivenOption> given;

  /// True if an option or an extension names the format. Otherwise the format is csv.
  bool names_format() const;
  OutputFormat written_format() const;
};

/// Parses the command line. @return the answer to --help or --version, if one of these was given.
/// @throws Error (usage).
std::optional<std::string> parse_arguments(int argc, const char* const* argv, Arguments& arguments);

/// @throws Error (usage) on an option that has no effect for this kind.
void require_kind(const Arguments& arguments, Kind kind);

/// The manual of ph-vectorise.
const app::Manual& manual();

}  // namespace ph::vectorise

namespace ph {

template <>
inline constexpr std::array names_of<vectorise::InputKind>{
    Named{vectorise::InputKind::automatic, "auto"},
    Named{vectorise::InputKind::barcode, "barcode"},
    Named{vectorise::InputKind::image, "image"},
};

template <>
inline constexpr std::array names_of<vectorise::OutputFormat>{
    Named{vectorise::OutputFormat::csv, "csv"},
    Named{vectorise::OutputFormat::npy, "npy"},
};

}  // namespace ph
