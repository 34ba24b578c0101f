// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "ph/explicit.hpp"
#include "ph/run_context.hpp"

namespace ph {

/// A list of simplices that counts its memory before it is filled.
class CountedList {
 public:
  /// @param simplices, vertices the numbers of simplices and of all their vertices.
  CountedList(std::size_t simplices, std::size_t vertices, const RunContext& context)
      : claim_(std::make_unique<MemoryClaim>(
            context.memory,
            vertices * sizeof(Index) + simplices * (sizeof(std::size_t) + sizeof(double)))) {
    list_.vertices.reserve(vertices);
    list_.offsets.reserve(simplices + 1);
    list_.values.reserve(simplices);
  }
  void add(std::span<const Index> vertices, double value) { list_.add(vertices, value); }
  /// The list, which is not counted any more: the complex that is made from it counts it.
  SimplexList take() {
    claim_.reset();
    return std::move(list_);
  }

 private:
  std::unique_ptr<MemoryClaim> claim_;
  SimplexList list_;
};

}  // namespace ph
