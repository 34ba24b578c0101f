// SPDX-License-Identifier: MIT
#pragma once
// This header declares the loops of a part of a volume, which live across several calls.
#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "ph/parts/image_loops.hpp"
#include "python/src/calls/run.hpp"
#include "python/src/results/bars.hpp"

namespace ph::python {

/// The highest dimension of the bars of an image.
int highest_dim(const ImagePart& part);

/// A part of a volume with the voxels of its array, until ImageLoops takes them.
struct HeldPart {
  HeldPart(SharedContext of, ImagePart its_part)
      : context(std::move(of)), part(std::move(its_part)) {}

  py::object recipe;  ///< keeps the array alive
  SharedContext context;
  ImagePart part;
};

/// ImageLoops with its own budget. Each call can be stopped. Calls from several threads run one
/// after another. After a call has failed, the state is lost, and all calls that need it fail.
class RunningLoops {
 public:
  /// Takes the voxels. This constructor and the destructor need the GIL.
  RunningLoops(HeldPart& held, std::int64_t field, const RunOptions& options);

  int part() const { return loops_->part(); }
  void begin(std::span<const std::byte> told, const RunOptions& options);
  void receive(std::span<const std::byte> message);
  bool is_idle();
  void work(std::size_t most, const RunOptions& options);
  std::vector<ImageLoops::Message> take_messages();
  Bars bars(const RunOptions& options);
  ImageLoops::Traffic traffic();

 private:
  template <class Use>
  auto locked(Use&& use);
  template <class Use>
  auto changed(const RunContext& call, Use&& use);
  void require_sound() const;

  py::object recipe_;
  SharedContext of_part_;
  int max_dim_;
  std::int64_t field_;
  RunContext context_;
  std::optional<ImageLoops> loops_;

  std::mutex mutex_;  // protects the members below and the loops
  bool has_begun_ = false, is_broken_ = false;
  // True if there may be messages that nobody has taken.
  bool has_news_ = false;
};

}  // namespace ph::python
