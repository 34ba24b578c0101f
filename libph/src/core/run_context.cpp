// SPDX-License-Identifier: MIT
#include "ph/run_context.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "libph/src/core/system/pages.hpp"
#include "ph/detail/core/format_size.hpp"
#include "ph/detail/core/machine_memory.hpp"
#include "ph/detail/core/on_first_use.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

[[noreturn]] void refuse(std::size_t bytes, std::size_t used, std::size_t limit) {
  throw Error(
      ErrorKind::resource,
      fmt::format("memory limit of {} would be exceeded: {} in use, {} more needed",
                  format_size(static_cast<double>(limit)), format_size(static_cast<double>(used)),
                  format_size(static_cast<double>(bytes))));
}

// Large blocks are mapped by the system, and are returned to it when they are freed. The C library
// would keep them in its heap, where freed blocks leave holes that no budget counts.
bool is_large(std::size_t bytes, std::size_t alignment) {
  return bytes >= std::size_t{1} << 20 && alignment <= kSmallestPage;
}

// The memory that a block of the C library occupies: a header of one word and the block, rounded up
// to a multiple of 16 bytes, and at least 32 bytes. Columns of a matrix are often this small.
std::size_t heap_size(std::size_t bytes) {
  constexpr std::size_t header = sizeof(std::size_t), step = 16, least = 32;
  return std::max(least, (bytes + header + step - 1) / step * step);
}

std::size_t size_of_block(std::size_t bytes, std::size_t alignment) {
  return is_large(bytes, alignment) ? mapped_size(bytes) : heap_size(bytes);
}

}  // namespace

void MemoryBudget::require(std::size_t bytes) const {
  const std::size_t now = used();
  if (bytes > limit_ || now > limit_ - bytes) refuse(bytes, now, limit_);
  if (parent_) parent_->require(bytes);
}

void MemoryBudget::add(std::size_t bytes) {
  if (parent_) parent_->add(bytes);
  try {
    add_here(bytes);
  } catch (...) {
    if (parent_) parent_->subtract(bytes);
    throw;
  }
}

void MemoryBudget::add_here(std::size_t bytes) {
  const std::size_t before = used_.fetch_add(bytes, std::memory_order_relaxed);
  if (bytes > limit_ || before > limit_ - bytes) {
    used_.fetch_sub(bytes, std::memory_order_relaxed);
    refuse(bytes, before, limit_);
  }
  std::size_t seen = peak_.load(std::memory_order_relaxed);
  while (seen < before + bytes &&
         !peak_.compare_exchange_weak(seen, before + bytes, std::memory_order_relaxed)) {
  }
}

void* MemoryBudget::do_allocate(std::size_t bytes, std::size_t alignment) {
  const std::size_t taken = size_of_block(bytes, alignment);
  add(taken);
  try {
    return is_large(bytes, alignment) ? map_pages(bytes)
                                      : std::pmr::new_delete_resource()->allocate(bytes, alignment);
  } catch (...) {
    subtract(taken);
    throw;
  }
}

void MemoryBudget::do_deallocate(void* p, std::size_t bytes, std::size_t alignment) {
  if (is_large(bytes, alignment)) {
    unmap_pages(p, bytes);
  } else {
    std::pmr::new_delete_resource()->deallocate(p, bytes, alignment);
  }
  subtract(size_of_block(bytes, alignment));
}

void RunContext::poll() const {
  if (stop.stop_requested()) throw Error(ErrorKind::cancelled, "stopped on request");
}

void RunContext::report(const Progress& progress) const {
  if (!on_progress) return;
  // All stages share the time of the last report. Otherwise many short stages in a row would never
  // be reported.
  const auto now = std::chrono::steady_clock::now();
  if (now - last_report_ < std::chrono::milliseconds(100)) return;
  last_report_ = now;
  on_progress(progress);
}

const RunContext& default_context() {
  // Without a limit, a lack of memory would end in std::bad_alloc or in the death of the process.
  struct Limited : RunContext {
    Limited() { memory.set_limit(machine_memory()); }
  };
  static constinit detail::OnFirstUse context([] { return Limited(); });
  return *context;
}

Ticker::Ticker(const RunContext& context, std::string_view stage, std::uint64_t total)
    : context_(context), progress_{stage, 0, total}, last_poll_(std::chrono::steady_clock::now()) {
  context_.poll();
}

void Ticker::poll() {
  using std::chrono::milliseconds;
  pending_ = 0;
  context_.poll();
  const auto now = std::chrono::steady_clock::now();
  const auto since = now - std::exchange(last_poll_, now);
  if (since < milliseconds(1))
    interval_ = std::min(kMostSteps, 2 * interval_);
  else if (since > milliseconds(5))
    interval_ = std::max<std::uint64_t>(1, interval_ / 4);
  if (!progress_.stage.empty()) context_.report(progress_);
}

}  // namespace ph
