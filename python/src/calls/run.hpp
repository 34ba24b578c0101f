// SPDX-License-Identifier: MIT
#pragma once
#include <pybind11/pybind11.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "ph/error.hpp"
#include "ph/run_context.hpp"

namespace ph::python {

namespace py = pybind11;

/// The options that limit, observe and stop a computation. They hold Python objects, so they must
/// be made while the GIL is held.
struct RunOptions {
  int threads = 0;  ///< 0 means one per core
  /// In bytes; if none, nine tenths of the memory of the machine, minus the memory of this process.
  std::optional<std::size_t> memory_limit;
  std::optional<double> timeout;     ///< in seconds
  py::object progress = py::none();  ///< called with (stage, done, total)
  /// The computation stops once `is_set()` of this object returns true.
  py::object stop = py::none();
  int slab_layers = 0;  ///< see RunContext
  /// Bytes of copies of the input, which count towards `memory_limit`.
  std::size_t copied = 0;

  /// True if the computation must be observed, even if it is short.
  bool is_watched() const { return timeout || !progress.is_none() || !stop.is_none(); }
};

/// The time limit was exceeded.
class Timeout : public Error {
 public:
  explicit Timeout(double seconds);
};

/// The environment of a computation. An object that keeps memory of the budget after the run must
/// also keep this environment.
using SharedContext = std::shared_ptr<const RunContext>;

/// Runs `task(context)` without the GIL.
///
/// The task runs on its own thread, which has ended when this function returns. During the task,
/// the caller's thread checks every 20 ms for signals (such as Ctrl-C, because Python handles
/// signals only on its main thread), progress, a stop and the time limit. An exception from a
/// signal handler or a callback stops the computation and is rethrown. Tasks that are certainly
/// short run on the caller's thread, because a thread takes longer to start than they take. If the
/// system has no thread left, all tasks run on the caller's thread. Tasks on the caller's thread
/// check at their start, and whenever they report progress.
/// @param is_short true if the task takes milliseconds at most.
/// @throws the exceptions of `task`; Timeout; Error (cancelled); py::error_already_set.
void run_task(const RunOptions& options, bool is_short,
              const std::function<void(const SharedContext&)>& task);

/// Does the same for tasks with a result. The result must not contain Python objects.
template <class Compute>
auto run(const RunOptions& options, bool is_short, const Compute& compute) {
  std::optional<std::invoke_result_t<Compute, const RunContext&>> result;
  run_task(options, is_short,
           [&](const SharedContext& context) { result.emplace(compute(*context)); });
  return std::move(*result);
}

}  // namespace ph::python
