// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "ph/detail/facade/transport.hpp"
#include "ph/error.hpp"

namespace ph::test {

/// What may happen to a message.
enum class Mishap { none, lost, doubled, swapped, changed };

/// Ranks that are threads of this process. Messages wait in queues. Random delays decide which rank
/// falls behind.
class ThreadRanks {
 public:
  using Bytes = std::vector<std::byte>;

  /// @param delays random numbers that delay ranks; null for no delays.
  ThreadRanks(int size, std::mt19937* delays) : size_(size) {
    for (int i = 0; i < size && delays != nullptr; ++i) naps_.push_back((*delays)());
  }
  /// Plans a mishap for one message. Messages are numbered over all ranks.
  void plan(Mishap mishap, int message) {
    mishap_ = mishap;
    unlucky_ = message;
  }
  bool has_happened() const { return has_happened_; }

  /// Runs all ranks until they end. If a rank fails, the others are told to stop. @throws the error
  /// of the first rank that fails.
  void run(const std::function<void(Transport&)>& rank) {
    std::vector<std::thread> threads;
    std::exception_ptr failure;
    for (int i = 0; i < size_; ++i)
      threads.emplace_back([&, i] {
        Rank transport(*this, i);
        try {
          rank(transport);
        } catch (...) {
          const std::lock_guard lock(mutex_);
          if (!failure) failure = std::current_exception();
          is_over_ = true;
          arrived_.notify_all();
        }
      });
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
  }

 private:
  class Rank final : public Transport {
   public:
    Rank(ThreadRanks& all, int rank) : all_(all), rank_(rank) {}
    int rank() const override { return rank_; }
    int size() const override { return all_.size_; }
    void send(int to, std::span<const std::byte> message) override {
      all_.nap(rank_);
      all_.put(rank_, to, Bytes(message.begin(), message.end()));
    }
    Bytes receive(int from) override {
      all_.nap(rank_);
      return all_.take(from, rank_);
    }

   private:
    ThreadRanks& all_;
    const int rank_;
  };

  /// Delays a rank. Each rank has a random generator of its own, because threads cannot share a
  /// generator.
  void nap(int rank) {
    if (naps_.empty()) return;
    std::uint_fast32_t& state = naps_[static_cast<std::size_t>(rank)];
    state = (state * 1664525U + 1013904223U) & 0xFFFFFFFFU;
    const auto choice = state >> 28;
    if (choice < 4) std::this_thread::yield();
    if (choice == 4) std::this_thread::sleep_for(std::chrono::microseconds(state >> 8 & 255));
  }
  void put(int from, int to, Bytes message) {
    const std::lock_guard lock(mutex_);
    std::deque<Bytes>& queue = queues_[{from, to}];
    const bool is_unlucky = mishap_ != Mishap::none && sent_++ == unlucky_;
    if (is_unlucky) {
      has_happened_ = true;
      if (mishap_ == Mishap::changed) message[message.size() / 2] ^= std::byte{16};
      if (mishap_ == Mishap::doubled) queue.push_back(message);
    }
    if (is_unlucky && mishap_ == Mishap::swapped) {
      held_ = {{from, to}, std::move(message)};
    } else if (!(is_unlucky && mishap_ == Mishap::lost)) {
      queue.push_back(std::move(message));
      if (held_.second.size() > 0 && held_.first == std::pair(from, to))
        queue.push_back(std::exchange(held_.second, {}));
    }
    arrived_.notify_all();
  }
  Bytes take(int from, int to) {
    std::unique_lock lock(mutex_);
    std::deque<Bytes>& queue = queues_[{from, to}];
    // Limits the wait, because a lost message never arrives.
    constexpr std::chrono::milliseconds patience(100);
    const bool came =
        arrived_.wait_for(lock, mishap_ == Mishap::none ? std::chrono::minutes(1) : patience,
                          [&] { return is_over_ || !queue.empty(); });
    if (is_over_) throw Error(ErrorKind::cancelled, "another rank failed");
    if (!came) throw Error(ErrorKind::io, "nothing came");
    Bytes message = std::move(queue.front());
    queue.pop_front();
    return message;
  }

  const int size_;
  std::vector<std::uint_fast32_t> naps_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::map<std::pair<int, int>, std::deque<Bytes>> queues_;
  Mishap mishap_ = Mishap::none;
  int unlucky_ = 0, sent_ = 0;
  std::pair<std::pair<int, int>, Bytes> held_;
  std::atomic<bool> has_happened_ = false;
  bool is_over_ = false;
};

}  // namespace ph::test
