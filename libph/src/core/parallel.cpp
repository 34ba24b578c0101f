// SPDX-License-Identifier: MIT
#include "ph/detail/core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "ph/error.hpp"

namespace ph {
namespace {

// Hands out pieces one by one to any thread that asks.
class Pieces {
 public:
  Pieces(std::size_t count, std::size_t piece, const RunContext& context,
         const std::function<void(std::size_t, std::size_t)>& work)
      : count_(count), piece_(piece), context_(context), work_(work) {}

  /// Takes pieces and computes them until none is left. @param on_piece called after each piece
  /// with the size of the piece.
  template <class OnPiece>
  void take_all(OnPiece&& on_piece) {
    try {
      for (;;) {
        const std::size_t begin = next_.fetch_add(piece_, std::memory_order_relaxed);
        if (begin >= count_) return;
        context_.poll();
        const std::size_t end = std::min(begin + piece_, count_);
        work_(begin, end);
        on_piece(end - begin);
      }
    } catch (...) {
      next_.store(count_, std::memory_order_relaxed);
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const std::size_t count_, piece_;
  const RunContext& context_;
  const std::function<void(std::size_t, std::size_t)>& work_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::exception_ptr error_;
};

}  // namespace

std::size_t thread_count(const RunContext& context) {
  if (context.threads > 0) return static_cast<std::size_t>(context.threads);
  if (context.threads < 0)
    throw Error(ErrorKind::usage,
                "threads: found " + std::to_string(context.threads) + ", expected 0 or more");
  return std::max(1U, std::thread::hardware_concurrency());
}

void for_each_piece(std::string_view stage, std::size_t count, std::size_t piece,
                    const RunContext& context,
                    const std::function<void(std::size_t, std::size_t)>& work) {
  Pieces pieces(count, piece, context, work);
  Ticker ticker(context, stage, count);
  const std::size_t pieces_left = (count + piece - 1) / piece;
  // Asking the system for the number of threads takes longer than one small piece.
  const std::size_t others =
      pieces_left > 1 ? std::min(thread_count(context), pieces_left) : pieces_left;
  std::vector<std::jthread> threads;
  threads.reserve(others);
  for (std::size_t i = 1; i < others; ++i) {
    try {
      threads.emplace_back([&] { pieces.take_all([](std::size_t) {}); });
    } catch (const std::system_error&) {
      break;  // no further thread can start; the existing threads do the work
    }
  }
  pieces.take_all([&](std::size_t steps) {
    ticker.tick(steps);
    ticker.poll();
  });
  threads.clear();
  pieces.rethrow();
}

}  // namespace ph
