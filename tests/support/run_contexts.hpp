// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <stop_token>

#include "ph/run_context.hpp"

namespace ph::test {

/// A context with a memory limit in bytes.
struct LimitedContext : RunContext {
  explicit LimitedContext(std::size_t limit) { memory.set_limit(limit); }
};

/// A context with this number of threads.
struct ThreadsContext : RunContext {
  explicit ThreadsContext(int count) { threads = count; }
};

/// A context that a test can stop at any time.
struct StoppableContext : RunContext {
  StoppableContext() { stop = source_.get_token(); }
  void request_stop() { source_.request_stop(); }

 private:
  std::stop_source source_;
};

/// A context that has already been stopped.
struct StoppedContext : StoppableContext {
  StoppedContext() { request_stop(); }
};

}  // namespace ph::test
