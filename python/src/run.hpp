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

/// How a computation is bounded, watched and stopped. Made with the GIL, as all that holds objects.
struct RunOptions {
  int threads = 0;                          ///< 0: one for each core
  std::optional<std::size_t> memory_limit;  ///< bytes; none: what the machine has left
  std::optional<double> timeout;            ///< seconds
  py::object progress = py::none();         ///< called with (stage, done, total)
  py::object stop = py::none();             ///< stops once `is_set()` of it says so
  int slab_layers = 0;                      ///< see RunContext

  /// Whether somebody has to look after the computation, however short it is.
  bool is_watched() const { return timeout || !progress.is_none() || !stop.is_none(); }
};

/// The time was not enough.
class Timeout : public Error {
 public:
  explicit Timeout(double seconds);
};

/// What a computation runs in. What keeps memory of the budget beyond the run keeps this, too.
using SharedContext = std::shared_ptr<const RunContext>;

/// Runs `task(context)` without the GIL.
///
/// It runs on a thread of its own, which is gone when this returns, while the caller's thread looks
/// every 20 ms for signals (Ctrl-C; Python takes them on its main thread only), progress, a stop
/// and the end of the time. What a signal handler or a callback throws stops the computation and is
/// thrown on. What is certainly short runs on the caller's thread. So does all where the system
/// gives no thread; it then looks where it says how far it is.
/// @param is_short whether it takes milliseconds at most.
/// @throws what `task` throws; Timeout; Error (cancelled); py::error_already_set.
void run_task(const RunOptions& options, bool is_short,
              const std::function<void(const SharedContext&)>& task);

/// The same for what has a result, which must hold no object of Python.
template <class Compute>
auto run(const RunOptions& options, bool is_short, const Compute& compute) {
  std::optional<std::invoke_result_t<Compute, const RunContext&>> result;
  run_task(options, is_short,
           [&](const SharedContext& context) { result.emplace(compute(*context)); });
  return std::move(*result);
}

}  // namespace ph::python
