// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <thread>
#include <vector>

#include "ph/detail/parallel.hpp"
#include "rips/annotations/field_rows.hpp"

namespace ph {

/// Writes stars into the rows of cocycles: phi(u,v,w) for all w of a new edge (u,v), as seen from
/// the edges (u,w) and (v,w), whose rows lie anywhere in memory. At once, or later on another
/// thread, while the owner of the rows goes on: who reads a row waits for the stars that may touch
/// it.
template <Field K>
class StarWriter {
 public:
  using Vertex = std::uint32_t;
  using Row = FieldRow<K>;
  using Unit = typename Row::Unit;
  using RowId = typename RowPool<K>::Id;

  /// Where a star goes.
  struct Star {
    Vertex u, v;
    const RowId *of_u, *of_v;  ///< rows of the edges at u and v, by their other end
  };

  /// @param rows, field outlive this.
  StarWriter(RowPool<K>& rows, const K& field, std::size_t vertices, std::size_t blocks,
             std::pmr::memory_resource* memory)
      : rows_(rows), field_(field), blocks_(blocks), last_(vertices, 0, memory), units_(memory) {}

  /// From now on stars wait until somebody calls `write_next`, on any thread.
  void write_later() {
    units_.resize(kMostWaiting * units_of_star());
    is_later_ = true;
    ready_ = begun_;
    done_ = begun_;
  }
  /// By the owner. Neither the rows' numbers nor the rows may be moved until `finish`.
  void write(const Star& star, const Unit* values);
  /// By the owner: a row of the edge ab is as if all stars had been written.
  void finish_row(Vertex a, Vertex b) const {
    if (is_later_) wait_until(std::max(last_[a], last_[b]));
  }
  /// By the owner: all rows are.
  void finish() const {
    if (is_later_) wait_until(begun_);
  }
  /// How many have been handed over.
  std::uint64_t count() const { return begun_; }
  /// Writes one star, if any waits and no other thread is about it. @return whether it did.
  bool write_next() const;

 private:
  static constexpr std::size_t kMostWaiting = 64;

  std::size_t units_of_star() const { return blocks_ * Row::kUnitsPerBlock; }
  void write_now(const Star& star, const Unit* values) const;
  void wait_until(std::uint64_t count) const {
    while (done_.load(std::memory_order_acquire) < count)
      if (!write_next()) std::this_thread::yield();
  }

  RowPool<K>& rows_;
  const K& field_;
  const std::size_t blocks_;
  bool is_later_ = false;
  std::pmr::vector<std::uint64_t> last_;  // by vertex: stars until the last with that end
  // Stars that wait, the k-th at k modulo their number.
  std::pmr::vector<Unit> units_;
  std::array<Star, kMostWaiting> stars_;
  std::uint64_t begun_ = 0;  // as the owner knows
  // Each on a line of its own: both threads look at them all the time.
  alignas(kCacheLine) std::atomic<std::uint64_t> ready_{0};
  alignas(kCacheLine) mutable std::atomic<std::uint64_t> done_{0};
  mutable std::atomic_flag is_writing_;
};

template <Field K>
void StarWriter<K>::write(const Star& star, const Unit* values) {
  if (!is_later_) {
    ++begun_;
    return write_now(star, values);
  }
  if (begun_ >= kMostWaiting) wait_until(begun_ - kMostWaiting + 1);
  const std::size_t place = begun_ % kMostWaiting;
  stars_[place] = star;
  std::copy_n(values, units_of_star(),
              units_.begin() + static_cast<std::ptrdiff_t>(place * units_of_star()));
  last_[star.u] = last_[star.v] = ++begun_;
  ready_.store(begun_, std::memory_order_release);
}

template <Field K>
bool StarWriter<K>::write_next() const {
  if (ready_.load(std::memory_order_acquire) == done_.load(std::memory_order_relaxed)) return false;
  if (is_writing_.test_and_set(std::memory_order_acquire)) return false;
  const std::uint64_t next = done_.load(std::memory_order_relaxed);
  const bool waits = next < ready_.load(std::memory_order_acquire);
  if (waits) {
    const std::size_t place = next % kMostWaiting;
    write_now(stars_[place], units_.data() + place * units_of_star());
    done_.store(next + 1, std::memory_order_release);
  }
  is_writing_.clear(std::memory_order_release);
  return waits;
}

template <Field K>
void StarWriter<K>::write_now(const Star& star, const Unit* values) const {
  const auto& [u, v, of_u, of_v] = star;
  // Rows are anywhere in memory: all are asked for before the first is waited for.
  Row::for_each(values, blocks_, [&](std::size_t w, auto) {
    __builtin_prefetch(of_u + w);
    __builtin_prefetch(of_v + w);
  });
  Row::for_each(values, blocks_, [&](std::size_t w, auto) {
    Row::prefetch(rows_[of_u[w]], v);
    Row::prefetch(rows_[of_v[w]], u);
  });
  Row::for_each(values, blocks_, [&](std::size_t w, auto a) {
    const auto opposite = field_.negate(a);
    Row::add_at(rows_[of_u[w]], v, w < u ? a : opposite, field_);
    Row::add_at(rows_[of_v[w]], u, v < w ? a : opposite, field_);
  });
}

}  // namespace ph
