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

/// A memory resource that counts memory, and refuses requests that would exceed a limit. The large
/// containers of a computation allocate through it. Thread-safe.
class MemoryBudget final : public std::pmr::memory_resource {
 public:
  static constexpr std::size_t kUnlimited = SIZE_MAX;

  explicit MemoryBudget(std::size_t limit_bytes = kUnlimited) : limit_(limit_bytes) {}
  /// A budget inside another budget, which must outlive it. Memory taken here counts against both
  /// limits.
  explicit MemoryBudget(MemoryBudget& parent) : parent_(&parent), limit_(kUnlimited) {}
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

  std::size_t limit() const { return limit_; }
  void set_limit(std::size_t bytes) { limit_ = bytes; }
  std::size_t used() const { return used_.load(std::memory_order_relaxed); }
  /// Bytes that may still be taken.
  std::size_t left() const {
    const std::size_t left = limit_ - std::min(limit_, used());
    return parent_ ? std::min(left, parent_->left()) : left;
  }
  std::size_t peak() const { return peak_.load(std::memory_order_relaxed); }

  /// @throws Error (resource) if `bytes` more bytes would exceed the limit. Allocates nothing.
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

/// Counts memory from another source, such as a mapped file, against a budget as long as this
/// object exists.
class MemoryClaim {
 public:
  /// @throws Error (resource) if `bytes` more bytes would exceed the limit.
  MemoryClaim(MemoryBudget& budget, std::size_t bytes) : budget_(budget), bytes_(bytes) {
    budget_.add(bytes_);
  }
  ~MemoryClaim() { budget_.subtract(bytes_); }
  /// Claims more, up to a total of `bytes` and a little beyond, which makes frequent calls cheap.
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

/// The progress of a computation. `total` is 0 if it cannot be known.
struct Progress {
  std::string_view stage;
  std::uint64_t done = 0;
  std::uint64_t total = 0;
};

/// The means by which a caller limits, observes and stops a long computation. A context must
/// outlive every object that was built with it.
struct RunContext {
  RunContext() = default;
  /// A context whose memory counts against another budget as well, which must outlive the context.
  explicit RunContext(MemoryBudget& parent) : memory(parent) {}

  std::stop_token stop;                              ///< polled often; see `poll`
  std::function<void(const Progress&)> on_progress;  ///< called at most ten times per second
  mutable MemoryBudget memory;                       ///< unlimited unless `set_limit` is called
  int threads = 0;                                   ///< threads to use, >= 0; 0: one per core
  /// Images: number of layers along the first axis that are processed together. 0: all layers if
  /// the memory limit allows it, otherwise as many as it allows. The result does not depend on this
  /// number.
  int slab_layers = 0;

  /// @throws Error (cancelled) once a stop was requested.
  void poll() const;
  /// Calls on_progress, unless it was called a moment ago. Only one thread may call it.
  void report(const Progress& progress) const;

 private:
  mutable std::chrono::steady_clock::time_point last_report_ = std::chrono::steady_clock::now();
};

/// The context of functions that were given none. Its memory limit is nine tenths of the memory of
/// the machine or container, as in the programs. It reports no progress and is never stopped.
const RunContext& default_context();

/// Counts the steps of a stage, and polls and reports now and then. A ticker whose stage has no
/// name never reports, and can therefore be used on any thread.
class Ticker {
 public:
  Ticker(const RunContext& context, std::string_view stage, std::uint64_t total = 0);
  Ticker(const Ticker&) = delete;
  Ticker& operator=(const Ticker&) = delete;

  void tick(std::uint64_t steps = 1) {
    progress_.done += steps;
    work(steps);
  }
  /// Counts work that is not progress (an addition inside a column): it leads to polls, but is not
  /// reported as steps.
  void work(std::uint64_t steps = 1) {
    pending_ += steps;
    if (pending_ >= interval_) poll();
  }
  /// Polls and reports now, for steps that take long.
  void poll();

 private:
  static constexpr std::uint64_t kMostSteps = 4096;

  const RunContext& context_;
  Progress progress_;
  std::uint64_t pending_ = 0;
  std::uint64_t interval_ = 1;  // steps between polls; slow steps are polled more often
  std::chrono::steady_clock::time_point last_poll_;
};

/// The error of one input among many. `what()` is "input I: " followed by the reason.
class InputError : public Error {
 public:
  InputError(std::size_t input, const Error& error)
      : Error(error.kind(), "input " + std::to_string(input) + ": " + error.marked()),
        input_(input),
        cause_(std::make_shared<const Error>(error)) {}
  std::size_t input() const noexcept { return input_; }
  /// The error itself, without the number of the input.
  const Error& cause() const noexcept { return *cause_; }
  std::string reason() const { return cause_->what(); }

 private:
  std::size_t input_;
  std::shared_ptr<const Error> cause_;
};

/// Calls `work(i, of_input)` for i = 0 … count - 1, on as many threads as `context` allows, one
/// input per thread: for many small inputs, this is faster than using all threads for one input at
/// a time. If there are at least twice as many threads as inputs, each input gets several threads.
///
/// Any thread may take any input: the output of `work` must depend on i alone. The context passed
/// to `work` stops with `context`, shares the rest of its memory limit with all other inputs and
/// reports no progress; `context` receives the number of finished inputs.
/// @throws InputError for an Error in `work`, except Error (cancelled); any other exception
///         unchanged. An error stops the other inputs; if several have failed by then, the error of
///         the input with the smallest number is thrown. Error (cancelled) on a stop request.
void for_each_input(std::size_t count, const RunContext& context,
                    const std::function<void(std::size_t, const RunContext&)>& work);

}  // namespace ph
