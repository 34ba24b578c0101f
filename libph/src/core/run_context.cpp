// SPDX-License-Identifier: MIT
#include "ph/run_context.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/system/pages.hpp"
#include "ph/error.hpp"

namespace ph {
namespace {

constexpr double kMiB = 1024.0 * 1024.0;

[[noreturn]] void refuse(std::size_t bytes, std::size_t used, std::size_t limit) {
  throw Error(ErrorKind::resource,
              fmt::format("memory limit of {:.1f} MiB would be exceeded: {:.1f} MiB in use, "
                          "{:.1f} MiB more needed",
                          static_cast<double>(limit) / kMiB, static_cast<double>(used) / kMiB,
                          static_cast<double>(bytes) / kMiB));
}

constexpr std::size_t kHugePage = std::size_t{2} << 20;

// What is asked of the system for a block. One that fills huge pages, or nearly, begins and ends
// where they do; others would leave too much room where memory is short. The budget counts what
// lies on huge pages as they do: without that, a program in a control group of 64 MiB is ended by
// the system before it reaches the limit that it took from the group.
struct Request {
  std::size_t bytes, alignment;
};
Request request_for(std::size_t bytes, std::size_t alignment) {
  constexpr std::size_t nearly = 5;  // at most a fifth of a block is left over
  const std::size_t rest = (kHugePage - bytes % kHugePage) % kHugePage;
  if (rest > bytes / nearly || bytes > SIZE_MAX - rest) return {bytes, alignment};
  return {bytes + rest, std::max(alignment, kHugePage)};
}

}  // namespace

void MemoryBudget::require(std::size_t bytes) const {
  const std::size_t now = used();
  if (bytes > limit_ || now > limit_ - bytes) refuse(bytes, now, limit_);
}

void MemoryBudget::add(std::size_t bytes) {
  const std::size_t before = used_.fetch_add(bytes, std::memory_order_relaxed);
  if (bytes > limit_ || before > limit_ - bytes) {
    subtract(bytes);
    refuse(bytes, before, limit_);
  }
  std::size_t seen = peak_.load(std::memory_order_relaxed);
  while (seen < before + bytes &&
         !peak_.compare_exchange_weak(seen, before + bytes, std::memory_order_relaxed)) {
  }
}

void* MemoryBudget::do_allocate(std::size_t bytes, std::size_t alignment) {
  const Request request = request_for(bytes, alignment);
  add(request.bytes);
  try {
    void* const block = std::pmr::new_delete_resource()->allocate(request.bytes, request.alignment);
    prefer_huge_pages(block, request.bytes);
    return block;
  } catch (...) {
    subtract(request.bytes);
    throw;
  }
}

void MemoryBudget::do_deallocate(void* p, std::size_t bytes, std::size_t alignment) {
  const Request request = request_for(bytes, alignment);
  std::pmr::new_delete_resource()->deallocate(p, request.bytes, request.alignment);
  subtract(request.bytes);
}

void RunContext::poll() const {
  if (stop.stop_requested()) throw Error(ErrorKind::cancelled, "stopped on request");
}

void RunContext::report(const Progress& progress) const {
  if (!on_progress) return;
  // The time is that of all stages: many short ones in a row would never be heard of otherwise.
  const auto now = std::chrono::steady_clock::now();
  if (now - last_report_ < std::chrono::milliseconds(100)) return;
  last_report_ = now;
  on_progress(progress);
}

const RunContext& default_context() {
  static const RunContext context;
  return context;
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
