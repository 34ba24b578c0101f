// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace ph {

/// A matrix with a number for each pair of vertices. Each number occupies 16 bits until a number
/// that needs more bits is stored.
class PairLabels {
 public:
  using Vertex = std::uint32_t;
  using Label = std::uint32_t;

  PairLabels(std::size_t vertices, std::pmr::memory_resource* memory)
      : vertices_(vertices), short_(vertices * vertices, 0, memory), long_(memory) {}
  /// The number of a pair, or 0 if none was stored.
  Label operator()(Vertex u, Vertex v) const {
    const std::size_t i = u * vertices_ + v;
    return long_.empty() ? short_[i] : long_[i];
  }
  void set(Vertex u, Vertex v, Label label) {
    if (label > UINT16_MAX && long_.empty()) {
      long_.assign(short_.begin(), short_.end());
      short_ = std::pmr::vector<std::uint16_t>(short_.get_allocator());
    }
    for (const std::size_t i : {u * vertices_ + v, v * vertices_ + u})
      if (long_.empty())
        short_[i] = static_cast<std::uint16_t>(label);
      else
        long_[i] = label;  // mutant: long-labels
  }
  /// Prefetches a label that will be needed soon.
  void prefetch(Vertex u, Vertex v) const {
    const std::size_t i = u * vertices_ + v;
    if (long_.empty())
      __builtin_prefetch(&short_[i]);
    else
      __builtin_prefetch(&long_[i]);
  }

 private:
  std::size_t vertices_;
  std::pmr::vector<std::uint16_t> short_;
  std::pmr::vector<Label> long_;  // used for all pairs once a number needs more than 16 bits
};

}  // namespace ph
