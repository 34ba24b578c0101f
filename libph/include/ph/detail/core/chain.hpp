// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/core/field.hpp"

namespace ph {

/// One term of a chain or cochain: a cell with a non-zero coefficient. Over Z/2 the coefficient is
/// always one and takes no space.
template <class Cell, Field K>
struct Entry {
  Entry() = default;
  Entry(const Cell& c, typename K::Element a) : cell(c), coefficient_(a) {}
  typename K::Element coefficient() const { return coefficient_; }

  Cell cell{};

 private:
  typename K::Element coefficient_{};
};

template <class Cell>
struct Entry<Cell, Z2> {
  Entry() = default;
  Entry(const Cell& c, Z2::Element) : cell(c) {}
  static constexpr Z2::Element coefficient() { return true; }

  Cell cell{};
};

}  // namespace ph
