// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/barcode/arguments/arguments.hpp"
#include "apps/barcode/complex/build_complex.hpp"
#include "apps/barcode/complex/read_input.hpp"
#include "apps/barcode/job/job.hpp"
#include "apps/common/run/session.hpp"

namespace ph::barcode {

/// Measures the stages of a run.
class Stopwatch {
 public:
  void lap(std::string stage) {
    const auto now = std::chrono::steady_clock::now();
    laps_.emplace_back(std::move(stage), std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }
  const std::vector<std::pair<std::string, double>>& laps() const { return laps_; }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> laps_;
};

/// Everything that is kept from an input: the complex, and the facts that results state about it.
struct Loaded {
  BuiltComplex built;
  std::string name;  ///< the name of the input, printable
  std::string description;
  std::vector<Index> point_ids;
  std::optional<Index> points;  ///< the number of points; empty for data without points
  std::optional<Index> coordinates;
  std::optional<Affine> affine;  ///< of an image, as its file states it
  bool nan_dropped = false;      ///< points or voxels with NaN are left out, as requested
  // The data that the complex refers to or that a report shows. Their memory is counted in the
  // budget.
  std::optional<NamedData> data = {};
  std::unique_ptr<MemoryClaim> claim = {};
};

/// Reads an input, builds its complex, and reports what was read and what was guessed.
/// @throws Error like the readers and complexes.
Loaded load(const Job& job, std::optional<Input>& input, app::Session& session, Stopwatch& watch);

}  // namespace ph::barcode
