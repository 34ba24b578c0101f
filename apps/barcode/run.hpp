// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barcode/arguments/arguments.hpp"
#include "common/run/program.hpp"
#include "common/run/session.hpp"

namespace ph::barcode {

inline constexpr app::Program kProgram{
    "ph-barcode",
    "lower the threshold, the dimension (--max-dim) or the number of points, or raise "
    "--memory-limit"};

/// One input and where its barcode goes.
struct Job {
  std::string input;
  std::string output;
  BarcodeFormat format = BarcodeFormat::csv;
  std::vector<app::Plot> plots = {};
  std::string report = {};  ///< empty: none
};

/// What became of it.
struct Outcome {
  int code = 0;
  std::string summary;  ///< "1024 points in R^3, CSV: 57 bars"
};

/// An input as it was read.
struct NamedData {
  std::string name;  ///< of the input, printable
  ReadResult read;
  std::size_t dropped = 0;  ///< points that were left out
  std::string sha256 = {};  ///< of the bytes that were read; empty: nobody wants to know
};
/// @throws Error as the readers.
NamedData read_input(const Input& input, const Arguments& arguments, const RunContext& context);

/// The files that a run writes. What cannot be created is said before anything is computed.
class Outputs {
 public:
  /// @throws Error (cannot_create).
  explicit Outputs(const Job& job);
  /// Writes and completes all but the report.
  /// @param look of the plots. @param trees those of merge trees, in their order.
  void write(const Barcode& bars, const BarcodeInfo& info, const PlotOptions& look,
             std::span<const std::string> trees, const RunContext& context);
  /// Precondition: the job has one.
  app::Output& report() { return *report_; }

 private:
  const Job& job_;
  std::optional<app::Output> barcode_, report_;
  std::vector<app::Output> plots_;
};

/// How plots look: those of superlevel sets name the values of the image.
PlotOptions look_of(PlotOptions look, bool superlevel);

/// Says which dimensions that plots were asked to show have no bars.
void note_absent_dims(const Barcode& bars, const PlotOptions& look, app::Session& session);

/// "57 bars"
std::string count_of(std::size_t count, std::string_view what);

/// Reads one input, computes its barcode and writes it. A stored barcode is there already.
/// @throws Error.
Outcome run(const Job& job, const Arguments& arguments, app::Session& session);

}  // namespace ph::barcode
