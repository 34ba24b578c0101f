// SPDX-License-Identifier: MIT
#pragma once
#include "ph/detail/io/reader.hpp"

namespace ph::detail {

/// Reads the cells of a text one after another, regardless of line ends.
class CellStream {
 public:
  explicit CellStream(TextLines& lines) : lines_(lines), cells_(lines) {}

  bool more() {
    while (!started_ || !cells_.more()) {
      if (!lines_.next()) return false;
      cells_.start();
      started_ = true;
    }
    return true;
  }
  Cells& cells() { return cells_; }

 private:
  TextLines& lines_;
  Cells cells_;
  bool started_ = false;
};

}  // namespace ph::detail
