// SPDX-License-Identifier: MIT
#include "ph/run_context.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <stop_token>
#include <utility>

#include "ph/detail/core/parallel.hpp"

namespace ph {
namespace {

/// Keeps the error of the first of the inputs that failed.
class FirstError {
 public:
  void keep(std::size_t input, std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (error_ && input_ < input) return;
    input_ = input;
    error_ = std::move(error);
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::size_t input_ = 0;
  std::exception_ptr error_;
};

}  // namespace

void for_each_input(std::size_t count, const RunContext& context,
                    const std::function<void(std::size_t, const RunContext&)>& work) {
  std::stop_source stop;
  const std::stop_callback as_asked(context.stop, [&] { stop.request_stop(); });
  RunContext of_input(context.memory);  // `work` may claim memory of `context` for its results
  of_input.stop = stop.get_token();
  of_input.memory.set_limit(context.memory.left());
  of_input.threads = static_cast<int>(
      std::max<std::size_t>(1, thread_count(context) / std::max<std::size_t>(1, count)));
  of_input.slab_layers = context.slab_layers;
  FirstError first_error;
  const auto failed = [&](std::size_t input, std::exception_ptr error) {
    first_error.keep(input, std::move(error));
    stop.request_stop();
  };
  const auto compute = [&](std::size_t i, std::size_t) {
    try {
      work(i, of_input);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::cancelled)
        failed(i, std::make_exception_ptr(InputError(i, error)));
      throw;
    } catch (...) {
      failed(i, std::current_exception());
      throw;
    }
  };
  try {
    for_each_piece("inputs", count, 1, context, compute);
  } catch (...) {
    first_error.rethrow();
    throw;
  }
}

}  // namespace ph
