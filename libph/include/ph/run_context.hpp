// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <memory_resource>
#include <stop_token>
#include <string>
#include <string_view>

#include "ph/error.hpp"

namespace ph {

/// A memory resource that counts, and refuses what would exceed a limit. The large containers of a
/// computation allocate through it. Thread-safe.
class MemoryBudget final : public std::pmr::memory_resource {
 public:
  static constexpr std::size_t kUnlimited = SIZE_MAX;

  explicit MemoryBudget(std::size_t limit_bytes = kUnlimited) : limit_(limit_bytes) {}
  /// A budget within another one, which outlives it: what is taken here counts in both, and both
  /// limits hold.
  explicit MemoryBudget(MemoryBudget& parent) : parent_(&parent), limit_(kUnlimited) {}
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

  std::size_t limit() const { return limit_; }
  void set_limit(std::size_t bytes) { limit_ = bytes; }
  std::size_t used() const { return used_.load(std::memory_order_relaxed); }
  /// What may still be taken.
  std::size_t left() const {
    const std::size_t left = limit_ - std::min(limit_, used());
    return parent_ ? std::min(left, parent_->left()) : left;
  }
  std::size_t peak() const { return peak_.load(std::memory_order_relaxed); }

  /// @throws Error (resource) if `bytes` more would exceed the limit. Allocates nothing.
  void require(std::size_t bytes) const;

 private:
  friend class MemoryClaim;
  void add(std::size_t bytes);
  void add_here(std::size_t bytes);
  void subtract(std::size_t bytes) {
    used_.fetch_sub(bytes, std::memory_order_relaxed);
    if (parent_) parent_->subtract(bytes);
  }
  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void* p, std::size_t bytes, std::size_t alignment) override;
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  MemoryBudget* parent_ = nullptr;
  std::size_t limit_;
  std::atomic<std::size_t> used_{0};
  std::atomic<std::size_t> peak_{0};
};

/// Counts memory that comes from elsewhere (a mapped file) in a budget for as long as it lives.
class MemoryClaim {
 public:
  /// @throws Error (resource) if `bytes` more would exceed the limit.
  MemoryClaim(MemoryBudget& budget, std::size_t bytes) : budget_(budget), bytes_(bytes) {
    budget_.add(bytes_);
  }
  ~MemoryClaim() { budget_.subtract(bytes_); }
  /// Claims more, up to `bytes` in all and a little ahead: it may be asked often.
  /// @throws Error (resource) as the constructor.
  void grow_to(std::size_t bytes) {
    if (bytes <= bytes_) return;
    constexpr std::size_t ahead = 1 << 12;
    budget_.add(bytes + ahead - bytes_);
    bytes_ = bytes + ahead;
  }
  std::size_t bytes() const { return bytes_; }
  MemoryClaim(const MemoryClaim&) = delete;
  MemoryClaim& operator=(const MemoryClaim&) = delete;

 private:
  MemoryBudget& budget_;
  std::size_t bytes_;
};

/// How far a computation is. `total` is 0 where it cannot be known.
struct Progress {
  std::string_view stage;
  std::uint64_t done = 0;
  std::uint64_t total = 0;
};

/// What a long computation needs from its caller: a way to stop it, to watch it and to bound it.
/// Outlives every object that was built with it.
struct RunContext {
  RunContext() = default;
  /// A context whose memory counts in that of another one, which outlives it.
  explicit RunContext(MemoryBudget& parent) : memory(parent) {}

  std::stop_token stop;                              ///< asked for often; see `poll`
  std::function<void(const Progress&)> on_progress;  ///< called at most ten times a second
  mutable MemoryBudget memory;                       ///< unlimited unless `set_limit` is called
  int threads = 0;                                   ///< threads to use; 0: one for each core
  /// Images: layers along the first axis that are looked at together. 0: all where the memory limit
  /// allows it, else as many as do. What is computed does not depend on it.
  int slab_layers = 0;

  /// @throws Error (cancelled) once a stop was requested.
  void poll() const;
  /// Calls on_progress, unless that happened a moment ago. From one thread only.
  void report(const Progress& progress) const;

 private:
  mutable std::chrono::steady_clock::time_point last_report_ = std::chrono::steady_clock::now();
};

/// No limits, no progress, no stop: what functions use that were given no context.
const RunContext& default_context();

/// Counts steps of a stage, polls and reports now and then; one without a name suits any thread.
class Ticker {
 public:
  Ticker(const RunContext& context, std::string_view stage, std::uint64_t total = 0);
  Ticker(const Ticker&) = delete;
  Ticker& operator=(const Ticker&) = delete;

  void tick(std::uint64_t steps = 1) {
    progress_.done += steps;
    work(steps);
  }
  /// Work that is not progress (an addition inside a column): polls, does not count.
  void work(std::uint64_t steps = 1) {
    pending_ += steps;
    if (pending_ >= interval_) poll();
  }
  /// Polls and reports now; for steps that take long.
  void poll();

 private:
  static constexpr std::uint64_t kMostSteps = 4096;

  const RunContext& context_;
  Progress progress_;
  std::uint64_t pending_ = 0;
  std::uint64_t interval_ = 1;  // steps between polls: fewer where a step takes long
  std::chrono::steady_clock::time_point last_poll_;
};

/// What went wrong with one input of many. `what()` is "input I: " and the reason.
class InputError : public Error {
 public:
  InputError(std::size_t input, const Error& error)
      : Error(error.kind(), "input " + std::to_string(input) + ": " + error.marked()),
        input_(input),
        cause_(std::make_shared<const Error>(error)) {}
  std::size_t input() const noexcept { return input_; }
  /// What went wrong with it, without its number.
  const Error& cause() const noexcept { return *cause_; }
  std::string reason() const { return cause_->what(); }

 private:
  std::size_t input_;
  std::shared_ptr<const Error> cause_;
};

/// Calls `work(i, of_input)` for i = 0 … count - 1, on as many threads as `context` allows, one
/// input on each: of many small ones that is faster than all threads on one. With fewer inputs than
/// threads each input gets several.
///
/// Which thread takes which input is left open: what `work` writes must depend on i alone. The
/// context it is given stops with `context`, has what is left of its memory limit for all inputs
/// together, and reports no progress: `context` is told how many inputs are done.
/// @throws InputError for an Error in `work`, anything else as it is. It stops the other inputs; of
///         several that have failed by then the first one counts. Error (cancelled) on a stop
///         request.
void for_each_input(std::size_t count, const RunContext& context,
                    const std::function<void(std::size_t, const RunContext&)>& work);

}  // namespace ph
