// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <stop_token>

#include "ph/run_context.hpp"

namespace ph::test {

/// A context whose memory has a limit, in bytes.
struct LimitedContext : RunContext {
  explicit LimitedContext(std::size_t limit) { memory.set_limit(limit); }
};

/// A context of so many threads.
struct ThreadsContext : RunContext {
  explicit ThreadsContext(int count) { threads = count; }
};

/// A context that a test stops when it likes.
struct StoppableContext : RunContext {
  StoppableContext() { stop = source_.get_token(); }
  void request_stop() { source_.request_stop(); }

 private:
  std::stop_source source_;
};

/// A context that was stopped beforehand.
struct StoppedContext : StoppableContext {
  StoppedContext() { request_stop(); }
};

}  // namespace ph::test
